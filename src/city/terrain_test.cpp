// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Places on hills, in steep valleys and at coasts: what terrain.h and drape.h promise.
#include "city/terrain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <tuple>

#include "base/child_process.h"
#include "base/files.h"
#include "city/drape.h"
#include "city/plan.h"
#include "city/plan_mesh.h"
#include "scene/flatten.h"

namespace gable {
namespace {

using HeightFunction = std::function<double(Vec2)>;

// Of plan coordinates about the middle of the place.
HeightField fieldOf(const Box2& area, double step, const HeightFunction& height) {
  const Vec2 from = area.min - Vec2{60, 60};
  const auto columns = static_cast<uint32_t>((area.size().x + 120) / step) + 2;
  const auto rows = static_cast<uint32_t>((area.size().y + 120) / step) + 2;
  std::vector<double> heights;
  for (uint32_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      heights.push_back(height(from + Vec2{c * step, r * step}));
    }
  }
  return {from, step, columns, std::move(heights)};
}

std::string feature(const std::string& tags, const std::string& kind, const std::string& at) {
  return R"({"type":"Feature","properties":{)" + tags + R"(},"geometry":{"type":")" + kind +
         R"(","coordinates":)" + at + "}}";
}

// The plan's origin is the middle of the box.
MapFeatures mapOf(const std::vector<std::string>& features) {
  std::string text =
      R"({"type":"FeatureCollection","crs":{"properties":{"name":"EPSG:32632"}},"features":[)";
  for (size_t i = 0; i < features.size(); ++i) text += (i ? "," : "") + features[i];
  return *readMapFeatures(text + "]}", {"a.geojson", {}, false}, {}, MapBox{-100, -100, 100, 100});
}

// A street up the hill, one along it, a house at each, a lake, a pitch, a stream and a park.
MapFeatures village() {
  return mapOf(
      {feature(R"("highway":"residential")", "LineString", "[[-100,0],[0,0],[100,0]]"),
       feature(R"("highway":"residential")", "LineString", "[[0,-100],[0,0],[10,100]]"),
       feature(R"("highway":"steps")", "LineString", "[[50,0],[50,60]]"),
       feature(R"("building":"yes")", "Polygon", "[[[15,8],[35,8],[35,20],[15,20]]]"),
       feature(R"("building":"yes")", "Polygon", "[[[35,8],[45,8],[45,30],[35,30]]]"),
       feature(R"("building":"yes")", "Polygon", "[[[-60,-60],[-45,-60],[-45,-45],[-60,-45]]]"),
       feature(R"("natural":"water")", "Polygon", "[[[-80,30],[-40,30],[-40,70],[-80,70]]]"),
       feature(R"("leisure":"pitch")", "Polygon", "[[[30,-40],[60,-40],[60,-60],[30,-60]]]"),
       feature(R"("waterway":"stream")", "LineString", "[[70,90],[80,-90]]"),
       feature(R"("leisure":"park")", "Polygon", "[[[-95,-95],[-20,-95],[-20,-65],[-95,-65]]]")});
}

double hill(Vec2 p) {
  return 300 + 0.25 * p.y + 0.08 * p.x + 4 * std::sin(p.x / 25) * std::cos(p.y / 18);
}

struct Border {
  uint32_t piece;
  double from, to;
};

