// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/room_volume.h"

#include <gtest/gtest.h>

#include <limits>

#include "math/trig.h"

namespace gable {
namespace {

Frame turnedAt(const Vec3& at, double degrees) {
  const double c = cosDeg(degrees), s = sinDeg(degrees);
  return Frame::of(at, {c, 0, -s}, {0, 1, 0}, {s, 0, c});
}

Shape boxOf(const Frame& scope, const Vec3& size) {
  Shape s;
  s.scope = scope;
  s.size = size;
  s.geometry.kind = GeometryKind::Box;
  return s;
}

// A face on the ground whose ring of (x, z) is seen from above; it looks up or down.
Shape faceOf(std::vector<Vec2> ring, bool up) {
  double area = 0;
  for (size_t i = 0; i < ring.size(); ++i) area += cross(ring[i], ring[(i + 1) % ring.size()]);
  // z runs down in the plan: what is clockwise there looks up.
  if ((area < 0) != up) std::reverse(ring.begin(), ring.end());
  MeshBuilder b;
  std::vector<uint32_t> corners;
  for (const Vec2 p : ring) corners.push_back(b.addPosition({p.x, 0, p.y}));
  b.addPolygon(corners);
  Shape s;
  s.size = {1, 0, 1};
  setMesh(s, makeRef<Mesh>(b.take()), ScopeFit::Keep);
  return s;
}

bool collide(const Shape& a, const Shape& b, double clearance = 0, bool byHeight = false) {
  RoomVolumes volumes;
  volumes.add(a, Frame{});
  volumes.add(b, Frame{});
  const bool forth = RoomVolumes::collide({volumes, 0}, {volumes, 1}, clearance, byHeight);
  EXPECT_EQ(forth, RoomVolumes::collide({volumes, 1}, {volumes, 0}, clearance, byHeight));
  return forth;
}

TEST(RoomVolumes, ContactIsNoOverlap) {
  const Shape box = boxOf(Frame{}, {2, 2, 2});
  EXPECT_FALSE(collide(box, boxOf(Frame::moved({2, 0, 0}), {2, 2, 2})));
  EXPECT_FALSE(collide(box, boxOf(Frame::moved({1.9995, 0, 0}), {2, 2, 2})));
  EXPECT_FALSE(collide(box, boxOf(Frame::moved({2, 0, 2}), {2, 2, 2})));
  EXPECT_TRUE(collide(box, boxOf(Frame::moved({1.99, 0, 0}), {2, 2, 2})));
  EXPECT_TRUE(collide(box, boxOf(Frame::moved({0.5, 0, 0.5}), {1, 1, 1})));
  EXPECT_TRUE(collide(box, box));
}

TEST(RoomVolumes, TurnedBoxesPassCorners) {
  const Shape box = boxOf(Frame{}, {2, 2, 2});
  // A square on its corner, whose box meets the other one.
  EXPECT_FALSE(collide(box, boxOf(turnedAt({1.5, 0, 3.3}, 45), {2, 2, 2})));
  EXPECT_TRUE(collide(box, boxOf(turnedAt({1.5, 0, 2.3}, 45), {2, 2, 2})));
}

TEST(RoomVolumes, ClearanceIsFromPointToPoint) {
  const Shape box = boxOf(Frame{}, {2, 2, 2});
  EXPECT_FALSE(collide(box, boxOf(Frame::moved({3, 0, 0}), {2, 2, 2}), 1));
  EXPECT_TRUE(collide(box, boxOf(Frame::moved({3, 0, 0}), {2, 2, 2}), 1.1));
  // From corner to corner it is the diagonal.
  const Shape atCorner = boxOf(Frame::moved({3, 0, 3}), {2, 2, 2});
  EXPECT_FALSE(collide(box, atCorner, 1.41));
  EXPECT_TRUE(collide(box, atCorner, 1.42));
}

TEST(RoomVolumes, HeightsCountWhereTheyAreAskedFor) {
  const Shape box = boxOf(Frame{}, {2, 2, 2}), above = boxOf(Frame::moved({0, 2, 0}), {2, 2, 2});
  EXPECT_TRUE(collide(box, above));
  EXPECT_FALSE(collide(box, above, 0, true));
  EXPECT_TRUE(collide(box, boxOf(Frame::moved({0, 3, 0}), {2, 2, 2}), 1.5, true));
  EXPECT_FALSE(collide(box, boxOf(Frame::moved({0, 3.5, 0}), {2, 2, 2}), 1.5, true));
  // 1 m beside and 1 m above.
  EXPECT_FALSE(collide(box, boxOf(Frame::moved({3, 3, 0}), {2, 2, 2}), 1.41, true));
  EXPECT_TRUE(collide(box, boxOf(Frame::moved({3, 3, 0}), {2, 2, 2}), 1.42, true));
}

TEST(RoomVolumes, FlatOnesInOnePlaneAreComparedThere) {
  Shape window = boxOf(Frame{}, {2, 2, 0});
  window.geometry.kind = GeometryKind::QuadXy;
  const auto at = [&](double x, double y, double z) {
    Shape s = window;
    s.scope = Frame::moved({x, y, z});
    return s;
  };
  EXPECT_TRUE(collide(window, at(1, 1, 0), 0, true));
  EXPECT_FALSE(collide(window, at(2, 0, 0), 0, true));
  EXPECT_FALSE(collide(window, at(0, 2, 0), 0, true));
  EXPECT_FALSE(collide(window, at(1, 1, 0.1), 0, true));
  // A wall that it lies on is only touched.
  EXPECT_FALSE(collide(window, boxOf(Frame::moved({-5, -5, -1}), {10, 10, 1}), 0, true));
}

TEST(RoomVolumes, PointsAreInTheWayWithinOthersAndWhereTheyCoincide) {
  const Shape point = boxOf(Frame::moved({1, 0, 1}), {});
  EXPECT_TRUE(collide(point, point));
  EXPECT_TRUE(collide(point, boxOf(Frame{}, {2, 2, 2})));
  EXPECT_FALSE(collide(point, boxOf(Frame{}, {1, 2, 2})));
  EXPECT_FALSE(collide(point, boxOf(Frame::moved({1.5, 0, 1}), {})));
  EXPECT_TRUE(collide(point, boxOf(Frame::moved({1.5, 0, 1}), {}), 0.6));
}

TEST(RoomVolumes, FacesAreTakenWithTheirNotches) {
  for (const bool up : {true, false}) {
    const Shape angle = faceOf({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, up);
    EXPECT_FALSE(collide(angle, boxOf(Frame::moved({1, 0, 1}), {3, 1, 3}))) << up;
    EXPECT_TRUE(collide(angle, boxOf(Frame::moved({0.9, 0, 1}), {3, 1, 3}))) << up;
    EXPECT_TRUE(collide(angle, boxOf(Frame::moved({2, 0, 2}), {1, 1, 1}), 1.1)) << up;
    EXPECT_FALSE(collide(angle, boxOf(Frame::moved({2, 0, 2}), {1, 1, 1}), 1)) << up;
  }
}

// A ring road in a hundred pieces leaves its middle free; a body as rich counts as its hull.
TEST(RoomVolumes, WhatLiesFlatIsNeverItsHull) {
  for (const double height : {0.0, 1.0}) {
    MeshBuilder b;
    const auto at = [&](double degrees, double r) {
      return b.addPosition({r * cosDeg(degrees), height * r / 10, r * sinDeg(degrees)});
    };
    for (int i = 0; i < 100; ++i) {
      const double from = 3.6 * i, to = 3.6 * (i + 1);
      const uint32_t corners[] = {at(to, 9), at(to, 10), at(from, 10), at(from, 9)};
      b.addPolygon(corners);
    }
    Shape road;
    road.size = {1, height, 1};
    setMesh(road, makeRef<Mesh>(b.take()), ScopeFit::Keep);
    EXPECT_TRUE(collide(road, boxOf(Frame::moved({9.5, 0, 0}), {1, 1, 1})));
    EXPECT_EQ(collide(road, boxOf(Frame::moved({-1, 0, -1}), {2, 1, 2})), height > 0) << height;
  }
}

TEST(RoomVolumes, WhatIsNotFiniteIsNotSound) {
  RoomVolumes volumes;
  volumes.add(boxOf(Frame{}, {1, 1, 1}), Frame{});
  volumes.add(boxOf(Frame::moved({std::numeric_limits<double>::quiet_NaN(), 0, 0}), {1, 1, 1}),
              Frame{});
  volumes.add(boxOf(Frame{}, {std::numeric_limits<double>::infinity(), 1, 1}), Frame{});
  EXPECT_TRUE(volumes.isSound(0));
  EXPECT_FALSE(volumes.isSound(1));
  EXPECT_FALSE(volumes.isSound(2));
}

}  // namespace
}  // namespace gable
