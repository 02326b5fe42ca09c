// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/old_regions.h"

#include <algorithm>
#include <set>

#include "base/number.h"
#include "lang/lexer.h"
#include "lang/parser.h"
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

std::string_view trimmed(std::string_view s) {
  const size_t from = s.find_first_not_of(" \t\n");
  if (from == std::string_view::npos) return {};
  return s.substr(from, s.find_last_not_of(" \t\n") - from + 1);
}

bool isWordSign(char c) {
  return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Where `sign` stands outside of brackets, from `at` on; npos if nowhere. A | is not that of ||.
size_t signOutside(std::string_view text, char sign, size_t at) {
  int depth = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (c != sign || depth > 0) continue;
    if (sign != '|' || at + 1 >= text.size() || text[at + 1] != '|') return at;
    ++at;
  }
  return std::string_view::npos;
}

/// One of several figures: with a condition, with a chance, or neither. No figure is "none".
struct FigureChoice {
  std::string condition, chance, figure;
};

/// 30%: romb(3) | circle(2) | none, and case ix == 0: romb(3) | circle(2). Empty when a part cannot
/// be read.
std::vector<FigureChoice> figureChoices(std::string_view text) {
  std::vector<FigureChoice> out;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.size(), signOutside(text, '|', begin));
    std::string_view part = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    FigureChoice one;
    if (const size_t colon = signOutside(part, ':', 0); colon != std::string_view::npos) {
      std::string_view head = trimmed(part.substr(0, colon));
      part = trimmed(part.substr(colon + 1));
      if (head.starts_with("case") && head.size() > 4 && !isWordSign(head[4])) {
        // ix and iy are those of the region.
        for (size_t i = 4; i < head.size();) {
          size_t to = i;
          while (to < head.size() && isWordSign(head[to])) ++to;
          const std::string_view word = head.substr(i, to - i);
          const bool own = word.size() == 2 && (word[0] == 'i' || word[0] == 'n' || word[0] == 'b');
          if (own && (word[1] == 'x' || word[1] == 'y')) one.condition += "region.";
          one.condition += word;
          if (to < head.size()) one.condition += head[to];
          i = to + 1;
        }
        one.condition = trimmed(one.condition);
      } else {
        if (head.ends_with('%')) head.remove_suffix(1);
        one.chance = trimmed(head);
        if (one.chance.empty()) return {};
      }
    }
    if (part != "none") {
      RegionTexts texts;
      texts.keepUnknown();
      one.figure = texts.figure(part);
      if (one.figure.empty()) return {};
    }
    out.push_back(std::move(one));
  }
  return out;
}

/// What stands before each of the figures: "30% : ", "case region.ix == 0 : ", "else : ".
/// Conditions are asked first; the others share what is left, and those without a chance the rest
/// of 100 %. Empty when chances that are expressions leave that open.
std::vector<std::string> headsOf(const std::vector<FigureChoice>& choices) {
  double given = 0;
  size_t open = 0, drawn = 0, expressions = 0;
  for (const FigureChoice& c : choices) {
    if (!c.condition.empty()) continue;
    ++drawn;
    double share = 0;
    if (c.chance.empty()) {
      ++open;
    } else if (parseNumber(c.chance, share)) {
      given += std::max(0.0, share);
    } else {
      ++expressions;
    }
  }
  const bool openIsLast =
      open == 1 && choices.back().chance.empty() && choices.back().condition.empty();
  if (expressions > 0 && !openIsLast) return {};
  if (drawn > 0 && open == 0 && given <= 0) return {};
  std::vector<std::string> out;
  size_t at = 0;
  for (const FigureChoice& c : choices) {
    if (!c.condition.empty()) {
      out.push_back("case " + c.condition + " : ");
      continue;
    }
    double share = 0;
    const bool number = parseNumber(c.chance, share);
    if (++at == drawn) {
      out.emplace_back(choices.size() > 1 ? "else : " : "");
    } else if (!c.chance.empty() && !number) {
      out.push_back(c.chance + "% : ");
    } else {
      double value = c.chance.empty() ? std::max(0.0, 100 - given) / static_cast<double>(open)
                                      : std::max(0.0, share);
      const double sum = open > 0 ? std::max(100.0, given) : given;
      value = value * 100 / sum;
      out.push_back(shortestText(value) + "% : ");
    }
  }
  return out;
}

