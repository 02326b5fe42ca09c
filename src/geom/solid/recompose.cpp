// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Vertices of one origin are a node. A node's moves are those of the shapes that have it as a
// vertex, and of those that have it within an edge, where they move it as they move the edge. A
// node within an edge of a shape that was divided also follows what others move the ends of that
// edge by; what came of the shape itself moved its own vertices already.
#include "geom/solid/recompose.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/work.h"
#include "geom/mesh/origins.h"
#include "geom/solid/box_tree.h"
#include "geom/solid/facets.h"
#include "geom/solid/vertex_pool.h"

namespace gable {

namespace {

constexpr uint32_t kNone = 0xffffffff;
// Components lie on a grid in axes of their own and come back rounded.
constexpr double kOfExtent = 1e-7;

using solid::VertexPool;

// Finds the nodes strictly within an edge between two others.
class NodesWithin {
 public:
  explicit NodesWithin(const VertexPool& nodes) : nodes_(nodes), tree_(boxesOf(nodes)) {}

  struct Within {
    uint32_t node;
    /// From 0 to 1 along the edge.
    double share;
  };
  std::vector<Within> find(uint32_t a, uint32_t b) const {
    std::vector<Within> out;
    const double near = nodes_.tolerance();
    Box3 box;
    box.include(nodes_[a]);
    box.include(nodes_[b]);
    box = {box.min - Vec3{near, near, near}, box.max + Vec3{near, near, near}};
    tree_.query(box, [&](uint32_t n) {
      if (n == a || n == b) return;
      const solid::Nearest at = solid::nearestOn(nodes_[a], nodes_[b], nodes_[n]);
      if (at.distance <= near && at.along > 0 && at.along < 1) out.push_back({n, at.along});
    });
    std::sort(out.begin(), out.end(), [](const Within& x, const Within& y) {
      return std::pair(x.share, x.node) < std::pair(y.share, y.node);
    });
    return out;
  }

 private:
  static std::vector<Box3> boxesOf(const VertexPool& nodes) {
    std::vector<Box3> boxes(nodes.size());
    for (uint32_t n = 0; n < boxes.size(); ++n) boxes[n].include(nodes[n]);
    return boxes;
  }

  const VertexPool& nodes_;
  solid::BoxTree tree_;
};

// A part, or the faces that nobody took.
struct Source {
  const Mesh* mesh = nullptr;
  bool deleted = false;
  /// By corner: its node, kNone for vertices of their own.
  std::vector<uint32_t> nodes;
  /// By position: what it became, for vertices of their own.
  std::map<uint32_t, uint32_t> own;
};

class Recomposition {
 public:
  Recomposition(const Mesh& whole, const std::vector<Mesh>& parts, LooseParts loose)
      : whole_(whole),
        parts_(parts),
        loose_(loose),
        level_(levelOf(whole, parts)),
        nodes_(toleranceOf(), cornersOf(whole, parts)),
        sources_(parts.size() + 1) {}

  Mesh run() {
    findNodes();
    within_.emplace(nodes_);
    for (size_t p = 0; p < parts_.size(); ++p) moveNodes(p);
    for (size_t p = 0; p < parts_.size(); ++p) moveWithinEdges(p);
    followEnds();
    for (Source& source : sources_) {
      if (source.deleted) continue;
      for (size_t f = 0; f < source.mesh->faceCount(); ++f) addFace(source, f);
    }
    Mesh out = builder_.take();
    dropOrigins(out, level_);
    return out;
  }

 private:
  struct Move {
    double shape;
    Vec3 by;
  };

