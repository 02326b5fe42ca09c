// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pieces of a face join by cancelling: an edge that one piece runs forth and another back goes, and
// what is left is linked to loops. Edge roles come from the two faces at an edge.
#include "geom/skeleton/roof_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "base/work.h"

namespace gable::skeleton {

namespace {

// Level, straight and concave are told at this part of the roof's extent.
constexpr double kRoofTolerance = 1e-9;

using HalfEdge = std::pair<uint32_t, uint32_t>;

double areaOf(const Ring& r) {
  double sum = 0;
  for (size_t i = 1; i + 1 < r.size(); ++i) sum += cross(r[i] - r[0], r[i + 1] - r[0]);
  return sum / 2;
}

Vec3 spaceOf(const SkeletonVertex& v) { return {v.xy.x, v.xy.y, v.height}; }

}  // namespace

Vec3 loopNormal(const std::vector<SkeletonVertex>& vertices, const std::vector<uint32_t>& loop) {
  Vec3 n;
  const Vec3 origin = spaceOf(vertices[loop[0]]);
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    work();
    n += cross(spaceOf(vertices[loop[i]]) - origin, spaceOf(vertices[loop[i + 1]]) - origin);
  }
  return normalized(n);
}

Polygon orientedCopy(const Polygon& polygon, std::vector<bool>& reversed) {
  Polygon copy = polygon;
  reversed.assign(polygon.holes.size() + 1, false);
  const auto turn = [&](Ring& r, size_t k) {
    if (r.size() < 3 || (areaOf(r) > 0) == (k == 0)) return;
    // Point 0 stays first, so that edge k becomes edge n - 1 - k.
    std::reverse(r.begin() + 1, r.end());
    reversed[k] = true;
  };
  turn(copy.outer, 0);
  for (size_t k = 0; k < copy.holes.size(); ++k) turn(copy.holes[k], k + 1);
  return copy;
}

void restoreEdgeNumbers(Roof& roof, const Polygon& polygon, const std::vector<bool>& reversed) {
  for (RoofFace& f : roof.faces) {
    if (f.role == RoofRole::Bottom || !reversed[f.ring]) continue;
    const Ring& r = f.ring == 0 ? polygon.outer : polygon.holes[f.ring - 1];
    f.edge = static_cast<uint32_t>(r.size()) - 1 - f.edge;
  }
}

RoofPieces::RoofPieces(const Polygon& polygon) : polygon_(polygon) {
  Box2 box;
  double far = 0;
  for (uint32_t k = 0; k < ringCount(); ++k) {
    firstEdge_.push_back(edgeCount_);
    for (const Vec2 p : ring(k)) {
      vertices_.push_back({p, 0});
      box.include(p);
      far = std::max({far, std::abs(p.x), std::abs(p.y)});
    }
    edgeCount_ += static_cast<uint32_t>(ring(k).size());
  }
  tolerance_ = kRoofTolerance * length(box.size()) + far * 0x1p-50;
  slopes_.resize(edgeCount_);
}

uint32_t RoofPieces::ringOf(uint32_t edgeNumber) const {
  return static_cast<uint32_t>(std::upper_bound(firstEdge_.begin(), firstEdge_.end(), edgeNumber) -
                               firstEdge_.begin() - 1);
}

uint32_t RoofPieces::endOf(uint32_t edgeNumber) const {
  const uint32_t r = ringOf(edgeNumber);
  const auto n = static_cast<uint32_t>(ring(r).size());
  return firstEdge_[r] + (edgeNumber - firstEdge_[r] + 1) % n;
}

uint32_t RoofPieces::addVertex(const SkeletonVertex& v) {
  vertices_.push_back(v);
  return static_cast<uint32_t>(vertices_.size() - 1);
}

void RoofPieces::addSlopePiece(uint32_t edgeNumber, std::vector<uint32_t> loop) {
  slopes_[edgeNumber].push_back(std::move(loop));
}

