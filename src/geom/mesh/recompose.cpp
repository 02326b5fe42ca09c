// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Vertices of one origin are a node. A node's moves are those of the parts that have it as a
// vertex, and of those that have it within an edge, where they move it as they move the edge.
#include "geom/mesh/recompose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "base/work.h"

namespace gable {

namespace {

constexpr size_t kPlace = kUvSets - 2, kHeight = kUvSets - 1;
constexpr uint32_t kNone = 0xffffffff;

Vec3 originOf(const Mesh& m, uint32_t corner) {
  const Vec2 xy = m.uvs[kPlace][corner];
  return {xy.x, xy.y, m.uvs[kHeight][corner].x};
}

// Components are kept as numbers from 1 on, below 0 where the shape was deleted.
double componentOf(const Mesh& m) { return m.uvs[kHeight].empty() ? 0 : m.uvs[kHeight][0].y; }

// Points that are one when they are nearer than a tolerance.
class Nodes {
 public:
  explicit Nodes(double tolerance) : tolerance_(tolerance) {}

  uint32_t at(const Vec3& p) {
    work();
    const Cell home = cellOf(p);
    for (int64_t dx = -1; dx <= 1; ++dx) {
      for (int64_t dy = -1; dy <= 1; ++dy) {
        for (int64_t dz = -1; dz <= 1; ++dz) {
          const auto found = cells_.find({home[0] + dx, home[1] + dy, home[2] + dz});
          if (found == cells_.end()) continue;
          for (const uint32_t n : found->second) {
            if (length(places_[n] - p) <= tolerance_) return n;
          }
        }
      }
    }
    cells_[home].push_back(static_cast<uint32_t>(places_.size()));
    places_.push_back(p);
    return static_cast<uint32_t>(places_.size() - 1);
  }
  const std::vector<Vec3>& places() const { return places_; }
  double tolerance() const { return tolerance_; }

 private:
  using Cell = std::array<int64_t, 3>;
  Cell cellOf(const Vec3& p) const {
    Cell c;
    for (size_t i = 0; i < 3; ++i) {
      c[i] = static_cast<int64_t>(std::floor(p[i] / (4 * tolerance_)));
    }
    return c;
  }

  double tolerance_;
  std::vector<Vec3> places_;
  std::map<Cell, std::vector<uint32_t>> cells_;
};

// Finds the nodes strictly within a segment.
class NodesAlong {
 public:
  explicit NodesAlong(const Nodes& nodes) : nodes_(nodes), order_(nodes.places().size()) {
    Box3 box;
    for (const Vec3& p : nodes.places()) box.include(p);
    const Vec3 size = box.size();
    axis_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::iota(order_.begin(), order_.end(), 0u);
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      return nodes.places()[a][axis_] < nodes.places()[b][axis_];
    });
  }

  struct Within {
    uint32_t node;
    /// From 0 to 1 along the segment.
    double share;
  };
  std::vector<Within> find(const Vec3& a, const Vec3& b) const {
    std::vector<Within> out;
    const Vec3 d = b - a;
    const double l2 = dot(d, d), near = nodes_.tolerance();
    if (l2 <= near * near) return out;
    const double from = std::min(a[axis_], b[axis_]) - near;
    const double to = std::max(a[axis_], b[axis_]) + near;
    auto at = std::partition_point(order_.begin(), order_.end(),
                                   [&](uint32_t n) { return nodes_.places()[n][axis_] < from; });
    for (; at != order_.end() && nodes_.places()[*at][axis_] <= to; ++at) {
      work();
      const Vec3 p = nodes_.places()[*at] - a;
      const double share = dot(p, d) / l2;
      if (share * share * l2 <= near * near || (1 - share) * (1 - share) * l2 <= near * near) {
        continue;
      }
      if (share <= 0 || share >= 1 || length(p - d * share) > near) continue;
      out.push_back({*at, share});
    }
    std::sort(out.begin(), out.end(),
              [](const Within& x, const Within& y) { return x.share < y.share; });
    return out;
  }

