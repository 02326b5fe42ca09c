// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Measures of a mesh, its hash and its transformation. Newell's sums run relative to a loop's first
// corner, so that a face far from the origin loses no digits.
#include "geom/mesh/mesh.h"

#include <algorithm>

#include "base/hash.h"
#include "base/work.h"
#include "geom/mesh/untagged_hash.h"

namespace gable {
namespace {

Vec3 loopAreaNormal(const Mesh& m, const MeshLoop& loop) {
  Vec3 sum;
  const Vec3 origin = m.at(loop.firstCorner);
  for (uint32_t i = 1; i + 1 < loop.cornerCount; ++i) {
    sum += cross(m.at(loop.firstCorner + i) - origin, m.at(loop.firstCorner + i + 1) - origin);
  }
  return sum;
}

uint64_t hashVec(uint64_t h, Vec2 v) {
  return hashCombine(hashCombine(h, hashDouble(v.x)), hashDouble(v.y));
}

uint64_t hashVec(uint64_t h, const Vec3& v) {
  return hashCombine(hashVec(h, Vec2{v.x, v.y}), hashDouble(v.z));
}

uint64_t hashShape(uint64_t h, const Mesh& m) {
  h = hashCombine(h, m.faces.size());
  for (const MeshFace& f : m.faces) {
    h = hashCombine(h, (static_cast<uint64_t>(f.firstLoop) << 32) | f.loopCount);
    h = hashCombine(h, (static_cast<uint64_t>(f.materialSlot) << 1) | (f.smooth ? 1 : 0));
  }
  h = hashCombine(h, m.loops.size());
  for (const MeshLoop& l : m.loops) {
    h = hashCombine(h, (static_cast<uint64_t>(l.firstCorner) << 32) | l.cornerCount);
  }
  h = hashCombine(h, m.corners.size());
  for (const uint32_t c : m.corners) h = hashCombine(h, c);
  return h;
}

// Of the numbers of tag sets of faces, edges and vertices; 0 where there are none.
uint64_t hashTags(const Mesh& m) {
  uint64_t h = 0, any = m.edgeTags.size() + m.vertexTags.size();
  for (const MeshFace& f : m.faces) {
    h = hashCombine(h, f.tags);
    any |= f.tags;
  }
  h = hashCombine(h, m.edgeTags.size());
  for (const uint32_t t : m.edgeTags) h = hashCombine(h, t);
  for (const uint32_t t : m.vertexTags) h = hashCombine(h, t);
  return any == 0 ? 0 : h;
}

template <class T>
void reverseKeepingFirst(std::vector<T>& v, const MeshLoop& loop) {
  if (v.empty() || loop.cornerCount == 0) return;
  const auto begin = v.begin() + loop.firstCorner;
  std::reverse(begin + 1, begin + loop.cornerCount);
}

// Edges follow their two ends: after the turn the edge at the first corner is the former last one.
void reverseEdges(std::vector<uint32_t>& v, const MeshLoop& loop) {
  if (v.empty()) return;
  const auto begin = v.begin() + loop.firstCorner;
  std::reverse(begin, begin + loop.cornerCount);
}

Vec3 scaledNormal(const Vec3& n, const Vec3& s) {
  const auto sign = [](double v) { return v < 0 ? -1.0 : 1.0; };
  // The inverse transpose times |det|, which stays finite for flattening scales.
  const Vec3 t = normalized(Vec3{n.x * sign(s.x) * std::fabs(s.y * s.z),
                                 n.y * sign(s.y) * std::fabs(s.x * s.z),
                                 n.z * sign(s.z) * std::fabs(s.x * s.y)});
  return t == Vec3{} ? n : t;
}

}  // namespace

Vec3 Mesh::areaNormal(size_t face) const { return loopAreaNormal(*this, loopsOf(face)[0]); }

double Mesh::area(size_t face) const {
  double a = 0;
  bool outer = true;
  for (const MeshLoop& loop : loopsOf(face)) {
    const double part = length(loopAreaNormal(*this, loop)) / 2;
    a += outer ? part : -part;
    outer = false;
  }
  return a;
}

double Mesh::area() const {
  double a = 0;
  for (size_t f = 0; f < faces.size(); ++f) a += area(f);
  return a;
}

Box3 Mesh::bounds() const {
  Box3 b;
  for (const Vec3& p : positions) b.include(p);
  return b;
}

uint64_t Mesh::contentHash() const {
  uint64_t h = hashCombine(0, positions.size());
  for (const Vec3& p : positions) h = hashVec(h, p);
  h = hashShape(h, *this);
  for (int s = 0; s < setCount(); ++s) {
    h = hashCombine(h, set(s).size());
    for (const Vec2 uv : set(s)) h = hashVec(h, uv);
  }
  h = hashCombine(h, normals.size());
  for (const Vec3& n : normals) h = hashVec(h, n);
  // Such that untaggedHash() can take the tags out again.
  return h ^ hashTags(*this);
}

uint64_t untaggedHash(const Mesh& mesh) { return (mesh.sharedHash() ^ hashTags(mesh)) | 1; }

bool Mesh::valid() const {
  for (const MeshFace& f : faces) {
    if (f.loopCount == 0 || uint64_t{f.firstLoop} + f.loopCount > loops.size()) return false;
  }
  for (const MeshLoop& l : loops) {
    if (l.cornerCount == 0 || uint64_t{l.firstCorner} + l.cornerCount > corners.size())
      return false;
  }
  for (const uint32_t c : corners) {
    if (c >= positions.size()) return false;
  }
  for (const Vec3& p : positions) {
    if (!isFinite(p)) return false;
  }
  for (int s = 0; s < setCount(); ++s) {
    if (hasUv(s) && set(s).size() != corners.size()) return false;
    for (const Vec2 uv : set(s)) {
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return false;
    }
  }
  if (!normals.empty() && normals.size() != corners.size()) return false;
  for (const Vec3& n : normals) {
    if (!isFinite(n)) return false;
  }
  if (vertexTags.size() > positions.size()) return false;
  return edgeTags.empty() || edgeTags.size() == corners.size();
}

void reverseFace(Mesh& m, size_t face) {
  for (const MeshLoop& loop : m.loopsOf(face)) {
    reverseKeepingFirst(m.corners, loop);
    for (int s = 0; s < m.setCount(); ++s) reverseKeepingFirst(m.set(s), loop);
    reverseKeepingFirst(m.normals, loop);
    reverseEdges(m.edgeTags, loop);
    if (m.normals.empty()) continue;
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      m.normals[loop.firstCorner + i] = -m.normals[loop.firstCorner + i];
    }
  }
}

