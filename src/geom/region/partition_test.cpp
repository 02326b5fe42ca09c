// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>

#include "base/random.h"
#include "geom/region/along.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "geom/region/grid_partition.h"
#include "geom/region/peel.h"
#include "geom/region/places.h"
#include "geom/region/rays.h"
#include "geom/region/voronoi.h"

namespace gable {
namespace {

// Every so many polygons of the corpus; all of them take minutes.
size_t strideWanted() {
  const char* all = std::getenv("GABLE_WHOLE_CORPUS");
  return all && *all ? 1 : 7;
}
const size_t kStride = strideWanted();

Polygon rect(double w, double h) { return {{{0, 0}, {w, 0}, {w, h}, {0, h}}, {}}; }

double areaOf(const std::vector<RegionPiece>& pieces, PieceKind kind) {
  double sum = 0;
  for (const RegionPiece& p : pieces) sum += p.kind == kind ? area(p.polygon) : 0;
  return sum;
}

size_t countOf(const std::vector<RegionPiece>& pieces, PieceKind kind) {
  size_t n = 0;
  for (const RegionPiece& p : pieces) n += p.kind == kind;
  return n;
}

// What every partition promises: all area is there, all rings are valid, all origins are right.
void expectPartition(const Polygon& p, const std::vector<RegionPiece>& pieces,
                     const std::string& name) {
  double sum = 0;
  for (const RegionPiece& piece : pieces) {
    sum += area(piece.polygon);
    ASSERT_EQ(piece.edges.size(), edgeCount(piece.polygon)) << name;
    EXPECT_TRUE(isValid(piece.polygon)) << name;
    EXPECT_GT(area(piece.polygon), 0) << name;
  }
  EXPECT_NEAR(sum, area(p), 1e-6 * area(p) + 8 * kRegionGrid * perimeter(p)) << name;
}

// Edges that are no part of the input edge they name; collinear neighbours count as one edge.
size_t wrongOrigins(const Polygon& p, const std::vector<RegionPiece>& pieces) {
  const std::vector<Ring> source = ringsOf(p);
  const std::vector<Segment> edges = edgesOf(p);
  size_t wrong = 0;
  for (const RegionPiece& piece : pieces) {
    size_t i = 0;
    for (const Segment& e : edgesOf(piece.polygon)) {
      const EdgeOrigin o = piece.edges[i++];
      if (o.role != EdgeRole::Kept && o.role != EdgeRole::Base) continue;
      if (o.source >= edges.size()) {
        ++wrong;
        continue;
      }
      const Segment& s = edges[o.source];
      const Vec2 d = normalized(s.b - s.a);
      const double off = std::max(std::fabs(cross(d, e.a - s.a)), std::fabs(cross(d, e.b - s.a)));
      const double beside = distanceTo(s, (e.a + e.b) * 0.5);
      wrong += std::min(off, beside) > 4 * kRegionGrid;
    }
  }
  return wrong;
}

void overCorpus(size_t stride, const std::function<void(const Polygon&, const std::string&)>& f) {
  const auto cases = corpus::loadCorpus(stride);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  for (size_t i = 0; i < cases.size(); ++i) {
    const std::string name = "case " + std::to_string(i * stride);
    Polygon p{cases[i].ring, {}};
    f(p, name);
    if (i % 4 == 0) f(corpus::withHoles(cases[i].ring, i), name + " with holes");
  }
}

GridOptions gridOf(uint32_t nx, uint32_t ny, double path) {
  GridOptions o;
  o.x.count = nx;
  o.y.count = ny;
  o.pathWidth = path;
  return o;
}

TEST(GridPartition, DividesASquareWithARhombusInTheMiddle) {
  GridOptions o = gridOf(2, 2, 2);
  o.junctionAt = [](uint32_t, uint32_t, uint32_t, uint32_t, uint64_t) {
    return JunctionPick{{PlanShape::Rhombus, 3, 0, 24}, 1};
  };
  const GridResult g = gridPartition(rect(20, 20), o);
  ASSERT_EQ(g.problem, GridProblem::None);
  EXPECT_EQ(countOf(g.pieces, PieceKind::Cell), 4u);
  EXPECT_EQ(countOf(g.pieces, PieceKind::Path), 4u);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Cell), 322, 1e-3);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Path), 60, 1e-3);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Junction), 18, 1e-3);
  for (const RegionPiece& p : g.pieces) {
    if (p.kind == PieceKind::Cell) {
      EXPECT_EQ(p.polygon.outer.size(), 5u);
    }
  }
}

