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
  /// The direction of a normal, not unit: the cofactors, with the sign that keeps it on its side.
  Vec3 normal(const Vec3& n) const {
    const Vec3 c = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
    return determinant() < 0 ? -c : c;
  }
  bool finite() const { return isFinite(x) && isFinite(y) && isFinite(z) && isFinite(origin); }
  bool operator==(const Affine&) const = default;
};

/// What `inner` does first and `outer` then.
inline Affine operator*(const Affine& outer, const Affine& inner) {
  return {outer.direction(inner.x), outer.direction(inner.y), outer.direction(inner.z),
          outer.point(inner.origin)};
}

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
