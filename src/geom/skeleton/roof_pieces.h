// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// RoofPieces: collects pieces of roof faces over shared vertices and joins the pieces of one face.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "geom/skeleton/roof.h"

namespace gable::skeleton {

/// How far slopes end short of their edges: what overhangs below zero ask for.
struct RoofRetreat {
  /// Slopes begin at this height.
  double eaves = 0;
  /// For upright edges (counted through all rings): how far in plan the slopes over them stay away.
  std::map<uint32_t, double> ends;
};

class RoofPieces {
 public:
  /// `polygon` is oriented: outer counter-clockwise, holes clockwise. Its points become the first
  /// vertices, in the order of the rings.
  explicit RoofPieces(const Polygon& polygon);

  const Ring& ring(uint32_t r) const { return r == 0 ? polygon_.outer : polygon_.holes[r - 1]; }
  uint32_t ringCount() const { return static_cast<uint32_t>(polygon_.holes.size() + 1); }
  uint32_t edgeCount() const { return edgeCount_; }
  /// Edges counted through all rings.
  uint32_t edgeNumber(uint32_t ring, uint32_t edge) const { return firstEdge_[ring] + edge; }
  uint32_t ringOf(uint32_t edgeNumber) const;
  uint32_t startOf(uint32_t edgeNumber) const { return edgeNumber; }
  uint32_t endOf(uint32_t edgeNumber) const;

  uint32_t addVertex(const SkeletonVertex& v);
  const SkeletonVertex& vertex(uint32_t v) const { return vertices_[v]; }
  void setHeight(uint32_t v, double h) { vertices_[v].height = h; }
  /// Below this, lengths are rounding.
  double tolerance() const { return tolerance_; }
  size_t vertexCount() const { return vertices_.size(); }

  /// Adds a piece to the slope of an edge; pieces that share edges grow together.
  void addSlopePiece(uint32_t edgeNumber, std::vector<uint32_t> loop);
  void addSide(uint32_t edgeNumber, std::vector<uint32_t> loop);

  /// Joins, cuts the slopes back, gives the edges their roles, evens the ridges out and adds the
  /// bottom.
  Roof finish(bool even, const RoofRetreat& retreat = {});

 private:
  struct Side {
    uint32_t edge = 0;
    std::vector<uint32_t> loop;
  };
  /// A vertex that left its faces, and where it lay between two that stayed.
  struct Dropped {
    uint32_t vertex = 0, before = 0, after = 0;
    double share = 0;
  };
  bool join(uint32_t edgeNumber, std::vector<std::vector<uint32_t>>& loops) const;
  /// Cuts back the slopes of `roof`, which has no other faces yet.
  void cutBack(Roof& roof, const RoofRetreat& retreat) const;
  void assignRoles(Roof& roof) const;
  void evenRidges(Roof& roof) const;
  void dropStraightVertices(Roof& roof);
  void rememberDropped(const Roof& roof, const std::vector<uint32_t>& loop,
                       const std::vector<char>& bent);
  void startAtEaves(Roof& roof) const;
  void addSidesAndBottom(Roof& roof) const;

  const Polygon& polygon_;
  std::vector<uint32_t> firstEdge_;
  uint32_t edgeCount_ = 0;
  double tolerance_ = 0;
  std::vector<SkeletonVertex> vertices_;
  std::vector<std::vector<std::vector<uint32_t>>> slopes_;
  std::vector<Side> sides_;
  std::vector<Dropped> dropped_;
};

/// Newell's normal of a loop in (plan x, plan y, height).
Vec3 loopNormal(const std::vector<SkeletonVertex>& vertices, const std::vector<uint32_t>& loop);

/// A copy with the outer ring counter-clockwise and holes clockwise; `reversed` tells per ring
/// whether it was turned, so that edge numbers can be mapped back.
Polygon orientedCopy(const Polygon& polygon, std::vector<bool>& reversed);
/// Maps the ring and edge numbers of the faces back to the polygon as given.
void restoreEdgeNumbers(Roof& roof, const Polygon& polygon, const std::vector<bool>& reversed);

}  // namespace gable::skeleton
