// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/region_texts.h"

#include <algorithm>
#include <cctype>

#include "base/number.h"
#include "base/text.h"

namespace gable::lang {

namespace {

// How tightly the language binds what has been written.
enum Level { kOr, kAnd, kMinus, kAtom };

struct Piece {
  std::string text;
  Level level = kAtom;
};

std::string within(const Piece& p, Level least) {
  return p.level < least ? "(" + p.text + ")" : p.text;
}

bool isBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

const char* sideNamed(std::string_view w) {
  if (w == "w" || w == "west") return "west";
  if (w == "n" || w == "north") return "north";
  if (w == "e" || w == "east") return "east";
  if (w == "s" || w == "south") return "south";
  return nullptr;
}

// Words that stand for themselves or for another word.
struct Word {
  std::string_view old;
  const char* now;
};
constexpr Word kWords[] = {{"all", "all"},
                           {"outer", "outer"},
                           {"outer_edge", "outer"},
                           {"outeredgesselection", "outer"},
                           {"inner", "inner"},
                           {"border", "border"},
                           {"pathside", "pathSide"},
                           {"centreside", "centreSide"},
                           {"centerside", "centreSide"},
                           {"holeside", "holeSide"},
                           {"cut", "cut"},
                           {"corners", "corners"},
                           {"longest", "longest"},
                           {"shortest", "shortest"},
                           {"peeled_base", "peeledBase"},
                           {"pb", "peeledBase"},
                           {"peeled_inner", "peeledInner"},
                           {"pi", "peeledInner"},
                           {"peeled_segment", "peeledSegment"},
                           {"ps", "peeledSegment"}};

}  // namespace

class RegionReader {
 public:
  RegionReader(RegionTexts& owner, std::string_view text) : o_(owner), text_(text) {}

  bool ok() const { return o_.problem_.empty(); }
  std::string finish(std::string out) {
    if (ok() && !atEnd()) fail("this was not expected");
    return ok() ? std::move(out) : std::string();
  }

