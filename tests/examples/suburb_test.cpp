// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The suburb, feature by feature: each test is named after its row in the table of features that
// the example promises. Counts and frequencies are those of reports, geometry that of leaves.
// Houses in rows of their own are drawn without detail, every body as the house model.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "geom/curve/curve.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"
#include "geom/region/hull.h"
#include "io/importers/mtl_file.h"
#include "io/importers/obj_file.h"
#include "math/trig.h"
#include "scene/flatten.h"

namespace gable {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

constexpr double kUnit = 2, kSide = 320;
const std::string kFolder = std::string(GABLE_SOURCE_DIR) + "/examples/suburb/";

Model derivedFrom(const Rules& rules, double width, double depth, double seed, Settings set) {
  EXPECT_FALSE(hasErrors(rules.diagnostics())) << render(rules.diagnostics());
  DeriveSettings settings;
  settings.seed = seed;
  settings.jobs = 2;
  // A hundred thousand houses take about four gigabytes.
  settings.limits.bytes = uint64_t{8} << 30;
  settings.attributes = std::move(set);
  Model model = derive(rules, Shapes::lot(width, depth), settings);
  EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
  return model;
}

Model suburb(double seed, Settings set = {}) {
  return derivedFrom(Rules::load(kFolder + "suburb.cga"), kSide, kSide, seed, std::move(set));
}

// Rules of ours that use the suburb's as `s`.
Rules rulesWith(const std::string& text) {
  return Rules::parse("import s : \"suburb.cga\"\n" + text, kFolder + "rows.cga");
}

// Plain houses, unturned, in rows of 20 m from place to place: `rows` rows of `columns`. The first
// row is `z` units south of the middle of the plan, the others lie to the north of it.
Model houses(size_t columns, size_t rows, double z, Settings set = {}, double seed = 1) {
  const Rules rules = rulesWith(
      "@StartRule Lot --> split(z) { 20 : split(x) { 20 : t(10, 0, 10) s(0, 0, 0) s.House }* }*");
  set.emplace_back("s.detail", "false");
  set.emplace_back("s.planting", "false");
  std::ostringstream middle;
  middle << -10 - z * kUnit;
  set.emplace_back("s.middleZ", middle.str());
  return derivedFrom(rules, 20.0 * static_cast<double>(columns), 20.0 * static_cast<double>(rows),
                     seed, std::move(set));
}

const Scene& sceneOf(const Model& m) { return m.impl().result.scene; }

std::map<std::string, double> countsOf(const Model& m, const std::string& key) {
  std::map<std::string, double> out;
  for (const Report& r : sceneOf(m).reports) {
    if (r.key != key) continue;
    out[r.value.kind == PlainValue::Kind::Text
            ? r.value.text
            : std::to_string(static_cast<int>(r.value.number))] += 1;
  }
  return out;
}

double countOf(const Model& m, const std::string& key) {
  double n = 0;
  for (const auto& [value, count] : countsOf(m, key)) n += count;
  return n;
}

std::string colorOf(const Scene& scene, const Leaf& leaf) {
  const Vec3 c = materialOf(scene, leaf, 0).color;
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(std::lround(c.x * 255)),
                static_cast<unsigned>(std::lround(c.y * 255)),
                static_cast<unsigned>(std::lround(c.z * 255)));
  return text;
}

struct Piece {
  std::string name, color;
  Mesh mesh;
  Frame frame;
};

// The leaves of a model by house: each begins with its drive.
std::vector<std::vector<Piece>> housesOf(const Model& m) {
  std::vector<std::vector<Piece>> out;
  const Scene& scene = sceneOf(m);
  bool inDrive = false;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    Piece p{scene.names[leaf.name], colorOf(scene, leaf),
            transformed(*scene.meshes[leaf.mesh], leaf.scale, world), world};
    const bool drive = p.name == "Concrete";
    if (drive && !inDrive) out.emplace_back();
    inDrive = drive;
    if (!out.empty()) out.back().push_back(std::move(p));
  });
  return out;
}

