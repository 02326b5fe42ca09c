// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces that move together form a group: all of a connected part, or in FaceNormal mode its
// coplanar neighbours. A group has its own copies of its positions, low (original) and high
// (moved), which are the same one where nothing moves. An edge between two faces of a group gets no
// side.
#include "geom/mesh/extrude.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/work.h"
#include "geom/mesh/topology.h"

namespace gable {
namespace {

// Neighbours whose normals differ by less (degrees) are extruded as one.
constexpr double kCoplanar = 1e-3;
// Moves shorter than this are none.
constexpr double kNoMove = 1e-12;

class Extrusion {
 public:
  Extrusion(const Mesh& m, const ExtrudeOptions& options)
      : mesh_(m), options_(options), topology_(m) {}

  ExtrudeResult run() {
    findGroups();
    findMoves();
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) extrudeFace(f);
    result_.mesh = builder_.take();
    return std::move(result_);
  }

 private:
  void findGroups() {
    group_.resize(mesh_.faces.size());
    for (uint32_t f = 0; f < group_.size(); ++f) group_[f] = f;
    for (uint32_t e = 0; e < topology_.edgeCount(); ++e) {
      work();
      const uint32_t c = topology_.usesOf(e)[0], twin = topology_.twin(c);
      if (twin == Topology::kNone) continue;
      const bool together = options_.mode != ExtrudeMode::FaceNormal ||
                            std::fabs(topology_.dihedralAngle(e)) < kCoplanar;
      if (together) group_[rootOf(topology_.faceOf(c))] = rootOf(topology_.faceOf(twin));
    }
    groupNormal_.resize(mesh_.faces.size());
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f)
      groupNormal_[rootOf(f)] += mesh_.areaNormal(f);
    for (Vec3& n : groupNormal_) n = normalized(n);
  }

  uint32_t rootOf(uint32_t f) {
    while (group_[f] != f) f = group_[f] = group_[group_[f]];
    return f;
  }

  bool isEdge(uint32_t face) const { return mesh_.loopsOf(face)[0].cornerCount == 2; }

  void findMoves() {
    if (options_.mode == ExtrudeMode::VertexNormal) {
      vertexMoves_ = vertexNormals(mesh_);
      addEdgeNormals();
    } else if (options_.mode == ExtrudeMode::FlatTop) {
      double low = 0, high = 0;
      bool first = true;
      for (const uint32_t p : mesh_.corners) {
        work();
        const double h = dot(options_.direction, mesh_.positions[p]);
        low = first ? h : std::min(low, h);
        high = first ? h : std::max(high, h);
        first = false;
      }
      target_ = options_.distance < 0 ? high + std::min(options_.distance, low - high)
                                      : low + std::max(options_.distance, high - low);
    }
  }

