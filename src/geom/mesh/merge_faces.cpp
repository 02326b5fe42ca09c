// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces grow into groups from a seed: a neighbour joins when its normal agrees with the seed's and
// every edge that it shares with the group may go. The outline of a group is found by walking the
// half-edges that stay, around the ones that go; it must be one outer loop and holes.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/mesh/cleanup.h"
#include "geom/mesh/face_plane.h"
#include "geom/mesh/rebuild.h"
#include "geom/mesh/topology.h"
#include "math/trig.h"

namespace gable {
namespace {

constexpr double kAngleSlack = 1e-3;
constexpr double kValueSlack = 1e-5;

// How a uv set changes over a face: the gradients of u and v.
struct UvSlope {
  Vec3 u, v;
};

class FaceMerger {
 public:
  FaceMerger(const Mesh& m, double angle) : mesh_(m), topology_(m), angle_(angle + kAngleSlack) {
    const size_t n = m.faces.size();
    group_.assign(n, kNoGroup);
    for (uint32_t f = 0; f < n; ++f) {
      normals_.push_back(m.normal(f));
      degenerate_.push_back(isDegenerate(m, f));
    }
    for (int s = 0; s < kUvSets; ++s) {
      if (m.hasUv(s)) slopes_.emplace_back(s, slopesOf(m.uvs[static_cast<size_t>(s)]));
    }
  }

  FaceSources run(Rebuild& out) {
    std::vector<std::vector<std::vector<uint32_t>>> outlines(mesh_.faces.size());
    // Faces without a normal seed nothing before all others have grown.
    for (const bool degenerate : {false, true}) {
      for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
        work(2);
        if (group_[f] != kNoGroup || degenerate_[f] != degenerate) continue;
        const std::vector<uint32_t> members = grow(f);
        if (outline(members, outlines[f])) continue;
        // Not one simple face: only the seed is settled, the others may seed groups of their own.
        outlines[f].clear();
        for (const uint32_t g : members) group_[g] = kNoGroup;
        group_[f] = f;
      }
    }
    FaceSources sources;
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      if (group_[f] != f) continue;
      if (outlines[f].empty()) {
        out.addFace(f);
      } else {
        out.addFace(f, outlines[f]);
      }
      sources.push_back(f);
    }
    return sources;
  }

 private:
  static constexpr uint32_t kNoGroup = 0xffffffff;

