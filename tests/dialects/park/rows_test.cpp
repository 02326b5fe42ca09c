// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The park notation and the operations on regions behind it, row by row. What can be measured on
// outlines alone (areas on hostile polygons, origins of edges) is tested beside the kernel in
// geom/region; here rules run.

#include "park_testing.h"

#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "geom/region/autoindex.h"
#include "geom/region/cut_holes.h"
#include "geom/region/grid_partition.h"
#include "geom/region/peel.h"
#include "geom/region/places.h"
#include "geom/region/quad_map.h"
#include "geom/region/rays.h"
#include "geom/region/segment_grid.h"
#include "geom/region/voronoi.h"

namespace gable {
namespace {

using namespace park_testing;

GridOptions gridOf(GridDim x, GridDim y, double path) {
  GridOptions o;
  o.x = std::move(x);
  o.y = std::move(y);
  o.pathWidth = path;
  return o;
}
// So many cells of equal size, or of drawn ones; their lines turned.
GridDim cells(uint32_t count) { return {count, {}, {}}; }
GridDim cells(uint32_t count, std::optional<DrawnRange> size, DrawnRange angle) {
  return {count, {}, {{size, angle}}};
}

size_t cellsOf(const GridResult& g) {
  size_t n = 0;
  for (const RegionPiece& p : g.pieces) n += p.kind == PieceKind::Cell;
  return n;
}

// How many edges were looked at.
size_t expectOrigins(const Polygon& p, const std::vector<RegionPiece>& pieces,
                     const std::string& name) {
  const std::vector<Segment> source = edgesOf(p);
  SegmentGrid index(source);
  const double near = 4 * kRegionGrid;
  size_t seen = 0, unresolved = 0, wrong = 0;
  for (const RegionPiece& piece : pieces) {
    size_t i = 0;
    for (const Segment& e : edgesOf(piece.polygon)) {
      const EdgeOrigin o = piece.edges[i++];
      ++seen;
      const Vec2 middle = (e.a + e.b) * 0.5;
      bool lies = false, lonely = length(e.b - e.a) > 100 * near;
      index.query({middle - Vec2{near, near}, middle + Vec2{near, near}}, [&](uint32_t k) {
        const Segment& s = source[k];
        lies = lies || (distanceTo(s, e.a) < near && distanceTo(s, e.b) < near &&
                        dot(e.b - e.a, s.b - s.a) > 0);
      });
      const bool kept = o.role == EdgeRole::Kept || o.role == EdgeRole::Base;
      unresolved += lies && lonely && !kept;
      if (!kept) continue;
      if (o.source >= source.size()) {
        ++wrong;
      } else {
        // Of neighbours in one line either will do.
        const Segment& own = source[o.source];
        const Vec2 d = normalized(own.b - own.a);
        const double off =
            std::max(std::fabs(cross(d, e.a - own.a)), std::fabs(cross(d, e.b - own.a)));
        wrong += std::min(off, distanceTo(own, middle)) > near;
      }
    }
  }
  EXPECT_EQ(unresolved, 0u) << name;
  EXPECT_EQ(wrong, 0u) << name;
  return seen;
}

TEST(ParkRows, P1GridCountsCellsPathsAndJunctions) {
  const Made m = run(documented("square"), kLot);
  EXPECT_EQ(m.count.at("ParkPath"), 4);
  EXPECT_NEAR(m.area.at("ParkPath"), 60, 1e-3);
  EXPECT_NEAR(m.area.at("Centre"), 18, 1e-3);
  EXPECT_EQ(m.count.at("TreeStrip"), 4);
  EXPECT_NEAR(m.area.at("TreeStrip"), 4 * 12.9375, 1e-3);
  const double bed = m.area.at("TreeRegion");
  EXPECT_NEAR(m.area.at("GrassRegion") + bed, 4 * 67.5625, 1e-3);
}

TEST(ParkRows, P2SizesCyclicCountsAndFits) {
  const Made m =
      run("PathWidth = 2\nR -> Grid(5 {3, 15}, 3) { C }\nC -> case (w == 15 && h == 15) : Big "
          "case (w == 3 && h == 3) : Small else : Side",
          Shapes::lot(47, 25));
  EXPECT_EQ(m.count.at("Big"), 2);
  EXPECT_EQ(m.count.at("Small"), 6);
  EXPECT_EQ(m.count.at("Side"), 7);
  EXPECT_NEAR(m.whole, 47 * 25, 1e-3);
  EXPECT_EQ(
      rules("Lot --> grid(widths = 3, rows = 1, path = 0) { region : A }", kLot).count.at("A"), 7);
  EXPECT_NEAR(
      rules("Lot --> grid(2, 1, 0, widths = 3, heights = 20, fit = center) { region : A }", kLot)
          .area.at("A"),
      120, 1e-6);
}

TEST(ParkRows, P3RangesAndAnglesKeepLinesApart) {
  for (int seed = 0; seed < 1000; seed += 20) {
    const Made m = run(documented("irregular"), Shapes::lot(40, 40), seed);
    EXPECT_NEAR(m.whole, 1600, 0.01) << seed;
  }
  // Lines that met within would make cells beyond the rows times the columns.
  const Polygon block{{{0, 0}, {12, 1}, {11, 19}, {-1, 18}}, {}};
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    GridOptions outer = gridOf(cells(3, DrawnRange{7, 15}, {-15, 15}), cells(2), 3);
    outer.sliver = outer.minArea = 0;
    outer.seed = seed;
    const Polygon lot{{{0, 0}, {40, 0}, {40, 40}, {0, 40}}, {}};
    EXPECT_EQ(cellsOf(gridPartition(lot, outer)), 6u) << seed;
    GridOptions inner = gridOf(cells(2, {}, {-5, 5}), cells(0, DrawnRange{1.5, 4}, {-25, 25}), 0);
    inner.sliver = inner.minArea = 0;
    inner.seed = seed;
    const GridResult g = gridPartition(block, inner);
    EXPECT_EQ(cellsOf(g), size_t{g.nx} * g.ny) << seed;
  }
}

// In the grid of beds without paths, what lies near another point is that point, bit for bit.
TEST(ParkRows, P4CellsWithoutPathsShareTheirBorders) {
  const Polygon blocks[] = {{{{0, 0}, {11, 0}, {11, 18}, {0, 18}}, {}},
                            {{{0, 0}, {12.3, 1.1}, {10.9, 19.7}, {-1.3, 18.2}}, {}}};
  for (const Polygon& block : blocks) {
    for (uint64_t seed = 0; seed < 40; ++seed) {
      GridOptions o = gridOf(cells(2, {}, {-5, 5}), cells(0, DrawnRange{1.5, 4}, {-25, 25}), 0);
      o.sliver = o.minArea = 0;
      o.seed = seed;
      const GridResult g = gridPartition(block, o);
      std::set<std::pair<double, double>> points;
      double sum = 0;
      for (const RegionPiece& p : g.pieces) {
        sum += area(p.polygon);
        for (const Vec2 v : p.polygon.outer) points.insert({v.x, v.y});
      }
      EXPECT_NEAR(sum, area(block), 1e-6);
      size_t near = 0;
      for (const auto& a : points) {
        for (const auto& b : points) {
          near += a != b && std::hypot(a.first - b.first, a.second - b.second) < 1e-6;
        }
      }
      EXPECT_EQ(near, 0u) << seed;
    }
  }
}

TEST(ParkRows, P5JunctionsOfFiveShapes) {
  for (const char* figure : {"Romb(2)", "Circle(2)", "Square(3)", "Rect(4,2)", "Polygon(6,2)"}) {
    const Made m =
        run(std::string("R -> Grid(3, 3) { A } { B } { ") + figure + " C }", Shapes::lot(40, 40));
    EXPECT_EQ(m.count.at("C"), 4) << figure;
    EXPECT_EQ(m.count.count("Centre"), 0u) << figure;
    EXPECT_NEAR(m.whole, 1600, 0.01) << figure;
  }
  EXPECT_TRUE(run("R -> Grid(3, 3) { A } { B } { Circle(30) C }", kLot).has("junction-clamped"));
}

TEST(ParkRows, P6OtherOutlinesKeepTheirArea) {
  const Made m = rules("Lot --> grid(3, 3, 1) { all : A }", cShape());
  EXPECT_NEAR(m.whole, 620, 0.01);
  const Made inner = rules("Lot --> grid(2, 2, 1, template = inner) { all : A }", cShape());
  EXPECT_NEAR(inner.whole, 620, 0.01);
}

TEST(ParkRows, P7VoronoiFormsAreEqual) {
  const std::string sites = "\nCircleRegions -> ScatterCircles(5 {[5-10]})\n";
  const Shapes lot = Shapes::lot(60, 50);
  const Made a =
      run("Region -> VoronoiSmoothed(CircleRegions) { SmoothRegions } { Path }" + sites, lot);
  const Made b =
      run("Region -> VoronoiRegions(CircleRegions)\n{ SmoothRegions } { Path }" + sites, lot);
  EXPECT_EQ(a.count.at("SmoothRegions"), 5);
  EXPECT_EQ(a.area.at("SmoothRegions"), b.area.at("SmoothRegions"));
  EXPECT_NEAR(a.whole, 3000, 0.01);
}

TEST(ParkRows, P8SmoothingStaysInTheCell) {
  double before = 0;
  for (const char* smooth : {"none", "average(2)", "chaikin(2)", "round(2)"}) {
    const Made m = rules(std::string("Lot --> voronoi([10,-10,40,-12,25,-35], 3, ") + smooth +
                             ") { region : A | path : B }",
                         Shapes::lot(60, 50));
    EXPECT_NEAR(m.whole, 3000, 0.01) << smooth;
    if (before == 0) before = m.area.at("A");
    EXPECT_LE(m.area.at("A"), before + 1e-6) << smooth;
  }
}

TEST(ParkRows, P9SomethingAtTheSites) {
  const Made m = run("R -> VoronoiRegions(S) { A } { B } { C }\nS -> ScatterCircles(4 {3})",
                     Shapes::lot(60, 50));
  EXPECT_EQ(m.count.at("C"), 4);
  EXPECT_NEAR(m.whole, 3000, 0.01);
}

TEST(ParkRows, P10RaysToCornersPointsAndDirections) {
  const Made m = run(documented("circular"), Shapes::lot(40, 31));
  EXPECT_EQ(m.count.at("Fountain"), 1);
  EXPECT_EQ(m.count.at("Grass"), 4);
  EXPECT_NEAR(m.whole, 1240, 0.01);
  const Made c = rules(
      "Lot --> castRays([5, -4], corners, 1) { region : A | path : B | centre : circle(2) C }",
      cShape());
  EXPECT_EQ(c.count.at("B"), 6);
  EXPECT_NEAR(c.whole, 620, 0.01);
  EXPECT_EQ(rules("Lot --> castRays(centre, direction(10) || direction(130) || direction(250), 1) "
                  "{ region : A }",
                  kLot)
                .count.at("A"),
            3);
}

TEST(ParkRows, P11CentresJoinedWithoutCrossings) {
  for (const char* links : {"none", "loop", "tree", "pairs", "thin, share = 0.5"}) {
    const Made m = rules(std::string("Lot --> castRays(5, corners, 1, radius = 4, connect = ") +
                             links + ") { region : A | path : B | centre : circle(2) C }",
                         Shapes::lot(60, 50));
    EXPECT_NEAR(m.whole, 3000, 0.02) << links;
  }
}

TEST(ParkRows, P12PeelFollowsOrEndsSquare) {
  const Shapes leaning = Shapes::polygon({{0, 0}, {10, 0}, {14, 4}, {0, 4}});
  EXPECT_NEAR(run("R -> Peel(S) { 1: A | B }", leaning).area.at("A"), 10.5, 1e-3);
  EXPECT_NEAR(run("R -> Peel(S, 1, CornersOrthogonal) { A | B }", leaning).area.at("A"), 10, 1e-3);
  EXPECT_NEAR(run("R -> Peel(S, 50%) { A | B }", Shapes::lot(20, 10)).area.at("A"), 50, 1);
}

TEST(ParkRows, P13ContractStaysInside) {
  EXPECT_NEAR(run("R -> Contract(1) A", kLot).area.at("A"), 324, 1e-3);
  EXPECT_LE(run("R -> Contract(1, centre) A", cShape()).area.at("A"), 620);
}

TEST(ParkRows, P14PlacesLieInside) {
  const Made m = run("R -> Place(CENTRE) { Square(0.5) }", cShape());
  EXPECT_NEAR(m.whole, 620, 1e-3);
  EXPECT_NEAR(m.area.at("Thing"), 0.25, 1e-6);
  const Made uv = rules("Lot --> place(at(0.25, 0.75)) { P } X.", kLot);
  EXPECT_NEAR(uv.places.at("P")[0].x, 5, 1e-9);
  EXPECT_NEAR(uv.places.at("P")[0].z, -15, 1e-9);
}

TEST(ParkRows, P15TreesTwoMetresApart) {
  const Made m = run("PathWidth = 2\nR -> Distribute(S: 0.375, 2) { T }", Shapes::lot(9, 9));
  const std::vector<Vec3>& t = m.places.at("T");
  ASSERT_EQ(t.size(), 5u);
  for (size_t i = 1; i < t.size(); ++i) EXPECT_NEAR(length(t[i] - t[i - 1]), 2, 1e-9);
  EXPECT_NEAR(t[0].z, -0.375, 1e-9);
}

TEST(ParkRows, P16ScatteredDiscsAreApart) {
  const Made m = run("R -> ScatterCircles(8 {[1,2]}, edge=1, min=0.5) { D }", Shapes::lot(30, 30));
  ASSERT_EQ(m.count.at("D"), 8);
  const std::vector<Vec3>& d = m.places.at("D");
  for (size_t i = 0; i < d.size(); ++i) {
    for (size_t k = 0; k < i; ++k) EXPECT_GE(length(d[i] - d[k]), 2.5);
    EXPECT_GE(d[i].x, 2);
    EXPECT_LE(d[i].x, 28);
  }
}

TEST(ParkRows, P17SweepsAreClosedVolumes) {
  const Made m = run(documented("square"), kLot);
  EXPECT_EQ(m.count.at("Bush"), 4);
  EXPECT_TRUE(m.closed.at("Bush"));
}

TEST(ParkRows, P18RangesPerLogicalEdge) {
  const Made m = run("R -> Parametrise([0.1, 0.9] [] [0.1, 0.9], Square(10))", kLot);
  EXPECT_EQ(m.count.at("Line"), 2);
  EXPECT_NEAR(m.length.at("Line"), 16, 1e-6);
  EXPECT_NEAR(selectedLength("[0.02,1] [0,1] [0,0.15]", kLot), 20 * 2.13, 1e-6);
}

TEST(ParkRows, P19JoinedChooseConstantsFunctions) {
  const Made m =
      run("PathWidth = 2\nSize = PathWidth + 1\nRegion -> Grid(2, 2) { ParkQuarter }\n{ "
          "ParkPathCentered }\n"
          "ParkPathCentered ->\njoined { RombCenter(Size) ParkPath(Size) }",
          kLot);
  EXPECT_EQ(m.count.at("ParkPath"), 1);
  EXPECT_NEAR(m.area.at("ParkPath"), 78, 1e-3);
  std::set<std::string> seen;
  for (const auto& [name, n] : run(documented("irregular"), Shapes::lot(40, 40)).count)
    seen.insert(name);
  EXPECT_TRUE(seen.count("GrassRegion") && seen.count("BushRegion") && seen.count("Plant1Region"));
}

TEST(ParkRows, P20ModelsAreLoaded) {
  const Made m = run("R -> Place(CENTRE) { Tree }\nTree -> loadModel(“tree”)", kLot);
  EXPECT_TRUE(m.has("missing-file") || m.has("missing-asset"));
  EXPECT_EQ(m.count.at("Tree"), 1);
  EXPECT_NEAR(m.area.at("Tree"), 6, 1e-6);
  // A triangle of half a square metre as OBJ, a larger one as glTF, each at the place that is told.
  const std::string folder = testing::TempDir() + "gable_park_models/";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder + name) << text;
  };
  write("tree.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write(
      "lamp.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
      R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,2,0]}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
      R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAAEAAAAAA"}]})");
  write("models.park",
        "R -> Place((0.25, 0.5)) { Tree } Place((0.75, 0.5)) { Lamp }\n"
        "Tree -> loadModel(\"tree\")\nLamp -> loadModel(\"lamp\")\n");
  LoadSettings settings;
  settings.project = folder;
  const Rules rules = Rules::load(folder + "models.park", settings);
  const Made loaded = collect(rules, derive(rules, kLot, {}));
  for (const Diagnostic& x : loaded.diagnostics) ADD_FAILURE() << x.message;
  EXPECT_NEAR(loaded.area.at("Tree"), 0.5, 1e-6);
  EXPECT_NEAR(loaded.area.at("Lamp"), 2, 1e-6);
  EXPECT_NEAR(loaded.places.at("Lamp")[0].z, -10, 1e-6);
  EXPECT_GT(loaded.places.at("Lamp")[0].x, loaded.places.at("Tree")[0].x + 9);
  // One that is not there is told while the grammar is read, once, with the nearest.
  write("slip.park", "R -> Place(CENTRE) { Tree }\nTree -> loadModel(\"trea\")\n");
  const Rules slip = Rules::load(folder + "slip.park", settings);
  ASSERT_EQ(slip.diagnostics().size(), 1u);
  const Diagnostic& d = slip.diagnostics()[0];
  EXPECT_EQ(d.code, "missing-file");
  EXPECT_EQ(d.hint, "did you mean 'tree'?");
  EXPECT_EQ(d.range->line, 2u);
  EXPECT_EQ(d.range->column, 19u);
  EXPECT_TRUE(derive(slip, kLot, {}).diagnostics().empty());
}

