// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/old_regions.h"

#include <algorithm>
#include <set>

#include "base/number.h"
#include "lang/region_texts.h"

namespace gable::lang {

namespace {

constexpr std::string_view kOperations[] = {"grid",        "voronoi",    "castRays",       "peel",
                                            "place",       "distribute", "scatterCircles", "sweep",
                                            "parametrise", "joined",     "region.selects"};

bool hasText(const Tree& t, NodeId node) {
  if (t.kind(node) == NodeKind::String) return true;
  if (t.kind(node) != NodeKind::Binary || t.binaryOp(node) != BinaryOp::Add) return false;
  return hasText(t, t.child(node, 0)) || hasText(t, t.child(node, 1));
}

class Rewriter {
 public:
  Rewriter(const Tree& t, NodeId call, std::string_view source)
      : t_(t), call_(call), source_(source), name_(t.text(call)) {
    for (const NodeId a : t.children(t.child(call, 0))) arguments_.push_back(a);
  }

  std::vector<TextEdit> run() {
    if (name_ == "grid") {
      dimension(0, "widths", "columnAngles");
      dimension(1, "heights", "rowAngles");
      plain(2);
      figure(3, "junction");
      options(4);
    } else if (name_ == "voronoi") {
      sites(0);
      plain(1);
      formed(2, &RegionTexts::smoothing);
      addSites();
      options(3);
    } else if (name_ == "castRays") {
      centres();
      formed(1, &RegionTexts::targets);
      plain(2);
      addSites();
      figure(3, "centre");
      options(4);
    } else if (name_ == "peel") {
      peel();
      options(2);
    } else if (name_ == "place") {
      formed(0, &RegionTexts::places);
      figure(1, "");
      options(2);
    } else if (name_ == "distribute") {
      formed(0, &RegionTexts::selection);
      positions(1);
      named(2, "inset");
      figure(3, "");
      options(4);
    } else if (name_ == "scatterCircles") {
      plain(0);
      formed(1, &RegionTexts::drawn);
      options(2);
    } else if (name_ == "sweep") {
      formed(0, &RegionTexts::lines);
      plain(1);
      named(2, "inset");
      options(3);
    } else if (name_ == "parametrise") {
      formed(0, &RegionTexts::lines);
      plain(1);
    } else if (name_ == "region.selects") {
      formed(0, &RegionTexts::selection);
    } else {
      return {};
    }
    if (!ok_) return {};
    std::string list;
    for (const std::string& p : positional_) list += (list.empty() ? "" : ", ") + p;
    for (const std::string& p : named_) list += (list.empty() ? "" : ", ") + p;
    const Span from = t_.span(arguments_.front()), to = t_.span(arguments_.back());
    edits_.insert(edits_.begin(), {from.begin, to.end, list});
    return std::move(edits_);
  }

 private:
  bool has(size_t i) const { return i < arguments_.size(); }
  std::string written(NodeId node) const {
    const Span s = t_.span(node);
    return std::string(source_.substr(s.begin, s.end - s.begin));
  }
  // A text that is put together, with the expressions in their places.
  std::string textOf(NodeId node) const {
    if (t_.kind(node) == NodeKind::String) return std::string(t_.text(node));
    if (hasText(t_, node)) return textOf(t_.child(node, 0)) + textOf(t_.child(node, 1));
    const bool simple = t_.kind(node) == NodeKind::Name || t_.kind(node) == NodeKind::Number ||
                        t_.kind(node) == NodeKind::Call;
    const std::string own = written(node);
    return simple || own.front() == '(' ? own : "(" + own + ")";
  }
  bool isText(size_t i) const { return has(i) && hasText(t_, arguments_[i]); }
  std::string text(size_t i) const { return has(i) ? textOf(arguments_[i]) : std::string(); }