struct Body {
  Box3 walls;
  // Along the narrow flat top of the roof.
  Vec3 ridge;
};

// The bodies of a plain house, the one at the back first: four walls and six faces of roof each.
std::vector<Body> bodiesOf(const std::vector<Piece>& house) {
  std::vector<Body> out;
  size_t walls = 0, roofs = 0;
  for (const Piece& p : house) {
    if (p.name == "Wall") {
      if (walls++ % 4 == 0) out.emplace_back();
      out.back().walls.include(p.mesh.bounds().min);
      out.back().walls.include(p.mesh.bounds().max);
    }
    if (p.name != "Roof" || p.mesh.normal(0).y < 0.999) continue;
    ++roofs;
    const auto ends = p.mesh.loopsOf(0)[0];
    Vec3 longest;
    for (uint32_t i = 0; i < ends.cornerCount; ++i) {
      const Vec3 edge = p.mesh.at(ends.firstCorner + (i + 1) % ends.cornerCount) -
                        p.mesh.at(ends.firstCorner + i);
      if (length(edge) > length(longest)) longest = edge;
    }
    out.back().ridge = normalized(longest);
  }
  EXPECT_EQ(walls % 4, 0u);
  EXPECT_EQ(roofs, out.size());
  return out;
}

// Squares of differences to what is expected, in shares of it.
double chiSquare(const std::vector<std::pair<double, double>>& foundAndExpected) {
  double sum = 0;
  for (const auto& [found, expected] : foundAndExpected) {
    sum += (found - expected) * (found - expected) / expected;
  }
  return sum;
}

TEST(SuburbRows, S1PartsOfAHouseShareItsColours) {
  const auto all = housesOf(houses(40, 5, 0));
  ASSERT_EQ(all.size(), 200u);
  std::set<std::string> dressed;
  for (const auto& house : all) {
    std::set<std::string> walls, roofs;
    for (const Piece& p : house) {
      if (p.name == "Wall" || p.name == "Chimney") walls.insert(p.color);
      if (p.name == "Roof") roofs.insert(p.color);
    }
    EXPECT_EQ(walls.size(), 1u);
    EXPECT_EQ(roofs.size(), 1u);
    dressed.insert(*walls.begin() + *roofs.begin());
  }
  EXPECT_EQ(dressed.size(), 6u);
}

// S2 and S11 on a hundred thousand houses.
TEST(SuburbRows, S2AndS11SharesOfConfigurationsAndColours) {
  const Model m = houses(500, 200, 0);
  const double n = countOf(m, "houses");
  ASSERT_EQ(n, 100000);
  const auto shares = [&](const std::string& key, const std::map<std::string, double>& expected) {
    auto found = countsOf(m, key);
    EXPECT_EQ(found.size(), expected.size()) << key;
    for (const auto& [value, share] : expected) EXPECT_NEAR(found[value] / n, share, 0.01) << value;
  };
  shares("config", {{"one", 0.2}, {"two", 0.4}, {"three", 0.4}});
  shares("roofs", {{"#585756", 0.6}, {"#8e8e8e", 0.4}});
  shares("walls", {{"#acd2f3", 0.2}, {"#efece4", 0.4}, {"#dcc695", 0.4}});
  shares("doors", {{"#c9c6c6", 0.2}, {"#363636", 0.2}, {"#8a2020", 0.2}, {"#69411d", 0.4}});
}

