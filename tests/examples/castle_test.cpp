// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The castle village, row by row; C1 to C3 are with the trees, the formula of C6 is with the
// kernel. The layout is looked at on many seeds, with `sketch` on; GABLE_SEEDS=200 makes it more
// than the short form, and derives every castle whole as well.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "render/render.h"
#include "scene_faults.h"

namespace gable {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

constexpr double kLot = 330;
constexpr double kGap = 2;

std::string source(const std::string& path) { return std::string(GABLE_SOURCE_DIR) + "/" + path; }

int seeds(int otherwise) {
  const char* given = std::getenv("GABLE_SEEDS");
  return given ? std::atoi(given) : otherwise;
}

const Rules& castle() {
  static const Rules rules = Rules::load(source("examples/castle/castle.cga"));
  return rules;
}

Rules importing(const std::string& text) {
  return Rules::parse(
      "version \"2025.1\"\nimport towers : \"towers.cga\"\nimport huts : \"huts.cga\"\n" + text,
      source("examples/castle/test.cga"));
}

Model derived(const Rules& rules, const Shapes& shapes, double seed, Attributes attributes = {}) {
  DeriveSettings settings;
  settings.seed = seed;
  settings.jobs = 1;
  settings.attributes = std::move(attributes);
  Model model = derive(rules, shapes, settings);
  EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
  return model;
}

Model castleOf(double seed, Attributes attributes = {}) {
  return derived(castle(), Shapes::lot(kLot, kLot), seed, std::move(attributes));
}
Model sketchOf(double seed) { return castleOf(seed, {{"sketch", "true"}, {"planting", "false"}}); }

const Scene& sceneOf(const Model& m) { return m.impl().result.scene; }

template <class Visit>
void forEachNamed(const Model& m, const std::string& name, Visit&& visit) {
  const Scene& scene = sceneOf(m);
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    if (scene.names[leaf.name] == name) {
      visit(transformed(*scene.meshes[leaf.mesh], leaf.scale, world), world);
    }
  });
}

std::vector<double> reported(const Model& m, const std::string& key) {
  std::vector<double> out;
  for (const Report& r : sceneOf(m).reports) {
    if (r.key == key) out.push_back(r.value.number);
  }
  return out;
}

