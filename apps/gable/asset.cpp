// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable asset prepare: a model made ready to fill the scopes of terminal shapes. gable asset
// material: the library of materials.

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "answer.h"
#include "commands.h"
#include "derive_settings.h"
#include "gable/materials.h"

namespace {

bool setTriple(const std::string& text, const char* option, gable::Triple& out) {
  if (parseNumbers(text, ',', kMetres, out.data(), 3)) return true;
  wrongOption(option, "three numbers, such as 8,9,8", text);
  return false;
}

void listMaterials() {
  std::string all;
  gable::JsonWriter json(all);
  json.beginArray();
  for (const gable::LibraryMaterialInfo& m : gable::libraryMaterials()) {
    char text[96];
    std::snprintf(text, sizeof text, "%-18s %4.3g x %-4.3g m  ", m.name.c_str(), m.width, m.height);
    put(text + m.color + "  " + m.doc + "\n");
    json.beginObject().key("name").value(m.name).key("width").value(m.width);
    json.key("height").value(m.height).key("color").value(m.color);
    json.key("doc").value(m.doc).endObject();
  }
  json.endArray();
  answer().member("materials", all);
}

}  // namespace

int runAssetPrepare(const AssetArguments& a) {
  gable::PrepareSettings s;
  s.zUp = a.zUp;
  s.name = a.name;
  if (!a.pivot.empty() && !setTriple(a.pivot, "--pivot", s.pivot.emplace())) return kExitUsage;
  if (!a.volume.empty() && !setTriple(a.volume, "--size", s.volume.emplace())) return kExitUsage;
  if (!a.rotate.empty() && !setTriple(a.rotate, "--rotate", s.rotate)) return kExitUsage;
  if (const int status = checkExtension(a.output, {"glb", "gltf", "obj"})) return status;
  const gable::Model model = gable::Model::load(a.model, fileLimits(a.limits));
  print(model.diagnostics());
  if (!model.found()) return statusOf(model.diagnostics(), kExitFile);
  const gable::Model ready = model.prepared(s);
  if (gable::hasErrors(ready.diagnostics())) {
    print(ready.diagnostics());
    return statusOf(ready.diagnostics(), kExitWrong);
  }
  gable::WriteSettings settings;
  settings.limits = fileLimits(a.limits);
  const gable::WriteResult written = ready.write(a.output, settings);
  print(written.diagnostics);
  if (!written.ok) return statusOf(written.diagnostics, kExitFile);
  const auto [low, high] = ready.bounds().value_or(gable::BoundingBox{});
  char text[200];
  std::snprintf(text, sizeof text,
                ": the model covers %.3g..%.3g, %.3g..%.3g, %.3g..%.3g of the volume\n", low[0],
                high[0], low[1], high[1], low[2], high[2]);
  answer().wrote(a.output);
  tell(a.output + text);
  return kExitDone;
}

int runAssetMaterial(const MaterialArguments& a) {
  if (a.name.empty()) {
    listMaterials();
    return kExitDone;
  }
  const std::vector<gable::LibraryMaterialInfo> all = gable::libraryMaterials();
  const bool known =
      std::any_of(all.begin(), all.end(), [&](const auto& m) { return m.name == a.name; });
  const std::string folder = a.folder.empty() ? a.name : a.folder;
  // A name that is none leaves no folder.
  if (known) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
      return fail(kExitFile, "the folder '" + folder + "' could not be made: " + error.message(),
                  "name another with -o");
    }
  }
  const gable::WriteResult written = gable::writeLibraryMaterial(a.name, folder);
  print(written.diagnostics);
  if (!known) return kExitUsage;
  if (!written.ok) return statusOf(written.diagnostics, kExitFile);
  char text[64];
  std::snprintf(text, sizeof text, ": 3 pictures, %.0f kB\n",
                static_cast<double>(written.bytes) / 1000);
  answer().wrote(folder);
  answer().member("bytes", std::to_string(written.bytes));
  tell(folder + text);
  return kExitDone;
}