  std::vector<UvSlope> slopesOf(const std::vector<Vec2>& uv) const {
    std::vector<UvSlope> out;
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      UvSlope slope;
      const Vec2 first = uv[mesh_.loopsOf(f)[0].firstCorner];
      for (const MeshLoop& loop : mesh_.loopsOf(f)) {
        work();
        for (uint32_t i = 0; i < loop.cornerCount; ++i) {
          const uint32_t a = loop.firstCorner + i, b = topology_.next(a);
          const Vec2 middle = (uv[a] + uv[b]) * 0.5 - first;
          const Vec3 outward = cross(mesh_.at(b) - mesh_.at(a), normals_[f]);
          slope.u += outward * middle.x;
          slope.v += outward * middle.y;
        }
      }
      const double area = mesh_.area(f);
      if (area > 0) slope = {slope.u * (1 / area), slope.v * (1 / area)};
      out.push_back(slope);
    }
    return out;
  }

  // The edge may go: nothing that can be seen ends at it.
  bool removable(uint32_t corner) const {
    const uint32_t twin = topology_.twin(corner);
    if (twin == Topology::kNone) return false;
    const MeshFace& f = mesh_.faces[topology_.faceOf(corner)];
    const MeshFace& g = mesh_.faces[topology_.faceOf(twin)];
    if (f.materialSlot != g.materialSlot || f.tags != g.tags || f.smooth != g.smooth) return false;
    if (!mesh_.edgeTags.empty() && (mesh_.edgeTags[corner] != 0 || mesh_.edgeTags[twin] != 0)) {
      return false;
    }
    return sameValues(corner, topology_.next(twin)) && sameValues(topology_.next(corner), twin) &&
           sameSlopes(topology_.faceOf(corner), topology_.faceOf(twin));
  }

  bool sameValues(uint32_t a, uint32_t b) const {
    for (const auto& set : mesh_.uvs) {
      if (!set.empty() && length(set[a] - set[b]) > kValueSlack) return false;
    }
    return mesh_.normals.empty() || length(mesh_.normals[a] - mesh_.normals[b]) <= kValueSlack;
  }

  bool sameSlopes(uint32_t f, uint32_t g) const {
    if (degenerate_[f] || degenerate_[g]) return true;
    const auto close = [&](const Vec3& a, const Vec3& b) {
      // Turning the face bends a gradient as much as it bends the normal.
      const double slack = 1e-3 + 2 * toRadians(angle_);
      return length(a - b) <= slack * std::max(length(a), length(b));
    };
    for (const auto& [set, slopes] : slopes_) {
      if (!close(slopes[f].u, slopes[g].u) || !close(slopes[f].v, slopes[g].v)) return false;
    }
    return true;
  }

  bool agrees(uint32_t seed, uint32_t f) const {
    if (degenerate_[f]) return true;
    const Vec3& a = normals_[seed];
    const Vec3& b = normals_[f];
    return atan2Deg(length(cross(a, b)), dot(a, b)) <= angle_;
  }

  template <class Visit>
  void forCorners(uint32_t face, const Visit& visit) const {
    for (const MeshLoop& loop : mesh_.loopsOf(face)) {
      for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) visit(c);
    }
  }

  std::vector<uint32_t> grow(uint32_t seed) {
    std::vector<uint32_t> members{seed};
    group_[seed] = seed;
    if (degenerate_[seed]) return members;
    for (size_t k = 0; k < members.size(); ++k) {
      work(4);
      const uint32_t member = members[k];
      forCorners(member, [&](uint32_t c) {
        const uint32_t twin = topology_.twin(c);
        if (twin == Topology::kNone) return;
        const uint32_t other = topology_.faceOf(twin);
        if (group_[other] != kNoGroup || !agrees(seed, other) || !mayJoin(seed, other)) return;
        group_[other] = seed;
        members.push_back(other);
      });
    }
    return members;
  }

  bool mayJoin(uint32_t seed, uint32_t face) const {
    bool fits = true;
    forCorners(face, [&](uint32_t c) {
      const uint32_t twin = topology_.twin(c);
      const bool shared = twin != Topology::kNone && group_[topology_.faceOf(twin)] == seed;
      fits = fits && (!shared || removable(c));
    });
    return fits;
  }

  // Both sides belong to the group, so the edge goes. In the seed itself an edge may be met twice.
  bool goes(uint32_t corner) const {
    const uint32_t twin = topology_.twin(corner);
    if (twin == Topology::kNone) return false;
    const uint32_t f = topology_.faceOf(corner), g = topology_.faceOf(twin);
    return group_[f] == group_[g] && group_[f] != kNoGroup && (f != g || removable(corner));
  }

  bool outline(const std::vector<uint32_t>& members, std::vector<std::vector<uint32_t>>& loops) {
    std::vector<uint32_t> stay;
    for (const uint32_t f : members) {
      work();
      forCorners(f, [&](uint32_t c) {
        if (!goes(c)) stay.push_back(c);
      });
    }
    const bool whole = members.size() == 1 && stay.size() == cornerCount(members[0]);
    if (whole || stay.empty()) return false;
    std::sort(stay.begin(), stay.end());
    std::vector<bool> used(stay.size());
    for (size_t i = 0; i < stay.size(); ++i) {
      work();
      if (used[i]) continue;
      std::vector<uint32_t> loop;
      uint32_t c = stay[i];
      do {
        work();
        const auto at = std::lower_bound(stay.begin(), stay.end(), c) - stay.begin();
        used[static_cast<size_t>(at)] = true;
        loop.push_back(c);
        c = topology_.next(c);
        while (goes(c)) c = topology_.next(topology_.twin(c));
      } while (c != stay[i] && loop.size() <= stay.size());
      if (loop.size() < 3 || loop.size() > stay.size()) return false;
      loops.push_back(std::move(loop));
    }
    return putOuterFirst(members[0], loops);
  }

  uint32_t cornerCount(uint32_t face) const {
    uint32_t n = 0;
    for (const MeshLoop& loop : mesh_.loopsOf(face)) n += loop.cornerCount;
    return n;
  }

  bool putOuterFirst(uint32_t seed, std::vector<std::vector<uint32_t>>& loops) const {
    size_t outer = loops.size();
    for (size_t i = 0; i < loops.size(); ++i) {
      work(loops[i].size());
      Vec3 sum;
      const Vec3 origin = mesh_.at(loops[i][0]);
      for (size_t k = 1; k + 1 < loops[i].size(); ++k) {
        sum += cross(mesh_.at(loops[i][k]) - origin, mesh_.at(loops[i][k + 1]) - origin);
      }
      if (repeatsPosition(loops[i])) return false;
      if (dot(sum, normals_[seed]) <= 0) continue;
      if (outer != loops.size()) return false;
      outer = i;
    }
    if (outer == loops.size()) return false;
    std::rotate(loops.begin(), loops.begin() + static_cast<std::ptrdiff_t>(outer),
                loops.begin() + static_cast<std::ptrdiff_t>(outer) + 1);
    return true;
  }

  bool repeatsPosition(const std::vector<uint32_t>& loop) const {
    std::vector<uint32_t> positions;
    for (const uint32_t c : loop) positions.push_back(mesh_.corners[c]);
    std::sort(positions.begin(), positions.end());
    return std::adjacent_find(positions.begin(), positions.end()) != positions.end();
  }

  const Mesh& mesh_;
  Topology topology_;
  double angle_;
  std::vector<uint32_t> group_;
  std::vector<Vec3> normals_;
  std::vector<bool> degenerate_;
  std::vector<std::pair<int, std::vector<UvSlope>>> slopes_;
};

}  // namespace

FaceSources mergeCoplanarFaces(Mesh& m, double angle) {
  Rebuild out(m);
  FaceSources sources = FaceMerger(m, angle).run(out);
  m = out.take();
  return sources;
}

}  // namespace gable