// Neighbours share the heights of their borders, or walls stand between; areas stay.
void expectClosed(const CityPlan& plan) {
  const TerrainSurface& s = *plan.terrain;
  ASSERT_EQ(s.pieces().size(), plan.ground.size());
  using Key = std::tuple<double, double, double, double>;
  std::map<Key, Border> borders;
  for (uint32_t i = 0; i < s.pieces().size(); ++i) {
    const TerrainSurface::Piece& piece = s.pieces()[i];
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    double sum = 0;
    for (uint32_t f = piece.firstFacet; f < piece.firstFacet + piece.facetCount; ++f) {
      const auto& v = s.facets()[f].points;
      const auto at = [&](size_t k) { return Vec2{s.points()[v[k]].x, s.points()[v[k]].y}; };
      const double twice = cross(at(1) - at(0), at(2) - at(0));
      EXPECT_GT(twice, 0);
      sum += 0.5 * twice;
      for (size_t k = 0; k < 3; ++k) ++edges[{v[k], v[(k + 1) % 3]}];
    }
    EXPECT_NEAR(sum, area(plan.ground[i].polygon), 1e-6 * sum + 1e-6);
    size_t outer = 0;
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      if (edges.count({edge.second, edge.first})) continue;
      ++outer;
      const Vec3 &a = s.points()[edge.first], &b = s.points()[edge.second];
      EXPECT_TRUE(std::isfinite(a.z));
      borders[{a.x, a.y, b.x, b.y}] = {i, a.z, b.z};
    }
    EXPECT_EQ(outer, piece.pointCount);
  }
  double expected = 0;
  for (const auto& [key, own] : borders) {
    const auto& [ax, ay, bx, by] = key;
    const auto other = borders.find({bx, by, ax, ay});
    if (other == borders.end()) {
      const auto at = [&](double v, double w) { return std::fabs(v - w) < 0.01; };
      EXPECT_TRUE((at(ax, bx) && (at(ax, plan.area.min.x) || at(ax, plan.area.max.x))) ||
                  (at(ay, by) && (at(ay, plan.area.min.y) || at(ay, plan.area.max.y))));
      continue;
    }
    const double a = own.from - other->second.to, b = own.to - other->second.from;
    if (!s.pieces()[own.piece].level && !s.pieces()[other->second.piece].level) {
      EXPECT_EQ(a, 0);
      EXPECT_EQ(b, 0);
    }
    // The area of a wall of our own side, where it is the higher one.
    const double l = length(Vec2{bx - ax, by - ay});
    if (a >= 0 && b >= 0) expected += 0.5 * (a + b) * l;
    if (a > 0 && b < 0) expected += 0.5 * a * a / (a - b) * l;
    if (a < 0 && b > 0) expected += 0.5 * b * b / (b - a) * l;
  }
  double walls = 0;
  for (const CityShape& shape : plan.shapes) {
    if (shape.rule != "Plinth" && shape.rule != "RetainingWall") continue;
    std::string beyond;
    for (const AttributeValue& v : shape.attributes) {
      if (v.name == "beyond") beyond = v.values[0].text;
    }
    const double below = beyond == "Water" || beyond == "Sea" ? 1.6 : 0.3;
    for (const auto& f : shape.faces) {
      const double l = length(Vec2{f[1].x - f[0].x, f[1].y - f[0].y});
      walls += (0.5 * (f[2].z - f[1].z + f[3].z - f[0].z) - below) * l;
    }
  }
  EXPECT_NEAR(walls, expected, 1e-6 * expected + 0.01);
}

// Nowhere does the ground rise above a floor that it touches.
void expectNothingSunk(const CityPlan& plan) {
  const TerrainSurface& s = *plan.terrain;
  std::map<std::pair<double, double>, double> floors;
  for (uint32_t i = 0; i < s.pieces().size(); ++i) {
    if (plan.ground[i].surface != Surface::Footprint) continue;
    const TerrainSurface::Piece& p = s.pieces()[i];
    for (uint32_t k = p.firstPoint; k < p.firstPoint + p.pointCount; ++k) {
      const auto [at, isNew] =
          floors.emplace(std::pair(s.points()[k].x, s.points()[k].y), s.points()[k].z);
      if (!isNew) at->second = std::min(at->second, s.points()[k].z);
    }
  }
  for (uint32_t i = 0; i < s.pieces().size(); ++i) {
    const TerrainSurface::Piece& p = s.pieces()[i];
    if (p.level) continue;
    for (uint32_t k = p.firstPoint; k < p.firstPoint + p.pointCount; ++k) {
      const auto at = floors.find({s.points()[k].x, s.points()[k].y});
      if (at != floors.end()) {
        EXPECT_LE(s.points()[k].z, at->second + 1e-9);
      }
    }
  }
}

