// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each face is fanned into triangles; on a triangle uv is linear, so dp/du follows from its edges.
#include "builtins/ops/subdivide/shared/uv_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gable {

UvExtent uvExtent(const Mesh& m, int set, int coordinate) {
  const auto& uvs = m.uvs[static_cast<size_t>(set)];
  UvExtent e;
  e.min = std::numeric_limits<double>::infinity();
  e.max = -e.min;
  for (const Vec2 uv : uvs) {
    e.min = std::min(e.min, uv[static_cast<size_t>(coordinate)]);
    e.max = std::max(e.max, uv[static_cast<size_t>(coordinate)]);
  }
  double weight = 0, sum = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const MeshLoop& loop = m.loopsOf(f)[0];
    for (uint32_t i = 1; i + 1 < loop.cornerCount; ++i) {
      const uint32_t a = loop.firstCorner, b = a + i, c = a + i + 1;
      const Vec3 p = m.at(b) - m.at(a), q = m.at(c) - m.at(a);
      const Vec2 s = uvs[b] - uvs[a], t = uvs[c] - uvs[a];
      const double det = cross(s, t);
      if (std::fabs(det) <= 1e-18) continue;
      const Vec3 along =
          coordinate == 0 ? p * (t.y / det) - q * (s.y / det) : q * (s.x / det) - p * (t.x / det);
      const double area = length(cross(p, q));
      weight += area;
      sum += area * length(along);
    }
  }
  e.metres = weight > 0 ? (e.max - e.min) * sum / weight : 0;
  return e;
}

}  // namespace gable
