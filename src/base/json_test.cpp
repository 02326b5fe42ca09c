// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gable {
namespace {

TEST(Json, readsEveryKindOfValue) {
  const auto r = parseJson(R"({"a":[1,-2.5e3,true,null,"x\u00e9"],"b":{"c":false},"a2":1e400})");
  EXPECT_FALSE(r.ok());  // 1e400 has no value
  auto t = parseJson(R"( {"a":[1,-2.5e3,true,null,"x\u00e9"],"b":{"c":false},"b":{"c":7}} )");
  ASSERT_TRUE(t.ok()) << t.error().message;
  const JsonValue& a = (*t)["a"];
  EXPECT_EQ(a.size(), 5u);
  EXPECT_EQ(a.at(0).number(0), 1);
  EXPECT_EQ(a.at(1).number(0), -2500);
  EXPECT_TRUE(a.at(2).boolean(false));
  EXPECT_TRUE(a.at(3).isNull());
  EXPECT_EQ(a.at(4).text(), "x\xc3\xa9");
  EXPECT_TRUE(a.at(5).isNull());
  EXPECT_EQ((*t)["b"]["c"].number(0), 7);
  EXPECT_EQ(t->members().size(), 3u);
  EXPECT_TRUE((*t)["none"]["deeper"].isNull());
}

TEST(Json, reportsWhereTheTextIsWrong) {
  for (const char* text : {"", "{", "[1,]", "{\"a\":}", "nul", "[1] 2", "\"\x01\"", "[\"\xff\"]",
                           "{\"a\" 1}", "[01]", "'a'", "[NaN]", "\xff\xfe"}) {
    const auto r = parseJson(text);
    EXPECT_FALSE(r.ok()) << text;
    EXPECT_EQ(r.error().code, "json-syntax") << text;
    EXPECT_FALSE(r.error().message.empty());
  }
  EXPECT_NE(parseJson("{\n  \"a\": x}").error().message.find("line 2"), std::string::npos);
}

TEST(Json, stopsAtItsLimits) {
  EXPECT_EQ(parseJson(std::string(100000, '[')).error().code, "json-limit");
  std::string nested;
  for (int i = 0; i < 100000; ++i) nested += "{\"a\":";
  EXPECT_EQ(parseJson(nested).error().code, "json-limit");
  std::string many = "[0";
  for (int i = 0; i < 100; ++i) many += ",0";
  EXPECT_EQ(parseJson(many + "]", {10, 100}).error().code, "json-limit");
  EXPECT_TRUE(parseJson(many + "]", {10, 102}).ok());
}

TEST(Json, writesWhatReadsBack) {
  std::string out;
  JsonWriter w(out);
  w.beginObject().field("n", 0.1).field("t", "a\"b\\c\n\x01\xc3\xa9\xff").key("l").beginArray();
  w.value(1).value(-5).value(uint64_t{18446744073709551615u}).value(true).null().value(-0.0);
  w.value(std::numeric_limits<double>::quiet_NaN()).value(0.1f).endArray();
  w.key("e").beginObject().endObject().endObject();
  EXPECT_EQ(out,
            "{\"n\":0.1,\"t\":\"a\\\"b\\\\c\\n\\u0001\xc3\xa9\xef\xbf\xbd\",\"l\":[1,-5,"
            "18446744073709551615,true,null,0,null,0.1],\"e\":{}}");
  EXPECT_TRUE(parseJson(out).ok());
}

TEST(Json, indentsOneElementALine) {
  std::string out;
  JsonWriter w(out, 2);
  w.beginObject().key("a").beginArray().value(1).value(2).endArray().field("b", false);
  w.key("c").beginArray().endArray().endObject();
  EXPECT_EQ(out, "{\n  \"a\": [\n    1,\n    2\n  ],\n  \"b\": false,\n  \"c\": []\n}");
}

}  // namespace
}  // namespace gable
