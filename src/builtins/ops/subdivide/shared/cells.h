// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A shape divided along two axes of its scope at once: the cells of a grid, the nine pieces of a
// margin. Boxes and rectangles are divided by arithmetic alone; other geometry is cut by planes,
// and solids are closed. Cells without geometry, of a shape that has some, do not exist.
#pragma once

#include <vector>

#include "builtins/ops/subdivide/shared/split_sizes.h"
#include "geom/mesh/mesh.h"
#include "shape/op_call.h"

namespace gable {

class Cells {
 public:
  /// Pieces ascend. `second` may be empty: then only one axis is divided. The shape must outlive
  /// this. O(cells) for primitives, O(faces * (u + v) pieces) for meshes.
  Cells(const Shape& shape, Axis u, const SplitPieces& first, Axis v, const SplitPieces& second);

  /// The cell of the i-th piece along u and the j-th along v; false when it does not exist. Call it
  /// once for each cell.
  bool take(size_t i, size_t j, Shape& out);

 private:
  const Shape& shape_;
  Axis u_, v_;
  const SplitPieces& first_;
  const SplitPieces& second_;
  /// By i * v pieces + j; empty for primitives.
  std::vector<Mesh> meshes_;
  bool primitive_;
};

/// Along which axes a shape is divided when it is to stay whole along `axis`: for a shape that is
/// flat along one axis these are the other two, whatever `axis` says.
struct AxisPair {
  Axis whole, u, v;
};
/// x and z for y, y and z for x, x and y for z. False when fewer than two axes have an extent.
bool axesAround(const Shape& s, Axis axis, AxisPair& out);

/// How a number of pieces comes of a ratio of lengths. One piece at least.
double roundedCount(double ratio, std::string_view rounding);

/// `whole` in equal pieces as near to `preferred` as the rounding says; one piece when nothing is
/// preferred. Fails beyond kMaxSplitPieces.
Status equalPieces(double whole, double preferred, std::string_view rounding, SplitPieces& out);

}  // namespace gable
