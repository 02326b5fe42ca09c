// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gradient noise: smooth, without a direction of its own, a pure function of place and address.
#pragma once

#include <cstdint>

#include "math/vec.h"

namespace gable {

/// In [-1, 1], 0 at whole coordinates, changing over a distance of about 1; twice differentiable.
/// Coordinates beyond 1e9, and what is no number, give 0. The same bits with every compiler.
double gradientNoise(Vec2 p, uint64_t address);
double gradientNoise(const Vec3& p, uint64_t address);

/// Octaves of it, each twice as fine and half as strong as the one before; in [-1, 1]. From 1 to 16
/// octaves.
double fractalNoise(Vec2 p, int octaves, uint64_t address);
double fractalNoise(const Vec3& p, int octaves, uint64_t address);

}  // namespace gable
