// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Functions of values alone: numbers, conversion, strings, lists, arrays, colours.

#include <gtest/gtest.h>

#include <limits>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

struct Values : testing::Test {
  FakeServices services;
  double number(const char* name, const std::vector<Arg>& args) {
    return callNumber(name, args, services);
  }
  std::string text(const char* name, const std::vector<Arg>& args) {
    return callText(name, args, services);
  }
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_F(Values, numbersRoundAndCompare) {
  EXPECT_EQ(number("abs", {-2.5}), 2.5);
  EXPECT_EQ(text("abs", {floats({-1, 2, -3})}), "(3)[1,2,3]");
  EXPECT_EQ(number("ceil", {1.2}), 2);
  EXPECT_EQ(text("ceil", {-0.5}), "0");
  EXPECT_EQ(number("floor", {-1.2}), -2);
  EXPECT_EQ(number("rint", {2.5}), 2);
  EXPECT_EQ(number("rint", {3.5}), 4);
  EXPECT_EQ(text("rint", {table({{0.4, 0.6}, {1.4, 1.6}})}), "(2x2)[0,1;1,2]");
  EXPECT_EQ(number("min", {10, -10}), -10);
  EXPECT_EQ(text("min", {"abc", "def"}), "abc");
  EXPECT_EQ(text("max", {"abc", "def"}), "def");
  EXPECT_EQ(text("max", {floats({1, 2}), floats({1, 3})}), "(2)[1,3]");
  EXPECT_EQ(text("max", {floats({1, 2}), floats({1, 2, 0})}), "(3)[1,2,0]");
  EXPECT_EQ(number("clamp", {1.5, 0, 1}), 1);
  EXPECT_EQ(number("clamp", {-11, -10, 10}), -10);
  EXPECT_EQ(number("clamp", {5, -10, 10}), 5);
}

TEST_F(Values, elementaryFunctionsTakeDegrees) {
  EXPECT_EQ(number("sin", {30}), 0.5);
  EXPECT_EQ(number("cos", {90}), 0);
  EXPECT_EQ(number("tan", {45}), 1);
  EXPECT_NEAR(number("asin", {0.5}), 30, 1e-12);
  EXPECT_NEAR(number("acos", {0.5}), 60, 1e-12);
  EXPECT_NEAR(number("atan", {1}), 45, 1e-12);
  EXPECT_NEAR(number("atan2", {1, -1}), 135, 1e-12);
  EXPECT_EQ(number("pow", {2, 10}), 1024);
  EXPECT_NEAR(number("exp", {1}), 2.718281828459045, 1e-12);
  EXPECT_NEAR(number("ln", {number("exp", {2})}), 2, 1e-12);
  EXPECT_NEAR(number("log10", {1000}), 3, 1e-12);
  EXPECT_EQ(number("sqrt", {9}), 3);
  EXPECT_TRUE(services.warnings.empty());
  EXPECT_TRUE(std::isnan(number("sqrt", {-1})));
  ASSERT_EQ(services.warnings.size(), 1u);
  EXPECT_EQ(services.warnings[0].code, "not-a-number");
}

TEST_F(Values, infiniteAndMissingNumbersAreTold) {
  EXPECT_EQ(text("isinf", {kInfinity}), "true");
  EXPECT_EQ(text("isinf", {floats({1, kInfinity})}), "(2)[false,true]");
  EXPECT_EQ(text("isnan", {1}), "false");
  EXPECT_EQ(text("isnan", {number("ln", {-1})}), "true");
  EXPECT_EQ(text("isnan", {number("float", {"a"})}), "true");
  EXPECT_EQ(text("isNull", {"CityEngine"}), "false");
  EXPECT_EQ(text("isNull", {"\xee\x80\x80"}), "true");
  EXPECT_EQ(text("isNull", {strings({"a", "\xee\x80\x80"})}), "(2)[false,true]");
}

TEST_F(Values, conversionFollowsTheReference) {
  EXPECT_EQ(number("float", {"0.5"}), 0.5);
  EXPECT_EQ(number("float", {true}), 1);
  EXPECT_EQ(number("float", {"001.5"}), 1.5);
  EXPECT_EQ(text("floatArray", {strings({"1.5", "-2", "0", "nixda", "5+6"})}),
            "(5)[1.5,-2,0,nan,5]");
  EXPECT_EQ(text("floatArray", {bools({true, false, true})}), "(3)[1,0,1]");
  EXPECT_EQ(text("floatArray", {}), "(0)[]");
  EXPECT_EQ(text("bool", {"1"}), "true");
  EXPECT_EQ(text("bool", {6.66}), "true");
  EXPECT_EQ(text("bool", {"false"}), "false");
  EXPECT_EQ(text("bool", {"f"}), "false");
  EXPECT_EQ(text("bool", {"0.0"}), "false");
  EXPECT_EQ(text("bool", {"beneath the remains"}), "true");
  EXPECT_EQ(text("boolArray", {strings({"true", "1", "0", "f", "false", "any"})}),
            "(6)[true,true,false,false,false,true]");
  EXPECT_EQ(text("boolArray", {floats({1, 0, 1, 20})}), "(4)[true,false,true,true]");
  EXPECT_EQ(text("stringArray", {floats({1, 0, 1.777, 20})}), "(4)[1,0,1.777,20]");
  EXPECT_EQ(text("stringArray", {bools({true, false})}), "(2)[true,false]");
  EXPECT_EQ(text("str", {1.69 - 69 / 100.0}), "1");
  EXPECT_EQ(text("str", {true}), "true");
  EXPECT_EQ(callFunction("sel", {"scope.xy"}, services).type, ValueType::Selector);
}

TEST_F(Values, stringsAreSearchedAndCut) {
  EXPECT_EQ(number("len", {"cityengine"}), 10);
  EXPECT_EQ(number("len", {"caf\xc3\xa9"}), 4);
  const char* three = "CE_Zero CE_One CE_Two";
  EXPECT_EQ(number("find", {three, "CE", 0}), 0);
  EXPECT_EQ(number("find", {three, "CE", 1}), 8);
  EXPECT_EQ(number("find", {three, "asdf", 1}), -1);
  EXPECT_EQ(number("find", {three, "CE", 5}), -1);
  EXPECT_EQ(number("find", {"\xc3\xa9x\xc3\xa9x", "x", 1}), 3);
  EXPECT_EQ(number("count", {"cityengine", "e"}), 2);
  EXPECT_EQ(number("count", {"cityengine", ""}), 0);
  EXPECT_EQ(text("substring", {"0123456789", 2, 5}), "234");
  EXPECT_EQ(text("substring", {"0123456789", -20, 5}), "01234");
  EXPECT_EQ(text("substring", {"0123456789", 0, 20}), "0123456789");
  EXPECT_EQ(text("substring", {"0123456789", 5, 0}), "");
  EXPECT_EQ(text("substring", {"\xc3\xa9\xc3\xa8x", 1, 3}), "\xc3\xa8x");
  const char* rule = "rule your city with cityengine";
  EXPECT_EQ(number("findFirst", {rule, "city"}), 10);
  EXPECT_EQ(number("findLast", {rule, "city"}), 20);
  EXPECT_EQ(number("findLast", {rule, "town"}), -1);
  EXPECT_EQ(text("getPrefix", {rule, "city"}), "rule your ");
  EXPECT_EQ(text("getPrefix", {"myTexture.has.prefix.jpg", "."}), "myTexture");
  EXPECT_EQ(text("getPrefix", {"abc", "."}), "");
  EXPECT_EQ(text("getSuffix", {rule, "city"}), "engine");
  EXPECT_EQ(text("getRange", {rule, "y", "city"}), "our city with ");
  EXPECT_EQ(text("getRange", {"myTexture.hasName.001.jpg", ".", "."}), "hasName.001");
  EXPECT_EQ(text("getRange", {"CityEngine", "CityEn", "tyEngine"}), "");
  EXPECT_EQ(text("replace", {rule, "your city", "designs"}), "rule designs with cityengine");
  EXPECT_EQ(text("replace", {"myTexture.#.jpg", "#", 1}), "myTexture.1.jpg");
  EXPECT_EQ(text("replace", {"aaa", "a", "aa"}), "aaaaaa");
}

TEST_F(Values, splitStringTakesTextsAndExpressions) {
  EXPECT_EQ(text("splitString", {"a.b.c", "."}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {".b.", "."}), "(3)[,b,]");
  EXPECT_EQ(text("splitString", {"a\\b\\c", "\\"}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"abc", ""}), "(5)[,a,b,c,]");
  EXPECT_EQ(text("splitString", {"", ","}), "(1)[]");
  EXPECT_EQ(text("splitString", {"a;b;c", "$;"}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"a.b.c", "$\\."}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"a\t\tb\tc", "$\t+"}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"a b  c", "$\\s+"}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"a$b$c", "$\\$"}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"abc", "$\\B"}), "(3)[a,b,c]");
  EXPECT_EQ(text("splitString", {"abacba", "$(?<=a)b(?=a)"}), "(2)[a,acba]");
  EXPECT_EQ(text("splitString", {"a$b", "$"}), "(2)[a,b]");
  EXPECT_TRUE(services.warnings.empty());
  EXPECT_EQ(text("splitString", {"abc", "$("}), "(0)[]");
  EXPECT_EQ(text("splitString", {std::string(200001, ','), ","}), "(0)[]");
  ASSERT_EQ(services.warnings.size(), 2u);
  EXPECT_EQ(services.warnings[0].code, "bad-regex");
  EXPECT_EQ(services.warnings[1].code, "array-too-large");
}

