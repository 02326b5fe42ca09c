// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_images.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "base/bytes.h"
#include "base/files.h"

namespace gable {
namespace {

constexpr std::string_view kImages = "images/";
constexpr size_t kDigits = 16;
constexpr std::string_view kHex = "0123456789abcdef";

std::string hexOf(uint64_t v) {
  std::string out(kDigits, '0');
  for (size_t i = kDigits; i-- > 0; v >>= 4) out[i] = kHex[v & 15];
  return out;
}

}  // namespace

Result<std::vector<std::string>> TileImages::write(const std::vector<ModelTexture>& images) {
  std::vector<std::string> names;
  const std::lock_guard lock(writing_);
  for (const ModelTexture& image : images) {
    const uint64_t sum = checksum(image.bytes);
    const char* const ending = image.mime == "image/png" ? ".png" : ".jpg";
    names.push_back("tiles/" + std::string(kImages) + hexOf(sum) + ending);
    const auto [at, fresh] = files_.try_emplace(names.back());
    if (!fresh) continue;
    // Where that fails, the file cannot be written, which is told.
    std::error_code ignored;
    std::filesystem::create_directories(folder_ + folderOf(names.back()), ignored);
    const Result<uint64_t> bytes = writeFile(folder_ + names.back(), image.bytes);
    if (!bytes.ok()) return bytes.error();
    at->second = {names.back(), bytes.value(), sum};
  }
  return names;
}

std::vector<TileFile> TileImages::files() const {
  std::vector<TileFile> out;
  for (const auto& [name, file] : files_) out.push_back(file);
  return out;
}

bool isTileImage(std::string_view path) {
  if (!path.starts_with(kImages)) return false;
  path.remove_prefix(kImages.size());
  const std::string_view digits = path.substr(0, kDigits), ending = path.substr(digits.size());
  return digits.size() == kDigits && digits.find_first_not_of(kHex) == std::string_view::npos &&
         (ending == ".png" || ending == ".jpg");
}

void addImages(std::vector<TileFile>& to, const std::vector<TileFile>& more) {
  std::vector<TileFile> both;
  const auto before = [](const TileFile& a, const TileFile& b) { return a.name < b.name; };
  std::set_union(to.begin(), to.end(), more.begin(), more.end(), std::back_inserter(both), before);
  to.swap(both);
}

std::string addressFrom(std::string_view file, std::string_view target) {
  size_t common = 0;
  for (size_t i = 0; i < std::min(file.size(), target.size()) && file[i] == target[i]; ++i) {
    if (file[i] == '/') common = i + 1;
  }
  std::string out;
  for (const char c : file.substr(common)) {
    if (c == '/') out += "../";
  }
  return out.append(target.substr(common));
}

}  // namespace gable
