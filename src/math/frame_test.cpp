// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "math/frame.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/trig.h"

namespace gable {
namespace {

double distance(const Vec3& a, const Vec3& b) { return length(a - b); }

TEST(Frame, composesAndInverts) {
  const Frame a = Frame::moved({1, 2, 3}) * rotationXyz(10, 20, 30);
  const Frame b = Frame::moved({-4, 0, 2}) * rotationXyz(-70, 5, 120);
  const Vec3 p{0.3, -7, 11};
  EXPECT_LT(distance((a * b).point(p), a.point(b.point(p))), 1e-12);
  EXPECT_LT(distance((inverse(a) * a).point(p), p), 1e-12);
  EXPECT_LT(distance(a.toLocal(a.point(p)), p), 1e-12);
}

TEST(Frame, quarterTurnsAreExact) {
  EXPECT_EQ(rotationXyz(0, 90, 0).x, (Vec3{0, 0, -1}));
  EXPECT_EQ(rotationXyz(90, 0, 0).y, (Vec3{0, 0, 1}));
  EXPECT_EQ(rotationXyz(0, 0, 90).x, (Vec3{0, 1, 0}));
  EXPECT_FALSE(rotationXyz(360, -360, 720).turned);
}

TEST(Frame, anglesComeBack) {
  for (uint64_t i = 0; i < 200; ++i) {
    const Frame f = rotationXyz(randomIn(3 * i, -180, 180), randomIn(3 * i + 1, -180, 180),
                                randomIn(3 * i + 2, -180, 180));
    const Vec3 a = anglesXyz(f);
    const Frame g = rotationXyz(a.x, a.y, a.z);
    EXPECT_LT(distance(f.x, g.x) + distance(f.y, g.y) + distance(f.z, g.z), 1e-9);
  }
  const Vec3 pole = anglesXyz(rotationXyz(0, 90, 25));
  EXPECT_LT(distance(rotationXyz(pole.x, pole.y, pole.z).y, rotationXyz(0, 90, 25).y), 1e-9);
}

TEST(Frame, axesFromZStayOrthonormal) {
  for (const Vec3 hint : {Vec3{1, 0, 0}, Vec3{0, 0, 3}, Vec3{0, 0, 0}}) {
    const Frame f = frameFromZ({}, {0, 0, 2}, hint);
    EXPECT_NEAR(dot(f.x, f.z), 0, 1e-15);
    EXPECT_NEAR(length(f.x), 1, 1e-15);
    EXPECT_EQ(cross(f.z, f.x), f.y);
  }
}

TEST(Trig, exactAtTheUsualAngles) {
  EXPECT_EQ(sinDeg(30), 0.5);
  EXPECT_EQ(sinDeg(180), 0.0);
  EXPECT_EQ(cosDeg(60), 0.5);
  EXPECT_EQ(cosDeg(-270), 0.0);
  EXPECT_EQ(tanDeg(45), 1.0);
  for (double d = -720; d <= 720; d += 7.25) {
    EXPECT_NEAR(sinDeg(d), std::sin(toRadians(d)), 1e-14);
    EXPECT_NEAR(cosDeg(d), std::cos(toRadians(d)), 1e-14);
  }
}

}  // namespace
}  // namespace gable
