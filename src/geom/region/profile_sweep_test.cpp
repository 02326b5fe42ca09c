// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/profile_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geom/mesh/topology.h"
#include "geom/region/corpus.h"

namespace gable {
namespace {

constexpr const char* kNames[] = {"box", "batter", "gable", "round", "dome", "kerb"};

TEST(ProfileSweep, knowsItsCrossSections) {
  for (const char* name : kNames) EXPECT_TRUE(isProfile(*profileNamed(name))) << name;
  EXPECT_FALSE(profileNamed("wave"));
  EXPECT_FALSE(isProfile({{0, 0}, {1, 0}}));
  EXPECT_FALSE(isProfile({{0, 1}, {0.5, 1}}));
  EXPECT_FALSE(isProfile({{0, 1}, {0.6, 1}, {0.4, 1}, {1, 0}}));
  EXPECT_FALSE(isProfile({{0, -1}, {1, 1}}));
}

TEST(ProfileSweep, aRingInTheRegionIsOneShell) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
  const Polyline line{{{1, 1}, {9, 1}, {9, 9}, {1, 9}}, true};
  const Mesh m = sweptProfile(p, line, 1, 2, *profileNamed("box"), RibbonEnds::Butt);
  EXPECT_TRUE(Topology(m).closed());
  EXPECT_NEAR(volume(m), 2 * (81 - 49), 1e-9);
  EXPECT_EQ(m.faceCount(), 16u);
}

TEST(ProfileSweep, squareEndsAreLongerByHalfTheWidth) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
  const Polyline line{{{2, 5}, {8, 5}}, false};
  EXPECT_NEAR(volume(sweptProfile(p, line, 1, 1, *profileNamed("gable"), RibbonEnds::Butt)), 4.8,
              1e-9);
  EXPECT_NEAR(volume(sweptProfile(p, line, 1, 1, *profileNamed("gable"), RibbonEnds::Square)), 5.6,
              1e-9);
}

TEST(ProfileSweep, volumesOnHostileOutlinesAreClosedAndNoLargerThanTheRegion) {
  size_t i = 0;
  const std::vector<corpus::Case> cases = corpus::loadCorpus(40);
  if (cases.empty()) GTEST_SKIP() << "the corpus of hard polygons is not there";
  for (const corpus::Case& c : cases) {
    const Polygon p = corpus::withHoles(c.ring, i);
    const double size = std::sqrt(area(p)), width = size / 15, height = 1;
    const Polyline line = movedLeft({p.outer, true}, i % 3 == 0 ? 0 : width);
    const Mesh m =
        sweptProfile(p, line, width, height, *profileNamed(kNames[i % 6]), RibbonEnds::Butt);
    EXPECT_TRUE(m.faceCount() == 0 || Topology(m).closed()) << i;
    EXPECT_LE(volume(m), area(p) * height * (1 + 1e-6)) << i;
    EXPECT_GE(volume(m), -1e-6 * area(p)) << i;
    ++i;
  }
}

}  // namespace
}  // namespace gable