  // --- Signs ---
  bool atEnd() {
    skip();
    return at_ >= text_.size();
  }
  char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  bool accept(std::string_view sign) {
    skip();
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }
  void need(char c) {
    if (!accept(c)) fail(std::string("'") + c + "' is missing");
  }
  void fail(std::string what) {
    if (!ok()) return;
    std::string place = " at the end";
    if (at_ < text_.size()) place = " at '" + std::string(text_.substr(at_, 12)) + "'";
    // The whole text stands in the message already.
    if (at_ == 0) place.clear();
    o_.problem_ = std::move(what) + place;
  }
  std::string word() {
    skip();
    const size_t begin = at_;
    if (at_ < text_.size() && isLetter(text_[at_])) {
      while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]))) ++at_;
    }
    return lowerCase(text_.substr(begin, at_ - begin));
  }
  size_t place() const { return at_; }
  void goTo(size_t place) { at_ = place; }

  // An expression up to one of the signs outside of brackets.
  std::string_view raw(std::string_view stops) {
    skip();
    const size_t begin = at_;
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (depth == 0 && stops.find(c) != std::string_view::npos && isStop(c, begin)) break;
      if (c == '(' || c == '[' || c == '{') ++depth;
      if (c == ')' || c == ']' || c == '}') --depth;
    }
    std::string_view out = text_.substr(begin, at_ - begin);
    while (!out.empty() && isBlank(out.back())) out.remove_suffix(1);
    return out;
  }
  // A sign at the beginning belongs to the number; the sign of an angle is no part of a name.
  bool isStop(char c, size_t begin) const {
    if (c == '-') return at_ > begin;
    if (c != 'a') return true;
    const bool nameBefore = at_ > begin && isLetter(text_[at_ - 1]);
    return !nameBefore && (at_ + 1 >= text_.size() || !isLetter(text_[at_ + 1]));
  }
  std::string number(std::string_view stops) {
    const std::string_view e = raw(stops);
    if (e.empty()) {
      fail("a number is missing");
      return "0";
    }
    return o_.number_ ? o_.number_(e) : std::string(e);
  }
  // A number that ends at a blank too.
  std::string plainNumber() { return number(" \t\n,;{}[]()|&"); }

  // [a,b], [a-b], [a] or a.
  std::string range() {
    if (!accept('[')) return plainNumber();
    const std::string low = number(",]-");
    if (accept(']')) return low;
    if (!accept(',')) need('-');
    const std::string high = number("]");
    need(']');
    return "rand(" + low + ", " + high + ")";
  }

  // --- Selections ---
  Piece either() {
    Piece p = difference();
    while (ok() && (accept("||") || accept('|'))) {
      p = {p.text + " || " + difference().text, kOr};
    }
    return p;
  }
  Piece difference() {
    Piece p = both();
    while (ok() && accept('-')) {
      const Piece right = both();
      p = {within(p, kMinus) + " - " + within(right, kAtom), kMinus};
    }
    return p;
  }
  Piece both() {
    Piece p = unary();
    while (ok() && (accept("&&") || accept('&'))) {
      const Piece right = unary();
      p = {within(p, kAnd) + " && " + within(right, kAnd), kAnd};
    }
    return p;
  }
  Piece unary() {
    constexpr int kDeepest = 200;
    if (++depth_ > kDeepest) {
      fail("there are too many brackets");
      return {};
    }
    Piece p;
    if (accept('!')) {
      p = {"!" + within(unary(), kAtom), kAtom};
    } else if (accept('(')) {
      p = either();
      need(')');
    } else {
      p = atom();
    }
    --depth_;
    return p;
  }

  Piece brackets() {
    Piece p;
    do {
      const std::string a = number(",]");
      std::string one = "edge(" + a + ")";
      if (accept(',')) one = "range(" + a + ", " + number("]") + ")";
      need(']');
      p = p.text.empty() ? Piece{one, kAtom} : Piece{p.text + " || " + one, kOr};
    } while (ok() && accept('['));
    return p;
  }

  Piece atom() {
    if (accept('[')) return brackets();
    const char first = peek();
    if (isDigit(first) || first == '.' || first == '-' || first == '+') {
      return {"edge(" + number(" \t\n,;{}[]()|&-") + ")", kAtom};
    }
    const size_t begin = at_;
    const std::string w = word();
    if (const char* side = sideNamed(w)) return {std::string("side(") + side + ")", kAtom};
    for (const Word& known : kWords) {
      if (known.old != w) continue;
      const std::string of = level(w);
      if (of == "strict") return {"strictOuter", kAtom};
      return {known.now + of, kAtom};
    }
    if (w == "len") {
      const bool more = accept('>');
      if (!more) need('<');
      return {std::string(more ? "longer(" : "shorter(") + plainNumber() + ")", kAtom};
    }
    if (peek() != '(') return unknown(w, begin);
    return call(w, begin);
  }

  // pi(1), outer(0), outer(strict).
  std::string level(const std::string& w) {
    if (peek() != '(') return {};
    const bool takes = w.starts_with("outer") || w.starts_with("p") || w == "corners";
    if (!takes || w == "pathside") return {};
    const size_t before = at_;
    accept('(');
    const size_t open = at_;
    if (w == "outer" && word() == "strict" && accept(')')) return "strict";
    at_ = open;
    const std::string inside = number(")");
    need(')');
    if (w == "corners") {
      at_ = before;
      return {};
    }
    return "(" + inside + ")";
  }

  // A word as it is written, with the arguments behind it.
  std::string asWritten(size_t begin) {
    skipTo(begin);
    std::string out;
    while (at_ < text_.size() && (isLetter(text_[at_]) || isDigit(text_[at_]))) out += text_[at_++];
    if (!accept('(')) return out;
    out += "(" + std::string(raw(")"));
    need(')');
    return out + ")";
  }
  Piece unknown(const std::string& w, size_t begin) {
    if (o_.keepUnknown_ && !w.empty()) return {asWritten(begin), kAtom};
    at_ = begin;
    if (ok()) o_.word_ = w;
    fail("no edges have this name");
    return {};
  }

  std::string direction() {
    const size_t begin = at_;
    std::string w = word();
    const bool world = w == "world" && accept('.');
    if (world) w = word();
    if (const char* side = sideNamed(w)) return (world ? "world." : "") + std::string(side);
    at_ = begin;
    return number(",;)");
  }

  Piece call(const std::string& w, size_t begin) {
    accept('(');
    std::string out;
    if (w == "side") {
      const std::string name = word();
      const char* side = sideNamed(name);
      if (!side && o_.keepUnknown_ && !name.empty()) return unknown(w, begin);
      if (!side && ok()) o_.word_ = name;
      if (!side) fail("side takes W, N, E or S");
      out = std::string("side(") + (side ? side : "west");
    } else if (w == "touches") {
      out = "touches(" + either().text;
    } else if (w == "facing") {
      out = "facing(" + direction();
    } else if (w == "grow") {
      out = "grow(" + direction();
      while (ok() && accept(',')) out += " || " + direction();
      if (accept(';')) out += ", " + number(")");
    } else if (w == "angle" || w == "sector" || w == "index" || w == "nth" || w == "random") {
      out = w + "(" + number(",)");
      while (ok() && accept(',')) out += ", " + number(",)");
    } else {
      return unknown(w, begin);
    }
    need(')');
    return {out + ")", kAtom};
  }

  // --- Lines ---
  void add(std::string& out, const std::string& one) { out += (out.empty() ? "" : " || ") + one; }
  void rangeOf(int edge, std::string& out) {
    need('[');
    const std::string a = number(",]");
    need(',');
    const std::string b = number("]");
    need(']');
    add(out, "edge(" + std::to_string(edge) + ", " + a + ", " + b + ")");
  }
  // An entry for each logical edge; false when the text is no such list.
  bool ranges(std::string& out) {
    bool any = false;
    for (int edge = 0; !atEnd() && ok(); ++edge) {
      const char c = peek();
      if (c == '_') {
        accept('_');
        add(out, "edge(" + std::to_string(edge) + ")");
      } else if (c == '[' || c == '{') {
        entry(edge, out);
      } else if (c == '0') {
        if (number(" \t\n,;{}[]()|&") != "0") return false;
      } else {
        return false;
      }
      any = true;
      accept(',');
    }
    return any && ok();
  }
  void entry(int edge, std::string& out) {
    const size_t before = at_;
    const bool braces = accept('{');
    if (!braces) accept('[');
    if (accept(braces ? '}' : ']')) return;
    if (!braces && peek() != '[') {
      at_ = before;
      return rangeOf(edge, out);
    }
    while (ok() && !accept(braces ? '}' : ']')) {
      rangeOf(edge, out);
      accept(',');
    }
  }

  // (x, y) or (x, y, r), one after the other: a call of each.
  std::string points(const std::string& call) {
    std::string out;
    while (ok() && accept('(')) {
      std::string one = call + "(" + number(",)");
      while (ok() && accept(',')) one += ", " + number(",)");
      need(')');
      add(out, one + ")");
      accept(',');
    }
    return out;
  }

 private:
  void skipTo(size_t place) {
    at_ = place;
    skip();
  }
  void skip() {
    while (at_ < text_.size() && isBlank(text_[at_])) ++at_;
  }
  RegionTexts& o_;
  std::string_view text_;
  size_t at_ = 0;
  int depth_ = 0;
};