  void plain(size_t i) {
    if (!has(i)) return;
    ok_ = ok_ && !isText(i);
    positional_.push_back(written(arguments_[i]));
  }
  void named(size_t i, const char* name) {
    if (!has(i)) return;
    ok_ = ok_ && !isText(i);
    const std::string value = written(arguments_[i]);
    if (value != "0") named_.push_back(std::string(name) + " = " + value);
  }
  void formed(size_t i, std::string (RegionTexts::*form)(std::string_view)) {
    if (!has(i)) return;
    if (!isText(i)) return plain(i);
    RegionTexts texts;
    const std::string made = (texts.*form)(text(i));
    ok_ = ok_ && !made.empty();
    positional_.push_back(made);
  }
  void dimension(size_t i, const char* sizes, const char* angles) {
    if (!has(i)) return;
    if (!isText(i)) return add(i == 0 ? "columns" : "rows", written(arguments_[i]));
    RegionTexts texts;
    const RegionTexts::Dimension d = texts.dimension(text(i));
    ok_ = ok_ && d.read;
    if (!d.count.empty()) {
      add(i == 0 ? "columns" : "rows", d.count);
    } else {
      gap_ = true;
    }
    if (!d.sizes.empty()) named_.push_back(std::string(sizes) + " = " + d.sizes);
    if (!d.angles.empty()) named_.push_back(std::string(angles) + " = " + d.angles);
  }
  // By its place as long as none before it is missing.
  void add(const std::string& name, const std::string& value) {
    if (gap_) {
      named_.push_back(name + " = " + value);
    } else {
      positional_.push_back(value);
    }
  }
  void sites(size_t i) {
    if (!isText(i)) return plain(i);
    RegionTexts texts;
    const RegionTexts::Sites s = texts.sites(text(i));
    ok_ = ok_ && !s.sites.empty();
    positional_.push_back(s.sites);
    radius_ = s.radius;
  }
  void addSites() {
    if (!radius_.empty()) named_.push_back("radius = " + radius_);
  }
  void centres() {
    const std::string word = text(0);
    if (isText(0) && (word == "centre" || word == "center")) {
      positional_.emplace_back("centre");
    } else {
      sites(0);
    }
  }
  void positions(size_t i) {
    if (!isText(i)) return plain(i);
    std::string t = text(i);
    std::erase(t, ' ');
    if (t.size() < 3 || t.front() != '[' || t.back() != ']') {
      positional_.push_back(t);
      return;
    }
    std::string inside = t.substr(1, t.size() - 2);
    const bool start = inside.starts_with("start:"), colon = start || inside.starts_with(":");
    const bool end = inside.ends_with(":end");
    if (start) inside = inside.substr(6);
    if (colon && !start) inside = inside.substr(1);
    if (end) inside.resize(inside.size() - 4);
    if (inside.ends_with(":")) inside.pop_back();
    double v = 0;
    const bool number = parseNumber(inside, v);
    // Of an expression nobody knows whether it is a count or a length.
    const bool list =
        !colon && !end && (inside.find(',') != std::string::npos || (number && v < 1));
    ok_ = ok_ && (list || number);
    if (list) {
      named_.push_back("at = [" + inside + "]");
      return;
    }
    const bool real = inside.find('.') != std::string::npos;
    named_.push_back(std::string(real ? "interval = " : "intervals = ") + inside);
    if (start) named_.emplace_back("start = true");
    if (end) named_.emplace_back("end = true");
  }

  void peel() {
    const std::string selection = text(0);
    if (selection.find('{') == std::string::npos) {
      formed(0, &RegionTexts::selection);
      plain(1);
      return;
    }
    const size_t open = selection.find('{') + 1, close = selection.rfind('}');
    std::string all;
    size_t begin = open, depth = 0;
    for (size_t i = open; close != std::string::npos && i <= close; ++i) {
      const char c = i < close ? selection[i] : ',';
      if (c == '(' || c == '[') ++depth;
      if ((c == ')' || c == ']') && depth > 0) --depth;
      if (c != ',' || (depth > 0 && i < close)) continue;
      const std::string item = selection.substr(begin, i - begin);
      begin = i + 1;
      const size_t colon = item.rfind(':');
      RegionTexts texts;
      const std::string edges =
          colon == std::string::npos ? std::string() : texts.selection(item.substr(0, colon));
      ok_ = ok_ && !edges.empty();
      if (!ok_) return;
      size_t width = colon + 1;
      while (width < item.size() && item[width] == ' ') ++width;
      all += (all.empty() ? "wide(" : " || wide(") + edges + ", " + item.substr(width) + ")";
    }
    ok_ = ok_ && !all.empty();
    positional_.push_back(all);
  }

  // A figure moves to the head of the operations that it is for.
  void figure(size_t i, std::string_view word) {
    if (!has(i)) return;
    const std::string old = text(i);
    if (isText(i) && (old == "none" || old.empty())) return;
    std::string made;
    if (!isText(i)) {
      if (written(arguments_[i]) == "0") return;
      made = "circle(" + written(arguments_[i]) + ")";
    } else {
      // Choices among figures had no operations of their own.
      RegionTexts texts;
      made = texts.figure(old);
    }
    ok_ = ok_ && !made.empty();
    bool found = false;
    for (const NodeId block : t_.children(call_).subspan(1)) {
      for (const NodeId item : t_.children(block)) {
        if (t_.kind(item) != NodeKind::Item) continue;
        const NodeId head = t_.child(item, 0), body = t_.child(item, 2);
        const bool mine = head == kNoNode ? word.empty()
                                          : t_.kind(head) == NodeKind::Name && !word.empty() &&
                                                t_.text(head) == word;
        if (!mine || t_.children(body).empty()) continue;
        const uint32_t at = t_.span(body).begin;
        edits_.push_back({at, at, made + " "});
        found = true;
      }
    }
    // A figure that is cut out and given to no one.
    ok_ = ok_ && found;
  }

