// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Roof edges: which edges of a mesh are eaves, hips, valleys and ridges. Faces that look up are the
// roof; upright ones and those that look down are not.
//
//   eave    at one face of the roof, and level: the low edge of a slope, both of a shed roof
//   valley  between two faces of the roof that fold inward
//   hip     between two others, and it begins at an eave
//   ridge   between two others
//
// Eaves run as their face does, the other edges upward.
#pragma once

#include <span>
#include <vector>

#include "builtins/mesh_edges.h"
#include "builtins/selection.h"
#include "geom/mesh/mesh.h"

namespace gable {

/// What an edge is, and from which position to which it runs.
struct PlacedEdge {
  RoofEdge what = RoofEdge::None;
  uint32_t from = 0, to = 0;
};

/// By the number of the edge. `normals` are those of the faces. Of several ways that may be up, the
/// one that makes most edges eaves, the first of them on a tie. O(edges) for each.
std::vector<PlacedEdge> roofEdges(const Mesh& m, const MeshEdges& edges,
                                  std::span<const Vec3> normals, std::span<const Vec3> ups);

/// The ways that may be up for a shape's mesh, all in scope coordinates. A face with the tag
/// roof.bottom decides; else it is the scope's, the world's, or where faces with the tag roof.top
/// look together: those of a whole roof cancel each other out in all directions but up.
std::vector<Vec3> waysUp(OpCall& call, const Mesh& m);

}  // namespace gable
