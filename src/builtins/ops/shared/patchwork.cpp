// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/patchwork.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/work.h"
#include "builtins/ops/shared/face_plan.h"
#include "geom/mesh/face_plane.h"

namespace gable {

namespace {

bool before(const PatchEdge& a, const PatchEdge& b) {
  return std::pair{a.from, a.to} < std::pair{b.from, b.to};
}

// Edges with their opposite taken away, one for one; sorted by their starts.
std::vector<PatchEdge> withoutOpposites(std::vector<PatchEdge> edges) {
  std::stable_sort(edges.begin(), edges.end(), before);
  std::vector<bool> gone(edges.size(), false);
  for (size_t i = 0; i < edges.size(); ++i) {
    work();
    if (gone[i]) continue;
    const PatchEdge twin{edges[i].to, edges[i].from};
    auto at = std::lower_bound(edges.begin(), edges.end(), twin, before);
    for (; at != edges.end() && at->from == twin.from && at->to == twin.to; ++at) {
      const auto k = static_cast<size_t>(at - edges.begin());
      if (gone[k] || k == i) continue;
      gone[i] = gone[k] = true;
      break;
    }
  }
  std::vector<PatchEdge> kept;
  for (size_t i = 0; i < edges.size(); ++i) {
    work();
    if (!gone[i]) kept.push_back(edges[i]);
  }
  return kept;
}

// Grows with the turn to the left: from -2 (back) through 0 (straight on) to 2.
double turnOf(Vec2 in, Vec2 out) {
  const double sine = cross(in, out), cosine = dot(normalized(in), normalized(out));
  return sine >= 0 ? 1 - cosine : cosine - 1;
}

// Follows edges to loops. From a point where more than one goes on, the one that turns farthest to
// the left does, which keeps polygons that touch apart.
std::vector<PatchLoop> chained(const std::vector<PatchEdge>& edges, std::span<const Vec2> points) {
  std::vector<bool> used(edges.size(), false);
  const auto following = [&](size_t i) {
    const Vec2 in = points[edges[i].to] - points[edges[i].from];
    auto at = std::lower_bound(edges.begin(), edges.end(), PatchEdge{edges[i].to, 0}, before);
    size_t best = edges.size();
    double bestTurn = 0;
    for (; at != edges.end() && at->from == edges[i].to; ++at) {
      work();
      const auto k = static_cast<size_t>(at - edges.begin());
      if (used[k]) continue;
      const double turn = turnOf(in, points[at->to] - points[at->from]);
      if (best != edges.size() && turn <= bestTurn) continue;
      best = k;
      bestTurn = turn;
    }
    return best;
  };
  std::vector<PatchLoop> loops;
  for (size_t first = 0; first < edges.size(); ++first) {
    work();
    if (used[first]) continue;
    PatchLoop loop;
    size_t i = first;
    while (i < edges.size()) {
      work();
      used[i] = true;
      loop.push_back(edges[i]);
      if (edges[i].to == edges[first].from) break;
      i = following(i);
    }
    if (i < edges.size()) loops.push_back(std::move(loop));
  }
  return loops;
}

Ring ringOf(const PatchLoop& loop, std::span<const Vec2> points) {
  Ring r;
  for (const PatchEdge& e : loop) r.push_back(points[e.from]);
  return r;
}

// Whether a loop that does not cross a ring lies in it; points on the ring do not tell.
bool liesIn(const Ring& ring, const Ring& loop) {
  for (const Vec2 p : loop) {
    const Where where = locate(ring, p);
    if (where != Where::Boundary) return where == Where::Inside;
  }
  return false;
}

}  // namespace

std::vector<Patch> patchesOf(std::vector<PatchEdge> edges, std::span<const Vec2> points) {
  std::vector<Patch> patches;
  std::vector<Ring> outers;
  std::vector<std::pair<PatchLoop, Ring>> holes;
  for (PatchLoop& loop : chained(withoutOpposites(std::move(edges)), points)) {
    Ring ring = ringOf(loop, points);
    const double area = signedArea(ring);
    const Vec2 size = bounds(ring).size();
    // What rounding left between two edges.
    if (loop.size() < 3 || std::fabs(area) < 1e-10 * dot(size, size)) continue;
    const auto first =
        std::min_element(loop.begin(), loop.end(),
                         [](const PatchEdge& a, const PatchEdge& b) { return a.order < b.order; });
    std::rotate(loop.begin(), first, loop.end());
    if (area < 0) {
      holes.emplace_back(std::move(loop), std::move(ring));
      continue;
    }
    patches.push_back({{std::move(loop)}});
    outers.push_back(std::move(ring));
  }
  for (auto& [loop, ring] : holes) {
    size_t owner = patches.size();
    double least = 0;
    for (size_t p = 0; p < outers.size(); ++p) {
      work();
      const double area = signedArea(outers[p]);
      if (owner < patches.size() && area >= least) continue;
      if (!liesIn(outers[p], ring)) continue;
      owner = p;
      least = area;
    }
    if (owner < patches.size()) patches[owner].loops.push_back(std::move(loop));
  }
  std::stable_sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) {
    return a.loops[0][0].order < b.loops[0][0].order;
  });
  return patches;
}