TEST(SuburbRows, S3ATurnedHouseIsTheHouseTurned) {
  const Rules rules =
      rulesWith("attr turn = 0\n@StartRule Lot --> t(10, 0, 10) s(0, 0, 0) r(0, turn, 0) s.House");
  for (const double seed : {1.0, 2.0, 3.0, 4.0, 5.0}) {
    const auto at = [&](const char* turn) {
      return derivedFrom(rules, 20, 20, seed,
                         {{"turn", turn}, {"s.planting", "false"}, {"s.middleZ", "-10"}});
    };
    const Model straight = at("0"), turned = at("37");
    const auto a = flatLeaves(sceneOf(straight)), b = flatLeaves(sceneOf(turned));
    ASSERT_EQ(a.size(), b.size());
    ASSERT_GT(a.size(), 100u);
    const double c = cosDeg(37), s = sinDeg(37);
    double worst = 0;
    std::string where;
    for (size_t i = 0; i < a.size(); ++i) {
      const Mesh m = worldMesh(sceneOf(straight), a[i]), n = worldMesh(sceneOf(turned), b[i]);
      ASSERT_EQ(m.positions.size(), n.positions.size());
      for (size_t k = 0; k < m.positions.size(); ++k) {
        const Vec3 d = m.positions[k] - Vec3{10, 0, -10};
        const Vec3 expected = Vec3{10, 0, -10} + Vec3{c * d.x + s * d.z, d.y, c * d.z - s * d.x};
        if (length(n.positions[k] - expected) > worst)
          where = sceneOf(straight).names[a[i].leaf->name];
        worst = std::max(worst, length(n.positions[k] - expected));
      }
    }
    EXPECT_LT(worst, 1e-5) << where << ", seed " << seed;
  }
}

TEST(SuburbRows, S4OneWingLeftOrRightWithItsAnnex) {
  const auto all = housesOf(houses(60, 1, 0, {{"s.oneWing", "1"}}));
  // By the side of the wing: its box and the annex's, seen from the middle of the house.
  std::map<bool, std::pair<Box3, Box3>> found;
  for (size_t i = 0; i < all.size(); ++i) {
    const Vec3 middle{20.0 * static_cast<double>(i) + 10, 0, -10};
    const auto bodies = bodiesOf(all[i]);
    ASSERT_EQ(bodies.size(), 3u);
    const auto local = [&](Box3 b) { return Box3{b.min - middle, b.max - middle}; };
    const Box3 back = local(bodies[0].walls), wing = local(bodies[1].walls),
               annex = local(bodies[2].walls);
    const auto touch = [](const Box3& a, const Box3& b) {
      return a.min.x <= b.max.x + 0.01 && b.min.x <= a.max.x + 0.01 && a.min.z <= b.max.z + 0.01 &&
             b.min.z <= a.max.z + 0.01;
    };
    EXPECT_TRUE(touch(annex, wing));
    EXPECT_TRUE(touch(annex, back));
    EXPECT_NEAR(annex.size().y, 0.75 * wing.size().y, 1e-6);
    found[wing.center().x > 0] = {wing, annex};
  }
  ASSERT_EQ(found.size(), 2u);
  const auto mirrored = [](const Box3& b) {
    return Box3{{-b.max.x, b.min.y, b.min.z}, {-b.min.x, b.max.y, b.max.z}};
  };
  for (const auto& [a, b] : {std::pair{found[true].first, found[false].first},
                             std::pair{found[true].second, found[false].second}}) {
    EXPECT_LT(length(mirrored(a).min - b.min), 1e-6);
    EXPECT_LT(length(mirrored(a).max - b.max), 1e-6);
  }
}

TEST(SuburbRows, S5RidgesOfGablesCrossThatOfTheBody) {
  const auto all = housesOf(houses(100, 1, 0, {{"s.oneWing", "0"}}));
  size_t gables = 0;
  for (const auto& house : all) {
    const auto bodies = bodiesOf(house);
    for (size_t i = 1; i < bodies.size(); ++i, ++gables) {
      EXPECT_LT(std::fabs(dot(bodies[i].ridge, bodies[0].ridge)), 1e-6);
    }
  }
  EXPECT_GT(gables, 150u);
}

