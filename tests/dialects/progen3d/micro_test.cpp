// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Grammars that ask one question each, against what the original program drew for them. Where the
// documented meaning differs from what it did, the test says so and holds to the documentation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drawn.h"

namespace gable::progen3d_test {
namespace {

class Micro : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (dataFolder().empty()) GTEST_SKIP() << "the measured grammars are not beside the repository";
  }
  static Drawn micro(const std::string& name, double seed = 1) {
    DrawOptions options;
    options.seed = seed;
    return draw(dataText("micro/" + name + ".grammar"), options);
  }
  // Bodies agree with the truth in order; `except` are left out on both sides.
  static void expectTruth(const Drawn& d, const std::string& name,
                          const std::vector<size_t>& except = {}) {
    const std::vector<Truth> truth = truthOf(name);
    ASSERT_EQ(d.bodies.size(), truth.size());
    for (size_t i = 0; i < truth.size(); ++i) {
      if (std::find(except.begin(), except.end(), i) != except.end()) continue;
      EXPECT_TRUE(near(d.bodies[i].box, truth[i].box))
          << i << ": " << text(d.bodies[i].box) << " for " << text(truth[i].box);
      EXPECT_EQ(d.bodies[i].texture, truth[i].texture) << i;
      EXPECT_EQ(d.bodies[i].quarters, truth[i].quarters) << i;
      EXPECT_NEAR(d.bodies[i].scale, truth[i].scale, 1e-6) << i;
    }
  }
};

TEST_P(Micro, drawsWhatTheOriginalDrew) {
  const Drawn d = micro(GetParam());
  EXPECT_TRUE(d.model.ok());
  expectTruth(d, GetParam());
}

INSTANTIATE_TEST_SUITE_P(WithoutDraws, Micro,
                         testing::Values("brace", "const", "count", "ct", "dup", "leak", "multi",
                                         "nospace", "rbody", "sections", "trail"),
                         [](const auto& test) { return std::string(test.param); });

using MicroCase = Micro;

// --- Exceptions: the documented meaning wins ---

// `A ( -30 1 )` turns the other way; the original lost the sign.
TEST_F(MicroCase, rotButForTheSignOfAngles) {
  const Drawn d = micro("rot");
  expectTruth(d, "rot", {1});
  EXPECT_TRUE(near(d.bodies[1].box, {{-0.25, 0, -0.433013}, {1.11603, 1, 0.933013}}))
      << text(d.bodies[1].box);
}

// An alternative without a probability is never taken; the original always took it.
TEST_F(MicroCase, altnopDrawsTheBody) {
  EXPECT_EQ(micro("altnop").textures(), (std::map<int, int>{{1, 100}}));
}

// With probability 0 the alternative is drawn, once; the original drew the body.
TEST_F(MicroCase, altsectionsDrawsTheAlternativeOnce) {
  EXPECT_EQ(micro("altsections").textures(), (std::map<int, int>{{4, 1}}));
}

// What stands behind # is a comment; the original ran it.
TEST_F(MicroCase, cmtEndsTheLine) {
  EXPECT_EQ(micro("cmt").textures(), (std::map<int, int>{{1, 1}}));
}

// The arithmetic is right, whatever is written. Boxes 0, 2, 3, 5, 6, 7, 8 and 9 hold a mistake of
// the original: substitution of parts of names, right-associative quotients, lost signs and
// brackets, 10-4 read as a number.
TEST_F(MicroCase, exprCalculates) {
  EXPECT_TRUE(micro("expr").has("unknown-variable"));
  // The original counts names that it does not know as 0; here that is a mistake.
  std::string grammar = dataText("micro/expr.grammar");
  for (const char* name : {"undefinedname", "k_x", "kk"}) {
    grammar.replace(grammar.find(name), std::string(name).size(), "0");
  }
  const Drawn d = draw(grammar);
  expectTruth(d, "expr", {0, 2, 3, 5, 6, 7, 8, 9});
  ASSERT_EQ(d.bodies.size(), 10u);
  const auto size = [&](size_t i) { return d.bodies[i].box.max - d.bodies[i].box.min; };
  const Vec3 sizes[] = {{6, 1, 1}, {2, 2, 6},    {2, 11, 9}, {0, 1.5, 3}, {0.989992, 0.909297, 3},
                        {0, 3, 3}, {1.5, 9, 11}, {10, 5, 0}, {12, 2, 15}, {0, 0, 1.0 / 3}};
  for (size_t i = 0; i < 10; ++i) {
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(size(i)[k], sizes[i][k], 1e-5) << i << " " << k;
  }
}

// --- Mistakes that the original draws in some way: they are told, and nothing is derived ---

TEST_F(MicroCase, foursecHasASectionTooMany) {
  const Drawn d = micro("foursec");
  EXPECT_FALSE(d.rules.ok());
  EXPECT_TRUE(d.has("too-many-sections"));
}

TEST_F(MicroCase, fracrepRepeatsByAnUnknownName) {
  const Drawn d = micro("fracrep");
  EXPECT_FALSE(d.rules.ok());
  EXPECT_TRUE(d.has("unknown-variable"));
}

// --- Draws: ranges, counts and frequencies ---

double heightOf(const Body& b) { return b.box.max.y - b.box.min.y; }
double widthOf(const Body& b) { return b.box.max.x - b.box.min.x; }