TEST(GridPartition, TakesSizesInTurn) {
  GridOptions o = gridOf(3, 2, 2);
  for (const double s : {2.0, 6.0, 2.0}) o.x.sizes.push_back({DrawnRange{s, s}, {}});
  o.y.sizes.push_back({DrawnRange{6, 6}, {}});
  const GridResult g = gridPartition(rect(14, 14), o);
  ASSERT_EQ(g.problem, GridProblem::None);
  std::vector<double> areas;
  for (const RegionPiece& p : g.pieces) {
    if (p.kind == PieceKind::Cell) areas.push_back(area(p.polygon));
  }
  const std::vector<double> golden{12, 36, 12, 12, 36, 12};
  ASSERT_EQ(areas.size(), golden.size());
  for (size_t i = 0; i < areas.size(); ++i) EXPECT_NEAR(areas[i], golden[i], 1e-9);
  EXPECT_EQ(countOf(g.pieces, PieceKind::Path), 7u);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Path), 68, 1e-9);
  EXPECT_EQ(countOf(g.pieces, PieceKind::Junction), 2u);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Junction), 8, 1e-9);
}

TEST(GridPartition, FitsStretchesCentresOrFails) {
  GridOptions o = gridOf(2, 1, 2);
  o.x.sizes.push_back({DrawnRange{3, 3}, {}});
  o.y.sizes.push_back({DrawnRange{10, 10}, {}});
  GridResult g = gridPartition(rect(20, 10), o);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Cell), 180, 1e-9);
  o.fit = GridFit::Center;
  g = gridPartition(rect(20, 10), o);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Cell), 60, 1e-9);
  EXPECT_NEAR(areaOf(g.pieces, PieceKind::Path), 140, 1e-9);
  o.fit = GridFit::Fail;
  EXPECT_EQ(gridPartition(rect(20, 10), o).problem, GridProblem::DoesNotFit);
}

TEST(GridPartition, FindsTheCountThatStretchesLeast) {
  GridOptions o;
  o.x.sizes.push_back({DrawnRange{3, 3}, {}});
  o.y.count = 1;
  const GridResult g = gridPartition(rect(20, 10), o);
  EXPECT_EQ(g.nx, 7u);
}

TEST(GridPartition, NeverCrossesLinesInside) {
  for (uint64_t seed = 0; seed < 1000; ++seed) {
    GridOptions o = gridOf(8, 3, 0);
    o.x.sizes.push_back({DrawnRange{1.5, 4}, DrawnRange{-25, 25}});
    o.y.sizes.push_back({{}, DrawnRange{-5, 5}});
    o.seed = seed;
    const Polygon p = rect(20, 20);
    const GridResult g = gridPartition(p, o);
    ASSERT_EQ(g.problem, GridProblem::None);
    EXPECT_EQ(countOf(g.pieces, PieceKind::Cell), 24u) << seed;
    expectPartition(p, g.pieces, "seed " + std::to_string(seed));
  }
}

// Every made edge of a cell is, bit for bit, an edge of its neighbour the other way, but for the
// joints that only one of them has.
TEST(GridPartition, NeighboursWithoutPathShareTheirPoints) {
  GridOptions o = gridOf(4, 4, 0);
  o.x.sizes.push_back({DrawnRange{2, 4}, DrawnRange{-8, 8}});
  o.y.sizes.push_back({DrawnRange{2, 4}, DrawnRange{-8, 8}});
  o.sliver = o.minArea = 0;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    o.seed = seed;
    const GridResult g = gridPartition(rect(17.3, 11.7), o);
    std::vector<Vec2> points;
    for (const RegionPiece& p : g.pieces) {
      for (const Vec2 v : p.polygon.outer) points.push_back(v);
    }
    size_t near = 0;
    for (const Vec2 a : points) {
      for (const Vec2 b : points) near += !(a == b) && length(a - b) < 1e-6;
    }
    EXPECT_EQ(near, 0u) << seed;
  }
}