Mesh transformed(const Mesh& m, const Vec3& scale, const Frame& frame) {
  Mesh out = m;
  work(out.positions.size() + out.corners.size());
  for (Vec3& p : out.positions) p = frame.point(scaled(p, scale));
  for (Vec3& n : out.normals) n = frame.direction(scaledNormal(n, scale));
  const bool mirrors = ((scale.x < 0) != (scale.y < 0)) != (scale.z < 0);
  if (!mirrors) return out;
  // Turning a face negates its normals; they have the right side already.
  for (Vec3& n : out.normals) n = -n;
  for (size_t f = 0; f < out.faces.size(); ++f) reverseFace(out, f);
  return out;
}

void append(Mesh& to, const Mesh& from, uint16_t slotOffset) {
  const auto positionBase = static_cast<uint32_t>(to.positions.size());
  const auto cornerBase = static_cast<uint32_t>(to.corners.size());
  const auto loopBase = static_cast<uint32_t>(to.loops.size());
  const size_t cornerTotal = to.corners.size() + from.corners.size();
  const auto appendOptional = [&](auto& a, const auto& b) {
    if (a.empty() && b.empty()) return;
    a.resize(cornerBase);
    a.insert(a.end(), b.begin(), b.end());
    a.resize(cornerTotal);
  };
  const std::vector<Vec2> none;
  to.notes.resize(std::max(to.notes.size(), from.notes.size()));
  for (int s = 0; s < to.setCount(); ++s) {
    appendOptional(to.set(s), s < from.setCount() ? from.set(s) : none);
  }
  appendOptional(to.normals, from.normals);
  appendOptional(to.edgeTags, from.edgeTags);
  if (!from.vertexTags.empty()) {
    to.vertexTags.resize(positionBase);
    to.vertexTags.insert(to.vertexTags.end(), from.vertexTags.begin(), from.vertexTags.end());
  }
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.corners.reserve(cornerTotal);
  work(from.corners.size());
  for (const uint32_t c : from.corners) to.corners.push_back(c + positionBase);
  for (MeshLoop l : from.loops) {
    l.firstCorner += cornerBase;
    to.loops.push_back(l);
  }
  for (MeshFace f : from.faces) {
    f.firstLoop += loopBase;
    f.materialSlot = static_cast<uint16_t>(f.materialSlot + slotOffset);
    to.faces.push_back(f);
  }
}

}  // namespace gable
