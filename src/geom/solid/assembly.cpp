// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/assembly.h"

#include <algorithm>
#include <utility>

#include "base/work.h"
#include "geom/mesh/face_triangles.h"

namespace gable::solid {
namespace {

constexpr uint32_t kNone = SolidResult::kNone;

// What a face of the input knows of vertices: which of its corners lie there, and which of its
// edges run there; and its values at places between.
class SourceFace {
 public:
  SourceFace(const Mesh& m, const Facets& facets, const Splits& splits)
      : mesh_(m), facets_(facets), splits_(splits) {}

  void load(uint32_t face) {
    if (face == face_) return;
    face_ = face;
    corners_.clear();
    edges_.clear();
    triangles_.clear();
    for (const MeshLoop& loop : mesh_.loopsOf(face)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const uint32_t c = loop.firstCorner + i;
        const uint32_t u = vertexAt(c), v = vertexAt(next(loop, i));
        corners_.emplace_back(u, c);
        if (u == v) continue;
        parts_.clear();
        splits_.expand(u, v, parts_);
        for (const Edge& e : parts_) edges_.push_back({edgeKey(e), c, next(loop, i)});
      }
    }
    work(corners_.size() + edges_.size());
    std::sort(corners_.begin(), corners_.end());
    std::sort(edges_.begin(), edges_.end(), [](const Run& a, const Run& b) {
      return std::pair(a.edge, a.from) < std::pair(b.edge, b.from);
    });
  }

  uint32_t cornerAt(uint32_t vertex) const {
    const auto at = std::lower_bound(corners_.begin(), corners_.end(), std::pair(vertex, 0u));
    return at != corners_.end() && at->first == vertex ? at->second : kNone;
  }

  uint32_t edgeAt(uint32_t u, uint32_t v) const {
    const Run* run = runAt(u, v);
    return run ? run->from : kNone;
  }

  /// Shares of corners that make up a vertex; `u` and `w` are beside it.
  struct Share {
    uint32_t corner = 0;
    double weight = 0;
  };
  std::vector<Share> sharesAt(uint32_t u, uint32_t v, uint32_t w) {
    const uint32_t c = cornerAt(v);
    if (c != kNone) return {{c, 1}};
    for (const uint32_t beside : {u, w}) {
      const Run* run = runAt(beside, v);
      if (!run) continue;
      const double t = nearestOn(mesh_.at(run->from), mesh_.at(run->to), facets_.pool[v]).along;
      return {{run->from, 1 - t}, {run->to, t}};
    }
    return sharesInside(facets_.pool[v]);
  }

 private:
  // A part of an edge, and the corners between which the whole runs.
  struct Run {
    uint64_t edge = 0;
    uint32_t from = 0, to = 0;
  };

  uint32_t vertexAt(uint32_t corner) const { return facets_.vertexOf[mesh_.corners[corner]]; }
  static uint32_t next(const MeshLoop& loop, uint32_t i) {
    return loop.firstCorner + (i + 1 < loop.cornerCount ? i + 1 : 0);
  }

  const Run* runAt(uint32_t u, uint32_t v) const {
    const uint64_t key = edgeKey(u, v);
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), key,
                                     [](const Run& r, uint64_t k) { return r.edge < k; });
    return at != edges_.end() && at->edge == key ? &*at : nullptr;
  }

  std::vector<Share> sharesInside(const Vec3& p) {
    if (triangles_.empty()) triangulator_.add(mesh_, face_, triangles_);
    const Vec3 normal = mesh_.areaNormal(face_);
    std::vector<Share> best;
    double least = -1e300;
    for (const auto& t : triangles_) {
      work();
      const Vec3 a = mesh_.at(t[0]), b = mesh_.at(t[1]), c = mesh_.at(t[2]);
      const double all = dot(cross(b - a, c - a), normal);
      if (!(all > 0)) continue;
      const double wa = dot(cross(b - p, c - p), normal) / all;
      const double wb = dot(cross(c - p, a - p), normal) / all;
      const double wc = 1 - wa - wb;
      if (std::min({wa, wb, wc}) <= least) continue;
      least = std::min({wa, wb, wc});
      best = {{t[0], wa}, {t[1], wb}, {t[2], wc}};
    }
    if (best.empty()) best = {{corners_[0].second, 1}};
    return best;
  }

  const Mesh& mesh_;
  const Facets& facets_;
  const Splits& splits_;
  uint32_t face_ = kNone;
  // By vertex.
  std::vector<std::pair<uint32_t, uint32_t>> corners_;
  std::vector<Run> edges_;
  std::vector<Edge> parts_;
  FaceTriangulator triangulator_;
  std::vector<std::array<uint32_t, 3>> triangles_;
};

