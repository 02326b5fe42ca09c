// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Whether the place and the size of a shape are finite numbers. What is not would spread to all
// that comes of the shape, and no file can hold it; so the machine refuses what makes such a shape.
// All here is cheap enough for every operation.
#pragma once

#include <cmath>

#include "math/frame.h"
#include "math/vec.h"
#include "runtime/door.h"
#include "shape/shape.h"

namespace gable {

inline bool isFinite(const Frame& f) {
  return isFinite(f.origin) && (!f.turned || (isFinite(f.x) && isFinite(f.y) && isFinite(f.z)));
}

inline bool hasFiniteScope(const Shape& s) { return isFinite(s.scope) && isFinite(s.size); }

/// Neither place nor size is so large that arguments within kMostNumber could make them overflow.
inline bool isModerate(const Shape& s) {
  const auto moderate = [](const Vec3& v) {
    return std::fabs(v.x) <= kMostNumber && std::fabs(v.y) <= kMostNumber &&
           std::fabs(v.z) <= kMostNumber;
  };
  return moderate(s.scope.origin) && moderate(s.size);
}

}  // namespace gable
