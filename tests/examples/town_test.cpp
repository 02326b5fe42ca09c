// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The town: what its rules promise. Its whole lot is a square kilometre; the tests that look at
// every part take a smaller one, on several seeds.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"
#include "io/exporters/draw_list.h"
#include "json/answers.h"
#include "scene/flatten.h"
#include "scene_faults.h"

namespace gable {
namespace {

// Leaves that stand for buildings, by their names.
const std::set<std::string> kWalls = {"Stucco", "Brick", "Siding", "Glazing"};
// Rounding.
constexpr double kTouch = 0.01;

Model derived(double side, double seed) {
  const Rules rules = Rules::load(std::string(GABLE_SOURCE_DIR) + "/examples/town/town.cga");
  DeriveSettings settings;
  settings.seed = seed;
  settings.jobs = 2;
  return derive(rules, Shapes::lot(side, side), settings);
}

struct Town {
  Model model;
  std::vector<Polygon> roadways;
  // Places of walls from above.
  std::vector<Vec2> walls;
  size_t lamps = 0, trees = 0;

  Town(double side, double seed) : model(derived(side, seed)) {
    forEachLeaf(scene(), [&](const Leaf& leaf, const Frame& world) {
      const std::string& name = scene().names[leaf.name];
      if (name == "Light") ++lamps;
      if (name == "Bark") ++trees;
      const bool road = name == "Asphalt";
      if (!road && kWalls.count(name) == 0) return;
      const Mesh mesh = transformed(*scene().meshes[leaf.mesh], leaf.scale, world);
      if (road) {
        addGround(mesh);
      } else {
        for (const Vec3& p : mesh.positions) walls.push_back({p.x, -p.z});
      }
    });
  }
  const Scene& scene() const { return model.impl().result.scene; }

 private:
  void addGround(const Mesh& mesh) {
    const Frame ground = Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    for (size_t f = 0; f < mesh.faceCount(); ++f) {
      roadways.push_back(facePolygon(mesh, f, ground));
    }
  }
};

// The rule files that leaves come from, without their folders.
std::set<std::string> filesOf(const Scene& scene) {
  std::set<std::string> out;
  for (const SourcePlace& place : scene.sources) {
    out.insert(place.file.substr(place.file.rfind('/') + 1));
  }
  return out;
}

TEST(TownExample, hasTwoThousandBuildingsOfAllStylesAParkAndACastle) {
  const Town town(1000, 1);
  const std::set<std::string> files = filesOf(town.scene());
  for (const char* file : {"haussmann.cga", "monaco.cga", "rowhouse.cga", "suburb_house.cga",
                           "tower.cga", "gardens.cga", "castle.cga", "huts.cga"}) {
    EXPECT_EQ(files.count(file), 1u) << file;
  }
  // The studio draws so many.
  EXPECT_LT(prototypeLeafCounts(town.scene())[town.scene().roots.at(0).instance.prototype],
            kMostLeaves);
  EXPECT_FALSE(hasErrors(town.model.diagnostics())) << render(town.model.diagnostics());
  EXPECT_EQ(joined(faults(town.scene())), "");
  const std::string stats = statisticsJson(town.model);
  const size_t at = stats.find("\"buildings\"");
  ASSERT_NE(at, std::string::npos);
  const size_t sum = stats.find("\"sum\":", at);
  ASSERT_NE(sum, std::string::npos);
  EXPECT_GE(std::stod(stats.substr(sum + 6)), 2000);
}

TEST(TownExample, buildingsKeepOutOfTheRoadways) {
  for (const double seed : {1.0, 2.0, 3.0}) {
    const Town town(300, seed);
    EXPECT_EQ(joined(faults(town.scene())), "") << "seed " << seed;
    ASSERT_GT(town.roadways.size(), 10u);
    ASSERT_GT(town.walls.size(), 1000u);
    EXPECT_GT(town.lamps, 20u);
    EXPECT_GT(town.trees, 100u);
    Region inner;
    for (const Polygon& p : town.roadways) {
      for (const Polygon& q : offset({p}, -kTouch)) inner.push_back(q);
    }
    std::vector<Box2> boxes;
    for (const Polygon& p : inner) boxes.push_back(bounds(p));
    size_t inRoads = 0;
    for (const Vec2 w : town.walls) {
      for (size_t i = 0; i < inner.size(); ++i) {
        const Box2& b = boxes[i];
        if (w.x < b.min.x || w.x > b.max.x || w.y < b.min.y || w.y > b.max.y) continue;
        if (contains(inner[i], w)) ++inRoads;
      }
    }
    EXPECT_EQ(inRoads, 0u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace gable
