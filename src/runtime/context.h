// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Context queries: which other shapes a shape is inside of, overlaps, touches or lies near.
//
// A first pass of the derivation collects occluders: labelled shapes, shapes before they are split
// into components or offset, and leaves. The second pass asks this index. A shape never meets its
// own ancestors or descendants, and never itself.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geom/mesh/mesh.h"
#include "program/value.h"
#include "runtime/room.h"
#include "shape/services.h"

namespace gable {

struct Occluder {
  uint32_t initialShape = 0;
  PlacePath path;
  /// On what it depends that there is this shape at all.
  RoomCondition condition = kAlways;
  /// 0 for an unlabelled one.
  StringId label = 0;
  /// World coordinates.
  Mesh mesh;
  Frame scope;
  Vec3 size;
};

/// Any number of threads may ask at once.
class OccluderIndex {
 public:
  explicit OccluderIndex(std::vector<Occluder> occluders);
  ~OccluderIndex();

  /// Only closed surfaces occlude. O(log occluders + near triangles^2).
  bool test(ContextTest test, ContextScope scope, StringId label, const Occluder& asking) const;
  /// Between scopes, over shapes with that label; infinity when there is none.
  double minimumDistance(ContextScope scope, StringId label, const Occluder& asking) const;
  size_t count(ContextScope scope, StringId label, const Occluder& asking) const;
  /// How many shapes with that label come before the asking one in an order; equals do not.
  size_t rank(ContextScope scope, StringId label, ContextOrder order, const Occluder& asking) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gable