// From above: x to the east, y to the north.
Polygon fromAbove(const Mesh& m, size_t face = 0) {
  return facePolygon(m, face, Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
}
Ring outlineFromAbove(const Mesh& m) {
  std::vector<Vec2> points;
  for (const Vec3& p : m.positions) points.push_back({p.x, -p.z});
  return convexHull(points);
}

double distance(const Ring& a, const Ring& b) {
  double least = HUGE_VAL;
  for (const Vec2 p : a) least = std::min(least, distanceToBoundary({b, {}}, p));
  for (const Vec2 p : b) least = std::min(least, distanceToBoundary({a, {}}, p));
  return least;
}

/// The layout of one castle, from above.
struct Layout {
  std::vector<Ring> footprints, towers;
  Polygon yard;
  std::vector<Polygon> water;
  double wall = 0;
  size_t gates = 0;
  Vec2 insideGate;

  explicit Layout(const Model& m) {
    forEachNamed(m, "Footprint", [&](const Mesh& mesh, const Frame&) {
      footprints.push_back(outlineFromAbove(mesh));
    });
    forEachNamed(m, "Base",
                 [&](const Mesh& mesh, const Frame&) { towers.push_back(outlineFromAbove(mesh)); });
    forEachNamed(m, "Yard", [&](const Mesh& mesh, const Frame&) { yard = fromAbove(mesh); });
    forEachNamed(m, "Water", [&](const Mesh& mesh, const Frame&) {
      for (size_t f = 0; f < mesh.faceCount(); ++f) water.push_back(fromAbove(mesh, f));
    });
    forEachNamed(m, "Wall", [&](const Mesh& mesh, const Frame& world) {
      double from = HUGE_VAL, to = -HUGE_VAL;
      for (const Vec3& p : mesh.positions) {
        from = std::min(from, world.toLocal(p).x);
        to = std::max(to, world.toLocal(p).x);
      }
      wall += to - from;
    });
    const std::vector<double> gate = reported(m, "gate");
    gates = gate.size();
    std::vector<Vec3> bars;
    Vec3 outward;
    forEachNamed(m, "Bar", [&](const Mesh& mesh, const Frame& world) {
      for (const Vec3& p : mesh.positions) bars.push_back(p);
      outward = world.z;
    });
    Vec3 middle;
    for (const Vec3& p : bars) middle += p * (1.0 / static_cast<double>(bars.size()));
    const Vec3 inside = middle - outward * 3.4;
    insideGate = {inside.x, -inside.z};
  }
};

// ---- C4: bodies
// ----------------------------------------------------------------------------------

struct Body {
  const char* rule;
  double volume;
};

TEST(CastleRows, C4_bodiesAreClosedAndFaceOutward) {
  const double octagon = 2 * std::sqrt(2.0);
  for (const Body& b :
       {Body{"s(2, 3, 4) primitiveCube()", 24}, Body{"primitiveCylinder(8, 1, 2)", 2 * octagon},
        Body{"primitiveCone(8, 1, 3)", octagon},
        Body{"primitiveDisk(8, 1) extrude(2)", 2 * octagon}}) {
    const Model m =
        derived(importing("Lot --> " + std::string(b.rule) + " Body."), Shapes::lot(6, 6), 0);
    size_t bodies = 0;
    const Scene& scene = sceneOf(m);
    forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
      const Mesh mesh = transformed(*scene.meshes[leaf.mesh], leaf.scale, world);
      std::map<std::pair<uint32_t, uint32_t>, int> edges;
      double volume = 0;
      for (size_t f = 0; f < mesh.faceCount(); ++f) {
        for (const MeshLoop& loop : mesh.loopsOf(f)) {
          for (uint32_t i = 0; i < loop.cornerCount; ++i) {
            const uint32_t a = mesh.corners[loop.firstCorner + i];
            const uint32_t z = mesh.corners[loop.firstCorner + (i + 1) % loop.cornerCount];
            ++edges[{a, z}];
          }
        }
        const MeshLoop& outer = mesh.loopsOf(f)[0];
        volume += dot(mesh.areaNormal(f), mesh.at(outer.firstCorner)) / 6;
      }
      for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1) << b.rule;
        EXPECT_TRUE(edges.count({edge.second, edge.first})) << b.rule;
      }
      EXPECT_GT(volume, 0) << b.rule;
      EXPECT_NEAR(volume, b.volume, 1e-9) << b.rule;
      ++bodies;
    });
    EXPECT_EQ(bodies, 1u) << b.rule;
  }
}

TEST(CastleRows, C4_bridgesBetweenTwoOutlinesAreStrips) {
  const Model m = derived(importing("Lot --> primitiveDisk(12, 4) ring(0, 2, 1) Bridge."),
                          Shapes::lot(9, 9), 0);
  forEachNamed(m, "Bridge", [&](const Mesh& mesh, const Frame&) {
    EXPECT_EQ(mesh.faceCount(), 24u);
    for (size_t f = 0; f < mesh.faceCount(); ++f) EXPECT_GT(mesh.normal(f).y, 0.5);
  });
}

// ---- C5, C14: towers
// -----------------------------------------------------------------------------

// Whether counts of values 1, 2, .. lie within five standard deviations of their chances.
void expectChances(const std::vector<double>& values, const std::vector<double>& chances) {
  std::vector<double> counts(chances.size() + 1, 0);
  for (const double v : values) {
    ASSERT_GE(v, 1);
    ASSERT_LE(v, static_cast<double>(chances.size()));
    ++counts[static_cast<size_t>(v)];
  }
  const auto n = static_cast<double>(values.size());
  for (size_t i = 0; i < chances.size(); ++i) {
    const double spread = 5 * std::sqrt(n * chances[i] * (1 - chances[i]));
    EXPECT_NEAR(counts[i + 1], n * chances[i], spread) << "value " << i + 1;
  }
}

