// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The public cuts set up a field of values at the corners; mesh/slicer does the work.
#include "geom/mesh/clip.h"

#include <iterator>
#include <utility>

#include "geom/mesh/slicer.h"

namespace gable {
namespace {

std::vector<MeshPart> run(slicing::Slicer& slicer, std::span<const double> cuts,
                          const CutOptions& options) {
  std::vector<std::vector<slicing::Piece>> slabs = slicer.slice(cuts);
  if (options.cap) slicer.cap(cuts, slabs);
  std::vector<MeshPart> parts;
  parts.reserve(slabs.size());
  for (const auto& pieces : slabs) parts.push_back(slicer.build(pieces, options));
  return parts;
}

}  // namespace

std::vector<MeshPart> sliceAxis(const Mesh& m, int axis, std::span<const double> cuts,
                                const CutOptions& options) {
  std::vector<double> values;
  values.reserve(m.corners.size());
  for (const uint32_t p : m.corners) values.push_back(m.positions[p][static_cast<size_t>(axis)]);
  Vec3 direction;
  direction[static_cast<size_t>(axis)] = 1;
  slicing::Slicer slicer(m, std::move(values), axis, direction, options.tolerance);
  return run(slicer, cuts, options);
}

std::vector<MeshPart> sliceDirection(const Mesh& m, const Vec3& direction,
                                     std::span<const double> cuts, const CutOptions& options) {
  std::vector<double> values;
  values.reserve(m.corners.size());
  for (const uint32_t p : m.corners) values.push_back(dot(direction, m.positions[p]));
  slicing::Slicer slicer(m, std::move(values), -1, direction, options.tolerance);
  return run(slicer, cuts, options);
}

std::vector<MeshPart> sliceField(const Mesh& m, std::span<const double> cornerValues,
                                 std::span<const double> cuts, uint32_t cutEdgeTags) {
  slicing::Slicer slicer(m, {cornerValues.begin(), cornerValues.end()}, -1, Vec3{}, 0);
  CutOptions options;
  options.cutEdgeTags = cutEdgeTags;
  return run(slicer, cuts, options);
}

Mesh scoreField(const Mesh& m, std::span<const double> cornerValues, std::span<const double> cuts) {
  slicing::Slicer slicer(m, {cornerValues.begin(), cornerValues.end()}, -1, Vec3{}, 0);
  std::vector<slicing::Piece> all;
  for (std::vector<slicing::Piece>& slab : slicer.slice(cuts)) {
    std::move(slab.begin(), slab.end(), std::back_inserter(all));
  }
  return slicer.build(all, {}).mesh;
}

PlaneCut cutByPlane(const Mesh& m, const Plane& plane, const CutOptions& options) {
  const double cuts[] = {plane.offset};
  std::vector<MeshPart> parts = sliceDirection(m, plane.normal, cuts, options);
  return {std::move(parts[0]), std::move(parts[1])};
}

}  // namespace gable
