// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/triangles.h"

#include <cmath>

#include "geom/region/triangulate.h"

namespace gable::rt {

namespace {

/// Cosine of half a degree: imported meshes give flat faces normals too, which need no storing.
constexpr double kFlat = 0.99996;

bool isConvexQuad(const Mesh& mesh, const MeshLoop& loop, const Vec3& normal) {
  for (uint32_t i = 0; i < 4; ++i) {
    const Vec3& a = mesh.at(loop.firstCorner + i);
    const Vec3& b = mesh.at(loop.firstCorner + (i + 1) % 4);
    const Vec3& c = mesh.at(loop.firstCorner + (i + 2) % 4);
    if (dot(cross(b - a, c - b), normal) <= 0) return false;
  }
  return true;
}

void triangulateFace(const Mesh& mesh, size_t face, std::vector<std::array<uint32_t, 3>>& out) {
  const std::span<const MeshLoop> loops = mesh.loopsOf(face);
  if (loops.empty() || loops[0].cornerCount < 3) return;
  const MeshLoop& outer = loops[0];
  const uint32_t first = outer.firstCorner;
  const Vec3 normal = mesh.areaNormal(face);
  if (!isFinite(normal) || length(normal) == 0) return;

  // Most faces are triangles and rectangles.
  if (loops.size() == 1 && outer.cornerCount == 3) {
    out.push_back({first, first + 1, first + 2});
    return;
  }
  if (loops.size() == 1 && outer.cornerCount == 4 && isConvexQuad(mesh, outer, normal)) {
    out.push_back({first, first + 1, first + 2});
    out.push_back({first, first + 2, first + 3});
    return;
  }

  const Vec3 origin = mesh.at(first);
  const Frame plane = frameFromZ(origin, normal, mesh.at(first + 1) - origin);
  std::vector<Vec2> points;
  std::vector<uint32_t> corners, ends;
  for (const MeshLoop& loop : loops) {
    if (loop.cornerCount < 3) continue;
    for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
      const Vec3 p = plane.toLocal(mesh.at(c));
      points.push_back({p.x, p.y});
      corners.push_back(c);
    }
    ends.push_back(static_cast<uint32_t>(points.size()));
  }
  std::vector<Triangle> triangles;
  triangulate(points, ends, triangles);
  for (const Triangle& t : triangles) out.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
}

/// Normals of the corners of smooth faces: the corner's own, else the area-weighted mean of the
/// smooth faces about its position.
void smoothNormals(const Mesh& mesh, MeshTriangles& to) {
  const bool own = mesh.normals.size() == mesh.corners.size();
  bool any = own;
  for (const MeshFace& face : mesh.faces) any = any || face.smooth;
  if (!any) return;

  std::vector<Vec3> sums(mesh.positions.size());
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!mesh.faces[f].smooth) continue;
    const Vec3 n = mesh.areaNormal(f);
    for (const MeshLoop& loop : mesh.loopsOf(f)) {
      for (const uint32_t p : mesh.cornersOf(loop)) sums[p] += n;
    }
  }
  to.normals.assign(mesh.corners.size(), {});
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const MeshLoop& loop : mesh.loopsOf(f)) {
      for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
        const bool given = own && length(mesh.normals[c]) > 0;
        if (given)
          to.normals[c] = normalized(mesh.normals[c]);
        else if (mesh.faces[f].smooth)
          to.normals[c] = normalized(sums[mesh.corners[c]]);
      }
    }
  }
  to.smooth.reserve(to.corners.size());
  for (size_t i = 0; i < to.corners.size(); ++i) {
    const Vec3 facet = mesh.normal(to.faces[i]);
    bool all = true, bent = false;
    for (const uint32_t c : to.corners[i]) {
      const Vec3& n = to.normals[c];
      all = all && isFinite(n) && length(n) > 0;
      bent = bent || dot(n, facet) < kFlat;
    }
    to.smooth.push_back(all && bent);
  }
}

}  // namespace

MeshTriangles triangulated(const Mesh& mesh) {
  MeshTriangles result;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    triangulateFace(mesh, f, result.corners);
    result.faces.resize(result.corners.size(), static_cast<uint32_t>(f));
  }
  smoothNormals(mesh, result);
  return result;
}

}  // namespace gable::rt
