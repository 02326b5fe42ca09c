// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sums over faces; a loop's area vector is half of the sum of the cross products along it (Newell),
// so holes, which run the other way, count against their face by themselves.

#include "cases/measure.h"

#include <array>
#include <cmath>
#include <map>

#include "base/work.h"

namespace gable::cases {

namespace {

constexpr double kSamePoint = 1e-5;
constexpr double kFlat = 1e-4;

Vec3 areaVector(const Mesh& mesh, size_t face) {
  Vec3 sum;
  for (const MeshLoop& loop : mesh.loopsOf(face)) {
    const auto corners = mesh.cornersOf(loop);
    const Vec3 origin = mesh.positions[corners.front()];
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
      sum += cross(mesh.positions[corners[i]] - origin, mesh.positions[corners[i + 1]] - origin);
    }
  }
  return sum * 0.5;
}

using Key = std::array<long long, 3>;

Key keyOf(const Vec3& p) {
  return {std::llround(p.x / kSamePoint), std::llround(p.y / kSamePoint),
          std::llround(p.z / kSamePoint)};
}

}  // namespace

std::vector<PlacedLeaf> placedLeaves(const Scene& scene) {
  std::vector<PlacedLeaf> leaves;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    const Mesh& unit = *scene.meshes[leaf.mesh];
    work(unit.positions.size());
    Vec3 size = scaled(unit.bounds().size(), leaf.scale);
    for (size_t axis = 0; axis < 3; ++axis) size[axis] = std::abs(size[axis]);
    leaves.push_back({&leaf, scene.names[leaf.name], transformed(unit, leaf.scale, world), size});
  });
  return leaves;
}

double volume(const Mesh& mesh) {
  if (mesh.empty()) return 0;
  // Measured from a point of the mesh, so that a place far from the origin loses nothing.
  const Vec3 origin = mesh.positions.front();
  double sum = 0;
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    const uint32_t corner = mesh.loops[mesh.faces[face].firstLoop].firstCorner;
    sum += dot(mesh.at(corner) - origin, areaVector(mesh, face));
  }
  return sum / 3;
}

bool isClosed(const Mesh& mesh) {
  work(mesh.corners.size());
  // Each edge counts up one way and down the other.
  std::map<std::array<Key, 2>, int> balance;
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    for (const MeshLoop& loop : mesh.loopsOf(face)) {
      const auto corners = mesh.cornersOf(loop);
      for (size_t i = 0; i < corners.size(); ++i) {
        const Key a = keyOf(mesh.positions[corners[i]]);
        const Key b = keyOf(mesh.positions[corners[(i + 1) % corners.size()]]);
        if (a < b)
          ++balance[{a, b}];
        else if (b < a)
          --balance[{b, a}];
      }
    }
  }
  for (const auto& [edge, count] : balance) {
    if (count != 0) return false;
  }
  return !mesh.empty();
}

bool isFlat(const Mesh& mesh) {
  if (mesh.empty()) return false;
  const Vec3 normal = mesh.normal(0);
  const Vec3 origin = mesh.at(mesh.loops[mesh.faces[0].firstLoop].firstCorner);
  for (const Vec3& p : mesh.positions) {
    if (std::abs(dot(p - origin, normal)) > kFlat) return false;
  }
  return true;
}

}  // namespace gable::cases
