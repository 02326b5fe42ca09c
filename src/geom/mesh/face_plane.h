// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Between the faces of a mesh and plane polygons: where 2D operations on faces begin and end.
#pragma once

#include "geom/mesh/mesh.h"
#include "geom/region/region.h"

namespace gable {

/// A frame in the plane of a face: origin at its first corner, z its normal, x along its first edge
/// that has a length. The identity at the first corner for a face without area.
Frame faceFrame(const Mesh& m, size_t face);

/// A face in the xy coordinates of a frame (such as its faceFrame), ring by ring, corner by corner.
Polygon facePolygon(const Mesh& m, size_t face, const Frame& frame);

/// Adds a polygon that lies in the xy plane of a frame as a face with its own positions.
void addFace(MeshBuilder& b, const Polygon& p, const Frame& frame, uint16_t materialSlot = 0,
             uint32_t tags = 0);

/// A mesh of one face for each polygon.
Mesh meshOf(const Region& r, const Frame& frame);

}  // namespace gable