TEST(Terrain, HasNeitherCracksNorOverlaps) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 5, hill);
  const CityPlan plan = planCity(map, "CZ", &field);
  expectClosed(plan);
  expectNothingSunk(plan);
}

TEST(Terrain, FlatGroundHasNoWalls) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 10, [](Vec2) { return 42.5; });
  const CityPlan plan = planCity(map, "CZ", &field);
  expectClosed(plan);
  for (const Vec3& p : plan.terrain->points()) EXPECT_NEAR(p.z, 42.5, 1e-9);
  for (const CityShape& s : plan.shapes) {
    EXPECT_TRUE(s.rule != "Plinth" && s.rule != "RetainingWall");
    if (s.rule == "Building") {
      EXPECT_NEAR(s.height, 42.5, 1e-9);
    }
  }
}

TEST(Terrain, StreetsHaveBoundedSlopesAndLieLevelAcross) {
  const MapFeatures map = village();
  for (const double steep : {0.1, 0.5, 2.0}) {
    const HeightField field =
        fieldOf(map.area, 5, [&](Vec2 p) { return steep * p.y + 3 * std::sin(p.x / 15); });
    const Streets streets = streetsOf(map.features);
    const StreetGrade grade(field, map.features, streets, map.area);
    size_t pieces = 0;
    for (const StreetGrade::Piece& p : grade.pieces()) {
      ++pieces;
      EXPECT_LE(std::fabs(p.to - p.from), p.slope * length(p.b - p.a) + 1e-9);
    }
    EXPECT_GT(pieces, 60u);
    // Away from other lines.
    for (double x = -90; x < -20; x += 3) {
      EXPECT_NEAR(grade.heightAt({x, 2.5}), grade.heightAt({x, -2.5}), 0.05);
    }
  }
}

TEST(Terrain, WaterIsLevelAndPitchesAreTerraces) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 5, hill);
  const CityPlan plan = planCity(map, "CZ", &field);
  size_t lakes = 0, streams = 0;
  for (uint32_t i = 0; i < plan.ground.size(); ++i) {
    const GroundPiece& g = plan.ground[i];
    const bool level = plan.terrain->pieces()[i].level;
    if (g.surface == Surface::Water && map.features[g.feature].kind == MapFeature::Kind::Area) {
      ++lakes;
      EXPECT_TRUE(level);
    } else if (g.surface == Surface::Water) {
      ++streams;
      EXPECT_FALSE(level);
    }
    if (g.surface == Surface::Footprint) {
      EXPECT_TRUE(level);
    }
  }
  EXPECT_EQ(lakes, 1u);
  EXPECT_GE(streams, 1u);
}

TEST(Terrain, TheSeaIsAtItsLevelAndLandAboveIt) {
  const MapFeatures map =
      mapOf({feature(R"("natural":"coastline")", "LineString", "[[0,-130],[0,130]]"),
             feature(R"("man_made":"pier")", "LineString", "[[-5,20],[40,20]]"),
             feature(R"("highway":"residential")", "LineString", "[[-30,-100],[-30,100]]")});
  const HeightField field =
      fieldOf(map.area, 5, [](Vec2 p) { return 7 + std::max(0.0, -0.4 * p.x); });
  const CityPlan plan = planCity(map, "CZ", &field);
  expectClosed(plan);
  bool sea = false;
  for (uint32_t i = 0; i < plan.ground.size(); ++i) {
    const TerrainSurface::Piece& p = plan.terrain->pieces()[i];
    for (uint32_t k = p.firstPoint; k < p.firstPoint + p.pointCount; ++k) {
      const double z = plan.terrain->points()[k].z;
      if (plan.ground[i].surface == Surface::Sea) {
        sea = true;
        EXPECT_NEAR(z, 7, 1e-6);
      } else {
        EXPECT_GE(z, 7 - 1e-6);
      }
    }
  }
  EXPECT_TRUE(sea);
}

