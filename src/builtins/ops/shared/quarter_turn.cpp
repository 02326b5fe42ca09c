// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/quarter_turn.h"

#include <cmath>

namespace gable {

namespace {

constexpr QuarterTurn kNoTurn;

bool same(const QuarterTurn& a, const QuarterTurn& b) {
  for (size_t i = 0; i < 3; ++i) {
    if (a.from[i] != b.from[i] || a.back[i] != b.back[i]) return false;
  }
  return true;
}

// True for what a turned scope holds without polygons.
bool staysPrimitive(const Shape& s, const QuarterTurn& turn) {
  if (s.geometry.uv || s.size.x < 0 || s.size.y < 0 || s.size.z < 0) return false;
  if (s.geometry.kind == GeometryKind::Box) return true;
  return s.geometry.kind == GeometryKind::QuadXy && turn.from[2] == 2 && !turn.back[2];
}

}  // namespace

QuarterTurn quarterTurn(size_t axis, int quarters) {
  QuarterTurn t;
  const size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
  switch (((quarters % 4) + 4) % 4) {
    case 1:
      t.from[b] = c;
      t.from[c] = b;
      t.back[c] = true;
      break;
    case 2: t.back[b] = t.back[c] = true; break;
    case 3:
      t.from[b] = c;
      t.back[b] = true;
      t.from[c] = b;
      break;
    default: break;
  }
  return t;
}

QuarterTurn followed(const QuarterTurn& a, const QuarterTurn& b) {
  QuarterTurn t;
  for (size_t i = 0; i < 3; ++i) {
    t.from[i] = a.from[b.from[i]];
    t.back[i] = a.back[b.from[i]] != b.back[i];
  }
  return t;
}

bool quarterTurnOf(const Vec3& degrees, QuarterTurn& out) {
  int quarters[3];
  for (size_t i = 0; i < 3; ++i) {
    const double n = std::fmod(degrees[i], 360.0) / 90;
    if (n != std::nearbyint(n)) return false;
    quarters[i] = static_cast<int>(n);
  }
  // About x, y, z of the scope as it was, in this order, is about z, y, x of what is turned along.
  out = followed(followed(quarterTurn(2, quarters[2]), quarterTurn(1, quarters[1])),
                 quarterTurn(0, quarters[0]));
  return true;
}

void turnScope(Shape& s, const QuarterTurn& turn) {
  if (same(turn, kNoTurn)) return;
  const Vec3 axes[3] = {s.scope.x, s.scope.y, s.scope.z};
  Vec3 turned[3];
  for (size_t i = 0; i < 3; ++i)
    turned[i] = turn.back[i] ? -axes[turn.from[i]] : axes[turn.from[i]];
  const Frame scope = Frame::of(s.scope.origin, turned[0], turned[1], turned[2]);
  if (!staysPrimitive(s, turn)) {
    alignScope(s, scope);
    return;
  }
  Shape out = s;
  out.scope = scope;
  for (size_t i = 0; i < 3; ++i) {
    const size_t from = turn.from[i];
    out.size[i] = s.size[from];
    if (turn.back[i]) out.scope.origin += axes[from] * s.size[from];
    for (size_t end = 0; end < 2; ++end) {
      out.geometry.tags[2 * i + end] = s.geometry.tags[2 * from + (turn.back[i] ? 1 - end : end)];
    }
  }
  s = std::move(out);
}

}  // namespace gable