TEST(ParkRows, P21NothingIsLostOnASliver) {
  const Shapes sliver = Shapes::lot(10, 0.01);
  for (const char* op : {"grid(3, 3, 1) { all : A }", "voronoi(3, 1, radius = 2) { all : A }",
                         "castRays(centre, corners, 1) { all : A }", "peel(outer, 1) { all : A }",
                         "peel(pathSide, 1) { all : A }"}) {
    const Made m = rules(std::string("Lot --> ") + op, sliver);
    EXPECT_NEAR(m.whole, 0.1, 2e-3) << op;
  }
  for (const char* op : {"contract(1)", "place(centre, over = true) { circle(1) NIL }",
                         "distribute(outer, 1, 1) { NIL }", "scatterCircles(3, 1) { NIL }",
                         "sweep(outer, 0.1) { NIL }"}) {
    const Made m = rules(std::string("Lot --> ") + op + " A.", sliver);
    EXPECT_NEAR(m.area.at("A"), 0.1, 1e-9) << op;
  }
  EXPECT_EQ(run("R -> Grid(2 {3}, 1, fit=fail) { A } else { B }", kLot).count.at("B"), 1);
}

TEST(ParkRows, P22OuterInnerAndLevels) {
  const std::string nested =
      "grid(2, 2, 0) { region : case region.ix == 0 && region.iy == 0 : "
      "grid(2, 2, 0) { region : case region.ix == 0 && region.iy == 0 : R else : NIL } else : NIL "
      "}";
  EXPECT_NEAR(selectedLength("outer", kLot, nested), 10, 1e-6);
  EXPECT_NEAR(selectedLength("inner", kLot, nested), 10, 1e-6);
  EXPECT_NEAR(selectedLength("outer(-1)", kLot, nested), 10, 1e-6);
  EXPECT_NEAR(selectedLength("outer(0)", kLot, nested), 10, 1e-6);
  const std::string last =
      "grid(2, 2, 0) { region : case region.ix == 0 && region.iy == 0 : "
      "grid(2, 2, 0) { region : case region.ix == 1 && region.iy == 0 : R else : NIL } else : NIL "
      "}";
  EXPECT_NEAR(selectedLength("outer", kLot, last), 5, 1e-6);
  EXPECT_NEAR(selectedLength("outer(0)", kLot, last), 10, 1e-6);
}