// A box of a thousand kilometres around one street: the ground has no more corners than a town's.
// Six times the signed volume below a fan of faces.
double volumeOf(const std::vector<std::vector<Vec3>>& faces) {
  double sum = 0;
  for (const auto& f : faces) {
    for (size_t i = 1; i + 1 < f.size(); ++i) sum += dot(f[0], cross(f[i], f[i + 1]));
  }
  return sum / 6;
}

TEST(Terrain, ThePlaceIsAClosedBlockOfSoil) {
  const MapFeatures map = mapOf(
      {feature(R"("highway":"residential")", "LineString", "[[-100,0],[0,0],[100,0]]"),
       feature(R"("landuse":"grass")", "Polygon", "[[[-95,20],[20,20],[20,130],[-95,130]]]")});
  const HeightField field = fieldOf(map.area, 5, hill);
  const CityPlan plan = planCity(map, "CZ", &field, 12);
  const TerrainSurface& s = *plan.terrain;
  double lowest = 1e9, expected = 0;
  for (const Vec3& p : s.points()) lowest = std::min(lowest, p.z);
  std::vector<std::vector<Vec3>> faces;
  for (const TerrainSurface::Facet& f : s.facets()) {
    std::vector<Vec3> face;
    for (const uint32_t v : f.points) face.push_back(s.points()[v]);
    const Vec3 a = face[1] - face[0], b = face[2] - face[0];
    const double twice = cross(Vec2{a.x, a.y}, Vec2{b.x, b.y});
    expected += twice / 2 * (face[0].z + face[1].z + face[2].z) / 3;
    faces.push_back(std::move(face));
  }
  double base = 1e9;
  for (const CityShape& shape : plan.shapes) {
    if (shape.rule != "Soil" && shape.rule != "SoilRim") continue;
    EXPECT_EQ(liesOnGround(shape.rule), shape.rule == "SoilRim");
    for (std::vector<Vec3> face : shape.faces) {
      // As the drape lays it down.
      if (shape.rule == "SoilRim") {
        for (Vec3& p : face) p.z += s.heightAt({p.x, p.y});
      }
      for (const Vec3& p : face) base = std::min(base, p.z);
      faces.push_back(std::move(face));
    }
  }
  EXPECT_LE(base, lowest - 12);
  EXPECT_GT(base, lowest - 13.01);
  const double whole = plan.area.size().x * plan.area.size().y;
  EXPECT_NEAR(volumeOf(faces), expected - base * whole, 1e-9 * std::fabs(expected));
  // Without the bottom, every edge above it has its counterpart.
  std::map<std::array<double, 6>, int> edges;
  for (const auto& f : faces) {
    for (size_t i = 0; i < f.size(); ++i) {
      const Vec3 &a = f[i], &b = f[(i + 1) % f.size()];
      ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
      --edges[{b.x, b.y, b.z, a.x, a.y, a.z}];
    }
  }
  for (const auto& [e, count] : edges) {
    if (e[2] <= base && e[5] <= base) continue;
    EXPECT_EQ(count, 0) << e[0] << ' ' << e[1] << ' ' << e[2];
  }
}

TEST(Terrain, SoilCanBeLeftOut) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 5, hill);
  for (const auto& [depth, count] : {std::pair(0.0, 0), std::pair(1.0, 1)}) {
    const CityPlan plan = planCity(map, "CZ", &field, depth);
    int bottoms = 0;
    for (const CityShape& shape : plan.shapes) bottoms += shape.id == "bottom";
    EXPECT_EQ(bottoms, count);
  }
}

TEST(Terrain, InACrackTheGroundIsThatAroundIt) {
  const std::vector<Vec3> points{{0, 0, 100}, {10, 0, 1},  {0, 10, 2},
                                 {90, 90, 7}, {99, 90, 8}, {90, 99, 9}};
  const TerrainSurface surface(points, {{{0, 1, 2}, 0}, {{3, 4, 5}, 1}},
                               {{0, 1, 0, 3}, {1, 1, 3, 3}});
  EXPECT_EQ(surface.facetAt({60, 60}), TerrainSurface::kNothing);
  EXPECT_EQ(surface.heightAt({60, 60}), 7);
  EXPECT_EQ(surface.heightAt({11, 1}), 1);
}

