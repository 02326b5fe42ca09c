// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The example worlds, seed after seed: nothing breaks, no building reaches into a street or into
// another one, and every house can be walked to from a street. GABLE_SEEDS says how many seeds
// or which, with commas between them; tools/worlds.sh asks for 200.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "scene_faults.h"

namespace gable {
namespace {

// Rounding of walls that share a border.
constexpr double kTouch = 0.01;
// Two houses of the suburb are at least so far apart, and a house and a street.
constexpr double kHouseGap = 1, kStreetGap = 0.5;

// "200": so many from 0 on; "8,40,69": these.
std::vector<int> seeds(std::vector<int> otherwise) {
  const char* asked = std::getenv("GABLE_SEEDS");
  if (!asked) return otherwise;
  const std::string text = asked;
  std::vector<int> out;
  if (text.find(',') == std::string::npos) {
    for (int i = 0; i < std::max(1, std::atoi(asked)); ++i) out.push_back(i);
    return out;
  }
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) out.push_back(std::atoi(one.c_str()));
  return out;
}

using Settings = std::vector<std::pair<std::string, std::string>>;

Model derived(const std::string& example, double side, double seed, Settings set) {
  const Rules rules =
      Rules::load(std::string(GABLE_SOURCE_DIR) + "/examples/" + example + "/" + example + ".cga");
  DeriveSettings settings;
  settings.seed = seed;
  settings.jobs = 2;
  settings.attributes = std::move(set);
  return derive(rules, Shapes::lot(side, side), settings);
}

struct World {
  std::vector<Polygon> roads;
  std::vector<Polygon> buildings;
  // Where the public walks: roads and pavements.
  std::vector<Polygon> ways;
};

const Frame kGround = Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});

std::vector<Polygon> facesNamed(const Scene& scene, const std::string& name, double low = -1,
                                double high = 1) {
  std::vector<Polygon> out;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    if (scene.names[leaf.name] != name) return;
    const Mesh mesh = transformed(*scene.meshes[leaf.mesh], leaf.scale, world);
    for (size_t f = 0; f < mesh.faceCount(); ++f) {
      const double y = mesh.at(mesh.loopsOf(f)[0].firstCorner).y;
      if (y < low || y > high) continue;
      Polygon p = facePolygon(mesh, f, kGround);
      orient(p);
      out.push_back(std::move(p));
    }
  });
  return out;
}

// Everything between the walls and under the roof of a house of the suburb, from its drive.
void addSuburbHouses(const Scene& scene, double unit, std::vector<Polygon>& out) {
  bool inDrive = false;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    const bool drive = scene.names[leaf.name] == "Concrete";
    if (drive && !inDrive) {
      const auto corner = [&](double x, double z) {
        const Vec3 p = world.point({(3.75 + x) * unit, 0, (z - 0.4) * unit});
        return Vec2{p.x, -p.z};
      };
      const double w = 2.3391, d = 1.9588;
      Polygon p{{corner(-w, d), corner(w, d), corner(w, -d), corner(-w, -d)}, {}};
      orient(p);
      out.push_back(std::move(p));
    }
    inDrive = drive;
  });
}

bool apart(const Box2& a, const Box2& b, double gap) {
  return a.max.x + gap < b.min.x || b.max.x + gap < a.min.x || a.max.y + gap < b.min.y ||
         b.max.y + gap < a.min.y;
}

// Whether two polygons are nearer than `gap`; with 0 whether they share more than a border.
bool tooNear(const Polygon& a, const Polygon& b, double gap) {
  if (apart(bounds(a), bounds(b), gap)) return false;
  const Region grown = gap > 0 ? offset({a}, gap - kTouch) : offset({a}, -kTouch);
  return area(intersect(grown, {b})) > kTouch * kTouch;
}

bool crosses(const Polygon& p, Vec2 a, Vec2 b) {
  for (double t = 0.05; t < 1; t += 0.05) {
    if (locate(p, a + (b - a) * t) == Where::Inside) return true;
  }
  return false;
}