  // Positions of edges move along the mean of the edges' corner normals.
  void addEdgeNormals() {
    if (mesh_.normals.empty()) return;
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      work(2);
      if (!isEdge(f)) continue;
      for (uint32_t c : {mesh_.loopsOf(f)[0].firstCorner, mesh_.loopsOf(f)[0].firstCorner + 1}) {
        vertexMoves_[mesh_.corners[c]] += mesh_.normals[c];
      }
    }
    for (Vec3& n : vertexMoves_) n = normalized(n);
  }

  Vec3 moveOf(uint32_t face, uint32_t corner) {
    const uint32_t position = mesh_.corners[corner];
    switch (options_.mode) {
      case ExtrudeMode::FaceNormal:
        if (!isEdge(face)) return groupNormal_[rootOf(face)] * options_.distance;
        if (!mesh_.normals.empty()) return normalized(mesh_.normals[corner]) * options_.distance;
        return options_.direction * options_.distance;
      case ExtrudeMode::VertexNormal: return vertexMoves_[position] * options_.distance;
      case ExtrudeMode::Along: return options_.direction * options_.distance;
      case ExtrudeMode::FlatTop: break;
    }
    return options_.direction * (target_ - dot(options_.direction, mesh_.positions[position]));
  }

  struct Pair {
    uint32_t low, high;
  };

  // The group's copies of a corner's position.
  Pair positionsOf(uint32_t face, uint32_t corner) {
    const uint64_t key = (static_cast<uint64_t>(rootOf(face)) << 32) | mesh_.corners[corner];
    const auto [it, isNew] = pairs_.try_emplace(key);
    if (!isNew) return it->second;
    const Vec3 move = moveOf(face, corner);
    const uint32_t tags = mesh_.vertexTagsAt(mesh_.corners[corner]);
    const uint32_t low = builder_.addPosition(mesh_.at(corner), tags);
    it->second = {low, low};
    if (length(move) > kNoMove) {
      it->second.high = builder_.addPosition(mesh_.at(corner) + move, tags);
    }
    return it->second;
  }

  // Whether the face moves to the side that its normal looks to.
  bool movesForward(uint32_t face) {
    double sum = 0;
    const Vec3 normal = mesh_.normal(face);
    const MeshLoop& loop = mesh_.loopsOf(face)[0];
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      work();
      sum += dot(normal, moveOf(face, loop.firstCorner + i));
    }
    return sum >= 0;
  }

  void extrudeFace(uint32_t face) {
    const bool forward = movesForward(face);
    if (!isEdge(face)) addCap(face, false, forward);
    bool outer = true;
    for (const MeshLoop& loop : mesh_.loopsOf(face)) {
      if (loop.cornerCount < 2) continue;
      const uint32_t edges = isEdge(face) ? 1 : loop.cornerCount;
      for (uint32_t i = 0; i < edges; ++i) {
        work(4);
        addSide(face, loop.firstCorner + i, loop.firstCorner + (i + 1) % loop.cornerCount, forward,
                outer ? ExtrudeRole::SideOuter : ExtrudeRole::SideInner);
      }
      outer = false;
    }
    if (!isEdge(face)) addCap(face, true, forward);
  }

  void addCap(uint32_t face, bool moved, bool forward) {
    const MeshFace& f = mesh_.faces[face];
    builder_.beginFace(f.materialSlot, f.tags, f.smooth);
    note(face, moved ? ExtrudeRole::Top : ExtrudeRole::Bottom);
    const bool turned = moved != forward;
    for (const MeshLoop& loop : mesh_.loopsOf(face)) {
      builder_.beginLoop();
      const uint32_t n = loop.cornerCount;
      for (uint32_t i = 0; i < n; ++i) {
        work(4);
        const uint32_t c = loop.firstCorner + (turned ? (n - i) % n : i);
        const uint32_t edge = loop.firstCorner + (turned ? n - 1 - i : i);
        const Pair p = positionsOf(face, c);
        addCorner(moved ? p.high : p.low, c, tagsOf(edge));
      }
    }
  }

  void addSide(uint32_t face, uint32_t a, uint32_t b, bool forward, ExtrudeRole role) {
    const uint32_t twin = topology_.twin(a);
    if (!isEdge(face) && twin != Topology::kNone &&
        rootOf(topology_.faceOf(twin)) == rootOf(face)) {
      return;
    }
    const Pair pa = positionsOf(face, a), pb = positionsOf(face, b);
    if (pa.low == pa.high && pb.low == pb.high) return;
    builder_.beginFace(mesh_.faces[face].materialSlot, 0, false);
    note(face, role);
    builder_.beginLoop();
    // The edge that belongs to the original or the moved face carries its tags, and the edge that a
    // vertex leaves behind those of the vertex.
    const uint32_t first = forward ? pa.low : pa.high, second = forward ? pb.low : pb.high;
    const uint32_t third = forward ? pb.high : pb.low, fourth = forward ? pa.high : pa.low;
    addCorner(first, a, tagsOf(a));
    addCorner(second, b, second == third ? tagsOf(a) : vertexTagsOf(b));
    if (third != second) addCorner(third, b, tagsOf(a));
    if (fourth != first) addCorner(fourth, a, vertexTagsOf(a));
  }

  void note(uint32_t face, ExtrudeRole role) {
    result_.roles.push_back(role);
    result_.faceSource.push_back(face);
  }

  uint32_t tagsOf(uint32_t corner) const { return mesh_.edgeTagsAt(corner); }
  uint32_t vertexTagsOf(uint32_t corner) const { return mesh_.vertexTagsAt(mesh_.corners[corner]); }

  void addCorner(uint32_t position, uint32_t source, uint32_t tags) {
    const uint32_t corner = builder_.addCorner(position, tags);
    for (int s = 0; s < mesh_.setCount(); ++s) {
      if (mesh_.hasUv(s)) builder_.setUv(corner, s, mesh_.set(s)[source]);
    }
  }

  const Mesh& mesh_;
  const ExtrudeOptions& options_;
  Topology topology_;
  std::vector<uint32_t> group_;
  std::vector<Vec3> groupNormal_, vertexMoves_;
  double target_ = 0;
  std::unordered_map<uint64_t, Pair> pairs_;
  MeshBuilder builder_;
  ExtrudeResult result_;
};

}  // namespace

ExtrudeResult extrude(const Mesh& m, const ExtrudeOptions& options) {
  if (options.mode != ExtrudeMode::FlatTop && std::fabs(options.distance) <= kNoMove) {
    ExtrudeResult same{m, {}, {}};
    for (uint32_t f = 0; f < m.faces.size(); ++f) {
      same.roles.push_back(ExtrudeRole::Bottom);
      same.faceSource.push_back(f);
    }
    return same;
  }
  return Extrusion(m, options).run();
}

}  // namespace gable
