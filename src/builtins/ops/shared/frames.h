// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The coordinate systems that operations name (scope, pivot, object, world), each as a frame in the
// shape's local frame, and moves of a scope that leave the geometry where it is.
#pragma once

#include <cstdint>

#include "program/arguments.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

/// A coordinate system as operations name it, and whether they mean it absolutely or from where the
/// shape is.
enum class CoordSystem : uint8_t { Scope, Pivot, Object, World };
enum class Placing : uint8_t { Abs, Rel };
template <>
struct WordsOf<CoordSystem> {
  static constexpr const char* text = "scope pivot object world";
};
template <>
struct WordsOf<Placing> {
  static constexpr const char* text = "abs rel";
};

/// The axes and origin of a system.
Frame frameOf(CoordSystem system, const Shape& s, const Services& services);

/// The world and the object (the initial shape's origin) seen from the local frame.
Frame worldFrame(const Services& services);
Frame objectFrame(const Services& services);

/// The axes of `outer` turned by those of `inner`, without origins.
Frame composedAxes(const Frame& outer, const Frame& inner);

/// Turns the axes of `f` about its origin by `turn`, both given in the same outer frame.
void turnAxes(Frame& f, const Frame& turn);

/// True when the axes agree up to rounding.
bool sameAxes(const Frame& a, const Frame& b);

/// Gives a scope new axes (origin ignored) around the geometry, which stays where it is. A box or
/// rectangle whose axes stay remains a primitive.
void realignScope(Shape& s, const Frame& axes);

/// Sets the size of the scope; the geometry is scaled with it. When the change mirrors the
/// geometry, its faces turn round: a negative size shows the insides, as rules expect. Allocates
/// nothing while sizes stay positive.
void resizeScope(Shape& s, const Vec3& size);

/// True when a size has an odd number of negative components.
bool isMirrored(const Vec3& size);

/// All faces turned round.
Mesh reversed(const Mesh& m);

}  // namespace gable