TEST(SuburbRows, S6GablesAtTheMiddleOfThePlan) {
  // Gables stand half a unit in front of the house.
  const Model m = houses(5000, 1, -0.5, {{"s.oneWing", "0"}});
  auto found = countsOf(m, "gable");
  const double n = countOf(m, "gable");
  ASSERT_GT(n, 10000);
  // Three degrees of freedom: beyond 16.3 once in a thousand.
  EXPECT_LT(chiSquare({{found["none"], 0.2 * n},
                       {found["same"], 0.2 * n},
                       {found["low"], 0.2 * n},
                       {found["high"], 0.4 * n}}),
            16.3);
}

TEST(SuburbRows, S7TallBodiesByPlaceAndOneChimneyEach) {
  for (const auto& [z, share] :
       {std::pair{-40.0, 0.8}, std::pair{0.0, 0.5}, std::pair{40.0, 0.2}}) {
    const Model m = houses(5000, 1, z);
    EXPECT_NEAR(countsOf(m, "tall")["1"] / 5000, share, 0.025) << z;
    EXPECT_EQ(countOf(m, "chimneys"), 5000);
    EXPECT_NEAR(countsOf(m, "chimneys")["1"] / 5000, 0.5, 0.025);
  }
  // As shipped: what stays low is drawn again, with a second chimney.
  const Model shipped = houses(5000, 1, -40, {{"s.mode", "shipped"}});
  EXPECT_NEAR(countsOf(shipped, "tall")["1"] / 5000, 0.96, 0.015);
  EXPECT_NEAR(countOf(shipped, "chimneys") / 5000, 1.2, 0.025);
}

TEST(SuburbRows, S8BodiesStandOnTheGround) {
  for (const auto& house : housesOf(houses(200, 1, 0))) {
    for (const Body& b : bodiesOf(house)) EXPECT_NEAR(b.walls.min.y, 0, 0.05 * kUnit);
  }
  double lowest = 1;
  const Model m = suburb(1);
  forEachLeaf(sceneOf(m), [&](const Leaf& leaf, const Frame& world) {
    if (sceneOf(m).names[leaf.name] != "Wall") return;
    lowest = std::min(lowest,
                      transformed(*sceneOf(m).meshes[leaf.mesh], leaf.scale, world).bounds().min.y);
  });
  EXPECT_GE(lowest, -0.05 * kUnit);
}

TEST(SuburbRows, S9OneDoorBeforeAWall) {
  const auto all = housesOf(houses(1000, 10, 0));
  ASSERT_EQ(all.size(), 10000u);
  for (const auto& house : all) {
    const auto bodies = bodiesOf(house);
    size_t leaves = 0;
    Box3 door;
    for (const Piece& p : house) {
      if (p.name != "DoorEdge") continue;
      door.include(p.mesh.bounds().min);
      door.include(p.mesh.bounds().max);
      ++leaves;
    }
    // The sides and the top of one leaf.
    ASSERT_EQ(leaves, 3u);
    const Vec3 middle = door.center();
    const bool alongX = door.size().x > door.size().z;
    const auto inside = [&](const Vec3& q) {
      return std::any_of(bodies.begin(), bodies.end(), [&](const Body& b) {
        return q.x > b.walls.min.x && q.x < b.walls.max.x && q.z > b.walls.min.z &&
               q.z < b.walls.max.z;
      });
    };
    EXPECT_FALSE(inside(middle));
    const Vec3 step = alongX ? Vec3{0, 0, 0.1} : Vec3{0.1, 0, 0};
    // A wall close behind, on one side alone.
    EXPECT_NE(inside(middle + step), inside(middle - step));
  }
}

TEST(SuburbRows, S10HeightsFallTowardsTheSouth) {
  double lastBody = 1e9, lastGable = 1e9;
  for (const double z : {-40.0, -20.0, 0.0, 20.0, 40.0}) {
    const Model m = houses(8000, 1, z, {{"s.oneWing", "0"}});
    auto gables = countsOf(m, "gable");
    const double kept = gables["same"] + gables["low"] + gables["high"];
    const double body = 1 + 0.5 * countsOf(m, "tall")["1"] / 8000;
    const double gable = (gables["same"] + 1.25 * gables["low"] + 1.5 * gables["high"]) / kept;
    EXPECT_LT(body, lastBody) << z;
    EXPECT_LT(gable, lastGable) << z;
    lastBody = body;
    lastGable = gable;
  }
}

