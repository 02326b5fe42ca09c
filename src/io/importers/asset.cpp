// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/asset.h"

#include <algorithm>

#include "base/files.h"
#include "io/importers/converted.h"

namespace gable {

std::string relativeTo(const std::string& base, std::string_view name) {
  std::string path(name);
  for (char& c : path) {
    if (c == '\\') c = '/';
  }
  if (path.empty() || path[0] != '/') path = folderOf(base) + path;
  // Resolve "." and ".." part by part.
  std::vector<std::string_view> parts;
  const bool absolute = !path.empty() && path[0] == '/';
  for (size_t i = 0; i <= path.size();) {
    const size_t end = std::min(path.find('/', i), path.size());
    const std::string_view part = std::string_view(path).substr(i, end - i);
    i = end + 1;
    if (part.empty() || part == ".") continue;
    if (part == ".." && !parts.empty() && parts.back() != "..") {
      parts.pop_back();
    } else {
      parts.push_back(part);
    }
  }
  std::string out = absolute ? "/" : "";
  for (const std::string_view part : parts) {
    if (!out.empty() && out.back() != '/') out += '/';
    out += part;
  }
  return out;
}

Result<Asset> readAsset(std::string_view bytes, const AssetOptions& options) {
  const std::string extension = extensionOf(options.path);
  if (bytes.substr(0, 4) == "glTF" || extension == "gltf" || extension == "glb") {
    return readGltfAsset(bytes, options);
  }
  if (extension == "obj") return readObjAsset(bytes, options);
  if (isConvertible(options.path)) {
    Result<ConvertedModel> model = convertModel(bytes, options);
    return model.ok() ? readObjAsset(model->obj, model->options) : model.error();
  }
  return Error{"asset-unknown", "'" + options.path + "' is no model that can be read",
               "convert it to glTF or OBJ"};
}

}  // namespace gable
