// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "builtins/ops/region/shared/plan_text.h"

#include <algorithm>
#include <cmath>

#include "builtins/ops/region/shared/region_text.h"

namespace gable {

namespace {

enum class Known : uint8_t { Ix, Iy, Nx, Ny, Bx, By };
constexpr std::string_view kKnown[] = {"ix", "iy", "nx", "ny", "bx", "by"};
// Longer signs before those that they begin with.
constexpr std::string_view kSigns[] = {"==", "!=", "<=", ">=", "<", ">"};

struct Comparison {
  Known what;
  size_t sign;
  double with;

  bool holds(uint32_t ix, uint32_t iy, uint32_t nx, uint32_t ny) const {
    const uint32_t all[] = {ix, iy, nx, ny, std::min(ix, nx - 1 - ix), std::min(iy, ny - 1 - iy)};
    const double v = all[static_cast<size_t>(what)];
    switch (sign) {
      case 0: return v == with;
      case 1: return v != with;
      case 2: return v <= with;
      case 3: return v >= with;
      case 4: return v < with;
      default: return v > with;
    }
  }
};

bool readComparison(TextReader& r, Comparison& out) {
  const std::string name = r.word();
  const auto* found = std::find(std::begin(kKnown), std::end(kKnown), name);
  if (found == std::end(kKnown)) return false;
  out.what = static_cast<Known>(found - std::begin(kKnown));
  for (out.sign = 0; out.sign < std::size(kSigns); ++out.sign) {
    if (r.accept(kSigns[out.sign])) return r.number(out.with);
  }
  return false;
}

using All = std::vector<Comparison>;

bool readCondition(TextReader& r, std::vector<All>& out) {
  out.emplace_back();
  for (;;) {
    // Brackets around single comparisons are what people write.
    const bool bracket = r.accept('(');
    Comparison c;
    if (!readComparison(r, c) || (bracket && !r.accept(')'))) return false;
    out.back().push_back(c);
    if (r.accept("||")) {
      out.emplace_back();
    } else if (!r.accept("&&")) {
      return true;
    }
  }
}

// The text is divided at | outside of brackets, but for the || of conditions.
std::vector<std::string_view> alternatives(std::string_view text) {
  std::vector<std::string_view> out;
  size_t start = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '|') continue;
    if (i + 1 < text.size() && text[i + 1] == '|') {
      ++i;
      continue;
    }
    out.push_back(text.substr(start, i - start));
    start = i + 1;
  }
  out.push_back(text.substr(start));
  return out;
}

}  // namespace

bool readJunctions(std::string_view text, std::vector<JunctionChoice>& out, std::string& problem) {
  double given = 0, open = 0;
  for (std::string_view part : alternatives(text)) {
    JunctionChoice choice;
    choice.weight = -1;
    TextReader r(part);
    double share = 0;
    const size_t start = r.place();
    if (r.word() == "case") {
      std::vector<All> any;
      if (!readCondition(r, any) || !r.accept(':')) {
        problem = "'" + std::string(part) + "' has no condition that can be read";
        return false;
      }
      choice.where = [any](uint32_t ix, uint32_t iy, uint32_t nx, uint32_t ny) {
        return std::any_of(any.begin(), any.end(), [&](const All& all) {
          return std::all_of(all.begin(), all.end(),
                             [&](const Comparison& c) { return c.holds(ix, iy, nx, ny); });
        });
      };
    } else {
      r.goTo(start);
      if (r.number(share)) {
        r.accept('%');
        if (!r.accept(':')) {
          problem = "':' is missing in '" + std::string(part) + "'";
          return false;
        }
        choice.weight = std::max(0.0, share);
      }
    }
    TextReader figure(part.substr(r.place()));
    const bool none = figure.word() == "none" && figure.atEnd();
    if (!none && !readFigure(part.substr(r.place()), choice.figure, problem)) return false;
    if (!choice.where && choice.weight >= 0) given += choice.weight;
    if (!choice.where && choice.weight < 0) open += 1;
    out.push_back(std::move(choice));
  }
  for (JunctionChoice& c : out) {
    if (c.weight < 0) c.weight = std::max(0.0, 100 - given) / std::max(1.0, open);
  }
  return true;
}

bool readSmoothing(std::string_view text, Smoothing& s) {
  TextReader r(text);
  const std::string name = r.word();
  double a = 0, b = 0;
  const bool open = r.accept('(');
  const bool hasA = open && r.number(a);
  const bool hasB = hasA && r.accept(',') && r.number(b);
  if ((open && !r.accept(')')) || !r.atEnd()) return false;
  if (name.empty() || name == "none") {
    s.kind = Smoothing::Kind::None;
  } else if (name == "average" || name == "chaikin") {
    s.kind = name == "average" ? Smoothing::Kind::Average : Smoothing::Kind::Chaikin;
    if (hasA) s.times = static_cast<uint32_t>(std::clamp(a, 0.0, 6.0));
    if (hasB) s.weight = std::clamp(b, 0.0, 1.0);
  } else if (name == "bezier") {
    s.kind = Smoothing::Kind::Bezier;
  } else if (name == "round") {
    s.kind = Smoothing::Kind::Round;
    s.radius = hasA ? std::max(0.0, a) : 1;
  } else {
    return false;
  }
  return std::isfinite(s.radius);
}

}  // namespace gable
