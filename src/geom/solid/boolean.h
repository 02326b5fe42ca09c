// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Booleans of meshes in space: union, difference and intersection of two operands, and the union of
// any number. The operands are the faces of one mesh. Frame and units are the mesh's.
//
// Promises:
//   1. Closed operands give a closed result. Faces of it stay polygons with holes; no vertex lies
//      within an edge of another face.
//   2. A face of the result is a part of one face of the input, and keeps its material, tags, and
//      the tags of its edges; uvs and normals are interpolated. Parts that a difference turns round
//      lie on the other side of it.
//   3. Faces in one plane are cut along each other's outlines. Where faces of several operands lie
//      on each other one stays, that of the first operand.
//   4. Points within the tolerance (1e-9 of the extent) are one, planes within it too.
//   5. An operand that is not closed encloses what is behind it, unless its border runs into the
//      other operand; then it encloses nothing. In a union of many it never does. Operands that all
//      lie in one plane are regions of it, whichever way they turn.
// O(n log n) and what the faces that meet need: a pass over both for each pair, and for each part
// of the surface between intersections a pass over the operands around it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

enum class SolidOp : uint8_t {
  /// Of operands 0 and 1.
  Union,
  Subtract,
  Intersect,
  /// The union of all operands; open ones only lose what lies within closed ones.
  Unify,
};

struct SolidResult {
  static constexpr uint32_t kNone = 0xffffffff;
  Mesh mesh;
  /// For each face: the face that it is a part of.
  std::vector<uint32_t> faceSource;
  /// For each face: those of the input that lay on it besides, in ascending order.
  std::vector<std::vector<uint32_t>> faceOthers;
  /// For each corner: the corner whose place it has; kNone for new ones.
  std::vector<uint32_t> cornerSource;
  /// For each corner: the corner whose edge its edge is a part of; kNone for intersections.
  std::vector<uint32_t> edgeSource;
  /// For each corner: its edge lies on faces of several operands.
  std::vector<bool> cut;
};

/// `operandOf`: for each face the number of its operand. Faces of one or two corners are left out.
/// Nothing where the input is too confused at the scale of the tolerance.
std::optional<SolidResult> solidBoolean(const Mesh& m, std::span<const uint32_t> operandOf,
                                        SolidOp op);

}  // namespace gable
