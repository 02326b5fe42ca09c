// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where the sun stands over a place at a time. Within 0.02 degrees of the Astronomical Almanac from
// 1950 to 2050; the air's refraction is part of it. The same numbers on every machine.
#pragma once

namespace gable {

/// A moment of the Gregorian calendar; `hour` may have any fraction and counts in the zone
/// `hoursEast` of Greenwich.
struct Moment {
  int year = 2000, month = 6, day = 21;
  double hour = 12;
  double hoursEast = 0;
};

/// Degrees above the horizon, and clockwise from north.
struct SunPosition {
  double elevation = 0, azimuth = 0;
};

/// `latitude` and `longitude` in degrees, north and east positive.
SunPosition sunPosition(double latitude, double longitude, const Moment& moment);

}  // namespace gable
