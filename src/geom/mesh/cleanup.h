// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Cleaning of meshes: near vertices, collinear vertices, coplanar neighbours, duplicate and
// degenerate faces. Frame and units are the mesh's, angles degrees.
//
// What can be seen stays: faces of different material, tags or shading are never united; an edge
// with tags and an edge where uvs or normals jump or change their slope stays; a vertex stays where
// edge tags change or a uv or normal is not what its neighbours interpolate to. Each function
// rewrites the mesh without unused positions, keeps the order of faces (a united face takes the
// place of its first one), and gives for each face its source (the first of those united). Faces of
// one or two corners (points, edges) pass through. O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

using FaceSources = std::vector<uint32_t>;

/// Makes positions within `distance` of each other one (the first of them), and drops the edges and
/// faces that collapse by it. A distance of 0 merges identical positions.
FaceSources mergePositions(Mesh& m, double distance);

/// Drops vertices at which every face that uses them turns by at most `angle`.
FaceSources removeCollinearVertices(Mesh& m, double angle);

/// Unites faces across edges that exactly two share, where the normal of each is within `angle` of
/// that of the first. Faces with holes may result; what would not be one simple face stays apart.
FaceSources mergeCoplanarFaces(Mesh& m, double angle);

/// Drops faces whose area is at most `area` (or 1e-12 of their box's). Where such a face stood
/// between others a crack may open: mergeCoplanarFaces first.
FaceSources dropDegenerateFaces(Mesh& m, double area);

/// Drops later copies of a face with the same corners in the same direction.
FaceSources dropDuplicateFaces(Mesh& m);

/// True when the face has three corners or more and an area of at most `area` or 1e-12 of its
/// box's.
bool isDegenerate(const Mesh& m, size_t face, double area = 0);

struct CleanupOptions {
  bool vertices = true, edges = true, faces = true;
  /// 0: only what matches; 1: 1 m, 10 degrees, 1 square metre; linear between.
  double tolerance = 0;
};

/// CGA's cleanupGeometry: merges positions, then cleans the chosen components.
FaceSources cleanup(Mesh& m, const CleanupOptions& options);

}  // namespace gable