const std::vector<std::string_view>& RegionTexts::words() {
  static const std::vector<std::string_view> all = [] {
    std::vector<std::string_view> out{"W",       "N",      "E",      "S",      "side",
                                      "touches", "facing", "grow",   "sector", "angle",
                                      "index",   "nth",    "random", "len"};
    for (const Word& w : kWords) out.push_back(w.old);
    return out;
  }();
  return all;
}

std::string RegionTexts::selection(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  std::string out = r.either().text;
  return r.finish(std::move(out));
}

std::string RegionTexts::lines(std::string_view text) {
  std::string out;
  for (size_t begin = 0; begin <= text.size();) {
    size_t end = begin;
    for (int depth = 0; end < text.size() && (depth > 0 || text[end] != ';'); ++end) {
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    }
    const std::string_view part = text.substr(begin, end - begin);
    begin = end + 1;
    problem_.clear();
    RegionReader ranges(*this, part);
    std::string one;
    if (ranges.ranges(one)) {
      // Nothing of every edge.
      if (one.empty()) one = "edge(0) - edge(0)";
    } else {
      const bool blank = part.find_first_not_of(" \t\n") == std::string_view::npos;
      one = blank ? "all" : selection(part);
      if (one.empty()) return {};
    }
    out += (out.empty() ? "" : " || ") + one;
  }
  problem_.clear();
  return out;
}

