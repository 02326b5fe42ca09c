// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// cutFace: takes a face with holes apart along a straight cut. The shared core of cutting polygons
// by lines (region/line.h) and meshes by planes (mesh/clip.h); purely combinatorial, so that both
// sides of a cut, and all faces around an edge, end in the same points.
//
// Promises: each part's loops are oriented as the input's; a part's outer loop comes first; no loop
// repeats a point; parts whose area is below 1e-12 of their box are left out. A face of the input
// that is not valid gives some parts and never fails. O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "math/vec.h"

namespace gable::cut {

/// One corner of a face. All three numbers are the host's; equal points are one place.
struct Corner {
  uint32_t point = 0;
  /// What the host knows of the corner here: uv, field value.
  uint32_t attributes = 0;
  /// The edge that starts here.
  uint32_t edge = 0;
};

using Loop = std::vector<Corner>;
/// The outer loop first; outer loops turn left in the host's plane, holes right.
using Face = std::vector<Loop>;

class Host {
 public:
  virtual ~Host() = default;
  /// -1 below the cut, +1 above, 0 on it.
  virtual int side(const Corner& c) const = 0;
  /// Coordinates in the face's plane: x along the cut, y from below to above.
  virtual Vec2 place(const Corner& c) const = 0;
  /// The corner where the edge from a to b crosses the cut; its edge is a's.
  virtual Corner split(const Corner& a, const Corner& b) = 0;
};

/// Appends the parts of `face` on both sides. New edges along the cut get the number `cutEdge`.
void cutFace(const Face& face, Host& host, uint32_t cutEdge, std::vector<Face>& below,
             std::vector<Face>& above);

/// Appends the parts below only: the same ones.
void keepBelow(const Face& face, Host& host, uint32_t cutEdge, std::vector<Face>& below);

/// Orients nothing, but finds the holes of each outer loop: what mesh caps and cuts share. Drops
/// loops without area; takes loops apart that visit a point twice.
void nestLoops(std::vector<Loop> loops, const Host& host, std::vector<Face>& out);

}  // namespace gable::cut
