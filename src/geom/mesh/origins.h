// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Origins: where the corners of a mesh come from, for operations that take a mesh apart and glue
// the parts together again (solid/recompose.h).
//
// For each corner they say where its vertex was at first, its origin; where the shape that it
// belongs to began, its begin; and which shape that is. So `position - begin` is what the shape
// itself moved the vertex by. All are in the axes of the operation's own shape. They lie in
// Mesh::notes: cuts find the origins of new vertices as they find their uv coordinates. Operations
// nest: each has a level of its own, the innermost the last one.
//
// A corner without an origin, as those of inserted models are, has the shape 0.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "geom/mesh/mesh.h"

namespace gable {

/// How many levels of origins a mesh has.
size_t originLevels(const Mesh& m);
/// Adds a level in which each corner begins where it is now, in the axes of the mesh. `shape`: from
/// 1 on, and a whole number.
void noteOrigins(Mesh& m, double shape);
/// Leaves only the outermost levels.
void dropOrigins(Mesh& m, size_t levelsLeft);
/// Whether the innermost level knows any corner.
bool hasOrigins(const Mesh& m);

/// The shape is gone: its faces are no part of the result, but what it moved counts. Innermost
/// level.
void markDeleted(Mesh& m);
bool isDeleted(const Mesh& m);

/// A level of a mesh. The mesh must outlive it.
class Origins {
 public:
  Origins(const Mesh& m, size_t level);
  /// Between a known and an unknown corner the shape is no whole number.
  bool known(uint32_t corner) const {
    return shapes_ && (*shapes_)[corner].x != 0 &&
           std::nearbyint((*shapes_)[corner].x) == (*shapes_)[corner].x;
  }
  Vec3 origin(uint32_t corner) const;
  Vec3 begin(uint32_t corner) const;
  double shape(uint32_t corner) const { return std::fabs((*shapes_)[corner].x); }
  /// The nearest one of the shapes that it came of that was kept; 0 for none.
  double parent(uint32_t corner) const { return (*shapes_)[corner].y; }

 private:
  const std::vector<Vec2>* origins_ = nullptr;
  const std::vector<Vec2>* both_ = nullptr;
  const std::vector<Vec2>* begins_ = nullptr;
  const std::vector<Vec2>* shapes_ = nullptr;
};

/// A shape that ends and others that begin with its geometry, or with parts of it.
class Handover {
 public:
  /// `home` takes the positions of the mesh into the axes of the operation.
  Handover(const Mesh& ending, const Frame& home);
  /// Whether the shape moved any vertex.
  bool moved() const { return moved_; }
  /// The ending shape is kept as a deleted one: those that begin have it as their parent.
  void keep() { kept_ = true; }
  /// The innermost level begins anew where the mesh is now. A vertex that the ending shape made
  /// beside the one that stayed, as extrude does, has its origin there from now on.
  void begin(Mesh& m, const Frame& home, double shape) const;

 private:
  using Key = std::tuple<double, double, double>;
  static Key keyOf(const Vec3& p) { return {p.x, p.y, p.z}; }

  struct Stayed {
    Vec3 at;
    double moved;
  };
  /// By origin: where the vertex is that stayed the most.
  std::map<Key, Stayed> stayed_;
  double slack_ = 0;
  bool moved_ = false;
  bool kept_ = false;
};

}  // namespace gable