class Assembler {
 public:
  Assembler(const Mesh& m, const Facets& facets, const Splits& splits,
            const std::vector<uint64_t>& cuts)
      : mesh_(m), facets_(facets), cuts_(cuts), source_(m, facets, splits) {}

  SolidResult run(std::vector<Outline> outlines) {
    straighten(outlines);
    position_.assign(facets_.pool.size(), kNone);
    for (Outline& o : outlines) put(o);
    out_.mesh = builder_.take();
    return std::move(out_);
  }

 private:
  struct Vertex {
    uint32_t beside[2] = {kNone, kNone};
    bool stays = false;
  };

  template <class Visit>
  static void forCorners(const std::vector<uint32_t>& loop, const Visit& visit) {
    const size_t n = loop.size();
    for (size_t i = 0; i < n; ++i) visit(loop[i > 0 ? i - 1 : n - 1], loop[i], loop[(i + 1) % n]);
    work(n);
  }

  void straighten(std::vector<Outline>& outlines) {
    std::vector<Vertex> vertices(facets_.pool.size());
    for (const Outline& o : outlines) {
      source_.load(o.face);
      for (const auto& loop : o.loops) {
        forCorners(loop, [&](uint32_t u, uint32_t v, uint32_t w) { look(vertices, u, v, w); });
      }
    }
    for (Outline& o : outlines) {
      for (auto& loop : o.loops) {
        std::vector<uint32_t> left;
        for (const uint32_t v : loop) {
          if (vertices[v].stays) left.push_back(v);
        }
        if (left.size() > 2) loop = std::move(left);
      }
    }
  }

  void look(std::vector<Vertex>& vertices, uint32_t u, uint32_t v, uint32_t w) const {
    Vertex& vertex = vertices[v];
    if (vertex.stays) return;
    for (const uint32_t other : {u, w}) {
      if (other == vertex.beside[0] || other == vertex.beside[1]) continue;
      if (vertex.beside[1] != kNone) vertex.stays = true;
      vertex.beside[vertex.beside[0] == kNone ? 0 : 1] = other;
    }
    const Nearest n = nearestOn(facets_.pool[u], facets_.pool[w], facets_.pool[v]);
    const bool straight = n.distance <= facets_.pool.tolerance() && n.along > 0 && n.along < 1;
    vertex.stays = vertex.stays || !straight || source_.cornerAt(v) != kNone ||
                   source_.edgeAt(u, v) != source_.edgeAt(v, w);
  }

  void put(const Outline& o) {
    source_.load(o.face);
    const MeshFace& f = mesh_.faces[o.face];
    builder_.beginFace(f.materialSlot, f.tags, f.smooth);
    out_.faceSource.push_back(o.face);
    out_.faceOthers.push_back(o.others);
    for (const auto& loop : o.loops) {
      builder_.beginLoop();
      forCorners(loop, [&](uint32_t u, uint32_t v, uint32_t w) { putCorner(u, v, w, o.turned); });
    }
  }

  void putCorner(uint32_t u, uint32_t v, uint32_t w, bool turned) {
    if (position_[v] == kNone) position_[v] = builder_.addPosition(facets_.pool[v]);
    const uint32_t edge = source_.edgeAt(v, w);
    const bool tagged = edge != kNone && !mesh_.edgeTags.empty();
    const uint32_t corner = builder_.addCorner(position_[v], tagged ? mesh_.edgeTags[edge] : 0);
    out_.cornerSource.push_back(source_.cornerAt(v));
    out_.edgeSource.push_back(edge);
    out_.cut.push_back(std::binary_search(cuts_.begin(), cuts_.end(), edgeKey(v, w)));
    const auto shares = source_.sharesAt(u, v, w);
    for (int s = 0; s < kUvSets; ++s) {
      if (!mesh_.hasUv(s)) continue;
      Vec2 uv;
      for (const auto& share : shares) {
        uv = uv + mesh_.uvs[static_cast<size_t>(s)][share.corner] * share.weight;
      }
      builder_.setUv(corner, s, uv);
    }
    if (mesh_.normals.empty()) return;
    Vec3 n;
    for (const auto& share : shares) n += mesh_.normals[share.corner] * share.weight;
    n = shares.size() == 1 ? n : normalized(n);
    builder_.setNormal(corner, turned ? -n : n);
  }

  const Mesh& mesh_;
  const Facets& facets_;
  const std::vector<uint64_t>& cuts_;
  SourceFace source_;
  MeshBuilder builder_;
  // By vertex.
  std::vector<uint32_t> position_;
  SolidResult out_;
};

}  // namespace

SolidResult assemble(const Mesh& m, const Facets& facets, const Splits& splits,
                     const std::vector<uint64_t>& cuts, std::vector<Outline> outlines) {
  return Assembler(m, facets, splits, cuts).run(std::move(outlines));
}

}  // namespace gable::solid
