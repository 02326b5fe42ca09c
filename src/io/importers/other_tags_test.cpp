// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/other_tags.h"

#include <gtest/gtest.h>

#include "io/importers/map_features.h"

namespace gable {
namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

TEST(OtherTags, pairsAreReadInTheirOrder) {
  const Pairs want{{"building:levels", "5"}, {"roof:shape", "gabled"}};
  EXPECT_EQ(otherTags(R"("building:levels"=>"5","roof:shape"=>"gabled")"), want);
  EXPECT_EQ(otherTags(R"( "building:levels" => "5" , "roof:shape"=>"gabled" )"), want);
  EXPECT_EQ(otherTags(R"("note"=>"a \"b\" \\ c, d=>e","x"=>NULL,"y"=>"")"),
            (Pairs{{"note", R"(a "b" \ c, d=>e)"}}));
}

TEST(OtherTags, whatIsWrittenOtherwiseEndsThem) {
  for (const char* text : {"", "a", "\"", "\"a", "\"a\"", "\"a\"=", "\"a\"=>", "\"a\"=>\"",
                           "\"a\"=>\"b\\", "=>", ",", "\"a\"=>b"}) {
    EXPECT_TRUE(otherTags(text).empty()) << text;
  }
  EXPECT_EQ(otherTags(R"("a"=>"1","b)"), (Pairs{{"a", "1"}}));
  EXPECT_EQ(otherTags(R"("a"=>"1";"b"=>"2")"), (Pairs{{"a", "1"}}));
}

// As ogr2ogr writes buildings of a map of OpenStreetMap; a column of its own comes first.
TEST(OtherTags, featuresOfMapsHaveThem) {
  const std::string text =
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{
    "osm_way_id":"7","building":"yes","height":"9",
    "other_tags":"\"building:levels\"=>\"5\",\"height\"=>\"3\""},
    "geometry":{"type":"Polygon","coordinates":[[[7.4,43.7],[7.4001,43.7],[7.4001,43.7001],[7.4,43.7]]]}}]})";
  auto map = readMapFeatures(text, {"a.geojson", {}, false});
  ASSERT_TRUE(map.ok());
  ASSERT_EQ(map->features.size(), 1u);
  const MapFeature& f = map->features[0];
  EXPECT_EQ(f.id, "7");
  EXPECT_EQ(f.tag("building:levels"), "5");
  EXPECT_EQ(f.tag("height"), "9");
  EXPECT_EQ(f.tag("other_tags"), "");
}

}  // namespace
}  // namespace gable