/// Whether a list of arguments can be read: texts held what nobody wrote into a rule.
bool reads(const std::string& list) {
  const std::string text = "const c = f(" + list + ")";
  Diagnostics unheard;
  const Tokens tokens = tokenize(text, 0, unheard);
  parse(text, 0, tokens, unheard);
  return !unheard.hasErrors();
}

class Rewriter {
 public:
  Rewriter(const Tree& t, NodeId call, std::string_view source)
      : t_(t), call_(call), source_(source), name_(t.text(call)) {
    for (const NodeId a : t.children(t.child(call, 0))) {
      (t.kind(a) == NodeKind::NamedArg ? byName_ : arguments_).push_back(a);
    }
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
    } else if (name_ == "joined") {
      return joined();
    } else {
      return {};
    }
    for (const NodeId a : byName_) {
      ok_ = ok_ && !hasText(t_, t_.child(a, 0));
      named_.push_back(written(a));
    }
    if (!ok_) return {};
    std::string list;
    for (const std::string& p : positional_) list += (list.empty() ? "" : ", ") + p;
    for (const std::string& p : named_) list += (list.empty() ? "" : ", ") + p;
    if (!reads(list + parts_)) return {};
    const Span from = t_.span(arguments_.front()),
               to = t_.span(byName_.empty() ? arguments_.back() : byName_.back());
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
    texts.keepUnknown();
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
      texts.keepUnknown();
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

  // A figure moves to the head of the operations that it is for; those of several figures are
  // written for each.
  void figure(size_t i, std::string_view word) {
    if (!has(i)) return;
    const std::string old = text(i);
    if (isText(i) && (old == "none" || old.empty())) return;
    std::vector<FigureChoice> choices;
    if (!isText(i)) {
      if (written(arguments_[i]) == "0") return;
      choices.push_back({"", "", "circle(" + written(arguments_[i]) + ")"});
    } else {
      choices = figureChoices(old);
    }
    for (const FigureChoice& c : choices) {
      std::string condition = c.condition;
      if (condition.starts_with("case")) condition.erase(0, 4);
      for (const std::string& part : {c.figure, condition, c.chance}) {
        if (!part.empty()) parts_ += ", " + part;
      }
    }
    const std::vector<std::string> heads = headsOf(choices);
    ok_ = ok_ && !heads.empty();
    if (!ok_) return;
    bool found = false, unclear = false;
    NodeId last = kNoNode;
    for (const NodeId block : t_.children(call_).subspan(1)) {
      last = block;
      for (const NodeId item : t_.children(block)) {
        if (t_.kind(item) != NodeKind::Item) continue;
        const NodeId head = t_.child(item, 0), body = t_.child(item, 2);
        // Other heads, as `all`, may mean the figure's place too.
        unclear = unclear || (head != kNoNode && !isPart(t_.text(head)));
        const bool mine = head == kNoNode ? word.empty()
                                          : t_.kind(head) == NodeKind::Name && !word.empty() &&
                                                t_.text(head) == word;
        if (!mine || t_.children(body).empty()) continue;
        // A choice would take the branches that follow it for its own.
        const bool one = choices.size() == 1 && choices[0].condition.empty();
        for (const NodeId s : t_.children(body)) {
          ok_ = ok_ && (one || t_.kind(s) != NodeKind::Choice);
        }
        const uint32_t at = t_.span(body).begin;
        edits_.push_back({at, at, withFigures(choices, heads, written(body))});
        found = true;
      }
    }
    if (found || !ok_) return;
    // A figure that is cut out and given to no one.
    const uint32_t end = last == kNoNode ? 0 : t_.span(last).end;
    ok_ = !unclear && end > 0 && source_[end - 1] == '}';
    if (!ok_) return;
    std::string item = t_.children(last).empty() ? "" : "| ";
    if (!word.empty()) item += std::string(word) + " : ";
    edits_.push_back({end - 1, end - 1, item + withFigures(choices, heads, "NIL") + "NIL "});
  }
  static bool isPart(std::string_view word) {
    static constexpr std::string_view kParts[] = {"region", "path",      "junction",
                                                  "centre", "remainder", "otherwise"};
    return std::find(std::begin(kParts), std::end(kParts), word) != std::end(kParts);
  }
  // What stands before the body when it stands for the last of the figures.
  static std::string withFigures(const std::vector<FigureChoice>& choices,
                                 const std::vector<std::string>& heads, const std::string& body) {
    std::string out;
    for (size_t c = 0; c < choices.size(); ++c) {
      out += heads[c] + choices[c].figure + (choices[c].figure.empty() ? "" : " ");
      if (c + 1 < choices.size()) out += body + " ";
    }
    // Without a figure where no condition holds.
    if (!choices.back().condition.empty()) out += body + " else : ";
    return out;
  }