TEST(ParkRows, P23PeeledBaseInnerSegment) {
  const std::string strip = "peel(side(west), 2) { strip : R | rest : NIL }";
  EXPECT_NEAR(selectedLength("PEELED_BASE", kLot, strip), 20, 1e-3);
  EXPECT_NEAR(selectedLength("PI", kLot, strip), 20, 1e-3);
  EXPECT_NEAR(selectedLength("PS", kLot, strip), 20, 1e-3);
  const std::string rest =
      "peel(side(west), 2) { rest : peel(side(east), 2) { rest : R | strip : NIL } | strip : NIL "
      "}";
  EXPECT_NEAR(selectedLength("PI", kLot, rest), 20, 1e-3);
  EXPECT_NEAR(selectedLength("PI | PI(1)", kLot, rest), 40, 1e-3);
}

TEST(ParkRows, P24LogicalEdgesClockwiseFromTheSouthWest) {
  const Shapes lot = Shapes::lot(20, 10);
  const std::pair<const char*, double> sides[] = {{"0", 10}, {"1", 20}, {"2", 10}, {"3", 20}};
  for (const auto& [index, length] : sides) {
    EXPECT_NEAR(selectedLength(std::string("all & ") + index, lot), length, 1e-9) << index;
  }
  EXPECT_NEAR(selectedLength("all & [0,1]", lot), 10, 1e-9);
  EXPECT_NEAR(selectedLength("all & [0,1][2,2.5]", lot), 15, 1e-9);
  EXPECT_NEAR(selectedLength("all & [0.4,2.9]", lot), 6 + 20 + 9, 1e-9);
  for (const auto& [side, index] : {std::pair{"W", "0"}, {"N", "1"}, {"E", "2"}, {"S", "3"}}) {
    EXPECT_NEAR(selectedLength(std::string(side) + " - " + index, lot), 0, 1e-9) << side;
  }
}

