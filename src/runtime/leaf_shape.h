// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A leaf of a worker's output, and the shape that it stands for.
#pragma once

#include "runtime/output.h"
#include "shape/shape.h"

namespace gable {

/// Gives the leaf the geometry, frame and size of a shape that has geometry. What else it is stays.
void setShape(Leaf& leaf, const Shape& s, Output& output);

/// A shape with the geometry, frame, size, materials and attributes of the leaf, and nothing else.
Shape shapeOf(const Leaf& leaf, const Output& output);

/// Null for a box or a rectangle.
MeshRef meshOf(const Leaf& leaf, const Output& output);

}  // namespace gable