TEST_F(Values, findFirstLooksThroughArrays) {
  EXPECT_EQ(number("findFirst", {table({{1, 2, 3}, {4, 5, 6}}), 4, 0}), 3);
  EXPECT_EQ(number("findFirst", {floats({6, 8.1, 6, 8.1}), 8, 0.5}), 1);
  EXPECT_EQ(number("findFirst", {floats({6, 8.1}), 8, 0}), -1);
  EXPECT_EQ(number("findFirst", {strings({"a", "b"}), "b"}), 1);
  EXPECT_EQ(number("findFirst", {bools({true, false}), false}), 1);
}

TEST_F(Values, stringListsHaveItems) {
  EXPECT_EQ(text("listItem", {"rule;your;city;", 2}), "city");
  EXPECT_EQ(text("listItem", {"rule;your;city;", 3}), "");
  EXPECT_EQ(text("listItem", {"rule;your;city;", -1}), "");
  EXPECT_EQ(text("listFirst", {"rule;your;city;"}), "rule");
  EXPECT_EQ(text("listLast", {"rule;your;city;"}), "city");
  EXPECT_EQ(text("listLast", {""}), "");
  EXPECT_EQ(number("listSize", {"cityengine;rules;"}), 2);
  EXPECT_EQ(number("listSize", {""}), 0);
  EXPECT_EQ(number("listIndex", {"rule;your;city;", "*y"}), 2);
  EXPECT_EQ(number("listIndex", {"rule;your;city;", "*y*"}), 1);
  EXPECT_EQ(number("listIndex", {"rule;your;city;", "town"}), -1);
  EXPECT_EQ(number("listCount", {"city;cityengine;city;", "city"}), 2);
  EXPECT_EQ(number("listCount", {"rule;your;city;", "*y*"}), 2);
  EXPECT_EQ(text("listRange", {"rule;your;city;with;cityengine;", 0, 3}), "rule;your;city;");
  EXPECT_EQ(text("listRange", {"a;b;", 1, 9}), "b;");
  EXPECT_EQ(text("listAdd", {"rule;your;", "city"}), "rule;your;city;");
  EXPECT_EQ(text("listAdd", {"rule;your;", "city;"}), "rule;your;city;");
  EXPECT_EQ(text("listRemove", {"rule;your;city;", "*u*"}), "your;city;");
  EXPECT_EQ(text("listRemove", {"floor_1;floor_2;floor_3;", "*_2"}), "floor_1;floor_3;");
  EXPECT_EQ(text("listRemoveAll", {"rule;your;designs;and;your;cities;", "*u*"}),
            "designs;and;cities;");
  EXPECT_EQ(text("listRetainAll", {"rule;your;designs;and;your;cities;", "*s"}), "designs;cities;");
  EXPECT_EQ(text("listClean", {";;;;;my;city;rules;;your;;city;;"}), "my;city;rules;your;city;");
  EXPECT_EQ(text("listClean", {";;cityengine;;;rules"}), "cityengine;rules;");
  EXPECT_EQ(text("listTerminate", {"a;b"}), "a;b;");
  EXPECT_EQ(text("listFromArray", {floats({1, 2, 3})}), "1;2;3;");
  EXPECT_EQ(text("listFromArray", {bools({true, false})}), "true;false;");
  EXPECT_EQ(text("listToArray", {"rule;your;city;"}), "(3)[rule,your,city]");
}

