// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/viewpoint.h"

#include <gtest/gtest.h>

#include "math/trig.h"
#include "render/sampler.h"
#include "render/test_scenes.h"
#include "render/tone.h"

namespace gable::rt {
namespace {

struct Set {
  World world;
  Tracer tracer;
  Subject subject;
  explicit Set(const Scene& scene)
      : world(makeWorld(scene, nullptr)),
        tracer(world),
        subject{world, tracer, framingPoints(world), world.footHeight, frontAzimuthOf(world)} {}
};

struct Reach {
  double left = 1, right = 0, low = 1, high = 0;
};

/// What part of the picture the points take.
Reach reachOf(const Camera& c, const std::vector<Vec3f>& points, double aspect) {
  Reach r;
  for (const Vec3f& p : points) {
    const Vec3 d = toVec3(p) - c.eye;
    const double ahead = c.parallel ? 1 : dot(d, c.forward);
    EXPECT_GT(ahead, 0);
    const double x = 0.5 + dot(d, c.right) / ahead / (2 * c.halfWidth);
    const double y = c.horizon + dot(d, c.up) / ahead / (2 * c.halfWidth) * aspect;
    r.left = std::min(r.left, x);
    r.right = std::max(r.right, x);
    r.low = std::min(r.low, y);
    r.high = std::max(r.high, y);
  }
  return r;
}

Scene boxScene(const Vec3& size, double turn = 0) {
  SceneMaker m;
  m.box({-size.x / 2, 0, -size.z / 2}, size, m.material("#808080"));
  m.leaves.back().frame = rotationXyz(0, turn, 0) * m.leaves.back().frame;
  return std::move(m.finish());
}

TEST(Viewpoint, viewsHoldTheWholeSubject) {
  for (const Vec3& size :
       {Vec3{10, 8, 12}, Vec3{80, 5, 10}, Vec3{20, 120, 20}, Vec3{300, 1, 200}}) {
    const Set s(boxScene(size));
    RenderOptions o;
    const Vec3f sun = towardsSun(38, 225);
    for (const PictureView view : {PictureView::Iso, PictureView::Top, PictureView::Front}) {
      o.view = view;
      const Camera c = chooseCamera(s.subject, o, sun);
      const Reach r = reachOf(c, s.subject.points, 16.0 / 9);
      EXPECT_GE(r.left, 0.03);
      EXPECT_LE(r.right, 0.97);
      EXPECT_GE(r.low, 0.03);
      EXPECT_LE(r.high, 0.97);
      EXPECT_GT(std::max(r.right - r.left, r.high - r.low), 0.5);
    }
  }
}

TEST(Viewpoint, frontAndStreetKeepVerticalsUpright) {
  const Set s(streetScene());
  RenderOptions o;
  const Vec3f sun = towardsSun(38, 225);
  for (const PictureView view : {PictureView::Front, PictureView::Street}) {
    o.view = view;
    const Camera c = chooseCamera(s.subject, o, sun);
    EXPECT_EQ(c.up, (Vec3{0, 1, 0}));
    EXPECT_EQ(c.forward.y, 0);
    EXPECT_LT(c.horizon, 0.45);
  }
}

TEST(Viewpoint, streetHoldsAllOfATower) {
  for (const Vec3& size : {Vec3{20, 60, 20}, Vec3{40, 200, 30}, Vec3{12, 9, 10}}) {
    const Set s(boxScene(size));
    RenderOptions o;
    o.view = PictureView::Street;
    for (const uint32_t height : {500u, 900u, 2000u}) {
      o.height = height;
      const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
      EXPECT_NEAR(c.eye.y, s.subject.groundHeight + kEyeHeight, 1e-9);
      const Reach r = reachOf(c, s.subject.points, 1600.0 / height);
      EXPECT_GE(r.left, 0.03);
      EXPECT_LE(r.right, 0.97);
      EXPECT_GE(r.low, 0.03);
      EXPECT_LE(r.high, 0.97);
    }
  }
}

TEST(Viewpoint, streetEyeStandsOnOpenGround) {
  const Set s(streetScene());
  RenderOptions o;
  o.view = PictureView::Street;
  const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
  Ray up;
  up.origin = toVec3f(c.eye);
  up.direction = {0, 1, 0};
  Hit hit;
  EXPECT_FALSE(s.tracer.intersect(up, hit));
  Ray down = up;
  down.direction = {0, -1, 0};
  ASSERT_TRUE(s.tracer.intersect(down, hit) || c.eye.y < s.subject.groundHeight + 2);
}

// A wall at arm's length would fill a third of the picture.
TEST(Viewpoint, streetEyeKeepsAwayFromWalls) {
  for (const double width : {9.0, 14.0, 20.0}) {
    SceneMaker m;
    const uint32_t wall = m.material("#e3cf9f");
    m.box({-50, -0.2, -60}, {100, 0.2, 120}, m.material("#808080"));
    for (int k = 0; k < 6; ++k) {
      m.box({-width / 2 - 12, 0, -59.0 + 20 * k}, {12, 12.0 + k % 3, 19.5}, wall);
      m.box({width / 2, 0, -59.0 + 20 * k}, {12, 13.0 + k % 2, 19.5}, wall);
    }
    const Set s(m.finish());
    RenderOptions o;
    o.view = PictureView::Street;
    const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
    for (const double side : {-1.0, 1.0}) {
      Ray aside;
      aside.origin = toVec3f(c.eye);
      aside.direction = toVec3f(normalized(c.right * side + c.forward * 0.3));
      Hit hit;
      if (s.tracer.intersect(aside, hit)) {
        EXPECT_GT(hit.distance, 2.5f) << width;
      }
    }
  }
}

// A slope of 30 % with houses along level streets.
Scene hillTown() {
  SceneMaker m;
  const uint32_t earth = m.material("#8f7f5e"), wall = m.material("#e3cf9f");
  for (int k = 0; k < 40; ++k) m.box({-200, -20, -200.0 + 10 * k}, {400, 20 + 3.0 * k, 10}, earth);
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < 24; ++i) {
      m.box({-190.0 + 16 * i, 0, -190.0 + 50 * k}, {13, 12 + 15.0 * k, 11}, wall);
      m.box({-190.0 + 16 * i, 0, -169.0 + 50 * k}, {13, 18 + 15.0 * k, 11}, wall);
    }
  }
  return std::move(m.finish());
}

