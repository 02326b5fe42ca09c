// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The library of materials that rules name by material("brick.flemish"). Its pictures are made by
// the engine itself, the same bytes each time.
#pragma once

#include <string>
#include <vector>

#include "gable/gable.h"

namespace gable {

struct LibraryMaterialInfo {
  std::string name;
  /// One sentence.
  std::string doc;
  /// The tile that repeats, in metres.
  double width = 0, height = 0;
  /// The colour that a tint replaces, "#rrggbb".
  std::string color;
};
/// Sorted by name.
std::vector<LibraryMaterialInfo> libraryMaterials();

/// Writes color.jpg, normal.jpg, surface.jpg and material.mtl into a folder that exists: a material
/// of one's own to begin with. Codes: unknown-material, file-unwritable.
WriteResult writeLibraryMaterial(const std::string& name, const std::string& folder);

}  // namespace gable
