// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "math/sun_position.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

// The worked example of Reda and Andreas 2003, Solar Position Algorithm (NREL/TP-560-34302): zenith
// 50.11162 and azimuth 194.34024 degrees.
TEST(SunPosition, isThatOfTheReferenceWithinAFiftiethOfADegree) {
  const Moment moment{2003, 10, 17, 12 + 30 / 60.0 + 30 / 3600.0, -7};
  const SunPosition sun = sunPosition(39.742476, -105.1786, moment);
  EXPECT_NEAR(sun.elevation, 90 - 50.11162, 0.02);
  EXPECT_NEAR(sun.azimuth, 194.34024, 0.02);
}

TEST(SunPosition, atNoonOfTheSolsticeIsHighestByTheTilt) {
  const SunPosition summer = sunPosition(48.86, 0, {2024, 6, 20, 12, 0});
  EXPECT_NEAR(summer.elevation, 90 - 48.86 + 23.44, 0.05);
  EXPECT_NEAR(summer.azimuth, 180, 1.5);
  const SunPosition winter = sunPosition(48.86, 0, {2024, 12, 21, 12, 0});
  EXPECT_NEAR(winter.elevation, 90 - 48.86 - 23.44, 0.1);
}

TEST(SunPosition, standsInTheNorthSouthOfTheTropics) {
  const SunPosition sun = sunPosition(-33.87, 151.21, {2024, 6, 21, 12, 10});
  EXPECT_NEAR(sun.elevation, 90 - 33.87 - 23.44, 0.2);
  EXPECT_TRUE(sun.azimuth < 5 || sun.azimuth > 355) << sun.azimuth;
}

TEST(SunPosition, risesInTheEastAndSetsInTheWest) {
  const SunPosition morning = sunPosition(0, 0, {2024, 3, 20, 6.3, 0});
  EXPECT_NEAR(morning.azimuth, 90, 1);
  EXPECT_NEAR(morning.elevation, 3, 3);
  EXPECT_NEAR(sunPosition(0, 0, {2024, 3, 20, 18, 0}).azimuth, 270, 1);
  EXPECT_LT(sunPosition(0, 0, {2024, 3, 20, 0, 0}).elevation, -80);
}

TEST(SunPosition, clocksEastOfGreenwichAreEarlier) {
  const SunPosition zone = sunPosition(48.86, 2.35, {2024, 6, 21, 18.5, 2});
  const SunPosition greenwich = sunPosition(48.86, 2.35, {2024, 6, 21, 16.5, 0});
  EXPECT_DOUBLE_EQ(zone.elevation, greenwich.elevation);
  EXPECT_DOUBLE_EQ(zone.azimuth, greenwich.azimuth);
}

}  // namespace
}  // namespace gable
