// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How geometry is put into a scope: an asset or a primitive with a bounding box of its own comes to
// fill the scope, and fills in the sizes that the scope does not have.
#pragma once

#include <string>
#include <string_view>

#include "math/box.h"
#include "shape/op_call.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

/// Fills in zero sizes of the scope from the bounding box of what is inserted:
///   1. three zeros: the scope takes size and place of the box;
///   2. two zeros: size and place are those of the box times the one known ratio;
///   3. one zero: the size is that of the box times the mean of the two known ratios.
/// A dimension in which the box is flat gives no ratio and stays as it is.
void fillZeroSizes(Shape& s, const Box3& box);

/// Gives the scope a size of its own around the middle of its ground; negative heights go down.
void centerOnGround(Shape& s, const Vec3& size);

/// Gives the shape a mesh that fills its scope; `box` is the mesh's bounding box, in which it is
/// moved to begin at the origin. Faces turn round when the scope is mirrored. Materials of an
/// earlier asset are dropped, and the shape's trim planes cut.
void insertMesh(Shape& s, Mesh mesh, const Box3& box);
/// The same of a mesh that begins at the origin; it is shared where nothing has to be changed.
void insertMesh(Shape& s, MeshRef mesh, const Vec3& size);

/// The same with a primitive; sizes must not be negative.
void insertPrimitive(Shape& s, GeometryKind kind, bool uv);
/// A box that fills the scope, mirrored or not.
void insertBox(Shape& s, bool uv);

/// What stands for a model that cannot be had, and the warning that says so: the scope as a box, or
/// as the rectangle that it is. A scope of less than two sizes has no box, and the shape stays as
/// it was.
void insertPlaceholder(OpCall& call, std::string_view path, const std::string& why,
                       const char* hint);
/// Warns of what is left out of a model's file; messages about one file are told once.
void tellLosses(const OpCall& call, std::string_view path, const AssetModel& model);

/// Models that exist without a file: "builtin:cube", "builtin:cube:notex", "builtin:quad",
/// "builtin:disk", "builtin:sphere", "builtin:cylinder", "builtin:cone". They measure one metre.
/// An empty mesh for any other name.
Mesh builtinModel(std::string_view path);
/// The hint of a message about another name.
inline constexpr const char* kBuiltinModelNames =
    "the built-in models are builtin:cube, cube:notex, quad, disk, sphere, cylinder and cone";

const Box3 kUnitBox{{0, 0, 0}, {1, 1, 1}};

}  // namespace gable
