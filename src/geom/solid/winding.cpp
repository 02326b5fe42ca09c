// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Solid angles of triangles after A. Van Oosterom and J. Strackee, The Solid Angle of a Plane
// Triangle, 1983; their sum as a winding number after A. Jacobson, L. Kavan and O. Sorkine-Hornung,
// Robust Inside-Outside Segmentation using Generalized Winding Numbers, 2013. Seen from a point
// beside its plane, the triangles of a fan add up to their polygon, concave or not.
#include <algorithm>

#include "base/elementary.h"
#include "base/work.h"
#include "geom/solid/surface.h"
#include "math/trig.h"

namespace gable::solid {
namespace {

struct Ray {
  Vec3 to;
  double length = 0;
};

double solidAngle(const Ray& a, const Ray& b, const Ray& c) {
  const double over = dot(a.to, cross(b.to, c.to));
  const double under = a.length * b.length * c.length + dot(a.to, b.to) * c.length +
                       dot(b.to, c.to) * a.length + dot(c.to, a.to) * b.length;
  return 2 * atan2Of(over, under);
}

double solidAngle(const Facet& f, const VertexPool& pool, const Vec3& p) {
  const auto rayTo = [&](uint32_t v) {
    const Vec3 to = pool[v] - p;
    return Ray{to, length(to)};
  };
  double sum = 0;
  for (const auto& loop : f.loops) {
    work(4 * loop.size());
    const Ray first = rayTo(loop[0]);
    Ray last = rayTo(loop[1]);
    for (size_t i = 2; i < loop.size(); ++i) {
      const Ray next = rayTo(loop[i]);
      sum += solidAngle(first, last, next);
      last = next;
    }
  }
  return sum;
}

}  // namespace

double windingNumber(const Shell& shell, const Facets& facets, const Vec3& p) {
  const double flat = 2 * facets.pool.tolerance();
  double sum = 0;
  for (const uint32_t k : shell.facets) {
    work();
    const Facet& f = facets.list[k];
    // Outward normals give a positive angle from within.
    if (std::fabs(f.height(p)) > flat) sum += solidAngle(f, facets.pool, p);
  }
  return sum / (4 * kPi);
}

Vec3 pointWithin(const Piece& piece, const Facets& facets) {
  constexpr size_t kMostLines = 24;
  const Facet& f = facets.list[piece.facet];
  std::vector<double> heights;
  for (const Edge& e : piece.edges) heights.push_back(f.project(facets.pool[e[0]]).y);
  std::sort(heights.begin(), heights.end());
  // Lines between vertices, the widest gaps first.
  std::vector<std::pair<double, double>> lines;
  for (size_t i = 1; i < heights.size(); ++i) {
    lines.emplace_back(heights[i - 1] - heights[i], (heights[i - 1] + heights[i]) * 0.5);
  }
  std::sort(lines.begin(), lines.end());
  lines.resize(std::min(lines.size(), kMostLines));
  Vec2 best = f.project(facets.pool[piece.edges[0][0]]);
  double room = -1;
  for (const auto& [gap, y] : lines) {
    std::vector<double> places;
    work(piece.edges.size());
    for (const Edge& e : piece.edges) {
      const Vec2 a = f.project(facets.pool[e[0]]), b = f.project(facets.pool[e[1]]);
      if ((a.y > y) != (b.y > y)) places.push_back(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    std::sort(places.begin(), places.end());
    for (size_t i = 0; i + 1 < places.size(); i += 2) {
      const double here = std::min(-gap, places[i + 1] - places[i]);
      if (here <= room) continue;
      room = here;
      best = {(places[i] + places[i + 1]) * 0.5, y};
    }
  }
  const size_t x = f.project.x, y = f.project.y, z = 3 - x - y;
  Vec3 p;
  p[x] = best.x;
  p[y] = best.y;
  const double rise = f.normal[x] * (best.x - f.origin[x]) + f.normal[y] * (best.y - f.origin[y]);
  p[z] = f.origin[z] - rise / f.normal[z];
  return p;
}

}  // namespace gable::solid
