// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "render/integrator.h"
#include "render/sampler.h"
#include "render/test_scenes.h"

namespace gable::rt {
namespace {

/// Boxes of stone and one of glass on a plain, with a lamp.
Scene boxes() {
  SceneMaker m;
  const uint32_t stone = m.material("#c0b8a8"), glass = m.material("#80a0a0", 0.05);
  Material glow;
  glow.emissive = {1, 1, 1};
  const uint32_t lamp = m.material(glow);
  for (int i = 0; i < 4; ++i)
    m.box({3.0 * i - 6, 0, -1.0 * i}, {2, 3.0 + i, 2}, i == 2 ? glass : stone);
  m.box({-1, 0, 3}, {0.3, 2, 0.3}, lamp);
  return m.finish();
}

struct Set {
  Scene scene;
  World world = makeWorld(scene, nullptr);
  Tracer tracer{world};
  RenderOptions options;
  Light light;
  Emitters emitters;
  Stage stage;

  explicit Set(Scene s = boxes(), double sunElevation = 38)
      : scene(std::move(s)),
        light(options, sunElevation, 225),
        emitters(world,
                 [](const SurfaceMaterial& m, const Vec3f&, const Vec3f&) { return m.emissive; }),
        stage{world, tracer, light, emitters} {
    stage.groundHeight = static_cast<float>(world.footHeight);
    stage.haze = 1e-3f;
  }

  std::vector<PathStart> starts(size_t count) const {
    std::vector<PathStart> all(count);
    for (uint32_t i = 0; i < count; ++i) {
      const float across = static_cast<float>(i % 4) / 4 - 0.4f;
      const float up = 0.25f - static_cast<float>(i / 4) / 8;
      all[i].ray.origin = {0, 2, 20};
      all[i].ray.direction = normalized(Vec3f{across, up, -1});
      all[i].x = i;
      all[i].y = 7;
      all[i].sample = i % 3;
    }
    return all;
  }
};

void expectNear(const Vec3f& a, const Vec3f& b) {
  EXPECT_NEAR(a.x, b.x, 1e-3f * (1 + std::abs(b.x)));
  EXPECT_NEAR(a.y, b.y, 1e-3f * (1 + std::abs(b.y)));
  EXPECT_NEAR(a.z, b.z, 1e-3f * (1 + std::abs(b.z)));
}

void expectAsAlone(const Set& set, bool brief) {
  for (const size_t count : {size_t{1}, size_t{5}, Tracer::kMostTogether}) {
    const std::vector<PathStart> starts = set.starts(count);
    std::vector<PathResult> results(count);
    traceTogether(set.stage, starts, 3, brief, results.data());
    for (size_t i = 0; i < count; ++i) {
      const PathStart& s = starts[i];
      const PathResult alone = tracePath(set.stage, s.ray, s.x, s.y, s.sample, 3, brief);
      expectNear(results[i].direct, alone.direct);
      expectNear(results[i].sun, alone.sun);
      expectNear(results[i].indirect, alone.indirect);
      expectNear(results[i].albedo, alone.albedo);
      expectNear(results[i].normal, alone.normal);
      EXPECT_NEAR(results[i].distance, alone.distance, 1e-3);
    }
  }
}

TEST(Together, pathsAreAsTheyAreAlone) { expectAsAlone(Set(), false); }

TEST(Together, briefPathsAreAsTheyAreAlone) { expectAsAlone(Set(), true); }

TEST(Together, withoutBouncesPathsAreAsTheyAreAlone) {
  Set set;
  set.stage.bounces = 0;
  expectAsAlone(set, false);
}

/// A black plate that mirrors a lamp above it.
Scene plateUnderLamp() {
  SceneMaker m;
  Material glow;
  glow.color = {0, 0, 0};
  glow.emissive = {1, 1, 1};
  m.box({-9, 0, -9}, {18, 0.1, 18}, m.material("#000000", 0.2));
  m.box({-2, 3, -2}, {4, 0.5, 4}, m.material(glow));
  return m.finish();
}

/// Calls `look` with paths to the plate.
template <class Look>
void lookAtPlate(Set& set, Look&& look) {
  set.stage.ground = false;
  Ray ray;
  ray.origin = toVec3f(Vec3{0, 2, 8} - set.world.origin);
  ray.direction = normalized(Vec3f{0, -0.6f, -1});
  for (uint32_t sample = 0; sample < 64; ++sample) {
    look(tracePath(set.stage, ray, 3, 4, sample, 1));
  }
}

// Else its highlight would be added to the lamp's picture in it, as single specks: few of the
// points on a lamp that are drawn lie where a narrow coat mirrors them.
TEST(Lamps, areFoundByTheMirrorsThatShowThem) {
  Set set(plateUnderLamp());
  Vec3f direct, indirect;
  lookAtPlate(set, [&](const PathResult& path) {
    direct += path.direct;
    indirect += path.indirect;
  });
  EXPECT_GT(luminance(direct), 0);
  EXPECT_EQ(luminance(indirect), 0);
}

TEST(Lamps, areNoSpecksInMirrorsThatBlurThem) {
  // At night, when lamps outshine white.
  Set set(plateUnderLamp(), -9);
  float most = 0;
  lookAtPlate(set, [&](const PathResult& path) {
    most = std::max(most, luminance(path.direct) * set.light.exposure);
  });
  EXPECT_GT(most, 0.04f);
  EXPECT_LT(most, 0.15f) << "of white";
}

}  // namespace
}  // namespace gable::rt
