// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Positions, vertices and faces; the union of coplanar faces is in merge_faces.cpp.
#include "geom/mesh/cleanup.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/hash.h"
#include "base/work.h"
#include "geom/mesh/rebuild.h"
#include "math/cell.h"
#include "math/trig.h"

namespace gable {
namespace {

// What a tolerance of zero forgives: rounding. Degrees, and metres on uv and normal coordinates.
constexpr double kAngleSlack = 1e-3;
constexpr double kValueSlack = 1e-5;

uint64_t cellKey(int64_t x, int64_t y, int64_t z) {
  return hashCombine(hashCombine(static_cast<uint64_t>(x), static_cast<uint64_t>(y)),
                     static_cast<uint64_t>(z));
}

// For each position the first one within `distance` of it.
std::vector<uint32_t> representatives(const std::vector<Vec3>& positions, double distance) {
  const double inverse = 1 / std::max(distance, 1e-9);
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells;
  std::vector<uint32_t> out(positions.size());
  for (uint32_t i = 0; i < positions.size(); ++i) {
    work(27);
    const Vec3& p = positions[i];
    const auto x = cellIndex(p.x * inverse);
    const auto y = cellIndex(p.y * inverse);
    const auto z = cellIndex(p.z * inverse);
    uint32_t best = i;
    for (int64_t k = 0; k < 27; ++k) {
      const auto cell = cells.find(cellKey(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1));
      if (cell == cells.end()) continue;
      for (const uint32_t j : cell->second) {
        work();
        if (j < best && length(positions[j] - p) <= distance) best = j;
      }
    }
    out[i] = best;
    if (best == i) cells[cellKey(x, y, z)].push_back(i);
  }
  return out;
}

template <class T>
bool isMiddle(const T& a, const T& b, const T& c, double share) {
  return length(a + (c - a) * share - b) <= kValueSlack;
}

class CollinearFinder {
 public:
  CollinearFinder(const Mesh& m, double angle) : mesh_(m), angle_(angle + kAngleSlack) {
    removable_.assign(m.positions.size(), true);
    for (const MeshLoop& loop : m.loops) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const uint32_t c = loop.firstCorner + i;
        if (loop.cornerCount < 3 || m.vertexTagsAt(m.corners[c]) != 0 || !straight(loop, i)) {
          removable_[m.corners[c]] = false;
        }
      }
    }
  }
  bool removable(uint32_t position) const { return removable_[position]; }

 private:
  bool straight(const MeshLoop& loop, uint32_t i) const {
    const uint32_t n = loop.cornerCount;
    const uint32_t a = loop.firstCorner + (i + n - 1) % n, b = loop.firstCorner + i,
                   c = loop.firstCorner + (i + 1) % n;
    const Vec3 in = mesh_.at(b) - mesh_.at(a), out = mesh_.at(c) - mesh_.at(b);
    if (atan2Deg(length(cross(in, out)), dot(in, out)) > angle_) return false;
    if (!mesh_.edgeTags.empty() && mesh_.edgeTags[a] != mesh_.edgeTags[b]) return false;
    const double whole = length(in) + length(out);
    const double share = whole > 0 ? length(in) / whole : 0;
    for (const auto& set : mesh_.uvs) {
      if (!set.empty() && !isMiddle(set[a], set[b], set[c], share)) return false;
    }
    return mesh_.normals.empty() ||
           isMiddle(mesh_.normals[a], mesh_.normals[b], mesh_.normals[c], share);
  }

  const Mesh& mesh_;
  double angle_;
  std::vector<bool> removable_;
};

// The positions of a face's loops, each from its smallest on: equal for copies.
std::vector<uint32_t> signature(const Mesh& m, size_t face) {
  std::vector<uint32_t> out;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    const auto corners = m.cornersOf(loop);
    const auto first =
        static_cast<size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
    out.push_back(0xffffffff);
    for (size_t i = 0; i < corners.size(); ++i)
      out.push_back(corners[(first + i) % corners.size()]);
  }
  return out;
}

FaceSources composed(const FaceSources& outer, const FaceSources& inner) {
  FaceSources out;
  for (const uint32_t f : outer) out.push_back(inner[f]);
  return out;
}

}  // namespace

