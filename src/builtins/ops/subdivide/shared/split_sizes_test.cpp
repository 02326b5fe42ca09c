// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/split_sizes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gable {
namespace {

SplitItem size(double v, Unit unit = Unit::Absolute) {
  SplitItem item;
  item.size = v;
  item.unit = unit;
  return item;
}
SplitItem share(double v) { return size(v, Unit::Relative); }
SplitItem floating(double v) { return size(v, Unit::Floating); }
SplitItem group(uint32_t length, bool repeat) {
  SplitItem item;
  item.group = true;
  item.repeat = repeat;
  item.length = length;
  return item;
}

struct Divided {
  Status status;
  std::vector<double> sizes, starts;
  std::vector<uint32_t> slots;
  double end() const { return starts.empty() ? 0 : starts.back() + sizes.back(); }
};

Divided divide(std::vector<SplitItem> items, double whole, bool repeat = false) {
  uint32_t slot = 0;
  for (SplitItem& item : items) {
    if (!item.group) item.slot = slot++;
  }
  SplitPieces pieces;
  Divided d;
  d.status = dividePattern({items, repeat}, whole, pieces);
  for (const SplitPiece& p : pieces) {
    d.sizes.push_back(p.size);
    d.starts.push_back(p.start);
    d.slots.push_back(p.slot);
  }
  return d;
}

void expectSizes(const Divided& d, std::vector<double> expected) {
  ASSERT_TRUE(d.status.ok()) << d.status.message();
  ASSERT_EQ(d.sizes.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(d.sizes[i], expected[i], 1e-9) << i;
}

// The documented examples, on a scope of 10.
TEST(SplitSizes, relativeSizesAreSharesOfTheWhole) {
  expectSizes(divide({share(.5), share(.1), share(.2)}, 10), {5, 1, 2});
}

TEST(SplitSizes, floatingSizesFillTheWholeInProportion) {
  expectSizes(divide({floating(.5), floating(.1), floating(.2)}, 10), {6.25, 1.25, 2.5});
}

TEST(SplitSizes, floatingSizesTakeWhatAbsoluteOnesLeave) {
  expectSizes(divide({size(3.3), floating(3), size(5)}, 10), {3.3, 1.7, 5});
}

// Braces around all are a repeated group that is the only element of a sequence.
TEST(SplitSizes, bracesAreARepeatedGroupOnItsOwn) {
  const std::vector<std::vector<SplitItem>> patterns{
      {floating(3)},
      {size(3)},
      {share(.15), floating(2)},
      {floating(1), size(.4), floating(2.5)},
      {size(0)},
      {size(1), group(2, true), floating(.7), size(.2)},
      {group(1, true), size(.3), group(1, true), floating(.9)},
  };
  for (size_t p = 0; p < patterns.size(); ++p) {
    std::vector<SplitItem> grouped = patterns[p];
    grouped.insert(grouped.begin(), group(static_cast<uint32_t>(grouped.size()), true));
    for (double whole = 0.05; whole < 60; whole *= 1.07) {
      const Divided braces = divide(patterns[p], whole, true), own = divide(grouped, whole);
      EXPECT_EQ(braces.status.code(), own.status.code()) << p << " at " << whole;
      EXPECT_EQ(braces.starts, own.starts) << p << " at " << whole;
      EXPECT_EQ(braces.sizes, own.sizes) << p << " at " << whole;
      EXPECT_EQ(braces.slots, own.slots) << p << " at " << whole;
    }
  }
}

TEST(SplitSizes, whatLiesBeyondTheEndIsCutOrNeverMade) {
  expectSizes(divide({share(.5), share(.6), size(3)}, 10), {5, 5});
}

TEST(SplitSizes, absoluteRepetitionCutsTheLast) {
  const Divided d = divide({size(2), size(1)}, 10, true);
  expectSizes(d, {2, 1, 2, 1, 2, 1, 1});
  EXPECT_EQ(d.slots, (std::vector<uint32_t>{0, 1, 0, 1, 0, 1, 0}));
}

TEST(SplitSizes, floatingRepetitionKeepsTheRatioAndFills) {
  const Divided d = divide({floating(2), floating(1)}, 10, true);
  expectSizes(d, {20 / 9., 10 / 9., 20 / 9., 10 / 9., 20 / 9., 10 / 9.});
  EXPECT_NEAR(d.end(), 10, 1e-12);
}

TEST(SplitSizes, interleavedRepetitionStretchesLeast) {
  const Divided d =
      divide({size(1), group(3, true), floating(1), size(.2), floating(1), size(1)}, 10);
  expectSizes(d, {1, .9, .2, .9, .9, .2, .9, .9, .2, .9, .9, .2, .9, 1});
}

TEST(SplitSizes, rhythmEndsWithTheFixedPart) {
  expectSizes(divide({group(2, true), size(1), floating(2.7), size(1)}, 10), {1, 2, 1, 2, 1, 2, 1});
}

TEST(SplitSizes, tenthsRepeatTenTimes) {
  const Divided d = divide({share(.1), share(.1)}, 1, true);
  EXPECT_EQ(d.sizes.size(), 10u);
  for (const double s : d.sizes) EXPECT_EQ(s, d.sizes[0]);
}

TEST(SplitSizes, equalPartsAreBitEqual) {
  for (const double whole : {1.0 / 3, 7.77, 29.999, 1234.5678}) {
    const Divided d = divide({floating(1.7)}, whole, true);
    for (const double s : d.sizes) EXPECT_EQ(s, d.sizes[0]);
    EXPECT_NEAR(d.end(), whole, 1e-9 * whole);
  }
}

TEST(SplitSizes, plainGroupsAreReadWithoutTheirBraces) {
  expectSizes(divide({size(1), group(2, false), size(2), floating(1), size(3)}, 10), {1, 2, 4, 3});
}

TEST(SplitSizes, groupsOnBothSidesStaySymmetric) {
  expectSizes(divide({group(1, true), floating(2), size(2), group(1, true), floating(2)}, 12),
              {5 / 3., 5 / 3., 5 / 3., 2, 5 / 3., 5 / 3., 5 / 3.});
}

TEST(SplitSizes, rigidGroupsOnBothSidesShareTheRoom) {
  expectSizes(divide({group(1, true), size(2), size(1), group(1, true), size(2)}, 11),
              {2, 2, 1, 1, 2, 2, 1});
}

TEST(SplitSizes, nestedRepetitionsFillTheirParts) {
  // { { ~1 }* | 2 }* on 12: each run is 3 at least; four runs of 1 + 2.
  const Divided d = divide({group(3, true), group(1, true), floating(1), size(2)}, 12);
  ASSERT_TRUE(d.status.ok());
  EXPECT_NEAR(d.end(), 12, 1e-9);
  double sum = 0;
  for (const double s : d.sizes) sum += s;
  EXPECT_NEAR(sum, 12, 1e-9);
}

TEST(SplitSizes, repeatedFloatingPartsAreMadeOnceAtLeast) {
  expectSizes(divide({floating(5)}, 1, true), {1});
  expectSizes(divide({size(1), group(1, true), floating(5), size(1)}, 3), {1, 1, 1});
}

TEST(SplitSizes, repetitionGivesWayWhereOthersCanFill) {
  expectSizes(divide({floating(1), group(1, true), floating(3), floating(1)}, 2.4), {1.2, 1.2});
}

TEST(SplitSizes, zeroAndNegativeSizesMakeNothing) {
  expectSizes(divide({size(0), size(-2), floating(0), floating(-1), size(4)}, 10), {4});
  expectSizes(divide({size(2)}, 0), {});
}

TEST(SplitSizes, endlessRepetitionIsAFailure) {
  for (const SplitItem item : {size(0), floating(0), share(0), size(-1)}) {
    const Divided d = divide({item}, 10, true);
    ASSERT_FALSE(d.status.ok());
    EXPECT_STREQ(d.status.code(), "split-endless");
  }
}

TEST(SplitSizes, aMillionRepetitionsAreAFailure) {
  for (const SplitItem item : {size(1e-5), floating(1e-5), size(1e-300), share(1e-308)}) {
    const Divided d = divide({item}, 10, true);
    ASSERT_FALSE(d.status.ok());
    EXPECT_STREQ(d.status.code(), "split-too-many");
  }
}

TEST(SplitSizes, nestedRepetitionsBelowTheToleranceEnd) {
  const Divided d =
      divide({group(3, true), group(1, true), size(1e-5), size(1), group(0, true)}, 1e5, true);
  ASSERT_FALSE(d.status.ok());
}

TEST(SplitSizes, numbersThatAreNoneAreAFailure) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SplitItem item : {size(nan), floating(INFINITY), share(-INFINITY)}) {
    EXPECT_STREQ(divide({item}, 10).status.code(), "split-size-number");
  }
  EXPECT_STREQ(divide({size(1)}, nan).status.code(), "split-size-number");
}

