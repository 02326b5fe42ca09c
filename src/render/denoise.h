// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Smooths a film's indirect light along surfaces. Colours, edges and the sun's shadows are not
// touched: they are kept apart.
#pragma once

#include "render/film.h"

namespace gable::rt {

/// None only adds the parts up. Sky: of light that comes from the sky straight, which is smoother
/// than that of paths.
enum class Smoothing : uint8_t { None, Paths, Sky };

/// The picture's linear light, exposure not applied. The meter of the thread can stop smoothing.
std::vector<Vec3f> resolve(const Film& film, Smoothing smoothing, unsigned threads);

}  // namespace gable::rt
