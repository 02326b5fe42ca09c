// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/tracer.h"

#include <gtest/gtest.h>

#include "base/work.h"
#include "render/sampler.h"
#include "render/test_scenes.h"

namespace gable::rt {
namespace {

/// How many of a million rays get out of what is closed about `middle`.
int lost(const Scene& scene, const Vec3& middle) {
  const World world = makeWorld(scene, nullptr);
  const Tracer tracer(world);
  int count = 0;
  for (uint32_t i = 0; i < 1'000'000; ++i) {
    const Sampler numbers(1, 2, i, 3);
    Ray ray;
    ray.origin = toVec3f(middle - world.origin);
    const Vec3f side{0, numbers.number(1) < 0.5f ? -1.0f : 1.0f, 0};
    ray.direction = cosineDirection(side, numbers.point(2));
    Hit hit;
    count += !tracer.intersect(ray, hit);
  }
  return count;
}

TEST(Tracer, almostNoRayGetsOutOfWhatIsClosed) {
  // The first leaf is where the coordinates of rays begin: far from what is closed.
  SceneMaker ball, room;
  for (SceneMaker* m : {&ball, &room}) m->box({-700, 0, 400}, {1, 1, 1}, m->material("#ffffff"));
  ball.mesh(ballMesh(), ball.material("#ffffff"));
  room.box({-3, -1, -2}, {6, 2.7, 5}, room.material("#ffffff"));
  EXPECT_LE(lost(ball.finish(), {0.1, 0.2, 0.3}), 3);
  EXPECT_LE(lost(room.finish(), {0.1, 0.2, 0.3}), 3);
}

/// More triangles than one thread builds a structure of.
World largeWorld() {
  SceneMaker m;
  const auto grey = m.material("#808080");
  for (int i = 0; i < 22'000; ++i) {
    m.box({1.5 * (i % 150), 0, 1.5 * (i / 150)}, {1, 1 + 0.1 * (i % 7), 1}, grey);
  }
  return makeWorld(m.finish(), nullptr);
}

TEST(Tracer, severalBuildersMakeTheSameOfALargeWorld) {
  const World world = largeWorld();
  ASSERT_GT(world.triangles, 250'000u);
  const Tracer tracer(world), again(world);
  for (uint32_t i = 0; i < 20'000; ++i) {
    const Sampler numbers(1, 2, i, 3);
    Ray ray;
    ray.origin = toVec3f(world.bounds.center() + Vec3{0, 20, 0});
    ray.direction = cosineDirection({0, -1, 0}, numbers.point(1));
    Hit hit, other;
    ASSERT_EQ(tracer.intersect(ray, hit), again.intersect(ray, other));
    EXPECT_EQ(hit.triangle, other.triangle);
    EXPECT_EQ(hit.distance, other.distance);
  }
}

/// Says stop at once.
class StopNow final : public WorkMeter {
 public:
  bool look(uint64_t, uint64_t) override { return false; }
  bool lookAside(uint64_t) override { return false; }
};

TEST(Tracer, aMeterStopsSeveralBuilders) {
  const World world = largeWorld();
  StopNow meter;
  const WorkScope scope(meter);
  const Status built = guarded([&] {
    const Tracer tracer(world);
    return Status();
  });
  EXPECT_STREQ(built.code(), kWorkStopped);
}

}  // namespace
}  // namespace gable::rt