TEST(CastleRows, C5_towersDrawCapsAndFeetByTheirChances) {
  const Model m = derived(importing("Lot --> split(x) { 1 : s(0, 0, 0) towers.Tower }*"),
                          Shapes::lot(500, 4), 1);
  // The fifth and the sixth cap are alike: a low one, without a flag.
  expectChances(reported(m, "tower.cap"), std::vector<double>(6, 1.0 / 6));
  // Turrets, a base, and nothing twice.
  expectChances(reported(m, "tower.foot"), std::vector<double>(4, 1.0 / 4));
  for (const double stories : reported(m, "tower.stories")) {
    EXPECT_GE(stories, 4);
    EXPECT_LE(stories, 7);
  }
}

TEST(CastleRows, C5_facesCloseAnyNumberOfSides) {
  for (const char* sides : {"4", "6", "10", "16"}) {
    const Model m = derived(
        importing("Lot --> s(0, 0, 0) towers.TowerOf(5, 3, 4, \"#aaaaaa\")"), Shapes::lot(9, 9), 1,
        {{"towers.sides", sides}, {"towers.radius", "4"}, {"towers.story", "3"}});
    const double n = std::atof(sides);
    double walls = 0;
    size_t flags = 0, windows = 0;
    forEachNamed(m, "Masonry", [&](const Mesh& mesh, const Frame&) {
      for (size_t f = 0; f < mesh.faceCount(); ++f) {
        if (std::fabs(mesh.normal(f).y) < 1e-9) walls += mesh.area(f);
      }
    });
    // Glass lies deep in the wall, as wide as what is cut out of it.
    forEachNamed(m, "Recess", [&](const Mesh& mesh, const Frame&) {
      for (size_t f = 0; f < mesh.faceCount(); ++f) walls += mesh.area(f);
    });
    forEachNamed(m, "Pole", [&](const Mesh&, const Frame&) { ++flags; });
    forEachNamed(m, "Sill", [&](const Mesh&, const Frame&) { ++windows; });
    EXPECT_NEAR(walls, n * 2 * 4 * std::tan(3.14159265358979 / n) * 15, 0.01) << sides;
    EXPECT_EQ(flags, 1u);
    // A checkerboard, but for the ground floor; the faces of a square tower have two columns of it.
    EXPECT_EQ(static_cast<double>(windows), n / 2 * 4 * (n == 4 ? 2 : 1)) << sides;
  }
}

TEST(CastleRows, C14_oneCastlesTowersAreAlike) {
  std::set<double> all;
  for (int seed = 1; seed <= 5; ++seed) {
    const std::vector<double> sides = reported(castleOf(seed), "tower.sides");
    ASSERT_GE(sides.size(), 8u);
    EXPECT_EQ(std::set<double>(sides.begin(), sides.end()).size(), 1u) << "seed " << seed;
    all.insert(sides[0]);
  }
  EXPECT_GT(all.size(), 1u);
}

// ---- C6 to C9: what is built
// ---------------------------------------------------------------------

TEST(CastleRows, C6_aBoxIsCrenellatedByTheFormula) {
  const Model m = derived(importing("Lot --> extrude(4) comp(f) { top : towers.Battlement }"),
                          Shapes::lot(13, 9), 1);
  const auto gaps = [](double l) { return std::nearbyint((l - 1.4) / (1.4 + 0.75)); };
  size_t merlons = 0;
  forEachNamed(m, "Merlon", [&](const Mesh& mesh, const Frame&) {
    ++merlons;
    const Box3 box = mesh.bounds();
    EXPECT_NEAR(box.min.y, 4, 1e-9);
    EXPECT_NEAR(box.max.y, 5.9, 1e-9);
    const bool onEdge =
        box.min.x < 1e-3 || box.max.x > 13 - 1e-3 || box.max.z > -1e-3 || box.min.z < -9 + 1e-3;
    EXPECT_TRUE(onEdge);
  });
  EXPECT_EQ(static_cast<double>(merlons), 2 * gaps(13) + 2 * gaps(9));
}

