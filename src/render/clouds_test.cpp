// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "render/clouds.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/parallel_work.h"
#include "math/trig.h"

namespace gable::rt {
namespace {

Vec3f towards(double elevation, double turn) {
  return toVec3f(
      {cosDeg(elevation) * cosDeg(turn), sinDeg(elevation), cosDeg(elevation) * sinDeg(turn)});
}

/// What stands between two elevations, on average.
Clouds::Seen mean(const Clouds& clouds, double low, double high) {
  Clouds::Seen sum{0, 0, 0};
  int count = 0;
  for (double elevation = low; elevation < high; elevation += 1.3) {
    for (double turn = 0.5; turn < 360; turn += 2.1, ++count) {
      const Clouds::Seen seen = clouds.seen(towards(elevation, turn));
      sum = {sum.clear + seen.clear, sum.sun + seen.sun, sum.sky + seen.sky};
    }
  }
  const float share = 1 / static_cast<float>(count);
  return {sum.clear * share, sum.sun * share, sum.sky * share};
}

// A share of the sky is not met to the percent: clouds stand high, so more of it is hidden to the
// side than overhead, and their edges are thin.
TEST(Clouds, hideAboutTheShareThatIsAskedFor) {
  float before = 0;
  for (const double cover : {0.1, 0.3, 0.7}) {
    const float hidden = 1 - mean(Clouds(cover, 38), 20, 70).clear;
    EXPECT_NEAR(hidden, cover, 0.15) << cover;
    EXPECT_GT(hidden, before + 0.02f) << cover;
    before = hidden;
  }
}

TEST(Clouds, sendNoMoreThanTheyTake) {
  const Clouds clouds(0.5, 38);
  for (double elevation = 0; elevation <= 90; elevation += 0.7) {
    for (double turn = -180; turn <= 360; turn += 3.3) {
      const Clouds::Seen seen = clouds.seen(towards(elevation, turn));
      ASSERT_GE(seen.clear, 0);
      ASSERT_LE(seen.clear, 1);
      // White bodies send all of it, to all sides.
      ASSERT_LE(seen.sun, (1 - seen.clear) * 1.15f / kPif + 1e-6f);
      ASSERT_LE(seen.sky, (1 - seen.clear) * 1.001f / kPif + 1e-6f);
    }
  }
}

TEST(Clouds, fadeTowardsTheHorizonAndAreNowhereBelow) {
  const Clouds clouds(0.6, 38);
  EXPECT_GT(mean(clouds, 0.5, 2).clear, 0.9f);
  EXPECT_EQ(clouds.seen(towards(-1, 20)).clear, 1);
  EXPECT_EQ(clouds.seen(towards(0, 20)).sun, 0);
}

TEST(Clouds, areTheSameHoweverManyLookWhereverFirst) {
  const Clouds one(0.4, 20), other(0.4, 20);
  constexpr size_t kDirections = 1500;
  const auto direction = [](size_t i) {
    const double k = static_cast<double>(i);
    return towards(1 + 88 * k / kDirections, 137.5 * k);
  };
  std::vector<Clouds::Seen> backwards(kDirections);
  parallelWork(kDirections, 4, [&](size_t i, unsigned) {
    const size_t at = kDirections - 1 - i;
    backwards[at] = other.seen(direction(at));
  });
  for (size_t i = 0; i < kDirections; ++i) {
    const Clouds::Seen seen = one.seen(direction(i));
    ASSERT_EQ(seen.clear, backwards[i].clear);
    ASSERT_EQ(seen.sun, backwards[i].sun);
    ASSERT_EQ(seen.sky, backwards[i].sky);
  }
}

// Neighbouring tiles agree, also where the circle closes.
TEST(Clouds, haveNoSeams) {
  const Clouds clouds(0.7, 38);
  for (double turn = -0.2; turn < 360.2; turn += 0.05) {
    const Clouds::Seen a = clouds.seen(towards(41.3, turn)),
                       b = clouds.seen(towards(41.3, turn + 0.01));
    ASSERT_NEAR(a.clear, b.clear, 0.08) << turn;
  }
}

/// Whether something stands in a direction and nothing in a circle of two degrees about it.
bool isSpeck(const Clouds& clouds, double elevation, double turn) {
  if (clouds.seen(towards(elevation, turn)).clear > 0.95f) return false;
  constexpr int kAround = 24;
  for (int k = 0; k < kAround; ++k) {
    const double angle = 360.0 * k / kAround, aside = 2 * cosDeg(angle) / cosDeg(elevation);
    if (clouds.seen(towards(elevation + 2 * sinDeg(angle), turn + aside)).clear < 0.99f) {
      return false;
    }
  }
  return true;
}

// A puff of some metres in an empty sky is a white dot in the picture.
TEST(Clouds, areNoSpecks) {
  const Clouds clouds(0.25, 38);
  for (double elevation = 14; elevation < 27; elevation += 0.15) {
    for (double turn = 0; turn < 360; turn += 0.15) {
      ASSERT_FALSE(isSpeck(clouds, elevation, turn)) << elevation << ' ' << turn;
    }
  }
}

TEST(Clouds, haveABrightRimTowardsTheSun) {
  EXPECT_NEAR(Clouds::forward(0), 1, 1e-6);
  EXPECT_GT(Clouds::forward(0.99f), 3);
  EXPECT_GT(Clouds::forward(-1), 0.5f);
}

}  // namespace
}  // namespace gable::rt