  void options(size_t i) {
    if (!has(i)) return;
    const bool none = !isText(i) || RegionTexts::options(text(i)).empty();
    if (none) return;
    for (const auto& [name, value] : RegionTexts::options(text(i))) option(name, value);
  }
  void option(const std::string& name, const std::string& value) {
    static constexpr std::string_view kFlags[] = {"over",  "split", "align",
                                                  "chain", "lines", "orthogonal"};
    static constexpr std::string_view kSame[] = {
        "fit",    "template", "pattern", "dominance", "sliver", "orphans", "jitter",
        "hidden", "share",    "gap",     "edge",      "ends",   "height"};
    const auto in = [&](const auto& all) {
      return std::find(std::begin(all), std::end(all), name) != std::end(all);
    };
    if (name == "align" && name_ == "distribute") return;
    if (name == "symxy") {
      named_.emplace_back("symmetric = true");
    } else if (name == "round" && value.empty()) {
      named_.emplace_back("joins = round");
      named_.emplace_back("ends = round");
    } else if (name == "borderpath") {
      named_.push_back(std::string("borderPath = ") + (value == "none" ? "false" : "true"));
    } else if (name == "minarea") {
      named_.push_back("minArea = " + value);
    } else if (name == "smooth" || name == "profile") {
      RegionTexts texts;
      const std::string made = name == "smooth" ? texts.smoothing(value) : texts.profile(value);
      ok_ = ok_ && !made.empty();
      named_.push_back(name + " = " + made);
    } else if (name == "joins") {
      named_.push_back(std::string("joins = ") + (value == "miter" ? "mitre" : value));
    } else if (name == "connect" && value.starts_with("thin(") && value.ends_with(")")) {
      named_.emplace_back("connect = thin");
      named_.push_back("share = " + value.substr(5, value.size() - 6));
    } else if (name == "connect" || in(kSame)) {
      named_.push_back(name + " = " + (value == "centre" && name == "fit" ? "center" : value));
    } else if (in(kFlags) && value.empty()) {
      named_.push_back(name + " = true");
    } else {
      ok_ = false;
    }
  }

  const Tree& t_;
  NodeId call_;
  std::string_view source_;
  std::string_view name_;
  std::vector<NodeId> arguments_;
  std::vector<std::string> positional_, named_;
  std::vector<TextEdit> edits_;
  std::string radius_;
  bool ok_ = true, gap_ = false;
};

}  // namespace

std::string_view modernOperation(std::string_view name) {
  return name == "romb" ? "rhombus" : std::string_view();
}

bool isOldRegionCall(const Tree& tree, NodeId call) {
  const bool known = std::find(std::begin(kOperations), std::end(kOperations), tree.text(call)) !=
                     std::end(kOperations);
  if (!known) return false;
  const auto arguments = tree.children(tree.child(call, 0));
  return std::any_of(arguments.begin(), arguments.end(),
                     [&](NodeId a) { return hasText(tree, a); });
}

std::vector<TextEdit> modernRegionCall(const Tree& tree, NodeId call, std::string_view source) {
  const auto arguments = tree.children(tree.child(call, 0));
  const bool named = std::any_of(arguments.begin(), arguments.end(),
                                 [&](NodeId a) { return tree.kind(a) == NodeKind::NamedArg; });
  if (named || arguments.empty()) return {};
  return Rewriter(tree, call, source).run();
}

ModernText withModernRegions(const Tree& tree, std::string_view source) {
  std::vector<TextEdit> edits;
  std::vector<NodeId> calls, left;
  // The author's own rule or function of that name is none of ours.
  std::set<std::string_view> own;
  for (NodeId n = 1; n < tree.size(); ++n) {
    if (tree.kind(n) == NodeKind::Rule || tree.kind(n) == NodeKind::Function) {
      own.insert(tree.text(n));
    }
  }
  for (NodeId n = 1; n < tree.size(); ++n) {
    if (own.count(tree.text(n)) != 0) continue;
    if (tree.kind(n) != NodeKind::Apply && tree.kind(n) != NodeKind::Call) continue;
    if (const std::string_view now = modernOperation(tree.text(n));
        !now.empty() && tree.kind(n) == NodeKind::Apply && tree.child(n, 0) != kNoNode) {
      const Span name = nameSpan(tree, n);
      edits.push_back({name.begin, name.end, std::string(now)});
    }
    if (!isOldRegionCall(tree, n)) continue;
    const std::vector<TextEdit> made = modernRegionCall(tree, n, source);
    edits.insert(edits.end(), made.begin(), made.end());
    calls.push_back(n);
    if (made.empty()) left.push_back(n);
  }
  std::stable_sort(edits.begin(), edits.end(),
                   [](const TextEdit& a, const TextEdit& b) { return a.begin < b.begin; });
  std::string out;
  uint32_t at = 0;
  for (const TextEdit& e : edits) {
    // Calls within the texts of others.
    if (e.begin < at) return {std::string(source), std::move(calls)};
    out += std::string(source.substr(at, e.begin - at)) + e.text;
    at = e.end;
  }
  return {out + std::string(source.substr(at)), std::move(left)};
}

}  // namespace gable::lang