TEST(GridPartition, ClampsJunctionsThatAreTooLarge) {
  for (const PlanShape shape : {PlanShape::Rhombus, PlanShape::Circle, PlanShape::Square,
                                PlanShape::Rect, PlanShape::Polygon}) {
    GridOptions o = gridOf(3, 3, 1);
    o.junctionAt = [shape](uint32_t, uint32_t, uint32_t, uint32_t, uint64_t) {
      return JunctionPick{{shape, 30, 30, 6}, 1};
    };
    const Polygon p = rect(30, 30);
    const GridResult g = gridPartition(p, o);
    EXPECT_TRUE(g.junctionClamped);
    EXPECT_EQ(countOf(g.pieces, PieceKind::Junction), 4u);
    expectPartition(p, g.pieces, "clamped");
    o.junctionAt = [shape](uint32_t, uint32_t, uint32_t, uint32_t, uint64_t) {
      return JunctionPick{{shape, 1, 1, 6}, 1};
    };
    const GridResult small = gridPartition(p, o);
    EXPECT_FALSE(small.junctionClamped);
    expectPartition(p, small.pieces, "small");
  }
}

TEST(GridPartition, HoldsOnTheCorpus) {
  overCorpus(kStride, [](const Polygon& p, const std::string& name) {
    GridOptions o = gridOf(3, 3, std::sqrt(area(p)) / 20);
    const PlanFigure figure{PlanShape::Rhombus, std::sqrt(area(p)) / 15, 0, 24};
    o.junctionAt = [figure](uint32_t, uint32_t, uint32_t, uint32_t, uint64_t) {
      return JunctionPick{figure, 1};
    };
    const GridResult g = gridPartition(p, o);
    ASSERT_EQ(g.problem, GridProblem::None) << name;
    expectPartition(p, g.pieces, name);
    EXPECT_EQ(wrongOrigins(p, g.pieces), 0u) << name;
  });
}

TEST(Peel, GivesAnLFromTwoSides) {
  const Polygon quarter{{{0, 0}, {9, 0}, {9, 8}, {8, 9}, {0, 9}}, {}};
  const PeelEdge edges[] = {{0, 0, 1, 0.75}, {4, 0, 1, 0.75}};
  const PeelResult r = peel(quarter, edges, PeelEnds::Follow);
  ASSERT_EQ(r.strips.size(), 1u);
  ASSERT_EQ(r.rest.size(), 1u);
  EXPECT_NEAR(area(r.strips[0].polygon), 12.9375, 1e-4);
  EXPECT_EQ(r.strips[0].polygon.outer.size(), 6u);
  EXPECT_EQ(r.rest[0].polygon.outer.size(), 5u);
}

TEST(Peel, FollowsTheNeighbourOrEndsSquare) {
  // A trapezoid whose right side leans outward.
  const Polygon p{{{0, 0}, {10, 0}, {14, 4}, {0, 4}}, {}};
  const PeelEdge bottom[] = {{0, 0, 1, 1}};
  EXPECT_NEAR(area(peel(p, bottom, PeelEnds::Follow).strips[0].polygon), 10.5, 1e-4);
  EXPECT_NEAR(area(peel(p, bottom, PeelEnds::Orthogonal).strips[0].polygon), 10, 1e-4);
}

TEST(Peel, HoldsOnTheCorpus) {
  for (const PeelEnds ends : {PeelEnds::Follow, PeelEnds::Orthogonal}) {
    overCorpus(3 * kStride, [&](const Polygon& p, const std::string& name) {
      std::vector<PeelEdge> edges;
      const double d = std::sqrt(area(p)) * 0.04;
      for (uint32_t i = 0; i < edgeCount(p); ++i) {
        if (randomUnit(hashCombine(area(p) > 0 ? i : 0, 7)) < 0.5) edges.push_back({i, 0, 1, d});
      }
      const PeelResult r = peel(p, edges, ends);
      std::vector<RegionPiece> all = r.strips;
      all.insert(all.end(), r.rest.begin(), r.rest.end());
      expectPartition(p, all, name);
      EXPECT_EQ(wrongOrigins(p, all), 0u) << name;
    });
  }
}

