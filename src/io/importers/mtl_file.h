// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// MTL: the materials that an OBJ file names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "material/material.h"

namespace gable {

/// In the order of the file; of a name that comes again the last counts. Texture paths are made
/// relative to `path`, the project path of the file. `losses` gets at most two sentences with the
/// file and a line: one about statements that have no counterpart, one about those that cannot be
/// read. How light is to be computed (illum, Ni, sharpness) is passed over without a word.
std::vector<Material> parseMtl(std::string_view text, const std::string& path,
                               std::vector<std::string>& losses);

}  // namespace gable
