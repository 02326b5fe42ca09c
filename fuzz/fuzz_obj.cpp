// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as OBJ, as its material file, and as a file of shapes: reading ends in valid meshes or
// in a status.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/check.h"
#include "io/importers/shape_input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gable;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  AssetOptions options;
  options.path = "models/a.obj";
  options.readFile = [&](const std::string&) -> Result<std::string> { return std::string(text); };
  const Result<Asset> asset = readObjAsset(text, options);
  if (asset.ok()) {
    const Mesh& m = *asset.value().mesh;
    GABLE_CHECK(m.valid());
    GABLE_CHECK_EQ(asset.value().faceGroups.size(), m.faceCount());
    for (const MeshFace& f : m.faces) {
      GABLE_CHECK_LT(size_t{f.materialSlot}, asset.value().materials.size());
    }
  }
  const Result<ShapeFile> shapes = readObjShapes(text, options);
  if (shapes.ok()) {
    for (const ShapeInput& s : shapes.value().shapes) GABLE_CHECK(s.mesh.valid());
  }
  return 0;
}