TEST(Viewpoint, streetEyeStandsOnItsHill) {
  const Set s(hillTown());
  RenderOptions o;
  o.view = PictureView::Street;
  const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
  Ray down;
  down.origin = toVec3f(c.eye);
  down.direction = {0, -1, 0};
  Hit hit;
  ASSERT_TRUE(s.tracer.intersect(down, hit));
  EXPECT_NEAR(hit.distance, kEyeHeight, 1e-3);
  Ray up = down;
  up.direction = {0, 1, 0};
  EXPECT_FALSE(s.tracer.intersect(up, hit));
  // On the steps of the slope, and on no roof; not at the border.
  const Vec3 at = c.eye + s.world.origin;
  const double ground = 3 * std::floor((at.z + 200) / 10);
  EXPECT_NEAR(at.y - kEyeHeight, ground, 1e-3);
  EXPECT_LT(std::max(std::abs(at.x), std::abs(at.z)), 150);
}

TEST(Viewpoint, frontEyeIsAboveItsHill) {
  const Set s(hillTown());
  RenderOptions o;
  o.target = Vec3{0, 60, 0};
  for (const PictureView view : {PictureView::Iso, PictureView::Front, PictureView::Street}) {
    o.view = view;
    const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
    Ray up;
    up.origin = toVec3f(c.eye);
    up.direction = {0, 1, 0};
    Hit hit;
    EXPECT_FALSE(s.tracer.intersect(up, hit));
  }
}

TEST(Viewpoint, frontIsAnElevation) {
  const Set s(boxScene({20, 10, 8}, 30));
  RenderOptions o;
  o.view = PictureView::Front;
  const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
  EXPECT_TRUE(c.parallel);
  EXPECT_NEAR(c.forward.x, -sinDeg(150), 1e-3);
  EXPECT_NEAR(c.forward.z, cosDeg(150), 1e-3);
  // The wall of 20 metres is as wide as on paper, and stands on the ground line.
  const Reach r = reachOf(c, s.subject.points, 16.0 / 9);
  EXPECT_NEAR((r.right - r.left) * 2 * c.halfWidth, 20, 0.01);
  EXPECT_NEAR(r.low, c.horizon, 1e-6);
}

/// Where the ground is found under two boxes on a lot at height 0: corner and size of each.
double footUnder(const Vec3& a, const Vec3& sizeOfA, const Vec3& b, const Vec3& sizeOfB) {
  SceneMaker m;
  const uint32_t grey = m.material("#909090");
  m.box(a, sizeOfA, grey);
  m.box(b, sizeOfB, grey);
  Scene& lot = m.finish();
  lot.place.include(Vec3{});
  const World world = makeWorld(lot, nullptr);
  return world.footHeight + world.origin.y;
}

