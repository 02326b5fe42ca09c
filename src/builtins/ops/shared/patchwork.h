// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Patchwork: faces taken apart in their plane, and polygons put together again from what is left.
// Points are numbered, so that polygons which share points share them in the mesh as well.
#pragma once

#include <span>
#include <vector>

#include "geom/mesh/mesh.h"
#include "geom/region/region.h"

namespace gable {

struct PatchEdge {
  uint32_t from = 0, to = 0;
  uint32_t tags = 0;
  /// Loops begin with their edge of the least order.
  uint32_t order = 0;
};

using PatchLoop = std::vector<PatchEdge>;

/// The outer loop counter-clockwise, then holes clockwise.
struct Patch {
  std::vector<PatchLoop> loops;
};

/// The polygons that directed edges bound, their inside to the left. Edges that run both ways
/// cancel: the outlines of neighbours give the outline of their union. Slivers are dropped.
/// O(n log n), and O(holes * n).
std::vector<Patch> patchesOf(std::vector<PatchEdge> edges, std::span<const Vec2> points);

/// The face that patches are cut from: its plane, and uv coordinates in it (affine).
class PatchPlane {
 public:
  PatchPlane(const Mesh& m, size_t face);

  const Frame& frame() const { return frame_; }
  size_t face() const { return face_; }
  /// The face in the plane: one ring for each loop, in order.
  const Polygon& polygon() const { return polygon_; }
  /// The corner at which edge `edge` of ring `ring` starts.
  uint32_t cornerOf(size_t ring, size_t edge) const;
  Vec2 uvAt(int set, Vec2 p) const;
  /// How u and v change along a direction of the plane.
  Vec2 uvAlong(int set, Vec2 direction) const;

  std::vector<Vec2> points;
  /// The tags of points; those beyond its end have none.
  std::vector<uint32_t> pointTags;
  /// Adds the point that a corner of the face is, with its tags.
  void addCorner(uint32_t corner, Vec2 at);

 private:
  struct Affine {
    Vec2 origin, x, y;
  };
  void fit(int set);

  const Mesh& mesh_;
  size_t face_;
  Frame frame_;
  Polygon polygon_;
  std::vector<Affine> uv_;
};

/// A patch that is to become a face.
struct PatchFace {
  const PatchPlane* plane = nullptr;
  Patch patch;
  uint32_t tags = 0;
  /// The face looks to the other side.
  bool turned = false;
};

/// The faces as a mesh with the attributes of `from`, of which the planes are. Points of one plane
/// are shared by number.
Mesh meshOfPatches(const Mesh& from, std::span<const PatchFace> faces);

}  // namespace gable
