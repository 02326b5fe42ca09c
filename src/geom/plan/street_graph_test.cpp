// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plan/street_graph.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"

namespace gable {
namespace {

Region square(double side) { return {{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}}; }

std::vector<Street> crossroads() { return {{{{0, 50}, {100, 50}}, 10}, {{{50, 0}, {50, 100}}, 8}}; }

std::vector<Street> randomStreets(uint64_t seed, int count) {
  std::vector<Street> out;
  for (int i = 0; i < count; ++i) {
    const auto at = [&](int k) { return randomIn(hashCombine(seed, i * 16 + k), 0, 400); };
    out.push_back({catmullRom(Line{{at(0), at(1)}, {at(2), at(3)}, {at(4), at(5)}}, false, 0.2),
                   4 + 8 * randomUnit(hashCombine(seed, i * 16 + 7))});
  }
  return out;
}

void expectSound(const StreetGraph& g) {
  for (const StreetGraph::Edge& e : g.edges) {
    ASSERT_GE(e.line.size(), 2u);
    EXPECT_EQ(e.line.front(), g.nodes[e.from].point);
    EXPECT_EQ(e.line.back(), g.nodes[e.to].point);
  }
  for (uint32_t n = 0; n < g.nodes.size(); ++n) {
    EXPECT_FALSE(g.nodes[n].edges.empty());
    for (uint32_t e : g.nodes[n].edges) EXPECT_TRUE(g.edges[e].from == n || g.edges[e].to == n);
  }
}

// No two stretches cross between their nodes.
size_t crossings(const StreetGraph& g) {
  std::vector<std::pair<Vec2, Vec2>> s;
  for (const StreetGraph::Edge& e : g.edges) {
    for (size_t i = 0; i + 1 < e.line.size(); ++i) s.emplace_back(e.line[i], e.line[i + 1]);
  }
  size_t count = 0;
  for (size_t i = 0; i < s.size(); ++i) {
    for (size_t k = i + 1; k < s.size(); ++k) {
      const auto side = [](const std::pair<Vec2, Vec2>& l, Vec2 p) {
        return cross(l.second - l.first, p - l.first);
      };
      count += side(s[i], s[k].first) * side(s[i], s[k].second) < -1e-6 &&
               side(s[k], s[i].first) * side(s[k], s[i].second) < -1e-6;
    }
  }
  return count;
}

void expectWhole(const StreetPlan& plan, const Region& area) {
  double sum = 0;
  const auto add = [&](const Region& r) {
    EXPECT_TRUE(isValid(r));
    sum += gable::area(r);
  };
  for (const Region& r : plan.roadways) add(r);
  for (const Region& r : plan.junctions) add(r);
  add(plan.blocks);
  add(plan.islands);
  EXPECT_NEAR(sum, gable::area(area), 1e-5 * gable::area(area));
}

TEST(StreetGraph, makesANodeOfACrossing) {
  const StreetGraph g = buildStreetGraph(crossroads());
  expectSound(g);
  EXPECT_EQ(g.edges.size(), 4u);
  EXPECT_EQ(g.nodes.size(), 5u);
  size_t four = 0;
  for (const auto& n : g.nodes) four += n.edges.size() == 4;
  EXPECT_EQ(four, 1u);
}

TEST(StreetGraph, joinsAnEndNearAStreet) {
  const StreetGraph g = buildStreetGraph({{{{0, 0}, {100, 0}}, 8}, {{{50, 0.6}, {50, 60}}, 6}});
  expectSound(g);
  EXPECT_EQ(g.edges.size(), 3u);
}

TEST(StreetGraph, dropsShortDeadEndsAndKeepsLongOnes) {
  const StreetGraph g = buildStreetGraph(
      {{{{0, 0}, {100, 0}}, 8}, {{{50, 0}, {50, 4}}, 6}, {{{70, 0}, {70, 40}}, 6}});
  EXPECT_EQ(g.edges.size(), 3u);
}

TEST(StreetGraph, keepsDeadEndsAtTheBorder) {
  const Region area = square(100);
  StreetGraphOptions o;
  o.shortest = 40;
  o.area = &area;
  const std::vector<Street> streets{{{{0, 20}, {100, 20}}, 8}, {{{50, 0}, {50, 50}}, 8}};
  // To the border below it stays, into the area above it goes.
  EXPECT_EQ(buildStreetGraph(streets, o).edges.size(), 3u);
}

TEST(StreetGraph, keepsARingAndALoop) {
  const StreetGraph ring = buildStreetGraph({{{{0, 0}, {50, 0}, {50, 50}, {0, 50}, {0, 0}}, 8}});
  expectSound(ring);
  EXPECT_EQ(ring.edges.size(), 1u);
  EXPECT_EQ(ring.nodes.size(), 1u);
}

TEST(StreetGraph, countsDoubledStreetsOnce) {
  const StreetGraph g = buildStreetGraph({{{{0, 0}, {100, 0}}, 8}, {{{0, 0.1}, {100, 0.1}}, 12}});
  ASSERT_EQ(g.edges.size(), 1u);
  EXPECT_EQ(g.edges[0].width, 12);
}

TEST(StreetGraph, isPlaneWhateverCrosses) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const StreetGraph g = buildStreetGraph(randomStreets(seed, 14));
    expectSound(g);
    EXPECT_EQ(crossings(g), 0u) << seed;
  }
}

TEST(StreetGraph, forgetsWhatIsNoPlace) {
  EXPECT_TRUE(buildStreetGraph({}).edges.empty());
  EXPECT_TRUE(buildStreetGraph({{{{0, 0}}, 8}, {{{NAN, 0}, {1, INFINITY}}, 8}}).edges.empty());
}

TEST(StreetPlan, ofACrossroadsHasFourBlocks) {
  const Region area = square(100);
  const StreetPlan plan = planStreets(buildStreetGraph(crossroads()), area);
  expectWhole(plan, area);
  EXPECT_EQ(plan.blocks.size(), 4u);
  size_t junctions = 0;
  for (const Region& j : plan.junctions) junctions += !j.empty();
  EXPECT_EQ(junctions, 1u);
  // The roads themselves and four rounded corners of radius 4.
  double streets = 100 * 100 - gable::area(plan.blocks);
  EXPECT_NEAR(streets, 1000 + 800 - 80 + 4 * (16 - 3.14159 * 4), 0.5);
}

TEST(StreetPlan, makesUpAnyArea) {
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const Region area = square(400);
    const StreetPlan plan =
        planStreets(buildStreetGraph(randomStreets(seed, 12)), area, seed % 2 ? 4 : 0);
    expectWhole(plan, area);
    EXPECT_GT(plan.blocks.size(), 1u);
  }
}

TEST(StreetPlan, withoutStreetsIsOneBlock) {
  const StreetPlan plan = planStreets({}, square(50));
  ASSERT_EQ(plan.blocks.size(), 1u);
  EXPECT_NEAR(gable::area(plan.blocks), 2500, 1e-9);
}

}  // namespace
}  // namespace gable