  // joined("romb(3) rect(8, 2)", free): the figures become parts of a block.
  std::vector<TextEdit> joined() {
    const std::string figures = text(0);
    const bool free = has(1) && !isText(1) && written(arguments_[1]) == "free";
    const bool plainly = byName_.empty() && t_.children(call_).size() == 1;
    if (!plainly || !isText(0) || arguments_.size() > 2 || (has(1) && !free)) return {};
    std::string block;
    for (size_t at = figures.find_first_not_of(" ,|"); at < figures.size();
         at = figures.find_first_not_of(" ,|", at)) {
      const size_t open = figures.find('(', at);
      size_t end = open == std::string::npos ? open : signOutside(figures, ' ', open);
      if (end == std::string::npos) end = figures.rfind(')') + 1;
      // The bracket that closes the figure, with no blank behind it.
      for (size_t i = open, depth = 0; open != std::string::npos && i < end; ++i) {
        depth += figures[i] == '(' ? 1 : 0;
        if (figures[i] == ')' && --depth == 0) end = i + 1;
      }
      if (open == std::string::npos || end <= at) return {};
      RegionTexts texts;
      std::string one = texts.figure(figures.substr(at, end - at));
      if (one.empty() || !reads(one)) return {};
      if (free) one.insert(one.size() - 1, ", free");
      block += (block.empty() ? " { " : " | ") + one + " Part.";
      at = end;
    }
    if (block.empty()) return {};
    const Span all = t_.span(t_.child(call_, 0));
    return {{all.begin, all.end, block + " }"}};
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
    const bool words = std::all_of(name.begin(), name.end(), isWordSign) && !name.empty() &&
                       (name[0] < '0' || name[0] > '9');
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
      texts.keepUnknown();
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
      // What no operation knows keeps its name, for the analysis to report.
      ok_ = ok_ && words && std::all_of(value.begin(), value.end(), isWordSign);
      named_.push_back(name + " = " + (value.empty() ? "true" : value));
    }
  }

  const Tree& t_;
  NodeId call_;
  std::string_view source_;
  std::string_view name_;
  std::vector<NodeId> arguments_, byName_;
  std::vector<std::string> positional_, named_;
  std::vector<TextEdit> edits_;
  std::string radius_;
  // Figures and what chooses among them, behind a comma each.
  std::string parts_;
  bool ok_ = true, gap_ = false;
};

}  // namespace

std::string_view modernOperation(std::string_view name) {
  return name == "romb" ? "rhombus" : std::string_view();
}

std::span<const std::string_view> oldRegionOperations() { return kOperations; }

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
  if (arguments.empty() || tree.kind(arguments[0]) == NodeKind::NamedArg) return {};
  return Rewriter(tree, call, source).run();
}

ModernText withModernRegions(const Tree& tree, std::string_view source) {
  std::vector<TextEdit> edits;
  ModernText out;
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
    // A name alone is a leaf.
    if (const std::string_view now = modernOperation(tree.text(n));
        !now.empty() && tree.kind(n) == NodeKind::Apply &&
        (tree.child(n, 0) != kNoNode || tree.children(n).size() > 1)) {
      const Span name = nameSpan(tree, n);
      edits.push_back({name.begin, name.end, std::string(now)});
    }
    if (!isOldRegionCall(tree, n)) continue;
    const std::vector<TextEdit> made = modernRegionCall(tree, n, source);
    edits.insert(edits.end(), made.begin(), made.end());
    if (made.empty()) out.left.push_back(n);
  }
  std::stable_sort(edits.begin(), edits.end(),
                   [](const TextEdit& a, const TextEdit& b) { return a.begin < b.begin; });
  uint32_t at = 0;
  for (const TextEdit& e : edits) {
    // A call among the arguments of another is written anew with it, as it was.
    out.again = out.again || e.begin < at;
    if (e.begin < at) continue;
    out.text += std::string(source.substr(at, e.begin - at)) + e.text;
    at = e.end;
  }
  out.text += source.substr(at);
  return out;
}

}  // namespace gable::lang
