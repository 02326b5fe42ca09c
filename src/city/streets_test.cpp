// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "city/streets.h"

#include <gtest/gtest.h>

#include "city/coast.h"
#include "city/ribbon.h"
#include "geom/region/boolean.h"

namespace gable {
namespace {

MapFeature street(std::vector<Vec2> points, std::vector<std::pair<std::string, std::string>> tags) {
  MapFeature f;
  f.kind = MapFeature::Kind::Line;
  f.points = std::move(points);
  f.tags = std::move(tags);
  return f;
}

TEST(StreetProfile, TagsGoBeforeWhatIsUsual) {
  const auto width = [](std::vector<std::pair<std::string, std::string>> tags) {
    const auto p = streetProfileOf(street({{0, 0}, {9, 0}}, std::move(tags)));
    return p ? p->width : 0;
  };
  EXPECT_EQ(width({{"highway", "residential"}}), 6);
  EXPECT_EQ(width({{"highway", "residential"}, {"lanes", "3"}}), 9);
  EXPECT_EQ(width({{"highway", "residential"}, {"width", "7.5 m"}}), 7.5);
  EXPECT_EQ(width({{"highway", "residential"}, {"width", "wide"}}), 6);
  EXPECT_EQ(width({{"highway", "residential"}, {"width", "1e9"}}), 6);
  EXPECT_EQ(width({{"highway", "primary"}, {"tunnel", "yes"}}), 0);
  EXPECT_EQ(width({{"highway", "primary"}, {"layer", "1"}}), 0);
  EXPECT_EQ(width({{"highway", "footway"}}), 0);
}

TEST(StreetProfile, SidewalksAreOnTheSidesThatTheMapNames) {
  const auto walks = [](std::vector<std::pair<std::string, std::string>> tags) {
    tags.emplace_back("highway", "residential");
    const auto p = streetProfileOf(street({{0, 0}, {9, 0}}, std::move(tags)));
    return std::pair(p->leftWalk > 0, p->rightWalk > 0);
  };
  EXPECT_EQ(walks({}), std::pair(true, true));
  EXPECT_EQ(walks({{"sidewalk", "left"}}), std::pair(true, false));
  EXPECT_EQ(walks({{"sidewalk", "no"}}), std::pair(false, false));
  EXPECT_EQ(walks({{"sidewalk:both", "no"}, {"sidewalk:right", "yes"}}), std::pair(false, true));
}

TEST(Streets, WaysOfOneProfileAreOneStretch) {
  const Streets s = streetsOf({street({{0, 0}, {50, 0}}, {{"highway", "residential"}}),
                               street({{50, 0}, {100, 5}}, {{"highway", "residential"}})});
  ASSERT_EQ(s.stretches.size(), 1u);
  EXPECT_EQ(s.stretches[0].line.size(), 3u);
  EXPECT_TRUE(s.junctions.empty());
}

TEST(Streets, WhereThreeMeetIsAJunction) {
  const Streets s = streetsOf({street({{-60, 0}, {0, 0}, {60, 0}}, {{"highway", "residential"}}),
                               street({{0, 0}, {0, 50}}, {{"highway", "residential"}})});
  ASSERT_EQ(s.stretches.size(), 3u);
  ASSERT_EQ(s.junctions.size(), 1u);
  // Carriageways and junction leave nothing between them.
  std::vector<Ring> rings = s.junctions[0].outline;
  double sum = area(repaired(rings, FillRule::NonZero));
  for (const Stretch& stretch : s.stretches) {
    sum += area(repaired(stretch.carriageway, FillRule::Positive));
    rings.insert(rings.end(), stretch.carriageway.begin(), stretch.carriageway.end());
  }
  const Region all = repaired(rings, FillRule::Positive);
  EXPECT_EQ(all.size(), 1u);
  EXPECT_NEAR(area(all), sum, 0.5);
  // The kerbs are rounded: more than the two ribbons.
  EXPECT_GT(area(all), 120 * 6 + 47 * 6 + 1);
}

TEST(Streets, DoublesAndHostileWaysDoNoHarm) {
  std::vector<MapFeature> features;
  for (const char* kind : {"service", "primary", "residential"}) {
    features.push_back(street({{0, 0}, {50, 0}, {100, 0}}, {{"highway", kind}}));
  }
  features.push_back(street({{100, 0}, {50, 0}}, {{"highway", "service"}}));
  // To and fro, a loop, a figure of eight.
  features.push_back(street({{0, 50}, {50, 50}, {0, 50}, {50, 50}}, {{"highway", "service"}}));
  features.push_back(street({{0, 90}, {9, 90}, {9, 99}, {0, 90}}, {{"highway", "service"}}));
  features.push_back(
      street({{60, 60}, {90, 90}, {90, 60}, {60, 90}, {60, 60}}, {{"highway", "road"}}));
  const Streets s = streetsOf(features);
  double longest = 0;
  for (const Stretch& stretch : s.stretches) {
    if (stretch.line[0].y == 0) {
      EXPECT_EQ(stretch.feature, 1u);
    }
    longest = std::max(longest, lineLength(stretch.line));
  }
  EXPECT_NEAR(longest, 144.85, 0.01);
}

TEST(Ribbon, BendsAreCoveredOnBothSides) {
  const std::vector<Vec2> zigzag{{0, 0}, {20, 0}, {2, 1}, {22, 2}, {22, 30}};
  const Region r = repaired({ribbonAlong(zigzag, 2, 3)}, FillRule::Positive);
  for (size_t i = 0; i + 1 < zigzag.size(); ++i) {
    const Vec2 middle = (zigzag[i] + zigzag[i + 1]) * 0.5;
    const bool covered =
        std::any_of(r.begin(), r.end(), [&](const Polygon& p) { return contains(p, middle); });
    EXPECT_TRUE(covered) << i;
  }
}

TEST(Coast, TheWaterIsOnTheRight) {
  Box2 area;
  area.include({0, 0});
  area.include({100, 100});
  const auto sea = [&](const std::vector<std::vector<Vec2>>& lines) {
    double sum = 0;
    for (const Polygon& p : repaired(seaOf(lines, area), FillRule::EvenOdd)) sum += gable::area(p);
    return sum;
  };
  EXPECT_EQ(sea({}), 0);
  // From south to north in two ways, the water in the east.
  EXPECT_NEAR(sea({{{70, 40}, {70, 120}}, {{70, -20}, {70, 40}}}), 3000, 1e-6);
  EXPECT_NEAR(sea({{{70, 120}, {70, -20}}}), 7000, 1e-6);
  // An end within the area is led to its border.
  EXPECT_NEAR(sea({{{70, 2}, {70, 120}}}), 3000, 1e-6);
  // An island, alone and off the coast; a lagoon.
  const std::vector<Vec2> island{{80, 40}, {90, 40}, {90, 50}, {80, 50}, {80, 40}};
  const std::vector<Vec2> lagoon(island.rbegin(), island.rend());
  EXPECT_NEAR(sea({island}), 9900, 1e-6);
  EXPECT_NEAR(sea({lagoon}), 100, 1e-6);
  EXPECT_NEAR(sea({{{70, -20}, {70, 120}}, island}), 2900, 1e-6);
  // A bay: two places where the coast comes in.
  EXPECT_NEAR(sea({{{-9, 60}, {50, 60}, {50, 40}, {-9, 40}}}), 1000, 1e-6);
}

}  // namespace
}  // namespace gable