  // The level of the operation is the innermost one of any part: where a part has fewer, it has
  // lost all.
  static size_t levelOf(const Mesh& whole, const std::vector<Mesh>& parts) {
    size_t most = originLevels(whole) + 1;
    for (const Mesh& m : parts) most = std::max(most, originLevels(m));
    return most - 1;
  }
  static size_t cornersOf(const Mesh& whole, const std::vector<Mesh>& parts) {
    size_t count = whole.corners.size();
    for (const Mesh& m : parts) count += m.corners.size();
    return count;
  }
  double toleranceOf() const {
    Box3 box = whole_.bounds();
    for (const Mesh& m : parts_) {
      const Origins origins(m, level_);
      for (uint32_t c = 0; c < m.corners.size(); ++c) {
        work();
        if (origins.known(c)) box.include(origins.origin(c));
      }
    }
    const Vec3 size = box.size();
    const double extent = std::max({size.x, size.y, size.z, std::fabs(box.max.x),
                                    std::fabs(box.max.y), std::fabs(box.max.z), 1e-3});
    // Points that far apart are one, rather than none.
    return std::isfinite(extent) ? kOfExtent * extent : 1e300;
  }

  Source& partSource(size_t part) { return sources_[part + 1]; }

  void findNodes() {
    sources_[0].mesh = &whole_;
    for (const uint32_t p : whole_.corners) {
      sources_[0].nodes.push_back(nodes_.snap(whole_.positions[p]));
    }
    for (size_t p = 0; p < parts_.size(); ++p) {
      const Mesh& m = parts_[p];
      const Origins origins(m, level_);
      Source& source = partSource(p);
      source.mesh = &m;
      source.deleted = originLevels(m) > level_ && isDeleted(m);
      for (uint32_t c = 0; c < m.corners.size(); ++c) {
        source.nodes.push_back(origins.known(c) ? nodes_.snap(origins.origin(c)) : kNone);
      }
    }
    moves_.resize(nodes_.size());
    vertexTags_.resize(nodes_.size());
    // Edited vertices say what tags they have, before untouched ones do.
    for (size_t p = 0; p < parts_.size(); ++p) noteTags(partSource(p));
    noteTags(sources_[0]);
  }
  void noteTags(const Source& source) {
    const Mesh& m = *source.mesh;
    if (m.vertexTags.empty() || source.deleted) return;
    for (uint32_t c = 0; c < source.nodes.size(); ++c) {
      if (source.nodes[c] == kNone) continue;
      uint32_t& tags = vertexTags_[source.nodes[c]];
      if (tags == 0) tags = m.vertexTagsAt(m.corners[c]);
    }
  }

  bool same(const Vec3& a, const Vec3& b) const { return length(a - b) <= 10 * nodes_.tolerance(); }
  void addMove(uint32_t node, double shape, Vec3 by) {
    if (length(by) <= nodes_.tolerance()) return;
    for (const Move& m : moves_[node]) {
      work();
      if (m.shape == shape && same(m.by, by)) return;
    }
    moves_[node].push_back({shape, by});
  }

  // Where a part has several vertices of one origin, as after extrude, the one that stayed is the
  // node; the others are vertices of their own.
  void moveNodes(size_t part) {
    const Mesh& m = parts_[part];
    const Origins origins(m, level_);
    const auto ownMove = [&](uint32_t c) { return m.at(c) - origins.begin(c); };
    std::map<uint32_t, uint32_t> stayed;
    std::vector<uint32_t>& nodes = partSource(part).nodes;
    for (uint32_t c = 0; c < nodes.size(); ++c) {
      work();
      if (nodes[c] == kNone) continue;
      const auto [at, fresh] = stayed.try_emplace(nodes[c], c);
      if (!fresh && length(ownMove(c)) < length(ownMove(at->second))) at->second = c;
    }
    for (const auto& [node, corner] : stayed) {
      addMove(node, origins.shape(corner), ownMove(corner));
    }
    for (uint32_t c = 0; c < nodes.size(); ++c) {
      if (nodes[c] != kNone && !same(m.at(c), m.at(stayed[nodes[c]]))) nodes[c] = kNone;
    }
  }

