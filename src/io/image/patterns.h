// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The built-in textures (material/builtin_textures.h), drawn when they are asked for: plain
// building materials that repeat without a seam in both directions. The same pixels on every
// machine. O(pixels), some tens of milliseconds each.
#pragma once

#include <cstddef>

#include "io/image/image.h"

namespace gable {

constexpr uint32_t kPatternSize = 512;

/// By number, below kBuiltinTextures.size().
Image drawPattern(size_t number);

}  // namespace gable