TEST_F(MicroCase, boundIsDrawnFromItsRange) {
  const Drawn d = micro("bound");
  ASSERT_EQ(d.bodies.size(), 1u);
  EXPECT_GE(heightOf(d.bodies[0]), 4);
  EXPECT_LT(heightOf(d.bodies[0]), 8);
}

// An unbound variable has the value it was given at the start; the original took 0.
TEST_F(MicroCase, unboundHasItsSampledValue) {
  const Drawn d = micro("unbound");
  ASSERT_EQ(d.bodies.size(), 1u);
  EXPECT_GE(heightOf(d.bodies[0]), 4);
  EXPECT_LT(heightOf(d.bodies[0]), 8);
  EXPECT_TRUE(d.has("unbound-variable"));
}

TEST_F(MicroCase, ampDrawsAtEachUse) {
  const Drawn d = micro("amp");
  ASSERT_EQ(d.bodies.size(), 8u);
  double before = 1;
  std::vector<double> factors;
  for (size_t i = 1; i < 8; i += 2) {
    factors.push_back(widthOf(d.bodies[i]) / before);
    before = widthOf(d.bodies[i]);
    EXPECT_GE(factors.back(), 5);
    EXPECT_LT(factors.back(), 6);
  }
  EXPECT_NE(factors[0], factors[1]);
}

// &n draws in a rule that binds n as well; the original then read 0.
TEST_F(MicroCase, ampboundDrawsToo) {
  for (int seed = 0; seed < 20; ++seed) {
    const Drawn d = micro("ampbound", seed);
    ASSERT_EQ(d.bodies.size(), 1u);
    EXPECT_GE(d.bodies[0].texture, 5);
    EXPECT_LE(d.bodies[0].texture, 8);
  }
}

// A variable may be declared below its use; the original then read 0.
TEST_F(MicroCase, lateIsDeclaredAnywhere) {
  const Drawn d = micro("late");
  ASSERT_EQ(d.bodies.size(), 1u);
  EXPECT_GE(d.bodies[0].texture, 5);
  EXPECT_LE(d.bodies[0].texture, 8);
}

// A rule with an alternative gives its variables back like any other; in the original they stayed
// bound. n has its sampled value afterwards, which lies in its range too.
TEST_F(MicroCase, leakvarEndsWithTheRule) {
  const Drawn d = micro("leakvar");
  ASSERT_EQ(d.bodies.size(), 2u);
  EXPECT_EQ(d.bodies[0].texture, 2);
  EXPECT_GE(widthOf(d.bodies[1]), 5);
  EXPECT_LT(widthOf(d.bodies[1]), 6);
  EXPECT_TRUE(d.has("unbound-variable"));
}

void expectShare(int count, int calls, double p) {
  EXPECT_NEAR(count, calls * p, 3.5 * std::sqrt(calls * p * (1 - p)));
}

// p is the chance of the first sections; in the original it was that of the alternative.
TEST_F(MicroCase, probTakesTheBodyWithItsProbability) {
  const auto textures = micro("prob").textures();
  expectShare(textures.at(1), 1000, 0.2);
  EXPECT_EQ(textures.at(1) + textures.at(2), 1000);
}
TEST_F(MicroCase, emptyAltDrawsNothingOtherwise) {
  expectShare(static_cast<int>(micro("empty_alt").bodies.size()), 1000, 0.2);
}
// Without an alternative p counts all the same; the original passed it over.
TEST_F(MicroCase, probnoaltDrawsNothingOtherwise) {
  expectShare(static_cast<int>(micro("probnoalt").bodies.size()), 1000, 0.2);
}

// Whole ranges hold both bounds; the original left the upper one out.
TEST_F(MicroCase, intrAndIntr2DrawAllIntegers) {
  for (const char* name : {"intr", "intr2"}) {
    const Drawn d = micro(name);
    const auto textures = d.textures();
    EXPECT_EQ(textures.size(), 3u) << name;
    for (const int t : {4, 5, 6}) EXPECT_GT(textures.count(t), 0u) << name << " " << t;
  }
  EXPECT_EQ(micro("intr2").bodies.size(), 1000u);
  // Y n n repeats by the value it draws: a call with texture n leaves n of them.
  for (const auto& [texture, count] : micro("intr").textures()) EXPECT_EQ(count % texture, 0);
}

TEST_F(MicroCase, recprobEndsInItsAlternative) {
  double all = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const Drawn d = micro("recprob", seed);
    ASSERT_GE(d.bodies.size(), 1u);
    EXPECT_EQ(d.bodies.back().texture, 2);
    EXPECT_EQ(d.textures().at(2), 1);
    all += static_cast<double>(d.bodies.size());
  }
  // The number of bodies is geometric with p 0.3: mean 1 / 0.7.
  EXPECT_NEAR(all / 300, 1 / 0.7, 0.17);
}

TEST_F(MicroCase, rerollIsOncePerCall) {
  const Drawn d = micro("reroll");
  ASSERT_EQ(d.bodies.size(), 10u);
  // Y n, then twice (Q n, P m), and that twice: all of Y and Q agree, P draws for itself.
  const int n = d.bodies[0].texture;
  for (const size_t i : {0, 1, 3, 5, 6, 8}) EXPECT_EQ(d.bodies[i].texture, n) << i;
}

}  // namespace
}  // namespace gable::progen3d_test
