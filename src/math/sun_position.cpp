// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Michalsky 1988, The Astronomical Almanac's Algorithm for Approximate Solar Position (1950-2050),
// Solar Energy 40(3), with the refraction of Saemundsson 1986. Angles are in degrees.

#include "math/sun_position.h"

#include <cmath>

#include "math/trig.h"

namespace gable {

namespace {

/// Days from noon of 1 January 2000 to midnight of a day (Fliegel and Van Flandern 1968).
double daysSince2000(int year, int month, int day) {
  const int a = (month - 14) / 12;
  const int julian = (1461 * (year + 4800 + a)) / 4 + (367 * (month - 2 - 12 * a)) / 12 -
                     (3 * ((year + 4900 + a) / 100)) / 4 + day - 32075;
  return julian - 2451545 - 0.5;
}

/// How much higher than without air the sun is seen.
double refraction(double elevation) {
  if (elevation < -1) return 0;
  return 1.02 / 60 / tanDeg(elevation + 10.3 / (elevation + 5.11));
}

}  // namespace

SunPosition sunPosition(double latitude, double longitude, const Moment& moment) {
  const double universal = moment.hour - moment.hoursEast;
  const double n = daysSince2000(moment.year, moment.month, moment.day) + universal / 24;
  const auto turned = [](double degrees) { return degrees - 360 * std::floor(degrees / 360); };
  const double anomaly = turned(357.528 + 0.9856003 * n);
  const double ecliptic =
      turned(280.460 + 0.9856474 * n) + 1.915 * sinDeg(anomaly) + 0.020 * sinDeg(2 * anomaly);
  const double obliquity = 23.439 - 0.0000004 * n;
  const double ascension = atan2Deg(cosDeg(obliquity) * sinDeg(ecliptic), cosDeg(ecliptic));
  const double declination = asinDeg(sinDeg(obliquity) * sinDeg(ecliptic));
  const double sidereal = 6.697375 + 0.0657098242 * n + universal;
  const double hourAngle = turned(15 * sidereal + longitude - ascension);

  const double height = sinDeg(declination) * sinDeg(latitude) +
                        cosDeg(declination) * cosDeg(latitude) * cosDeg(hourAngle);
  const double elevation = asinDeg(height < -1 ? -1 : height > 1 ? 1 : height);
  const double azimuth = atan2Deg(-cosDeg(declination) * sinDeg(hourAngle),
                                  sinDeg(declination) * cosDeg(latitude) -
                                      cosDeg(declination) * sinDeg(latitude) * cosDeg(hourAngle));
  return {elevation + refraction(elevation), turned(azimuth)};
}

}  // namespace gable
