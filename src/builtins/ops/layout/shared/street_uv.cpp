// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A corner of a kerb lies as far along the street as the point of the centre line that is nearest
// to it. Where the line bends, the kerb on the inner side is as near to both of its stretches:
// there the corners on the line's bisector lie as far along as the bend itself.
#include "builtins/ops/layout/shared/street_uv.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "math/box.h"

namespace gable {

namespace {

// A corner lies on a bisector when its direction differs from it by less than this.
constexpr double kOnBisector = 1e-3;

class CentreLine {
 public:
  CentreLine(const Line& line, double width) : path_(line), width_(width) {
    const Line& points = path_.points();
    for (size_t i = 0; i < points.size(); ++i) {
      if (i > 0) length_ += length(points[i] - points[i - 1]);
      lengths_.push_back(length_);
    }
  }

  /// Metres along the line, and across it from the right kerb.
  Vec2 at(Vec2 p) const {
    const double s = path_.nearest(p);
    const Path::Place foot = path_.at(s);
    Vec2 place{s, cross(foot.tangent, p - foot.point)};
    place.y = std::copysign(length(p - foot.point), place.y) + width_ / 2;
    const Line& points = path_.points();
    double nearest = width_;
    work(points.size());
    for (size_t i = 1; i + 1 < points.size(); ++i) {
      const Vec2 away = p - points[i];
      const double distance = length(away);
      if (distance >= nearest) continue;
      const Vec2 tangent =
          normalized(normalized(points[i] - points[i - 1]) + normalized(points[i + 1] - points[i]));
      if (std::fabs(dot(away, tangent)) > kOnBisector * distance) continue;
      nearest = distance;
      place.x = lengths_[i];
    }
    return place;
  }

 private:
  Path path_;
  double width_, length_ = 0;
  std::vector<double> lengths_;
};

template <class Visit>
void forCorners(const Polygon& p, const Visit& visit) {
  for (const Vec2 c : p.outer) visit(c);
  for (const Ring& hole : p.holes) {
    for (const Vec2 c : hole) visit(c);
  }
}

}  // namespace

std::vector<StreetUvs> roadwayUvs(const Polygon& roadway, const Line& centre, double width) {
  const CentreLine line(centre, width);
  std::vector<Vec2> places;
  double first = HUGE_VAL, last = -HUGE_VAL;
  forCorners(roadway, [&](Vec2 p) {
    places.push_back(line.at(p));
    first = std::min(first, places.back().x);
    last = std::max(last, places.back().x);
  });
  std::vector<StreetUvs> out;
  const double whole = last > first ? last - first : 1;
  for (const Vec2 p : places) {
    out.push_back(StreetUvs{Vec2{(p.x - first) / whole, p.y / width}, Vec2{p.x - first, p.y},
                            Vec2{last - p.x, p.y}});
  }
  return out;
}

std::vector<StreetUvs> junctionUvs(const Polygon& junction) {
  const Box2 box = bounds(junction);
  const Vec2 size = box.max - box.min;
  std::vector<StreetUvs> out;
  forCorners(junction, [&](Vec2 p) {
    work();
    out.push_back(StreetUvs{Vec2{size.x > 0 ? (p.x - box.min.x) / size.x : 0,
                                 size.y > 0 ? (p.y - box.min.y) / size.y : 0}});
  });
  return out;
}

}  // namespace gable
