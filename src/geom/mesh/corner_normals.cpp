// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/corner_normals.h"

#include <algorithm>
#include <cmath>

namespace gable {
namespace {

// Sums by position over the smooth faces; empty when there are none.
std::vector<Vec3> smoothSums(const Mesh& m) {
  std::vector<Vec3> sums;
  for (size_t f = 0; f < m.faces.size(); ++f) {
    if (!m.faces[f].smooth) continue;
    if (sums.empty()) sums.resize(m.positions.size());
    const Vec3 n = m.areaNormal(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (const uint32_t p : m.cornersOf(loop)) sums[p] += n;
    }
  }
  return sums;
}

}  // namespace

Vec3 unitOf(const Vec3& v) {
  const double most = std::max(std::max(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
  // Squares of such numbers lose no digits.
  if (most > 1e-100 && most < 1e100) {
    const Vec3 plain = normalized(v);
    return isFinite(plain) ? plain : Vec3{};
  }
  if (!(most > 0) || !isFinite(v)) return {};
  return normalized(Vec3{v.x / most, v.y / most, v.z / most});
}

std::vector<Vec3> cornerNormals(const Mesh& m) {
  std::vector<Vec3> out(m.corners.size(), Vec3{0, 1, 0});
  std::vector<Vec3> smooth = smoothSums(m);
  for (Vec3& n : smooth) n = unitOf(n);
  for (size_t f = 0; f < m.faces.size(); ++f) {
    const Vec3 flat = unitOf(m.areaNormal(f));
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
        Vec3 n = m.normals.empty() ? Vec3{} : unitOf(m.normals[c]);
        if (n == Vec3{} && m.faces[f].smooth) n = smooth[m.corners[c]];
        if (n == Vec3{}) n = flat;
        if (n != Vec3{}) out[c] = n;
      }
    }
  }
  return out;
}

}  // namespace gable