 private:
  const Nodes& nodes_;
  std::vector<uint32_t> order_;
  size_t axis_ = 0;
};

class Recomposition {
 public:
  Recomposition(const Mesh& whole, const std::vector<Mesh>& parts)
      : whole_(whole), parts_(parts), nodes_(toleranceOf(whole, parts)) {}

  Mesh run() {
    findNodes();
    const NodesAlong along(nodes_);
    along_ = &along;
    for (size_t p = 0; p < parts_.size(); ++p) {
      if (hasOrigins(parts_[p])) moveNodes(p);
    }
    for (size_t p = 0; p < parts_.size(); ++p) {
      if (hasOrigins(parts_[p])) moveWithinEdges(p);
    }
    for (size_t f = 0; f < whole_.faceCount(); ++f) addFace(whole_, wholeNodes_, f, true);
    for (size_t p = 0; p < parts_.size(); ++p) {
      if (isDeleted(parts_[p])) continue;
      const bool tracked = hasOrigins(parts_[p]);
      for (size_t f = 0; f < parts_[p].faceCount(); ++f) {
        if (!tracked) {
          addPlainFace(p, f);
        } else if (isFace(parts_[p], f)) {
          addFace(parts_[p], nodesOf_[p], f, false);
        }
      }
    }
    Mesh out = builder_.take();
    dropOrigins(out);
    return out;
  }

 private:
  struct Move {
    double component;
    Vec3 by;
  };

  static double toleranceOf(const Mesh& whole, const std::vector<Mesh>& parts) {
    Box3 box = whole.bounds();
    for (const Mesh& m : parts) {
      for (uint32_t c = 0; hasOrigins(m) && c < m.corners.size(); ++c) box.include(originOf(m, c));
    }
    const Vec3 size = box.size();
    const double extent = std::max({size.x, size.y, size.z, std::fabs(box.max.x),
                                    std::fabs(box.max.y), std::fabs(box.max.z), 1e-3});
    // Points that far apart are one, rather than none.
    return std::isfinite(extent) ? 1e-7 * extent : 1e300;
  }
  static bool isFace(const Mesh& m, size_t f) { return m.loopsOf(f)[0].cornerCount > 2; }

  void findNodes() {
    for (uint32_t c = 0; c < whole_.corners.size(); ++c) {
      wholeNodes_.push_back(nodes_.at(whole_.at(c)));
    }
    nodesOf_.resize(parts_.size());
    for (size_t p = 0; p < parts_.size(); ++p) {
      const Mesh& m = parts_[p];
      for (uint32_t c = 0; hasOrigins(m) && c < m.corners.size(); ++c) {
        nodesOf_[p].push_back(nodes_.at(originOf(m, c)));
      }
    }
    moves_.resize(nodes_.places().size());
    vertexTags_.resize(nodes_.places().size());
    // Edited vertices say what tags they have, before untouched ones do.
    for (size_t p = 0; p < parts_.size(); ++p) noteTags(parts_[p], nodesOf_[p]);
    noteTags(whole_, wholeNodes_);
  }
  void noteTags(const Mesh& m, const std::vector<uint32_t>& nodes) {
    for (uint32_t c = 0; !m.vertexTags.empty() && c < nodes.size(); ++c) {
      uint32_t& tags = vertexTags_[nodes[c]];
      if (tags == 0) tags = m.vertexTagsAt(m.corners[c]);
    }
  }

  bool same(const Vec3& a, const Vec3& b) const { return length(a - b) <= 10 * nodes_.tolerance(); }
  void addMove(uint32_t node, double component, Vec3 by) {
    component = std::fabs(component);
    if (length(by) <= nodes_.tolerance()) by = {};
    for (const Move& m : moves_[node]) {
      if (m.component == component && same(m.by, by)) return;
    }
    moves_[node].push_back({component, by});
  }
  Vec3 ownMove(size_t part, uint32_t corner) const {
    return parts_[part].at(corner) - nodes_.places()[nodesOf_[part][corner]];
  }

