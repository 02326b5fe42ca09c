// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face is projected along the coordinate axis that its normal is nearest to, which keeps the
// coordinates exact and the direction of its rings. Small convex faces, almost all there are,
// become a fan; a fan in which every triangle is counter-clockwise is a triangulation of a simple
// polygon.
#include "geom/mesh/face_triangles.h"

#include <algorithm>

#include "base/work.h"
#include "geom/mesh/projection.h"
#include "geom/region/triangulate.h"

namespace gable {
namespace {

constexpr uint32_t kLongestFan = 8;

}  // namespace

bool FaceTriangulator::addFan(uint32_t firstCorner, uint32_t count,
                              std::vector<std::array<uint32_t, 3>>& out) {
  double size = 0;
  for (uint32_t i = 1; i < count; ++i) {
    const Vec2 d = points_[i] - points_[0];
    size = std::max(size, dot(d, d));
  }
  // Far above the rounding of the cross products; flatter triangles are left to exact arithmetic.
  const double least = 1e-10 * size;
  for (uint32_t apex = 0; apex < count; ++apex) {
    work(count);
    bool good = true;
    for (uint32_t i = 1; good && i + 1 < count; ++i) {
      const Vec2 a = points_[apex];
      good = cross(points_[(apex + i) % count] - a, points_[(apex + i + 1) % count] - a) > least;
    }
    if (!good) continue;
    for (uint32_t i = 1; i + 1 < count; ++i) {
      out.push_back({firstCorner + apex, firstCorner + (apex + i) % count,
                     firstCorner + (apex + i + 1) % count});
    }
    return true;
  }
  return false;
}

void FaceTriangulator::add(const Mesh& m, size_t face, std::vector<std::array<uint32_t, 3>>& out) {
  const auto loops = m.loopsOf(face);
  const Vec3 normal = m.areaNormal(face);
  if (loops.empty() || normal == Vec3{} || !isFinite(normal)) return;
  const Projection project = projectionFor(normal);
  points_.clear();
  ringEnds_.clear();
  cornerOf_.clear();
  for (const MeshLoop& loop : loops) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      cornerOf_.push_back(loop.firstCorner + i);
      points_.push_back(project(m.at(loop.firstCorner + i)));
    }
    ringEnds_.push_back(static_cast<uint32_t>(points_.size()));
  }
  const uint32_t count = loops[0].cornerCount;
  if (loops.size() == 1 && count <= kLongestFan && addFan(loops[0].firstCorner, count, out)) return;
  const size_t first = out.size();
  triangulate(points_, ringEnds_, out);
  for (size_t t = first; t < out.size(); ++t) {
    for (uint32_t& corner : out[t]) corner = cornerOf_[corner];
  }
}

}  // namespace gable
