// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/building_kind.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

MapFeature building(std::vector<std::pair<std::string, std::string>> tags) {
  MapFeature f;
  f.kind = MapFeature::Kind::Area;
  f.tags = std::move(tags);
  return f;
}

TEST(BuildingKind, TagsGoFirst) {
  const BuildingSize size{300, 3, 0};
  EXPECT_EQ(buildingKindOf(building({{"building", "chapel"}}), size, {}), "church");
  EXPECT_EQ(buildingKindOf(building({{"building", "warehouse"}}), size, {}), "industrial");
  EXPECT_EQ(buildingKindOf(building({{"building", "garages"}}), size, {}), "garage");
  EXPECT_EQ(buildingKindOf(building({{"building", "yes"}, {"amenity", "school"}}), size, {}),
            "school");
  EXPECT_EQ(buildingKindOf(building({{"building", "yes"}, {"amenity", "townhall"}}), size, {}),
            "public");
  EXPECT_EQ(buildingKindOf(building({{"building", "yes"}, {"historic", "castle"}}), size, {}),
            "public");
}

TEST(BuildingKind, SizeNeighboursAndLandTellTheRest) {
  const MapFeature f = building({{"building", "yes"}});
  EXPECT_EQ(buildingKindOf(f, {12, 0, 0}, {}), "shed");
  EXPECT_EQ(buildingKindOf(f, {120, 2, 0}, {}), "house");
  EXPECT_EQ(buildingKindOf(f, {120, 2, 0.5}, {}), "terrace");
  EXPECT_EQ(buildingKindOf(f, {300, 6, 0.5}, {}), "apartments");
  EXPECT_EQ(buildingKindOf(f, {300, 16, 0}, {}), "tower");
  EXPECT_EQ(buildingKindOf(f, {900, 2, 0}, "industrial"), "industrial");
  EXPECT_EQ(buildingKindOf(f, {30, 1, 0}, "garages"), "garage");
}

TEST(BuildingKind, ColoursHaveOneForm) {
  EXPECT_EQ(colourOfTag("#FDE396"), "#fde396");
  EXPECT_EQ(colourOfTag("#abc"), "#aabbcc");
  EXPECT_EQ(colourOfTag("dark_gray"), "#a9a9a9");
  EXPECT_EQ(colourOfTag("Light-Grey"), "#d3d3d3");
  EXPECT_EQ(colourOfTag("red"), "#ff0000");
  for (const char* none : {"", "#", "#12", "#12345g", "sunset", "red;blue"}) {
    EXPECT_EQ(colourOfTag(none), "") << none;
  }
}

}  // namespace
}  // namespace gable
