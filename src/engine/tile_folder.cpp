// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/tile_folder.h"

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "base/json.h"

namespace gable {

namespace {

constexpr const char* kGenerator = "Gable";
// Says that the folders `tiles` and `plan` are ours as long as there is no tileset.
constexpr const char* kUnfinished = "tiles/unfinished";

// tiles/0123.glb, tiles/01.json
bool isTileName(std::string_view uri) {
  constexpr std::string_view kBegin = "tiles/";
  if (!uri.starts_with(kBegin)) return false;
  uri.remove_prefix(kBegin.size());
  const size_t dot = std::min(uri.find('.'), uri.size());
  const std::string_view end = uri.substr(dot);
  return dot > 0 && (end == ".glb" || end == ".json") &&
         std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(dot),
                     [](char c) { return c >= '0' && c <= '3'; });
}

bool holdsFiles(const std::string& folder) {
  std::error_code error;
  return std::filesystem::exists(folder, error) && !std::filesystem::is_empty(folder, error);
}

}  // namespace

TileFolder::TileFolder(std::string path) : path_(std::move(path)) {
  if (!path_.ends_with('/')) path_ += '/';
}

std::optional<Error> TileFolder::open() {
  if (auto e = readBefore()) return e;
  std::error_code error;
  std::filesystem::create_directories(path_ + "tiles", error);
  if (error) {
    return Error{"tiles-folder", "the folder '" + path_ + "' cannot be made: " + error.message(),
                 "name another one, or see to its permissions"};
  }
  const Result<uint64_t> marked =
      writeFile(path_ + kUnfinished, "This folder is being written.\n");
  if (!marked.ok()) return marked.error();
  return std::nullopt;
}

Result<uint64_t> TileFolder::close(const TilePart& all, const std::vector<double>& transform) {
  const Result<uint64_t> bytes =
      writeFile(path_ + "tileset.json", tilesetJson(*all.root, transform));
  if (!bytes.ok()) return bytes;
  for (const TileFile& f : all.files) before_.erase(f.name);
  std::error_code ignored;
  for (const std::string& old : before_) std::filesystem::remove(path_ + old, ignored);
  std::filesystem::remove_all(plan(), ignored);
  std::filesystem::remove(path_ + kUnfinished, ignored);
  return bytes;
}

std::optional<Error> TileFolder::readBefore() {
  const std::string tileset = path_ + "tileset.json";
  const bool begun = fileExists(path_ + kUnfinished);
  if (fileExists(tileset)) {
    const Result<std::string> text = readFile(tileset);
    if (!text.ok()) return text.error();
    const Result<JsonValue> json = parseJson(text.value());
    if (!json.ok() || json.value()["asset"]["generator"].text() != kGenerator) {
      return Error{"tiles-folder", "'" + tileset + "' is a tileset that Gable has not made",
                   "name another folder, or remove the file"};
    }
  } else if (!begun && holdsFiles(path_ + "tiles")) {
    return Error{"tiles-folder",
                 "the folder '" + path_ + "tiles' has files that Gable has not made",
                 "name another folder"};
  }
  if (!begun && holdsFiles(plan())) {
    return Error{"tiles-folder",
                 "the folder '" + path_ + "plan' has files that Gable has not made",
                 "name another folder"};
  }
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(path_ + "tiles", error)) {
    const std::string name = "tiles/" + entry.path().filename().string();
    if (isTileName(name)) before_.insert(name);
  }
  return std::nullopt;
}

}  // namespace gable
