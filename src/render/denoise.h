// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Smooths a film's light along surfaces: what jitters from pixel to pixel is averaged with its
// neighbours of like normal, depth and brightness. Colours and edges are not touched: they are kept
// apart; of the sun's shadows only the grain of their soft rims goes.
#pragma once

#include "render/film.h"

namespace gable::rt {

/// The picture's linear light, exposure not applied; `smooth` false only adds the parts up.
std::vector<Vec3f> resolve(const Film& film, bool smooth, unsigned threads);

}  // namespace gable::rt
