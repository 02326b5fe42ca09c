// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/plan/crenellation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "geom/region/hull.h"

namespace gable {
namespace {

double sum(const std::vector<CrenellationPart>& parts) {
  double out = 0;
  for (const CrenellationPart& p : parts) out += area(p.polygon);
  return out;
}

// No part overlaps another by more than the grid of results can make of their borders.
void expectApart(const Crenellation& c, double whole) {
  Region all = c.rest;
  double parts = area(c.rest);
  for (const auto* list : {&c.merlons, &c.crenels}) {
    for (const CrenellationPart& p : *list) {
      all.push_back(p.polygon);
      parts += area(p.polygon);
    }
  }
  EXPECT_NEAR(area(unite(all, {})), parts, 1e-4 * (1 + whole));
}

TEST(Crenellation, C6_countsMerlonsByTheFormula) {
  for (const auto& [w, d] : {std::pair{10.0, 6.0}, {30.0, 8.0}, {2.0, 2.0}, {61.3, 17.7}}) {
    const CrenellationOptions o{1.5, 0.75, 0.5};
    const auto gaps = [&](double l) {
      return std::max(0.0, std::nearbyint((l - o.merlon) / (o.merlon + o.gap)));
    };
    const Polygon box{{{0, 0}, {w, 0}, {w, d}, {0, d}}, {}};
    const Crenellation c = crenellate(box, o);
    const double wanted = std::max(1.0, 2 * gaps(w) + 2 * gaps(d));
    EXPECT_EQ(static_cast<double>(c.merlons.size()), wanted) << w << " x " << d;
    EXPECT_EQ(merlonCount(box, o), wanted);
    if (wanted > 1) {
      EXPECT_EQ(c.crenels.size(), c.merlons.size());
    }
    expectApart(c, area(box));
  }
}

TEST(Crenellation, C6_allLieOnTheOutline) {
  const Polygon court{{{0, 0}, {40, 0}, {40, 30}, {12, 30}, {12, 22}, {0, 22}},
                      {{{20, 8}, {20, 16}, {30, 16}, {30, 8}}}};
  const Crenellation c = crenellate(court, {1.6, 0.8, 0.5});
  EXPECT_GT(c.merlons.size(), 40u);
  for (const auto* list : {&c.merlons, &c.crenels}) {
    for (const CrenellationPart& p : *list) {
      const Ring& r = p.polygon.outer;
      const Vec2 middle = (r[p.front] + r[(p.front + 1) % r.size()]) * 0.5;
      EXPECT_LT(distanceToBoundary(court, middle), 1e-3);
      for (const Vec2 at : r) EXPECT_LT(distanceToBoundary(court, at), 0.5 * std::sqrt(2.0) + 1e-3);
    }
  }
}

TEST(Crenellation, beginsAndEndsSidesWithAMerlon) {
  const Polygon box{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {}};
  const Crenellation c = crenellate(box, {1.5, 0.75, 0.5});
  for (const Vec2 corner : box.outer) {
    const auto at = [&](const CrenellationPart& p) {
      const Ring& r = p.polygon.outer;
      return std::any_of(r.begin(), r.end(), [&](Vec2 q) { return length(q - corner) < 1e-3; });
    };
    EXPECT_EQ(std::count_if(c.merlons.begin(), c.merlons.end(), at), 1);
    EXPECT_EQ(std::count_if(c.crenels.begin(), c.crenels.end(), at), 0);
  }
}

TEST(Crenellation, goesRoundTowersEvenly) {
  Polygon tower;
  for (int i = 0; i < 24; ++i) {
    const double a = 2 * 3.14159265358979 * i / 24;
    tower.outer.push_back({4 * std::cos(a), 4 * std::sin(a)});
  }
  const CrenellationOptions o{1.4, 0.7, 0.5};
  const Crenellation c = crenellate(tower, o);
  EXPECT_EQ(c.merlons.size(), static_cast<size_t>(std::lround(perimeter(tower.outer) / 2.1)));
  double least = 1e9, most = 0;
  for (const CrenellationPart& p : c.merlons) {
    least = std::min(least, area(p.polygon));
    most = std::max(most, area(p.polygon));
  }
  EXPECT_LT(most, 1.1 * least);
  EXPECT_EQ(c.rest.size(), 1u);
}

TEST(Crenellation, makesUpAnyPolygon) {
  const auto corpus = corpus::loadCorpus(25);
  if (corpus.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  size_t crenellated = 0;
  for (size_t i = 0; i < corpus.size(); ++i) {
    Polygon p = corpus::withHoles(corpus[i].ring, i);
    orient(p);
    if (!isValid(p)) continue;
    const double size = std::sqrt(area(p));
    const CrenellationOptions o{size / 20, size / 40, size / 50};
    const Crenellation c = crenellate(p, o);
    const double parts = sum(c.merlons) + sum(c.crenels) + area(c.rest);
    EXPECT_NEAR(parts, area(p), 2e-3 * area(p)) << "case " << i;
    for (const CrenellationPart& m : c.merlons) EXPECT_TRUE(isValid(m.polygon)) << "case " << i;
    if (c.merlons.size() > 10) ++crenellated;
  }
  EXPECT_GT(crenellated, corpus.size() / 2);
}

}  // namespace
}  // namespace gable
