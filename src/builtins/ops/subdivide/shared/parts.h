// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Children that are a part of their parent: what split-like operations give out.
#pragma once

#include "geom/mesh/mesh.h"
#include "shape/op_call.h"
#include "shape/shape.h"

namespace gable {

/// A copy of the parent whose scope is the part [start, start + size] along an axis, measured from
/// the scope's origin in the direction of its extent (so against the axis where the size is
/// negative). Geometry, pivot and all else are the parent's.
Shape scopePart(const Shape& parent, Axis axis, double start, double size);

/// Gives `child`, which was made by scopePart or is a copy of the parent, a mesh in the parent's
/// scope coordinates. With `adjust` the scope becomes the mesh's bounding box along the same axes;
/// sizes that were negative stay negative.
void setPartMesh(Shape& child, const Shape& parent, Mesh mesh, bool adjust);

/// The failure of a split along an axis in which the scope has no extent.
[[gnu::cold]] Status flatAlong(const OpCall& call, Axis axis);

}  // namespace gable