TEST(SuburbRows, S12UprightFacesHaveTheWallsMaterial) {
  const Model m = houses(20, 1, 0);
  const std::string path = ::testing::TempDir() + "suburb_rows.obj";
  ASSERT_TRUE(m.write(path, {}).ok);
  const auto textOf = [](const std::string& file) {
    std::ostringstream out;
    out << std::ifstream(file).rdbuf();
    return out.str();
  };
  const ObjFile obj = parseObj(textOf(path));
  std::map<std::string, Material> materials;
  std::vector<std::string> losses;
  const std::string mtl = textOf(::testing::TempDir() + "suburb_rows.mtl");
  for (const Material& one : parseMtl(mtl, path, losses)) materials[one.name] = one;
  EXPECT_TRUE(losses.empty());
  const auto is = [&](const ObjFace& f, std::initializer_list<const char*> colors) {
    const Vec3 c = materials.at(obj.materials.at(f.material)).color;
    return std::any_of(colors.begin(), colors.end(), [&](const char* hex) {
      unsigned r = 0, g = 0, b = 0;
      std::sscanf(hex, "#%02x%02x%02x", &r, &g, &b);
      return std::fabs(c.x * 255 - r) < 0.6 && std::fabs(c.y * 255 - g) < 0.6 &&
             std::fabs(c.z * 255 - b) < 0.6;
    });
  };
  size_t walls = 0, roofs = 0;
  for (const ObjFace& f : obj.faces) {
    const auto at = [&](uint32_t i) {
      return obj.positions[obj.corners[f.firstCorner + i].position];
    };
    const Vec3 n = normalized(cross(at(1) - at(0), at(2) - at(0)));
    if (is(f, {"#585756", "#8e8e8e"})) {
      ++roofs;
      EXPECT_GT(std::fabs(n.y), 1e-4);
    } else if (std::fabs(n.y) < 1e-4 && is(f, {"#acd2f3", "#efece4", "#dcc695"})) {
      ++walls;
    }
  }
  EXPECT_GT(walls, 100u);
  EXPECT_GT(roofs, 100u);
}

// A suburb with its centre lines: marks every half metre along each street.
struct Plan {
  Model model;
  std::vector<Line> lines;
  std::vector<std::vector<Vec2>> points;

  explicit Plan(double seed, Settings set = {}, bool whole = true)
      : model(derived(seed, std::move(set), whole)) {
    lines.resize(5);
    points.resize(5);
    double x = 0;
    for (const Report& r : sceneOf(model).reports) {
      const double v = r.value.number;
      if (r.key == "mark.x" || r.key == "point.x") x = v;
      if (r.key.starts_with("mark.z")) lines[index(r.key)].push_back({x, -v});
      if (r.key.starts_with("point.z")) points[index(r.key)].push_back({x, -v});
    }
  }

 private:
  static size_t index(const std::string& key) { return static_cast<size_t>(key.back() - '0'); }
  static Model derived(double seed, Settings set, bool whole) {
    static const Rules rules = rulesWith(R"(
attr whole = true
@StartRule Lot --> [ Whole ] set(s.planSize, min(scope.sx, scope.sz) / s.unit) Marks(0)
Whole --> case whole: s.Lot else: NIL
Marks(k) --> case k < 5: [ Points(k, 0) ] [ curve(catmullRom, s.street(k)) along(0.5, 0, 0, stretch) { all : Mark(k) } ] Marks(k + 1)
  else: NIL
Mark(k) --> report("mark.x", world.x) report("mark.z" + k, world.z) NIL
Points(k, i) --> case i < 5: [ t(s.street(k)[i, 0], 0, s.street(k)[i, 1]) Point(k) ] Points(k, i + 1) else: NIL
Point(k) --> report("point.x", world.x) report("point.z" + k, world.z) NIL
)");
    set.emplace_back("s.detail", "false");
    set.emplace_back("s.planting", "false");
    set.emplace_back("s.outskirts", "false");
    set.emplace_back("whole", whole ? "true" : "false");
    return derivedFrom(rules, kSide, kSide, seed, std::move(set));
  }
};

