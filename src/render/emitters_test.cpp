// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/emitters.h"

#include <gtest/gtest.h>

#include "render/sampler.h"
#include "render/test_scenes.h"

namespace gable::rt {
namespace {

/// A row of lamps above a street: closed boxes on posts that are left out.
Scene lampRow() {
  SceneMaker m;
  Material glow;
  glow.emissive = {1, 1, 1};
  const uint32_t shining = m.material(glow);
  for (int i = 0; i < 30; ++i) m.box({15.0 * i, 4, 0}, {0.3, 0.4, 0.3}, shining);
  return m.finish();
}

class EmitterRow : public testing::Test {
 protected:
  const Scene scene = lampRow();
  const World world = makeWorld(scene, nullptr);
  const Emitters emitters{
      world, [](const SurfaceMaterial& m, const Vec3f&, const Vec3f&) { return m.emissive; }};
  /// On the street, between two lamps.
  const Vec3f at = toVec3f(Vec3{203, 0, 3} - world.origin), up{0, 1, 0};

  /// What an emitting point gives to the surface, by its area.
  float given(const Vec3f& point, const Vec3f& facet) const {
    const Vec3f to = point - at;
    const float squared = dot(to, to);
    return std::max(0.0f, dot(up, to)) * std::abs(dot(facet, to)) / (squared * squared);
  }

  template <class Look>
  void drawMany(Look&& look) const {
    for (uint32_t i = 0; i < kDraws; ++i) {
      const Sampler numbers(3, 4, i, 5);
      EmitterSample lamp;
      ASSERT_TRUE(emitters.sample(at, up, numbers.number(1), numbers.point(2), lamp));
      look(lamp);
    }
  }

  static constexpr uint32_t kDraws = 4096;
};

TEST_F(EmitterRow, areDrawnWhereTheyFaceTheSurface) {
  uint32_t facing = 0;
  drawMany([&](const EmitterSample& lamp) { facing += dot(lamp.facet, at - lamp.point) > 0; });
  // Half of the area of a closed body looks away.
  EXPECT_GT(facing, kDraws * 3 / 4);
}

// Both sides of each facet shine, however seldom some are drawn.
TEST_F(EmitterRow, giveTheSumOfAllThatShines) {
  double drawn = 0;
  drawMany([&](const EmitterSample& lamp) {
    drawn += static_cast<double>(given(lamp.point, lamp.facet) / lamp.density) / kDraws;
  });
  double sum = 0;
  const TriangleSet& set = world.parts[0].solid;
  ASSERT_EQ(set.triangles.size(), emitters.size());
  for (const auto& [corners, material, piece, attributes] : set.triangles) {
    const Vec3f a = set.positions[corners[0]], ab = set.positions[corners[1]] - a,
                ac = set.positions[corners[2]] - a;
    const Vec3f across = cross(ab, ac);
    sum += static_cast<double>(given(a + (ab + ac) * (1.0f / 3), normalized(across)) *
                               length(across) / 2);
  }
  EXPECT_NEAR(drawn / sum, 1, 0.03);
}

}  // namespace
}  // namespace gable::rt