TEST(Contract, StaysInsideOnTheCorpus) {
  overCorpus(2 * kStride, [](const Polygon& p, const std::string& name) {
    const double d = std::sqrt(area(p)) * 0.03;
    double sum = 0;
    for (const RegionPiece& piece : contract(p, d)) {
      sum += area(piece.polygon);
      EXPECT_TRUE(isValid(piece.polygon)) << name;
      EXPECT_LT(area(subtract({piece.polygon}, {p})), 2 * kRegionGrid * perimeter(p)) << name;
    }
    EXPECT_LT(sum, area(p)) << name;
    for (const RegionPiece& piece : contractTowards(p, 0.3, middleOf(p))) {
      EXPECT_LT(area(subtract({piece.polygon}, {p})), 2 * kRegionGrid * perimeter(p)) << name;
    }
  });
}

TEST(Places, MiddlesLieInside) {
  overCorpus(2 * kStride, [](const Polygon& p, const std::string& name) {
    EXPECT_EQ(locate(p, middleOf(p)), Where::Inside) << name;
  });
}

TEST(Places, DiscsAreDisjointAndInside) {
  overCorpus(10 * kStride, [](const Polygon& p, const std::string& name) {
    ScatterOptions o;
    const double r = std::sqrt(area(p));
    o.count = 8;
    o.least = 0.01 * r;
    o.most = 0.05 * r;
    const std::vector<Disc> discs = scatterDiscs(p, o);
    for (size_t i = 0; i < discs.size(); ++i) {
      EXPECT_GE(signedDistance(p, discs[i].centre), discs[i].radius) << name;
      for (size_t k = 0; k < i; ++k) {
        EXPECT_GE(length(discs[i].centre - discs[k].centre), discs[i].radius + discs[k].radius);
      }
    }
  });
  const std::vector<Vec2> points = scatterPoisson(rect(40, 30), 2, 0.5, 1000, 3);
  EXPECT_GT(points.size(), 150u);
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t k = 0; k < i; ++k) EXPECT_GE(length(points[i] - points[k]), 2);
  }
}

TEST(Voronoi, HoldsOnTheCorpus) {
  overCorpus(kStride, [](const Polygon& p, const std::string& name) {
    const std::vector<Disc> sites = corpus::sitesIn(p, 8);
    if (sites.empty()) return;
    VoronoiOptions o;
    const VoronoiResult bare = voronoiPartition(p, sites, o);
    expectPartition(p, bare.pieces, name);
    EXPECT_EQ(wrongOrigins(p, bare.pieces), 0u) << name;
    EXPECT_EQ(countOf(bare.pieces, PieceKind::Cell), bare.sites.size()) << name;
  });
}

TEST(Voronoi, SmoothsWithinTheCellOnTheCorpus) {
  overCorpus(10 * kStride, [](const Polygon& p, const std::string& name) {
    const std::vector<Disc> sites = corpus::sitesIn(p, 6);
    if (sites.empty()) return;
    VoronoiOptions o;
    o.pathWidth = std::sqrt(area(p)) / 30;
    for (const Smoothing::Kind kind :
         {Smoothing::Kind::Average, Smoothing::Kind::Chaikin, Smoothing::Kind::Round}) {
      o.smoothing.kind = kind;
      o.smoothing.radius = o.pathWidth;
      expectPartition(p, voronoiPartition(p, sites, o).pieces, name);
    }
    o.borderPath = false;
    expectPartition(p, voronoiPartition(p, sites, o).pieces, name + " border");
  });
}

TEST(Voronoi, BuildsSomethingAtTheSites) {
  const Disc sites[] = {{{5, 5}, 2}, {{15, 5}, 1}};
  VoronoiOptions o;
  o.pathWidth = 1;
  o.centres = true;
  const Polygon p = rect(20, 10);
  const VoronoiResult r = voronoiPartition(p, sites, o);
  EXPECT_EQ(countOf(r.pieces, PieceKind::Remainder), 2u);
  expectPartition(p, r.pieces, "centres");
}

std::vector<RayTarget> cornersOf(const Polygon& p) {
  std::vector<RayTarget> out;
  for (const Vec2 v : p.outer) out.push_back({RayTarget::Kind::Point, v});
  return out;
}

