// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/text.h"

#include <gtest/gtest.h>

#include "language/words.h"

namespace gable::language {
namespace {

TEST(Text, countsInUnitsOfUtf16) {
  // a, e with accent (2 bytes, 1 unit), a house (4 bytes, 2 units), b.
  const Text t(
      "a\xc3\xa9\xf0\x9f\x8f\xa0"
      "b\nc");
  EXPECT_EQ(t.position(7), (Position{0, 4}));
  EXPECT_EQ(t.offset({0, 4}), 7u);
  EXPECT_EQ(t.offset({0, 2}), 3u);
  EXPECT_EQ(t.offset({0, 3}), 3u) << "the middle of a pair is its beginning";
  EXPECT_EQ(t.offset({1, 0}), 9u);
}

TEST(Text, movesPlacesOutsideToTheNearestInside) {
  const Text t("ab\r\ncd");
  EXPECT_EQ(t.offset({0, 99}), 2u);
  EXPECT_EQ(t.offset({7, 3}), 6u);
  EXPECT_EQ(t.position(99), (Position{1, 2}));
  EXPECT_EQ(Text("").offset({4000000000u, 4000000000u}), 0u);
}

TEST(Text, knowsAllEndsOfLines) {
  const Text t("a\nb\r\nc\rd");
  EXPECT_EQ(t.lineCount(), 4u);
  EXPECT_EQ(t.position(7), (Position{3, 0}));
}

TEST(Text, appliesChangesInOrder) {
  Text t("one two");
  t.apply({Range{{0, 0}, {0, 3}}, "1"});
  t.apply({Range{{0, 2}, {0, 5}}, "2\n3"});
  EXPECT_EQ(t.content(), "1 2\n3");
  t.apply({Range{{1, 1}, {0, 1}}, ""});
  EXPECT_EQ(t.content(), "1") << "ends in either order";
  t.apply({std::nullopt, "all"});
  EXPECT_EQ(t.content(), "all");
}

TEST(Words, splitsAnyNotation) {
  const std::string text = "A.b -> \"x y\" { 1.5e3 } // c\n/* d */ E. # f";
  std::string kinds;
  for (const Word& w : wordsOf(text)) kinds += "nNsCm"[static_cast<int>(w.kind)];
  EXPECT_EQ(kinds, "nmmsmNmCCnmC");
  EXPECT_EQ(wordsOf("\"never closed").size(), 1u);
  EXPECT_EQ(wordsOf("/* never closed").size(), 1u);
}

}  // namespace
}  // namespace gable::language
