// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "city/tag_values.h"

#include <gtest/gtest.h>

#include "base/measure.h"

namespace gable {
namespace {

TEST(TagValues, LengthsAreReadWithTheirUnits) {
  const std::pair<const char*, double> lengths[] = {{"3.5", 3.5},
                                                    {"3.5 m", 3.5},
                                                    {"3.5m", 3.5},
                                                    {" 12 metres ", 12},
                                                    {"3,5", 3.5},
                                                    {"+4", 4},
                                                    {"-2.5 m", -2.5},
                                                    {".5", 0.5},
                                                    {"12'", 3.6576},
                                                    {"12 ft", 3.6576},
                                                    {"12 feet", 3.6576},
                                                    {"12'6\"", 3.81},
                                                    {"12' 6\"", 3.81},
                                                    {"12'6", 3.81},
                                                    {"12 ft 6 in", 3.81},
                                                    {"12\xe2\x80\xb2"
                                                     "6\xe2\x80\xb3",
                                                     3.81},
                                                    {"10\"", 0.254},
                                                    {"250 cm", 2.5},
                                                    {"0.2 km", 200},
                                                    {"1 mi", 1609.344}};
  for (const auto& [text, metres] : lengths) {
    const auto read = writtenMetres(text);
    ASSERT_TRUE(read) << text;
    EXPECT_NEAR(*read, metres, 1e-9) << text;
  }
  for (const char* text :
       {"", " ", "m", "6 floors", "3-5", "4;5", "~15", "3 m 2", "1,200", "1.2.3", "12'13\"",
        "12'6 m", "3 m 6 in", "1e3", "--3", "'", "nan", "0x10", "3,"}) {
    EXPECT_FALSE(writtenMetres(text)) << text;
  }
}

TEST(TagValues, CountsHaveNoUnit) {
  EXPECT_EQ(writtenNumber("5.5"), 5.5);
  EXPECT_EQ(writtenNumber("5,5"), 5.5);
  EXPECT_EQ(writtenNumber("-1"), -1);
  for (const char* text : {"3 m", "12'", "two", "4;5", "2-3", "6 floors"}) {
    EXPECT_FALSE(writtenNumber(text)) << text;
  }
}

TEST(TagValues, RulesGetPlainNumbers) {
  EXPECT_EQ(plainTag("height", "20 ft"), "6.096");
  EXPECT_EQ(plainTag("building:levels", "3,5"), "3.5");
  EXPECT_EQ(plainTag("building:levels", "6 floors"), std::nullopt);
  EXPECT_EQ(plainTag("building:levels", "5000"), std::nullopt);
  EXPECT_EQ(plainTag("height", "-3"), std::nullopt);
  EXPECT_EQ(plainTag("name", "12'"), "12'");
}

MapFeature feature(const std::string& id, const std::string& key, const std::string& value) {
  MapFeature out;
  out.id = id;
  out.tags.emplace_back(key, value);
  return out;
}

TEST(TagValues, WhatIsNoNumberIsCountedByKey) {
  std::vector<MapFeature> features;
  for (int i = 0; i < 9; ++i)
    features.push_back(feature("way/" + std::to_string(i), "height", "tall"));
  features.push_back(feature("way/9", "height", "12 m"));
  features.push_back(feature("way/10", "building:levels", "6 floors"));
  const std::vector<MapDoubt> doubts = doubtsOf(features);
  ASSERT_EQ(doubts.size(), 2u);
  EXPECT_EQ(doubts[0].key, "building:levels");
  EXPECT_EQ(doubts[1].count, 9u);
  EXPECT_EQ(doubts[1].first.size(), 5u);
  EXPECT_EQ(doubts[1].first[0].first, "way/0");
}

TEST(TagValues, NamesThatAreNearlyKnownOnesAreInDoubt) {
  const std::pair<const char*, const char*> slips[] = {{"bulding:levels", "building:levels"},
                                                       {"heigth", "height"},
                                                       {"Height", "height"},
                                                       {"building_levels", "building:levels"},
                                                       {"roof:color", "roof:colour"},
                                                       {"land_use", "landuse"}};
  for (const auto& [key, meant] : slips) {
    const auto doubts = doubtsOf({feature("way/1", key, "3"), feature("way/2", key, "4")});
    ASSERT_EQ(doubts.size(), 1u) << key;
    EXPECT_EQ(doubts[0].meant, meant);
    EXPECT_EQ(doubts[0].count, 2u);
  }
  // Names of their own.
  for (const char* key :
       {"weight", "depth", "max_height", "maxheight", "building:flats", "lines", "level",
        "addr:streetnumber", "building_1", "roof:edge", "name", "a", ""}) {
    EXPECT_TRUE(doubtsOf({feature("way/1", key, "3")}).empty()) << key;
  }
}

}  // namespace
}  // namespace gable
