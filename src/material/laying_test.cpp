// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "material/laying.h"

#include <gtest/gtest.h>

namespace gable {

namespace {

// The pitch is a 3-4-5 triangle: rises 3 on 4.
const Vec3 kSouthSlope{0, 0.8, 0.6};
const Vec3 kEastSlope{0.6, 0.8, 0};

}  // namespace

TEST(Laying, uprightFacesHaveTheHeightAsV) {
  for (const Vec3& n : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-0.6, 0, 0.8}}) {
    const FaceAxes a = layingAxes(n);
    EXPECT_EQ(a.at({3, 2.5, -7}).y, 2.5);
    // u runs to the right for who looks at the face.
    EXPECT_NEAR(dot(cross(a.u, a.v), n), 1, 1e-12);
  }
}

TEST(Laying, slopesKeepLengths) {
  const FaceAxes a = layingAxes(kSouthSlope);
  // 5 metres up the slope.
  EXPECT_NEAR(a.at({0, 3, -4}).y - a.at({0, 0, 0}).y, 5, 1e-12);
  EXPECT_NEAR(a.at({2, 0, 0}).x - a.at({0, 0, 0}).x, 2, 1e-12);
}

TEST(Laying, coursesOfEqualSlopesMeetAtTheHip) {
  const FaceAxes south = layingAxes(kSouthSlope), east = layingAxes(kEastSlope);
  for (const double t : {0.0, 1.7, 20.0}) {
    const Vec3 onHip{10 - 4 * t, 3 * t, 10 - 4 * t};
    EXPECT_NEAR(south.at(onHip).y, east.at(onHip).y, 1e-9);
  }
}

TEST(Laying, levelAndBrokenNormalsHaveFiniteAxes) {
  EXPECT_EQ(layingAxes({0, 1, 0}).at({2, 9, -3}), (Vec2{2, 3}));
  EXPECT_EQ(layingAxes({0, -1, 0}).at({2, 9, 3}), (Vec2{2, 3}));
  EXPECT_EQ(layingAxes({}).at({2, 9, -3}), (Vec2{2, 3}));
}

}  // namespace gable
