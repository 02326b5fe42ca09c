// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as glTF or GLB, the files that it names included: reading ends in valid meshes or in a
// status.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/check.h"
#include "io/importers/shape_input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gable;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  AssetOptions options;
  options.path = "models/a.glb";
  options.readFile = [&](const std::string&) -> Result<std::string> { return std::string(bytes); };
  const Result<Asset> asset = readGltfAsset(bytes, options);
  if (asset.ok()) {
    const Mesh& m = *asset.value().mesh;
    GABLE_CHECK(m.valid());
    GABLE_CHECK_EQ(asset.value().faceGroups.size(), m.faceCount());
    for (const MeshFace& f : m.faces) {
      GABLE_CHECK_LT(size_t{f.materialSlot}, asset.value().materials.size());
    }
  }
  // Uniting triangles is a matter of its own and slow on much of it.
  if (size < 20000) {
    const Result<ShapeFile> shapes = readGltfShapes(bytes, options);
    if (shapes.ok()) {
      for (const ShapeInput& s : shapes.value().shapes) GABLE_CHECK(s.mesh.valid());
    }
  }
  return 0;
}