TEST(CastleRows, C7_threeKindsOfKeepsAsOften) {
  const Model m =
      derived(importing("Lot --> split(x) { 24 : towers.Keep }*"), Shapes::lot(24 * 150, 22), 3);
  expectChances(reported(m, "keep"), std::vector<double>(3, 1.0 / 3));
  std::set<std::string> looks;
  for (const char* kind : {"1", "2", "3"}) {
    const Model one = derived(importing("Lot --> towers.Keep(" + std::string(kind) + ", 18)"),
                              Shapes::lot(24, 22), 3);
    EXPECT_EQ(joined(faults(sceneOf(one))), "") << kind;
    size_t merlons = 0;
    forEachNamed(one, "Merlon", [&](const Mesh&, const Frame&) { ++merlons; });
    EXPECT_GT(merlons, 60u) << kind;
    const Box3 box = count(sceneOf(one)).bounds;
    // Within its lot, but for copings and strips.
    EXPECT_GT(box.min.x, -0.4);
    EXPECT_LT(box.max.x, 24.4);
    EXPECT_GT(box.min.z, -22.4);
    EXPECT_LT(box.max.z, 0.5);
    looks.insert(one.dump());
  }
  EXPECT_EQ(looks.size(), 3u);
}

TEST(CastleRows, C8_hutsHaveThreePlansAndRoofsOfFourLayers) {
  const Rules rules = importing("Lot --> split(x) { 10 : huts.Hut }*");
  const Model many = derived(rules, Shapes::lot(2400, 9), 2);
  expectChances(reported(many, "hut.plan"), std::vector<double>(3, 1.0 / 3));
  const Model stepped = derived(rules, Shapes::lot(200, 9), 2, {{"huts.roofs", "stepped"}});
  const std::vector<double> layers = reported(stepped, "hut.layer");
  ASSERT_GE(layers.size(), 80u);
  ASSERT_EQ(layers.size() % 4, 0u);
  for (size_t i = 0; i + 3 < layers.size(); i += 4) {
    for (size_t k = 1; k < 4; ++k) {
      EXPECT_NEAR(layers[i + k], 0.8 * layers[i + k - 1], 1e-6);
    }
  }
}

TEST(CastleRows, C9_courtsAreMirroredAboutTwoAxes) {
  const Model m = castleOf(5, {{"planting", "false"}, {"hutCount", "0"}, {"keeps", "1"}});
  const std::vector<double> courts = reported(m, "built.court");
  EXPECT_EQ(courts.size(), 4u);
  std::vector<Vec3> patches;
  forEachNamed(m, "Plants", [&](const Mesh& mesh, const Frame&) {
    const Box3 box = mesh.bounds();
    patches.push_back((box.min + box.max) * 0.5);
  });
  // 2 greens, 11 fields, 4 quarters in each.
  ASSERT_EQ(patches.size(), 4u * 2 * 11 * 4);
  for (size_t court = 0; court < 4; ++court) {
    const auto first = patches.begin() + static_cast<std::ptrdiff_t>(court * 88);
    const std::vector<Vec3> own(first, first + 88);
    Vec3 middle;
    for (const Vec3& p : own) middle += p * (1.0 / 88);
    const auto has = [&](double x, double z) {
      return std::any_of(own.begin(), own.end(), [&](const Vec3& p) {
        return std::fabs(p.x - x) < 1e-6 && std::fabs(p.z - z) < 1e-6;
      });
    };
    for (const Vec3& p : own) {
      EXPECT_TRUE(has(2 * middle.x - p.x, p.z));
      EXPECT_TRUE(has(p.x, 2 * middle.z - p.z));
    }
  }
}

// ---- C10 to C13, C19: the layout
// -----------------------------------------------------------------

TEST(CastleRows, C10_C19_nothingIsNearerThanTheGap) {
  size_t built = 0;
  for (int seed = 1; seed <= seeds(12); ++seed) {
    const Layout castle(sketchOf(seed));
    built += castle.footprints.size();
    ASSERT_GE(castle.footprints.size(), 6u) << "seed " << seed;
    for (size_t i = 0; i < castle.footprints.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        EXPECT_TRUE(intersect({{castle.footprints[i], {}}}, {{castle.footprints[k], {}}}).empty());
        EXPECT_GE(distance(castle.footprints[i], castle.footprints[k]), kGap - 1e-6)
            << "seed " << seed << ": " << k << " and " << i;
      }
    }
  }
  EXPECT_GT(built, 20u * static_cast<size_t>(seeds(12)));
}