TEST(Terrain, HugePlacesEnd) {
  const std::string text =
      R"({"type":"FeatureCollection","crs":{"properties":{"name":"EPSG:32632"}},"features":[)" +
      feature(R"("highway":"residential")", "LineString", "[[-500000,0],[500000,10]]") + "]}";
  Result<MapFeatures> map =
      readMapFeatures(text, {"a.geojson", {}, false}, {}, MapBox{-500000, -500000, 500000, 500000});
  ASSERT_TRUE(map.ok());
  const HeightField field = fieldOf(map->area, 10'000, [](Vec2 p) { return 0.001 * p.x; });
  const CityPlan plan = planCity(*map, "CZ", &field);
  EXPECT_LT(plan.terrain->points().size(), 6'000'000u);
  EXPECT_GT(plan.terrain->points().size(), 1000u);
}

TEST(Terrain, BridgesGoFromBankToBank) {
  const MapFeatures map =
      mapOf({feature(R"("highway":"primary")", "LineString", "[[-100,0],[-50,0]]"),
             feature(R"("highway":"primary","bridge":"yes")", "LineString", "[[-50,0],[50,0]]"),
             feature(R"("highway":"primary")", "LineString", "[[50,0],[100,0]]")});
  const HeightField field = fieldOf(
      map.area, 5, [](Vec2 p) { return 100 - 30 * std::max(0.0, 1 - std::fabs(p.x) / 45); });
  const CityPlan plan = planCity(map, "CZ", &field);
  double lowest = 1e9, deepest = 1e9;
  for (const CityShape& s : plan.shapes) {
    if (s.rule != "BridgeDeck" && s.rule != "BridgePier") continue;
    for (const auto& face : s.faces) {
      for (const Vec3& p : face) {
        if (s.rule == "BridgeDeck") lowest = std::min(lowest, p.z);
        if (s.rule == "BridgePier") deepest = std::min(deepest, p.z);
      }
    }
  }
  EXPECT_GT(lowest, 99);
  EXPECT_LT(lowest, 110);
  EXPECT_LT(deepest, 85);
}

TEST(PlanMesh, KeepsTheOutlineAndTheArea) {
  Polygon p{{{0, 0}, {100, 0}, {100, 60}, {50, 20}, {0, 60}}, {{{10, 10}, {10, 15}, {20, 10}}}};
  for (const double spacing : {0.0, 3.0, 12.0, 1e6}) {
    const PlanMesh m = meshOf(p, spacing);
    double sum = 0;
    for (const Triangle& t : m.triangles) {
      const double twice = cross(m.points[t[1]] - m.points[t[0]], m.points[t[2]] - m.points[t[0]]);
      EXPECT_GT(twice, 0);
      sum += 0.5 * twice;
    }
    EXPECT_NEAR(sum, area(p), 1e-6);
    EXPECT_EQ(m.triangles.size(), 2 * m.points.size() - 8);
    if (spacing == 3) {
      EXPECT_GT(m.points.size(), 150u);
    }
  }
}

// A slab of the whole place, a post and a house that does not lie on the ground.
TEST(Drape, LaysWhatLiesAndMovesWhatStands) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 5, hill);
  const CityPlan plan = planCity(map, "CZ", &field);
  Scene scene;
  scene.names = {"Lot", "Building"};
  scene.materialLists = {{0}};
  scene.materials.emplace_back();
  const auto add = [&](uint32_t name, uint32_t mesh, const Vec3& at, const Vec3& scale) {
    Leaf leaf;
    leaf.mesh = mesh;
    leaf.scale = scale;
    Prototype p;
    p.firstLeaf = static_cast<uint32_t>(scene.leaves.size());
    p.leafCount = 1;
    scene.leaves.push_back(leaf);
    scene.prototypes.push_back(p);
    const auto number = static_cast<uint32_t>(scene.prototypes.size() - 1);
    scene.roots.push_back({name, {Frame::moved(at), number, 0}});
  };
  add(0, kUnitBox, {-90, -0.05, -90}, {180, 0.2, 180});
  add(0, kUnitBox, {10, 0, 10}, {0.2, 4, 0.2});
  add(1, kUnitBox, {20, 300, 20}, {10, 5, 10});
  const Scene laid =
      draped(scene, *plan.terrain, [](const std::string& name) { return name == "Lot"; });
  ASSERT_EQ(laid.roots.size(), 3u);
  const auto leafOf = [&](size_t root) {
    return laid.leaves[laid.prototypes[laid.roots[root].instance.prototype].firstLeaf];
  };
  const Mesh& slab = *laid.meshes[leafOf(0).mesh];
  ASSERT_TRUE(slab.valid());
  double top = 0;
  for (size_t f = 0; f < slab.faceCount(); ++f) {
    const Vec3 n = slab.areaNormal(f);
    Vec2 middle;
    double y = 0, count = 0;
    for (const MeshLoop& loop : slab.loopsOf(f)) {
      for (const uint32_t c : slab.cornersOf(loop)) {
        middle = middle + Vec2{slab.positions[c].x, -slab.positions[c].z};
        y += slab.positions[c].y;
        ++count;
      }
    }
    if (!(n.y > 1e-6)) continue;
    top += 0.5 * n.y;
    EXPECT_NEAR(y / count, plan.terrain->heightAt(middle * (1 / count)) + 0.15, 1e-6);
  }
  EXPECT_NEAR(top, 180 * 180, 1e-3);
  const Leaf post = leafOf(1);
  EXPECT_EQ(post.mesh, kUnitBox);
  EXPECT_NEAR(post.frame.origin.y, plan.terrain->heightAt({10.1, -10.1}), 1e-9);
  EXPECT_EQ(laid.roots[2].instance.frame.origin.y, 300);
}

