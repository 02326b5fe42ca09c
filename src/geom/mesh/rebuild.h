// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rebuild: writes a mesh anew from corners of an old one, with all their attributes and without
// positions that nothing uses. Positions keep their order of first use.
#pragma once

#include <unordered_map>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

class Rebuild {
 public:
  explicit Rebuild(const Mesh& from)
      : from_(from), map_(from.positions.size(), MeshBuilder::kNoPosition) {}

  /// From now on the corner's edge has the tags of another corner's edge.
  void setEdge(uint32_t corner, uint32_t edgeCorner) { edges_[corner] = edgeCorner; }

  /// A face with the attributes of face `like`, whose loops are lists of corners of the old mesh.
  void addFace(uint32_t like, const std::vector<std::vector<uint32_t>>& loops) {
    const MeshFace& f = from_.faces[like];
    builder_.beginFace(f.materialSlot, f.tags, f.smooth);
    for (const auto& loop : loops) {
      builder_.beginLoop();
      for (const uint32_t c : loop) addCorner(c);
    }
  }
  /// The face as it was.
  void addFace(uint32_t face) { builder_.copyFace(from_, face, map_); }

  Mesh take() { return builder_.take(); }

 private:
  void addCorner(uint32_t c) {
    uint32_t& position = map_[from_.corners[c]];
    if (position == MeshBuilder::kNoPosition) {
      position = builder_.copyPosition(from_, from_.corners[c]);
    }
    uint32_t tags = 0;
    if (!from_.edgeTags.empty()) {
      const auto other = edges_.find(c);
      tags = from_.edgeTags[other == edges_.end() ? c : other->second];
    }
    const uint32_t corner = builder_.addCorner(position, tags);
    for (int s = 0; s < from_.setCount(); ++s) {
      if (from_.hasUv(s)) builder_.setUv(corner, s, from_.set(s)[c]);
    }
    if (!from_.normals.empty()) builder_.setNormal(corner, from_.normals[c]);
  }

  const Mesh& from_;
  MeshBuilder builder_;
  std::vector<uint32_t> map_;
  std::unordered_map<uint32_t, uint32_t> edges_;
};

}  // namespace gable
