// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/tile_folder.h"

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "base/json.h"
#include "tiles/tile_images.h"

namespace gable {

namespace {

constexpr const char* kGenerator = "Gable";
// Says that the folders `tiles` and `plan` are ours as long as there is no tileset.
constexpr const char* kUnfinished = "tiles/unfinished";

// 0123.glb, 01230/1.json, images/0123456789abcdef.png
bool isTileName(std::string_view name) {
  if (isTileImage(name)) return true;
  const size_t dot = std::min(name.find('.'), name.size());
  const std::string_view end = name.substr(dot);
  return (end == ".glb" || end == ".json") && isSquarePath(name.substr(0, dot));
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
  const Result<uint64_t> marked = writeFile(path_ + kUnfinished, "This folder is being written.\n");
  if (!marked.ok()) return marked.error();
  return std::nullopt;
}

Result<uint64_t> TileFolder::close(const TilePart& all, const std::vector<double>& transform) {
  const Result<uint64_t> bytes =
      writeFile(path_ + "tileset.json", tilesetJson(*all.root, transform));
  if (!bytes.ok()) return bytes;
  for (const TileFile& f : all.files) before_.erase(f.name);
  for (const TileFile& f : all.images) before_.erase(f.name);
  std::error_code ignored;
  for (const std::string& old : before_) {
    std::filesystem::remove(path_ + old, ignored);
    // Goes where it is empty.
    std::filesystem::remove(path_ + folderOf(old), ignored);
  }
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
    return Error{"tiles-folder", "the folder '" + path_ + "plan' has files that Gable has not made",
                 "name another folder"};
  }
  const std::string tiles = path_ + "tiles/";
  std::error_code error;
  for (auto at = std::filesystem::recursive_directory_iterator(tiles, error);
       !error && at != std::filesystem::recursive_directory_iterator(); at.increment(error)) {
    const std::string name = at->path().string().substr(tiles.size());
    if (isTileName(name)) before_.insert("tiles/" + name);
  }
  return std::nullopt;
}

}  // namespace gable