TEST(ParkRows, P25SidesShareTheOutline) {
  double sum = 0;
  for (const char* side : {"side(W)", "side(N)", "side(E)", "side(S)"})
    sum += selectedLength(side, cShape());
  EXPECT_NEAR(sum, selectedLength("all", cShape()), 1e-9);
}

TEST(ParkRows, P26FacingIsStrict) {
  EXPECT_NEAR(selectedLength("facing(E)", cShape()), 8 + 14 + 8, 1e-9);
  EXPECT_NEAR(selectedLength("facing(world.E)", cShape()), 30, 1e-9);
  double sum = 0;
  for (const char* d : {"W", "N", "E", "S"})
    sum += selectedLength(std::string("facing(") + d + ")", cShape());
  EXPECT_NEAR(sum, selectedLength("all", cShape()), 1e-9);
}

TEST(ParkRows, P27AnglesAreHalfOpenAndWrap) {
  const Shapes lot = Shapes::lot(20, 10);
  EXPECT_NEAR(selectedLength("angle(85, 95)", lot), 20, 1e-9);
  EXPECT_NEAR(selectedLength("angle(170, 10)", lot), 40, 1e-9);
  EXPECT_NEAR(selectedLength("angle(80, 90)", lot), 0, 1e-9);
}

TEST(ParkRows, P28SectorsSumUp) {
  double sum = 0;
  for (int a = 0; a < 360; a += 60) {
    sum += selectedLength("sector(" + std::to_string(a) + ", " + std::to_string(a + 60) + ")",
                          cShape());
  }
  EXPECT_NEAR(sum, selectedLength("all", cShape()), 1e-6);
  EXPECT_GE(selectedLength("sector(10, 20, whole)", cShape()),
            selectedLength("sector(10, 20)", cShape()));
}

