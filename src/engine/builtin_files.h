// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files that rules name and that are in no project: pictures, models and materials of the program.
#pragma once

#include <string_view>

#include "shape/services.h"

namespace gable {

/// Of a path that begins with "builtin:". A material is "builtin:materials/NAME/material.mtl".
bool isBuiltinFile(std::string_view path);

/// What is known of a built-in picture before it is drawn; not found for any other path.
ImageInfo builtinImage(std::string_view path);

}  // namespace gable