TEST(SuburbRows, S13StreetsPassThroughTheirPoints) {
  double farthest = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const double jitter = seed % 2 ? 5 : 6;
    const Plan plan(seed, {{"s.jitter", seed % 2 ? "5" : "6"}}, false);
    for (size_t k = 0; k < 5; ++k) {
      ASSERT_EQ(plan.points[k].size(), 5u);
      const Path path(plan.lines[k]);
      for (size_t i = 0; i < 5; ++i) {
        const Vec2 p = plan.points[k][i];
        EXPECT_NEAR(p.x, 40 + 60 * static_cast<double>(i), 1e-9);
        EXPECT_LT(length(path.at(path.nearest(p)).point - p), 0.01);
        // The lot lies to the north of the world's origin.
        const double off = (kSide - p.y) / kUnit - (40 + 20 * static_cast<double>(k));
        EXPECT_LE(std::fabs(off), jitter + 1e-9);
        farthest = std::max(farthest, std::fabs(off) / jitter);
        if (k > 0) {
          EXPECT_GE((plan.points[k - 1][i].y - p.y) / kUnit, 15 - 1e-9);
        }
      }
    }
  }
  EXPECT_GT(farthest, 0.95);
}

std::vector<Polygon> roadwaysOf(const Model& m) {
  std::vector<Polygon> out;
  const Frame ground = Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  forEachLeaf(sceneOf(m), [&](const Leaf& leaf, const Frame& world) {
    if (sceneOf(m).names[leaf.name] != "Asphalt") return;
    const Mesh mesh = transformed(*sceneOf(m).meshes[leaf.mesh], leaf.scale, world);
    for (size_t f = 0; f < mesh.faceCount(); ++f) out.push_back(facePolygon(mesh, f, ground));
  });
  return out;
}

TEST(SuburbRows, S14RoadsHaveNoGaps) {
  for (const double seed : {1.0, 2.0}) {
    const Plan plan(seed);
    const Region roads = offset(roadwaysOf(plan.model), 0.005);
    for (const Line& line : plan.lines) {
      for (const Vec2 p : line) {
        EXPECT_TRUE(std::any_of(roads.begin(), roads.end(),
                                [&](const Polygon& r) { return contains(r, p); }));
      }
    }
  }
}

// The middle of each house, and its axes, from the first slab of its drive.
std::vector<Frame> placesOf(const Model& m) {
  std::vector<Frame> out;
  bool inDrive = false;
  forEachLeaf(sceneOf(m), [&](const Leaf& leaf, const Frame& world) {
    const bool drive = sceneOf(m).names[leaf.name] == "Concrete";
    if (drive && !inDrive) {
      Frame f = world;
      f.origin = world.point({3.75 * kUnit, 0, -0.4 * kUnit});
      out.push_back(f);
    }
    inDrive = drive;
  });
  return out;
}