TEST(ParkRows, P29GrowSharesAllEdges) {
  double sum = 0;
  for (const char* d : {"W", "N", "E", "S"})
    sum += selectedLength(std::string("grow(") + d + ")", cShape());
  EXPECT_NEAR(sum, selectedLength("all", cShape()), 1e-9);
  EXPECT_LE(selectedLength("grow(W, E; 10)", cShape()), selectedLength("grow(W, E)", cShape()));
}

TEST(ParkRows, P30Filters) {
  const Shapes p = Shapes::polygon({{0, 0}, {10, 0}, {10, 4}, {0, 7}});
  EXPECT_NEAR(selectedLength("shortest", p), 4, 1e-9);
  EXPECT_NEAR(selectedLength("len > 9", p), 10 + std::sqrt(109.0), 1e-9);
  EXPECT_NEAR(selectedLength("index(1)", p), 4, 1e-9);
  EXPECT_NEAR(selectedLength("nth(2)", p), 10 + std::sqrt(109.0), 1e-9);
  EXPECT_NEAR(selectedLength("random(1)", p), selectedLength("all", p), 1e-9);
  EXPECT_NEAR(selectedLength("random(0)", p), 0, 1e-9);
}

TEST(ParkRows, P31Roles) {
  const std::string quarter =
      "grid(2, 2, 2) { region : case region.ix == 0 && region.iy == 0 : R else : NIL "
      "| junction : rhombus(3) NIL }";
  EXPECT_NEAR(selectedLength("centreside", kLot, quarter), std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(selectedLength("pathside", kLot, quarter), 16, 1e-3);
  EXPECT_NEAR(selectedLength("border", kLot, quarter), 18, 1e-3);
  EXPECT_NEAR(selectedLength("holeside", kLot, "place(centre) { square(2) NIL } R"), 8, 1e-3);
  EXPECT_NEAR(
      selectedLength("cut", kLot, "grid(2, 1, 0) { region : case region.ix == 0 : R else : NIL }"),
      20, 1e-6);
}

TEST(ParkRows, P32SelectionsCombine) {
  const double all = selectedLength("all", cShape());
  for (const char* a : {"facing(E)", "side(W)", "len>9", "sector(0,90)"}) {
    const std::string s = a;
    EXPECT_NEAR(selectedLength(s + " | !(" + s + ")", cShape()), all, 1e-6) << a;
    EXPECT_NEAR(selectedLength(s + " & !(" + s + ")", cShape()), 0, 1e-6) << a;
    EXPECT_NEAR(selectedLength("all - " + s, cShape()), all - selectedLength(s, cShape()), 1e-6)
        << a;
    EXPECT_NEAR(selectedLength(s + " || N", cShape()) + selectedLength(s + " && N", cShape()),
                selectedLength(s, cShape()) + selectedLength("N", cShape()), 1e-6)
        << a;
  }
}

// Rectangle, turned quad, roughly a quad, and anything else.
TEST(ParkRows, P33AutoindexingOfFourClasses) {
  const LogicalEdges straight = autoindex({{0, 0}, {20, 0}, {20, 10}, {0, 10}});
  EXPECT_EQ(straight.of, (std::vector<uint32_t>{3, 2, 1, 0}));
  // Turned: the longest side is x, west looks to -x of that.
  const Vec2 x{cosDeg(30), sinDeg(30)}, y = perpendicular(x);
  const LogicalEdges turned = autoindex({{0, 0}, x * 20, x * 20 + y * 8, y * 8});
  EXPECT_EQ(turned.of, (std::vector<uint32_t>{3, 2, 1, 0}));
  // Many edges, four sides.
  int right = 0;
  constexpr uint64_t kQuads = 300;
  for (uint64_t q = 0; q < kQuads; ++q) {
    Ring r;
    std::vector<uint32_t> wanted;
    const Vec2 corner[] = {{0, 0}, {60, 2}, {58, 41}, {1, 38}};
    for (uint32_t k = 0; k < 4; ++k) {
      const Vec2 a = corner[k], b = corner[(k + 1) % 4], n = normalized(perpendicular(b - a));
      for (int i = 0; i < 6; ++i) {
        const double off =
            i > 0 ? randomIn(hashCombine(q, 10 * k + static_cast<uint64_t>(i)), -0.8, 0.8) : 0;
        r.push_back(a + (b - a) * (i / 6.0) + n * off);
        wanted.push_back(3 - k);
      }
    }
    right += autoindex(r).of == wanted;
  }
  EXPECT_GE(right, 298);
  // A cross is none of these: an edge between any two bends.
  const Ring cross{{1, 1},   {20, 1},   {20, -1}, {1, -1}, {1, -20}, {-1, -20},
                   {-1, -1}, {-20, -1}, {-20, 1}, {-1, 1}, {-1, 20}, {1, 20}};
  EXPECT_EQ(autoindex({cross.rbegin(), cross.rend()}).count, 12u);
  forCorpus(10, [](const Polygon& p, size_t i) {
    const LogicalEdges l = autoindex(p.outer);
    ASSERT_EQ(l.of.size(), p.outer.size()) << i;
    // Each logical edge is one run of the ring.
    size_t changes = 0;
    for (size_t k = 0; k < l.of.size(); ++k) {
      changes += l.of[k] != l.of[(k + 1) % l.of.size()];
      EXPECT_LT(l.of[k], l.count) << i;
    }
    EXPECT_LE(changes, size_t{l.count}) << i;
  });
}

// No edge of any piece is unresolved: what lies on the region's outline says on which edge, and
// what says so lies there.
TEST(ParkRows, P34ProvenanceThroughEveryOperation) {
  size_t seen = 0;
  forCorpus(80, [&](const Polygon& p, size_t i) {
    const double size = std::sqrt(area(p));
    std::map<std::string, std::vector<RegionPiece>> made;
    GridOptions grid = gridOf(cells(3), cells(3), size / 20);
    made["grid"] = gridPartition(p, grid).pieces;
    const Disc site[] = {{poleOf(p).centre, 0}, {p.outer[0] * 0.5 + poleOf(p).centre * 0.5, 0}};
    VoronoiOptions cells;
    cells.pathWidth = size / 40;
    cells.borderPath = false;
    made["voronoi"] = voronoiPartition(p, site, cells).pieces;
    RayOptions rays;
    rays.pathWidth = size / 50;
    const Vec2 centre[] = {poleOf(p).centre};
    std::vector<RayTarget> corners;
    for (const Vec2 v : p.outer) corners.push_back({RayTarget::Kind::Point, v});
    made["rays"] = castRays(p, centre, corners, rays).pieces;
    std::vector<PeelEdge> half;
    for (uint32_t e = 0; e < edgeCount(p); e += 2) half.push_back({e, 0, 1, size / 30});
    PeelResult strips = peel(p, half, PeelEnds::Follow);
    made["strip"] = strips.strips;
    made["rest"] = strips.rest;
    Smoothing smooth;
    smooth.kind = Smoothing::Kind::Average;
    made["smooth"] = peel(p, half, PeelEnds::Orthogonal, smooth).rest;
    made["map"] = quadMap(p, 3, 2).pieces;
    made["holes"] = withoutHoles(corpus::withHoles(p.outer, i));
    const Region disc{{ringOf({PlanShape::Circle, size / 10, 0, 24}, poleOf(p).centre), {}}};
    made["place"] = combineTraced(BooleanOp::Difference, wholePiece(p), disc,
                                  {kNoEdge, EdgeRole::Hole, EdgeOrigin::kNoSide});
    for (const auto& [name, pieces] : made) {
      const Polygon source = name == "holes" ? corpus::withHoles(p.outer, i) : p;
      seen += expectOrigins(source, pieces, name + " of polygon " + std::to_string(i));
    }
  });
  if (!corpus::loadCorpus(2000).empty()) {
    EXPECT_GT(seen, 5000u);
  }
}

TEST(ParkRows, P35TreesStandSymmetrically) {
  const Made m = run(documented("square"), kLot);
  std::vector<Vec3> trees = m.places.at("TallTree");
  EXPECT_EQ(trees.size() % 4, 0u);
  for (const Vec3& t : trees) {
    for (const Vec3& mirrored : {Vec3{20 - t.x, t.y, t.z}, Vec3{t.x, t.y, -20 - t.z}}) {
      double nearest = 1e9;
      for (const Vec3& u : trees) nearest = std::min(nearest, length(u - mirrored));
      EXPECT_LT(nearest, 1e-9);
    }
  }
}

TEST(ParkRows, P36PatternsOfAddresses) {
  const auto xs = [&](int n, const std::string& pattern, const std::string& u) {
    const Made m = rules("Lot --> grid(" + std::to_string(n) + ", 1, 0, pattern = " + pattern +
                             ") { region : place(at(" + u + ", 0.5)) { P } X. }",
                         Shapes::lot(10.0 * n, 10));
    std::vector<double> out;
    for (const Vec3& p : m.places.count("P") ? m.places.at("P") : std::vector<Vec3>{}) {
      out.push_back(std::round(p.x * 1000) / 1000);
    }
    return out;
  };
  using V = std::vector<double>;
  EXPECT_EQ(xs(3, "centre", "0.8"), (V{8, 15, 22}));
  EXPECT_EQ(xs(4, "pair", "0.8"), (V{8, 12, 28, 32}));
  EXPECT_EQ(xs(4, "mirror", "0.8"), (V{8, 18, 22, 32}));
  EXPECT_EQ(xs(3, "local", "0.8"), (V{8, 18, 28}));
  EXPECT_EQ(xs(4, "extend", "1.8"), (V{18, 22}));
  EXPECT_EQ(xs(4, "extendL", "1.8"), (V{18}));
}

TEST(ParkRows, P37ChoppedCornersBelongToOneSideEverywhere) {
  const Made m = rules(
      "Lot --> grid(2, 2, 2) { region : peel(side(east), 1) { strip : A | rest : B } | junction : "
      "rhombus(3) NIL }",
      kLot);
  ASSERT_EQ(m.count.at("A"), 4);
  // Mirror images have their centres mirrored.
  for (const Vec3& a : m.places.at("A")) {
    double nearest = 1e9;
    for (const Vec3& b : m.places.at("A"))
      nearest = std::min(nearest, length(b - Vec3{20 - a.x, a.y, a.z}));
    EXPECT_LT(nearest, 1e-6);
  }
}

TEST(ParkRows, P38BoundaryMetric) {
  const auto types = [](int n) {
    std::string cases;
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        cases += "case (bx == " + std::to_string(x) + " && by == " + std::to_string(y) + "): Type" +
                 std::to_string(x) + std::to_string(y) + " ";
      }
    }
    const std::string size = std::to_string(n);
    return run("R -> Grid(" + size + ", " + size + ") { C } {}\nC -> " + cases + " else: Other",
               Shapes::lot(50, 50))
        .count.size();
  };
  EXPECT_EQ(types(3), 4u);
  EXPECT_EQ(types(4), 4u);
  EXPECT_EQ(types(5), 9u);
}