std::string RegionTexts::places(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  if (r.peek() == '(') return r.finish(r.points("at"));
  const std::string w = r.word();
  if (w == "centre" || w == "center") return r.finish("centre");
  if (w == "centroid") return r.finish("centroid");
  if (w == "corners") {
    if (r.accept('(')) {
      r.word();
      r.need(')');
    }
    return r.finish("corners");
  }
  if (w == "points") {
    r.need('(');
    std::string out = r.points("point");
    r.need(')');
    return r.finish(std::move(out));
  }
  if (w == "corner" && r.accept('(')) {
    const std::string inside(r.raw(")"));
    r.need(')');
    if (!r.finish("x").empty()) {
      double n = 0;
      if (parseNumber(inside, n)) return "corner(" + inside + ")";
      const std::string edges = selection(inside);
      return edges.empty() ? edges : "corner(" + edges + ")";
    }
    return {};
  }
  if (keepUnknown_ && !w.empty()) return r.finish(r.asWritten(0));
  word_ = w;
  problem_ = "this is no place of a region";
  return {};
}

std::string RegionTexts::drawn(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  std::string out = r.peek() == '[' ? r.range() : r.number(";");
  return r.finish(std::move(out));
}

RegionTexts::Sites RegionTexts::sites(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  Sites out;
  const size_t begin = r.place();
  if (r.word() == "points") {
    r.need('(');
    out.sites = r.points("point");
    r.need(')');
  } else {
    r.goTo(begin);
    const bool bracket = r.accept('[');
    if (r.peek() == '(') {
      out.sites = r.points("point");
      if (bracket) r.need(']');
    } else {
      out.sites = r.number("{]");
      if (r.accept('{')) {
        out.radius = r.range();
        r.need('}');
      }
    }
  }
  if (r.finish("x").empty()) out = {};
  return out;
}

std::string RegionTexts::targets(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  const size_t begin = r.place();
  const std::string w = r.word();
  if (w == "corners") {
    if (r.accept('(')) {
      r.raw(")");
      r.need(')');
    }
    return r.finish("corners");
  }
  if ((w == "directions" || w == "entrances") && r.accept('(')) {
    const bool bracket = r.accept('[');
    std::string out;
    while (r.ok() && r.peek() != ')' && r.peek() != ']' && !r.atEnd()) {
      r.add(out, (w == "directions" ? "direction(" : "entrance(") + r.number(" ,)]") + ")");
      r.accept(',');
    }
    if (bracket) r.need(']');
    r.need(')');
    return r.finish(std::move(out));
  }
  if (w == "points") {
    r.need('(');
    std::string out = r.points("point");
    r.need(')');
    return r.finish(std::move(out));
  }
  r.goTo(begin);
  if (r.peek() == '(') return r.finish(r.points("point"));
  return r.finish(r.number(";"));
}

std::string RegionTexts::figure(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  const std::string name = r.word();
  const char* now = name == "rombcenter" || name == "romb"          ? "rhombus"
                    : name == "polygon" || name == "regularpolygon" ? "regularPolygon"
                    : name == "circle"                              ? "circle"
                    : name == "square"                              ? "square"
                    : name == "rect"                                ? "rect"
                                                                    : nullptr;
  if (!now && keepUnknown_ && !name.empty() && r.peek() == '(') return r.finish(r.asWritten(0));
  if (!now) {
    word_ = name;
    problem_ = "'" + std::string(text) + "' is no figure";
    return {};
  }
  r.need('(');
  std::string out = std::string(now) + "(" + r.number(",)");
  while (r.ok() && r.accept(',')) out += ", " + r.number(",)");
  r.need(')');
  return r.finish(out + ")");
}