  // Where a part has several vertices of one origin, as after extrude, the one that stayed is the
  // node; the others are vertices of their own.
  void moveNodes(size_t part) {
    const Mesh& m = parts_[part];
    std::map<uint32_t, uint32_t> first;
    std::vector<uint32_t>& nodes = nodesOf_[part];
    for (uint32_t c = 0; c < nodes.size(); ++c) {
      work();
      const auto [at, fresh] = first.try_emplace(nodes[c], c);
      if (!fresh && length(ownMove(part, c)) < length(ownMove(part, at->second))) at->second = c;
    }
    std::vector<uint32_t> shared(nodes.size(), kNone);
    for (uint32_t c = 0; c < nodes.size(); ++c) {
      work();
      const uint32_t kept = first[nodes[c]];
      if (same(m.at(c), m.at(kept))) shared[c] = nodes[c];
    }
    for (const auto& [node, corner] : first) {
      addMove(node, componentOf(m), ownMove(part, corner));
    }
    nodes = std::move(shared);
  }

  // An edge takes the nodes within it along.
  void moveWithinEdges(size_t part) {
    const Mesh& m = parts_[part];
    forEachEdge(m, nodesOf_[part], [&](uint32_t a, uint32_t b) {
      const Vec3 from = m.at(a) - originOf(m, a), to = m.at(b) - originOf(m, b);
      for (const NodesAlong::Within& w : along_->find(originOf(m, a), originOf(m, b))) {
        addMove(w.node, componentOf(m), from + (to - from) * w.share);
      }
    });
    for (const MeshFace& f : m.faces) {
      const MeshLoop& loop = m.loops[f.firstLoop];
      if (loop.cornerCount != 2) continue;
      const uint32_t a = loop.firstCorner;
      const uint32_t own = m.edgeTags.empty() ? 0 : m.edgeTags[a];
      const auto [low, high] = std::minmax(nodesOf_[part][a], nodesOf_[part][a + 1]);
      if (own != 0 || f.tags != 0) edgeTags_.try_emplace({low, high}, own != 0 ? own : f.tags);
    }
  }

  template <class Visit>
  void forEachEdge(const Mesh& m, const std::vector<uint32_t>& nodes, const Visit& visit) {
    for (const MeshLoop& loop : m.loops) {
      for (uint32_t i = 0; i < loop.cornerCount && loop.cornerCount > 1; ++i) {
        work();
        const uint32_t a = loop.firstCorner + i;
        const uint32_t b = loop.firstCorner + (i + 1) % loop.cornerCount;
        if (nodes[a] != kNone && nodes[b] != kNone) visit(a, b);
        if (loop.cornerCount == 2) break;
      }
    }
  }

  uint32_t positionOf(uint32_t node) {
    const auto [at, fresh] = positions_.try_emplace(node, 0u);
    if (fresh) {
      Vec3 p = nodes_.places()[node];
      for (const Move& m : moves_[node]) p += m.by;
      at->second = builder_.addPosition(p, vertexTags_[node]);
    }
    return at->second;
  }

