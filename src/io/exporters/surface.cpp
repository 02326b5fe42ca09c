// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/hash.h"
#include "geom/mesh/corner_normals.h"

namespace gable {
namespace {

bool sameVertex(const Mesh& m, uint32_t a, uint32_t b) {
  if (m.corners[a] != m.corners[b]) return false;
  for (const auto& uv : m.uvs) {
    if (!uv.empty() && uv[a] != uv[b]) return false;
  }
  return true;
}

uint64_t vertexHash(const Mesh& m, uint32_t corner, const Vec3& n) {
  uint64_t h = hashCombine(m.corners[corner], hashDouble(n.x));
  h = hashCombine(hashCombine(h, hashDouble(n.y)), hashDouble(n.z));
  for (const auto& uv : m.uvs) {
    if (!uv.empty())
      h = hashCombine(hashCombine(h, hashDouble(uv[corner].x)), hashDouble(uv[corner].y));
  }
  return h;
}

}  // namespace

Vec3 scaledNormal(const Vec3& n, const Vec3& s) {
  const auto sign = [](double v) { return v < 0 ? -1.0 : 1.0; };
  const Vec3 t =
      unitOf({n.x * sign(s.x) * std::fabs(s.y * s.z), n.y * sign(s.y) * std::fabs(s.x * s.z),
              n.z * sign(s.z) * std::fabs(s.x * s.y)});
  return t == Vec3{} ? n : t;
}

std::vector<SlotTally> slotTallies(const Mesh& m) {
  std::vector<SlotTally> bySlot;
  for (const MeshFace& f : m.faces) {
    if (f.materialSlot >= bySlot.size()) bySlot.resize(f.materialSlot + size_t{1});
    uint32_t corners = 0;
    for (uint32_t l = 0; l < f.loopCount; ++l) corners += m.loops[f.firstLoop + l].cornerCount;
    bySlot[f.materialSlot].corners += corners;
    bySlot[f.materialSlot].triangles += std::max(corners + 2 * f.loopCount, 4u) - 4;
  }
  std::vector<SlotTally> out;
  for (size_t slot = 0; slot < bySlot.size(); ++slot) {
    if (bySlot[slot].corners == 0) continue;
    out.push_back({static_cast<uint16_t>(slot), bySlot[slot].corners, bySlot[slot].triangles});
  }
  return out;
}

const SurfacePart* DrawSurface::part(uint16_t slot) const {
  const auto p = std::lower_bound(parts.begin(), parts.end(), slot,
                                  [](const SurfacePart& a, uint16_t s) { return a.slot < s; });
  return p != parts.end() && p->slot == slot ? &*p : nullptr;
}

void DrawSurface::addFace(const Mesh& m, size_t face, const std::vector<Vec3>& cornerNormals,
                          FaceTriangulator& triangulator) {
  scratch_.clear();
  triangulator.add(m, face, scratch_);
  if (scratch_.empty()) return;
  const auto loops = m.loopsOf(face);
  SurfaceFace out;
  out.firstVertex = static_cast<uint32_t>(corners.size());
  out.firstTriangle = static_cast<uint32_t>(triangles.size());
  for (const MeshLoop& loop : loops) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      corners.push_back(loop.firstCorner + i);
      normals.push_back(cornerNormals[loop.firstCorner + i]);
    }
  }
  const auto vertexOf = [&](uint32_t corner) {
    uint32_t before = 0;
    for (const MeshLoop& loop : loops) {
      if (corner - loop.firstCorner < loop.cornerCount) return before + (corner - loop.firstCorner);
      before += loop.cornerCount;
    }
    return before;
  };
  for (const auto& t : scratch_) {
    triangles.push_back({vertexOf(t[0]), vertexOf(t[1]), vertexOf(t[2])});
  }
  out.vertexCount = static_cast<uint32_t>(corners.size()) - out.firstVertex;
  out.triangleCount = static_cast<uint32_t>(triangles.size()) - out.firstTriangle;
  faces.push_back(out);
}