// A post that carries a wide sign, placed twice, is one prototype still; so is a long low cart
// where the ground is even. Paving that the same rule makes is not moved as a whole.
TEST(Drape, ThingsStayShared) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 5, [](Vec2 p) { return 200 + 0.1 * p.x; });
  const CityPlan plan = planCity(map, "CZ", &field);
  Scene scene;
  scene.names = {"Lot"};
  scene.materialLists = {{0}};
  scene.materials.emplace_back();
  const auto addPrototype = [&](const std::vector<std::pair<Vec3, Vec3>>& boxes) {
    Prototype p;
    p.firstLeaf = static_cast<uint32_t>(scene.leaves.size());
    p.leafCount = static_cast<uint32_t>(boxes.size());
    for (const auto& [at, size] : boxes) {
      Leaf leaf;
      leaf.frame = Frame::moved(at);
      leaf.scale = size;
      scene.leaves.push_back(leaf);
    }
    scene.prototypes.push_back(p);
    return static_cast<uint32_t>(scene.prototypes.size() - 1);
  };
  const uint32_t post =
      addPrototype({{{-0.1, 0, -0.1}, {0.2, 3, 0.2}}, {{-1, 3, -1}, {2, 0.1, 2}}});
  const uint32_t cart = addPrototype({{{-0.7, 0, -2}, {0.3, 0.6, 0.6}},
                                      {{0.4, 0, 1.4}, {0.3, 0.6, 0.6}},
                                      {{-0.8, 0.4, -2}, {1.6, 0.5, 4}}});
  const uint32_t paved =
      addPrototype({{{-2, 0, -2}, {4, 0.1, 4}}, {{-0.1, 0, -0.1}, {0.2, 2, 0.2}}});
  Prototype all;
  all.instanceCount = 6;
  for (uint32_t i = 0; i < 6; ++i) {
    const Vec3 at{-60.0 + 8 * i, 0, 70};
    scene.instances.push_back({Frame::moved(at), i / 2 == 0 ? post : i / 2 == 1 ? cart : paved, 0});
  }
  scene.prototypes.push_back(all);
  scene.roots.push_back({0, {Frame(), static_cast<uint32_t>(scene.prototypes.size() - 1), 0}});
  const Scene laid = draped(scene, *plan.terrain, [](const std::string&) { return true; });
  const Prototype& own = laid.prototypes[laid.roots[0].instance.prototype];
  ASSERT_EQ(own.instanceCount, 4u);
  EXPECT_EQ(leafCount(laid), leafCount(scene));
  for (uint32_t i = 0; i < 4; ++i) {
    const Instance& in = laid.instances[own.firstInstance + i];
    EXPECT_EQ(in.prototype, i < 2 ? post : cart);
    const Vec3& at = in.frame.origin;
    EXPECT_NEAR(at.y, plan.terrain->heightAt({at.x, -at.z}), 0.05) << i;
    // Posts are upright, carts go with the ground.
    EXPECT_NEAR(in.frame.y.x, i < 2 ? 0 : -0.1 / std::sqrt(1.01), 0.02) << i;
    EXPECT_NEAR(dot(in.frame.x, in.frame.y), 0, 1e-12);
  }
}

