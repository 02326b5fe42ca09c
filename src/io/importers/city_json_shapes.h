// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// City models as initial shapes: an object of a CityJSON file that has surfaces is a shape, in its
// finest level of detail. What is known of a surface is a tag of the face ("RoofSurface"), and
// attributes of the object are attributes of the shape; a part of a building has those of the
// building as well. The type of the object is the attribute cityType.
#pragma once

#include <string>

#include "base/json.h"
#include "io/importers/shape_input.h"

namespace gable {

/// Codes: shapes-broken, shapes-empty. What cannot be read is a warning that names the object.
Result<ShapeFile> readCityJsonShapes(const JsonValue& root, const std::string& path,
                                     const FeatureFilter& filter);

}  // namespace gable