// Lanes are as wide as they are drawn: jetties, eaves and copings stay over their own footprint,
// and what stands on the wall stays out of all of them.
TEST(CastleRows, C19_nothingHangsOverTheLanes) {
  const bool all = std::getenv("GABLE_SEEDS") != nullptr;
  for (int seed = 1; seed <= (all ? seeds(0) : 3); ++seed) {
    const Layout plan(sketchOf(seed));
    const Model m = castleOf(seed, {{"planting", "false"}});
    const Scene& scene = sceneOf(m);
    std::map<std::string, double> over;
    forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
      const std::string& file = scene.sources[leaf.source].file;
      if (file.find("huts") == std::string::npos && file.find("towers") == std::string::npos)
        return;
      const Mesh mesh = transformed(*scene.meshes[leaf.mesh], leaf.scale, world);
      for (const Ring& f : plan.footprints) {
        double out = 0, in = 0;
        for (const Vec3& p : mesh.positions) {
          const double depth = signedDistance({f, {}}, {p.x, -p.z});
          out = std::max(out, -depth);
          in = std::max(in, depth);
        }
        // Of its own footprint it covers something.
        double& most = over[scene.sources[leaf.source].rule];
        if (in > 0.01) most = std::max(most, out);
      }
    });
    EXPECT_GT(over.size(), 20u);
    for (const auto& [rule, out] : over) EXPECT_LT(out, 1e-4) << rule << ", seed " << seed;
  }
}

TEST(CastleRows, C11_theWallIsClosedAndHoldsAllBuildings) {
  for (int seed = 1; seed <= seeds(12); ++seed) {
    const Layout castle(sketchOf(seed));
    for (const Ring& f : castle.footprints) {
      for (const Vec2 p : f) {
        // Eight metres outside of the hull, of which the wall and its towers take some.
        EXPECT_GE(signedDistance(castle.yard, p), 8 - 1e-3) << "seed " << seed;
      }
      for (const Ring& t : castle.towers) {
        EXPECT_TRUE(intersect({{f, {}}}, {{t, {}}}).empty()) << "seed " << seed;
      }
    }
    // Wall from tower to tower, but for the gate.
    EXPECT_EQ(castle.gates, 1u);
    EXPECT_NEAR(castle.wall + 21, perimeter(castle.yard.outer), 1e-6) << "seed " << seed;
    EXPECT_GE(castle.towers.size(), castle.yard.outer.size()) << "seed " << seed;
    for (const Vec2 corner : castle.yard.outer) {
      EXPECT_TRUE(std::any_of(castle.towers.begin(), castle.towers.end(),
                              [&](const Ring& t) { return locate(t, corner) == Where::Inside; }))
          << "seed " << seed;
    }
  }
}

TEST(CastleRows, C12_theMoatGoesRoundOutsideTheWall) {
  for (int seed = 1; seed <= seeds(12); ++seed) {
    const Layout castle(sketchOf(seed));
    ASSERT_EQ(castle.water.size(), 1u) << "seed " << seed;
    ASSERT_EQ(castle.water[0].holes.size(), 1u);
    const Region wall = {{castle.yard.outer, {}}};
    EXPECT_TRUE(intersect(castle.water, wall).empty()) << "seed " << seed;
    EXPECT_GT(distance(castle.water[0].holes[0], castle.yard.outer), 4) << "seed " << seed;
    Polygon hole{castle.water[0].holes[0], {}};
    orient(hole);
    for (const Vec2 p : castle.yard.outer) EXPECT_TRUE(contains(hole, p));
    // Smooth: no sharp corner, edges of centimetres left out.
    for (Ring r : {castle.water[0].outer, hole.outer}) {
      dropDuplicates(r, 0.05);
      for (size_t i = 0; i < r.size(); ++i) {
        const Vec2 a = r[(i + 1) % r.size()] - r[i];
        const Vec2 b = r[(i + 2) % r.size()] - r[(i + 1) % r.size()];
        EXPECT_GT(dot(normalized(a), normalized(b)), 0.8) << "seed " << seed;
      }
    }
  }
}

