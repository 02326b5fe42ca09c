// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The step that point location by crossing counts takes at each edge.
#pragma once

#include <algorithm>

#include "math/predicates.h"

namespace gable {

enum class Crossing { None, Crosses, Touches };

/// Whether the ray from `p` to +x crosses the edge from `a` to `b`, or `p` lies on it (Touches). An
/// edge counts when it spans p.y half-open, so that a vertex on the ray is counted once; signs are
/// exact.
inline Crossing crossingOf(Vec2 a, Vec2 b, Vec2 p) {
  if (a == p || b == p) return Crossing::Touches;
  if (a.y == p.y && b.y == p.y) {
    const bool on = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x);
    return on ? Crossing::Touches : Crossing::None;
  }
  if ((a.y > p.y) == (b.y > p.y)) return Crossing::None;
  const int turn = orientation(a, b, p);
  if (turn == 0) return Crossing::Touches;
  return (turn > 0) == (b.y > a.y) ? Crossing::Crosses : Crossing::None;
}

}  // namespace gable