TEST(ParkRows, P39GrammarsAsWritten) {
  // E1 is P1's; here in one shape with its paths, as the variant has it.
  const Made e1 = run(documented("square"), kLot);
  EXPECT_NEAR(e1.area.at("TreeStrip"), 4 * 12.9375, 1e-3);
  EXPECT_NEAR(e1.area.at("GrassRegion") + e1.area.at("TreeRegion"), 4 * 67.5625, 1e-3);
  EXPECT_EQ(e1.count.at("TreeRegion"), 4);
  EXPECT_EQ(e1.count.at("Tree"), 4);
  EXPECT_EQ(e1.count.at("Fountain"), 1);
  // E2 with its plaza in the very middle: the golden numbers are of that.
  const Made e2 =
      run("PathWidth = 2\nCentreRegionSize = 5\nRegion -> CastRays(CENTRE "
          "[CentreRegionSize], CastToList) { CentreRegion } { CutRegion }\n"
          "CastToList -> Corners(Region)\nCentreRegion -> Plaza\nCutRegion -> Grass",
          Shapes::lot(40, 30));
  EXPECT_EQ(e2.count.at("Grass"), 4);
  EXPECT_EQ(e2.count.at("Path"), 4);
  EXPECT_NEAR(e2.area.at("Grass"), 966.05, 0.01);
  EXPECT_NEAR(e2.area.at("Path"), 156.31, 0.01);
  EXPECT_NEAR(e2.area.at("Plaza"), 77.65, 0.01);
  const Made written = run(documented("circular"), Shapes::lot(40, 31));
  EXPECT_EQ(written.count.at("Grass"), 4);
  EXPECT_NEAR(written.area.at("Fountain"), 77.65, 0.01);
  // E3: five islands, and one network around them.
  const Made e3 = run(documented("freeform"), Shapes::lot(60, 50));
  EXPECT_EQ(e3.count.at("SmoothRegions"), 5);
  EXPECT_NEAR(e3.whole, 3000, 0.01);
  EXPECT_GT(e3.area.at("Path"), 0.15 * 3000);
  // E4: two lines of eight metres.
  const Made e4 = run("R -> Parametrise([0.1, 0.9] [] [0.1, 0.9], Square(10))", kLot);
  EXPECT_NEAR(e4.length.at("Line"), 16, 1e-6);
  for (const Vec3& at : e4.places.at("Line")) {
    EXPECT_NEAR(std::fabs(at.x - 10), 5, 1e-9);
    EXPECT_NEAR(at.z, -10, 1e-9);
  }
  const Made e5 = run(documented("recursive"), Shapes::lot(14, 14));
  EXPECT_EQ(e5.count.at("TreeRegion"), 24);
  EXPECT_EQ(e5.count.at("CementPath"), 9);
  EXPECT_NEAR(e5.area.at("CementPath"), 76, 1e-6);
  EXPECT_NEAR(e5.area.at("TreeRegion") + e5.area.at("StonePath"), 120, 1e-6);
  // E6: some ninety beds, of four kinds.
  const Made e6 = run(documented("irregular"), Shapes::lot(40, 40));
  int beds = 0;
  for (const char* kind : {"GrassRegion", "BushRegion", "Plant1Region", "Plant2Region"}) {
    beds += e6.count.at(kind);
    EXPECT_GT(e6.count.at(kind), 8) << kind;
  }
  EXPECT_GT(beds, 60);
  EXPECT_LT(beds, 120);
  // E7 on a lot that its sizes fill: 3, 15, 3, 15, 3 by 3, 15, 3, and paths of 3 metres.
  const Made e7 = run(documented("cells"), Shapes::lot(39 + 12, 21 + 6));
  EXPECT_NEAR(e7.whole, 51 * 27, 1e-3);
  EXPECT_EQ(e7.count.at("SimplePark"), 2);
  EXPECT_EQ(e7.count.at("TreeRegion"), 6);
  EXPECT_NEAR(e7.area.at("SimplePark"), 2 * 225, 1e-3);
  EXPECT_NEAR(e7.area.at("TreeRegion"), 6 * 9, 1e-3);
  EXPECT_NEAR(e7.area.at("GrassRegion"), 7 * 45, 1e-3);
  const Made e8 = run("Region -> grid(2, 1) { CellRegion }", kLot);
  EXPECT_EQ(e8.count.at("CellRegion"), 2);
  EXPECT_NEAR(e8.area.at("CellRegion"), 17 * 20, 1e-3);
  const Made e9 =
      run("Park -> grid(2, 1) { SubPark1 }\nSubPark1 -> grid(3,2) { ParkRegion1 }", kLot);
  EXPECT_EQ(e9.count.at("ParkRegion1"), 12);
  EXPECT_NEAR(e9.whole, 400, 1e-3);
}

