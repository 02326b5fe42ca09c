// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the readers of initial shapes from models have in common.
#pragma once

#include <string>

#include "base/json.h"
#include "io/importers/shape_input.h"

namespace gable {

/// The name of a file without folder and extension.
std::string stemOf(const std::string& path);
/// Of a file without any polygon. Code: shapes-empty.
Error emptyShapes(const std::string& path);
/// Warns of faces that were left out, unless there are none.
void noteDropped(ShapeFile& out, uint64_t faces);
/// A footprint that faces the ground would be built downward. Its outer ring is clockwise as seen
/// from above, which says nothing about what was meant; GeoJSON's rings are turned as well.
void turnFootprintsUp(ShapeFile& out);
/// The slots of a mesh that was read as an asset become those of a shape, which count from 1: their
/// materials, where one of them says anything, and their groups.
void takeMaterials(ShapeInput& shape, Asset part);

/// A number, text or bool as an attribute, or a list of one kind of them as an array of one row;
/// what is neither is left out. Maps name "roof:shape" what a rule calls roof_shape.
void addAttribute(const JsonValue::Member& member, ShapeInput& shape);

}  // namespace gable