PatchPlane::PatchPlane(const Mesh& m, size_t face)
    : mesh_(m), face_(face), frame_(planFrame(m, face)), polygon_(facePolygon(m, face, frame_)) {
  uv_.resize(static_cast<size_t>(m.setCount()));
  for (int set = 0; set < m.setCount(); ++set) {
    if (m.hasUv(set)) fit(set);
  }
}

uint32_t PatchPlane::cornerOf(size_t ring, size_t edge) const {
  return mesh_.loopsOf(face_)[ring].firstCorner + static_cast<uint32_t>(edge);
}

void PatchPlane::addCorner(uint32_t corner, Vec2 at) {
  const uint32_t tags = mesh_.vertexTagsAt(mesh_.corners[corner]);
  if (tags != 0) {
    pointTags.resize(points.size());
    pointTags.push_back(tags);
  }
  points.push_back(at);
}

// From the triangle of the outer loop with the largest area.
void PatchPlane::fit(int set) {
  const Ring& r = polygon_.outer;
  const auto& uvs = mesh_.set(set);
  double best = 0;
  for (size_t i = 1; i + 1 < r.size(); ++i) {
    work();
    const Vec2 a = r[i] - r[0], b = r[i + 1] - r[0];
    const double det = cross(a, b);
    if (std::fabs(det) <= best) continue;
    best = std::fabs(det);
    const Vec2 origin = uvs[cornerOf(0, 0)];
    const Vec2 da = uvs[cornerOf(0, i)] - origin, db = uvs[cornerOf(0, i + 1)] - origin;
    // d(uv)/dx and d(uv)/dy solve a.x * dx + a.y * dy = da, and the same for b.
    Affine& f = uv_[static_cast<size_t>(set)];
    f.x = (da * b.y - db * a.y) * (1 / det);
    f.y = (db * a.x - da * b.x) * (1 / det);
    f.origin = origin - f.x * r[0].x - f.y * r[0].y;
  }
}

Vec2 PatchPlane::uvAt(int set, Vec2 p) const {
  return uv_[static_cast<size_t>(set)].origin + uvAlong(set, p);
}

Vec2 PatchPlane::uvAlong(int set, Vec2 direction) const {
  const Affine& f = uv_[static_cast<size_t>(set)];
  return f.x * direction.x + f.y * direction.y;
}

Mesh meshOfPatches(const Mesh& from, std::span<const PatchFace> faces) {
  MeshBuilder b;
  std::map<const PatchPlane*, std::vector<uint32_t>> numbers;
  for (const PatchFace& face : faces) {
    const PatchPlane& plane = *face.plane;
    std::vector<uint32_t>& number = numbers[&plane];
    number.resize(plane.points.size(), MeshBuilder::kNoPosition);
    b.beginFace(from.faces[plane.face()].materialSlot, face.tags);
    for (const PatchLoop& loop : face.patch.loops) {
      b.beginLoop();
      const size_t n = loop.size();
      for (size_t i = 0; i < n; ++i) {
        work();
        const PatchEdge& edge = loop[face.turned ? (n - i) % n : i];
        const PatchEdge& tagged = loop[face.turned ? n - 1 - i : i];
        uint32_t& position = number[edge.from];
        const Vec2 at = plane.points[edge.from];
        if (position == MeshBuilder::kNoPosition) {
          const uint32_t tags = edge.from < plane.pointTags.size() ? plane.pointTags[edge.from] : 0;
          position = b.addPosition(fromPlanFrame(plane.frame(), at), tags);
        }
        const uint32_t corner = b.addCorner(position, tagged.tags);
        for (int set = 0; set < from.setCount(); ++set) {
          if (from.hasUv(set)) b.setUv(corner, set, plane.uvAt(set, at));
        }
      }
    }
  }
  return b.take();
}

}  // namespace gable
