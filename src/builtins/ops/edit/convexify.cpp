// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each concave face is triangulated; then the diagonals are taken away again, the longest first, as
// long as what they part is convex together (Hertel and Mehlhorn). At most four times as many parts
// come out as there have to be, mostly no more.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/patchwork.h"
#include "geom/mesh/topology.h"
#include "geom/region/triangulate.h"
#include "math/predicates.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Diagonal {
  uint32_t from, to;
  uint32_t left, right;
  double length;
};

class Convexifier {
 public:
  Convexifier(const Mesh& m, size_t face, double maxLength)
      : mesh_(m), plane_(m, face), maxLength_(maxLength) {
    const Polygon& p = plane_.polygon();
    uint32_t first = 0;
    for (size_t r = 0; r <= p.holes.size(); ++r) {
      const Ring& ring = r == 0 ? p.outer : p.holes[r - 1];
      const auto n = static_cast<uint32_t>(ring.size());
      for (uint32_t i = 0; i < n; ++i) {
        work();
        const uint32_t corner = plane_.cornerOf(r, i);
        plane_.addCorner(corner, ring[i]);
        const uint32_t tags = m.edgeTagsAt(corner);
        outline_.push_back({first + i, first + (i + 1) % n, tags, first + i});
      }
      first += n;
    }
    triangles_ = triangulate(p);
    findDiagonals();
  }

  void run(std::vector<PatchFace>& out) {
    group_.resize(triangles_.size());
    for (uint32_t t = 0; t < group_.size(); ++t) group_[t] = t;
    for (const Triangle& t : triangles_) rings_.push_back({t[0], t[1], t[2]});
    for (const Diagonal& d : diagonals_) {
      work();
      const uint32_t a = find(d.left), b = find(d.right);
      if (a == b) continue;
      std::vector<uint32_t> ring = united(rings_[a], rings_[b], d);
      if (d.length <= maxLength_ && !isConvex(ring)) continue;
      group_[std::max(a, b)] = std::min(a, b);
      rings_[std::min(a, b)] = std::move(ring);
    }
    for (uint32_t g = 0; g < group_.size(); ++g) {
      if (find(g) == g) addGroup(g, out);
    }
  }

  const PatchPlane& plane() const { return plane_; }

 private:
  uint32_t find(uint32_t t) {
    while (group_[t] != t) t = group_[t] = group_[group_[t]];
    return t;
  }

  void findDiagonals() {
    std::vector<std::array<uint32_t, 3>> edges;
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      work();
      for (size_t i = 0; i < 3; ++i) {
        edges.push_back({triangles_[t][i], triangles_[t][(i + 1) % 3], t});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [a, b, t] : edges) {
      if (a > b) continue;
      const auto twin = std::lower_bound(edges.begin(), edges.end(), std::array<uint32_t, 3>{b, a});
      if (twin == edges.end() || (*twin)[0] != b || (*twin)[1] != a) continue;
      diagonals_.push_back({a, b, t, (*twin)[2], length(plane_.points[b] - plane_.points[a])});
    }
    std::stable_sort(diagonals_.begin(), diagonals_.end(),
                     [](const Diagonal& a, const Diagonal& b) { return a.length > b.length; });
  }

  // The ring of two parts without the diagonal: from its end round the left part to its start, and
  // round the right part back.
  static std::vector<uint32_t> united(const std::vector<uint32_t>& left,
                                      const std::vector<uint32_t>& right, const Diagonal& d) {
    std::vector<uint32_t> ring;
    const auto takeFrom = [&](const std::vector<uint32_t>& part, uint32_t from, uint32_t to) {
      size_t i = 0;
      while (i < part.size() && !(part[i] == from && part[(i + 1) % part.size()] == to)) ++i;
      for (size_t k = 1; k < part.size(); ++k) ring.push_back(part[(i + k) % part.size()]);
    };
    takeFrom(left, d.from, d.to);
    takeFrom(right, d.to, d.from);
    return ring;
  }

  bool isConvex(const std::vector<uint32_t>& ring) const {
    const size_t n = ring.size();
    for (size_t i = 0; i < n; ++i) {
      work();
      const Vec2 a = plane_.points[ring[i]], b = plane_.points[ring[(i + 1) % n]],
                 c = plane_.points[ring[(i + 2) % n]];
      if (orientation(a, b, c) < 0) return false;
    }
    return true;
  }

  // Cancelling the triangles' edges keeps holes that a group runs round.
  void addGroup(uint32_t group, std::vector<PatchFace>& out) {
    std::vector<PatchEdge> edges;
    for (uint32_t t = 0; t < triangles_.size(); ++t) {
      work();
      if (find(t) != group) continue;
      for (size_t i = 0; i < 3; ++i) {
        edges.push_back(edgeOf(triangles_[t][i], triangles_[t][(i + 1) % 3]));
      }
    }
    const uint32_t tags = mesh_.faces[plane_.face()].tags;
    for (Patch& p : patchesOf(std::move(edges), plane_.points)) {
      out.push_back({&plane_, std::move(p), tags});
    }
  }

  // With the tags of the face's edge, where it is one.
  PatchEdge edgeOf(uint32_t from, uint32_t to) const {
    if (from < outline_.size() && outline_[from].to == to) return outline_[from];
    return {from, to, 0, std::numeric_limits<uint32_t>::max()};
  }

  const Mesh& mesh_;
  PatchPlane plane_;
  double maxLength_;
  std::vector<PatchEdge> outline_;
  std::vector<Triangle> triangles_;
  std::vector<Diagonal> diagonals_;
  std::vector<uint32_t> group_;
  std::vector<std::vector<uint32_t>> rings_;
};

struct Convexify {
  std::optional<double> maxLength;
};

Status applyConvexify(OpCall& call, const Convexify& args) {
  Shape& s = call.shape();
  const double maxLength = args.maxLength.value_or(std::numeric_limits<double>::infinity());
  if (s.geometry.kind != GeometryKind::Mesh) return {};
  const MeshRef mesh = meshInScope(s);
  if (!isConcave(*mesh)) return {};
  Mesh out;
  MeshBuilder kept;
  std::vector<uint32_t> map;
  // Convex faces stay as they are; parts of concave ones share points among themselves.
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{} || !isConcave(*mesh, f)) {
      kept.copyFace(*mesh, f, map);
      continue;
    }
    append(out, kept.take());
    map.clear();
    Convexifier one(*mesh, f, maxLength);
    std::vector<PatchFace> faces;
    one.run(faces);
    append(out, meshOfPatches(*mesh, faces));
  }
  append(out, kept.take());
  setMesh(s, std::move(out), ScopeFit::Keep);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Convexify::maxLength>("maxLength", "Cuts longer than this are not made, in metres.",
                                 "of any length")
        .above(0),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    heavy({"convexify", "edit", "Cuts concave faces into convex ones.", kSignatures,
           typed<applyConvexify>}),
};

}  // namespace

extern const OpList kOps_convexify;
const OpList kOps_convexify = kSpecs;

}  // namespace gable
