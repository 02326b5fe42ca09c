// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Heights of decks: clear of what passes below, no steeper than allowed, on the ground at their
// ends.

#include "city/bridges.h"

#include <gtest/gtest.h>

#include <cmath>

#include "city/plan.h"

namespace gable {
namespace {

MapFeature way(const std::string& id, std::vector<Vec2> points,
               std::vector<std::pair<std::string, std::string>> tags) {
  MapFeature f;
  f.kind = MapFeature::Kind::Line;
  f.id = id;
  f.points = std::move(points);
  f.tags = std::move(tags);
  return f;
}

// A street over a railway, that goes on to both sides; 100 m to the west, a few metres to the east.
MapFeatures overTheRails(double east) {
  MapFeatures map;
  map.area.include({-200, -100});
  map.area.include({200, 100});
  map.features = {
      way("w", {{-140, 0}, {-40, 0}}, {{"highway", "tertiary"}}),
      way("b", {{-40, 0}, {0, 4}, {40, 0}}, {{"highway", "tertiary"}, {"bridge", "yes"}}),
      way("e", {{40, 0}, {40 + east, 0}}, {{"highway", "tertiary"}}),
      way("r", {{0, -90}, {0, 90}}, {{"railway", "rail"}}),
      way("t", {{-90, 50}, {90, 50}},
          {{"highway", "primary"}, {"tunnel", "yes"}, {"layer", "-1"}})};
  return map;
}

double steepest(const Bridge& b) {
  double most = 0;
  for (size_t i = 1; i < b.line.size(); ++i) {
    const Vec3 d = b.line[i] - b.line[i - 1];
    most = std::max(most, std::fabs(d.z) / length(Vec2{d.x, d.y}));
  }
  return most;
}

TEST(Bridges, WhatTheMapSaysIsNoBridgeIsNone) {
  for (const char* word : {"no", "false", "0", ""}) {
    MapFeatures map = overTheRails(100);
    map.features[1].tags[1].second = word;
    EXPECT_TRUE(bridgesOf(map.features, streetsOf(map.features)).empty()) << word;
  }
}

TEST(Bridges, DecksAreClearOfWhatPassesBelow) {
  const MapFeatures map = overTheRails(100);
  const std::vector<Bridge> bridges = bridgesOf(map.features, streetsOf(map.features));
  ASSERT_EQ(bridges.size(), 3u);
  EXPECT_FALSE(bridges[0].isRamp);
  for (const Vec3& p : bridges[0].line) EXPECT_GE(p.z - bridges[0].thickness, 4.5);
  for (const Bridge& b : bridges) EXPECT_LE(steepest(b), 0.0801);
  for (size_t i = 1; i < 3; ++i) {
    EXPECT_TRUE(bridges[i].isRamp);
    EXPECT_NEAR(bridges[i].line.front().z, 5.6, 1e-9);
    EXPECT_NEAR(bridges[i].line.back().z, 0, 1e-9);
  }
}

TEST(Bridges, ShortRampsKeepTheSlopeAndLowerTheDeck) {
  const MapFeatures map = overTheRails(10);
  const std::vector<Bridge> bridges = bridgesOf(map.features, streetsOf(map.features));
  ASSERT_GE(bridges.size(), 2u);
  for (const Bridge& b : bridges) EXPECT_LE(steepest(b), 0.0801);
  EXPECT_LT(bridges[0].line.back().z, 1);
}

TEST(Bridges, BridgesThatMeetHaveOneHeight) {
  MapFeatures map = overTheRails(100);
  map.features.push_back(
      way("s", {{0, 4}, {0, 80}}, {{"highway", "footway"}, {"bridge", "yes"}, {"layer", "2"}}));
  const std::vector<Bridge> bridges = bridgesOf(map.features, streetsOf(map.features));
  const Bridge* foot = nullptr;
  for (const Bridge& b : bridges) {
    if (map.features[b.feature].id == "s") foot = &b;
  }
  ASSERT_TRUE(foot);
  EXPECT_NEAR(foot->line.front().z, 5.6, 1e-9);
  EXPECT_NEAR(foot->line.back().z, 0, 1e-9);
}

TEST(Bridges, TheGroundBeneathStaysWholeAndPiersStandBesideTracks) {
  const MapFeatures map = overTheRails(100);
  const CityPlan plan = planCity(map, "CZ");
  double sum = 0;
  for (const GroundPiece& p : plan.ground) sum += area(p.polygon);
  EXPECT_NEAR(sum, 400 * 200, 8);
  GroundIndex index(plan.ground);
  size_t decks = 0, piers = 0;
  for (const CityShape& s : plan.shapes) {
    decks += s.rule == "BridgeDeck";
    if (s.rule != "BridgePier") continue;
    ++piers;
    for (const Vec3& p : s.faces[0]) {
      EXPECT_NE(plan.ground[index.pieceAt({p.x, p.y})].surface, Surface::Track);
    }
  }
  EXPECT_EQ(decks, 3u);
  EXPECT_GE(piers, 2u);
}

TEST(Bridges, HostileLinesAreLeftOutOrBuilt) {
  MapFeatures map = overTheRails(100);
  const std::vector<std::pair<std::string, std::string>> tags{
      {"highway", "primary"}, {"bridge", "yes"}, {"layer", "1e9"}};
  map.features.push_back(way("x", {{0, 0}, {1e7, 1e7}, {0, 0}, {1, 1}, {0, 0}}, tags));
  map.features.push_back(way("y", {{5, 5}, {5, 5.001}, {5, 5}}, tags));
  map.features.push_back(way("z", {{40, 0}, {-40, 0}, {40, 0}}, tags));
  const CityPlan plan = planCity(map, "CZ");
  for (const CityShape& s : plan.shapes) {
    for (const auto& face : s.faces) {
      for (const Vec3& p : face) {
        EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
        EXPECT_LE(p.z, 28.1);
      }
    }
  }
}

}  // namespace
}  // namespace gable