  // An edge takes the nodes within it along.
  void moveWithinEdges(size_t part) {
    const Mesh& m = parts_[part];
    const Origins origins(m, level_);
    const std::vector<uint32_t>& nodes = partSource(part).nodes;
    for (const MeshLoop& loop : m.loops) {
      for (uint32_t i = 0; i < edgeCount(loop); ++i) {
        work();
        const uint32_t a = loop.firstCorner + i;
        const uint32_t b = loop.firstCorner + (i + 1) % loop.cornerCount;
        if (nodes[a] == kNone || nodes[b] == kNone || nodes[a] == nodes[b]) continue;
        const Vec3 from = m.at(a) - origins.begin(a), to = m.at(b) - origins.begin(b);
        for (const NodesWithin::Within& w : within_->find(nodes[a], nodes[b])) {
          addMove(w.node, origins.shape(a), from + (to - from) * w.share);
        }
      }
    }
    if (!partSource(part).deleted) noteEdgeTags(m, nodes);
  }

  // Shapes that were divided, the outer ones first: their numbers are smaller.
  void followEnds() {
    std::vector<std::pair<double, size_t>> divided;
    for (size_t p = 0; p < parts_.size(); ++p) {
      const Origins origins(parts_[p], level_);
      for (uint32_t c = 0; c < parts_[p].corners.size(); ++c) {
        work();
        if (!origins.known(c)) continue;
        parents_[origins.shape(c)] = origins.parent(c);
        if (!partSource(p).deleted) continue;
        if (divided.empty() || divided.back().second != p) divided.push_back({origins.shape(c), p});
      }
    }
    std::sort(divided.begin(), divided.end());
    for (const auto& [shape, part] : divided) followEnds(part, shape);
  }
  void followEnds(size_t part, double shape) {
    const std::vector<uint32_t>& nodes = partSource(part).nodes;
    for (const MeshLoop& loop : parts_[part].loops) {
      for (uint32_t i = 0; i < edgeCount(loop); ++i) {
        work();
        const uint32_t a = nodes[loop.firstCorner + i];
        const uint32_t b = nodes[loop.firstCorner + (i + 1) % loop.cornerCount];
        if (a == kNone || b == kNone || a == b) continue;
        if (moves_[a].empty() && moves_[b].empty()) continue;
        const std::vector<NodesWithin::Within> within = within_->find(a, b);
        if (within.empty()) continue;
        // By shape, what it moves the ends by.
        std::map<double, std::pair<Vec3, Vec3>> others;
        for (const Move& m : moves_[a]) {
          if (!cameOf(m.shape, shape)) others[m.shape].first += m.by;
        }
        for (const Move& m : moves_[b]) {
          if (!cameOf(m.shape, shape)) others[m.shape].second += m.by;
        }
        for (const NodesWithin::Within& w : within) {
          for (const auto& [mover, by] : others) {
            work();
            addMove(w.node, mover, by.first + (by.second - by.first) * w.share);
          }
        }
      }
    }
  }
  bool cameOf(double shape, double ancestor) const {
    while (shape > ancestor) {
      work();
      const auto parent = parents_.find(shape);
      if (parent == parents_.end() || parent->second >= shape) return false;
      shape = parent->second;
    }
    return shape == ancestor;
  }

  static uint32_t edgeCount(const MeshLoop& loop) {
    return loop.cornerCount > 2 ? loop.cornerCount : loop.cornerCount - 1;
  }
  void noteEdgeTags(const Mesh& m, const std::vector<uint32_t>& nodes) {
    for (const MeshFace& f : m.faces) {
      const MeshLoop& loop = m.loops[f.firstLoop];
      if (loop.cornerCount != 2) continue;
      const uint32_t a = loop.firstCorner;
      const uint32_t tags = m.edgeTagsAt(a) != 0 ? m.edgeTagsAt(a) : f.tags;
      const auto [low, high] = std::minmax(nodes[a], nodes[a + 1]);
      if (tags != 0) edgeTags_.try_emplace({low, high}, tags);
    }
  }

  Vec3 placeOf(uint32_t node) const {
    Vec3 p = nodes_[node];
    for (const Move& m : moves_[node]) p += m.by;
    return p;
  }
  uint32_t positionOf(uint32_t node) {
    const auto [at, fresh] = positions_.try_emplace(node, 0u);
    if (fresh) at->second = builder_.addPosition(placeOf(node), vertexTags_[node]);
    return at->second;
  }
  uint32_t positionOf(Source& source, uint32_t corner) {
    if (source.nodes[corner] != kNone) return positionOf(source.nodes[corner]);
    const uint32_t position = source.mesh->corners[corner];
    const auto [at, fresh] = source.own.try_emplace(position, 0u);
    if (fresh) at->second = builder_.copyPosition(*source.mesh, position);
    return at->second;
  }

