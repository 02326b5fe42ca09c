// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plan/parcels.h"

#include <gtest/gtest.h>

#include "geom/plan/street_growth.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "geom/region/hull.h"

namespace gable {
namespace {

using Divide = std::vector<Parcel> (*)(const Polygon&, const std::vector<bool>&,
                                       const ParcelOptions&);

ParcelOptions optionsFor(const Polygon& block) {
  ParcelOptions o;
  o.targetArea = area(block) / 12;
  o.minArea = area(block) / 60;
  o.minWidth = std::sqrt(area(block)) / 12;
  o.minFrontage = o.minWidth / 2;
  return o;
}

void expectSound(const Polygon& block, const std::vector<Parcel>& parcels, const ParcelOptions& o,
                 double tolerance) {
  double sum = 0;
  for (const Parcel& p : parcels) {
    EXPECT_TRUE(isValid(p.polygon));
    sum += area(p.polygon);
    if (parcels.size() == 1) continue;
    EXPECT_GE(p.frontage, o.minFrontage * (1 - 1e-9));
    EXPECT_GE(area(p.polygon), o.minArea * (1 - 1e-9));
    const OrientedRect box = smallestRect(p.polygon.outer);
    EXPECT_GE(std::min(box.width, box.height), o.minWidth * (1 - 1e-9));
  }
  EXPECT_NEAR(sum, area(block), tolerance * (1 + area(block)));
}

class Parcels : public testing::TestWithParam<Divide> {};

TEST_P(Parcels, makeUpAnyBlock) {
  const auto corpus = corpus::loadCorpus(GetParam() == &parcelsByBox ? 4 : 20);
  if (corpus.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  size_t divided = 0;
  for (const corpus::Case& c : corpus) {
    Polygon block{c.ring, {}};
    orient(block);
    const ParcelOptions o = optionsFor(block);
    const auto parcels = GetParam()(block, {}, o);
    expectSound(block, parcels, o, 1e-6);
    if (parcels.size() > 3) ++divided;
  }
  EXPECT_GT(divided, corpus.size() / 2);
}

TEST_P(Parcels, ofARectangleLieInTwoRows) {
  const Polygon block{{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, {}};
  ParcelOptions o;
  o.targetArea = 400;
  o.irregularity = 0;
  const auto parcels = GetParam()(block, {}, o);
  expectSound(block, parcels, o, 1e-9);
  EXPECT_GE(parcels.size(), 8u);
  EXPECT_LE(parcels.size(), 16u);
  size_t corners = 0;
  for (const Parcel& p : parcels) corners += p.corner;
  EXPECT_EQ(corners, 4u);
}

TEST_P(Parcels, areEqualForEqualInput) {
  const Polygon block{{{0, 0}, {90, 5}, {80, 60}, {40, 40}, {-5, 70}}, {}};
  ParcelOptions o;
  o.targetArea = 250;
  o.address = 42;
  const auto a = GetParam()(block, {}, o), b = GetParam()(block, {}, o);
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].polygon.outer, b[i].polygon.outer);
}

TEST_P(Parcels, keepToTheSidesThatHaveAStreet) {
  const Polygon block{{{0, 0}, {100, 0}, {100, 30}, {0, 30}}, {}};
  ParcelOptions o;
  o.targetArea = 300;
  const auto parcels = GetParam()(block, {true, false, false, false}, o);
  expectSound(block, parcels, o, 1e-9);
  EXPECT_GE(parcels.size(), 6u);
  for (const Parcel& p : parcels) EXPECT_FALSE(p.corner);
}

// Every lot of a town has its street, its area and its width, whatever the seed; each block has
// lots at corners, and no sliver is left beside them.
TEST_P(Parcels, ofGrownStreetsAreAllFit) {
  size_t lots = 0, corners = 0, blocks = 0;
  for (uint64_t seed = 0; seed < 6; ++seed) {
    const Region area{{{{0, 0}, {420, 0}, {400, 380}, {150, 420}, {0, 300}}, {}}};
    DirectionField field;
    field.addGrid({200, 200}, 12 * static_cast<double>(seed), 0);
    field.addRadial({150, 180}, 120);
    field.setNoise(20, 150, seed);
    FieldStreets grown;
    grown.spacing = 75;
    grown.mainSpacing = 200;
    grown.address = seed;
    const auto graph = buildStreetGraph(fieldStreets(area, field, grown), {2, 30, &area});
    ParcelOptions o;
    o.targetArea = 320;
    o.minArea = 120;
    o.minWidth = 7;
    o.minFrontage = 5;
    o.address = seed;
    for (const Polygon& block : planStreets(graph, area, 4, 400).blocks) {
      const auto parcels = GetParam()(block, {}, o);
      expectSound(block, parcels, o, 1e-6);
      ++blocks;
      lots += parcels.size();
      for (const Parcel& p : parcels) corners += p.corner;
    }
  }
  EXPECT_GT(blocks, 60u);
  EXPECT_GT(lots, 6 * blocks);
  EXPECT_GT(corners, 2 * blocks);
}

TEST_P(Parcels, areTheBlockItselfWhereItIsSmall) {
  const Polygon block{{{0, 0}, {8, 0}, {8, 9}, {0, 9}}, {}};
  const auto parcels = GetParam()(block, {}, {});
  ASSERT_EQ(parcels.size(), 1u);
  EXPECT_NEAR(area(parcels[0].polygon), 72, 1e-9);
}

TEST_P(Parcels, goRoundACourt) {
  Polygon block{{{0, 0}, {80, 0}, {80, 60}, {0, 60}}, {{{30, 20}, {30, 40}, {50, 40}, {50, 20}}}};
  orient(block);
  ParcelOptions o;
  o.targetArea = 350;
  expectSound(block, GetParam()(block, {}, o), o, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Both, Parcels, testing::Values(&parcelsByBox, &parcelsBySkeleton),
                         [](const auto& each) {
                           return each.param == &parcelsByBox ? "ByBox" : "BySkeleton";
                         });

}  // namespace
}  // namespace gable