TEST(SuburbRows, S15HousesStandAlongTheStreetsAndFaceThem) {
  for (const double seed : {1.0, 2.0, 3.0}) {
    const Plan plan(seed);
    const auto places = placesOf(plan.model);
    // By the formula: stations 4, 12, 20.. below the length less 8, on both sides.
    size_t expected = 0;
    for (const Line& line : plan.lines) {
      for (double k = 4; k < Path(line).length() / kUnit - 8; k += 8) expected += 2;
    }
    EXPECT_EQ(places.size(), expected);
    EXPECT_GE(places.size(), 140u);
    EXPECT_LE(places.size(), 150u);
    size_t next = 0;
    for (const Line& line : plan.lines) {
      const Path path(line);
      const size_t side = static_cast<size_t>(std::ceil((path.length() / kUnit - 12) / 8));
      double last = 0;
      for (size_t i = 0; i < 2 * side && next < places.size(); ++i, ++next) {
        const Frame& f = places[next];
        const Vec2 p{f.origin.x, -f.origin.z};
        const double s = path.nearest(p);
        const Path::Place at = path.at(s);
        EXPECT_NEAR(length(p - at.point), 4 * kUnit, 0.01);
        // The front looks at the road.
        const Vec2 front{f.z.x, -f.z.z};
        EXPECT_GT(dot(front, normalized(at.point - p)), 0.9999);
        const Vec2 along{f.x.x, -f.x.z};
        // Half a metre of line is a chord: its direction is that of its middle.
        const Vec2 tangent = normalized(path.at(s + 0.25).point - path.at(s - 0.25).point);
        EXPECT_LT(acosDeg(std::min(1.0, std::fabs(dot(along, tangent)))), 0.5);
        if (i % side > 0) {
          // Found on the chords between marks.
          EXPECT_NEAR(std::fabs(s - last), 8 * kUnit, 0.1);
        }
        last = s;
      }
    }
  }
}

TEST(SuburbRows, S16ADriveForEachHouse) {
  const Plan plan(4);
  EXPECT_EQ(countOf(plan.model, "drives"), countOf(plan.model, "houses"));
  for (const auto& house : housesOf(plan.model)) {
    for (const Piece& p : house) {
      if (p.name != "Concrete") continue;
      for (const Vec3& v : p.mesh.positions) {
        double away = 1e9;
        for (const Line& line : plan.lines) {
          const Path path(line);
          const Vec2 q{v.x, -v.z};
          away = std::min(away, length(path.at(path.nearest(q)).point - q));
        }
        // Between the roadway and the house's own line, from which the road bends away beside it.
        EXPECT_GT(away, 1.2 * kUnit);
        EXPECT_LT(away, 4.4 * kUnit);
      }
    }
  }
}

TEST(SuburbRows, S17TreesStandWhereThereIsRoom) {
  double trees = 0, sites = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    const Plan plan(seed);
    auto found = countsOf(plan.model, "trees");
    trees += found["1"];
    sites += found["0"] + found["1"];
    std::vector<Path> paths;
    for (const Line& line : plan.lines) paths.emplace_back(line);
    std::vector<Box3> walls;
    for (const auto& house : housesOf(plan.model)) {
      for (const Piece& p : house) {
        if (p.name == "Wall") walls.push_back(p.mesh.bounds());
      }
    }
    size_t trunks = 0;
    forEachLeaf(sceneOf(plan.model), [&](const Leaf& leaf, const Frame& world) {
      if (sceneOf(plan.model).names[leaf.name] != "Bark") return;
      ++trunks;
      const Mesh bark = transformed(*sceneOf(plan.model).meshes[leaf.mesh], leaf.scale, world);
      // The wood is one with its boughs: where it stands is the middle of its foot.
      const double ground = bark.bounds().min.y;
      Box3 foot;
      for (const Vec3& at : bark.positions) {
        if (at.y < ground + 0.05) foot.include(at);
      }
      const Vec3 c = foot.center();
      const Vec2 p{c.x, -c.z};
      for (const Path& path : paths) {
        EXPECT_GE(length(path.at(path.nearest(p)).point - p), 6 * kUnit);
      }
      for (const Box3& b : walls) {
        EXPECT_FALSE(c.x > b.min.x && c.x < b.max.x && c.z > b.min.z && c.z < b.max.z);
      }
    });
    EXPECT_GE(static_cast<double>(trunks), found["1"]);
  }
  EXPECT_GT(sites, 1500);
  EXPECT_NEAR(trees / sites, 0.5, 0.03);
}