// Open addressing over the part's vertices; the first of equal ones stays, in order.
void DrawSurface::mergeVertices(const Mesh& m, SurfacePart& part) {
  if (part.faceCount < 2) return;
  const SurfaceFace first = faces[part.firstFace];
  const auto vertexCount = static_cast<uint32_t>(corners.size()) - first.firstVertex;
  size_t capacity = 16;
  while (capacity < 2 * size_t{vertexCount}) capacity *= 2;
  constexpr uint32_t kFree = 0xffffffff;
  std::vector<uint32_t> table(capacity, kFree), newIndex(vertexCount);
  uint32_t kept = 0;
  for (uint32_t v = 0; v < vertexCount; ++v) {
    const uint32_t c = corners[first.firstVertex + v];
    const Vec3 n = normals[first.firstVertex + v];
    size_t at = vertexHash(m, c, n) & (capacity - 1);
    for (;; at = (at + 1) & (capacity - 1)) {
      const uint32_t other = table[at];
      if (other == kFree) {
        table[at] = kept;
        corners[first.firstVertex + kept] = c;
        normals[first.firstVertex + kept] = n;
        newIndex[v] = kept++;
        break;
      }
      if (sameVertex(m, corners[first.firstVertex + other], c) &&
          normals[first.firstVertex + other] == n) {
        newIndex[v] = other;
        break;
      }
    }
  }
  for (uint32_t f = 0; f < part.faceCount; ++f) {
    const SurfaceFace& face = faces[part.firstFace + f];
    const uint32_t shift = face.firstVertex - first.firstVertex;
    for (uint32_t t = 0; t < face.triangleCount; ++t) {
      for (uint32_t& v : triangles[face.firstTriangle + t]) v = newIndex[v + shift];
    }
  }
  corners.resize(first.firstVertex + kept);
  normals.resize(first.firstVertex + kept);
  faces.resize(part.firstFace + 1);
  faces.back().vertexCount = kept;
  faces.back().triangleCount = static_cast<uint32_t>(triangles.size()) - first.firstTriangle;
  part.faceCount = 1;
}

void DrawSurface::build(const Mesh& m, FaceTriangulator& triangulator, bool apart) {
  corners.clear();
  normals.clear();
  triangles.clear();
  faces.clear();
  parts.clear();
  const std::vector<Vec3> lit = cornerNormals(m);
  const bool mergeable =
      !apart && (!m.normals.empty() || std::any_of(m.faces.begin(), m.faces.end(),
                                                   [](const MeshFace& f) { return f.smooth; }));
  std::vector<uint32_t> order(m.faces.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](uint32_t a, uint32_t b) {
    return m.faces[a].materialSlot < m.faces[b].materialSlot;
  };
  if (!std::is_sorted(order.begin(), order.end(), before)) {
    std::stable_sort(order.begin(), order.end(), before);
  }
  for (size_t i = 0; i < order.size();) {
    SurfacePart part{m.faces[order[i]].materialSlot, static_cast<uint32_t>(faces.size()), 0};
    for (; i < order.size() && m.faces[order[i]].materialSlot == part.slot; ++i) {
      addFace(m, order[i], lit, triangulator);
    }
    part.faceCount = static_cast<uint32_t>(faces.size()) - part.firstFace;
    if (part.faceCount == 0) continue;
    if (mergeable) mergeVertices(m, part);
    parts.push_back(part);
  }
}

FaceAxes layingOf(const Mesh& m, const DrawSurface& surface, const SurfaceFace& face,
                  const Frame& frame, const Vec3& scale) {
  const auto at = [&](uint32_t vertex) {
    return frame.point(scaled(m.at(surface.corners[face.firstVertex + vertex]), scale));
  };
  Vec3 normal;
  for (uint32_t t = 0; t < face.triangleCount; ++t) {
    const auto& tri = surface.triangles[face.firstTriangle + t];
    const Vec3 a = at(tri[0]);
    normal += cross(at(tri[1]) - a, at(tri[2]) - a);
  }
  const bool mirrored = ((scale.x < 0) != (scale.y < 0)) != (scale.z < 0);
  return layingAxes(unitOf(mirrored ? -normal : normal));
}

Tangents tangentsOf(const Mesh& m, const DrawSurface& surface, int uvSet) {
  Tangents out;
  out.u.resize(surface.corners.size());
  out.v.resize(surface.corners.size());
  const std::vector<Vec2>& uv = m.uvs[static_cast<size_t>(uvSet)];
  if (uv.empty()) return out;
  for (const SurfaceFace& face : surface.faces) {
    for (uint32_t t = 0; t < face.triangleCount; ++t) {
      const auto& tri = surface.triangles[face.firstTriangle + t];
      const uint32_t a = surface.corners[face.firstVertex + tri[0]];
      const uint32_t b = surface.corners[face.firstVertex + tri[1]];
      const uint32_t c = surface.corners[face.firstVertex + tri[2]];
      const Vec3 e1 = m.at(b) - m.at(a), e2 = m.at(c) - m.at(a);
      const Vec2 d1 = uv[b] - uv[a], d2 = uv[c] - uv[a];
      const double turn = cross(d1, d2);
      if (turn == 0) continue;
      // The gradients times the uv area, so that large triangles weigh more; the sign keeps their
      // sense where the texture is mirrored.
      const double sign = turn > 0 ? 1 : -1;
      const Vec3 u = (e1 * d2.y - e2 * d1.y) * sign, v = (e2 * d1.x - e1 * d2.x) * sign;
      for (const uint32_t i : tri) {
        out.u[face.firstVertex + i] += u;
        out.v[face.firstVertex + i] += v;
      }
    }
  }
  return out;
}

}  // namespace gable
