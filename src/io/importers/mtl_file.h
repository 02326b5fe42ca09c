// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// MTL: the materials that an OBJ file names.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "material/material.h"

namespace gable {

/// By name; the last of a name counts. Texture paths are made relative to `path`, the project path
/// of the file. Statements that have no counterpart are passed over.
std::map<std::string, Material> parseMtl(std::string_view text, const std::string& path);

}  // namespace gable