// Whatever the pattern: pieces lie in the whole, in order, and do not overlap.
TEST(SplitSizes, piecesNeverOverlapOrLeaveTheWhole) {
  uint64_t state = 1;
  const auto draw = [&](uint32_t n) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<uint32_t>((state >> 33) % n);
  };
  for (int run = 0; run < 3000; ++run) {
    std::vector<SplitItem> items;
    for (uint32_t i = 0, n = 1 + draw(5); i < n; ++i) {
      const double v = 0.1 * (draw(60) + 1);
      const auto any = [&] {
        return draw(3) == 0 ? size(v) : draw(2) == 0 ? floating(v) : share(v / 20);
      };
      if (draw(3) == 0) {
        const bool nested = draw(3) == 0;
        items.push_back(group(nested ? 4 : 2, draw(3) > 0));
        items.push_back(any());
        items.push_back(any());
        if (nested) items.push_back(group(1, draw(2) == 0));
        if (nested) items.push_back(any());
      } else {
        items.push_back(any());
      }
    }
    const double whole = 0.3 * draw(100);
    const Divided d = divide(items, whole, draw(3) == 0);
    ASSERT_TRUE(d.status.ok()) << d.status.message();
    double at = 0;
    for (size_t i = 0; i < d.sizes.size(); ++i) {
      EXPECT_GE(d.starts[i], at - 1e-7);
      EXPECT_GT(d.sizes[i], 0);
      at = d.starts[i] + d.sizes[i];
    }
    EXPECT_LE(at, whole + 1e-7);
  }
}

}  // namespace
}  // namespace gable
