// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The weighted straight skeleton, cut off at height 1, with distances as weights: an edge's face is
// its strip. Edges that stand still have upright faces, which have no area in the plane but carry
// the outline of the remainder from the height of the face to that of the cut. So the remainder is
// the face's outline less those of all skeleton faces, edge by edge.
#include "builtins/ops/shared/set_back.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/skeleton/skeleton.h"

namespace gable {

namespace {

constexpr double kTop = 1 - 1e-9;

}  // namespace

SetBack::SetBack(const Mesh& m, const Services& services, bool tagged)
    : mesh_(m), tags_(services, "setback"), tagged_(tagged) {}

Status SetBack::addFace(size_t face, std::span<const double> distance,
                        std::span<const uint32_t> group) {
  Work w;
  w.plane = std::make_unique<PatchPlane>(mesh_, face);
  const Polygon& polygon = w.plane->polygon();
  std::vector<std::vector<double>> weights;
  bool moves = false;
  for (size_t r = 0; r <= polygon.holes.size(); ++r) {
    const Ring& ring = r == 0 ? polygon.outer : polygon.holes[r - 1];
    weights.emplace_back();
    for (size_t i = 0; i < ring.size(); ++i) {
      work();
      const uint32_t corner = w.plane->cornerOf(r, i);
      const bool moved = group[corner] != kNoGroup && distance[corner] > 0;
      weights[r].push_back(moved ? distance[corner] : 0);
      moves |= moved;
      w.corner.push_back(corner);
      w.plane->addCorner(corner, ring[i]);
    }
  }
  w.inputCount = static_cast<uint32_t>(w.corner.size());
  if (moves) {
    const Skeleton skeleton = buildSkeleton(polygon, weights, 1);
    if (!skeleton.status.ok()) return skeleton.status;
    for (size_t v = w.inputCount; v < skeleton.vertices.size(); ++v) {
      w.plane->points.push_back(skeleton.vertices[v].xy);
    }
    for (const SkeletonVertex& v : skeleton.vertices) w.height.push_back(v.height);
    for (const SkeletonFace& f : skeleton.faces) {
      work(4);
      if (f.loop.empty()) continue;
      Strip s;
      s.corner = w.plane->cornerOf(f.ring, f.edge);
      s.kind = f.step ? 1 : weights[f.ring][f.edge] > 0 ? 0 : 2;
      if (s.kind == 0) s.group = group[s.corner];
      s.loop = f.loop;
      s.holes = f.holes;
      w.strips.push_back(std::move(s));
    }
  }
  work_.push_back(std::move(w));
  return {};
}

// An edge that starts or ends at a vertex of the face takes the tags of the vertex.
uint32_t SetBack::sideTags(const Work& w, const PatchEdge& e) {
  const uint32_t side = tagged_ ? tags_.with(0, "side") : 0;
  const uint32_t vertex = std::min(e.from, e.to);
  if (vertex >= w.inputCount || std::max(e.from, e.to) < w.inputCount) return side;
  return tags_.merged(side, mesh_.vertexTagsAt(mesh_.corners[w.corner[vertex]]));
}

// The edges of a strip with the tags that they have in it.
void SetBack::addEdges(const Work& w, const Strip& s, const std::vector<uint32_t>& loop,
                       std::vector<PatchEdge>& out) {
  const size_t n = loop.size();
  for (size_t i = 0; i < n; ++i) {
    work();
    PatchEdge e{loop[i], loop[(i + 1) % n], 0, 4 * s.corner};
    const bool low = w.height[e.from] == 0 && w.height[e.to] == 0;
    const bool high = w.height[e.from] >= kTop && w.height[e.to] >= kTop;
    if (low) {
      e.tags = tagged(s.corner, "front");
    } else if (high && s.kind == 0) {
      e.tags = tagged(s.corner, "back");
      e.order += 2;
    } else {
      e.tags = sideTags(w, e);
      e.order += 3;
    }
    out.push_back(e);
  }
}

std::vector<PatchFace> SetBack::strips(uint32_t group) {
  std::vector<PatchFace> out;
  for (const Work& w : work_) {
    std::vector<PatchEdge> edges;
    for (const Strip& s : w.strips) {
      if (s.group != group) continue;
      addEdges(w, s, s.loop, edges);
      for (const auto& hole : s.holes) addEdges(w, s, hole, edges);
    }
    for (Patch& p : patchesOf(std::move(edges), w.plane->points)) {
      out.push_back({w.plane.get(), std::move(p), mesh_.faces[w.plane->face()].tags});
    }
  }
  return out;
}

std::vector<PatchEdge> SetBack::faceOutline(const Work& w) {
  std::vector<PatchEdge> edges;
  const Polygon& polygon = w.plane->polygon();
  uint32_t first = 0;
  for (size_t r = 0; r <= polygon.holes.size(); ++r) {
    const auto n =
        static_cast<uint32_t>(r == 0 ? polygon.outer.size() : polygon.holes[r - 1].size());
    for (uint32_t i = 0; i < n; ++i) {
      work();
      const uint32_t corner = w.corner[first + i];
      edges.push_back({first + i, first + (i + 1) % n, tagged(corner, "remainder"), 4 * corner});
    }
    first += n;
  }
  return edges;
}

std::vector<PatchFace> SetBack::remainders() {
  std::vector<PatchFace> out;
  for (const Work& w : work_) {
    std::vector<PatchEdge> edges = faceOutline(w);
    const auto takeAway = [&](const Strip& s, const std::vector<uint32_t>& loop) {
      const size_t n = loop.size();
      for (size_t i = 0; i < n; ++i) {
        PatchEdge e{loop[(i + 1) % n], loop[i], 0, 4 * s.corner};
        e.tags = s.kind == 0   ? tagged(s.corner, "back")
                 : s.kind == 1 ? sideTags(w, e)
                               : tagged(s.corner, "remainder");
        edges.push_back(e);
      }
    };
    for (const Strip& s : w.strips) {
      takeAway(s, s.loop);
      for (const auto& hole : s.holes) takeAway(s, hole);
    }
    for (Patch& p : patchesOf(std::move(edges), w.plane->points)) {
      out.push_back({w.plane.get(), std::move(p), mesh_.faces[w.plane->face()].tags});
    }
  }
  return out;
}

std::vector<PatchFace> SetBack::stripOfEachEdge() {
  std::vector<PatchFace> out;
  for (const Work& w : work_) {
    for (const Strip& s : w.strips) {
      if (s.kind != 0) continue;
      std::vector<PatchEdge> edges;
      addEdges(w, s, s.loop, edges);
      for (const auto& hole : s.holes) addEdges(w, s, hole, edges);
      const uint32_t faceTags = tags_.merged(mesh_.faces[w.plane->face()].tags, tagsOf(s.corner));
      for (Patch& p : patchesOf(std::move(edges), w.plane->points)) {
        out.push_back({w.plane.get(), std::move(p), faceTags});
      }
    }
  }
  return out;
}

}  // namespace gable
