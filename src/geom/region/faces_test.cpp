// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/region/faces.h"

#include <gtest/gtest.h>

#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"
#include "geom/region/piece.h"

namespace gable {
namespace {

std::vector<Segment> turnedRound(const Polygon& p) {
  std::vector<Segment> out;
  for (const Segment& s : edgesOf(p)) out.push_back({s.b, s.a});
  return out;
}

double areaOf(const std::vector<Face>& faces) {
  double sum = 0;
  for (const Face& f : faces) sum += area(f.polygon);
  return sum;
}

const Polygon kSquare{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}};

TEST(Faces, ChordsDivide) {
  const std::vector<Segment> chords{{{0, 1}, {4, 1}}, {{4, 1}, {0, 4}}};
  std::vector<Face> faces;
  ASSERT_TRUE(facesOf(edgesOf(kSquare), chords, 1e-5, faces));
  ASSERT_EQ(faces.size(), 3u);
  EXPECT_DOUBLE_EQ(areaOf(faces), 16);
  // The one below the first chord: three edges and the chord the other way round.
  EXPECT_EQ(faces[0].edges, (std::vector<uint32_t>{0, 1, 5, 3}));
}

TEST(Faces, EdgesThatMeetVanish) {
  const Polygon corner{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};
  std::vector<Segment> edges = edgesOf(kSquare);
  for (const Segment& s : turnedRound(corner)) edges.push_back(s);
  std::vector<Face> faces;
  ASSERT_TRUE(facesOf(edges, {}, 1e-5, faces));
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].polygon.outer.size(), 6u);
  EXPECT_DOUBLE_EQ(areaOf(faces), 12);
}

TEST(Faces, IslandsBecomeHoles) {
  const Polygon island{{{1, 1}, {2, 1}, {2, 2}}, {}};
  std::vector<Segment> edges = edgesOf(kSquare);
  for (const Segment& s : turnedRound(island)) edges.push_back(s);
  std::vector<Face> faces;
  ASSERT_TRUE(facesOf(edges, {}, 1e-5, faces));
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].polygon.holes.size(), 1u);
  EXPECT_EQ(faces[0].edges.size(), 7u);
  // With chords from it to the outline it is none any more.
  const std::vector<Segment> chords{{{0, 0}, {1, 1}}, {{2, 2}, {4, 4}}};
  ASSERT_TRUE(facesOf(edges, chords, 1e-5, faces));
  EXPECT_EQ(faces.size(), 2u);
  EXPECT_DOUBLE_EQ(areaOf(faces), 15.5);
}

TEST(Faces, GivesNothingWhereEdgesCrossOrStayOpen) {
  std::vector<Face> faces;
  std::vector<Segment> open = edgesOf(kSquare);
  open.pop_back();
  EXPECT_FALSE(facesOf(open, {}, 1e-5, faces));
  const std::vector<Segment> bowtie = edgesOf(Polygon{{{0, 0}, {4, 4}, {4, 0}, {0, 3}}, {}});
  EXPECT_FALSE(facesOf(bowtie, {}, 1e-5, faces));
  const std::vector<Segment> crossing{{{0, 0}, {4, 4}}, {{0, 4}, {4, 0}}};
  EXPECT_FALSE(facesOf(edgesOf(kSquare), crossing, 1e-5, faces));
  std::vector<Segment> over = edgesOf(kSquare);
  for (const Segment& s : turnedRound({{{3, 3}, {5, 3}, {5, 5}, {3, 5}}, {}})) over.push_back(s);
  EXPECT_FALSE(facesOf(over, {}, 1e-5, faces));
  EXPECT_TRUE(faces.empty());
}

// What a strip, an inset and a quarter leave is what the boolean leaves.
TEST(Faces, AgreeWithTheBooleanOnTheCorpus) {
  const auto cases = corpus::loadCorpus(11);
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not here";
  size_t without = 0, all = 0;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Polygon p = corpus::withHoles(cases[i].ring, i);
    const Box2 box = bounds(p);
    const Vec2 m = box.center();
    const Region parts = intersect({p}, {{{box.min, {m.x, box.min.y}, m, {box.min.x, m.y}}, {}},
                                         {{m, {box.max.x, m.y}, box.max, {m.x, box.max.y}}, {}}});
    std::vector<Segment> edges = edgesOf(p);
    for (const Polygon& part : parts) {
      for (const Segment& s : turnedRound(part)) edges.push_back(s);
    }
    std::vector<Face> faces;
    ++all;
    without += !facesOf(edges, {}, 2 * kRegionGrid, faces);
    Region left;
    for (const Face& f : faces) {
      left.push_back(f.polygon);
      EXPECT_EQ(f.edges.size(), edgeCount(f.polygon));
    }
    if (faces.empty()) continue;
    EXPECT_TRUE(isValid(left)) << i;
    EXPECT_NEAR(area(left), area(subtract({p}, parts)), 8 * kRegionGrid * perimeter(p)) << i;
    EXPECT_LT(area(intersect(left, parts)), 8 * kRegionGrid * perimeter(p)) << i;
  }
  // The boolean is for the few that are in doubt.
  EXPECT_LT(without, all / 10);
}

}  // namespace
}  // namespace gable
