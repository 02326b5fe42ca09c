// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Heights of small files that are made here, right and wrong.
#include "io/geo/height_raster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/geo/geo_frames.h"
#include "io/geo/height_field.h"
#include "io/testing/tiff_sample.h"

namespace gable {
namespace {

GeoPlace degrees(double longitude, double latitude) {
  return {0, 0, GeoPlace::Degrees{longitude, latitude}};
}

// Ten by eight areas of a thousandth of a degree, 100 + column + 10 row.
TiffSample sample() {
  TiffSample s;
  s.width = 10;
  s.height = 8;
  for (int r = 0; r < 8; ++r) {
    for (int c = 0; c < 10; ++c) s.values.push_back(100 + c + 10 * r);
  }
  s.pixelScale = {0.001, 0.001, 0};
  s.tiepoints = {0, 0, 0, 7.4, 43.8, 0};
  s.geoKeys = {1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326};
  return s;
}

double heightAt(const HeightRaster& r, const GeoPlace& place) {
  const auto cell = r.cellAt(place);
  return cell ? r.heightAt(*cell).value_or(std::nan("")) : std::nan("");
}

TEST(HeightRaster, ReadsFloatsAndWholeNumbersInStripsAndTiles) {
  for (const auto kind : {TiffSample::Kind::Float, TiffSample::Kind::Int16}) {
    for (const bool tiled : {false, true}) {
      TiffSample s = sample();
      s.kind = kind;
      s.tiled = tiled;
      Result<HeightRaster> r = HeightRaster::read(tiffOf(s), "a.tif");
      ASSERT_TRUE(r.ok()) << r.error().message;
      // Areas: the middle of the first is half a cell from the corner.
      EXPECT_NEAR(heightAt(*r, degrees(7.4005, 43.7995)), 100, 1e-6);
      EXPECT_NEAR(heightAt(*r, degrees(7.4035, 43.7975)), 123, 1e-6);
      EXPECT_NEAR(heightAt(*r, degrees(7.4040, 43.7970)), 128.5, 1e-6);
      EXPECT_TRUE(std::isnan(heightAt(*r, degrees(7.3, 43.7975))));
    }
  }
}

TEST(HeightRaster, PointsLieOnTheirCorners) {
  TiffSample s = sample();
  s.geoKeys[11] = 2;
  Result<HeightRaster> r = HeightRaster::read(tiffOf(s), "a.tif");
  ASSERT_TRUE(r.ok());
  EXPECT_NEAR(heightAt(*r, degrees(7.403, 43.798)), 123, 1e-6);
}

TEST(HeightRaster, KnowsUtmOfBothHalves) {
  for (const bool south : {false, true}) {
    TiffSample s = sample();
    const LonLat corner{9.2, south ? -40.0 : 40.0};
    const TransverseMercator zone({9, 0});
    const Vec2 at = zone.forward(corner) * 0.9996 + Vec2{5e5, south ? 1e7 : 0};
    s.pixelScale = {30, 30, 0};
    s.tiepoints = {0, 0, 0, at.x, at.y, 0};
    s.geoKeys = {1, 1, 0,    2, 1024, 0,
                 1, 1, 3072, 0, 1,    static_cast<uint16_t>(south ? 32732 : 32632)};
    Result<HeightRaster> r = HeightRaster::read(tiffOf(s), "a.tif");
    ASSERT_TRUE(r.ok()) << r.error().message;
    const auto cell = r->cellAt(degrees(corner.longitude, corner.latitude));
    ASSERT_TRUE(cell);
    EXPECT_NEAR(cell->x, -0.5, 1e-5);
    EXPECT_NEAR(cell->y, -0.5, 1e-5);
  }
}

TEST(HeightRaster, OtherProjectionsNameTheRemedy) {
  TiffSample s = sample();
  s.geoKeys = {1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 2154};
  Result<HeightRaster> r = HeightRaster::read(tiffOf(s), "a.tif");
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.error().code, "heights-projection");
  EXPECT_NE(r.error().message.find("EPSG:2154"), std::string::npos);
  EXPECT_NE(r.error().hint.find("gdalwarp"), std::string::npos);
}

TEST(HeightRaster, ValuesThatStandForNoneAreVoids) {
  TiffSample s = sample();
  s.noData = "-9999";
  s.values[33] = -9999;
  Result<HeightRaster> r = HeightRaster::read(tiffOf(s), "a.tif");
  ASSERT_TRUE(r.ok());
  EXPECT_TRUE(std::isnan(heightAt(*r, degrees(7.4035, 43.7965))));
  EXPECT_NEAR(heightAt(*r, degrees(7.4065, 43.7965)), 136, 1e-6);
  s.values.assign(80, -9999);
  EXPECT_EQ(HeightRaster::read(tiffOf(s), "a.tif").error().code, "heights-empty");
}

TEST(HeightRaster, NeverSwingsBeyondItsNeighbours) {
  TiffSample s = sample();
  for (int i = 0; i < 80; ++i) s.values[static_cast<size_t>(i)] = i % 10 < 5 ? 0 : 100;
  Result<HeightRaster> r = HeightRaster::read(tiffOf(s), "a.tif");
  ASSERT_TRUE(r.ok());
  for (double c = 0; c <= 9; c += 0.1) {
    const auto h = r->heightAt({c, 3.5});
    ASSERT_TRUE(h);
    EXPECT_GE(*h, 0);
    EXPECT_LE(*h, 100);
  }
}

TEST(HeightRaster, BrokenFilesAreErrors) {
  const std::string good = tiffOf(sample());
  EXPECT_EQ(HeightRaster::read("", "a.tif").error().code, "heights-broken");
  EXPECT_EQ(HeightRaster::read("x", "a.png").error().code, "heights-unknown");
  const std::string hint = HeightRaster::read("x", "a.asc").error().hint;
  EXPECT_NE(hint.find("gdal_translate -a_srs EPSG:4326 'a.asc' heights.tif"), std::string::npos);
  for (size_t cut = 1; cut < good.size(); cut += 7) {
    // Any answer, without a crash.
    const auto r = HeightRaster::read(good.substr(0, cut), "a.tif");
    if (!r.ok()) {
      EXPECT_EQ(r.error().code.rfind("heights-", 0), 0u) << r.error().code;
    }
  }
  for (size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(0xff);
    const auto r = HeightRaster::read(bad, "a.tif");
    if (!r.ok()) {
      EXPECT_EQ(r.error().code.rfind("heights-", 0), 0u) << r.error().code;
    }
  }
  TiffSample huge = sample();
  huge.claimedWidth = huge.claimedHeight = 1'000'000;
  EXPECT_EQ(HeightRaster::read(tiffOf(huge), "a.tif").error().code, "heights-large");
  TiffSample nowhere = sample();
  nowhere.pixelScale = {0, 0, 0};
  EXPECT_EQ(HeightRaster::read(tiffOf(nowhere), "a.tif").error().code, "heights-place");
  nowhere.pixelScale.clear();
  EXPECT_EQ(HeightRaster::read(tiffOf(nowhere), "a.tif").error().code, "heights-place");
}

std::string hgt() {
  std::string out(size_t{2} * 1201 * 1201, '\0');
  for (size_t r = 0; r < 1201; ++r) {
    for (size_t c = 0; c < 1201; ++c) {
      const auto v = static_cast<uint16_t>(r / 10 + c / 100);
      out[2 * (r * 1201 + c)] = static_cast<char>(v >> 8);
      out[2 * (r * 1201 + c) + 1] = static_cast<char>(v & 0xff);
    }
  }
  // A void in the first row.
  out[0] = static_cast<char>(0x80);
  return out;
}

TEST(HeightRaster, TilesOfSrtmLieWhereTheirNameSays) {
  Result<HeightRaster> r = HeightRaster::read(hgt(), "some/N43E007.hgt");
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_NEAR(heightAt(*r, degrees(7.5, 43.5)), 60 + 6, 1e-6);
  EXPECT_TRUE(std::isnan(heightAt(*r, degrees(7, 44))));
  EXPECT_NEAR(heightAt(*r, degrees(8, 43)), 120 + 12, 1e-6);
  Result<HeightRaster> west = HeightRaster::read(hgt(), "s34w059.hgt");
  ASSERT_TRUE(west.ok());
  EXPECT_NEAR(heightAt(*west, degrees(-58, -34)), 120 + 12, 1e-6);
  EXPECT_EQ(HeightRaster::read(hgt(), "heights.hgt").error().code, "heights-name");
  EXPECT_EQ(HeightRaster::read("abc", "N43E007.hgt").error().code, "heights-broken");
}

TEST(HeightField, FillsVoidsFromAround) {
  std::vector<double> heights;
  for (int r = 0; r < 20; ++r) {
    for (int c = 0; c < 20; ++c) heights.push_back(5.0 * c);
  }
  for (int r = 8; r < 12; ++r) {
    for (int c = 8; c < 12; ++c) heights[static_cast<size_t>(20 * r + c)] = std::nan("");
  }
  ASSERT_TRUE(fillVoids(heights, 20));
  for (int r = 0; r < 20; ++r) {
    for (int c = 0; c < 20; ++c) {
      EXPECT_NEAR(heights[static_cast<size_t>(20 * r + c)], 5.0 * c, 20) << r << ' ' << c;
    }
  }
  std::vector<double> none(9, std::nan(""));
  EXPECT_FALSE(fillVoids(none, 3));
}

TEST(HeightField, LiesWhereTheMapLies) {
  Result<HeightRaster> raster = HeightRaster::read(hgt(), "N43E007.hgt");
  ASSERT_TRUE(raster.ok());
  const auto frame = localGeoFrame({7.5, 43.5});
  Box2 area;
  area.include({-500, -500});
  area.include({500, 500});
  Result<HeightField> field = HeightField::of(*raster, *frame, area);
  ASSERT_TRUE(field.ok()) << field.error().message;
  // Rows of 92.6 metres, ten of them a metre.
  EXPECT_NEAR(field->at({0, 0}), 66, 0.3);
  EXPECT_GT(field->at({0, -400}), field->at({0, 400}) - 0.01);
  EXPECT_EQ(field->at({1e9, 0}), field->at({1e7, 0}));
  EXPECT_EQ(field->filled(), 0);
  const auto far = localGeoFrame({20, 50});
  EXPECT_EQ(HeightField::of(*raster, *far, area).error().code, "heights-elsewhere");
  const auto nowhere = mapGeoFrame("EPSG:2154", {0, 0});
  EXPECT_EQ(HeightField::of(*raster, *nowhere, area).error().code, "heights-place");
}

}  // namespace
}  // namespace gable
