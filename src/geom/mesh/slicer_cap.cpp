// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Caps: after a cut, the edges in its plane that only one face of a side uses bound the opening.
// They are linked, turned round, into loops (at a point of several, the sharpest left turn keeps
// loops apart) and nested into faces with holes. Only components that were closed before take part.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/mesh/slicer.h"
#include "geom/mesh/topology.h"

namespace gable::slicing {
namespace {

struct DirectedEdge {
  uint32_t low, high;
  bool forward;
  bool operator<(const DirectedEdge& o) const {
    if (low != o.low) return low < o.low;
    return high < o.high;
  }
};

// Grows with the angle from `in` to `next`, from -2 (a turn back to the right) to 2 (to the left).
double turnKey(Vec2 in, Vec2 next) {
  const double c = cross(in, next), d = dot(in, next);
  const double reach = std::fabs(c) + std::fabs(d);
  const double opening = reach > 0 ? 1 - d / reach : 0;
  return c >= 0 ? opening : -opening;
}

}  // namespace

std::vector<bool> facesOfClosedComponents(const Mesh& m) {
  const Topology t(m);
  std::vector<bool> closed;
  for (const uint32_t c : t.components()) closed.push_back(t.componentEncloses(c));
  return closed;
}

void Slicer::cap(std::span<const double> cuts, std::vector<std::vector<Piece>>& slabs) {
  const std::vector<bool> closed = facesOfClosedComponents(mesh_);
  const Vec3 normal = normalized(direction_);
  for (size_t k = 0; k < cuts.size(); ++k) {
    cut_ = cuts[k];
    capSide(closed, normal, slabs[k]);
    capSide(closed, -normal, slabs[k + 1]);
  }
}

std::vector<Slicer::CapEdge> Slicer::openEdges(const std::vector<Piece>& pieces,
                                               const std::vector<bool>& closed) const {
  std::vector<DirectedEdge> edges;
  for (const Piece& piece : pieces) {
    if (piece.source == MeshPart::kNone || !closed[piece.source]) continue;
    for (const cut::Loop& loop : piece.face) {
      work(loop.size());
      for (size_t i = 0; i < loop.size(); ++i) {
        const cut::Corner& a = loop[i];
        const cut::Corner& b = loop[(i + 1) % loop.size()];
        if (!onCut(a.attributes) || !onCut(b.attributes)) continue;
        edges.push_back(
            {std::min(a.point, b.point), std::max(a.point, b.point), a.point < b.point});
      }
    }
  }
  std::stable_sort(edges.begin(), edges.end());
  std::vector<CapEdge> out;
  for (size_t i = 0, end = 0; i < edges.size(); i = end) {
    int balance = 0;
    for (; end < edges.size() && !(edges[i] < edges[end]); ++end)
      balance += edges[end].forward ? 1 : -1;
    for (int k = balance; k > 0; --k) out.push_back({edges[i].high, edges[i].low});
    for (int k = balance; k < 0; ++k) out.push_back({edges[i].low, edges[i].high});
  }
  return out;
}

std::vector<cut::Loop> Slicer::linkLoops(const std::vector<CapEdge>& edges,
                                         uint32_t attributes) const {
  std::vector<CapEdge> sorted = edges;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const CapEdge& a, const CapEdge& b) { return a.from < b.from; });
  std::vector<bool> used(sorted.size());
  const auto placeOf = [&](uint32_t point) { return place({point, attributes, 0}); };
  // The unused edge from `at` that turns left the most, coming from `before`.
  const auto sharpestLeft = [&](uint32_t before, uint32_t at) {
    size_t best = sorted.size();
    double bestTurn = 0;
    const Vec2 in = placeOf(at) - placeOf(before);
    auto it = std::lower_bound(sorted.begin(), sorted.end(), at,
                               [](const CapEdge& e, uint32_t p) { return e.from < p; });
    for (; it != sorted.end() && it->from == at; ++it) {
      const auto i = static_cast<size_t>(it - sorted.begin());
      if (used[i]) continue;
      const Vec2 next = placeOf(it->to) - placeOf(at);
      const double turn = turnKey(in, next);
      if (best == sorted.size() || turn > bestTurn) {
        best = i;
        bestTurn = turn;
      }
    }
    return best;
  };
  std::vector<cut::Loop> loops;
  for (size_t first = 0; first < sorted.size(); ++first) {
    work();
    if (used[first]) continue;
    cut::Loop loop;
    size_t e = first;
    bool isClosed = false;
    while (e < sorted.size() && !isClosed) {
      work();
      used[e] = true;
      loop.push_back({sorted[e].from, attributes, MeshPart::kNone});
      isClosed = sorted[e].to == sorted[first].from;
      if (!isClosed) e = sharpestLeft(sorted[e].from, sorted[e].to);
    }
    if (isClosed) loops.push_back(std::move(loop));
  }
  return loops;
}

// The vertices of a cap are those of the faces around it, and have their notes.
void Slicer::giveNotes(const std::vector<Piece>& pieces, std::vector<cut::Face>& caps) {
  std::unordered_map<uint32_t, uint32_t> like;
  for (const Piece& piece : pieces) {
    for (const cut::Loop& loop : piece.face) {
      work(loop.size());
      for (const cut::Corner& c : loop) like.try_emplace(c.point, c.attributes);
    }
  }
  for (cut::Face& face : caps) {
    for (cut::Loop& loop : face) {
      for (cut::Corner& c : loop) {
        work(sets_.size());
        const auto from = like.find(c.point);
        if (from == like.end()) continue;
        values_.push_back(values_[c.attributes]);
        for (size_t s = 0; s < sets_.size(); ++s) {
          if (sets_[s].empty()) continue;
          const Vec2 value = sets_[s][s < kUvSets ? c.attributes : from->second];
          sets_[s].push_back(value);
        }
        if (!normals_.empty()) {
          const Vec3 normal = normals_[c.attributes];
          normals_.push_back(normal);
        }
        c.attributes = static_cast<uint32_t>(values_.size() - 1);
      }
    }
  }
}

void Slicer::capSide(const std::vector<bool>& closed, const Vec3& normal,
                     std::vector<Piece>& pieces) {
  const std::vector<CapEdge> edges = openEdges(pieces, closed);
  if (edges.empty()) return;
  const Frame plane = frameFromZ(points_[edges[0].from], normal, Vec3{1, 0, 0});
  origin_ = plane.origin;
  along_ = plane.x;
  up_ = plane.y;
  const auto attributes = static_cast<uint32_t>(values_.size());
  values_.push_back(cut_);
  for (auto& set : sets_) {
    if (!set.empty()) set.push_back({});
  }
  if (!normals_.empty()) normals_.push_back(normal);
  std::vector<cut::Face> caps;
  cut::nestLoops(linkLoops(edges, attributes), *this, caps);
  if (!mesh_.notes.empty()) giveNotes(pieces, caps);
  for (cut::Face& f : caps) pieces.push_back({std::move(f), MeshPart::kNone});
}

}  // namespace gable::slicing