TEST(Rays, CastToTheCornersOfARectangle) {
  const Polygon p = rect(40, 30);
  RayOptions o;
  o.pathWidth = 2;
  o.centre = {PlanShape::Circle, 5, 0, 24};
  const Vec2 centre[] = {{20, 15}};
  const RayResult r = castRays(p, centre, cornersOf(p), o);
  EXPECT_EQ(countOf(r.pieces, PieceKind::Cell), 4u);
  EXPECT_EQ(countOf(r.pieces, PieceKind::Path), 4u);
  EXPECT_NEAR(areaOf(r.pieces, PieceKind::Cell), 966.05, 0.01);
  EXPECT_NEAR(areaOf(r.pieces, PieceKind::Path), 156.31, 0.01);
  EXPECT_NEAR(areaOf(r.pieces, PieceKind::Junction), 77.65, 0.01);
}

TEST(Rays, LeaveOutCornersThatAreHidden) {
  const Polygon c{{{0, 0}, {30, 0}, {30, 8}, {10, 8}, {10, 22}, {30, 22}, {30, 30}, {0, 30}}, {}};
  RayOptions o;
  o.pathWidth = 1;
  const Vec2 centre[] = {{5, 4}};
  EXPECT_EQ(castRays(c, centre, cornersOf(c), o).rays, 6u);
}

TEST(Rays, JoinCentresWithoutCrossings) {
  const Polygon p = rect(60, 40);
  const std::vector<Disc> sites = corpus::sitesIn(p, 7);
  std::vector<Vec2> centres;
  for (const Disc& d : sites) centres.push_back(d.centre);
  RayOptions o;
  o.pathWidth = 1;
  const std::pair<CentreLinks, uint32_t> wanted[] = {
      {CentreLinks::None, 0}, {CentreLinks::Tree, 6}, {CentreLinks::Pairs, 3}};
  for (const auto& [links, count] : wanted) {
    o.links = links;
    const RayResult r = castRays(p, centres, cornersOf(p), o);
    if (links != CentreLinks::Pairs) {
      EXPECT_EQ(r.links, count);
    } else {
      EXPECT_LE(r.links, count);
    }
    expectPartition(p, r.pieces, "links");
  }
  o.links = CentreLinks::Loop;
  EXPECT_GE(castRays(p, centres, cornersOf(p), o).links, 5u);
}

// Paths to many corners, one by one: each within the region, beside the centre and its neighbours.
TEST(Rays, PathsOfStarsAreWholeAndApart) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    Polygon p;
    const int n = 5 + static_cast<int>(seed) * 2;
    for (int i = 0; i < n; ++i) {
      const double a = 360.0 * i / n;
      const double r = 30 * (1 - 0.8 * randomUnit(hashCombine(seed, static_cast<uint64_t>(i))));
      p.outer.push_back({r * cosDeg(a) + 1000.3, r * sinDeg(a) - 77});
    }
    RayOptions o;
    o.pathWidth = 0.2 + 0.1 * static_cast<double>(seed % 9);
    o.centre = {seed % 2 == 0 ? PlanShape::Circle : PlanShape::Square, 2, 0, 24};
    const Vec2 centre[] = {{1000.3, -77}};
    const RayResult r = castRays(p, centre, cornersOf(p), o);
    EXPECT_GT(r.rays, 4u);
    expectPartition(p, r.pieces, "star " + std::to_string(seed));
    Region paths, others;
    double sum = 0;
    for (const RegionPiece& piece : r.pieces) {
      (piece.kind == PieceKind::Path ? paths : others).push_back(piece.polygon);
      if (piece.kind == PieceKind::Path) sum += area(piece.polygon);
    }
    EXPECT_NEAR(area(unite(paths, {})), sum, 1e-3);
    EXPECT_NEAR(area(subtract({p}, others)), sum, 1e-2);
  }
}

TEST(Rays, HoldOnTheCorpus) {
  overCorpus(kStride, [](const Polygon& p, const std::string& name) {
    const Vec2 centre[] = {poleOf(p).centre};
    RayOptions o;
    expectPartition(p, castRays(p, centre, cornersOf(p), o).pieces, name);
  });
  overCorpus(5 * kStride, [](const Polygon& p, const std::string& name) {
    const Vec2 centre[] = {poleOf(p).centre};
    RayOptions o;
    o.pathWidth = std::sqrt(area(p)) / 40;
    o.centre = {PlanShape::Circle, o.pathWidth * 2, 0, 24};
    const RayResult r = castRays(p, centre, cornersOf(p), o);
    expectPartition(p, r.pieces, name + " with paths");
    EXPECT_EQ(wrongOrigins(p, r.pieces), 0u) << name;
  });
}

