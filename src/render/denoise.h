// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Smooths a film's light along surfaces: what jitters from pixel to pixel is averaged with its
// neighbours of like normal, depth and brightness. Colours and edges are not touched: they are kept
// apart; of the sun's shadows only the grain of their soft rims goes.
#pragma once

#include "render/film.h"

namespace gable::rt {

/// None only adds the parts up. Sky: of light that comes from the sky straight, which is smoother
/// than that of paths, and the sun's is not touched.
enum class Smoothing : uint8_t { None, Paths, Sky };

/// The picture's linear light, exposure not applied.
std::vector<Vec3f> resolve(const Film& film, Smoothing smoothing, unsigned threads);

}  // namespace gable::rt
