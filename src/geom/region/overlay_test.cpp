// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/overlay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/random.h"
#include "geom/region/clean.h"
#include "geom/region/snap_round.h"

namespace gable {
namespace {

Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::map<uint32_t, double> areasOf(const std::vector<OverlayPiece>& pieces) {
  std::map<uint32_t, double> out;
  for (const OverlayPiece& p : pieces) out[p.layer] += area(p.polygon);
  return out;
}

// The promises: areas add up, polygons are valid, edges have their counterpart.
void expectWhole(const std::vector<OverlayPiece>& pieces, double whole) {
  double sum = 0;
  std::map<std::tuple<double, double, double, double>, uint32_t> edges;
  for (uint32_t i = 0; i < pieces.size(); ++i) {
    const OverlayPiece& p = pieces[i];
    sum += area(p.polygon);
    EXPECT_TRUE(isValid(p.polygon)) << "piece " << i << " of layer " << p.layer;
    for (const Segment& s : edgesOf(p.polygon)) {
      EXPECT_TRUE(edges.emplace(std::tuple(s.a.x, s.a.y, s.b.x, s.b.y), i).second);
    }
  }
  EXPECT_NEAR(sum, whole, 1e-9 * whole);
  for (uint32_t i = 0; i < pieces.size(); ++i) {
    const std::vector<Segment> own = edgesOf(pieces[i].polygon);
    ASSERT_EQ(own.size(), pieces[i].beyond.size());
    for (size_t k = 0; k < own.size(); ++k) {
      const auto at = edges.find({own[k].b.x, own[k].b.y, own[k].a.x, own[k].a.y});
      const uint32_t other = at == edges.end() ? OverlayPiece::kNothing : at->second;
      EXPECT_EQ(pieces[i].beyond[k], other);
    }
  }
}

TEST(Overlay, TheLastLayerHasThePlace) {
  const std::vector<OverlayLayer> layers{
      {{box(0, 0, 10, 10)}}, {{box(2, 2, 8, 8)}}, {{box(4, 4, 12, 6)}}};
  const std::vector<OverlayPiece> pieces = overlay(layers);
  expectWhole(pieces, 100);
  const auto areas = areasOf(pieces);
  EXPECT_DOUBLE_EQ(areas.at(0), 100 - 36 - 4);
  EXPECT_DOUBLE_EQ(areas.at(1), 36 - 8);
  EXPECT_DOUBLE_EQ(areas.at(2), 12);
}

TEST(Overlay, HolesAndIslandsNest) {
  std::vector<OverlayLayer> layers{{{box(0, 0, 100, 100)}}};
  for (int k = 1; k < 10; ++k) {
    const double d = 5.0 * k;
    layers.push_back({{box(d, d, 100 - d, 100 - d)}});
  }
  const std::vector<OverlayPiece> pieces = overlay(layers);
  ASSERT_EQ(pieces.size(), 10u);
  expectWhole(pieces, 1e4);
  for (const OverlayPiece& p : pieces) EXPECT_EQ(p.polygon.holes.size(), p.layer < 9 ? 1u : 0u);
}

TEST(Overlay, FillRulesAreKept) {
  // A ring that goes round twice, and one that goes the other way.
  Ring twice = box(1, 1, 5, 5);
  const Ring again = twice;
  twice.insert(twice.end(), again.begin(), again.end());
  const Ring turned{{1, 1}, {1, 5}, {5, 5}, {5, 1}};
  const auto covered = [&](const Ring& r, FillRule fill) {
    const auto areas =
        areasOf(overlay(std::vector<OverlayLayer>{{{box(0, 0, 9, 9)}}, {{r}, fill}}));
    return areas.count(1) ? areas.at(1) : 0;
  };
  EXPECT_EQ(covered(twice, FillRule::EvenOdd), 0);
  EXPECT_EQ(covered(twice, FillRule::NonZero), 16);
  EXPECT_EQ(covered(turned, FillRule::NonZero), 16);
  EXPECT_EQ(covered(turned, FillRule::Positive), 0);
}

TEST(Overlay, ThinPiecesGoToTheirNeighbour) {
  const std::vector<OverlayLayer> layers{
      {{box(0, 0, 10, 10)}}, {{box(0, 0, 5, 10)}}, {{box(5.02, 0, 10, 10)}}};
  const std::vector<OverlayPiece> pieces = overlay(layers);
  expectWhole(pieces, 100);
  EXPECT_EQ(areasOf(pieces).count(0), 0u);
}

TEST(Overlay, HostileRingsDoNoHarm) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const std::vector<OverlayLayer> layers{
      {{box(0, 0, 10, 10)}},
      {{{{nan, 0}, {1, 1}, {2, 0}}, {{inf, 0}, {1, 1}, {2, 0}}}},
      {{{}, {{1, 1}}, {{1, 1}, {2, 2}}, {{3, 3}, {3, 3}, {3, 3}}}},
      {{{{1, 1}, {9, 9}, {9, 1}, {1, 9}}}},
      {{{{-1e9, 4}, {1e9, 4}, {1e9, 5}, {-1e9, 5}}}}};
  const std::vector<OverlayPiece> pieces = overlay(layers);
  expectWhole(pieces, 100);
  EXPECT_NEAR(areasOf(pieces).at(4), 10, 1e-9);
  EXPECT_TRUE(overlay({}).empty());
  EXPECT_TRUE(overlay(std::vector<OverlayLayer>{{{{{nan, nan}, {1, 1}, {2, 2}}}}}).empty());
}

// Stars across each other, on a fine grid and on one so coarse that everything is moved.
TEST(Overlay, RandomOutlinesAddUp) {
  for (const double grid : {0x1.0p-8, 0.25, 1.0}) {
    for (uint64_t seed = 0; seed < 12; ++seed) {
      std::vector<OverlayLayer> layers{{{box(0, 0, 64, 64)}}};
      uint64_t draw = 0;
      const auto next = [&] { return randomUnit(seed * 1000003 + ++draw); };
      for (int l = 0; l < 20; ++l) {
        Ring r;
        const Vec2 c{next() * 64, next() * 64};
        for (int k = 0; k < 9; ++k)
          r.push_back({c.x + 24 * (next() - 0.5), c.y + 24 * (next() - 0.5)});
        layers.push_back({{r}, l % 2 ? FillRule::NonZero : FillRule::EvenOdd});
      }
      OverlayOptions options;
      options.grid = grid;
      options.thin = seed % 2 ? 0 : 0.5;
      expectWhole(overlay(layers, options), 64 * 64);
    }
  }
}

TEST(SnapRound, PiecesMeetInEndsOnly) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<GridSegment> segments;
    uint64_t draw = 0;
    const auto next = [&] {
      return static_cast<int64_t>(randomUnit(seed * 1000003 + ++draw) * 24);
    };
    for (int k = 0; k < 40; ++k) segments.push_back({{next(), next()}, {next(), next()}});
    const Snapped s = snapRound(segments);
    for (const SnappedPiece& p : s.pieces) {
      const GridPoint a = s.points[p.from], b = s.points[p.to];
      for (const GridPoint q : s.points) {
        const bool within =
            turn(a, b, q) == 0 && (q.x - a.x) * (q.x - b.x) <= 0 && (q.y - a.y) * (q.y - b.y) <= 0;
        EXPECT_TRUE(!within || q == a || q == b);
      }
      for (const SnappedPiece& r : s.pieces) {
        const GridPoint c = s.points[r.from], d = s.points[r.to];
        const bool apart = turn(a, b, c) * turn(a, b, d) >= 0 || turn(c, d, a) * turn(c, d, b) >= 0;
        EXPECT_TRUE(apart);
      }
    }
  }
}

}  // namespace
}  // namespace gable
