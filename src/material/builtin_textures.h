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

}  // namespace gable
