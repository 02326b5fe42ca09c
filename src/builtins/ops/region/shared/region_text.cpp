// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "builtins/ops/region/shared/region_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/number.h"

namespace gable {

void TextReader::skip() {
  while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
}

bool TextReader::atEnd() {
  skip();
  return at_ >= text_.size();
}

char TextReader::peek() {
  skip();
  return at_ < text_.size() ? text_[at_] : '\0';
}

bool TextReader::accept(char c) {
  if (peek() != c) return false;
  ++at_;
  return true;
}

bool TextReader::accept(std::string_view sign) {
  skip();
  if (!text_.substr(at_).starts_with(sign)) return false;
  at_ += sign.size();
  return true;
}

std::string TextReader::word() {
  skip();
  std::string out;
  const auto letter = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_';
  };
  if (at_ >= text_.size() || !letter(text_[at_])) return out;
  while (at_ < text_.size() &&
         (letter(text_[at_]) || std::isdigit(static_cast<unsigned char>(text_[at_])))) {
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_++])));
  }
  return out;
}

bool TextReader::number(double& v) {
  skip();
  const char* begin = text_.data() + at_;
  const char* end = text_.data() + text_.size();
  if (begin == end) return false;
  const char* after = readNumber(begin, end, v);
  if (after == nullptr || after == begin) return false;
  at_ += static_cast<size_t>(after - begin);
  return true;
}

// [a,b], [a-b] or a.
bool TextReader::range(DrawnRange& r) {
  const size_t start = at_;
  if (!accept('[')) {
    if (!number(r.low)) return false;
    r.high = r.low;
    return true;
  }
  if (number(r.low)) {
    r.high = r.low;
    if (accept(']')) return true;
    // A minus may be the sign between, or a sign of the second number: [5-10] reads as 5 and -10.
    if (accept(',')) {
      if (number(r.high) && accept(']')) return true;
    } else if (accept('-')) {
      if (number(r.high) && accept(']')) return true;
    }
  }
  at_ = start;
  return false;
}

namespace {

std::string near(std::string_view text, size_t place) {
  return place < text.size() ? "at '" + std::string(text.substr(place, 12)) + "'" : "at its end";
}

}  // namespace

namespace {

// The sign of an angle: a30, a [-5,5].
bool acceptAngle(TextReader& r, std::string_view text) {
  if (r.peek() != 'a') return false;
  const size_t next = r.place() + 1;
  if (next < text.size() && std::isalpha(static_cast<unsigned char>(text[next]))) return false;
  r.goTo(next);
  return true;
}

}  // namespace

bool readDimension(std::string_view text, GridDim& out, std::string& problem) {
  TextReader r(text);
  double n = 0;
  if (r.number(n)) {
    if (!(n >= 0 && n <= kMostCells)) {
      problem = "a grid cannot have " + shortestText(n) + " cells along one side";
      return false;
    }
    out.count = static_cast<uint32_t>(std::max(1.0, n));
  } else if (r.peek() == '[') {
    DrawnRange counts;
    if (!r.range(counts) || !(counts.low >= 1 && counts.high >= counts.low) ||
        counts.high > kMostCells) {
      problem = "these are no counts " + near(text, r.place());
      return false;
    }
    out.drawnCount = counts;
  }
  // One angle for all lines that have none of their own.
  DrawnRange angle;
  bool turned = false;
  if (acceptAngle(r, text)) {
    if (!r.range(angle)) {
      problem = "an angle is missing " + near(text, r.place());
      return false;
    }
    turned = true;
  }
  if (r.accept('{')) {
    while (!r.accept('}')) {
      GridSize s;
      DrawnRange size;
      const bool sized = r.range(size);
      if (sized) s.size = size;
      if (acceptAngle(r, text)) {
        if (!r.range(s.angle)) {
          problem = "an angle is missing " + near(text, r.place());
          return false;
        }
      } else if (!sized) {
        problem = "a size is missing " + near(text, r.place());
        return false;
      }
      out.sizes.push_back(s);
      if (!r.accept(',') && r.peek() != '}') {
        problem = "'}' is missing " + near(text, r.place());
        return false;
      }
    }
  }
  if (turned && out.sizes.empty()) out.sizes.emplace_back();
  for (GridSize& s : out.sizes) {
    if (turned && s.angle.low == 0 && s.angle.high == 0) s.angle = angle;
  }
  if (r.atEnd()) return true;
  problem = "this is no size of a grid " + near(text, r.place());
  return false;
}

bool readFigure(std::string_view text, PlanFigure& out, std::string& problem) {
  TextReader r(text);
  const std::string name = r.word();
  std::vector<double> v;
  bool closed = true;
  if (r.accept('(')) {
    double x = 0;
    while (r.number(x)) {
      v.push_back(x);
      if (!r.accept(',')) break;
    }
    closed = r.accept(')');
  }
  struct Known {
    std::string_view name;
    PlanShape shape;
    size_t least, most;
  };
  static constexpr Known kKnown[] = {{"romb", PlanShape::Romb, 1, 1},
                                     {"rombcenter", PlanShape::Romb, 1, 1},
                                     {"circle", PlanShape::Circle, 1, 2},
                                     {"square", PlanShape::Square, 1, 1},
                                     {"rect", PlanShape::Rect, 2, 2},
                                     {"polygon", PlanShape::Polygon, 2, 2},
                                     {"regularpolygon", PlanShape::Polygon, 2, 2}};
  for (const Known& k : kKnown) {
    if (k.name != name) continue;
    if (!closed || !r.atEnd() || v.size() < k.least || v.size() > k.most ||
        !std::all_of(v.begin(), v.end(), [](double x) { return x > 0 && std::isfinite(x); })) {
      problem = "'" + name + "' takes " + std::to_string(k.least) + " lengths above zero";
      return false;
    }
    out.shape = k.shape;
    out.a = v[0];
    out.b = v.size() > 1 ? v[1] : v[0];
    if (k.shape == PlanShape::Polygon) {
      out.segments = static_cast<uint32_t>(std::clamp(v[0], 3.0, 1000.0));
      out.a = v[1];
    } else if (k.shape == PlanShape::Circle && v.size() > 1) {
      out.segments = static_cast<uint32_t>(std::clamp(v[1], 3.0, 1000.0));
    }
    return true;
  }
  problem = "'" + std::string(text) + "' is no figure";
  return false;
}

