// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The textures that exist without a file, by number and name. io/image/patterns.h draws them.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace gable {

/// In the order of their numbers.
constexpr std::array<const char*, 24> kBuiltinTextures{
    "concrete",   "plaster",    "brick",   "oak",         "sandstone",   "ashlar",
    "roof_tiles", "slate",      "marble",  "granite",     "planks",      "steel",
    "walnut",     "corrugated", "copper",  "driftwood",   "floor_tiles", "stucco",
    "grass",      "gravel",     "asphalt", "cobblestone", "glass",       "linen"};

constexpr std::string_view kBuiltinTexturePrefix = "builtin:textures/";

/// "builtin:textures/02_brick.png": in the order of the numbers when sorted as text.
inline std::string builtinTexturePath(size_t number) {
  const std::string digits = std::to_string(number);
  return std::string(kBuiltinTexturePrefix) + (number < 10 ? "0" : "") + digits + "_" +
         kBuiltinTextures[number] + ".png";
}

/// Pictures of leaves, sorted; io/image/leaf_pictures.h draws them.
constexpr std::array<const char*, 17> kBuiltinLeaves{
    "birch", "blossom", "candle", "cherry", "chestnut", "cypress", "grass",  "ivy",   "lime",
    "oak",   "olive",   "palm",   "pine",   "plane",    "poplar",  "spruce", "willow"};

constexpr std::string_view kBuiltinLeavesPrefix = "builtin:leaves/";

/// The number of a path such as "builtin:leaves/lime.png"; kBuiltinLeaves.size() for any other.
inline size_t builtinLeaves(std::string_view path) {
  constexpr std::string_view kEnding = ".png";
  if (!path.starts_with(kBuiltinLeavesPrefix) || !path.ends_with(kEnding)) {
    return kBuiltinLeaves.size();
  }
  path.remove_prefix(kBuiltinLeavesPrefix.size());
  path.remove_suffix(kEnding.size());
  size_t i = 0;
  while (i < kBuiltinLeaves.size() && path != kBuiltinLeaves[i]) ++i;
  return i;
}

/// The pictures that CGA itself has, by name; nothing draws them, and surfaces keep their colour.
constexpr std::array<std::string_view, 2> kCgaTextures{"builtin:default", "builtin:uvtest.png"};

/// Whether a path that begins with "builtin:" names a texture.
inline bool isBuiltinTexture(std::string_view path) {
  for (const std::string_view name : kCgaTextures) {
    if (path == name) return true;
  }
  for (size_t i = 0; i < kBuiltinTextures.size(); ++i) {
    if (path == builtinTexturePath(i)) return true;
  }
  return builtinLeaves(path) < kBuiltinLeaves.size();
}

}  // namespace gable
