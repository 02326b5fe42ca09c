// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/regex.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

std::string found(const char* pattern, std::string_view text) {
  const Regex regex(pattern);
  EXPECT_TRUE(regex.valid()) << pattern << ": " << regex.error();
  const Regex::Match m = regex.search(text);
  return m.found ? std::string(text.substr(m.begin, m.end - m.begin)) : "-";
}

TEST(Regex, findsWhatPatternsSay) {
  EXPECT_EQ(found("b+", "aabbbc"), "bbb");
  EXPECT_EQ(found("b+?", "aabbbc"), "b");
  EXPECT_EQ(found("a|bc", "xbc"), "bc");
  EXPECT_EQ(found("(ab|cd)*x", "zabcdabx"), "abcdabx");
  EXPECT_EQ(found("[2-5]\\.png", "1.png 4.png"), "4.png");
  EXPECT_EQ(found("[^a]", "aab"), "b");
  EXPECT_EQ(found("\\d{2,3}", "a1 2345"), "234");
  EXPECT_EQ(found("\\bcity\\b", "cityengine city"), "city");
  EXPECT_EQ(found("^b", "ab"), "-");
  EXPECT_EQ(found("b$", "abab"), "b");
  EXPECT_EQ(found("a.c", "a\nc abc"), "abc");
  EXPECT_EQ(found("(?<=a)b(?=a)", "cbaba"), "b");
  EXPECT_EQ(found("x(?!y)", "xyxz"), "x");
  EXPECT_EQ(found("(?<!a)b", "abcb"), "b");
  EXPECT_EQ(found("\\x41\\t", "A\t"), "A\t");
  EXPECT_EQ(found("\\u00e9", "caf\xc3\xa9"), "\xc3\xa9");
  EXPECT_EQ(found("a{2}b{1,}c{0,1}", "aabbbd"), "aabbb");
  EXPECT_EQ(found("[]a]+", "]a"), "]a");
  EXPECT_EQ(found("", "abc"), "");
}

TEST(Regex, prefersEarlierAlternativesAndLongerRepeats) {
  EXPECT_EQ(found("a|ab", "ab"), "a");
  EXPECT_EQ(found("(a|ab)(c|bcd)", "abcd"), "abcd");
  EXPECT_TRUE(Regex("a*").matchesWhole("aaa"));
  EXPECT_TRUE(Regex("a|ab").matchesWhole("ab"));
  EXPECT_FALSE(Regex("a*").matchesWhole("aab"));
}

TEST(Regex, mistakesAreSaid) {
  for (const char* pattern :
       {"(", ")", "[a", "*a", "a{3,2}", "\\", "(?<name>a)", "[z-a]", "\\x4", "a{2000}"}) {
    EXPECT_FALSE(Regex(pattern).valid()) << pattern;
    EXPECT_FALSE(Regex(pattern).search("a").found);
  }
  EXPECT_FALSE(Regex("((((((a{900}){900}){900}){900}){900}){900})").valid());
  EXPECT_FALSE(Regex(std::string(100000, '(')).valid());
}

TEST(Regex, hostilePatternsEndSoon) {
  const std::string text(5000, 'a');
  EXPECT_FALSE(Regex("(a*)*b").search(text).found);
  EXPECT_FALSE(Regex("(a|a)*b").search(text).found);
  EXPECT_FALSE(Regex("(a?){30}a{30}b").search(text).found);
  EXPECT_TRUE(Regex("((a*)*)*").search(text).found);
}

}  // namespace
}  // namespace gable
