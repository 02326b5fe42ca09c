// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Affine: any linear map and a move; the images of the axes are its columns. Where axes must stay
// orthonormal there is Frame.
#pragma once

#include "math/vec.h"

namespace gable {

struct Affine {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;

  Vec3 direction(const Vec3& d) const { return x * d.x + y * d.y + z * d.z; }
  Vec3 point(const Vec3& p) const { return origin + direction(p); }
  /// Negative when it mirrors.
  double determinant() const { return dot(cross(x, y), z); }
  bool operator==(const Affine&) const = default;
};

/// Each of these is done first, in the coordinates that go into `a`.
inline Affine afterMove(const Affine& a, const Vec3& by) { return {a.x, a.y, a.z, a.point(by)}; }
inline Affine afterScale(const Affine& a, const Vec3& by) {
  return {a.x * by.x, a.y * by.y, a.z * by.z, a.origin};
}
/// `x`, `y`, `z`: what the axes become.
inline Affine afterTurn(const Affine& a, const Vec3& x, const Vec3& y, const Vec3& z) {
  return {a.direction(x), a.direction(y), a.direction(z), a.origin};
}

}  // namespace gable
