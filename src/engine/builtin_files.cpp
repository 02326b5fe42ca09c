// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/builtin_files.h"

#include "builtins/ops/shared/insert.h"
#include "io/image/leaf_pictures.h"
#include "io/image/patterns.h"
#include "io/image/surface.h"
#include "material/builtin_textures.h"
#include "material/library.h"

namespace gable {

bool isBuiltinFile(std::string_view path) {
  constexpr std::string_view kFolder = "builtin:materials/", kFile = "/material.mtl";
  if (path.starts_with(kFolder) && path.ends_with(kFile)) {
    path.remove_prefix(kFolder.size());
    return libraryMaterial(path.substr(0, path.size() - kFile.size())) != nullptr;
  }
  return isBuiltinTexture(path) || materialPictureOf(path).material != nullptr ||
         builtinModel(path).faceCount() > 0;
}

ImageInfo builtinImage(std::string_view path) {
  if (builtinLeaves(path) < kBuiltinLeaves.size()) {
    return {true, kLeafPictureSize, kLeafPictureSize, true};
  }
  if (materialPictureOf(path).material) return {true, kSurfaceSize, kSurfaceSize, false};
  if (path.starts_with(kBuiltinTexturePrefix) && isBuiltinTexture(path)) {
    return {true, kPatternSize, kPatternSize, false};
  }
  return {};
}

}  // namespace gable