// Some straight way from a wall to the nearest street leads through no other building.
bool reachable(const World& w, size_t which) {
  const Ring& ring = w.buildings[which].outer;
  for (size_t i = 0; i < ring.size(); ++i) {
    for (const double t : {0.0, 0.25, 0.5, 0.75}) {
      const Vec2 from = ring[i] + (ring[(i + 1) % ring.size()] - ring[i]) * t;
      Vec2 to;
      double best = 1e300;
      for (const Polygon& way : w.ways) {
        const Ring& r = way.outer;
        for (size_t k = 0; k < r.size(); ++k) {
          const Vec2 d = r[(k + 1) % r.size()] - r[k];
          const double s = std::clamp(dot(from - r[k], d) / std::max(dot(d, d), 1e-12), 0.0, 1.0);
          const Vec2 q = r[k] + d * s;
          if (length(q - from) >= best) continue;
          best = length(q - from);
          to = q;
        }
      }
      // At the street itself; by rounding it may lie a hair within the house.
      if (best < kTouch) return true;
      const bool blocked =
          std::any_of(w.buildings.begin(), w.buildings.end(),
                      [&](const Polygon& other) { return crosses(other, from, to); });
      if (!blocked) return true;
    }
  }
  return false;
}

void expectSound(const World& w, double gap, double streetGap, const std::string& what) {
  size_t inStreets = 0, inOthers = 0, unreachable = 0;
  std::vector<Box2> boxes;
  for (const Polygon& p : w.buildings) boxes.push_back(bounds(p));
  for (size_t i = 0; i < w.buildings.size(); ++i) {
    ASSERT_TRUE(isValid(w.buildings[i])) << what << ", building " << i;
    for (const Polygon& road : w.roads) {
      inStreets += tooNear(w.buildings[i], road, streetGap) ? 1 : 0;
    }
    for (size_t k = 0; k < i; ++k) {
      if (apart(boxes[i], boxes[k], gap)) continue;
      inOthers += tooNear(w.buildings[i], w.buildings[k], gap) ? 1 : 0;
    }
    if (reachable(w, i)) continue;
    ++unreachable;
    const Vec2 c = bounds(w.buildings[i]).center();
    std::printf("%s: no way to the building at %.1f, %.1f\n", what.c_str(), c.x, -c.y);
  }
  EXPECT_EQ(inStreets, 0u) << what;
  EXPECT_EQ(inOthers, 0u) << what;
  EXPECT_EQ(unreachable, 0u) << what;
}

TEST(Worlds, theSuburbKeepsItsGaps) {
  for (const int seed : seeds({0, 1, 2})) {
    const Model m = derived("suburb", 320, seed,
                            {{"detail", "false"}, {"planting", "false"}, {"outskirts", "false"}});
    ASSERT_FALSE(hasErrors(m.diagnostics())) << render(m.diagnostics());
    const Scene& scene = m.impl().result.scene;
    World w{facesNamed(scene, "Asphalt"), {}, {}};
    w.ways = w.roads;
    addSuburbHouses(scene, 2, w.buildings);
    EXPECT_GE(w.buildings.size(), 140u);
    expectSound(w, kHouseGap, kStreetGap, "seed " + std::to_string(seed));
  }
}

TEST(Worlds, theTownsBuildingsKeepToTheirLots) {
  for (const int seed : seeds({0, 1, 2})) {
    const Model m = derived("town", 300, seed, {{"planting", "false"}, {"plan", "true"}});
    ASSERT_FALSE(hasErrors(m.diagnostics())) << render(m.diagnostics());
    const Scene& scene = m.impl().result.scene;
    EXPECT_EQ(joined(faults(scene)), "") << "seed " << seed;
    World w{facesNamed(scene, "Asphalt"), {}, {}};
    // Pavements lie higher than the paving of yards.
    w.ways = facesNamed(scene, "Paving", 0.125, 0.135);
    w.ways.insert(w.ways.end(), w.roads.begin(), w.roads.end());
    w.buildings = facesNamed(scene, "Footprint");
    EXPECT_GT(w.buildings.size(), 60u);
    expectSound(w, 0, 0, "seed " + std::to_string(seed));
  }
}

