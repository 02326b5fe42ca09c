// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parts of a box or a rectangle along an axis of its scope. A split gives out a plan and the pieces
// of the divided length; each part is made when its turn comes, once, where it will be worked on.
#pragma once

#include <cstdint>
#include <span>

#include "base/small_buffer.h"
#include "program/arguments.h"
#include "shape/shape.h"

namespace gable {

/// An axis of the scope.
enum class Axis : uint8_t { X, Y, Z };
template <>
struct WordsOf<Axis> {
  static constexpr const char* text = "x y z";
};

/// Where a part of a divided length begins, how long it is, and the block slot that it goes to.
struct SplitPiece {
  double start = 0;
  double size = 0;
  uint32_t slot = 0;
};

/// What the parts of one split have in common.
struct PartPlan {
  Axis axis = Axis::X;
  /// The axis is square to a rectangle: its part keeps no extent there.
  bool flat = false;
  /// How many pieces the length has; split.total of every part.
  uint32_t total = 0;
  /// The number of the first piece given out: all but one of those square to a rectangle are left
  /// out.
  uint32_t first = 0;
  /// The address that those of the parts are derived from.
  uint64_t path = 0;
};

/// Makes the part number `index`. The piece is measured from the scope's origin in the direction of
/// its extent (so against the axis where the size is negative). Tags of the sides, or edges, that
/// the cuts made are dropped.
void makePart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece, uint32_t index,
              Shape& part);

/// A trim plane along the axes of a scope: dot(along, p) <= distance for p measured from its
/// origin.
struct LightPlane {
  Vec3 along;
  /// The sides of a box that look beyond the plane: it reaches dot(ahead, size) further than its
  /// origin.
  Vec3 ahead;
  /// |along.x| + |along.y| + |along.z|: what a box reaches further when it grows by 1 on all sides.
  double spread = 0;
  double distance = 0;
  /// Switched on (trim.vertical, trim.horizontal).
  bool on = false;
};

/// The trim planes that light parts are subject to: those of a shape with the same axes.
struct LightTrim {
  std::span<const LightPlane> planes;
  /// The shape's scope, which the planes are measured in; null when the parts' local frame is not
  /// the shape's but begins at `origin` in that scope, with its axes.
  const Frame* scope = nullptr;
  Vec3 origin;

  /// A place of the parts' local frame in the shape's scope.
  Vec3 there(const Vec3& p) const { return scope ? scope->toLocal(p) : origin + p; }
};

/// The trim planes of a shape, for its light parts.
using LightPlanes = SmallBuffer<LightPlane, 4>;
void findLightPlanes(const Shape& s, LightPlanes& out);

/// A part that becomes a leaf in a few plain steps: it moves along its parent's axes, changes its
/// size and becomes a primitive, and is never made as a shape. Its parent is a box or a rectangle
/// of a size that is nowhere negative.
struct LightPart {
  /// The parent's scope: its axes are the part's.
  const Frame* parent;
  /// Of the scope, in the local frame.
  Vec3 origin;
  Vec3 size;
  GeometryKind kind;
  bool uv = false;
  /// Null where nothing trims.
  const LightTrim* trim = nullptr;
};

/// True when a part as a shape would certainly forget all its trim planes.
bool isFarFromTrim(const LightPart& part);

inline const Vec3& directionOf(const Frame& f, Axis axis) {
  return axis == Axis::X ? f.x : axis == Axis::Y ? f.y : f.z;
}

/// Forgets the trim planes that the shape is too far from to meet: those which the scope, grown by
/// a quarter of its largest size on all sides, lies behind. Equal parts of a facade then are equal
/// shapes, whatever their distance from its corners.
void forgetFarTrimPlanes(Shape& s);

}  // namespace gable