namespace {

struct Option {
  std::string name, value = "1";
  bool bare = true;
};

// False at what is no option; those before it have been read.
bool readOptions(std::string_view text, std::vector<Option>& out) {
  TextReader r(text);
  while (!r.atEnd()) {
    Option o;
    o.name = r.word();
    if (o.name.empty()) return false;
    if (r.accept('=')) {
      o.bare = false;
      o.value.clear();
      r.peek();
      size_t at = r.place(), depth = 0;
      for (; at < text.size(); ++at) {
        const char c = text[at];
        if (depth == 0 && (c == ',' || std::isspace(static_cast<unsigned char>(c)))) break;
        if (c == '(' || c == '[') ++depth;
        if ((c == ')' || c == ']') && depth > 0) --depth;
        o.value += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
      r.goTo(at);
    }
    out.push_back(std::move(o));
    r.accept(',');
  }
  return true;
}

bool isOneOf(std::string_view value, std::string_view words) {
  for (size_t begin = 0; begin <= words.size();) {
    const size_t end = std::min(words.find('|', begin), words.size());
    if (words.substr(begin, end - begin) == value) return true;
    begin = end + 1;
  }
  return false;
}

// Whether one of the known options, divided by blanks, takes this one.
bool isKnown(const Option& o, std::string_view known) {
  for (size_t begin = 0; begin < known.size();) {
    const size_t end = std::min(known.find(' ', begin), known.size());
    const std::string_view item = known.substr(begin, end - begin);
    begin = end + 1;
    const size_t equals = std::min(item.find('='), item.size());
    if (item.substr(0, equals) != o.name) continue;
    if (equals == item.size() || o.bare) return o.bare && equals == item.size();
    const std::string_view takes = item.substr(equals + 1);
    double v = 0;
    if (takes == "*") return !o.value.empty();
    if (takes == "#") return parseNumber(o.value, v) && std::isfinite(v) && v >= 0;
    return isOneOf(o.value, takes);
  }
  return false;
}

}  // namespace

std::string option(std::string_view options, std::string_view name) {
  std::vector<Option> all;
  readOptions(options, all);
  for (const Option& o : all) {
    if (o.name == name) return o.value;
  }
  return {};
}

bool checkOptions(std::string_view options, std::string_view known, std::string& problem) {
  std::vector<Option> all;
  const bool read = readOptions(options, all);
  for (const Option& o : all) {
    if (isKnown(o, known)) continue;
    problem = "'" + o.name + (o.bare ? "" : "=" + o.value) + "' is none of its options";
    return false;
  }
  if (!read) problem = "'" + std::string(options) + "' cannot be read as options";
  return read;
}

bool readPoints(std::string_view text, std::vector<Disc>& out) {
  TextReader r(text);
  const bool named = r.word() == "points";
  if (!named) r.goTo(0);
  const bool bracket = named ? r.accept('(') : r.accept('[');
  if (named && !bracket) return false;
  while (r.accept('(')) {
    Disc d;
    if (!r.number(d.centre.x) || !r.accept(',') || !r.number(d.centre.y)) return false;
    if (r.accept(',') && (!r.number(d.radius) || !(d.radius >= 0))) return false;
    if (!r.accept(')') || !std::isfinite(d.centre.x + d.centre.y + d.radius)) return false;
    out.push_back(d);
    r.accept(',');
  }
  if (bracket && !r.accept(named ? ')' : ']')) return false;
  return r.atEnd() && !out.empty();
}

namespace {

bool rangeOf(TextReader& r, uint32_t logical, std::vector<LogicalRange>& out) {
  LogicalRange range{logical, 0, 0};
  const bool read =
      r.accept('[') && r.number(range.from) && r.accept(',') && r.number(range.to) && r.accept(']');
  if (read) out.push_back(range);
  return read;
}

}  // namespace

bool readRanges(std::string_view text, std::vector<LogicalRange>& out) {
  TextReader r(text);
  uint32_t logical = 0;
  bool any = false;
  while (!r.atEnd()) {
    double v = 0;
    if (r.accept('_')) {
      out.push_back({logical, 0, 1});
    } else if (r.peek() == '[') {
      // Several in a row with no comma are of several edges; {[..],[..]} and [[..],[..]] are of
      // one.
      r.accept('[');
      if (r.peek() == '[') {
        while (!r.accept(']')) {
          if (!rangeOf(r, logical, out)) return false;
          r.accept(',');
        }
      } else if (!r.accept(']')) {
        LogicalRange range{logical, 0, 0};
        if (!r.number(range.from) || !r.accept(',') || !r.number(range.to) || !r.accept(']')) {
          return false;
        }
        out.push_back(range);
      }
    } else if (r.accept('{')) {
      while (!r.accept('}')) {
        if (!rangeOf(r, logical, out)) return false;
        r.accept(',');
      }
    } else if (!r.number(v) || v != 0) {
      return false;
    }
    any = true;
    ++logical;
    r.accept(',');
  }
  return any;
}

}  // namespace gable