TEST(CastleRows, C13_bigThenSmallThenBigThenSmall) {
  const Model m = castleOf(5, {{"log", "true"}, {"sketch", "true"}});
  const std::vector<std::string>& log = m.prints();
  ASSERT_GE(log.size(), 10u);
  std::vector<std::string> stages;
  for (const std::string& line : log) {
    const std::string what = line.substr(line.find(' ') + 1);
    if (stages.empty() || stages.back() != what) stages.push_back(what);
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"court", "keep", "court", "hut"}));
  // Who came first got the place that was wished: the first court stands in the middle.
  const Layout castle(m);
  const Box2 first = bounds(castle.footprints[0]);
  EXPECT_LT(length(first.center() - Vec2{kLot / 2, kLot / 2}), 1e-3);
}

// What one can walk to from the gate: the yard without the wall, less everything that is built,
// each as wide again as somebody needs.
TEST(CastleLayout, everythingIsReachedFromTheGate) {
  for (int seed = 1; seed <= seeds(12); ++seed) {
    const Layout castle(sketchOf(seed));
    Region built;
    for (const Ring& f : castle.footprints) built.push_back({f, {}});
    for (const Ring& t : castle.towers) built.push_back({t, {}});
    const double half = 0.6;
    const Region free = subtract(offset({castle.yard}, -2.4 - half), offset(built, half));
    const Polygon* way = nullptr;
    for (const Polygon& p : free) {
      if (contains(p, castle.insideGate)) way = &p;
    }
    ASSERT_NE(way, nullptr) << "seed " << seed;
    for (const Ring& f : castle.footprints) {
      double least = HUGE_VAL;
      for (const Vec2 p : f) least = std::min(least, distanceToBoundary(*way, p));
      EXPECT_LT(least, half * 1.5) << "seed " << seed;
    }
  }
}

// ---- C16 to C18: what comes out
// ------------------------------------------------------------------

class Written : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("gable-castle-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               "-" + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const Model& m, const std::string& name) {
    const std::string path = (folder_ / name).string();
    EXPECT_TRUE(m.write(path, WriteSettings{}).ok);
    return path;
  }
  std::filesystem::path folder_;
};

std::string bytesOf(const std::string& path) {
  std::string out;
  std::FILE* in = std::fopen(path.c_str(), "rb");
  if (!in) return out;
  char buffer[65536];
  for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, in)) > 0;) out.append(buffer, n);
  std::fclose(in);
  return out;
}

TEST_F(Written, C16_objComesBackWithItsTrianglesAndMaterials) {
  const Model m = castleOf(5, {{"planting", "false"}});
  const Model back = Model::load(write(m, "castle.obj"));
  ASSERT_TRUE(back.ok()) << render(back.diagnostics());
  EXPECT_EQ(count(sceneOf(back)).triangles, count(sceneOf(m)).triangles);
  const std::string mtl = bytesOf((folder_ / "castle.mtl").string());
  size_t materials = 0;
  for (size_t at = 0; (at = mtl.find("newmtl ", at)) != std::string::npos; ++at) ++materials;
  EXPECT_GT(materials, 20u);
  EXPECT_EQ(count(sceneOf(back)).materials, materials);
}

TEST_F(Written, C18_oneSeedGivesOneCastle) {
  const std::string once = bytesOf(write(castleOf(7, {{"planting", "false"}}), "once.obj"));
  const std::string again = bytesOf(write(castleOf(7, {{"planting", "false"}}), "once.obj"));
  const std::string other = bytesOf(write(castleOf(8, {{"planting", "false"}}), "once.obj"));
  EXPECT_GT(once.size(), 1000000u);
  EXPECT_TRUE(once == again);
  EXPECT_FALSE(once == other);
}

