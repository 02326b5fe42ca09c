// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/line.h"

#include <gtest/gtest.h>

#include <set>

#include "geom/region/clean.h"
#include "geom/region/corpus.h"

namespace gable {
namespace {

TEST(Line, splitsASquareAndSaysWhereEdgesComeFrom) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}};
  const double at[] = {1};
  const std::vector<StripPiece> pieces = splitIntoStrips(p, {1, 0}, at);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].polygon.outer, (Ring{{0, 0}, {1, 0}, {1, 3}, {0, 3}}));
  EXPECT_EQ(pieces[0].edgeOrigin, (std::vector<uint32_t>{0, StripPiece::kOnLine, 2, 3}));
  EXPECT_EQ(pieces[1].polygon.outer, (Ring{{1, 0}, {4, 0}, {4, 3}, {1, 3}}));
  EXPECT_EQ(pieces[1].edgeOrigin, (std::vector<uint32_t>{0, 1, 2, StripPiece::kOnLine}));
}

TEST(Line, leftIsFirst) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}};
  const std::vector<StripPiece> pieces = splitByLine(p, {0, 1}, {1, 0});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_DOUBLE_EQ(area(pieces[0].polygon), 8);
  EXPECT_DOUBLE_EQ(area(pieces[1].polygon), 4);
}

TEST(Line, aLineAlongAnEdgeOrOutsideCutsNothing) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}};
  const double offsets[] = {-1, 0, 4, 9};
  const std::vector<StripPiece> pieces = splitIntoStrips(p, {1, 0}, offsets);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].strip, 2u);
  EXPECT_EQ(pieces[0].polygon.outer, p.outer);
}

TEST(Line, aCombFallsIntoItsTeeth) {
  const Polygon p{{{0, 0},
                   {7, 0},
                   {7, 3},
                   {5, 3},
                   {5, 1},
                   {4, 1},
                   {4, 3},
                   {2, 3},
                   {2, 1},
                   {1, 1},
                   {1, 3},
                   {0, 3}},
                  {}};
  const double offsets[] = {1, 2};
  const std::vector<StripPiece> pieces = splitIntoStrips(p, {0, 1}, offsets);
  std::vector<size_t> count(3);
  for (const StripPiece& piece : pieces) ++count[piece.strip];
  EXPECT_EQ(count, (std::vector<size_t>{1, 3, 3}));
}

std::set<std::pair<double, double>> pointsOn(const std::vector<StripPiece>& pieces, uint32_t strip,
                                             uint32_t line) {
  std::set<std::pair<double, double>> out;
  for (const StripPiece& piece : pieces) {
    if (piece.strip != strip) continue;
    size_t edge = 0;
    for (const Ring& r : ringsOf({piece.polygon})) {
      for (size_t i = 0; i < r.size(); ++i, ++edge) {
        if (piece.edgeOrigin[edge] != StripPiece::kOnLine + line) continue;
        out.insert({r[i].x, r[i].y});
        out.insert({r[(i + 1) % r.size()].x, r[(i + 1) % r.size()].y});
      }
    }
  }
  return out;
}

TEST(Line, corpusStripsAddUpAndShareTheirPoints) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  size_t pieceCount = 0, valid = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    const double angle = i % 2 ? 0 : randomIn(i, 0, 360);
    const Vec2 normal{cosDeg(angle), sinDeg(angle)};
    std::vector<double> offsets = {dot(normal, p.outer[0])};
    for (uint64_t k = 0; k < 5; ++k) {
      const double t = randomUnit(hashCombine(i, k));
      offsets.push_back(dot(normal, p.outer[k % p.outer.size()] * t + p.outer[1] * (1 - t)));
    }
    std::sort(offsets.begin(), offsets.end());
    const auto near = [](double a, double b) { return b - a < 1e-5; };
    offsets.erase(std::unique(offsets.begin(), offsets.end(), near), offsets.end());
    const std::vector<StripPiece> pieces = splitIntoStrips(p, normal, offsets);
    double sum = 0;
    const std::vector<Segment> sources = edgesOf(p);
    for (const StripPiece& piece : pieces) {
      sum += area(piece.polygon);
      ++pieceCount;
      valid += isValid(piece.polygon) ? 1 : 0;
      const std::vector<Segment> edges = edgesOf(piece.polygon);
      ASSERT_EQ(edges.size(), piece.edgeOrigin.size());
      const double slack = 1e-8 * length(bounds(p).size());
      for (size_t e = 0; e < edges.size(); ++e) {
        const uint32_t from = piece.edgeOrigin[e];
        const Vec2 middle = (edges[e].a + edges[e].b) * 0.5;
        if (from < StripPiece::kOnLine) {
          ASSERT_LE(distanceTo(sources[from], middle), slack) << i;
        } else {
          ASSERT_NEAR(dot(normal, middle), offsets[from - StripPiece::kOnLine], slack) << i;
        }
      }
    }
    ASSERT_NEAR(sum, area(p), 1e-8 * area(p)) << i;
    for (uint32_t k = 0; k < offsets.size(); ++k) {
      ASSERT_EQ(pointsOn(pieces, k, k), pointsOn(pieces, k + 1, k)) << i;
    }
  }
  // Cuts through points within rounding of each other may leave a ring that touches itself.
  EXPECT_GE(valid * 1000, pieceCount * 995) << valid << " of " << pieceCount;
}

}  // namespace
}  // namespace gable
