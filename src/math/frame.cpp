// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "math/frame.h"

#include <algorithm>
#include <cmath>

#include "math/trig.h"

namespace gable {

Frame Frame::of(const Vec3& origin, const Vec3& x, const Vec3& y, const Vec3& z) {
  Frame f;
  f.origin = origin;
  f.x = x;
  f.y = y;
  f.z = z;
  f.turned = !(x == Vec3{1, 0, 0} && y == Vec3{0, 1, 0} && z == Vec3{0, 0, 1});
  return f;
}

Frame inverse(const Frame& f) {
  if (!f.turned) return Frame::moved(-f.origin);
  return Frame::of(f.toLocalDirection(-f.origin), {f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y},
                   {f.x.z, f.y.z, f.z.z});
}

Frame rotationXyz(double xDegrees, double yDegrees, double zDegrees) {
  const double sa = sinDeg(xDegrees), ca = cosDeg(xDegrees);
  const double sb = sinDeg(yDegrees), cb = cosDeg(yDegrees);
  const double sg = sinDeg(zDegrees), cg = cosDeg(zDegrees);
  return Frame::of({}, {cb * cg, cb * sg, -sb},
                   {sa * sb * cg - ca * sg, ca * cg + sa * sb * sg, sa * cb},
                   {sa * sg + ca * sb * cg, ca * sb * sg - sa * cg, ca * cb});
}

Vec3 anglesXyz(const Frame& f) {
  const double sb = std::clamp(-f.x.z, -1.0, 1.0);
  // At the poles x and z turn about the same axis; all of the turn is given to z.
  if (std::fabs(sb) > 1 - 1e-12) {
    return {0, sb > 0 ? 90.0 : -90.0, atan2Deg(-f.y.x, f.y.y)};
  }
  return {atan2Deg(f.y.z, f.z.z), asinDeg(sb), atan2Deg(f.x.y, f.x.x)};
}

Frame frameFromZ(const Vec3& origin, const Vec3& z, const Vec3& xHint) {
  const Vec3 axis = normalized(z);
  Vec3 x = xHint - axis * dot(xHint, axis);
  if (length(x) <= 1e-12 * std::max(1.0, length(xHint))) {
    // The hint says nothing: take the coordinate axis that is farthest from z.
    const Vec3 other = std::fabs(axis.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    x = other - axis * dot(other, axis);
  }
  x = normalized(x);
  return Frame::of(origin, x, cross(axis, x), axis);
}

}  // namespace gable
