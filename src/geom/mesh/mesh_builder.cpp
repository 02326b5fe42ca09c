// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// MeshBuilder, and the two meshes that every rule file starts from. Optional corner attributes are
// filled up lazily: a vector comes to life with its first value and take() completes it.
#include <algorithm>
#include <array>

#include "base/check.h"
#include "base/work.h"
#include "geom/mesh/mesh.h"

namespace gable {

uint32_t MeshBuilder::addPosition(const Vec3& p, uint32_t vertexTags) {
  if (vertexTags != 0) {
    mesh_.vertexTags.resize(mesh_.positions.size());
    mesh_.vertexTags.push_back(vertexTags);
  }
  mesh_.positions.push_back(p);
  return static_cast<uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::beginFace(uint16_t materialSlot, uint32_t tags, bool smooth) {
  mesh_.faces.push_back({static_cast<uint32_t>(mesh_.loops.size()), 0, materialSlot, smooth, tags});
}

void MeshBuilder::beginLoop() {
  GABLE_CHECK(!mesh_.faces.empty());
  mesh_.loops.push_back({static_cast<uint32_t>(mesh_.corners.size()), 0});
  ++mesh_.faces.back().loopCount;
}

uint32_t MeshBuilder::addCorner(uint32_t position, uint32_t edgeTags) {
  work();
  const auto corner = static_cast<uint32_t>(mesh_.corners.size());
  mesh_.corners.push_back(position);
  ++mesh_.loops.back().cornerCount;
  if (edgeTags != 0) {
    mesh_.edgeTags.resize(corner);
    mesh_.edgeTags.push_back(edgeTags);
  }
  return corner;
}

void MeshBuilder::setUv(uint32_t corner, int set, Vec2 uv) {
  if (set >= mesh_.setCount()) mesh_.notes.resize(static_cast<size_t>(set - kUvSets) + 1);
  std::vector<Vec2>& v = mesh_.set(set);
  if (v.size() <= corner) v.resize(corner + 1);
  v[corner] = uv;
}

void MeshBuilder::setNormal(uint32_t corner, const Vec3& n) {
  if (mesh_.normals.size() <= corner) mesh_.normals.resize(corner + 1);
  mesh_.normals[corner] = n;
}

void MeshBuilder::addPolygon(std::span<const uint32_t> positions, uint16_t materialSlot,
                             uint32_t tags) {
  beginFace(materialSlot, tags);
  beginLoop();
  for (const uint32_t p : positions) addCorner(p);
}

void MeshBuilder::copyFace(const Mesh& from, size_t face, std::vector<uint32_t>& map,
                           bool reversed) {
  if (map.size() < from.positions.size()) map.resize(from.positions.size(), kNoPosition);
  const MeshFace& f = from.faces[face];
  beginFace(f.materialSlot, f.tags, f.smooth);
  for (const MeshLoop& loop : from.loopsOf(face)) {
    beginLoop();
    const uint32_t n = loop.cornerCount;
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t c = loop.firstCorner + (reversed ? (n - i) % n : i);
      const uint32_t edge = loop.firstCorner + (reversed ? n - 1 - i : i);
      uint32_t& position = map[from.corners[c]];
      if (position == kNoPosition) position = copyPosition(from, from.corners[c]);
      const uint32_t corner = addCorner(position, from.edgeTagsAt(edge));
      for (int s = 0; s < from.setCount(); ++s) {
        if (from.hasUv(s)) setUv(corner, s, from.set(s)[c]);
      }
      if (!from.normals.empty()) {
        setNormal(corner, reversed ? -from.normals[c] : from.normals[c]);
      }
    }
  }
}

Mesh MeshBuilder::take() {
  const size_t n = mesh_.corners.size();
  for (int s = 0; s < mesh_.setCount(); ++s) {
    if (mesh_.hasUv(s)) mesh_.set(s).resize(n);
  }
  if (!mesh_.normals.empty()) mesh_.normals.resize(n);
  if (!mesh_.edgeTags.empty()) mesh_.edgeTags.resize(n);
  Mesh out = std::move(mesh_);
  mesh_ = Mesh();
  return out;
}

namespace {

constexpr std::array<Vec2, 4> kQuadUv{Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}};

void addQuad(MeshBuilder& b, const std::array<uint32_t, 4>& ring, bool withUv) {
  b.beginFace();
  b.beginLoop();
  for (size_t i = 0; i < 4; ++i) {
    const uint32_t corner = b.addCorner(ring[i]);
    if (withUv) b.setUv(corner, 0, kQuadUv[i]);
  }
}

}  // namespace

// The rings were measured on the original runtime; its uv coordinates run 0..3 along each ring.
// Only with the bottom as face 0 do all four sides stand upright (u to the right, v up seen from
// outside).
Mesh makeBoxMesh(const Vec3& size, bool withUv) {
  static constexpr std::array<std::array<uint32_t, 4>, 6> kRings{
      {{0, 1, 2, 3}, {7, 6, 5, 4}, {3, 2, 6, 7}, {2, 1, 5, 6}, {1, 0, 4, 5}, {0, 3, 7, 4}}};
  MeshBuilder b;
  for (const double y : {0.0, size.y}) {
    b.addPosition({0, y, 0});
    b.addPosition({size.x, y, 0});
    b.addPosition({size.x, y, size.z});
    b.addPosition({0, y, size.z});
  }
  for (const auto& ring : kRings) addQuad(b, ring, withUv);
  return b.take();
}

Mesh makeQuadMesh(double w, double h, QuadPlane plane, bool withUv) {
  MeshBuilder b;
  // The ring runs along +x first and counter-clockwise seen from the normal's side.
  const auto at = [&](double u, double v) {
    return plane == QuadPlane::Xy ? Vec3{u * w, v * h, 0} : Vec3{u * w, 0, (1 - v) * h};
  };
  for (const Vec2 uv : kQuadUv) b.addPosition(at(uv.x, uv.y));
  addQuad(b, {0, 1, 2, 3}, withUv);
  return b.take();
}

}  // namespace gable
