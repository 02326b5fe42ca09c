// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <numeric>

#include "io/importers/asset.h"
#include "io/importers/face_filter.h"
#include "io/importers/obj_parts.h"

namespace gable {

Result<Asset> readObjAsset(std::string_view text, const AssetOptions& options) {
  const ObjFile file = parseObj(text);
  std::vector<std::string> warnings;
  Result<ObjMaterials> materials = objMaterials(file, options, warnings, warnings);
  if (!materials.ok()) return materials.error();
  std::vector<uint32_t> faces(file.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  Result<ObjPart> part = objPart(file, faces, *materials, {}, options);
  if (!part.ok()) return part.error();
  Asset out = std::move(part->asset);
  out.warnings = std::move(warnings);
  if (part->dropped > 0) {
    out.warnings.push_back(std::to_string(part->dropped) + " faces without area are left out");
  }
  if (file.badLines > 0) {
    out.warnings.push_back(
        options.path + ":" + std::to_string(file.firstBadLine) + ": " + file.firstBadReason +
        (file.badLines > 1 ? "; " + std::to_string(file.badLines) + " lines in all cannot be read"
                           : ""));
  }
  return finishAsset(std::move(part->mesh), std::move(out), options);
}

}  // namespace gable
