// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The coordinate systems that operations name (scope, pivot, object, world), each as a frame in the
// shape's local frame, and moves of a scope that leave the geometry where it is.
#pragma once

#include <string_view>

#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

/// The axes and origin of a system named by a word; `known` is false for any other word.
Frame systemNamed(std::string_view word, const Shape& s, const Services& services, bool& known);

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
