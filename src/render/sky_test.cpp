// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/sky.h"

#include <gtest/gtest.h>

#include "math/trig.h"

namespace gable::rt {
namespace {

float up(double elevation) { return static_cast<float>(sinDeg(elevation)); }

TEST(Sky, zenithIsBlueAndHorizonPaler) {
  const Sky sky(40);
  const Vec3f zenith = sky.radiance(1, 0), horizon = sky.radiance(up(2), -1);
  EXPECT_GT(zenith.z, 2 * zenith.x);
  EXPECT_GT(luminance(horizon), 2 * luminance(zenith));
  EXPECT_LT(horizon.z / horizon.x, zenith.z / zenith.x);
}

// Skies give a level surface from a twentieth, in the clearest air, to a quarter of what the sun
// gives one that faces it.
TEST(Sky, givesTheShareOfTheSunThatClearSkiesGive) {
  for (const double elevation : {25.0, 40.0, 60.0}) {
    const Sky sky(elevation);
    const float share = luminance(sky.irradiance) / luminance(sky.sun);
    EXPECT_GT(share, 0.05f) << elevation;
    EXPECT_LT(share, 0.25f) << elevation;
    const Sky milky(elevation, 20);
    EXPECT_GT(luminance(milky.irradiance) / luminance(milky.sun), 1.5f * share) << elevation;
  }
}

TEST(Sky, sunReddensAndDimsWhileItSets) {
  Vec3f before = Sky(60).sun;
  for (const double elevation : {30.0, 15.0, 6.0, 2.0, 0.5}) {
    const Vec3f sun = Sky(elevation).sun;
    EXPECT_LT(luminance(sun), luminance(before));
    EXPECT_LT(sun.z / sun.x, before.z / before.x);
    before = sun;
  }
  EXPECT_EQ(maxOf(Sky(-2).sun), 0);
}

TEST(Sky, twilightFadesTowardsNight) {
  float before = luminance(Sky(5).irradiance);
  for (const double elevation : {0.0, -4.0, -8.0, -12.0}) {
    const float light = luminance(Sky(elevation).irradiance);
    EXPECT_LT(light, 0.6f * before) << elevation;
    EXPECT_GT(light, 0) << elevation;
    before = light;
  }
  EXPECT_LT(before, 1e-3f * luminance(Sky(20).irradiance));
}

TEST(Sky, eveningIsWarmOnTheSunsSideAlone) {
  const Sky sky(1);
  const Vec3f west = sky.radiance(up(1), 1), east = sky.radiance(up(1), -1);
  EXPECT_GT(luminance(west), luminance(east));
  EXPECT_GT(west.x / west.z, 1.5f * east.x / east.z);
}

TEST(Sky, hazeWhitensIt) {
  const Vec3f clear = Sky(40, 1).radiance(up(30), 0), milky = Sky(40, 6).radiance(up(30), 0);
  EXPECT_LT(milky.z / milky.x, clear.z / clear.x);
  EXPECT_LT(luminance(Sky(40, 6).sun), luminance(Sky(40, 1).sun));
}

TEST(Sky, isNowhereNegativeOrInfinite) {
  for (const double elevation : {-90.0, -20.0, -0.1, 0.0, 0.3, 45.0, 90.0}) {
    for (const double haze : {0.0, 1.0, 50.0}) {
      const Sky sky(elevation, haze);
      for (int i = 0; i <= 20; ++i) {
        for (int k = 0; k <= 8; ++k) {
          const Vec3f c = sky.radiance(static_cast<float>(i) / 20, static_cast<float>(k) / 4 - 1);
          ASSERT_TRUE(isFinite(c)) << elevation << " " << haze;
          ASSERT_GE(std::min(c.x, std::min(c.y, c.z)), 0) << elevation << " " << haze;
        }
      }
    }
  }
}

}  // namespace
}  // namespace gable::rt