FaceSources mergePositions(Mesh& m, double distance) {
  const std::vector<uint32_t> to = representatives(m.positions, distance);
  for (uint32_t& p : m.corners) p = to[p];
  // A vertex without tags takes those of the first that it is united with.
  for (uint32_t p = 0; p < m.vertexTags.size(); ++p) {
    if (m.vertexTags[p] != 0 && m.vertexTags[to[p]] == 0) m.vertexTags[to[p]] = m.vertexTags[p];
  }
  FaceSources sources;
  Rebuild r(m);
  for (uint32_t f = 0; f < m.faces.size(); ++f) {
    work(4);
    std::vector<std::vector<uint32_t>> loops;
    bool lost = false;
    for (const MeshLoop& loop : m.loopsOf(f)) {
      std::vector<uint32_t> kept;
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const uint32_t c = loop.firstCorner + i;
        if (kept.empty() || m.corners[kept.back()] != m.corners[c]) {
          kept.push_back(c);
        } else {
          r.setEdge(kept.back(), c);
        }
      }
      while (kept.size() > 1 && m.corners[kept.back()] == m.corners[kept[0]]) kept.pop_back();
      const bool collapsed = kept.size() < std::min(loop.cornerCount, 3u);
      lost = lost || (collapsed && loops.empty());
      if (!collapsed) loops.push_back(std::move(kept));
    }
    if (lost) continue;
    r.addFace(f, loops);
    sources.push_back(f);
  }
  m = r.take();
  return sources;
}

FaceSources removeCollinearVertices(Mesh& m, double angle) {
  const CollinearFinder finder(m, angle);
  FaceSources sources;
  Rebuild r(m);
  for (uint32_t f = 0; f < m.faces.size(); ++f) {
    std::vector<std::vector<uint32_t>> loops;
    for (const MeshLoop& loop : m.loopsOf(f)) {
      work();
      std::vector<uint32_t> kept, all;
      for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
        all.push_back(c);
        if (!finder.removable(m.corners[c])) kept.push_back(c);
      }
      loops.push_back(kept.size() >= 3 ? std::move(kept) : std::move(all));
    }
    r.addFace(f, loops);
    sources.push_back(f);
  }
  m = r.take();
  return sources;
}

bool isDegenerate(const Mesh& m, size_t face, double area) {
  if (m.loopsOf(face)[0].cornerCount < 3) return false;
  Box3 box;
  for (const uint32_t p : m.cornersOf(m.loopsOf(face)[0])) box.include(m.positions[p]);
  const double least = 1e-12 * dot(box.size(), box.size());
  return m.area(face) <= std::max(area, least);
}

namespace {

template <class Drop>
FaceSources keepUnless(Mesh& m, const Drop& drop) {
  FaceSources sources;
  Rebuild r(m);
  for (uint32_t f = 0; f < m.faces.size(); ++f) {
    if (drop(f)) continue;
    r.addFace(f);
    sources.push_back(f);
  }
  m = r.take();
  return sources;
}

}  // namespace

FaceSources dropDuplicateFaces(Mesh& m) {
  std::vector<std::pair<std::vector<uint32_t>, uint32_t>> signatures;
  for (uint32_t f = 0; f < m.faces.size(); ++f) signatures.emplace_back(signature(m, f), f);
  std::sort(signatures.begin(), signatures.end());
  std::vector<bool> dropped(m.faces.size());
  for (size_t i = 1; i < signatures.size(); ++i) {
    if (signatures[i].first == signatures[i - 1].first) dropped[signatures[i].second] = true;
  }
  return keepUnless(m, [&](uint32_t f) { return dropped[f]; });
}

FaceSources dropDegenerateFaces(Mesh& m, double area) {
  return keepUnless(m, [&](uint32_t f) { return isDegenerate(m, f, area); });
}

FaceSources cleanup(Mesh& m, const CleanupOptions& options) {
  const double t = std::clamp(options.tolerance, 0.0, 1.0);
  FaceSources sources = mergePositions(m, t);
  if (options.faces) sources = composed(dropDuplicateFaces(m), sources);
  if (options.edges) sources = composed(mergeCoplanarFaces(m, 10 * t), sources);
  if (options.faces) sources = composed(dropDegenerateFaces(m, t), sources);
  if (options.vertices) sources = composed(removeCollinearVertices(m, 10 * t), sources);
  return sources;
}

}  // namespace gable
