// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plant/limb.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geom/mesh/topology.h"

namespace gable {
namespace {

LimbOptions tree() {
  LimbOptions o;
  o.length = 10;
  o.width = 0.5;
  LimbLevel stem, bough, twig;
  stem.boughs = 12;
  bough.boughs = 5;
  o.levels = {stem, bough, twig};
  o.leaf.count = 4;
  o.seed = 7;
  return o;
}

Mesh skinOf(const LimbSystem& s) {
  MeshBuilder b;
  for (const Limb& limb : s.limbs) addSkin(b, limb);
  return b.take();
}

TEST(Limb, growsAsManyAsAreCounted) {
  const LimbOptions o = tree();
  const LimbSystem s = growLimbs(o);
  EXPECT_EQ(s.limbs.size(), 73u);
  EXPECT_EQ(s.leaves.size(), 240u);
  EXPECT_EQ(limbCounts(o).limbs, 73);
  EXPECT_EQ(limbCounts(o).leaves, 240);
}

TEST(Limb, skinsAreClosedAndLookOutward) {
  for (const double flare : {0.0, 1.0}) {
    LimbOptions o = tree();
    o.flare = flare;
    o.sides = 12;
    for (const Limb& limb : growLimbs(o).limbs) {
      MeshBuilder b;
      addSkin(b, limb);
      const Mesh m = b.take();
      ASSERT_TRUE(m.valid());
      EXPECT_TRUE(Topology(m).closed());
      double volume = 0;
      for (size_t f = 0; f < m.faceCount(); ++f) {
        const MeshLoop loop = m.loopsOf(f)[0];
        volume += dot(m.areaNormal(f), m.at(loop.firstCorner));
      }
      EXPECT_GT(volume, 0);
    }
  }
}

TEST(Limb, boughsBeginInsideTheLimbThatCarriesThem) {
  const LimbSystem s = growLimbs(tree());
  const Limb& stem = s.limbs[0];
  for (const Limb& limb : s.limbs) {
    if (limb.level != 1) continue;
    const Vec3 foot = limb.rings[0].at;
    double nearest = 1e9, radius = 0;
    for (size_t i = 1; i < stem.rings.size(); ++i) {
      const Vec3 a = stem.rings[i - 1].at, d = stem.rings[i].at - a;
      const double t = std::fmin(1, std::fmax(0, dot(foot - a, d) / dot(d, d)));
      const double far = length(foot - (a + d * t));
      if (far >= nearest) continue;
      nearest = far;
      radius = stem.rings[i].radius;
    }
    EXPECT_LT(nearest, 0.2 * radius);
  }
}

TEST(Limb, tapersAboveItsCollar) {
  for (const Limb& limb : growLimbs(tree()).limbs) {
    for (size_t i = 3; i < limb.rings.size(); ++i) {
      EXPECT_LE(limb.rings[i].radius, limb.rings[i - 1].radius + 1e-12);
    }
    for (const Limb::Ring& r : limb.rings) {
      EXPECT_NEAR(length(r.along), 1, 1e-9);
      EXPECT_NEAR(dot(r.along, r.aside), 0, 1e-9);
    }
  }
}

TEST(Limb, aCutOffStemGoesOnInItsLastBough) {
  LimbOptions o = tree();
  o.levels[0].tip = 0.5;
  const LimbSystem s = growLimbs(o);
  const Limb::Ring& end = s.limbs[0].rings.back();
  double best = 0;
  for (const Limb& limb : s.limbs) {
    if (limb.level == 1 && length(limb.rings[0].at - end.at) < 1e-9) {
      best = std::fmax(best, limb.rings[0].radius);
    }
  }
  EXPECT_NEAR(best, end.radius, 1e-12);
}

TEST(Limb, risesAndHangs) {
  LimbOptions o = tree();
  o.levels[1].wander = 0;
  const auto endHeight = [&](double rise) {
    o.levels[1].rise = rise;
    double sum = 0;
    for (const Limb& limb : growLimbs(o).limbs) {
      if (limb.level == 1) sum += limb.rings.back().at.y - limb.rings.front().at.y;
    }
    return sum;
  };
  const double level = endHeight(0), up = endHeight(0.8), down = endHeight(-0.8);
  EXPECT_GT(up, level + 1);
  EXPECT_LT(down, level - 1);
}

TEST(Limb, flatLeavesOfALevelBoughLieLevel) {
  LimbOptions o = tree();
  o.levels.resize(2);
  o.levels[0].angle = o.levels[0].topAngle = 90;
  o.levels[0].wander = o.levels[1].wander = 0;
  o.levels[1].boughs = 0;
  const auto steepest = [&](double flat) {
    o.leaf = {50, 0.1, 0.1, 0.1, 60, 0, flat, 0, 1};
    double most = 0;
    for (const LeafPlace& leaf : growLimbs(o).leaves) {
      EXPECT_NEAR(length(leaf.frame.y), 1, 1e-9);
      EXPECT_NEAR(dot(leaf.frame.y, leaf.frame.z), 0, 1e-9);
      most = std::fmax(most, std::fabs(leaf.frame.y.y));
    }
    return most;
  };
  EXPECT_GT(steepest(0), 0.5);
  // Boughs leave by up to a sixth more or less than the angle that is asked for.
  EXPECT_LT(steepest(1), 0.3);
}

TEST(Limb, equalOptionsMakeEqualLimbs) {
  EXPECT_EQ(skinOf(growLimbs(tree())).contentHash(), skinOf(growLimbs(tree())).contentHash());
  LimbOptions other = tree();
  other.seed = 8;
  EXPECT_NE(skinOf(growLimbs(tree())).contentHash(), skinOf(growLimbs(other)).contentHash());
}

TEST(Limb, extremesStayFinite) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    for (const double angle : {0.0, 180.0}) {
      for (const double rise : {-1.0, 1.0}) {
        LimbOptions o = tree();
        o.length *= size;
        o.width *= size;
        for (LimbLevel& level : o.levels) {
          level.angle = level.topAngle = angle;
          level.rise = rise;
          level.flat = 1;
          level.wander = 90;
          level.from = 1;
        }
        const LimbSystem s = growLimbs(o);
        EXPECT_TRUE(skinOf(s).valid());
        MeshBuilder b;
        for (const LeafPlace& leaf : s.leaves) addLeaf(b, leaf, o.leaf);
        EXPECT_TRUE(b.take().valid());
      }
    }
  }
}

}  // namespace
}  // namespace gable
