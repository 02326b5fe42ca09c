// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Components: the faces, edges, vertices, materials or holes of a mesh as a component split counts
// and selects them, and the axes that each gives its shape.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "builtins/mesh_edges.h"
#include "builtins/selection.h"
#include "geom/mesh/mesh.h"

namespace gable {

enum class ComponentKind : uint8_t {
  Faces,
  Edges,
  FaceEdges,
  Vertices,
  FaceVertices,
  /// Materials and groups: what has the same slot, as a table of first slots tells.
  Slots,
  Holes,
};

struct Component {
  Selectable what;
  /// The face; the first slot of Slots.
  uint32_t face = 0;
  /// The corner it begins at: of faces the first, of edges the start, of holes the first.
  uint32_t corner = 0;
  /// Its origin and axes in scope coordinates: x and z of the shape.
  Vec3 origin, x, z;
  /// For edges: from and to, as positions, in the direction of x.
  uint32_t from = 0, to = 0;
};

/// What is up where nobody asks for the edges of roofs: the y axis of the scope.
inline constexpr Vec3 kUp[] = {{0, 1, 0}};

class Components : public ComponentSource {
 public:
  /// Of a mesh in scope coordinates, which must outlive this. `firstSlots` tells of each slot the
  /// first one that counts as the same. O(n log n).
  /// `ups`: the ways that may be up for the edges of roofs.
  Components(const Mesh& m, ComponentKind kind, std::vector<uint16_t> firstSlots = {},
             std::span<const Vec3> ups = kUp);

  const std::vector<Component>& list() const { return list_; }
  const MeshEdges& edges() const { return *edges_; }

  /// The geometry of some components (by number) in scope coordinates. Takes time by what it makes.
  Mesh meshOf(const std::vector<uint32_t>& which);
  /// The components as connected sets, in the order of their first members.
  std::vector<std::vector<uint32_t>> connected(const std::vector<uint32_t>& which) const;

  void tagsOf(const Selectable& c, Of of, std::vector<uint32_t>& out) const override;
  void pointsOf(const Selectable& c, std::vector<Vec3>& out) const override;

 private:
  void addFaces();
  void addEdges(std::span<const Vec3> ups);
  void addFaceEdges();
  void addVertices();
  void addFaceVertices();
  void addSlots();
  uint32_t slotOf(uint32_t face) const;
  std::span<const uint32_t> facesOfSlot(uint32_t slot) const;
  void addHoles();
  void placeRoofEdges(std::span<const Vec3> ups);
  bool facesBorder(uint32_t face) const;
  Vec3 meanNormalOfEdge(uint32_t edge) const;
  void faceTags(uint32_t face, Of of, std::vector<uint32_t>& out) const;
  void ownTags(const Component& c, std::vector<uint32_t>& out) const;
  void edgeTags(uint32_t edge, std::vector<uint32_t>& out) const;
  void vertexTags(uint32_t position, std::vector<uint32_t>& out) const;

  const Mesh& mesh_;
  ComponentKind kind_;
  std::unique_ptr<MeshEdges> edges_;
  std::vector<Vec3> normals_;
  std::vector<Component> list_;
  std::vector<uint16_t> firstSlots_;
  /// Of components by slot: the faces, those of one slot together.
  std::vector<uint32_t> bySlot_;
  /// Where meshOf puts positions; empty of them between its calls.
  std::vector<uint32_t> positionMap_;
};

}  // namespace gable
