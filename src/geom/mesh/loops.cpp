// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/mesh/loops.h"

#include <cmath>

namespace gable {

namespace {

// The plane coordinates that a normal's largest component leaves, in an order that keeps turns.
Vec2 flattened(const Vec3& p, const Vec3& normal) {
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  if (z >= x && z >= y) return normal.z > 0 ? Vec2{p.x, p.y} : Vec2{p.y, p.x};
  if (x >= y) return normal.x > 0 ? Vec2{p.y, p.z} : Vec2{p.z, p.y};
  return normal.y > 0 ? Vec2{p.z, p.x} : Vec2{p.x, p.z};
}

bool insideLoop(const IndexLoop& loop, const Vec3& at, const Vec3& normal,
                const std::function<Vec3(uint32_t)>& point) {
  const Vec2 p = flattened(at, normal);
  bool inside = false;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec2 a = flattened(point(loop[i]), normal);
    const Vec2 b = flattened(point(loop[(i + 1) % loop.size()]), normal);
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
  }
  return inside;
}

}  // namespace

Vec3 loopNormal(const IndexLoop& loop, const std::function<Vec3(uint32_t)>& point) {
  Vec3 sum;
  if (loop.empty()) return sum;
  const Vec3 origin = point(loop[0]);
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += cross(point(loop[i]) - origin, point(loop[i + 1]) - origin);
  }
  return sum;
}

std::vector<LoopFace> facesOfLoops(std::vector<IndexLoop> loops, const Vec3& normal,
                                   double leastArea, const std::function<Vec3(uint32_t)>& point) {
  const double length = gable::length(normal);
  std::vector<LoopFace> faces;
  std::vector<double> areas;
  std::vector<IndexLoop> holes;
  for (IndexLoop& loop : loops) {
    const double area = dot(loopNormal(loop, point), normal) / (2 * length);
    if (loop.size() < 3 || !(std::fabs(area) >= leastArea)) continue;
    if (area > 0) {
      areas.push_back(area);
      faces.push_back({std::move(loop)});
    } else {
      holes.push_back(std::move(loop));
    }
  }
  for (IndexLoop& hole : holes) {
    size_t owner = faces.size() == 1 ? 0 : faces.size();
    // The middle of an edge lies on no other loop's vertex as a rule.
    const Vec3 at = (point(hole[0]) + point(hole[1])) * 0.5;
    for (size_t f = 0; f < faces.size() && faces.size() > 1; ++f) {
      if (owner < faces.size() && areas[f] >= areas[owner]) continue;
      if (insideLoop(faces[f][0], at, normal, point)) owner = f;
    }
    if (owner < faces.size()) faces[owner].push_back(std::move(hole));
  }
  return faces;
}

}  // namespace gable