std::string RegionTexts::smoothing(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  // So many averages.
  if (isDigit(r.peek())) return r.finish(r.number(";"));
  const std::string name = r.word();
  const bool known = name == "none" || name == "average" || name == "chaikin" || name == "bezier" ||
                     name == "round";
  if (!known && keepUnknown_ && !name.empty()) return r.finish(r.asWritten(0));
  if (!known) {
    word_ = name;
    problem_ = "there is no such smoothing";
    return {};
  }
  std::string out = name;
  if (r.accept('(')) {
    out += "(" + r.number(",)");
    while (r.ok() && r.accept(',')) out += ", " + r.number(",)");
    r.need(')');
    out += ")";
  }
  return r.finish(std::move(out));
}

std::string RegionTexts::profile(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  if (r.peek() != '(') return r.finish(r.word());
  std::string out;
  while (r.ok() && r.accept('(')) {
    out += (out.empty() ? "[" : "; ") + r.number(",");
    r.need(',');
    out += ", " + r.number(")");
    r.need(')');
    r.accept(',');
  }
  return r.finish(out + "]");
}

RegionTexts::Dimension RegionTexts::dimension(std::string_view text) {
  problem_.clear();
  RegionReader r(*this, text);
  Dimension out;
  const auto angleHere = [&] {
    if (r.peek() != 'a') return false;
    const size_t next = r.place() + 1;
    if (next < text.size() && isLetter(text[next])) return false;
    r.goTo(next);
    return true;
  };
  if (r.peek() == '[') {
    out.count = r.range();
  } else if (r.peek() != '{' && r.peek() != 'a' && !r.atEnd()) {
    out.count = r.number("{a[");
  }
  std::string angle;
  if (angleHere()) angle = r.range();
  std::vector<std::string> sizes, angles;
  bool turned = false;
  if (r.accept('{')) {
    while (r.ok() && !r.accept('}')) {
      sizes.emplace_back();
      angles.emplace_back();
      if (!angleHere()) {
        sizes.back() = r.peek() == '[' ? r.range() : r.number(",}a");
        if (angleHere()) angles.back() = r.range();
      } else {
        angles.back() = r.range();
      }
      turned = turned || !angles.back().empty();
      if (!r.accept(',') && r.peek() != '}') r.need('}');
    }
  }
  const auto unsized = static_cast<size_t>(std::count(sizes.begin(), sizes.end(), std::string()));
  if (unsized > 0 && unsized < sizes.size()) r.fail("a size is missing");
  const auto listed = [](const std::vector<std::string>& all, const std::string& otherwise) {
    if (all.size() == 1) return all[0].empty() ? otherwise : all[0];
    std::string list;
    for (const std::string& s : all) {
      list += (list.empty() ? "[" : ", ") + (s.empty() ? otherwise : s);
    }
    return list + "]";
  };
  if (!sizes.empty() && unsized == 0) out.sizes = listed(sizes, "0");
  if (turned) {
    out.angles = listed(angles, angle.empty() ? "0" : angle);
  } else {
    out.angles = angle;
  }
  out.read = !r.finish("x").empty();
  return out;
}

std::vector<std::pair<std::string, std::string>> RegionTexts::options(std::string_view text) {
  std::vector<std::pair<std::string, std::string>> out;
  for (size_t at = 0; at < text.size();) {
    if (isBlank(text[at]) || text[at] == ',') {
      ++at;
      continue;
    }
    const size_t begin = at;
    int depth = 0;
    for (; at < text.size(); ++at) {
      const char c = text[at];
      if (depth == 0 && (c == ',' || isBlank(c))) break;
      depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    }
    const std::string_view one = text.substr(begin, at - begin);
    const size_t equals = one.find('=');
    if (equals == std::string_view::npos) {
      out.emplace_back(lowerCase(one), std::string());
    } else {
      out.emplace_back(lowerCase(one.substr(0, equals)), std::string(one.substr(equals + 1)));
    }
  }
  return out;
}

}  // namespace gable::lang
