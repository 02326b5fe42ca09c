// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/skeleton/envelope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "geom/region/corpus.h"

namespace gable {
namespace {

double volumeOf(const Envelope& e) {
  double sum = 0;
  for (const EnvelopeFace& f : e.faces) {
    for (const auto& l : f.loops) {
      for (size_t i = 1; i + 1 < l.size(); ++i) {
        const Vec3 o = e.vertices[e.faces[0].loops[0][0]];
        sum += dot(e.vertices[l[0]] - o, cross(e.vertices[l[i]] - o, e.vertices[l[i + 1]] - o));
      }
    }
  }
  return sum / 6;
}

size_t openEdges(const Envelope& e) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (const EnvelopeFace& f : e.faces) {
    for (const auto& l : f.loops) {
      for (size_t i = 0; i < l.size(); ++i) {
        ++uses[{l[i], l[(i + 1) % l.size()]}];
        --uses[{l[(i + 1) % l.size()], l[i]}];
      }
    }
  }
  size_t open = 0;
  for (const auto& [edge, n] : uses) open += n != 0;
  return open;
}

using Sides = std::vector<std::vector<EnvelopeSide>>;

TEST(Envelope, closesOverAHouse) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {}};
  const Envelope e = buildEnvelope(p, Sides{{{3, 45}, {3, 90}, {3, 45}, {0, 90}}}, 20);
  ASSERT_TRUE(e.status.ok());
  EXPECT_EQ(openEdges(e), 0u);
  EXPECT_EQ(e.faces.size(), 7u);
  EXPECT_NEAR(volumeOf(e), 10 * (3 * 6 + 9), 1e-9);
}

TEST(Envelope, verticesLieOnlyWhereEdgesBend) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 6}, {0, 6}}, {}};
  const Envelope e = buildEnvelope(p, Sides{{{1, 80}, {2, 80}, {3, 80}, {4, 80}}}, 6);
  ASSERT_TRUE(e.status.ok());
  EXPECT_EQ(openEdges(e), 0u);
  std::map<uint32_t, int> uses;
  for (const EnvelopeFace& f : e.faces) {
    for (const auto& l : f.loops) {
      for (const uint32_t v : l) ++uses[v];
    }
  }
  for (const auto& [v, n] : uses) EXPECT_GE(n, 3) << v;
}

TEST(Envelope, numbersThatMakeNoSolidAreRefused) {
  const Polygon p{{{0, 0}, {10, 0}, {10, 6}}, {}};
  for (const EnvelopeSide s : {EnvelopeSide{-1, 45}, EnvelopeSide{1, 0}, EnvelopeSide{1, 91},
                               EnvelopeSide{NAN, 45}, EnvelopeSide{1, NAN}}) {
    EXPECT_STREQ(buildEnvelope(p, Sides{{s}}, 6).status.code(), "envelope-sides");
  }
  EXPECT_STREQ(buildEnvelope(p, {}, 0).status.code(), "envelope-sides");
}

TEST(Envelope, hostilePolygonsGetClosedEnvelopes) {
  const auto cases = corpus::loadCorpus(8);
  if (cases.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  size_t failed = 0, number = 0;
  for (const corpus::Case& c : cases) {
    const Polygon p = corpus::withHoles(c.ring, ++number);
    Box2 box;
    for (const Vec2 v : p.outer) box.include(v);
    const double unit = length(box.size()) / 20;
    Sides sides(p.holes.size() + 1);
    for (size_t r = 0; r < sides.size(); ++r) {
      const size_t n = r == 0 ? p.outer.size() : p.holes[r - 1].size();
      for (size_t k = 0; k < n; ++k) {
        sides[r].push_back({unit * static_cast<double>(k % 3), k % 4 == 3 ? 90.0 : 45.0});
      }
    }
    const Envelope e = buildEnvelope(p, sides, unit * 3);
    failed += !e.status.ok();
    if (!e.status.ok()) continue;
    EXPECT_EQ(openEdges(e), 0u) << number;
    EXPECT_GT(volumeOf(e), 0) << number;
  }
  EXPECT_EQ(failed, 0u);
}

}  // namespace
}  // namespace gable
