// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

TEST(Flow, nilDropsTheShape) {
  FakeServices services;
  EXPECT_TRUE(Op("NIL").on(boxShape({1, 1, 1}), services).dropped);
}

TEST(Flow, printShowsValuesAndArrays) {
  FakeServices services;
  const Shape s;
  Op("print").args(2.5).on(s, services);
  Op("print").args(table({{1, 2}, {3, 4}})).on(s, services);
  Op("print").args("text").on(s, services);
  EXPECT_EQ(services.prints,
            (std::vector<std::string>{"2.5", "(2x2)\n   1   2\n   3   4", "text"}));
}

TEST(Flow, reportRecordsKeyAndValue) {
  FakeServices services;
  const Shape s;
  Op("report").args("window.area", 3).on(s, services);
  Op("report").args("window.open", true).on(s, services);
  ASSERT_EQ(services.reports.size(), 2u);
  EXPECT_EQ(services.reports[0].key, "window.area");
  EXPECT_EQ(services.reports[0].value.number, 3);
  EXPECT_EQ(services.reports[1].value.type, ValueType::Bool);
  EXPECT_FALSE(Op("report").args("k", floats({1, 2})).on(s, services).status.ok());
}

TEST(Flow, labelNeedsAName) {
  FakeServices services;
  Op("label").args("tower").on(boxShape({1, 1, 1}), services);
  EXPECT_EQ(services.labels, std::vector<std::string>{"tower"});
  EXPECT_FALSE(Op("label").args("").on(boxShape({1, 1, 1}), services).status.ok());
}

}  // namespace
}  // namespace gable
