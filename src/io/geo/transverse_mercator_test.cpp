// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/geo/transverse_mercator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "math/trig.h"

namespace gable {
namespace {

TEST(TransverseMercator, inverseUndoesForward) {
  for (uint64_t i = 0; i < 2000; ++i) {
    const LonLat center{randomIn(i, -180, 180), randomIn(i + 10000, -80, 80)};
    const TransverseMercator tm(center);
    const LonLat p{center.longitude + randomIn(i + 20000, -5, 5),
                   center.latitude + randomIn(i + 30000, -5, 5)};
    const Vec2 q = tm.forward(p);
    const Vec2 back = tm.forward(tm.inverse(q));
    EXPECT_NEAR(back.x, q.x, 1e-8);
    EXPECT_NEAR(back.y, q.y, 1e-8);
  }
}

TEST(TransverseMercator, theCentreIsTheOriginAndNorthIsUp) {
  const TransverseMercator tm({7.42, 43.735});
  const Vec2 o = tm.forward({7.42, 43.735});
  EXPECT_NEAR(o.x, 0, 1e-9);
  EXPECT_NEAR(o.y, 0, 1e-9);
  EXPECT_GT(tm.forward({7.43, 43.735}).x, 0);
  EXPECT_GT(tm.forward({7.42, 43.745}).y, 0);
}

// Lengths along the meridian and the parallel from the radii of curvature of the ellipsoid.
TEST(TransverseMercator, smallStepsHaveTheLengthOfTheEllipsoid) {
  const double a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  for (const double latitude : {-60.0, -10.0, 0.0, 43.735, 75.0}) {
    const TransverseMercator tm({20, latitude});
    const double s = sinDeg(latitude), w = 1 - e2 * s * s;
    const double step = 1e-3, radians = toRadians(step);
    const double meridian = a * (1 - e2) / (w * std::sqrt(w)) * radians;
    const double parallel = a / std::sqrt(w) * cosDeg(latitude) * radians;
    const Vec2 north =
        tm.forward({20, latitude + step / 2}) - tm.forward({20, latitude - step / 2});
    const Vec2 east = tm.forward({20 + step / 2, latitude}) - tm.forward({20 - step / 2, latitude});
    EXPECT_NEAR(north.y, meridian, 1e-6);
    EXPECT_NEAR(east.x, parallel, 1e-6);
    EXPECT_NEAR(north.x, 0, 1e-9);
    EXPECT_NEAR(east.y, 0, 1e-9);
  }
}

// The quarter meridian of WGS 84 is 10001965.729 m; the series must give it from equator to pole.
TEST(TransverseMercator, theQuarterMeridianIsRight) {
  const TransverseMercator tm({0, 0});
  EXPECT_NEAR(tm.forward({0, 90}).y, 10001965.729, 2e-3);
}

TEST(TransverseMercator, longitudesGoRound) {
  const TransverseMercator tm({179.9, 10});
  EXPECT_NEAR(tm.forward({-179.9, 10}).x, -tm.forward({179.7, 10}).x, 1e-6);
}

}  // namespace
}  // namespace gable