TEST(Drape, APieceOfTheGroundBecomesItsFacets) {
  const MapFeatures map = village();
  const HeightField field = fieldOf(map.area, 5, hill);
  const CityPlan plan = planCity(map, "CZ", &field);
  for (uint32_t i = 0; i < plan.ground.size(); ++i) {
    Scene scene;
    scene.names = {"Lot"};
    scene.materialLists = {{0}};
    scene.materials.emplace_back();
    MeshBuilder b;
    b.beginFace();
    const auto ring = [&](const Ring& r) {
      b.beginLoop();
      for (const Vec2 p : r) b.addCorner(b.addPosition({p.x, 0.5, -p.y}));
    };
    ring(plan.ground[i].polygon.outer);
    for (const Ring& h : plan.ground[i].polygon.holes) ring(h);
    scene.meshes.push_back(makeRef<Mesh>(b.take()));
    Leaf leaf;
    leaf.mesh = kFirstMesh;
    scene.leaves.push_back(leaf);
    Prototype p;
    p.leafCount = 1;
    scene.prototypes.push_back(p);
    scene.roots.push_back({0, {Frame(), 0, 0}});
    const Scene laid = draped(scene, *plan.terrain, [](const std::string&) { return true; });
    const Mesh& m = *laid.meshes.back();
    const TerrainSurface::Piece& piece = plan.terrain->pieces()[i];
    EXPECT_EQ(m.faceCount(), piece.level ? 1 : piece.facetCount) << i;
  }
}

class RealTerrain : public ::testing::TestWithParam<const char*> {};

TEST_P(RealTerrain, KeepsThePromises) {
  const char* shared = std::getenv("GABLE_SHARED");
  const std::string path = std::string(shared ? shared : "../shared") + "/data/gis/" + GetParam();
  Result<std::string> bytes = readFile(path, uint64_t{1} << 30);
  if (!bytes.ok()) GTEST_SKIP() << path << " is not there";
  if (programBeside("gable-maps").empty()) GTEST_SKIP() << "gable-maps is not built";
  auto map = readMapFeatures(*bytes, {path, {}, false});
  ASSERT_TRUE(map.ok()) << map.error().message;
  const HeightField field = fieldOf(map->area, 15, [](Vec2 p) {
    return std::max(0.0,
                    120 + 0.15 * p.y - 0.1 * p.x + 15 * std::sin(p.x / 90) * std::sin(p.y / 70));
  });
  const CityPlan plan = planCity(*map, {}, &field);
  expectClosed(plan);
  expectNothingSunk(plan);
}

INSTANTIATE_TEST_SUITE_P(Maps, RealTerrain,
                         ::testing::Values("monaco-latest.osm.pbf", "prague_vinohrady.osm"),
                         [](const auto& info) { return info.index == 0 ? "Monaco" : "Vinohrady"; });

}  // namespace
}  // namespace gable
