// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pictures of leaves (material/builtin_textures.h), drawn when they are asked for: twigs with
// leaves on nothing. A picture has four twigs, two beside and two above one another; each grows up
// from the middle of its lower edge. Leaves are nearly white, so that the colour of the surface is
// what they show. The same pixels on every machine. Some tens of milliseconds each.
#pragma once

#include <cstddef>

#include "io/image/image.h"

namespace gable {

constexpr uint32_t kLeafPictureSize = 512;

/// By number, below kBuiltinLeaves.size().
Image drawLeaves(size_t number);

}  // namespace gable