void RoofPieces::addSide(uint32_t edgeNumber, std::vector<uint32_t> loop) {
  sides_.push_back({edgeNumber, std::move(loop)});
}

/// The pieces of a face as loops, the largest first. False where they do not close.
bool RoofPieces::join(uint32_t edgeNumber, std::vector<std::vector<uint32_t>>& loops) const {
  const auto& pieces = slopes_[edgeNumber];
  loops.clear();
  if (pieces.size() == 1) {
    loops.push_back(pieces[0]);
    return true;
  }
  std::multiset<HalfEdge> edges;
  for (const auto& piece : pieces) {
    for (size_t i = 0; i < piece.size(); ++i) {
      work(4);
      const HalfEdge h{piece[i], piece[(i + 1) % piece.size()]};
      const auto back = edges.find({h.second, h.first});
      if (back != edges.end())
        edges.erase(back);
      else
        edges.insert(h);
    }
  }
  while (!edges.empty()) {
    work();
    std::vector<uint32_t> loop;
    const uint32_t first = edges.begin()->first;
    uint32_t v = first;
    do {
      const auto next = edges.lower_bound({v, 0});
      if (next == edges.end() || next->first != v) return false;
      loop.push_back(v);
      v = next->second;
      edges.erase(next);
    } while (v != first);
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  const auto planArea = [&](const std::vector<uint32_t>& l) {
    double sum = 0;
    for (size_t i = 1; i + 1 < l.size(); ++i) {
      sum += cross(vertices_[l[i]].xy - vertices_[l[0]].xy,
                   vertices_[l[i + 1]].xy - vertices_[l[0]].xy);
    }
    return sum;
  };
  std::stable_sort(loops.begin(), loops.end(),
                   [&](const auto& a, const auto& b) { return planArea(a) > planArea(b); });
  return !loops.empty();
}

void RoofPieces::assignRoles(Roof& roof) const {
  std::map<HalfEdge, std::pair<size_t, Vec3>> faceAt;
  for (size_t f = 0; f < roof.faces.size(); ++f) {
    const Vec3 normal = loopNormal(roof.vertices, roof.faces[f].loops[0].vertices);
    for (const RoofLoop& l : roof.faces[f].loops) {
      for (size_t i = 0; i < l.vertices.size(); ++i) {
        work();
        faceAt[{l.vertices[i], l.vertices[(i + 1) % l.vertices.size()]}] = {f, normal};
      }
    }
  }
  // First the eaves, since hips are told by starting at one.
  std::vector<char> onEave(roof.vertices.size(), 0);
  for (RoofFace& f : roof.faces) {
    for (RoofLoop& l : f.loops) {
      l.edges.assign(l.vertices.size(), RoofEdgeRole::Border);
      double lowest = std::numeric_limits<double>::infinity();
      for (const uint32_t v : l.vertices) lowest = std::min(lowest, roof.vertices[v].height);
      for (size_t i = 0; i < l.vertices.size(); ++i) {
        const uint32_t a = l.vertices[i], b = l.vertices[(i + 1) % l.vertices.size()];
        if (faceAt.count({b, a}) != 0) continue;
        const double ha = roof.vertices[a].height, hb = roof.vertices[b].height;
        if (ha > lowest + tolerance_ || hb > lowest + tolerance_) continue;
        l.edges[i] = RoofEdgeRole::Eave;
        onEave[a] = onEave[b] = 1;
      }
    }
  }
  for (RoofFace& f : roof.faces) {
    for (RoofLoop& l : f.loops) {
      for (size_t i = 0; i < l.vertices.size(); ++i) {
        const uint32_t a = l.vertices[i], b = l.vertices[(i + 1) % l.vertices.size()];
        const auto across = faceAt.find({b, a});
        if (across == faceAt.end()) continue;
        const Vec3 mine = faceAt[{a, b}].second;
        const Vec3 along = spaceOf(roof.vertices[b]) - spaceOf(roof.vertices[a]);
        // Going along the edge the face is on the left; the turn of the normals tells hollow from
        // fold.
        const bool hollow = dot(cross(mine, across->second.second), along) < -1e-9 * length(along);
        l.edges[i] = hollow                   ? RoofEdgeRole::Valley
                     : onEave[a] || onEave[b] ? RoofEdgeRole::Hip
                                              : RoofEdgeRole::Ridge;
      }
    }
  }
}

/// Sets the vertices of each connected group of ridges to their mean height.
void RoofPieces::evenRidges(Roof& roof) const {
  std::vector<uint32_t> group(roof.vertices.size());
  std::iota(group.begin(), group.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (group[v] != v) v = group[v] = group[group[v]];
    return v;
  };
  std::vector<char> onRidge(roof.vertices.size(), 0);
  for (const RoofFace& f : roof.faces) {
    for (const RoofLoop& l : f.loops) {
      for (size_t i = 0; i < l.vertices.size(); ++i) {
        work();
        if (l.edges[i] != RoofEdgeRole::Ridge) continue;
        const uint32_t a = l.vertices[i], b = l.vertices[(i + 1) % l.vertices.size()];
        onRidge[a] = onRidge[b] = 1;
        const uint32_t p = find(a), q = find(b);
        group[std::max(p, q)] = std::min(p, q);
      }
    }
  }
  std::map<uint32_t, std::pair<double, int>> mean;
  for (uint32_t v = 0; v < group.size(); ++v) {
    if (!onRidge[v]) continue;
    auto& [sum, count] = mean[find(v)];
    sum += roof.vertices[v].height;
    ++count;
  }
  for (uint32_t v = 0; v < group.size(); ++v) {
    if (!onRidge[v]) continue;
    const auto& [sum, count] = mean[find(v)];
    roof.vertices[v].height = sum / count;
  }
  for (const Dropped& d : dropped_) {
    const double a = roof.vertices[d.before].height, b = roof.vertices[d.after].height;
    // The bottom keeps its corners: only what stands on a ridge is lifted with it.
    if (d.vertex >= edgeCount_) roof.vertices[d.vertex].height = a + d.share * (b - a);
  }
}

/// Takes out vertices where the borders of all their faces go straight on: the corners of the
/// polygon under an overhang. Remembers where they were, for what else stands on them.
void RoofPieces::dropStraightVertices(Roof& roof) {
  const auto positionOf = [&](uint32_t v) { return spaceOf(roof.vertices[v]); };
  std::vector<char> bent(roof.vertices.size(), 0);
  for (const RoofFace& f : roof.faces) {
    for (const RoofLoop& l : f.loops) {
      const size_t n = l.vertices.size();
      for (size_t i = 0; i < n; ++i) {
        work();
        const Vec3 p = positionOf(l.vertices[(i + n - 1) % n]);
        const Vec3 q = positionOf(l.vertices[i]);
        const Vec3 r = positionOf(l.vertices[(i + 1) % n]);
        const bool straight =
            dot(q - p, r - q) > 0 && length(cross(q - p, r - p)) <= tolerance_ * length(r - p);
        if (!straight) bent[l.vertices[i]] = 1;
      }
    }
  }
  // A sliver that would lose its shape keeps all of its vertices, and so do its neighbours theirs.
  for (bool changed = true; changed;) {
    changed = false;
    for (const RoofFace& f : roof.faces) {
      for (const RoofLoop& l : f.loops) {
        const auto isBent = [&](uint32_t v) { return bent[v] != 0; };
        const auto kept = std::count_if(l.vertices.begin(), l.vertices.end(), isBent);
        if (kept >= 3 || kept == static_cast<std::ptrdiff_t>(l.vertices.size())) continue;
        for (const uint32_t v : l.vertices) bent[v] = 1;
        changed = true;
      }
    }
  }
  for (RoofFace& f : roof.faces) {
    for (RoofLoop& l : f.loops) {
      std::vector<uint32_t> kept;
      for (const uint32_t v : l.vertices) {
        if (bent[v]) kept.push_back(v);
      }
      if (kept.size() == l.vertices.size()) continue;
      rememberDropped(roof, l.vertices, bent);
      l.vertices = std::move(kept);
    }
  }
}

void RoofPieces::rememberDropped(const Roof& roof, const std::vector<uint32_t>& loop,
                                 const std::vector<char>& bent) {
  const size_t n = loop.size();
  for (size_t i = 0; i < n; ++i) {
    work();
    if (bent[loop[i]]) continue;
    size_t before = i, after = i;
    do before = (before + n - 1) % n;
    while (!bent[loop[before]]);
    do after = (after + 1) % n;
    while (!bent[loop[after]]);
    const Vec2 a = roof.vertices[loop[before]].xy, b = roof.vertices[loop[after]].xy;
    const double whole = length(b - a);
    const double share = whole > 0 ? length(roof.vertices[loop[i]].xy - a) / whole : 0;
    dropped_.push_back({loop[i], loop[before], loop[after], share});
  }
}

/// A slope begins with its longest eave, so that what is laid on it starts there.
void RoofPieces::startAtEaves(Roof& roof) const {
  for (RoofFace& f : roof.faces) {
    RoofLoop& l = f.loops[0];
    size_t best = 0;
    double longest = 0;
    for (size_t i = 0; i < l.vertices.size(); ++i) {
      work();
      if (l.edges[i] != RoofEdgeRole::Eave) continue;
      const uint32_t a = l.vertices[i], b = l.vertices[(i + 1) % l.vertices.size()];
      const double d = length(roof.vertices[b].xy - roof.vertices[a].xy);
      if (d > longest + tolerance_) {
        longest = d;
        best = i;
      }
    }
    const auto shift = static_cast<std::ptrdiff_t>(best);
    std::rotate(l.vertices.begin(), l.vertices.begin() + shift, l.vertices.end());
    std::rotate(l.edges.begin(), l.edges.begin() + shift, l.edges.end());
  }
}

void RoofPieces::addSidesAndBottom(Roof& roof) const {
  for (const Side& s : sides_) {
    const uint32_t r = ringOf(s.edge);
    RoofFace f;
    f.role = r == 0 ? RoofRole::SideOuter : RoofRole::SideInner;
    f.ring = r;
    f.edge = s.edge - firstEdge_[r];
    f.loops.push_back({s.loop, std::vector<RoofEdgeRole>(s.loop.size(), RoofEdgeRole::Border)});
    roof.faces.push_back(std::move(f));
  }
  RoofFace bottom;
  bottom.role = RoofRole::Bottom;
  for (uint32_t r = 0; r < ringCount(); ++r) {
    RoofLoop l;
    const auto n = static_cast<uint32_t>(ring(r).size());
    for (uint32_t i = 0; i < n; ++i) l.vertices.push_back(firstEdge_[r] + (n - i) % n);
    l.edges.assign(n, RoofEdgeRole::Border);
    bottom.loops.push_back(std::move(l));
  }
  roof.faces.push_back(std::move(bottom));
}

Roof RoofPieces::finish(bool even, const RoofRetreat& retreat) {
  Roof roof;
  roof.vertices = vertices_;
  for (uint32_t e = 0; e < edgeCount_; ++e) {
    if (slopes_[e].empty()) continue;
    RoofFace f;
    f.ring = ringOf(e);
    f.edge = e - firstEdge_[f.ring];
    std::vector<std::vector<uint32_t>> loops;
    if (!join(e, loops)) continue;
    for (auto& l : loops) f.loops.push_back({std::move(l), {}});
    roof.faces.push_back(std::move(f));
  }
  cutBack(roof, retreat);
  // Only an overhang leaves such vertices: a face has a piece inside and one outside then.
  if (std::any_of(slopes_.begin(), slopes_.end(), [](const auto& p) { return p.size() > 1; })) {
    dropStraightVertices(roof);
  }
  assignRoles(roof);
  startAtEaves(roof);
  if (even) evenRidges(roof);
  addSidesAndBottom(roof);
  return roof;
}

}  // namespace gable::skeleton
