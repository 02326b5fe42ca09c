// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/text.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(Text, lowerCaseChangesLettersOfAsciiAlone) {
  EXPECT_EQ(lowerCase("Roof.\xc3\x89"
                      "[@Z]"),
            "roof.\xc3\x89"
            "[@z]");
  EXPECT_TRUE(equalButForCase("roofHip", "ROOFhip"));
  EXPECT_FALSE(equalButForCase("roof", "roofs"));
  EXPECT_FALSE(equalButForCase("\xc3\x89", "\xc3\xa9"));
}

TEST(Text, editDistanceCountsSlips) {
  EXPECT_EQ(editDistance("", "abc", 9), 3u);
  EXPECT_EQ(editDistance("extrude", "extrude", 9), 0u);
  EXPECT_EQ(editDistance("extrud", "extrude", 9), 1u);
  EXPECT_EQ(editDistance("heigth", "height", 9), 1u);
  EXPECT_EQ(editDistance("kitten", "sitting", 9), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting", 9), editDistance("sitting", "kitten", 9));
  EXPECT_EQ(editDistance("kitten", "sitting", 1), 2u);
  EXPECT_EQ(editDistance("a", "abcdefgh", 3), 4u);
}

TEST(Text, nearestNameIsNearOrNone) {
  const std::vector<std::string_view> names = {"extrude", "envelope", "s", "split", "Split"};
  EXPECT_EQ(nearestName("extrud", names), "extrude");
  EXPECT_EQ(nearestName("SPLIT", names), "split");
  EXPECT_EQ(nearestName("gableRoof", {"gableRoofs", "roofGable", "roofHip"}), "roofGable");
  EXPECT_EQ(nearestName("hipRoof", {"roofGable", "roofhip"}), "");
  EXPECT_EQ(nearestName("qqq", names), "");
  EXPECT_EQ(nearestName("x", names), "");
  EXPECT_EQ(nearestName("extrude", {"extrude"}), "");
  EXPECT_EQ(nearestName(std::string(100000, 'e'), names), "");
  EXPECT_EQ(didYouMean("envelop", names), "did you mean 'envelope'?");
  EXPECT_EQ(didYouMean("qqq", names), "");
}

TEST(Text, linesAreTakenOneAfterTheOther) {
  const auto lines = [](std::string_view rest) {
    std::vector<std::string_view> all;
    for (std::string_view line; takeLine(rest, line);) all.push_back(line);
    return all;
  };
  using Lines = std::vector<std::string_view>;
  EXPECT_EQ(lines("a\n\nb"), (Lines{"a", "", "b"}));
  EXPECT_EQ(lines("a\n"), Lines{"a"});
  EXPECT_EQ(lines("\n"), Lines{""});
  EXPECT_EQ(lines(""), Lines{});
}

TEST(Text, utf8IsWrittenAndMeasured) {
  for (const uint32_t c : {0x41u, 0xe9u, 0x20acu, 0x1f3e0u}) {
    std::string s;
    appendUtf8(s, c);
    EXPECT_EQ(utf8Length(s, 0), s.size());
  }
  std::string s;
  appendUtf8(s, 0xd800);
  EXPECT_EQ(s, "\xef\xbf\xbd");
  EXPECT_EQ(utf8Length("\xc3", 0), 0u);
  EXPECT_EQ(utf8Length("\x80", 0), 0u);
  EXPECT_EQ(utf8Length("\xe2\x82x", 0), 0u);
}

}  // namespace
}  // namespace gable
