// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Assets: models that rules insert, read from OBJ and glTF into one mesh with materials by slot.
//
// Promises: any bytes end in an asset or an Error, in time and memory in proportion to the input;
// the mesh is valid (geom/mesh), every face has an area, and no material slot is beyond
// `materials`.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "geom/mesh/mesh.h"
#include "material/material.h"
#include "scene/scene.h"

namespace gable {

struct Asset {
  MeshRef mesh;
  /// By slot of the mesh; at least one.
  std::vector<Material> materials;
  /// Names of the parts of the file (OBJ groups, glTF nodes), and the part of each face.
  std::vector<std::string> groups;
  std::vector<uint32_t> faceGroups;
  /// By slot, the name of its part; filled in by divideSlots.
  std::vector<std::string> slotGroups;
  /// Properties that the file carries of itself.
  std::vector<std::pair<std::string, PlainValue>> metadata;
  Box3 bounds;
  /// Textures that the file holds itself, by the name that `materials` use for them: the asset's
  /// path,
  /// '#' and the file's own numbering.
  std::map<std::string, std::string> textures;
  /// One sentence each: what was left out.
  std::vector<std::string> warnings;
};

/// The bytes of another file that the asset names, by project path.
using FileReader = std::function<Result<std::string>(const std::string& path)>;

struct AssetOptions {
  /// The project path of the asset: its folder is where the files it names lie.
  std::string path;
  /// Material files, buffers and the like; without it they are left out with a warning.
  FileReader readFile;
  /// Turns a model with z up so that y is up.
  bool zUp = false;
};

/// Slots are numbers of 16 bits, and a shape's own material takes one more.
constexpr size_t kMostMaterials = 65534;

/// By the content and the extension. Codes: asset-broken, asset-empty, asset-unknown,
/// asset-too-large, asset-converter.
Result<Asset> readAsset(std::string_view bytes, const AssetOptions& options);
Result<Asset> readObjAsset(std::string_view text, const AssetOptions& options);
Result<Asset> readGltfAsset(std::string_view bytes, const AssetOptions& options);

/// Divides the slots of the mesh by `faceGroups`, so that each slot has faces of one material and
/// one group, in the order of their first faces; fills in `slotGroups`. Where no group has a name,
/// or there are more than slots can be, all stays as it is.
void divideSlots(Mesh& mesh, Asset& asset);

/// The project path of a file that is named relative to another: "a/b.obj" and "../t/c.png" give
/// "t/c.png". Backslashes are slashes. What would leave the project keeps its leading "..".
std::string relativeTo(const std::string& base, std::string_view name);

}  // namespace gable