  // `nodes` by corner; kNone for vertices of their own.
  void addFace(const Mesh& m, const std::vector<uint32_t>& nodes, size_t face, bool untouched) {
    const MeshFace& f = m.faces[face];
    builder_.beginFace(f.materialSlot, f.tags, f.smooth);
    std::map<uint32_t, uint32_t> own;
    for (const MeshLoop& loop : m.loopsOf(face)) {
      builder_.beginLoop();
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const uint32_t a = loop.firstCorner + i;
        const uint32_t b = loop.firstCorner + (i + 1) % loop.cornerCount;
        uint32_t position = 0;
        if (nodes[a] != kNone) {
          position = positionOf(nodes[a]);
        } else {
          const auto [at, fresh] = own_.try_emplace({&m, m.corners[a]}, 0u);
          if (fresh) at->second = builder_.copyPosition(m, m.corners[a]);
          position = at->second;
        }
        std::vector<NodesAlong::Within> within;
        if (nodes[a] != kNone && nodes[b] != kNone) {
          within = along_->find(nodes_.places()[nodes[a]], nodes_.places()[nodes[b]]);
        }
        uint32_t from = nodes[a];
        const uint32_t tags = m.edgeTags.empty() ? 0 : m.edgeTags[a];
        for (size_t k = 0; k <= within.size(); ++k) {
          const uint32_t to = k < within.size() ? within[k].node : nodes[b];
          const double share = k == 0 ? 0 : within[k - 1].share;
          if (k > 0) position = positionOf(within[k - 1].node);
          addCorner(m, a, b, share, position, untouched ? tagsOf(from, to, tags) : tags);
          from = to;
        }
      }
    }
  }
  // What an edited edge says of a part of an untouched one.
  uint32_t tagsOf(uint32_t a, uint32_t b, uint32_t otherwise) const {
    const auto found = edgeTags_.find({std::min(a, b), std::max(a, b)});
    return found == edgeTags_.end() ? otherwise : found->second;
  }
  void addCorner(const Mesh& m, uint32_t a, uint32_t b, double share, uint32_t position,
                 uint32_t tags) {
    const uint32_t made = builder_.addCorner(position, tags);
    for (int set = 0; set < static_cast<int>(kPlace); ++set) {
      if (!m.hasUv(set)) continue;
      const auto& uvs = m.uvs[static_cast<size_t>(set)];
      builder_.setUv(made, set, uvs[a] + (uvs[b] - uvs[a]) * share);
    }
  }
  void addPlainFace(size_t part, size_t face) {
    plainPositions_.resize(parts_.size());
    builder_.copyFace(parts_[part], face, plainPositions_[part]);
  }

  const Mesh& whole_;
  const std::vector<Mesh>& parts_;
  Nodes nodes_;
  const NodesAlong* along_ = nullptr;
  // By corner.
  std::vector<uint32_t> wholeNodes_;
  std::vector<std::vector<uint32_t>> nodesOf_, plainPositions_;
  // By node.
  std::vector<std::vector<Move>> moves_;
  std::vector<uint32_t> vertexTags_;
  std::map<uint32_t, uint32_t> positions_;
  std::map<std::pair<const Mesh*, uint32_t>, uint32_t> own_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edgeTags_;
  MeshBuilder builder_;
};

}  // namespace

bool hasRoomForOrigins(const Mesh& m) { return m.uvs[kPlace].empty() && m.uvs[kHeight].empty(); }

void setOrigins(Mesh& m, uint32_t component) {
  m.uvs[kPlace].clear();
  m.uvs[kHeight].clear();
  for (const uint32_t c : m.corners) {
    const Vec3& p = m.positions[c];
    m.uvs[kPlace].push_back({p.x, p.y});
    m.uvs[kHeight].push_back({p.z, component + 1.0});
  }
}

// Coordinates that a rule has put there meanwhile are no origins.
bool hasOrigins(const Mesh& m) {
  const std::vector<Vec2>& height = m.uvs[kHeight];
  if (m.uvs[kPlace].empty() || height.empty() || height[0].y == 0) return false;
  return std::all_of(height.begin(), height.end(), [&](const Vec2& uv) {
    return uv.y == height[0].y && std::nearbyint(uv.y) == uv.y;
  });
}

void dropOrigins(Mesh& m) {
  m.uvs[kPlace].clear();
  m.uvs[kHeight].clear();
}

void markDeleted(Mesh& m) {
  for (Vec2& uv : m.uvs[kHeight]) uv.y = -std::fabs(uv.y);
}

bool isDeleted(const Mesh& m) { return componentOf(m) < 0; }

Mesh recomposed(const Mesh& whole, const std::vector<Mesh>& parts) {
  return Recomposition(whole, parts).run();
}

}  // namespace gable
