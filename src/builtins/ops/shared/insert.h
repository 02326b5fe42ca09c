// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How geometry is put into a scope: an asset or a primitive with a bounding box of its own comes to
// fill the scope, and fills in the sizes that the scope does not have.
#pragma once

#include "math/box.h"
#include "shape/op_call.h"
#include "shape/shape.h"

namespace gable {

/// Fills in zero sizes of the scope from the bounding box of what is inserted:
///   1. three zeros: the scope takes size and place of the box;
///   2. two zeros: size and place are those of the box times the one known ratio;
///   3. one zero: the size is that of the box times the mean of the two known ratios.
/// A dimension in which the box is flat gives no ratio and stays as it is.
void fillZeroSizes(Shape& s, const Box3& box);

/// Gives the shape a mesh that fills its scope; `box` is the mesh's bounding box, in which it is
/// moved to begin at the origin. Faces turn round when the scope is mirrored. Materials of an
/// earlier asset are dropped.
void insertMesh(Shape& s, Mesh mesh, const Box3& box);

}  // namespace gable
