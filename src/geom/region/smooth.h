// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Smoothing of outlines and of lines. Plan coordinates, metres.
//
// Promises: a smoothed outline lies within the polygon; a smoothed line keeps its ends. O(n log n).
#pragma once

#include <cstdint>
#include <vector>

#include "geom/region/region.h"

namespace gable {

struct Smoothing {
  /// Average: edges are divided, and each vertex goes towards its neighbours. Chaikin: corners are
  /// cut at the quarters of edges. Bezier: arcs from the middle of each edge to the next, with the
  /// corner as their control point. Round: corners are rounded with a radius.
  enum class Kind : uint8_t { None, Average, Chaikin, Bezier, Round } kind = Kind::None;
  /// Average and Chaikin: how often.
  uint32_t times = 2;
  /// Average: what a vertex keeps of itself.
  double weight = 1.0 / 3;
  /// Round: the radius.
  double radius = 0;
};

/// The smoothed outline within `p`; several where it falls apart, empty where nothing is left.
Region smoothed(const Polygon& p, const Smoothing& s);

/// The line smoothed in the same way; Round counts as Bezier.
std::vector<Vec2> smoothed(const std::vector<Vec2>& line, const Smoothing& s);

/// Edges no longer than `most`, of a ring or of a line.
Ring subdivided(const Ring& points, double most, bool closed);

}  // namespace gable
