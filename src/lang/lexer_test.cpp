// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/lexer.h"

#include <gtest/gtest.h>

#include "lang/dump.h"

namespace gable::lang {
namespace {

// The texts of all tokens, separated by blanks.
std::string words(std::string_view text) {
  Diagnostics diagnostics;
  const Tokens tokens = tokenize(text, 0, diagnostics);
  std::string out;
  for (const Token& t : tokens.tokens) {
    if (t.kind == TokenKind::End) break;
    if (!out.empty()) out += ' ';
    out += text.substr(t.begin, t.end - t.begin);
  }
  return out;
}

std::string codes(std::string_view text) {
  Diagnostics diagnostics;
  tokenize(text, 0, diagnostics);
  std::string out;
  for (const Diagnostics::Entry& d : diagnostics.all()) out += d.code + "\n";
  return out;
}

TEST(Lexer, keepsDottedNamesWhole) {
  EXPECT_EQ(words("world.up.flatTop X. Y"), "world.up.flatTop X . Y");
  EXPECT_EQ(words("imp.A(scope.sx)"), "imp.A ( scope.sx )");
  EXPECT_EQ(words("style$Lot _a"), "style$Lot _a");
}

TEST(Lexer, readsAllFormsOfNumbers) {
  EXPECT_EQ(words("1 1.5 .5 5. 1e3 1.5E-3 2e+4"), "1 1.5 .5 5. 1e3 1.5E-3 2e+4");
  EXPECT_EQ(words("1em"), "1 em");
  EXPECT_EQ(words("5.}"), "5. }");
}

TEST(Lexer, dotBeforeAnOperatorBelongsToTheOperator) {
  EXPECT_EQ(words("1.==x"), "1 .== x");
  EXPECT_EQ(words("a .+ b .&& c .<= .!d"), "a .+ b .&& c .<= .! d");
  EXPECT_EQ(words("X.//a comment"), "X .");
  EXPECT_EQ(words("X./* a comment */Y"), "X . Y");
  EXPECT_EQ(words("1.// a comment"), "1.");
}

TEST(Lexer, terminalBeforeADigitEndsAtTheDot) { EXPECT_EQ(words("X.20% : B"), "X . 20 % : B"); }

TEST(Lexer, tellsArrowsFromMinus) {
  EXPECT_EQ(words("A-->B - -1"), "A --> B - - 1");
  // The parser reports the short one.
  EXPECT_EQ(words("A -> B"), "A -> B");
}

TEST(Lexer, tellsTheSignsOfBlocksApart) {
  EXPECT_EQ(words("a=:b a=b a:=b a==b a||b a|b"), "a =: b a = b a := b a == b a || b a | b");
}

TEST(Lexer, leavesOutComments) {
  EXPECT_EQ(words("a // b\nc # d\ne /* f\n g */ h"), "a c e h");
  EXPECT_EQ(words("color(\"#ff0000\") # red"), "color ( \"#ff0000\" )");
  EXPECT_EQ(words("\"// no comment\" \"/* nor here */\""), "\"// no comment\" \"/* nor here */\"");
}

TEST(Lexer, passesOverByteOrderMarksAndOddSpaces) {
  EXPECT_EQ(words("\xef\xbb\xbf"
                  "a\r\nb\xc2\xa0"
                  "c\xe2\x80\x8b"
                  "d"),
            "a b c d");
  EXPECT_EQ(codes("\xef\xbb\xbf"
                  "a\r\nb\xc2\xa0"
                  "c"),
            "");
}

TEST(Lexer, takesLettersOfOtherAlphabetsIntoNames) {
  EXPECT_EQ(words("h\xc3\xb6he --> b"), "h\xc3\xb6he --> b");
  EXPECT_EQ(codes("h\xc3\xb6he --> b"), "");
}

TEST(Lexer, reportsWhatIsNoToken) {
  EXPECT_EQ(codes("a \\ b"), "unexpected-character\n");
  EXPECT_EQ(codes("a & b"), "unexpected-character\n");
  EXPECT_EQ(codes("\xe2\x80\x9c"
                  "text\xe2\x80\x9d"),
            "unexpected-character\nunexpected-character\n");
  EXPECT_EQ(codes("\"no end\nb"), "unterminated-string\n");
  EXPECT_EQ(words("\"no end\r\nb"), "\"no end b");
  EXPECT_EQ(codes("a /* no end"), "unterminated-comment\n");
}

TEST(Lexer, stringsMayRunOverLines) {
  EXPECT_EQ(words("a = \"one\n  two\" b"), "a = \"one\n  two\" b");
  EXPECT_EQ(codes("a = \"one\n  two\" // say \"\nb = \"c\""), "");
  // One that would hold a rule lacks its quote, wherever the next one stands.
  EXPECT_EQ(codes("A --> color(\"red) X.\nB --> set(a, \"b\") set(c, \"d) Y.\n"),
            "unterminated-string\nunterminated-string\n");
  // Where a quote is missing, all end with their line.
  EXPECT_EQ(codes("a = \"one\nb = \"two\"\nc = \"three\""), "unterminated-string\n");
}

TEST(Lexer, replacesEscapesInStrings) {
  EXPECT_EQ(stringValue("\"a\\nb\\t\\\"c\\\" \\\\\""), "a\nb\t\"c\" \\");
  EXPECT_EQ(stringValue("\"\\ue000\\u0041\""),
            "\xee\x80\x80"
            "A");
  EXPECT_EQ(stringValue("\"images\\facade.jpg\""), "images\\facade.jpg");
  EXPECT_EQ(stringValue("\"\\u12\""), "\\u12");
  EXPECT_EQ(stringValue("\"open"), "open");
}

// Indices of matching brackets, in the order of the opening ones.
std::vector<std::pair<uint32_t, uint32_t>> pairs(std::string_view text) {
  Diagnostics diagnostics;
  std::vector<std::pair<uint32_t, uint32_t>> out;
  const Tokens tokens = tokenize(text, 0, diagnostics);
  for (uint32_t i = 0; i < tokens.tokens.size(); ++i) {
    if (tokens.tokens[i].match > i) out.push_back({i, tokens.tokens[i].match});
  }
  return out;
}

TEST(Lexer, pairsBrackets) {
  using P = std::vector<std::pair<uint32_t, uint32_t>>;
  EXPECT_EQ(pairs("( [ { } ] )"), (P{{0, 5}, {1, 4}, {2, 3}}));
  // A brace closes over open parentheses, a parenthesis not over a brace.
  EXPECT_EQ(pairs("{ ( }"), (P{{0, 2}}));
  EXPECT_EQ(pairs("( { )"), (P{}));
  EXPECT_EQ(pairs("( { ) }"), (P{{1, 3}}));
  EXPECT_EQ(pairs("( [ )"), (P{{0, 2}}));
  EXPECT_EQ(pairs(") ] }"), (P{}));
}

TEST(Lexer, stopsAtItsLimitOfTokens) {
  const std::string text(kMaxTokens + 10, ',');
  Diagnostics diagnostics;
  const Tokens tokens = tokenize(text, 0, diagnostics);
  EXPECT_EQ(tokens.tokens.size(), kMaxTokens + 1);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "file-too-large");
}

}  // namespace
}  // namespace gable::lang
