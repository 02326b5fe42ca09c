// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The rows of the acceptance list of the ProGen3d notation, a test each.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "base/files.h"
#include "drawn.h"
#include "io/importers/asset.h"

namespace gable::progen3d_test {
namespace {

Box3 box(const Vec3& min, const Vec3& max) { return {min, max}; }
Vec3 sizeOf(const Body& b) { return b.box.max - b.box.min; }

DrawOptions seeded(double seed) {
  DrawOptions o;
  o.seed = seed;
  return o;
}

void expectBox(const Body& b, const Box3& expected, double tolerance = 1e-4) {
  EXPECT_TRUE(near(b.box, expected, tolerance)) << text(b.box) << " for " << text(expected);
}

void expectShare(size_t count, double calls, double p, double sigmas = 3) {
  EXPECT_NEAR(static_cast<double>(count), calls * p, sigmas * std::sqrt(calls * p * (1 - p)));
}

TEST(Row, R1_rulesStartWithTheFirstAndMissingOnesAreTold) {
  const Drawn d =
      draw("X -> A1 Nowhere\nA1 -> I ( Cube 1 )\nA1 -> I ( Cube 2 )\nZ -> I ( Cube 3 )\n");
  EXPECT_EQ(d.textures(), (std::map<int, int>{{1, 1}}));
  EXPECT_EQ(d.codes(),
            (std::vector<std::string>{"unknown-rule 1:9", "rule-repeated 3:1", "unused-rule 4:1"}));
  EXPECT_EQ(d.rules.startRule(), "X");
}

TEST(Row, R2_startAndEndAreDrawnOnce) {
  const Drawn d = draw("X 1 -> C\nC 3 -> I ( Cube 1 ) | I ( Cube 2 ) T ( 1 0 0 ) | I ( Cube 3 )\n");
  ASSERT_EQ(d.bodies.size(), 5u);
  const int textures[] = {1, 2, 2, 2, 3};
  const double places[] = {0, 0, 1, 2, 3};
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(d.bodies[i].texture, textures[i]);
    expectBox(d.bodies[i], box({places[i] - 0.5, 0, -0.5}, {places[i] + 0.5, 1, 0.5}));
  }
}

TEST(Row, R2_bracketsMayOpenAtTheStartAndCloseAtTheEnd) {
  const Drawn d =
      draw("X -> C I ( Cube 9 )\nC 2 -> [ T ( 5 0 0 ) | I ( Cube 1 ) T ( 1 0 0 ) | ]\n");
  ASSERT_EQ(d.bodies.size(), 3u);
  EXPECT_TRUE(d.messages().empty());
  expectBox(d.bodies[1], box({5.5, 0, -0.5}, {6.5, 1, 0.5}));
  expectBox(d.bodies[2], box({-0.5, 0, -0.5}, {0.5, 1, 0.5}));
}

TEST(Row, R3_ofTwoSectionsTheFirstIsDrawnOnceAndTheSecondRepeated) {
  const Drawn d = draw(
      "X -> R Xlength ( 7.3 7.3 ) WindowsXN\n"
      "WindowsXN Xlength -> T ( Xlength/2.0-0.8 0 -1 ) | T ( -0.9 0 0 ) [ S ( 0.8 0.95 0.01 ) "
      "T ( 0.9 0 0 ) I ( Cube ) ]\n");
  ASSERT_EQ(d.bodies.size(), 7u);
  for (size_t i = 0; i < 7; ++i) {
    const double middle = 7.3 / 2 - 0.8 - 0.9 * static_cast<double>(i + 1) + 0.8 * 0.9;
    expectBox(d.bodies[i], box({middle - 0.4, 0, -1.005}, {middle + 0.4, 0.95, -0.995}));
  }
}

TEST(Row, R4_turnsAreTruncated) {
  const Drawn d = draw(
      "X -> R* n ( 3 3 ) A1 B1 C1 D1 E1 F1\nA1 2.9 -> I ( Cube 1 )\nB1 11/4 -> I ( Cube 2 )\n"
      "C1 -3 -> I ( Cube 3 )\nD1 n -> I ( Cube 4 )\nE1 n*2-1 -> I ( Cube 5 )\nF1 0 -> I ( Cube 6 "
      ")\n");
  EXPECT_EQ(d.textures(), (std::map<int, int>{{1, 2}, {2, 2}, {4, 3}, {5, 5}}));
}

TEST(Row, R5_variablesAreDrawnAtEachCallAndReachAllThatIsCalled) {
  // Y draws n; Q and what it calls see it; P draws its own; Z is called outside.
  const Drawn d = draw(
      "X -> R n ( 2 9 ) Y Y Z\nY 2 n -> [ S ( n 1 1 ) I ( Cube 1 ) ] Q\n"
      "Q 2 -> [ S ( n 1 1 ) I ( Cube 2 ) ] P\nP 1 n -> [ S ( n 1 1 ) I ( Cube 3 ) ]\n"
      "Z -> [ S ( n 1 1 ) I ( Cube 4 ) ]\n");
  ASSERT_EQ(d.bodies.size(), 21u);
  for (const size_t call : {0, 10}) {
    const double n = sizeOf(d.bodies[call]).x;
    for (size_t i = 0; i < 10; ++i) {
      const double width = sizeOf(d.bodies[call + i]).x;
      if (d.bodies[call + i].texture == 3)
        EXPECT_NE(width, n);
      else
        EXPECT_EQ(width, n);
    }
  }
  EXPECT_NE(sizeOf(d.bodies[0]).x, sizeOf(d.bodies[10]).x);
  EXPECT_NE(sizeOf(d.bodies[20]).x, sizeOf(d.bodies[10]).x);
  EXPECT_TRUE(d.has("unbound-variable"));
}

std::vector<double> heights(const char* range, const char* word, int calls) {
  const Drawn d = draw("X -> " + std::string(word) + " h " + range + " Y\nY " +
                       std::to_string(calls) + " -> C\nC 1 h -> [ S ( 1 h 1 ) I ( Cube ) ]\n");
  std::vector<double> out;
  for (const Body& b : d.bodies) out.push_back(b.box.max.y + b.box.min.y);
  return out;
}

TEST(Row, R6_realRangesAreUniform) {
  std::vector<double> h = heights("( 4 8 )", "R", 10000);
  ASSERT_EQ(h.size(), 10000u);
  std::sort(h.begin(), h.end());
  EXPECT_GE(h.front(), 4);
  EXPECT_LT(h.back(), 8);
  // Kolmogorov-Smirnov: beyond 1.63 / sqrt(n) the odds are under 1 in 100.
  double d = 0;
  for (size_t i = 0; i < h.size(); ++i) {
    const double at = (h[i] - 4) / 4, n = static_cast<double>(h.size());
    d = std::max({d, std::fabs(at - static_cast<double>(i) / n),
                  std::fabs(at - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(d, 1.63 / 100);
}

TEST(Row, R7_wholeRangesHoldBothBounds) {
  std::map<double, size_t> count;
  for (const double h : heights("( -2 3 )", "R*", 6000)) ++count[h];
  ASSERT_EQ(count.size(), 6u);
  for (int v = -2; v <= 3; ++v) expectShare(count[v], 6000, 1.0 / 6, 4);
  for (const double h : heights("( 2 2 )", "R*", 10)) EXPECT_EQ(h, 2);
  for (const double h : heights("( 1.2 3.9 )", "R*", 100)) EXPECT_TRUE(h == 2 || h == 3);
}

TEST(Row, R8_probabilityIsThatOfTheFirstSections) {
  const Drawn d = draw("X 10000 -> C\nC ; 0.2 -> I ( Cube 1 ) -> I ( Cube 2 )\n");
  ASSERT_EQ(d.bodies.size(), 10000u);
  expectShare(static_cast<size_t>(d.textures()[1]), 10000, 0.2);
}

TEST(Row, R9_withoutAlternativeNothingIsDrawnOtherwise) {
  const Drawn d = draw("X 10000 -> C\nC ; 0.6 -> I ( Cube 1 )\n");
  expectShare(d.bodies.size(), 10000, 0.6);
}

TEST(Row, R9_theCityHasBuildingsOnSixOfTenPlots) {
  const std::string city = dataText("readme-1-city.grammar");
  if (city.empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  // One ball tops each building. 100 cities: a binomial sum.
  size_t buildings = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const Drawn d = draw(city, seeded(seed));
    const auto balls = std::count_if(d.bodies.begin(), d.bodies.end(),
                                     [](const Body& b) { return b.rule == "Top"; });
    EXPECT_LE(balls, 54);
    buildings += static_cast<size_t>(balls);
    const Body& floor = d.bodies[0];
    expectBox(floor, box({-60, 0, -60}, {60, 0.1, 60}));
  }
  expectShare(buildings, 5400, 0.6);
}

TEST(Row, R10_sectionsHoldWithAnAlternative) {
  size_t bodies = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const Drawn d =
        draw("X -> C\nC 3 ; 0.5 -> I ( Cube 1 ) | I ( Cube 2 ) | I ( Cube 3 ) -> I ( Cube 4 )\n",
             seeded(seed));
    const auto textures = d.textures();
    const bool first = textures == std::map<int, int>{{1, 1}, {2, 3}, {3, 1}};
    const bool other = textures == std::map<int, int>{{4, 1}};
    EXPECT_TRUE(first || other);
    bodies += first ? 1 : 0;
  }
  expectShare(bodies, 200, 0.5);
}

TEST(Row, R11_scalesMultiplyAndMirrorsLookOutwards) {
  DrawOptions options;
  options.surfaces = true;
  const Drawn d = draw(
      "X -> [ S ( 2 2 2 ) S ( 3 1 0.5 ) I ( CubeX ) ] [ S ( 1 1 -1 ) Y ] [ S ( -2 -3 -1 ) I ( "
      "CubeX ) ]\n"
      "Y -> T ( 0 0 2 ) I ( CubeY ) S ( 1 0.5 1 ) I ( Cylinder )\n",
      options);
  ASSERT_EQ(d.bodies.size(), 4u);
  expectBox(d.bodies[0], box({0, 0, -0.5}, {6, 2, 0.5}));
  expectBox(d.bodies[1], box({-0.5, 0, -3}, {0.5, 1, -2}));
  expectBox(d.bodies[3], box({-2, -3, -0.5}, {0, 0, 0.5}));
  const double volumes[] = {12, 1, 0.3911, 6};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(d.bodies[i].closed) << i;
    EXPECT_NEAR(d.bodies[i].volume, volumes[i], 1e-3) << i;
  }
}

TEST(Row, R12_movesAreInScaledAndTurnedUnits) {
  const Drawn d = draw(
      "X -> [ S ( 2 3 4 ) T ( 1 1 1 ) I ( Cube ) ] [ S ( 2 2 2 ) A ( 90 1 ) T ( 1 0 0 ) I ( Cube ) "
      "]\n");
  expectBox(d.bodies[0], box({1, 3, 2}, {3, 6, 6}));
  expectBox(d.bodies[1], box({-1, 0, -3}, {1, 2, -1}));
}

TEST(Row, R13_anglesHaveSigns) {
  const Drawn d = draw(
      "X -> [ A ( 30 1 ) I ( CubeX ) ] [ A ( -30 1 ) I ( CubeX ) ] [ A ( 400 2 ) I ( CubeX ) ] "
      "[ A ( 90 0 ) I ( CubeX ) ] [ A ( 40 2.7 ) I ( CubeX ) ]\n");
  expectBox(d.bodies[0], box({-0.25, 0, -0.933013}, {1.11603, 1, 0.433013}));
  expectBox(d.bodies[1], box({-0.25, 0, -0.433013}, {1.11603, 1, 0.933013}));
  expectBox(d.bodies[2], box({-0.642788, 0, -0.5}, {0.766044, 1.40883, 0.5}));
  expectBox(d.bodies[3], box({0, -0.5, 0}, {1, 0.5, 1}));
  expectBox(d.bodies[4], d.bodies[2].box);
}

TEST(Row, R13_turnsOfUnequalSizesShear) {
  DrawOptions options;
  options.surfaces = true;
  const Drawn d = draw("X -> S ( 2 1 1 ) A ( 45 2 ) I ( CubeX )\n", options);
  const double h = std::sqrt(0.5);
  expectBox(d.bodies[0], box({-2 * h, 0, -0.5}, {2 * h, 2 * h, 0.5}));
  EXPECT_TRUE(d.bodies[0].closed);
  EXPECT_NEAR(d.bodies[0].volume, 2, 1e-9);
}

TEST(Row, R14_tapersScaleTheFarSide) {
  DrawOptions options;
  options.surfaces = true;
  const Drawn d = draw(
      "X -> [ D ( 1 0.45 1 ) I ( Cube ) ] [ A ( 270 0 ) D ( 0.1 0.1 0.5 ) I ( Cube ) ] "
      "[ D ( 1 0.5 0.5 ) I ( CubeX ) ] [ D ( 0.5 1 0.5 ) T ( 2 0 0 ) I ( Cube ) ] "
      "[ D ( 0.5 0.5 1 ) I ( CubeY ) ]\n",
      options);
  ASSERT_EQ(d.bodies.size(), 5u);
  expectBox(d.bodies[0], box({-0.5, 0, -0.5}, {0.5, 0.45, 0.5}));
  expectBox(d.bodies[1], box({-0.5, -0.5, -0.1}, {0.5, 0.5, 0}));
  expectBox(d.bodies[2], box({0, 0, -0.5}, {1, 1, 0.5}));
  EXPECT_NEAR(d.bodies[2].volume, (1 + 0.5 + 0.25) / 3, 1e-9);
  expectBox(d.bodies[3], box({0.75, 0, -0.5}, {2.5, 1, 0.5}));
  EXPECT_NEAR(d.bodies[4].volume, (1 + 0.5 + 0.25) / 3, 1e-9);
  for (const Body& b : d.bodies) EXPECT_TRUE(b.closed);
}

TEST(Row, R14_cylinderOfTaperedBoxes) {
  const std::string grammar = dataText("p133-cylinder.grammar");
  if (grammar.empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  const Drawn d = draw(grammar);
  EXPECT_EQ(d.bodies.size(), 38u);
  EXPECT_TRUE(near(d.bounds, box({-1.7570537, -5, -1.7705939}, {1.7755077, 5, 1.7680154})))
      << text(d.bounds);
}

TEST(Row, R15_bracketsSaveAndRestore) {
  const Drawn d = draw("X -> [ T ( 3 0 0 ) [ S ( 2 2 2 ) I ( Cube ) ] I ( Cube ) ] I ( Cube )\n");
  ASSERT_EQ(d.bodies.size(), 3u);
  expectBox(d.bodies[0], box({2, 0, -1}, {4, 2, 1}));
  expectBox(d.bodies[1], box({2.5, 0, -0.5}, {3.5, 1, 0.5}));
  expectBox(d.bodies[2], box({-0.5, 0, -0.5}, {0.5, 1, 0.5}));
}

TEST(Row, R15_unbalancedBracketsAreTold) {
  const Drawn d = draw("X -> ] I ( Cube 1 ) [ T ( 2 0 0 ) I ( Cube 2 )\nY -> [ [\n");
  EXPECT_EQ(d.codes(), (std::vector<std::string>{"unexpected-bracket 1:6", "unclosed-bracket 1:21",
                                                 "unused-rule 2:1", "unclosed-bracket 2:6",
                                                 "unclosed-bracket 2:8"}));
  EXPECT_FALSE(d.rules.ok());
}

TEST(Row, R16_callsLeakTheirTransforms) {
  const Drawn d =
      draw("X -> M I ( Cube 2 ) [ M ] I ( Cube 3 )\nM -> T ( 5 0 0 ) S ( 2 2 2 ) I ( Cube 1 )\n");
  ASSERT_EQ(d.bodies.size(), 4u);
  expectBox(d.bodies[1], box({4, 0, -1}, {6, 2, 1}));
  expectBox(d.bodies[2], box({13, 0, -2}, {17, 4, 2}));
  expectBox(d.bodies[3], d.bodies[1].box);
}

TEST(Row, R17_pivotsAndExtents) {
  const Drawn d = draw("X -> S ( 2 3 4 ) I ( Cube ) I ( CubeX ) I ( CubeY )\n");
  expectBox(d.bodies[0], box({-1, 0, -2}, {1, 3, 2}));
  expectBox(d.bodies[1], box({0, 0, -2}, {2, 3, 2}));
  expectBox(d.bodies[2], box({-1, 0, 0}, {1, 3, 4}));
  // A file that uses DS or DT has all boxes centred, and CubeY stands upright.
  const Drawn centred =
      draw("X -> S ( 2 3 4 ) I ( Cube ) I ( CubeX ) I ( CubeY )\nZ -> DS ( 1 1 1 )\n");
  expectBox(centred.bodies[0], box({-1, -1.5, -2}, {1, 1.5, 2}));
  expectBox(centred.bodies[1], box({0, -1.5, -2}, {2, 1.5, 2}));
  expectBox(centred.bodies[2], box({-1, 0, -2}, {1, 3, 2}));
}

TEST(Row, R17_dsAndDtScaleTheCornersOfASide) {
  const Drawn d = draw(
      "X -> DT ( 1 0.5 1 ) DS ( 1 1 0.5 ) I ( Cube ) DS ( 1 0.5 1 ) I ( CubeX ) I ( CubeY )\n");
  // DS takes the front of a Cube, the end of a CubeX, the top of a CubeY; DT the top of a Cube.
  expectBox(d.bodies[0], box({-0.5, -0.5, -0.5}, {0.5, 0.25, 0.25}));
  expectBox(d.bodies[1], box({0, -0.5, -0.5}, {1, 0.5, 0.5}));
  expectBox(d.bodies[2], box({-0.5, 0, -0.5}, {0.5, 0.5, 0.5}));
}

struct Measured {
  const char* file;
  size_t bodies;
  Box3 bounds;
};

TEST(Row, R17_measuredGrammars) {
  if (dataFolder().empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  const Measured all[] = {
      {"13-brick_wall", 800, box({0.5, 0, 1.975}, {20.95, 39.95, 2.025})},
      {"15-cylinder_fan", 20, box({-2.5, -1.5, -1.5}, {2.5, 1.5, 1.5})},
      {"01-dy_cube_wedge", 1, box({-0.5, 0, -0.5}, {0.5, 0.45, 0.5})},
      {"02-d_pyramid", 1, box({-0.5, -0.5, -0.1}, {0.5, 0.5, 0})},
  };
  for (const Measured& m : all) {
    const Drawn d = draw(dataText(std::string(m.file) + ".grammar"));
    EXPECT_EQ(d.bodies.size(), m.bodies) << m.file;
    EXPECT_TRUE(near(d.bounds, m.bounds)) << m.file << " " << text(d.bounds);
  }
  // The measured run of this one drew 18 of 18 or 19.
  bool eighteen = false;
  for (int seed = 0; seed < 20 && !eighteen; ++seed) {
    const Drawn d = draw(dataText("00-cylinder.grammar"), seeded(seed));
    EXPECT_EQ(d.bodies.size(), 20u);
    eighteen = near(d.bounds, box({-2.0504, 0, -2.0564}, {2.0504, 1, 2.0564}), 5e-5);
  }
  EXPECT_TRUE(eighteen);
  // A rail and 6 to 9 posts that fill one metre.
  for (int seed = 0; seed < 10; ++seed) {
    const Drawn d = draw(dataText("fence.grammar"), seeded(seed));
    EXPECT_GE(d.bodies.size(), 7u);
    EXPECT_LE(d.bodies.size(), 10u);
    EXPECT_NEAR(d.bounds.min.x, 0, 1e-9);
    EXPECT_NEAR(d.bounds.max.x, 1, 1e-9);
    EXPECT_NEAR(d.bounds.min.y, 0, 1e-9);
    EXPECT_GE(d.bounds.max.y, 0.5);
    EXPECT_LE(d.bounds.max.y, 0.65 + 0.03);
  }
}

TEST(Row, R18_spheresAndCylindersAreClosed) {
  DrawOptions options;
  options.surfaces = true;
  const Drawn d = draw(
      "X -> S ( 2 4 2 ) I ( Sphere ) I ( Cylinder ) D ( 0.5 1 0.5 ) I ( Sphere ) I ( Cylinder )\n",
      options);
  ASSERT_EQ(d.bodies.size(), 4u);
  expectBox(d.bodies[0], box({-1, -2, -1}, {1, 2, 1}));
  expectBox(d.bodies[1], box({-1, 0, -1}, {1, 4, 1}));
  const double pi = 3.14159265;
  EXPECT_NEAR(d.bodies[0].volume, 4.0 / 3 * pi * 2, 0.12);
  EXPECT_NEAR(d.bodies[1].volume, pi * 4, 0.06);
  for (const Body& b : d.bodies) EXPECT_TRUE(b.closed);
}

TEST(Row, R18_theCityIsClosedEverywhere) {
  const std::string city = dataText("readme-1-city.grammar");
  if (city.empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  DrawOptions options;
  options.surfaces = true;
  for (const Body& b : draw(city, options).bodies) {
    EXPECT_TRUE(b.closed);
    EXPECT_GT(b.volume, 0);
  }
}

TEST(Row, R19_textureTurnsAndScaleReachTheFile) {
  const Drawn d =
      draw("X -> I ( Cube 2 1 0.25 ) T ( 2 0 0 ) I ( Cube 5 ) T ( 2 0 0 ) I ( Cube 99 )\n");
  ASSERT_EQ(d.bodies.size(), 3u);
  EXPECT_EQ(d.bodies[0].texture, 2);
  EXPECT_EQ(d.bodies[0].quarters, 1);
  EXPECT_EQ(d.bodies[0].scale, 0.25);
  EXPECT_EQ(d.bodies[1].texture, 5);
  EXPECT_EQ(d.bodies[1].scale, 0.125);
  EXPECT_EQ(d.bodies[2].texture, -1);

  std::filesystem::create_directories(GABLE_WRITTEN_DIR);
  const std::string path = GABLE_WRITTEN_DIR "/progen3d_textures.glb";
  ASSERT_TRUE(d.model.write(path, {}).ok);
  const Result<std::string> bytes = readFile(path);
  ASSERT_TRUE(bytes.ok());
  AssetOptions options;
  options.path = "progen3d_textures.glb";
  const Result<Asset> asset = readAsset(bytes.value(), options);
  ASSERT_TRUE(asset.ok());
  // The faces of the first box show half of the texture, turned; those of the second a quarter.
  const Mesh& m = *asset.value().mesh;
  ASSERT_TRUE(m.hasUv(0));
  std::map<std::string, Vec2> spans;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const size_t slot = m.faces[f].materialSlot;
    ASSERT_LT(slot, asset.value().materials.size());
    const Material& material = asset.value().materials[slot];
    const TextureMap& map = material.map(TextureLayer::Color);
    Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
    const MeshLoop& loop = m.loopsOf(f)[0];
    for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
      const Vec2 uv = m.uvs[0][c];
      low = {std::min(low.x, uv.x), std::min(low.y, uv.y)};
      high = {std::max(high.x, uv.x), std::max(high.y, uv.y)};
    }
    spans[material.name] = {(high.x - low.x) * map.su, (high.y - low.y) * map.sv};
    EXPECT_FALSE(material.name == "02_brick" && map.path.empty());
  }
  ASSERT_EQ(spans.count("02_brick"), 1u);
  ASSERT_EQ(spans.count("05_ashlar"), 1u);
  EXPECT_NEAR(spans["02_brick"].x, 0.5, 1e-6);
  EXPECT_NEAR(spans["05_ashlar"].x, 0.25, 1e-6);
  EXPECT_EQ(asset.value().textures.size(), 2u);
}

struct Arithmetic {
  const char* text;
  double value;
};

TEST(Row, R20_expressionsCalculateRight) {
  const Arithmetic table[] = {{"k-m-1", 0},
                              {"1-2*k", -5},
                              {"2+3*k", 11},
                              {"k*m/4", 1.5},
                              {"12/k/m", 2},
                              {"k/m*m", 3},
                              {"k^m", 9},
                              {"2^k^m", 512},
                              {"-k^2", -9},
                              {"k*-1", -3},
                              {"1-neg", 1.5},
                              {"-(k)", -3},
                              {"1-(k)", -2},
                              {"(k+1)/m", 2},
                              {"k*(m+1)", 9},
                              {"1/(k+m-1)", 0.25},
                              {"(1/(k+m-1))*k", 0.75},
                              {"2*(m+1)+5", 11},
                              {"(k+1)*(m+1)", 12},
                              {"+5", 5},
                              {"1/0", 0},
                              {"k/(m-2)", 0},
                              {"cos(0)", 1},
                              {"sin(k)", 0.14112},
                              {"cos(k)", -0.989992},
                              {"10-4", 6},
                              {"1e1", 10},
                              {"k+k+k+k+k", 15},
                              {"( k + 1 ) * ( m + 1 )", 12},
                              {"k - 1", 2},
                              {"-0.5*k", -1.5},
                              {"(1+2)+(3+4)", 10},
                              {"2^-1", 0.5},
                              {"--k", 3},
                              {".5", 0.5},
                              {"1/3*3", 1}};
  std::string body;
  for (const Arithmetic& a : table) body += std::string("[ T ( 0 ") + a.text + " 0 ) I ( Cube ) ] ";
  const Drawn d = draw("X -> R* k ( 3 3 ) R* m ( 2 2 ) R neg ( -0.5 -0.5 ) Y\nY -> " + body + "\n");
  ASSERT_EQ(d.bodies.size(), std::size(table));
  EXPECT_TRUE(d.messages().empty());
  for (size_t i = 0; i < std::size(table); ++i) {
    EXPECT_NEAR(d.bodies[i].box.min.y, table[i].value, 1e-5) << table[i].text;
  }
}

TEST(Row, R20_blanksSeparateArguments) {
  const Drawn d = draw("X -> R k ( 3 3 ) S ( 2 -1 +1 ) T ( k -k k-1 ) I ( CubeX )\n");
  EXPECT_TRUE(d.messages().empty());
  expectBox(d.bodies[0], box({6, 2, 1.5}, {8, 3, 2.5}));
}

TEST(Row, R21_countsAndFreshDraws) {
  const Drawn d = draw(
      "X -> Tower\nTower 5 -> [ T ( 0 Tower_count 0 ) I ( Cube Tower_count ) Inner ]\n"
      "Inner 2 -> I ( Cube Tower_count*2+Inner_count )\n");
  ASSERT_EQ(d.bodies.size(), 15u);
  for (int turn = 0; turn < 5; ++turn) {
    const auto at = static_cast<size_t>(turn) * 3;
    EXPECT_EQ(d.bodies[at].texture, turn);
    EXPECT_NEAR(d.bodies[at].box.min.y, turn, 1e-9);
    EXPECT_EQ(d.bodies[at + 1].texture, 2 * turn);
    EXPECT_EQ(d.bodies[at + 2].texture, 2 * turn + 1);
  }
  const Drawn fresh = draw("X -> R n ( 5 6 ) Y\nY 50 -> [ S ( &n &n 1 ) I ( Cube ) ]\n");
  for (size_t i = 0; i < fresh.bodies.size(); ++i) {
    const Vec3 size = sizeOf(fresh.bodies[i]);
    EXPECT_TRUE(size.x >= 5 && size.x < 6 && size.y >= 5 && size.y < 6);
    EXPECT_NE(size.x, size.y);
    EXPECT_FALSE(i > 0 && size.x == sizeOf(fresh.bodies[i - 1]).x);
  }
}

TEST(Row, R22_spacingAndCommentsChangeNothing) {
  const std::string one =
      "X -> R h ( 2 5 ) Y\n"
      "Y 3 h ; 0.9 -> [ S ( 1 h/2 2 ) I ( Cube 1 ) ] | T ( 1 0 0 ) I ( CubeX 2 0 1 ) | I ( Cube 3 "
      ") -> I ( Cube 4 )\n";
  const std::string two =
      "# a tower\nX->R h(2 5)Y\n\nY 3 h;0.9->[S(1 h/2 2)I(Cube 1)]|T(1 0 0)I(CubeX 2 0 1)|I(Cube "
      "3)->I(Cube 4)";
  const std::string three =
      "/* a\n   tower */\r\nX ->\r\n   R h ( 2, 5 )   // range\r\n   Y\r\n\r\n"
      "Y 3 h ; 0.9 ->\r\n  [ S ( 1  h / 2  2 ) # wall\r\n    I ( Cube 1 ) ]\r\n"
      "  | T ( 1 0 0 ) I ( CubeX 2 0 1 )\r\n  | I ( Cube 3 )\r\n  -> I ( Cube 4 )\r\n";
  for (int seed = 0; seed < 5; ++seed) {
    const Drawn a = draw(one, seeded(seed)), b = draw(two, seeded(seed)),
                c = draw(three, seeded(seed));
    EXPECT_TRUE(a.messages().empty() && b.messages().empty() && c.messages().empty());
    ASSERT_EQ(a.bodies.size(), b.bodies.size());
    ASSERT_EQ(a.bodies.size(), c.bodies.size());
    for (size_t i = 0; i < a.bodies.size(); ++i) {
      EXPECT_TRUE(near(a.bodies[i].box, b.bodies[i].box, 0));
      EXPECT_TRUE(near(a.bodies[i].box, c.bodies[i].box, 0));
      EXPECT_EQ(a.bodies[i].texture, c.bodies[i].texture);
    }
  }
}

TEST(Row, R23_theSameSeedGivesTheSameBytes) {
  const std::string grammar =
      "X -> R h ( 1 9 ) Y\nY 20 -> C T ( 2 0 0 )\nC 1 h ; 0.5 -> [ S ( 1 h 1 ) I ( Cube 3 ) ] -> I "
      "( Sphere )\n";
  const auto bytes = [&](double seed) {
    const std::string path = testing::TempDir() + "/progen3d.glb";
    EXPECT_TRUE(draw(grammar, seeded(seed)).model.write(path, {}).ok);
    return readFile(path).value();
  };
  EXPECT_EQ(bytes(7), bytes(7));
  EXPECT_NE(bytes(7), bytes(8));
}

TEST(Row, R24_endlessRulesEndAndKeepWhatIsDrawn) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const Drawn chain = draw("X -> I ( Cube ) T ( 1 0 0 ) X\n");
  EXPECT_TRUE(chain.has("recursion-too-deep"));
  EXPECT_GT(chain.bodies.size(), 500u);
  EXPECT_EQ(chain.model.end(), End::LimitReached);
  const Drawn wall = draw("Wall -> I ( Cube ) [ Wall ] [ Wall ]\n");
  EXPECT_TRUE(wall.has("recursion-too-deep"));
  EXPECT_GT(wall.bodies.size(), 500u);
  // 2^1000 calls that draw nothing, and more turns than anybody waits for.
  std::string doubling = "X -> A0\n";
  for (int i = 0; i < 1000; ++i) {
    doubling += "A" + std::to_string(i) + " -> A" + std::to_string(i + 1) + " A" +
                std::to_string(i + 1) + "\n";
  }
  doubling += "A1000 -> T ( 1 0 0 )\n";
  DrawOptions small;
  small.limits.shapes = 100000;
  EXPECT_TRUE(draw(doubling, small).has("too-many-turns"));
  const Drawn turns = draw("X 2000000000 -> I ( Cube 1 ) T ( 1 0 0 )\n", small);
  EXPECT_TRUE(turns.has("too-many-shapes") || turns.has("too-many-turns"));
  EXPECT_GT(turns.bodies.size(), 50000u);
  const Drawn nested = draw("X 99999 -> Y\nY 99999 -> Z\nZ 99999 -> T ( 0 0 0 )\n", small);
  EXPECT_TRUE(nested.has("too-many-turns"));
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), 20);
}

TEST(Row, R24_placesOfMessagesAreTold) {
  const Drawn d = draw("X ->\n  I ( Cube ) X\n");
  bool found = false;
  for (const Diagnostic& m : d.messages()) {
    if (m.code != "recursion-too-deep") continue;
    found = true;
    EXPECT_EQ(m.range->line, 2u);
    EXPECT_EQ(m.range->column, 14u);
  }
  EXPECT_TRUE(found);
}

void expectSameBodies(const std::string& grammar, const std::string& name) {
  const Converted converted = convert(grammar, name);
  ASSERT_FALSE(converted.text.empty()) << name;
  for (int seed = 0; seed < 3; ++seed) {
    const Drawn a = draw(grammar, seeded(seed), name);
    const Drawn b = drawConverted(converted.text, seeded(seed));
    EXPECT_TRUE(b.model.ok()) << name;
    ASSERT_EQ(a.bodies.size(), b.bodies.size()) << name;
    for (size_t i = 0; i < a.bodies.size(); ++i) {
      ASSERT_TRUE(near(a.bodies[i].box, b.bodies[i].box, 0)) << name << " " << i;
      EXPECT_EQ(a.bodies[i].texture, b.bodies[i].texture);
      EXPECT_EQ(a.bodies[i].rule, b.bodies[i].rule);
    }
  }
  // The text is in canonical form and free of complaints.
  const Formatted formatted = format(converted.text, "converted.cga");
  EXPECT_EQ(formatted.text, converted.text) << name;
  const Rules rules = Rules::parse(converted.text, "converted.cga");
  for (const Diagnostic& m : rules.diagnostics()) {
    ADD_FAILURE() << name << ": " << m.rendered;
  }
}

TEST(Row, R25_conversionDrawsTheSame) {
  const char* all[] = {
      "X -> I ( Cube )\n",
      "X -> X2\nX2 3 -> [ T ( 0 X2_count 0 ) X3 ]\nX3 ; 0.5 -> I ( Cube 1 ) -> X4\nX4 2 -> I ( "
      "CubeX 2 ) T ( 1/X2_count 0 0 )\n",
      "X ; 0.5 -> I ( Cube ) T ( 1 0 0 ) X -> I ( Sphere )\n",
      "case -> else attr\nelse 2 -> R* true ( 1 4 ) R* x ( 1 2 ) R* y ( 1 1 ) I ( Cube )\nattr 1 "
      "true -> S ( true x y ) "
      "extrude\nextrude -> I ( Cube &true )\n",
      "X -> R a ( -3 -1 ) R x ( 1 2 ) Y\nY 2 a x -> [ A ( a*20 x ) S ( x -a a^2 ) D ( 0.5 x 1 ) I "
      "( Cube sin(a)+cos(-x) ) ] T ( -1 a 0 )\n",
      "X 3 -> | | I ( Cube )\nY -> X\n",
      "X -> [ [ I ( Cube ) ] DS ( 1 2 3 ) I ( CubeY ) ] T ( 1 1 1 ) A ( 20 1 ) I ( CubeX 1 2 3 )\n",
      "\xc3\x84 -> \xc3\x96 2Nd\n\xc3\x96 -> I ( Cube )\n2Nd -> T ( 1 0 0 ) I ( Cube )\n",
  };
  for (const char* grammar : all) expectSameBodies(grammar, "test.grammar");
}

TEST(Row, R25_conversionDrawsTheSameForAllMeasuredGrammars) {
  if (dataFolder().empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  for (const char* name : {"00-cylinder",
                           "01-dy_cube_wedge",
                           "02-d_pyramid",
                           "03-dtdt_cube",
                           "04-dsdt_cube_wedge_offset",
                           "07-hollow_cylinder",
                           "13-brick_wall",
                           "15-cylinder_fan",
                           "fence",
                           "p133-cylinder",
                           "readme-0-syntax",
                           "readme-1-city",
                           "readme-2-city-two-wings",
                           "readme-3-simple-building",
                           "readme-4-building-verandah",
                           "micro/altnop",
                           "micro/altsections",
                           "micro/amp",
                           "micro/ampbound",
                           "micro/bound",
                           "micro/brace",
                           "micro/cmt",
                           "micro/const",
                           "micro/count",
                           "micro/ct",
                           "micro/dup",
                           "micro/empty_alt",
                           "micro/intr",
                           "micro/intr2",
                           "micro/late",
                           "micro/leak",
                           "micro/leakvar",
                           "micro/multi",
                           "micro/nospace",
                           "micro/prob",
                           "micro/probnoalt",
                           "micro/rbody",
                           "micro/recprob",
                           "micro/reroll",
                           "micro/rot",
                           "micro/sections",
                           "micro/trail",
                           "micro/unbound"}) {
    const std::string text = dataText(std::string(name) + ".grammar");
    ASSERT_FALSE(text.empty()) << name;
    expectSameBodies(text, std::string(name) + ".grammar");
  }
}

TEST(Row, R25_sharingChangesNothing) {
  const std::string grammar = dataText("readme-4-building-verandah.grammar");
  if (grammar.empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  DrawOptions apart = seeded(3);
  apart.sharing = false;
  const Drawn a = draw(grammar, seeded(3)), b = draw(grammar, apart);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_TRUE(near(a.bodies[i].box, b.bodies[i].box, 0));
  }
}

// --- What is wrong is told with its place, and what is right is drawn ---

TEST(Mistakes, areToldAllInOneRun) {
  const Drawn d = draw(
      "X -> Q ( 1 2 3 ) S ( 1 2 ) I ( Kube ) T ( 1 0 0 \n"
      "Y -> I ( Cube nowhere ) * { }\n"
      "Z -> a | b | c | d\n"
      "W ; 3 -> I\n"
      "V -> R k ( 1 ) R k ( 2 3 )\n");
  const std::vector<std::string> expected = {
      "unknown-word 1:6",         "wrong-argument-count 1:18", "unknown-primitive 1:32",
      "unclosed-bracket 1:41",    "unused-rule 2:1",           "unknown-texture 2:15",
      "ignored-sign 2:25",        "ignored-sign 2:27",         "ignored-sign 2:29",
      "unused-rule 3:1",          "too-many-sections 3:16",    "unused-rule 4:1",
      "bad-probability 4:5",      "missing-arguments 4:10",    "unused-rule 5:1",
      "wrong-argument-count 5:6", "variable-repeated 5:16"};
  EXPECT_EQ(d.codes(), expected);
  EXPECT_FALSE(d.rules.ok());
}

TEST(Mistakes, thatOnceWereSilent) {
  const auto codes = [](const char* grammar) { return draw(grammar).codes(); };
  using Codes = std::vector<std::string>;
  EXPECT_EQ(codes("X -> A ( 90 3 ) I ( Cube )"), Codes{"bad-axis 1:13"});
  EXPECT_EQ(codes("X 1 h -> R h ( 5 2 ) S ( 1 h 1 ) I ( Cube )"), Codes{"reversed-range 1:10"});
  EXPECT_EQ(codes("X ; -0.5 -> I ( Cube )"), Codes{"bad-probability 1:5"});
  EXPECT_EQ(codes("X ; -> I ( Cube )"), Codes{"bad-probability 1:3"});
  EXPECT_EQ(codes("X -> I ( Cube )\nY -> I ( Cube )"), Codes{"unused-rule 2:1"});
  EXPECT_EQ(codes("X -> I ( Cube 24 )"), Codes{"unknown-texture 1:6"});
  EXPECT_EQ(codes("X -> I ( Cube -1 )"), Codes{"unknown-texture 1:6"});
  EXPECT_EQ(codes("X -> I ( Cube 23 ) I ( Cube 23 )"), Codes{});
}

TEST(Mistakes, wordsOfTheOtherCaseAreMeant) {
  const Drawn d = draw("X -> s ( 1 1 1 ) I ( Cube )");
  ASSERT_EQ(d.codes(), std::vector<std::string>{"unknown-word 1:6"});
  EXPECT_EQ(d.messages().at(0).hint, "did you mean 'S'?");
}

TEST(Mistakes, haveRemediesInTheNotation) {
  for (const char* grammar : {"X -> [ X ]", "X -> X X", "X 200000 -> T ( 1 0 0 )"}) {
    const Drawn d = draw(grammar);
    ASSERT_FALSE(d.messages().empty()) << grammar;
    const std::string hint = d.messages().at(0).hint;
    EXPECT_NE(hint.find("rule"), hint.npos) << hint;
    EXPECT_EQ(hint.find("case"), hint.npos) << hint;
    EXPECT_EQ(hint.find("width"), hint.npos) << hint;
  }
}

// A value from outside for a variable that rules draw anew would have no effect.
TEST(Mistakes, settingWhatIsDrawnAnewIsRefused) {
  const Rules rules = Rules::parse(
      "X -> R h ( 2 4 ) R w ( 1 2 ) Y\nY 1 h -> S ( w h 1 ) I ( Cube )", "test.grammar");
  const auto codeOf = [&](const char* name) {
    DeriveSettings settings;
    settings.attributes = {{name, "40"}};
    const Model model = derive(rules, Shapes::lot(10, 10), settings);
    return model.diagnostics().empty() ? std::string() : model.diagnostics()[0].code;
  };
  EXPECT_EQ(codeOf("h"), "not-settable");
  EXPECT_EQ(codeOf("w"), "");
  for (const AttributeInfo& a : rules.attributes()) EXPECT_EQ(a.hidden, a.name == "h") << a.name;
}

TEST(Textures, mayHaveNames) {
  const Drawn d = draw(
      "X -> I ( CubeY concrete 0 1 ) T ( 2 0 0 ) I ( Cube redbrick ) T ( 2 0 0 )\n"
      "  I ( Cube roughblueshinysemitransparentmetal 1 0.5 ) I ( Cube Nonsense )\n");
  EXPECT_EQ(d.codes(), std::vector<std::string>{"unknown-texture 2:64"});
  EXPECT_EQ(d.textures(), (std::map<int, int>{{-1, 1}, {0, 1}, {2, 1}, {11, 1}}));
  ASSERT_EQ(d.bodies.size(), 4u);
  EXPECT_EQ(d.bodies[0].scale, 1);
  EXPECT_EQ(d.bodies[2].quarters, 1);
  EXPECT_EQ(d.bodies[2].scale, 0.5);
}

// The material stands before the body, and leaves the taper alone.
TEST(Bodies, namedTexturesLeaveATaper) {
  DrawOptions options;
  options.surfaces = true;
  const Drawn d = draw("X -> D ( 0.5 1 0.5 ) I ( Cube redbrick )\n", options);
  ASSERT_EQ(d.bodies.size(), 1u);
  EXPECT_NEAR(d.bodies[0].volume, 0.5833333, 1e-6);
}

TEST(Mistakes, aFileWithoutRulesIsNone) {
  for (const char* text : {"", "# nothing\n", "I ( Cube )\n"}) {
    const Drawn d = draw(text);
    EXPECT_FALSE(d.rules.ok());
    EXPECT_TRUE(d.has("no-rules") || d.has("no-arrow")) << text;
  }
}

}  // namespace
}  // namespace gable::progen3d_test
