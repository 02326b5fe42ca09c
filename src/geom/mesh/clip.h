// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Cutting meshes: by a plane, into slabs along a direction, or into bands of any linear field such
// as a uv coordinate. Frame and units are the mesh's.
//
// Promises:
//   1. Faces with holes and concave faces are cut as what they are; parts keep materials, tags,
//      edge tags, and interpolate uvs and normals. A ring starts next to where the input's started.
//   2. Both sides of a cut, and all faces around an edge, share exactly the same new points; along
//      an axis their coordinate is exactly the cut.
//   3. A face in the plane of a cut goes to exactly one side: the one that its normal leaves
//      (a solid's top stays with what is below it).
//   4. No NaN, no part with less than 1e-12 of its box's area. Points within 1e-9 of the extent
//      from a cut, or within the options' tolerance, count as lying on it.
//   5. With `cap`, each closed component of the mesh that a cut opens gets planar faces, holes
//      included, that close both sides again. Cap uvs are 0.
// Each face costs O(n log n) a cut that meets it. Input must be valid() and finite.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

struct CutOptions {
  bool cap = false;
  uint16_t capSlot = 0;
  /// Face tags of caps.
  uint32_t capTags = 0;
  /// Edge tags of the edges that a cut makes in faces that it cuts.
  uint32_t cutEdgeTags = 0;
  /// Points whose value differs by no more than this from a cut's count as lying on it.
  double tolerance = 0;
};

/// A part of a mesh and where it comes from.
struct MeshPart {
  static constexpr uint32_t kNone = 0xffffffff;
  Mesh mesh;
  /// For each face the source face; kNone for caps.
  std::vector<uint32_t> faceSource;
  /// For each corner the source corner whose edge this corner's edge is a part of; kNone for cuts.
  std::vector<uint32_t> edgeSource;
};

struct Plane {
  /// Points p with dot(normal, p) = offset. The front is where the normal points; it need not be a
  /// unit vector.
  Vec3 normal{0, 1, 0};
  double offset = 0;
};

struct PlaneCut {
  MeshPart back, front;
};

PlaneCut cutByPlane(const Mesh& m, const Plane& plane, const CutOptions& options = {});

/// Cuts at ascending values of a coordinate (axis 0..2): cuts.size() + 1 slabs from low to high, of
/// which some may be empty.
std::vector<MeshPart> sliceAxis(const Mesh& m, int axis, std::span<const double> cuts,
                                const CutOptions& options = {});

/// The same along any direction: cuts are values of dot(direction, p).
std::vector<MeshPart> sliceDirection(const Mesh& m, const Vec3& direction,
                                     std::span<const double> cuts, const CutOptions& options = {});

/// Cuts each face where a field, given at the corners and linear over each face, takes the values
/// of `cuts`. Faces that share an edge share new points where their values on it agree. No caps.
std::vector<MeshPart> sliceField(const Mesh& m, std::span<const double> cornerValues,
                                 std::span<const double> cuts, uint32_t cutEdgeTags = 0);
/// The same, with all parts in one mesh that share their points.
Mesh scoreField(const Mesh& m, std::span<const double> cornerValues, std::span<const double> cuts);

}  // namespace gable
