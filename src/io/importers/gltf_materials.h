// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// glTF's materials in CGA's terms: the opposite of io/exporters/gltf_materials.h.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/importers/gltf_file.h"

namespace gable {

struct GltfMaterial {
  Material material;
  /// By texture layer: the TEXCOORD number that it reads, -1 where it has no texture.
  std::array<int, kTextureLayers> texcoords;
};

/// All materials of the file, in its order. Pictures inside the file go to `asset.textures`.
std::vector<GltfMaterial> readGltfMaterials(const GltfFile& file, const AssetOptions& options,
                                            Asset& asset);

}  // namespace gable
