// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/attribute_values.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

class AttributeValuesTest : public testing::Test {
 protected:
  uint32_t declare(const std::string& name, ValueType type) {
    AttributeCode& a = program.attributes.emplace_back();
    a.name = name;
    a.type = type;
    return static_cast<uint32_t>(program.attributes.size() - 1);
  }
  void give(const AttributeValues::Given& given) {
    values = AttributeValues(program.attributes.size());
    values.give(given, program, pool);
  }

  ValuePool pool;
  Program program;
  AttributeValues values;
};

TEST_F(AttributeValuesTest, TakesWhatHasTheName) {
  const uint32_t height = declare("height", ValueType::Float);
  const uint32_t width = declare("width", ValueType::Float);
  give({{"height", Value::of(9.0)}, {"depth", Value::of(3.0)}});
  ASSERT_TRUE(values.isKnown(height));
  EXPECT_EQ(values.value(height).number, 9);
  EXPECT_FALSE(values.isKnown(width));
}

TEST_F(AttributeValuesTest, TheLastOneGivenCounts) {
  const uint32_t height = declare("height", ValueType::Float);
  give({{"height", Value::of(9.0)}, {"height", Value::of(4.0)}});
  EXPECT_EQ(values.value(height).number, 4);
}

TEST_F(AttributeValuesTest, ConvertsBetweenTextsNumbersAndTruth) {
  const uint32_t number = declare("number", ValueType::Float);
  const uint32_t truth = declare("truth", ValueType::Bool);
  give({{"number", pool.string("2.5")}, {"truth", pool.string("true")}});
  EXPECT_EQ(values.value(number).number, 2.5);
  EXPECT_EQ(values.value(truth).type, ValueType::Bool);
  EXPECT_TRUE(values.value(truth).truth());
  give({{"number", Value::of(true)}, {"truth", Value::of(0.0)}});
  EXPECT_EQ(values.value(number).type, ValueType::Float);
  EXPECT_EQ(values.value(number).number, 1);
  EXPECT_FALSE(values.value(truth).truth());
}

TEST_F(AttributeValuesTest, LengthsHaveTheirUnitsAndHalfNumbersAreNone) {
  const uint32_t number = declare("number", ValueType::Float);
  give({{"number", pool.string("12 ft")}});
  EXPECT_NEAR(values.value(number).number, 3.6576, 1e-12);
  for (const char* text : {"12 floors", "2-3", "4;5", "12 ", "", "1e999", "nan"}) {
    values.begin();
    const Value given = pool.string(text);
    give({{"number", given}});
    EXPECT_EQ(values.isKnown(number), std::string(text) == "12 ") << text;
    EXPECT_EQ(takesValue(program.attributes[number], given, pool), values.isKnown(number)) << text;
  }
}

TEST_F(AttributeValuesTest, KeepsTheInitialiserForWhatIsOfNoUse) {
  const uint32_t number = declare("number", ValueType::Float);
  give({{"number", pool.string("tall")}});
  EXPECT_FALSE(values.isKnown(number));
}

TEST_F(AttributeValuesTest, ConstantsAndPropagatedOnesAreNotGiven) {
  const uint32_t constant = declare("constant", ValueType::Float);
  const uint32_t propagated = declare("propagated", ValueType::Float);
  program.attributes[constant].constant = true;
  program.attributes[propagated].propagatesFrom = 0;
  give({{"constant", Value::of(1.0)}, {"propagated", Value::of(1.0)}});
  EXPECT_FALSE(values.isKnown(constant));
  EXPECT_FALSE(values.isKnown(propagated));
}

TEST_F(AttributeValuesTest, AnotherWorkerGetsWhatIsKnown) {
  const uint32_t known = declare("known", ValueType::Float);
  const uint32_t busy = declare("busy", ValueType::Float);
  give({{"known", Value::of(7.0)}});
  values.beginEvaluation(busy);
  EXPECT_TRUE(values.isBusy(busy));
  const AttributeValues copy = values.known();
  EXPECT_EQ(copy.value(known).number, 7);
  EXPECT_TRUE(copy.isKnown(known));
  EXPECT_FALSE(copy.isBusy(busy));
  EXPECT_FALSE(copy.isKnown(busy));
}

TEST_F(AttributeValuesTest, OfOneShapeAreForgottenForTheNext) {
  const uint32_t height = declare("height", ValueType::Float);
  give({{"height", Value::of(7.0)}});
  values.begin();
  EXPECT_FALSE(values.isKnown(height));
}

TEST_F(AttributeValuesTest, HashesTellValuesApart) {
  const uint32_t a = declare("a", ValueType::Float);
  const uint32_t b = declare("b", ValueType::Float);
  give({{"a", Value::of(7.0)}});
  const std::vector<uint64_t> first = values.hashes();
  give({{"a", Value::of(8.0)}});
  const std::vector<uint64_t> second = values.hashes();
  EXPECT_NE(first[a], 0u);
  EXPECT_NE(first[a], second[a]);
  EXPECT_EQ(first[b], 0u);
}

}  // namespace
}  // namespace gable
