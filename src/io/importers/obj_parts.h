// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces of an OBJ file as a mesh with materials by slot and groups by face: all of them for an
// asset, some for an initial shape.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/importers/asset.h"
#include "io/importers/obj_file.h"

namespace gable {

using ObjMaterials = std::map<std::string, Material>;

/// The materials of the files that `file` names. Files that cannot be read are told in `missing`,
/// what is left out of the others in `losses`.
Result<ObjMaterials> objMaterials(const ObjFile& file, const AssetOptions& options,
                                  std::vector<std::string>& missing,
                                  std::vector<std::string>& losses);

struct ObjPartWishes {
  bool groups = true;
  /// A material without a definition is none; else it is a plain one with the name.
  bool definedOnly = false;
  bool normals = true;
};

struct ObjPart {
  Mesh mesh;
  /// Materials of the mesh's slots and groups of its faces, and no more.
  Asset asset;
  /// Faces without area.
  uint64_t dropped = 0;
};

/// Linear in the faces and their corners. Code: asset-too-large.
Result<ObjPart> objPart(const ObjFile& file, std::span<const uint32_t> faces,
                        const ObjMaterials& materials, const ObjPartWishes& wishes,
                        const AssetOptions& options);

}  // namespace gable