// How far something reaches over polygons other than one.
double depthIn(const std::vector<Polygon>& polygons, const std::vector<Box2>& boxes, size_t except,
               const Mesh& mesh, const Box2& box) {
  double deepest = 0;
  for (size_t i = 0; i < polygons.size(); ++i) {
    if (i == except || apart(boxes[i], box, 0)) continue;
    for (const Vec3& p : mesh.positions) {
      deepest = std::max(deepest, signedDistance(polygons[i], {p.x, -p.z}));
    }
  }
  return deepest;
}

std::vector<Box2> boundsOf(const std::vector<Polygon>& polygons) {
  std::vector<Box2> out;
  for (const Polygon& p : polygons) out.push_back(bounds(p));
  return out;
}

// Where rows turn a corner, cornices of neighbours meet, and awnings reach before each other's
// windows; walls do not meet.
constexpr double kAwning = 1, kCornice = 0.5, kBand = 0.1;
// The imports that houses come from.
constexpr const char* kStyles[] = {"oldTown.", "apartments.", "towers.", "rows.", "family."};

TEST(Worlds, theTownsHousesStayOverTheirFootprints) {
  const std::set<std::string> walls = {"Stucco", "Brick", "Siding", "Glazing"};
  for (const int seed : seeds({1})) {
    Settings set = {{"planting", "false"}, {"withCastle", "false"}, {"withPark", "false"}};
    const Model built = derived("town", 300, seed, set);
    set.emplace_back("plan", "true");
    const Model plan = derived("town", 300, seed, set);
    const std::vector<Polygon> footprints = facesNamed(plan.impl().result.scene, "Footprint");
    const std::vector<Polygon> roads = facesNamed(plan.impl().result.scene, "Asphalt");
    const std::vector<Box2> boxes = boundsOf(footprints), roadBoxes = boundsOf(roads);
    const Scene& scene = built.impl().result.scene;
    std::map<std::string, double> over;
    forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
      const SourcePlace& source = scene.sources[leaf.source];
      const auto isOf = [&](const char* style) { return source.rule.rfind(style, 0) == 0; };
      if (std::none_of(std::begin(kStyles), std::end(kStyles), isOf)) return;
      const Mesh mesh = transformed(*scene.meshes[leaf.mesh], leaf.scale, world);
      Box2 box;
      for (const Vec3& p : mesh.positions) box.include({p.x, -p.z});
      double least = 1e300;
      size_t own = footprints.size();
      for (size_t i = 0; i < footprints.size(); ++i) {
        if (apart(boxes[i], box, 2)) continue;
        double out = 0;
        for (const Vec3& p : mesh.positions) {
          out = std::max(out, -signedDistance(footprints[i], {p.x, -p.z}));
        }
        if (out >= least) continue;
        least = out;
        own = i;
      }
      const std::string& name = scene.names[leaf.name];
      double& most = over[source.rule + " " + name];
      const double allowed = walls.count(name) > 0 ? kBand : name == "Canvas" ? kAwning : kCornice;
      most = std::max(most, depthIn(footprints, boxes, own, mesh, box) - allowed);
      // Nothing at all reaches over a roadway.
      most = std::max(most, depthIn(roads, roadBoxes, roads.size(), mesh, box));
      if (own == footprints.size()) most = least;
    });
    EXPECT_GT(over.size(), 30u);
    for (const auto& [what, out] : over) EXPECT_LT(out, kTouch) << what << ", seed " << seed;
  }
}

}  // namespace
}  // namespace gable