TEST(SuburbRows, S18LampsOnBothSidesOfAllStreets) {
  for (const double seed : {1.0, 2.0, 3.0})
    EXPECT_EQ(countOf(suburb(seed, {{"detail", "false"}}), "lamps"), 162);
}

TEST(SuburbRows, S18NoLampStandsInACarriageway) {
  constexpr double kRoad = 2.4 * kUnit, kMiddle = kSide / 2;
  for (int seed = 1; seed <= 12; ++seed) {
    const Plan plan(seed);
    std::vector<Path> streets;
    for (const Line& line : plan.lines) streets.emplace_back(line);
    for (const double x : {kMiddle - 60 * kUnit, kMiddle + 60 * kUnit}) {
      streets.emplace_back(Line{{x, -kSide}, {x, 0}});
    }
    size_t posts = 0;
    forEachLeaf(sceneOf(plan.model), [&](const Leaf& leaf, const Frame& world) {
      if (sceneOf(plan.model).names[leaf.name] != "Iron") return;
      const Box3 box =
          transformed(*sceneOf(plan.model).meshes[leaf.mesh], leaf.scale, world).bounds();
      if (box.size().y < 4) return;
      ++posts;
      const Vec2 foot{box.center().x, -box.center().z};
      for (const Path& street : streets) {
        EXPECT_GT(length(street.at(street.nearest(foot)).point - foot), kRoad / 2) << seed;
      }
    });
    EXPECT_EQ(posts, countOf(plan.model, "lamps"));
  }
}

TEST(SuburbRows, S19AnotherModelMakesOtherHouses) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(::testing::TempDir()) / "suburb_model";
  fs::remove_all(folder);
  fs::create_directories(folder / "rules");
  fs::copy(kFolder + "suburb.cga", folder);
  fs::copy(kFolder + "house.obj", folder);
  for (const char* shared : {"trees.cga", "parts.cga"}) {
    fs::copy(kFolder + "../rules/" + shared, folder / "rules");
  }
  const auto facesOf = [&] {
    const Model m = derivedFrom(Rules::load((folder / "suburb.cga").string()), kSide, kSide, 1,
                                {{"detail", "false"}, {"outskirts", "false"}});
    const double bodies = countOf(m, "bodies");
    size_t roofs = 0;
    forEachLeaf(sceneOf(m), [&](const Leaf& leaf, const Frame&) {
      if (sceneOf(m).names[leaf.name] == "Roof") ++roofs;
    });
    return static_cast<double>(roofs) / bodies;
  };
  EXPECT_EQ(facesOf(), 6);
  // A tent: no walls but its ends.
  std::ofstream(folder / "house.obj")
      << "v 0 0 0\nv 4 0 0\nv 4 0 -4\nv 0 0 -4\nv 0 3 -2\nv 4 3 -2\n"
         "f 1 2 6 5\nf 3 4 5 6\nf 1 5 4\nf 2 3 6\n";
  EXPECT_EQ(facesOf(), 2);
}

TEST(SuburbRows, S21ASeedIsASuburb) {
  const auto bytesOf = [](double seed, const std::string& name) {
    const std::string path = ::testing::TempDir() + name;
    EXPECT_TRUE(suburb(seed).write(path, {}).ok);
    std::ostringstream out;
    out << std::ifstream(path, std::ios::binary).rdbuf();
    return out.str();
  };
  const std::string first = bytesOf(7, "suburb_a.glb");
  EXPECT_GT(first.size(), 100000u);
  EXPECT_TRUE(first == bytesOf(7, "suburb_b.glb"));
  EXPECT_FALSE(first == bytesOf(8, "suburb_c.glb"));
  // What the plan is made of can be set.
  EXPECT_GE(Rules::load(kFolder + "suburb.cga").attributes().size(), 15u);
}

}  // namespace
}  // namespace gable
