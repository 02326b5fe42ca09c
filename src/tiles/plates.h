// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Plates: what narrow parts in one plane look like together from far away.
//
// A rule divides a facade into strips and tiles, none of which lies on a larger one: together they
// are the wall. Parts whose planes are equal within the tolerance are drawn into a grid of cells
// about as wide as the tolerance. Where they and the large parts in the plane cover a cell at least
// half, it belongs to a plate; full cells become as few rectangles as a greedy search finds. This
// is the idea of billboard clouds (Decoret, Durand, Sillion, Dorsey: Billboard clouds for extreme
// model simplification, 2003) for planes that are known.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tiles/coarse.h"

namespace gable {

struct Plate {
  /// A rectangle: a box without thickness across its z, which points where its parts look. It
  /// has no triangles yet. Its look is the mean of the narrow parts that it stands for.
  CoarsePart part;
  /// How far the farthest of what it stands for is from its plane, in metres.
  double offset = 0;
};

struct Plates {
  std::vector<Plate> plates;
  /// By narrow part: whether a plate stands for it.
  std::vector<bool> taken;
  /// By large part: how it moves to lie before a plate that would hide it, by the tolerance at
  /// most.
  std::vector<Vec3> moves;
};

/// The plates of a feature: `narrow` and `large` are indices into the model's parts. A plate is at
/// least as wide as the tolerance in both directions. O(n log n) in the parts and in the cells that
/// they cover; a part that is longer than a thousand cells makes no plate.
Plates platesOf(const CoarseModel& model, std::span<const size_t> narrow,
                std::span<const size_t> large, double tolerance);

}  // namespace gable