  void addFace(Source& source, size_t face) {
    const Mesh& m = *source.mesh;
    const bool isLoose = m.loopsOf(face)[0].cornerCount < 3;
    if (isLoose && loose_ == LooseParts::Move) return;
    const MeshFace& f = m.faces[face];
    builder_.beginFace(f.materialSlot, f.tags, f.smooth);
    const bool withNormals = !m.normals.empty() && staysInPlace(source, face);
    for (const MeshLoop& loop : m.loopsOf(face)) {
      builder_.beginLoop();
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const uint32_t a = loop.firstCorner + i;
        const uint32_t b = loop.firstCorner + (i + 1) % loop.cornerCount;
        const uint32_t position = positionOf(source, a);
        addEdge(source, {a, isLoose ? a : b}, position, withNormals);
      }
    }
  }
  // Nothing but the part itself moved the face.
  bool staysInPlace(const Source& source, size_t face) const {
    for (const MeshLoop& loop : source.mesh->loopsOf(face)) {
      for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
        work();
        if (source.nodes[c] == kNone) continue;
        if (!same(placeOf(source.nodes[c]), source.mesh->at(c))) return false;
      }
    }
    return true;
  }

  struct CornerPair {
    uint32_t from, to;
  };
  // The corner where an edge of a face begins, and those at the nodes within the edge.
  void addEdge(const Source& source, CornerPair edge, uint32_t position, bool withNormals) {
    const Mesh& m = *source.mesh;
    const uint32_t a = source.nodes[edge.from], b = source.nodes[edge.to];
    std::vector<NodesWithin::Within> within;
    if (a != kNone && b != kNone && a != b) within = within_->find(a, b);
    const bool untouched = source.mesh == &whole_;
    uint32_t from = a;
    for (size_t k = 0; k <= within.size(); ++k) {
      const uint32_t to = k < within.size() ? within[k].node : b;
      const double share = k == 0 ? 0 : within[k - 1].share;
      const uint32_t tags = m.edgeTagsAt(edge.from);
      const uint32_t made = builder_.addCorner(k == 0 ? position : positionOf(within[k - 1].node),
                                               untouched ? tagsOf(from, to, tags) : tags);
      for (int set = 0; set < m.setCount(); ++set) {
        if (!m.hasUv(set)) continue;
        const Vec2 uv = m.set(set)[edge.from];
        builder_.setUv(made, set, uv + (m.set(set)[edge.to] - uv) * share);
      }
      if (withNormals) {
        const Vec3& n = m.normals[edge.from];
        builder_.setNormal(made, k == 0 ? n : normalized(n + (m.normals[edge.to] - n) * share));
      }
      from = to;
    }
  }
  // What an edited edge says of a part of an untouched one.
  uint32_t tagsOf(uint32_t a, uint32_t b, uint32_t otherwise) const {
    const auto found = edgeTags_.find({std::min(a, b), std::max(a, b)});
    return found == edgeTags_.end() ? otherwise : found->second;
  }

  const Mesh& whole_;
  const std::vector<Mesh>& parts_;
  LooseParts loose_;
  size_t level_;
  VertexPool nodes_;
  /// The untouched faces, and then the parts.
  std::vector<Source> sources_;
  std::optional<NodesWithin> within_;
  // By node.
  std::vector<std::vector<Move>> moves_;
  std::vector<uint32_t> vertexTags_;
  /// By shape, the one that was divided into it.
  std::map<double, double> parents_;
  std::map<uint32_t, uint32_t> positions_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> edgeTags_;
  MeshBuilder builder_;
};

}  // namespace

Mesh recomposed(const Mesh& whole, const std::vector<Mesh>& parts, LooseParts loose) {
  return Recomposition(whole, parts, loose).run();
}

}  // namespace gable
