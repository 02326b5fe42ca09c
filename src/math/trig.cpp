// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "math/trig.h"

#include <cmath>

namespace gable {

namespace {

// Sine and cosine of 0..45 degrees; 30 and 45 are exact or alike, so that sin 30 and tan 45 are.
double sinOctant(double d) {
  if (d == 45) return 0x1.6a09e667f3bcdp-1;
  return d == 30 ? 0.5 : sinSmall(toRadians(d));
}
double cosOctant(double d) { return d == 45 ? 0x1.6a09e667f3bcdp-1 : cosSmall(toRadians(d)); }

// Sine of any angle in [0, 90].
double sinQuadrant(double d) {
  if (d == 90) return 1;
  return d <= 45 ? sinOctant(d) : (d == 60 ? cosOctant(30) : cosOctant(90 - d));
}
double cosQuadrant(double d) {
  if (d == 90) return 0;
  return d <= 45 ? cosOctant(d) : sinOctant(90 - d);
}

}  // namespace

double sinDeg(double degrees) {
  double d = std::fmod(degrees, 360.0);
  if (d < 0) return -sinDeg(-d);
  if (d >= 180) return -sinDeg(d - 180);
  return d > 90 ? sinQuadrant(180 - d) : sinQuadrant(d);
}

double cosDeg(double degrees) {
  double d = std::fmod(std::fabs(degrees), 360.0);
  if (d > 180) d = 360 - d;
  return d > 90 ? -cosQuadrant(180 - d) : cosQuadrant(d);
}

double tanDeg(double degrees) { return sinDeg(degrees) / cosDeg(degrees); }
double asinDeg(double v) { return toDegrees(asinOf(v)); }
double acosDeg(double v) { return toDegrees(acosOf(v)); }
double atanDeg(double v) { return toDegrees(atan2Of(v, 1)); }
double atan2Deg(double y, double x) { return toDegrees(atan2Of(y, x)); }

}  // namespace gable