TEST_F(Values, arraysHaveSizes) {
  const Arg t = table({{1, 2, 3}, {4, 5, 6}});
  EXPECT_EQ(number("size", {t}), 6);
  EXPECT_EQ(number("nRows", {t}), 2);
  EXPECT_EQ(number("nColumns", {t}), 3);
  EXPECT_EQ(number("sum", {floats({1, 2, 3})}), 6);
  EXPECT_EQ(number("sum", {bools({true, false, true})}), 2);
  EXPECT_EQ(text("sum", {strings({"a", "b", "c"})}), "abc");
  EXPECT_EQ(text("transpose", {t}), "(3x2)[1,4;2,5;3,6]");
}

TEST_F(Values, setElemsFollowsTheReference) {
  const Arg zeros = floats({0, 0, 0, 0, 0, 0});
  EXPECT_EQ(text("setElems", {zeros, 2, 1}), "(6)[0,0,1,0,0,0]");
  EXPECT_EQ(text("setElems", {zeros, floats({1, 2, 3, 4}), 1}), "(6)[0,1,1,1,1,0]");
  EXPECT_EQ(text("setElems", {zeros, floats({5, 1, 3}), floats({1, 2, 3})}), "(6)[0,2,0,3,0,1]");
  EXPECT_EQ(text("setElems", {zeros, floats({1, 1, 1}), floats({1, 2, 3})}), "(6)[0,3,0,0,0,0]");
  const Arg square = table({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(text("setElems", {square, 1, 1, 5}), "(3x3)[0,0,0;0,5,0;0,0,0]");
  EXPECT_EQ(text("setElems", {square, floats({0, 2}), floats({0, 1, 2}), 1}),
            "(3x3)[1,1,1;0,0,0;1,1,1]");
  EXPECT_EQ(text("setElems", {square, floats({2, 1}), floats({2, 0}), table({{1, 2}, {3, 4}})}),
            "(3x3)[0,0,0;4,0,3;2,0,1]");
  EXPECT_EQ(text("setElems", {square, floats({1, 1}), floats({0, 2}), table({{1, 2}, {3, 4}})}),
            "(3x3)[0,0,0;3,0,4;0,0,0]");
  EXPECT_EQ(text("setElems", {floats({1, 1}), 3, 5}), "(4)[1,1,0,5]");
  EXPECT_EQ(text("setElems", {floats({1, 1}), 2, 2, 5}), "(3x3)[1,1,0;0,0,0;0,0,5]");
  EXPECT_EQ(text("setElems", {floats({1, 1}), -1, 5}), "(2)[1,1]");
  EXPECT_EQ(
      text("setElems", {floats({1, 2, 3, 4, 5, 6, 7}),
                        bools({false, false, false, false, true, true, true}), floats({3, 2, 1})}),
      "(7)[1,2,3,4,3,2,1]");
  EXPECT_EQ(text("setElems", {strings({"a"}), 2, "c"}), "(3)[a,,c]");
  EXPECT_TRUE(services.warnings.empty());
}

TEST_F(Values, setElemsReportsWhatCannotBe) {
  const Arg two = floats({1, 1});
  EXPECT_EQ(text("setElems", {two, floats({0, 1}), floats({1, 2, 3})}), "(2)[1,1]");
  EXPECT_EQ(text("setElems", {two, 1e18, 5}), "(2)[1,1]");
  EXPECT_EQ(text("setElems", {two, 1000, 1000, 5}), "(2)[1,1]");
  EXPECT_EQ(text("setElems", {two, 0, "a"}), "(2)[1,1]");
  EXPECT_EQ(services.warnings.size(), 4u);
}

TEST_F(Values, sortingGivesPlaces) {
  EXPECT_EQ(text("sortIndices", {strings({"c", "b", "d", "a"})}), "(4)[3,1,0,2]");
  EXPECT_EQ(text("sortIndices", {floats({2, 1, 3, 3, 1})}), "(5)[1,4,0,2,3]");
  EXPECT_EQ(text("sortIndices", {floats({2, std::nan(""), 1})}), "(3)[2,0,1]");
  EXPECT_EQ(text("sortIndices", {table({{3, 1, 2}, {2, 1, 3}})}), "(2x3)[1,2,0;4,3,5]");
  EXPECT_EQ(text("sortRowIndices", {table({{4, 0, 1}, {2, 1, 9}, {1, 3, 0}, {2, 1, 0}})}),
            "(4)[2,3,1,0]");
}

TEST_F(Values, coloursGoBothWays) {
  EXPECT_EQ(text("colorRGBToHex", {0, 0.5, 1}), "#0080FF");
  EXPECT_EQ(text("colorRGBOToHex", {0, 0.5, 1, 0.5}), "#0080FF80");
  EXPECT_EQ(text("colorHSVToHex", {90, 0.5, 0.5}), "#608040");
  EXPECT_EQ(text("colorHSVToHex", {90 - 720, 0.5, 0.5}), "#608040");
  EXPECT_EQ(text("colorHSVOToHex", {90, 0.5, 0.5, 0.5}), "#60804080");
  EXPECT_NEAR(number("colorHexToR", {"#4080BF"}), 0.2509803921568628, 1e-12);
  EXPECT_NEAR(number("colorHexToG", {"#4080BF80"}), 0.5019607843137256, 1e-12);
  EXPECT_NEAR(number("colorHexToB", {"#4080BF"}), 0.7490196078431374, 1e-12);
  EXPECT_EQ(number("colorHexToO", {"#4080BF"}), 0);
  EXPECT_NEAR(number("colorHexToO", {"#4080BF80"}), 0.5019607843137256, 1e-12);
  EXPECT_EQ(number("colorHexToH", {"#608040"}), 90);
  EXPECT_EQ(number("colorHexToS", {"#608040"}), 0.5);
  EXPECT_NEAR(number("colorHexToV", {"#60804080"}), 0.5019607843137256, 1e-12);
  EXPECT_TRUE(services.warnings.empty());
  EXPECT_EQ(number("colorHexToH", {"green"}), 0);
  EXPECT_EQ(services.warnings.size(), 1u);
}

TEST_F(Values, hueSurvivesTheRoundTrip) {
  for (int h = 0; h < 360; h += 15) {
    const std::string hex = text("colorHSVToHex", {h, 1, 1});
    EXPECT_NEAR(number("colorHexToH", {hex}), h, 0.5) << hex;
  }
}

TEST_F(Values, rampsRunFromEndToEnd) {
  EXPECT_EQ(text("colorRamp", {"whiteToBlack", 0}), "#FFFFFF");
  EXPECT_EQ(text("colorRamp", {"whiteToBlack", 1}), "#000000");
  EXPECT_EQ(text("colorRamp", {"whiteToBlack", 7}), "#000000");
  EXPECT_EQ(text("colorRamp", {"yellowToRed", 0.5}), "#FF8000");
  EXPECT_EQ(text("colorRamp", {"greenToRed", 0.5}), "#FFFF00");
  EXPECT_EQ(text("colorRamp", {"spectrum", 0.5}), "#00FF00");
  EXPECT_TRUE(services.warnings.empty());
  text("colorRamp", {"rainbow", 0.5});
  EXPECT_EQ(services.warnings.size(), 1u);
}

TEST_F(Values, drawsDependOnTheAddressAlone) {
  Shape s;
  s.path = 12345;
  const auto draw = [&](const std::vector<Arg>& args, uint64_t site) {
    return callFunction("rand", args, services, s, site).number;
  };
  EXPECT_EQ(draw({}, 1), draw({}, 1));
  EXPECT_NE(draw({}, 1), draw({}, 2));
  double low = 9, high = 0, sum = 0;
  for (uint64_t site = 0; site < 1000; ++site) {
    const double v = draw({2, 4}, site);
    low = std::min(low, v);
    high = std::max(high, v);
    sum += draw({10}, site);
  }
  EXPECT_GE(low, 2);
  EXPECT_LT(high, 4);
  EXPECT_NEAR(sum / 1000, 5, 0.4);
  EXPECT_EQ(text("p", {1}), "true");
  EXPECT_EQ(text("p", {2}), "true");
  EXPECT_EQ(text("p", {0}), "false");
  EXPECT_EQ(text("p", {-1}), "false");
  int yes = 0;
  for (uint64_t site = 0; site < 1000; ++site) {
    yes += callFunction("p", {0.3}, services, s, site).truth();
  }
  EXPECT_NEAR(yes, 300, 60);
  EXPECT_EQ(text("listRandom", {""}), "");
  EXPECT_EQ(text("listRandom", {"only;"}), "only");
}

}  // namespace
}  // namespace gable
