// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// RoomVolumes: what shapes take up when they ask for room. A volume is the plan of a shape, as
// convex pieces, from its lowest to its highest point: exact for what stands upright, and for
// footprints of any outline. Lengths up to kContactTolerance count as contact, and contact is no
// overlap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/box.h"
#include "shape/shape.h"

namespace gable {

class RoomVolumes {
 public:
  /// The volume number count(): of the faces of a mesh that look up, else of the scope.
  void add(const Shape& s, const Frame& world);
  uint32_t count() const { return static_cast<uint32_t>(volumes_.size()); }
  const Box3& box(uint32_t volume) const { return volumes_[volume].box; }
  /// No number is infinite.
  bool isSound(uint32_t volume) const;

  struct Place {
    const RoomVolumes& volumes;
    uint32_t volume;
  };
  /// Overlap, or are nearer than the clearance. `byHeight`: heights count. Two that are flat in one
  /// direction and lie in one plane are compared in that plane.
  static bool collide(Place a, Place b, double clearance, bool byHeight);

 private:
  struct Volume {
    Box3 box;
    uint32_t firstPiece = 0, endPiece = 0;
  };
  using Piece = std::span<const Vec2>;

  void addPiece(Piece points);
  void addHull(std::vector<Vec2> points);
  bool addFaces(const Mesh& m, bool up, size_t most);
  void addMesh(const Mesh& m);
  Piece piece(uint32_t number) const;

  std::vector<Volume> volumes_;
  /// By piece: where its points end. They run counter-clockwise; two are a line, one is a point.
  std::vector<uint32_t> pieceEnds_;
  std::vector<Vec2> points_;
};

}  // namespace gable
