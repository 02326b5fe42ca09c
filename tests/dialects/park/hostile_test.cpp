// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Regions that are hard: each operation ends with all area given out, or with a word about why not.
// And the garden of the examples with many seeds: nothing lies on anything else.

#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"
#include "geom/region/boolean.h"
#include "geom/region/hull.h"
#include "park_testing.h"

namespace gable {
namespace {

using namespace park_testing;
using PlanRing = Shapes::Ring;

struct Hard {
  const char* name;
  Shapes shapes;
  double area;
};

// A star of so many vertices around a place.
PlanRing star(int vertices, double radius, double x, double y) {
  PlanRing r;
  for (int i = 0; i < vertices; ++i) {
    const double a = 360.0 * i / vertices;
    const double reach =
        radius * (0.7 + 0.3 * randomUnit(hashCombine(7, static_cast<uint64_t>(i))));
    r.push_back({x + reach * cosDeg(a), y + reach * sinDeg(a)});
  }
  return r;
}

double areaOf(const PlanRing& r) {
  double sum = 0;
  for (size_t i = 0; i < r.size(); ++i) {
    const auto& [ax, ay] = r[i];
    const auto& [bx, by] = r[(i + 1) % r.size()];
    sum += (ax - r[0].first) * (by - r[0].second) - (bx - r[0].first) * (ay - r[0].second);
  }
  return sum / 2;
}

std::vector<Hard> hardRegions() {
  const PlanRing many = star(5000, 300, 0, 0), far = star(40, 50, 458000, 5428000);
  return {
      {"touching itself",
       Shapes::polygon({{0, 0}, {20, 0}, {20, 10}, {10, 10}, {20, 20}, {0, 20}, {10, 10}, {0, 10}}),
       -1},
      {"crossing itself", Shapes::polygon({{0, 0}, {20, 20}, {20, 0}, {0, 20}}), -1},
      {"running back", Shapes::polygon({{0, 0}, {20, 0}, {30, 0}, {20, 0}, {20, 10}, {0, 10}}),
       200},
      {"one millimetre wide", Shapes::lot(20, 0.001), 0.02},
      {"one millimetre small", Shapes::lot(0.001, 0.001), 1e-6},
      {"ten kilometres wide", Shapes::lot(10000, 10000), 1e8},
      {"five thousand vertices", Shapes::polygon(many), areaOf(many)},
      {"far from the origin", Shapes::polygon(far), areaOf(far)},
      {"a needle", Shapes::polygon({{0, 0}, {1000, 0.01}, {0, 0.02}}), 10},
      {"no area", Shapes::polygon({{0, 0}, {10, 0}, {20, 0}}), -1},
  };
}

// New points lie on the grid, so a long thin outline may be off by a step along it.
double stepAlong(const Hard& h) {
  const std::string name = h.name;
  return kRegionGrid * (name == "a needle" ? 2000 : name == "one millimetre wide" ? 40 : 0);
}

// On a quiet machine nothing takes longer than a second; sanitizers are slower by far.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kMostSeconds = 200;
#else
constexpr double kMostSeconds = 5;
#endif

using Metres = std::function<std::string(double share)>;

// The operations on every hard region; lengths are shares of its size.
void forEachHard(const std::function<std::vector<std::string>(const Metres&)>& operations,
                 const std::function<void(const Hard&, double size, const std::string& op)>& look) {
  for (const Hard& h : hardRegions()) {
    const double size = h.area > 0 ? std::sqrt(h.area) : 10;
    const Metres metres = [&](double share) { return std::to_string(share * size); };
    for (const std::string& op : operations(metres)) {
      const std::clock_t start = std::clock();
      look(h, size, op);
      const double took = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      EXPECT_LT(took, kMostSeconds) << h.name << ": " << op;
    }
  }
}

TEST(ParkHostile, PartitionsEndWithAllAreaOrAWord) {
  const auto operations = [](const Metres& metres) -> std::vector<std::string> {
    return {
        "grid(3, 3, " + metres(0.05) + ") { all : A }",
        "grid(2, 2, 0, template = inner) { all : A | junction : circle(" + metres(0.1) + ") A }",
        "voronoi(6, " + metres(0.03) + ", radius = " + metres(0.01) + ") { all : A }",
        "voronoi(6, 0, none, jitter = " + metres(0.02) + ") { all : A }",
        "castRays(centre, corners, " + metres(0.01) + ") { region || path : A | centre : circle(" +
            metres(0.05) + ") A }",
        "castRays(centre, 7, 0) { all : A }",
        "peel(all, " + metres(0.02) + ") { all : A }",
        "peel(longest, '0.3, orthogonal = true) { all : A }",
        "peel(facing(west), " + metres(0.05) + ", smooth = average(2)) { all : A }",
        "quadMap(3, 3) { all : A }"};
  };
  forEachHard(operations, [](const Hard& h, double size, const std::string& op) {
    const Made m = rules("Lot --> " + op, h.shapes);
    if (h.area > 0) {
      EXPECT_NEAR(m.whole, h.area, 1e-5 * h.area + 1e-4 * size + stepAlong(h))
          << h.name << ": " << op;
    } else {
      EXPECT_TRUE(m.whole > 0 || !m.diagnostics.empty()) << h.name << ": " << op;
    }
  });
}

TEST(ParkHostile, OtherOperationsLeaveAShapeOrAWord) {
  const auto operations = [](const Metres& metres) -> std::vector<std::string> {
    return {"contract(" + metres(0.05) + ")",
            "contract('0.5)",
            "place(centre) { circle(" + metres(0.05) + ") B }",
            "place(corner(all)) { square(" + metres(0.02) + ") B }",
            "distribute(all, " + metres(0.2) + ", " + metres(0.01) + ") { B }",
            "scatterCircles(5, " + metres(0.02) + ") { B }",
            "sweep(all, " + metres(0.01) + ", " + metres(0.02) + ") { B }",
            "sweep(all, " + metres(0.02) + ", height = 1, profile = dome) { B }",
            "sweep(edge(0) || edge(1) || facing(east), " + metres(0.03) + ", " + metres(0.04) +
                ", ends = square, height = 1, profile = [0, 0; 0, 1; 0.5, 0.2; 1, 0.6]) { B }",
            "place(corners) { B } distribute(all, " + metres(0.3) + ", chain = true) { B }",
            "parametrise(edge(0) || edge(1) || edge(2) || edge(3)) { B }",
            "cutHoles()",
            "joined { circle(" + metres(0.1) + ") B. | rect(" + metres(0.3) + ", " + metres(0.1) +
                ") B. }"};
  };
  forEachHard(operations, [](const Hard& h, double, const std::string& op) {
    const Made m = rules("Lot --> " + op + " A.", h.shapes);
    EXPECT_TRUE(m.count.count("A") || !m.diagnostics.empty()) << h.name << ": " << op;
    const auto left = m.area.find("A");
    if (left != m.area.end() && h.area > 0) {
      EXPECT_LE(left->second, h.area * (1 + 1e-6) + 1e-6 + stepAlong(h)) << h.name << ": " << op;
    }
  });
}

// Convex and not, with holes: the sum of what a rule makes of the corpus is what there was.
TEST(ParkHostile, RulesKeepTheAreaOfTheCorpus) {
  forCorpus(67, [](const Polygon& plain, size_t i) {
    for (const Polygon& p : {plain, corpus::withHoles(plain.outer, i)}) {
      const auto ringOf = [](const Ring& r) {
        PlanRing out;
        for (const Vec2 v : r) out.push_back({v.x, v.y});
        return out;
      };
      std::vector<PlanRing> holes;
      for (const Ring& hole : p.holes) holes.push_back(ringOf(hole));
      const Shapes shapes = Shapes::polygon(ringOf(p.outer), holes);
      const double whole = area(p), size = std::sqrt(whole);
      const std::string path = std::to_string(size / 30);
      for (const std::string& op :
           {"grid(3, 2, " + path + ") { all : A }",
            "voronoi(5, " + path + ") { all : A | otherwise : A }",
            "castRays(centre, corners, " + path + ") { all : A | otherwise : A }",
            "peel(all, " + path + ") { all : A }", std::string("quadMap(3, 2) { all : A }")}) {
        const double made = rules("Lot --> " + op, shapes).whole;
        EXPECT_NEAR(made, whole, 1e-5 * whole + 1e-4 * size) << "polygon " << i << ": " << op;
      }
    }
  });
}

struct Thing {
  std::string name;
  Ring outline;
};

// Whether two convex outlines share area: no line along an edge of one keeps the other away.
bool overlap(const Ring& a, const Ring& b) {
  const auto apart = [](const Ring& r, const Ring& other) {
    for (size_t i = 0; i < r.size(); ++i) {
      const Vec2 d = normalized(r[(i + 1) % r.size()] - r[i]);
      bool beyond = true;
      for (const Vec2 v : other) beyond = beyond && cross(d, v - r[i]) < 1e-3;
      if (beyond) return true;
    }
    return false;
  };
  return !apart(a, b) && !apart(b, a);
}

// The plan of the garden: the grounds make up the plot, and no thing stands on another.
TEST(ParkHostile, ManyGardensHaveNothingOnAnythingElse) {
  const std::string folder = std::string(GABLE_SOURCE_DIR) + "/examples/";
  LoadSettings options;
  options.project = folder;
  const Rules rules = Rules::load(folder + "gardens/gardens.cga", options);
  for (const Diagnostic& x : rules.diagnostics()) ADD_FAILURE() << x.message;
  const Shapes plot = Shapes::load(folder + "gardens/buildings.geojson");
  const char* asked = std::getenv("GABLE_SEEDS");
  const int many = asked && *asked ? std::atoi(asked) : 6;
  // In these a lamp stood where a bench had cut a corner off its place.
  std::vector<int> seeds = {18, 30, 53, 58};
  for (int seed = 1; seed <= many; ++seed) seeds.push_back(seed);
  for (const int seed : seeds) {
    DeriveSettings settings;
    settings.seed = seed;
    settings.attributes = {{"plan", "true"}};
    const Model model = derive(rules, plot, settings);
    double ground = 0;
    std::vector<Thing> things;
    const Scene& scene = model.impl().result.scene;
    forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
      const std::string name = scene.names[leaf.name];
      const Mesh placed = transformed(*scene.meshes[leaf.mesh], leaf.scale, world);
      if (name == "Flat") ground += placed.area();
      if (name != "Footprint") return;
      std::vector<Vec2> points;
      for (const Vec3& v : placed.positions) points.push_back({v.x, -v.z});
      things.push_back({name, convexHull(points)});
    });
    EXPECT_NEAR(ground, 12956.56, 0.5) << "seed " << seed;
    EXPECT_GT(things.size(), 100u) << "seed " << seed;
    size_t meetings = 0;
    for (size_t i = 0; i < things.size(); ++i) {
      for (size_t k = 0; k < i; ++k) meetings += overlap(things[i].outline, things[k].outline);
    }
    EXPECT_EQ(meetings, 0u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace gable
