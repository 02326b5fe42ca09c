// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <filesystem>

#include "engine/guard.h"
#include "engine/impl.h"
#include "engine/picture_files.h"

namespace gable {

namespace {

std::string namesJson(const PictureData& picture) {
  std::string text;
  JsonWriter w(text, 2);
  const auto names = [&w](const char* name, const std::vector<std::string>& list) {
    w.key(name).beginArray();
    for (const std::string& each : list) w.value(each);
    w.endArray();
  };
  w.beginObject();
  writeCamera(w, picture);
  names("objects", picture.layers.objectNames);
  names("rules", picture.layers.ruleNames);
  names("materials", picture.layers.materialNames);
  w.endObject();
  return text + "\n";
}

}  // namespace

WriteResult writePicture(const PictureData& picture, const std::string& path) {
  return guardedResult<WriteResult>([&] {
    PictureFiles files(picture, "");
    files.writeColors(path);
    return files.result();
  });
}

WriteResult writePictureLayers(const PictureData& picture, const std::string& folder) {
  return guardedResult<WriteResult>([&] {
    const PictureLayers& l = picture.layers;
    const size_t pixels = static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height);
    if (pixels == 0 || l.depth.size() != pixels) {
      WriteResult none;
      none.diagnostics.push_back(diagnosticOf(Error{"picture-layers", "the picture has no layers",
                                                    "draw it with PictureSettings::layers set"}));
      return none;
    }
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    PictureFiles files(picture, folder.empty() || folder.ends_with('/') ? folder : folder + '/');
    files.writeFloats("depth.pfm", l.depth);
    files.writeCentimetres("depth.png", l.depth);
    files.writeNormals("normal.png");
    files.writeAlbedo("albedo.png");
    files.writeNumbers("object.png", l.objects);
    files.writeNumbers("instance.png", l.instances);
    files.writeNumbers("rule.png", l.rules);
    files.writeNumbers("material.png", l.materials);
    files.write("layers.json", namesJson(picture));
    return files.result();
  });
}

}  // namespace gable
