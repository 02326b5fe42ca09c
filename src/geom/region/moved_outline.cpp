// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Chen and McMains, "Polygon offsetting by computing winding numbers", 2005: with the way back over
// the corner at corners that close, the winding number tells inside from outside.
#include "geom/region/moved_outline.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "math/trig.h"

namespace gable {
namespace {

// Ends of neighbours that are so near each other, in grid units of the caller, need no join.
constexpr double kStraight = 1;

class Corner {
 public:
  Corner(Ring& out, Vec2 at, Vec2 in, Vec2 on, double distance)
      : out_(out),
        at_(at),
        in_(in),
        on_(on),
        d_(distance),
        cos_(dot(in, on)),
        sin_(cross(in, on)) {}

  void join(const OffsetOptions& o) {
    if (std::fabs(sin_ * d_) < kStraight && cos_ > 0) {
      add(in_);
    } else if (sin_ * d_ < 0) {
      add(in_);
      out_.push_back(at_);
      add(on_);
    } else if (o.join == OffsetJoin::Round) {
      round(o.roundError);
    } else if (o.join == OffsetJoin::Miter && 1 + cos_ >= 2 / (o.miterLimit * o.miterLimit)) {
      add((in_ + on_) * (1 / (1 + cos_)));
    } else {
      square();
    }
  }

 private:
  void add(Vec2 direction) { out_.push_back(at_ + direction * d_); }

  // Cut across, at the distance from the corner.
  void square() {
    const double t = std::sqrt((1 - cos_) / 2) / (1 + std::sqrt((1 + cos_) / 2));
    const double turn = d_ < 0 ? -t : t;
    add(in_ + perpendicular(in_) * turn);
    add(on_ - perpendicular(on_) * turn);
  }

  void round(double error) {
    const double r = std::fabs(d_);
    const double angle = std::fabs(atan2Deg(sin_, cos_));
    const double step = 2 * acosDeg(std::max(1 - error / r, 0.0));
    const int steps = std::max(1, static_cast<int>(std::ceil(angle / std::max(step, 0.5))));
    const double turn = (d_ < 0 ? -angle : angle) / steps;
    for (int i = 0; i < steps; ++i) {
      work();
      const double a = turn * i;
      add(in_ * cosDeg(a) + perpendicular(in_) * sinDeg(a));
    }
    add(on_);
  }

  Ring& out_;
  Vec2 at_, in_, on_;
  double d_, cos_, sin_;
};

}  // namespace

Ring movedOutline(const Ring& r, double distance, const OffsetOptions& options) {
  const size_t n = r.size();
  Ring out;
  if (n < 3) return out;
  const auto normal = [&](size_t i) { return -perpendicular(normalized(r[(i + 1) % n] - r[i])); };
  Vec2 in = normal(n - 1);
  for (size_t i = 0; i < n; ++i) {
    work(4);
    const Vec2 on = normal(i);
    Corner(out, r[i], in, on, distance).join(options);
    in = on;
  }
  return out;
}

}  // namespace gable
