// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/write_model.h"

#include "base/files.h"
#include "base/text.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// Formats without instances, by far more than a file system takes.
constexpr uint64_t kMostLeaves = 2'000'000'000;

struct Format {
  const char* extension;
  bool expands;
  Result<WriteReport> (*write)(const Scene&, const std::string&, const WriteOptions&);
};
constexpr Format kFormats[] = {{"glb", false, writeGltf},
                               {"gltf", false, writeGltf},
                               {"obj", true, writeObj},
                               {"usda", false, writeUsd},
                               {"usdz", false, writeUsd},
                               {"ply", true, writePly},
                               {"stl", true, writeStl},
                               {"city.json", true, writeCityJson},
                               {"city.jsonl", true, writeCityJson},
                               {"ifc", true, writeIfc}};

}  // namespace

const std::vector<std::string>& modelExtensions() {
  static const std::vector<std::string> kAll = [] {
    std::vector<std::string> all;
    for (const Format& f : kFormats) all.emplace_back(f.extension);
    return all;
  }();
  return kAll;
}

std::string modelFormatOf(const std::string& path) {
  const std::string name = lowerCase(fileNameOf(path));
  for (const Format& f : kFormats) {
    const std::string_view end = f.extension;
    const size_t size = end.size() + 1;
    if (name.size() >= size && name.ends_with(end) && name[name.size() - size] == '.') {
      return f.extension;
    }
  }
  return {};
}

Result<WriteReport> writeModel(const Scene& scene, const std::string& path,
                               const WriteOptions& options) {
  const std::string extension = modelFormatOf(path);
  for (const Format& f : kFormats) {
    if (extension != f.extension) continue;
    if (f.expands && leafCount(scene) > kMostLeaves) {
      return Error{"model-too-large", "'" + path + "' would show more leaves than can be written",
                   "write .glb, or generate fewer shapes at a time"};
    }
    return f.write(scene, path, options);
  }
  std::string known;
  for (const std::string& e : modelExtensions()) known += (known.empty() ? "." : ", .") + e;
  return Error{"format-unknown", "'" + path + "' names no model format that can be written",
               "use one of " + known};
}

}  // namespace gable