TEST(ParkRows, P40RegionsWithHoles) {
  const Shapes holed = Shapes::polygon({{0, 0}, {30, 0}, {30, 30}, {0, 30}},
                                       {{{10, 10}, {20, 10}, {20, 20}, {10, 20}}});
  for (const char* op : {"grid(3, 3, 1) { all : A }", "voronoi([5,-5,25,-25], 1) { all : A }",
                         "castRays([5,-5], corners, 1) { all : A }", "peel(all, 1) { all : A }",
                         "quadMap(3, 3) { all : A }", "cutHoles() comp(f) { all : A }"}) {
    EXPECT_NEAR(rules(std::string("Lot --> ") + op, holed).whole, 800, 0.01) << op;
  }
  EXPECT_GT(run("R -> NoHoles A", holed).area.at("A"), 799.9);
  forCorpus(25, [](const Polygon& plain, size_t i) {
    const Polygon p = corpus::withHoles(plain.outer, i);
    double sum = 0;
    for (const RegionPiece& piece : withoutHoles(p)) {
      EXPECT_TRUE(piece.polygon.holes.empty()) << i;
      sum += area(piece.polygon);
    }
    EXPECT_NEAR(sum, area(p), 1e-9 * area(p) + 1e-9) << i;
  });
}

TEST(ParkRows, P41VolumesAreClosed) {
  const Made kerbs = rules(
      "Lot --> grid(2, 2, 2) { region : peel(all, 0.3) { strip : extrude(0.15) Kerb "
      "| rest : Lawn } | junction : circle(3) peel(all, 0.4) { strip : extrude(0.5) Basin | rest : "
      "extrude(0.3) Water } | path : extrude(0.05) Path }\n"
      "Lawn --> place(centre) { circle(2) extrude(0.2) Bed } "
      "sweep(edge(0, 0.1, 1) || edge(1) || edge(2, 0, 0.5), 0.6, 0.8) { extrude(1) Hedge } Grass.",
      kLot);
  for (const char* name : {"Kerb", "Basin", "Water", "Path", "Bed", "Hedge"}) {
    ASSERT_TRUE(kerbs.count.count(name)) << name;
    EXPECT_TRUE(kerbs.closed.at(name)) << name;
  }
  const Made built = run(example("promenade"), Shapes::lot(44, 36));
  for (const char* name : {"Kerbstone", "Hedge", "BedRim", "BushRing", "Water", "Rim"}) {
    ASSERT_TRUE(built.count.count(name)) << name;
    EXPECT_TRUE(built.closed.at(name)) << name;
  }
  EXPECT_GE(built.count.at("Bench"), 12);
  EXPECT_GE(built.count.at("Lamp"), 8);
  // In a park on a plot of the real world, all that is built on the ground is closed.
  const std::string folder = std::string(GABLE_SOURCE_DIR) + "/examples/";
  LoadSettings settings;
  settings.project = folder;
  const Rules rules = Rules::load(folder + "gardens/gardens.cga", settings);
  const Made park =
      collect(rules, derive(rules, Shapes::load(folder + "gardens/buildings.geojson"), {}));
  EXPECT_GT(park.count.at("Built"), 200);
  EXPECT_TRUE(park.closed.at("Built"));
}

