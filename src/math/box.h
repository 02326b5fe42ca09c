// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Axis-aligned boxes. A new box is empty (min > max) and grows by include().
#pragma once

#include <algorithm>
#include <limits>

#include "math/vec.h"

namespace gable {

struct Box2 {
  Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void include(Vec2 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  bool empty() const { return min.x > max.x || min.y > max.y; }
  /// Points on the border are inside.
  bool contains(Vec2 p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
  }
  /// Boxes that touch meet; an empty one meets none.
  bool meets(const Box2& b) const {
    return min.x <= b.max.x && b.min.x <= max.x && min.y <= b.max.y && b.min.y <= max.y;
  }
  /// Whether they meet in more than their borders.
  bool overlaps(const Box2& b) const {
    return min.x < b.max.x && b.min.x < max.x && min.y < b.max.y && b.min.y < max.y;
  }
  Vec2 size() const { return empty() ? Vec2{} : max - min; }
  Vec2 center() const { return (min + max) * 0.5; }
};

struct Box3 {
  Vec3 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};

  void include(const Vec3& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  void include(const Box3& b) {
    if (b.empty()) return;
    include(b.min);
    include(b.max);
  }
  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  /// Boxes that touch meet, or are no farther apart than `slack` along any axis.
  bool meets(const Box3& b, double slack = 0) const {
    return min.x <= b.max.x + slack && b.min.x <= max.x + slack && min.y <= b.max.y + slack &&
           b.min.y <= max.y + slack && min.z <= b.max.z + slack && b.min.z <= max.z + slack;
  }
  Vec3 size() const { return empty() ? Vec3{} : max - min; }
  Vec3 center() const { return (min + max) * 0.5; }
};

}  // namespace gable
