// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Frame: a rigid placement, three orthonormal axes and an origin. A point p of the frame lies at
// origin + p.x * x + p.y * y + p.z * z of the frame around it. Frames compose from the outside in:
// world = outer * inner. `turned` is false while the axes are exactly the identity, so that chains
// of plain moves cost three additions.
#pragma once

#include "math/vec.h"

namespace gable {

struct Frame {
  Vec3 origin;
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  bool turned = false;

  Vec3 direction(const Vec3& d) const { return turned ? x * d.x + y * d.y + z * d.z : d; }
  Vec3 point(const Vec3& p) const { return origin + direction(p); }
  /// Into the frame: the inverse of direction and point.
  Vec3 toLocalDirection(const Vec3& d) const {
    return turned ? Vec3{dot(x, d), dot(y, d), dot(z, d)} : d;
  }
  Vec3 toLocal(const Vec3& p) const { return toLocalDirection(p - origin); }

  static Frame moved(const Vec3& by) {
    Frame f;
    f.origin = by;
    return f;
  }
  /// Axes as given (orthonormal, right-handed); sets `turned` from their values.
  static Frame of(const Vec3& origin, const Vec3& x, const Vec3& y, const Vec3& z);

  friend bool operator==(const Frame& a, const Frame& b) {
    return a.origin == b.origin && a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

inline Frame operator*(const Frame& outer, const Frame& inner) {
  if (!outer.turned) {
    Frame f = inner;
    f.origin += outer.origin;
    return f;
  }
  if (!inner.turned) {
    Frame f = outer;
    f.origin = outer.point(inner.origin);
    return f;
  }
  return Frame::of(outer.point(inner.origin), outer.direction(inner.x), outer.direction(inner.y),
                   outer.direction(inner.z));
}

Frame inverse(const Frame& f);

/// The rotation of CGA: about x, then y, then z of the surrounding frame, in degrees
/// each about a fixed axis (so the matrix on column vectors is Rz * Ry * Rx); quarter turns are
/// exact.
Frame rotationXyz(double xDegrees, double yDegrees, double zDegrees);

/// Angles (degrees) for which rotationXyz gives the axes of `f` back.
Vec3 anglesXyz(const Frame& f);

/// Axes from a wanted z and a hint for x; both need not be unit. Falls back to some x when the hint
/// is parallel to z.
Frame frameFromZ(const Vec3& origin, const Vec3& z, const Vec3& xHint);

}  // namespace gable
