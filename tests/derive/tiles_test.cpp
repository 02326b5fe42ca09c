// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tiles by the library: a plan, its jobs and their merge make what one call makes.

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>

#include "gable/city.h"
#include "gable/gable.h"
#include "gable/tiles.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

class Tiles : public testing::Test {
 protected:
  Tiles() : folder_(fs::path(testing::TempDir()) / ("gable-tiles-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    put("block.cga", "attr levels = 9\nBlock --> extrude(3 + levels) Mass.\n");
    put("city.cga",
        "import b : \"block.cga\"\n@StartRule Ground --> Flat.\nBuilding --> b.Block\n");
  }
  ~Tiles() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  // Heights that rise to the east, as a tile of SRTM: 49 to 50 degrees north, 8 to 9 east.
  std::string heights() const {
    std::string bytes;
    for (int row = 0; row < 1201; ++row) {
      for (int column = 0; column < 1201; ++column) {
        bytes += static_cast<char>(column * 4 / 256);
        bytes += static_cast<char>(column * 4 % 256);
      }
    }
    put("N49E008.hgt", bytes);
    return at("N49E008.hgt");
  }

  // Squares of fifteen metres, one beside the other.
  static std::string map(int count) {
    std::ostringstream out;
    out << R"({"type":"FeatureCollection","features":[)";
    for (int i = 0; i < count; ++i) {
      const double x = 8.5 + 0.0003 * (i % 70), y = 49.5 + 0.0003 * (i / 70), s = 0.0002;
      out << (i ? "," : "") << R"({"type":"Feature","properties":{"building":"yes","levels":)"
          << i % 5 << R"(},"geometry":{"type":"Polygon","coordinates":[[[)" << x << "," << y
          << "],[" << x + s << "," << y << "],[" << x + s << "," << y + s << "],[" << x << ","
          << y + s << "],[" << x << "," << y << "]]]}}";
    }
    out << "]}";
    return out.str();
  }

  std::map<std::string, std::string> contents(const std::string& name) const {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / name)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      std::ostringstream text;
      text << file.rdbuf();
      out[fs::relative(entry.path(), folder_ / name).string()] = text.str();
    }
    return out;
  }

  TilePlan planOf(const Rules& rules, const Shapes& shapes, const std::string& name) const {
    TilePlanSettings settings;
    settings.rules = at("city.cga");
    settings.jobShapes = 1000;
    settings.tiles.triangles = 2000;
    return planTiles(rules, shapes, at(name), settings);
  }

 private:
  fs::path folder_;
};

TEST_F(Tiles, aPlanKeepsTheTerrainAndWhatShapesReach) {
  CitySettings settings;
  settings.terrain = heights();
  const City city = City::parse(map(2500), "town.geojson", settings);
  ASSERT_TRUE(city.ok()) << render(city.diagnostics());
  const Rules rules = Rules::load(at("city.cga"));
  TileSettings tiles;
  tiles.triangles = 2000;
  const TileResult one = writeTiles(rules, city.shapes(), at("one/"), tiles);
  ASSERT_TRUE(one.ok) << render(one.diagnostics);

  const TilePlan planned = planOf(rules, city.shapes(), "many/");
  ASSERT_TRUE(planned.ok()) << render(planned.diagnostics());
  const TilePlan plan = TilePlan::load(at("many/"));
  ASSERT_GT(plan.jobs(), 1u);
  for (uint64_t job = plan.jobs(); job-- > 0;) {
    const TileResult made = runTileJob(plan, plan.rules(), job);
    ASSERT_TRUE(made.ok) << render(made.diagnostics);
  }
  const TileResult merged = mergeTiles(plan);
  ASSERT_TRUE(merged.ok) << render(merged.diagnostics);
  EXPECT_EQ(merged.triangles, one.triangles);
  EXPECT_EQ(contents("many"), contents("one"));

  // Both were on the terrain, and the levels of the map reached the imported file.
  const City flat = City::parse(map(2500), "town.geojson");
  ASSERT_TRUE(writeTiles(rules, flat.shapes(), at("flat/"), tiles).ok);
  EXPECT_NE(contents("flat"), contents("one"));
}

TEST_F(Tiles, aPlanForOthersIsNotReplacedUnasked) {
  const City city = City::parse(map(20), "town.geojson");
  const Rules rules = Rules::load(at("city.cga"));
  ASSERT_TRUE(planOf(rules, city.shapes(), "out/").ok());
  TileSettings tiles;
  const TileResult refused = writeTiles(rules, city.shapes(), at("out/"), tiles);
  EXPECT_FALSE(refused.ok);
  ASSERT_FALSE(refused.diagnostics.empty());
  EXPECT_EQ(refused.diagnostics[0].code, "tiles-planned");
  tiles.replacePlan = true;
  EXPECT_TRUE(writeTiles(rules, city.shapes(), at("out/"), tiles).ok);
}

TEST_F(Tiles, progressRisesAndAWishToStopIsHeard) {
  const City city = City::parse(map(2500), "town.geojson");
  const Rules rules = Rules::load(at("city.cga"));
  const TilePlan plan = planOf(rules, city.shapes(), "out/");
  ASSERT_TRUE(plan.ok());
  TileRun run;
  run.threads = 4;
  std::atomic<int> within{0};
  size_t last = 0;
  bool alone = true, rising = true;
  run.progress = [&](size_t done, size_t total) {
    alone = alone && within.fetch_add(1) == 0;
    rising = rising && done > last && done <= total;
    last = done;
    within.fetch_sub(1);
  };
  for (uint64_t job = 0; job < plan.jobs(); ++job) {
    last = 0;
    ASSERT_TRUE(runTileJob(plan, rules, job, run).ok);
    EXPECT_GT(last, 0u);
  }
  std::atomic<bool> cancel{true};
  TileRun stopped = run;
  stopped.cancel = &cancel;
  last = 0;
  const TileResult none = mergeTiles(plan, stopped);
  EXPECT_FALSE(none.ok);
  ASSERT_FALSE(none.diagnostics.empty());
  EXPECT_EQ(none.diagnostics.back().code, "was-cancelled");
  EXPECT_FALSE(fs::exists(at("out/tileset.json")));
  last = 0;
  EXPECT_TRUE(mergeTiles(plan, run).ok);
  EXPECT_TRUE(alone);
  EXPECT_TRUE(rising);
}

}  // namespace
}  // namespace gable