// A tower on a plain, from above.
TEST(CastleRows, C17_thePictureHasShadowsAndAmbientOcclusion) {
  const Model m = derived(importing("Lot --> [ color(\"#b3a27f\") Yard. ] t(30, 0, 30) s(0, 0, 0) "
                                    "towers.TowerOf(6, 4, 4, \"#b9ab8c\")"),
                          Shapes::lot(60, 60), 1, {{"towers.sides", "10"}, {"towers.radius", "4"}});
  RenderOptions options;
  options.width = options.height = 160;
  options.view = PictureView::Top;
  options.samples = 16;
  const auto lightAt = [&](const Picture& p, double x, double z) {
    const double metre = 80 / p.camera.halfWidth;
    const auto column = static_cast<size_t>(80 + (x - p.camera.eye.x) * metre);
    const auto row = static_cast<size_t>(80 + (z - p.camera.eye.z) * metre);
    const float* rgb = &p.image.rgb.at(3 * (row * 160 + column));
    return static_cast<double>(rgb[0]) + rgb[1] + rgb[2];
  };
  // Round the tower lies its shadow on one side, and light on the other.
  const Picture sunny = render(sceneOf(m), options);
  double least = HUGE_VAL, most = 0;
  for (const auto& [x, z] :
       {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
    const double light = lightAt(sunny, 30 + 8.0 * x, -30 + 8.0 * z);
    least = std::min(least, light);
    most = std::max(most, light);
  }
  EXPECT_LT(least, 0.5 * most);
  // Under an even sky the ground is darker the nearer the wall is.
  options.uniformSky = Vec3{1, 1, 1};
  const Picture dull = render(sceneOf(m), options);
  const double foot = lightAt(dull, 30 + 7, -30), near = lightAt(dull, 30 + 12, -30);
  const double far = lightAt(dull, 30 + 27, -30);
  EXPECT_LT(foot, 0.97 * near);
  EXPECT_LT(near, 0.99 * far);
}

// ---- Whole castles
// -------------------------------------------------------------------------------

TEST(Castles, areSound) {
  for (int seed = 1; seed <= seeds(4); ++seed) {
    const Model m = castleOf(100 + seed);
    EXPECT_EQ(joined(faults(sceneOf(m))), "") << "seed " << 100 + seed;
    EXPECT_GT(count(sceneOf(m)).leaves, 15000u);
    for (const char* what : {"built.court", "built.keep", "gate"}) {
      EXPECT_FALSE(reported(m, what).empty()) << what;
    }
  }
}

TEST(Castles, threadsAndSharingChangeNothing) {
  DeriveSettings settings;
  settings.seed = 11;
  settings.jobs = 2;
  settings.attributes = {{"planting", "false"}, {"hutCount", "15"}};
  const Model two = derive(castle(), Shapes::lot(kLot, kLot), settings);
  settings.jobs = 1;
  settings.sharing = false;
  const Model one = derive(castle(), Shapes::lot(kLot, kLot), settings);
  EXPECT_TRUE(one.dump() == two.dump());
}

TEST(Castles, standOnLotsOfOtherRules) {
  const Rules rules = Rules::parse(
      "version \"2025.1\"\nimport castle : \"castle/castle.cga\"\n"
      "Lot --> split(x) { 240 : t(0, 3, 0) castle.Lot | ~1 : Field. }",
      source("examples/town/test.cga"));
  const Model m = derived(rules, Shapes::lot(400, 240), 3);
  EXPECT_EQ(reported(m, "gate").size(), 1u);
  const Box3 box = count(sceneOf(m)).bounds;
  EXPECT_GE(box.min.y, -0.01);
  forEachNamed(m, "Yard", [&](const Mesh& mesh, const Frame&) {
    EXPECT_NEAR(mesh.bounds().min.y, 3 + 9 + 0.05, 1e-6);
    EXPECT_LT(mesh.bounds().max.x, 240);
  });
}

TEST(Castles, fitSmallerLots) {
  for (const double side : {10.0, 30.0, 80.0, 170.0, 240.0}) {
    const Model m = derived(castle(), Shapes::lot(side, side), 3);
    EXPECT_EQ(joined(faults(sceneOf(m))), "") << side;
    EXPECT_GT(count(sceneOf(m)).leaves, 5u) << side;
  }
}

}  // namespace
}  // namespace gable