TEST(ParkRows, P42ConvertedTextMakesTheSameModel) {
  std::vector<std::string> texts;
  for (const char* name : {"square", "circular", "freeform", "recursive", "irregular", "cells"}) {
    texts.push_back(documented(name));
  }
  texts.push_back(
      "PathWidth = 2\nRegion -> Grid(2, 2) { ParkQuarter }\n{ ParkPathCentered }\n"
      "ParkPathCentered ->\njoined { RombCenter(3) ParkPath(3) }");
  texts.push_back("R -> Parametrise([0.1, 0.9] [] [0.1, 0.9], Square(10))");
  texts.push_back("Region -> grid(2, 1) { CellRegion }");
  texts.push_back("Park -> grid(2, 1) { SubPark1 }\nSubPark1 -> grid(3,2) { ParkRegion1 }");
  for (const std::string& text : texts) {
    const Rules park = Rules::parse(text, "a.park");
    ASSERT_FALSE(hasErrors(park.diagnostics())) << text;
    const Rules cga = Rules::parse(convert(text, "a.park").text, "a.cga");
    ASSERT_FALSE(hasErrors(cga.diagnostics())) << text;
    const Shapes lot = Shapes::lot(60, 50);
    EXPECT_EQ(derive(park, lot, {}).dump(), derive(cga, lot, {}).dump()) << text;
  }
}

TEST(ParkRows, SharingChangesNothing) {
  for (const char* name : {"square", "recursive", "irregular"}) {
    const Made a = run(documented(name), Shapes::lot(60, 50), 3, "a.park", true);
    const Made b = run(documented(name), Shapes::lot(60, 50), 3, "a.park", false);
    EXPECT_EQ(a.count, b.count) << name;
    EXPECT_NEAR(a.whole, b.whole, 1e-9) << name;
  }
}

}  // namespace
}  // namespace gable
