// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/hash.h"
#include "io/exporters/city_faces.h"

namespace gable {
namespace {

TopFace face(std::vector<Vec3> ring) { return {{std::move(ring)}}; }
TopFace level(double x, double y, double w, double d, double z) {
  return face({{x, y, z}, {x + w, y, z}, {x + w, y + d, z}, {x, y + d, z}});
}
// Two slopes about a ridge along x.
std::vector<TopFace> gabled(double x, double y, double w, double d, double eaves, double ridge) {
  return {
      face({{x, y, eaves}, {x + w, y, eaves}, {x + w, y + d / 2, ridge}, {x, y + d / 2, ridge}}),
      face({{x, y + d / 2, ridge},
            {x + w, y + d / 2, ridge},
            {x + w, y + d, eaves},
            {x, y + d, eaves}})};
}

// By the divergence theorem, triangles about the first corner of each ring.
double volumeOf(const BuildingShell& s) {
  double sum = 0;
  for (const ShellFace& f : s.faces) {
    for (const auto& ring : f.rings) {
      for (size_t i = 2; i < ring.size(); ++i) {
        sum += dot(s.points[ring[0]], cross(s.points[ring[i - 1]], s.points[ring[i]])) / 6;
      }
    }
  }
  return sum;
}

// What the header promises of a closed shell.
void expectSound(const BuildingShell& s) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const ShellFace& f : s.faces) {
    Vec3 normal;
    for (size_t r = 0; r < f.rings.size(); ++r) {
      std::vector<Vec3> ring;
      for (size_t k = 0; k < f.rings[r].size(); ++k) {
        ring.push_back(s.points[f.rings[r][k]]);
        ++edges[{f.rings[r][k], f.rings[r][(k + 1) % f.rings[r].size()]}];
      }
      if (r == 0) normal = normalized(ringNormal(ring));
      for (const Vec3& p : ring) {
        EXPECT_LT(std::fabs(dot(p - s.points[f.rings[0][0]], normal)), 0.01 + 1e-9);
      }
    }
    const double least = f.kind == CityKind::Roof     ? 0.05
                         : f.kind == CityKind::Ground ? -1.01
                                                      : -1e-6;
    const double most = f.kind == CityKind::Roof ? 1.01 : f.kind == CityKind::Ground ? -0.99 : 1e-6;
    EXPECT_GE(normal.z, least);
    EXPECT_LE(normal.z, most);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST(CityBlocks, aGabledHouseIsOneClosedShell) {
  const auto shells = shellsOf(gabled(0, 0, 10, 8, 5, 8), 0);
  ASSERT_EQ(shells.size(), 1u);
  const BuildingShell& s = shells[0];
  EXPECT_TRUE(s.closed);
  expectSound(s);
  // Two roofs, a ground, two walls below the eaves; each gable wall is one for each roof.
  EXPECT_EQ(s.faces.size(), 9u);
  EXPECT_NEAR(s.area, 80, 1e-6);
  EXPECT_NEAR(s.volume, 80 * 6.5, 1e-3);
  EXPECT_NEAR(volumeOf(s), s.volume, 1e-3);
  const BuildingShell block = blockOf(s);
  EXPECT_TRUE(block.closed);
  expectSound(block);
  EXPECT_EQ(block.faces.size(), 6u);
  EXPECT_NEAR(volumeOf(block), s.volume, 80 * 0.001);
}

TEST(CityBlocks, theTopmostRoofIsSeenAndWallsStandBetweenHeights) {
  // A tower through a hall, whose floor slab below is covered.
  std::vector<TopFace> faces{level(0, 0, 20, 10, 6), level(5, 2, 4, 4, 15), level(0, 0, 20, 10, 3)};
  const auto shells = shellsOf(faces, 0);
  ASSERT_EQ(shells.size(), 1u);
  EXPECT_TRUE(shells[0].closed);
  expectSound(shells[0]);
  EXPECT_NEAR(shells[0].volume, 200 * 6 + 16 * 9, 1e-2);
  EXPECT_EQ(shells[0].faces.size(), 2u + 4 + 4 + 1);
}

TEST(CityBlocks, roofsThatCrossAreCutWhereTheyDo) {
  // A cross of two gabled wings of one height.
  std::vector<TopFace> faces = gabled(0, 6, 20, 8, 5, 9);
  for (const TopFace& f : gabled(0, 0, 20, 8, 5, 9)) {
    TopFace turned = f;
    for (Vec3& p : turned.rings[0]) p = {-p.y + 14, p.x, p.z};
    faces.push_back(turned);
  }
  const auto shells = shellsOf(faces, 0);
  ASSERT_EQ(shells.size(), 1u);
  EXPECT_TRUE(shells[0].closed);
  expectSound(shells[0]);
  // Two prisms less what they share: a pyramid over a block.
  const double prism = 20 * 8 * 7, both = 64 * 5 + 64 * 4 / 3.0;
  EXPECT_NEAR(shells[0].volume, 2 * prism - both, 0.5);
}

TEST(CityBlocks, detailsAndWhatLiesOnTheGroundAreLeftOut) {
  std::vector<TopFace> faces{level(0, 0, 10, 10, 6), level(-0.4, 0, 0.4, 10, 4),
                             level(20, 0, 10, 10, 0.2), level(3, 3, 0.5, 0.5, 8)};
  const auto shells = shellsOf(faces, 0);
  ASSERT_EQ(shells.size(), 1u);
  EXPECT_NEAR(shells[0].volume, 600, 1e-2);
  EXPECT_TRUE(shellsOf({}, 0).empty());
  EXPECT_TRUE(shellsOf(std::vector<TopFace>{face({{0, 0, 0}, {1, 0, 9}, {0, 0, 9}})}, 0).empty());
}

TEST(CityBlocks, courtsAreHoles) {
  std::vector<TopFace> faces{level(0, 0, 20, 5, 6), level(0, 15, 20, 5, 6), level(0, 5, 5, 10, 7),
                             level(15, 5, 5, 10, 7)};
  const auto shells = shellsOf(faces, 1);
  ASSERT_EQ(shells.size(), 1u);
  EXPECT_TRUE(shells[0].closed);
  expectSound(shells[0]);
  EXPECT_EQ(shells[0].faces.back().rings.size(), 2u);
  EXPECT_NEAR(volumeOf(blockOf(shells[0])), shells[0].volume, 0.4);
}

TEST(CityBlocks, outlinesThatTouchThemselvesGetANeck) {
  // A court whose corner is that of the outline, and a balcony that hangs at a corner.
  const std::vector<std::vector<TopFace>> plans{{level(0, 0, 20, 5, 6), level(0, 5, 5, 10, 6),
                                                 level(0, 15, 15, 5, 6), level(15, 5, 5, 10, 6)},
                                                {level(0, 0, 10, 10, 6), level(10, 10, 2, 2, 4),
                                                 level(9, 12, 3, 3, 6), level(9, 10, 1, 2, 5)}};
  for (const std::vector<TopFace>& faces : plans) {
    const auto shells = shellsOf(faces, 0);
    ASSERT_EQ(shells.size(), 1u);
    EXPECT_TRUE(shells[0].closed);
    expectSound(shells[0]);
    double area = 0;
    for (const TopFace& f : faces) area += length(ringNormal(f.rings[0])) / 2;
    EXPECT_NEAR(shells[0].area, area, 0.02);
  }
}

TEST(CityBlocks, anyRoofsMakeSoundShells) {
  int closed = 0, all = 0;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    uint64_t draws = 0;
    const auto draw = [&](double low, double high) {
      const uint64_t h = hashCombine(seed, ++draws);
      return low + (high - low) * static_cast<double>(h >> 11) * 0x1.0p-53;
    };
    std::vector<TopFace> faces;
    for (int i = 0; i < 6; ++i) {
      const double x = draw(0, 20), y = draw(0, 20), w = draw(2, 14), d = draw(2, 14);
      const double eaves = draw(3, 9);
      if (draw(0, 1) < 0.3) faces.push_back(level(x, y, w, d, eaves));
      const double turn = draw(0, 1) < 0.5 ? 0 : draw(0, 1.5);
      for (TopFace f : gabled(x, y, w, d, eaves, eaves + draw(1, 5))) {
        for (Vec3& p : f.rings[0]) {
          p = {p.x * (1 - turn * turn / 3) - p.y * turn, p.x * turn + p.y * (1 - turn * turn / 3),
               p.z};
        }
        faces.push_back(f);
      }
    }
    for (const BuildingShell& s : shellsOf(faces, 0)) {
      ++all;
      if (!s.closed) continue;
      ++closed;
      expectSound(s);
      EXPECT_NEAR(volumeOf(s), s.volume, 0.002 * s.volume + 0.5) << seed;
    }
  }
  EXPECT_GE(all, 60);
  EXPECT_GE(closed, all - 1);
}

}  // namespace
}  // namespace gable
