// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/geo/geo_frames.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(GeoFrames, localMetresLieAboutTheirCentre) {
  const auto frame = localGeoFrame({7.42, 43.73});
  const GeoPlace middle = frame->at({0, 0});
  ASSERT_TRUE(middle.degrees);
  EXPECT_NEAR(middle.degrees->longitude, 7.42, 1e-12);
  EXPECT_NEAR(middle.degrees->latitude, 43.73, 1e-12);
  const GeoPlace north = frame->at({0, 1000});
  EXPECT_EQ(north.y, 1000);
  EXPECT_NEAR(north.degrees->latitude, 43.73 + 1000 / 111103.0, 1e-5);
}

// The zone's middle on the equator has the easting 500000; the false northing of the south.
TEST(GeoFrames, utmHasItsZonesAndScale) {
  const auto north = mapGeoFrame("urn:ogc:def:crs:EPSG::32632", {500000, 0});
  EXPECT_NEAR(north->at({0, 0}).degrees->longitude, 9, 1e-12);
  EXPECT_NEAR(north->at({0, 0}).degrees->latitude, 0, 1e-12);
  const auto south = mapGeoFrame("EPSG:32733", {500000, 1e7});
  EXPECT_NEAR(south->at({0, 0}).degrees->longitude, 15, 1e-12);
  EXPECT_NEAR(south->at({0, 0}).degrees->latitude, 0, 1e-12);
  // 45 degrees north on the middle of a zone: the meridian's 4984944.378 m, scaled.
  const auto middle = mapGeoFrame("EPSG:25832", {500000, 4984944.378 * 0.9996});
  EXPECT_NEAR(middle->at({0, 0}).degrees->latitude, 45, 1e-8);
  EXPECT_EQ(middle->at({3, 4}).x, 500003);
}

TEST(GeoFrames, theWebsMercatorIsASphere) {
  const auto frame = mapGeoFrame("EPSG:3857", {20037508.342789244 / 2, 5621521.486192066});
  EXPECT_NEAR(frame->at({0, 0}).degrees->longitude, 90, 1e-9);
  EXPECT_NEAR(frame->at({0, 0}).degrees->latitude, 45, 1e-9);
}

TEST(GeoFrames, textsMakeEqualFrames) {
  for (const auto& frame : {localGeoFrame({7.123456789012345, -43.1}),
                            mapGeoFrame("EPSG:32632", {500000.25, 1}), mapGeoFrame("", {3, 4})}) {
    const auto again = geoFrameOf(frame->text());
    ASSERT_TRUE(again) << frame->text();
    EXPECT_EQ(again->hash(), frame->hash());
  }
  for (const char* text : {"", "local", "local 1", "map 1 2", "map 1 2 x", "other 1 2 3"}) {
    EXPECT_FALSE(geoFrameOf(text)) << text;
  }
}

TEST(GeoFrames, otherSystemsHaveNoDegrees) {
  for (const char* system : {"EPSG:2056", "EPSG:32661", "", "ESRI:102100", "EPSG:x"}) {
    const GeoPlace p = mapGeoFrame(system, {2600000, 1200000})->at({5, 7});
    EXPECT_FALSE(p.degrees) << system;
    EXPECT_EQ(p.x, 2600005);
    EXPECT_EQ(p.y, 1200007);
  }
}

}  // namespace
}  // namespace gable
