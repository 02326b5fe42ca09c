// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each side is the line moved: on the outer side of a turn the corner is mitred, or cut where it
// would reach far; on the inner side the outline goes by the corner of the line itself, so that
// what runs back there goes round the other way and is not filled.
#include "city/ribbon.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/curve/curve.h"
#include "math/trig.h"

namespace gable {
namespace {

// A mitre reaches at most so many times the distance.
constexpr double kMostMitre = 2;
// Of the cosine: turns of less than 25 degrees are followed by a single point on both sides.
constexpr double kGentle = 0.9;

// The right side of a line, in its direction.
void addRightSide(const std::vector<Vec2>& line, double distance, Ring& out) {
  const size_t last = line.size() - 1;
  const auto right = [&](size_t segment) {
    const Vec2 d = normalized(line[segment + 1] - line[segment]);
    return Vec2{d.y, -d.x} * distance;
  };
  out.push_back(line[0] + right(0));
  for (size_t i = 1; i < last; ++i) {
    work();
    const Vec2 a = right(i - 1), b = right(i);
    const double square = std::max(distance * distance, 1e-12);
    const double cosine = dot(a, b) / square;
    const double reach = 2 / std::max(1 + cosine, 1e-9);
    // Turning left, the right side is the outer one.
    const bool outer = cross(a, b) > 0;
    const double room = std::min(length(line[i] - line[i - 1]), length(line[i + 1] - line[i]));
    if ((outer && reach <= kMostMitre * kMostMitre) || (cosine > kGentle && room > distance)) {
      out.push_back(line[i] + (a + b) * (0.5 * reach));
    } else {
      out.push_back(line[i] + a);
      if (!outer) out.push_back(line[i]);
      out.push_back(line[i] + b);
    }
  }
  out.push_back(line[last] + right(last - 1));
}

}  // namespace

Ring ribbonAlong(const std::vector<Vec2>& line, double left, double right, double more) {
  std::vector<Vec2> middle = line;
  if (more > 0) {
    const size_t last = middle.size() - 1;
    const Vec2 back = normalized(line[0] - line[1]), on = normalized(line[last] - line[last - 1]);
    middle[0] = middle[0] + back * more;
    middle[last] = middle[last] + on * more;
  }
  Ring out;
  addRightSide(middle, right, out);
  std::reverse(middle.begin(), middle.end());
  addRightSide(middle, left, out);
  return out;
}

Ring discAround(Vec2 middle, double radius) {
  constexpr int kSides = 16;
  Ring out;
  for (int k = 0; k < kSides; ++k) {
    const double angle = (k + 0.5) * 360 / kSides;
    out.push_back(middle + Vec2{cosDeg(angle), sinDeg(angle)} * radius);
  }
  return out;
}

std::vector<Vec2> linePart(const std::vector<Vec2>& line, double from, double to) {
  const Path path(line);
  std::vector<Vec2> out{path.at(from).point};
  double sum = 0;
  for (size_t i = 1; i < path.points().size(); ++i) {
    work();
    sum += length(path.points()[i] - path.points()[i - 1]);
    if (sum > from + 1e-3 && sum < to - 1e-3) out.push_back(path.points()[i]);
  }
  out.push_back(path.at(to).point);
  return out;
}

double lineLength(const std::vector<Vec2>& line) { return Path(line).length(); }

}  // namespace gable
