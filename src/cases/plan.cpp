// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// An edge is cut where it crosses the region's boundary; a piece between two cuts lies on one side,
// so that its middle tells which.

#include "cases/plan.h"

#include <algorithm>
#include <cmath>

#include "geom/region/boolean.h"

namespace gable::cases {
namespace {

Vec2 seenFromAbove(const Vec3& p) { return {p.x, -p.z}; }

/// Heights that only touch share nothing.
constexpr double kTouch = 1e-3;

double distanceToSegment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double length = dot(along, along);
  const double t = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0;
  const Vec2 off = p - (a + along * t);
  return std::sqrt(dot(off, off));
}

template <class Each>
void forEachEdge(const Region& region, Each&& each) {
  const auto ring = [&](const Ring& r) {
    for (size_t i = 0; i < r.size(); ++i) each(r[i], r[(i + 1) % r.size()]);
  };
  for (const Polygon& p : region) {
    ring(p.outer);
    for (const Ring& hole : p.holes) ring(hole);
  }
}

double distanceBeyond(Vec2 p, const Region& region) {
  for (const Polygon& polygon : region) {
    if (contains(polygon, p)) return 0;
  }
  double least = INFINITY;
  forEachEdge(region, [&](Vec2 a, Vec2 b) { least = std::min(least, distanceToSegment(p, a, b)); });
  return least;
}

/// Where the edge from a to b crosses the boundary, as shares of its length, with both ends.
std::vector<double> cutsOf(Vec2 a, Vec2 b, const Region& region) {
  std::vector<double> cuts{0, 1};
  forEachEdge(region, [&](Vec2 c, Vec2 d) {
    const double along = cross(b - a, d - c);
    if (along == 0) return;
    const double t = cross(c - a, d - c) / along, u = cross(c - a, b - a) / along;
    if (t > 0 && t < 1 && u >= 0 && u <= 1) cuts.push_back(t);
  });
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

}  // namespace

Region planOf(const Mesh& mesh) {
  Region plan;
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    std::vector<Ring> rings;
    for (const MeshLoop& loop : mesh.loopsOf(face)) {
      rings.emplace_back();
      for (uint32_t corner : mesh.cornersOf(loop)) {
        rings.back().push_back(seenFromAbove(mesh.positions[corner]));
      }
    }
    plan = unite(plan, repaired(rings, FillRule::EvenOdd));
  }
  return plan;
}

double reachBeyond(const Mesh& mesh, const Region& region) {
  double most = 0;
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    for (const MeshLoop& loop : mesh.loopsOf(face)) {
      const auto corners = mesh.cornersOf(loop);
      for (size_t i = 0; i < corners.size(); ++i) {
        const Vec2 a = seenFromAbove(mesh.positions[corners[i]]);
        const Vec2 b = seenFromAbove(mesh.positions[corners[(i + 1) % corners.size()]]);
        most = std::max(most, distanceBeyond(a, region));
        const std::vector<double> cuts = cutsOf(a, b, region);
        for (size_t k = 0; k + 1 < cuts.size(); ++k) {
          const Vec2 middle = a + (b - a) * ((cuts[k] + cuts[k + 1]) / 2);
          most = std::max(most, distanceBeyond(middle, region));
        }
      }
    }
  }
  return most;
}

double sharedPlan(const PlacedLeaf& a, const PlacedLeaf& b) {
  const Box3 boxA = a.mesh.bounds(), boxB = b.mesh.bounds();
  for (size_t axis = 0; axis < 3; ++axis) {
    if (std::min(boxA.max[axis], boxB.max[axis]) - std::max(boxA.min[axis], boxB.min[axis]) <
        kTouch) {
      return 0;
    }
  }
  return area(intersect(planOf(a.mesh), planOf(b.mesh)));
}

}  // namespace gable::cases
