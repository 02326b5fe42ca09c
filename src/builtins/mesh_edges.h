// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The edges of a mesh and who meets at them, in the order in which rules count edges.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

/// An edge as its first face runs along it: from `corner` to the corner after it.
struct MeshEdge {
  static constexpr uint32_t kNone = 0xffffffff;
  uint32_t corner = kNone;
  /// A corner of the second face at the edge; kNone at a border.
  uint32_t other = kNone;
  /// How often faces run along it; more than 2 where a mesh is no surface.
  uint32_t uses = 0;
};

class MeshEdges {
 public:
  /// Edge 0 is the first edge of the first face; edges met before are not counted again.
  /// O(n log n).
  explicit MeshEdges(const Mesh& m);

  const std::vector<MeshEdge>& edges() const { return edges_; }
  uint32_t edgeOf(uint32_t corner) const { return edgeOf_[corner]; }
  uint32_t faceOf(uint32_t corner) const { return faceOf_[corner]; }
  uint32_t next(uint32_t corner) const { return next_[corner]; }
  uint32_t previous(uint32_t corner) const { return previous_[corner]; }
  /// The corners at a position, ascending.
  std::vector<uint32_t> cornersAt(uint32_t position) const;

 private:
  const Mesh& mesh_;
  std::vector<MeshEdge> edges_;
  std::vector<uint32_t> edgeOf_, faceOf_, next_, previous_;
  /// Corners sorted by position, and where each position's begin.
  std::vector<uint32_t> byPosition_, firstAt_;
};

}  // namespace gable