TEST(Along, ParametrisesASquare) {
  const Polygon p = rect(10, 10);
  // Counter-clockwise south, east, north, west.
  const uint32_t logical[] = {3, 2, 1, 0};
  const LogicalRange ends[] = {{0, 0.1, 0.9}, {2, 0.1, 0.9}};
  const std::vector<Polyline> two = parametrise(p.outer, logical, ends, true);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(two[0].length(), 8, 1e-12);
  EXPECT_EQ(two[0].points[0], (Vec2{0, 1}));
  EXPECT_EQ(two[1].points[0], (Vec2{10, 9}));
  const LogicalRange joined[] = {{0, 0.02, 1}, {1, 0, 1}, {2, 0, 0.15}};
  const std::vector<Polyline> one = parametrise(p.outer, logical, joined, true);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].length(), 9.8 + 10 + 1.5, 1e-12);
}

TEST(Along, SpacesExactlyAndEvenly) {
  const Polyline line{{{0, 0}, {9, 0}}, false};
  const std::vector<Station> trees = spaced(line, 2);
  ASSERT_EQ(trees.size(), 5u);
  EXPECT_NEAR(trees[0].at.x, 0.5, 1e-12);
  EXPECT_NEAR(trees[4].at.x, 8.5, 1e-12);
  EXPECT_EQ(evenly(line, 3, true, true).size(), 4u);
  EXPECT_EQ(evenly(line, 3, false, false).size(), 2u);
}

TEST(Along, RibbonsOfClosedLinesAreRings) {
  const Polyline ring{{{2, 2}, {8, 2}, {8, 8}, {2, 8}}, true};
  const std::vector<RegionPiece> r = ribbons(rect(10, 10), {&ring, 1}, 1);
  ASSERT_EQ(r.size(), 1u);
  EXPECT_EQ(r[0].polygon.holes.size(), 1u);
  EXPECT_NEAR(area(r[0].polygon), 24, 1e-3);
}

TEST(Autoindex, CountsClockwiseFromTheSouthWest) {
  EXPECT_EQ(autoindex(rect(20, 10).outer).of, (std::vector<uint32_t>{3, 2, 1, 0}));
  // The same, from another start and with a chopped corner.
  const Ring r{{20, 8}, {18, 10}, {0, 10}, {0, 0}, {20, 0}};
  const LogicalEdges e = sidesOf(r);
  EXPECT_EQ(e.of[1], 1u);
  EXPECT_EQ(e.of[2], 0u);
  EXPECT_EQ(e.of[3], 3u);
  EXPECT_EQ(e.of[4], 2u);
}

TEST(Autoindex, FindsTheCornersOfNoisyQuads) {
  int right = 0;
  constexpr int kQuads = 2000;
  for (uint64_t q = 0; q < kQuads; ++q) {
    const auto draw = [&](uint64_t k, double lo, double hi) {
      return randomIn(hashCombine(q, k), lo, hi);
    };
    const double w = draw(0, 20, 60), h = draw(1, 20, 60);
    const Vec2 corner[4] = {{draw(2, -3, 3), draw(3, -3, 3)},
                            {w + draw(4, -3, 3), draw(5, -3, 3)},
                            {w + draw(6, -3, 3), h + draw(7, -3, 3)},
                            {draw(8, -3, 3), h + draw(9, -3, 3)}};
    Ring r;
    std::vector<uint32_t> wanted;
    for (uint32_t k = 0; k < 4; ++k) {
      const Vec2 a = corner[k], b = corner[(k + 1) % 4];
      const int n = 1 + static_cast<int>(draw(10 + k, 0, 8));
      for (int i = 0; i < n; ++i) {
        Vec2 p = a + (b - a) * (static_cast<double>(i) / n);
        if (i > 0) {
          p = p + normalized(perpendicular(b - a)) *
                      draw(100 + 20 * k + static_cast<uint64_t>(i), -0.8, 0.8);
        }
        r.push_back(p);
        wanted.push_back(3 - k);
      }
    }
    // The longer side is along x, so the count may begin a quarter later.
    std::vector<uint32_t> found = sidesOf(r).of;
    const uint32_t turn = (wanted[0] + 4 - found[0]) % 4;
    for (uint32_t& side : found) side = (side + turn) % 4;
    right += found == wanted;
  }
  EXPECT_GE(right, 1990);
}

}  // namespace
}  // namespace gable
