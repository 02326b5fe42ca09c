// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Textures by name, as the versions in the browser have them: "concrete", "redbrick", or words in
// one, "roughblueshinysemitransparentmetal". What is meant is put together from words for colour,
// sheen and transparency, and one for the stuff, which Gable has a built-in picture of.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gable::progen3d {

struct NamedTexture {
  /// "builtin:textures/02_brick.png"; empty: no picture.
  std::string path;
  /// "#rrggbb"; empty: the picture's own.
  std::string color;
  double opacity = 1;
  /// Below 0: as it is.
  double roughness = -1;
  double metallic = 0;
};

/// None where some part of the name is no word for any of these.
std::optional<NamedTexture> namedTexture(std::string_view name);

}  // namespace gable::progen3d
