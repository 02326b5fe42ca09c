// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures of few colours: a byte a pixel in place of four. Equal pictures have equal palettes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/image/image.h"

namespace gable {

constexpr size_t kMostPaletteColors = 256;

struct Palette {
  /// Red, green, blue, alpha: the clearest first, so that a file says no more of alpha than it
  /// must.
  std::vector<std::array<uint8_t, 4>> colors;
  /// By pixel, rows from the top.
  std::vector<uint8_t> numbers;
};

/// The colours of a picture, where it has kMostPaletteColors at most. `channels`: 3 takes every
/// pixel for opaque. Linear in the pixels, and ends soon where there are more.
std::optional<Palette> paletteOf(const Image& image, int channels = 4);

/// The picture in at most so many colours, one at least, each the mean of those near it: groups of
/// colours are cut at their mean, those first that differ most. Where it has no more, it stays.
void reduceColors(Image& image, size_t most);

}  // namespace gable