TEST(Viewpoint, twigsThatReachDeepAreNoTerrain) {
  EXPECT_NEAR(footUnder({0, 0, 0}, {20, 9, 10}, {30, -4, 0}, {0.1, 12, 0.1}), 0, 1e-6);
  // A cellar does.
  EXPECT_NEAR(footUnder({0, 0, 0}, {20, 9, 10}, {30, -4, 0}, {3, 4, 3}), -4, 1e-6);
  // And so do posts that stand on the lot.
  EXPECT_NEAR(footUnder({0, 4, 0}, {20, 9, 10}, {1, 0, 1}, {0.1, 4, 0.1}), 0, 1e-6);
}

TEST(Viewpoint, frontFollowsTurnedWalls) {
  for (const double turn : {-30.0, -10.0, 0.0, 20.0, 40.0}) {
    const World world = makeWorld(boxScene({20, 10, 8}, turn), nullptr);
    EXPECT_NEAR(frontAzimuthOf(world), 180 - turn, 0.1);
    EXPECT_GT(world.wallAgreement, 0.99);
  }
}

TEST(Viewpoint, groundIgnoresRootsButFollowsTerrain) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  m.box({0, 0, 0}, {30, 5, 30}, grey);
  m.box({40, -1, 0}, {0.2, 6, 0.2}, grey);
  EXPECT_NEAR(makeWorld(m.finish(), nullptr).footHeight, 0, 1e-6);
  SceneMaker valley;
  const uint32_t green = valley.material("#6B8743");
  valley.box({0, 0, 0}, {30, 5, 30}, green);
  valley.box({30, -8, 0}, {30, 1, 30}, green);
  EXPECT_NEAR(makeWorld(valley.finish(), nullptr).footHeight, -8, 1e-6);
}

// A canal that is a small part of its town.
TEST(Viewpoint, groundLiesBelowCanals) {
  for (const bool isCanal : {true, false}) {
    SceneMaker m;
    const uint32_t grey = m.material("#808080");
    m.box({0, -0.1, 0}, {500, 0.1, 500}, grey);
    m.box({500, -1.4, 0}, {6, 0.2, 200}, grey);
    Scene scene = m.finish();
    scene.names.push_back("Water");
    if (isCanal) scene.leaves.back().name = static_cast<uint32_t>(scene.names.size() - 1);
    EXPECT_NEAR(makeWorld(scene, nullptr).footHeight, isCanal ? -1.4 : -0.1, 1e-6);
  }
}

TEST(Viewpoint, eyeAndTargetReplaceTheView) {
  const Set s(boxScene({4, 4, 4}));
  RenderOptions o;
  o.eye = Vec3{10, 5, 0};
  o.target = Vec3{0, 5, 0};
  const Camera c = chooseCamera(s.subject, o, towardsSun(38, 225));
  EXPECT_NEAR(c.forward.x, -1, 1e-12);
  EXPECT_NEAR(c.right.z, -1, 1e-12);
  EXPECT_EQ(c.eye + s.world.origin, (Vec3{10, 5, 0}));
}

TEST(Sampler, everyDimensionFillsTheSquareEvenly) {
  for (uint32_t dimension = 0; dimension < 40; ++dimension) {
    for (const uint32_t bits : {0u, 1u, 2u, 3u, 4u}) {
      // Elementary intervals: 16 points, one in each of 2^bits x 2^(4-bits) cells.
      std::vector<int> cells(16, 0);
      for (uint32_t s = 0; s < 16; ++s) {
        const Vec2f p = Sampler(5, 9, s, 1).point(dimension);
        ASSERT_GE(p.x, 0);
        ASSERT_LT(p.x, 1);
        const uint32_t x = static_cast<uint32_t>(p.x * static_cast<float>(1u << bits));
        const uint32_t y = static_cast<uint32_t>(p.y * static_cast<float>(16u >> bits));
        ++cells[x * (16u >> bits) + y];
      }
      for (const int n : cells) EXPECT_EQ(n, 1);
    }
  }
}

TEST(Tone, inverseGivesTheLightBack) {
  for (const Vec3f& c :
       {Vec3f{0.2f, 0.4f, 0.7f}, Vec3f{0.72f, 0.77f, 0.77f}, Vec3f{0.1f, 0.1f, 0.1f}}) {
    const Vec3f back = toneMapped(inverseToneMapped(c));
    EXPECT_NEAR(back.x, c.x, 1e-3);
    EXPECT_NEAR(back.y, c.y, 1e-3);
    EXPECT_NEAR(back.z, c.z, 1e-3);
  }
}

TEST(World, normalsSurvivePacking) {
  for (int i = 0; i < 200; ++i) {
    const Vec3f n =
        toVec3f({sinDeg(i * 37) * cosDeg(i * 11), sinDeg(i * 11), cosDeg(i * 37) * cosDeg(i * 11)});
    EXPECT_GT(dot(unpackNormal(packNormal(n)), n), 0.999999f);
  }
}

}  // namespace
}  // namespace gable::rt
