// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/block_selectors.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

// { front && VALUE : ... | VALUE : ... } with the two values that the rule computes.
BlockCode block() {
  BlockCode b;
  BlockTerm front, computed, both, second;
  front.word = 9;
  computed.kind = static_cast<uint8_t>(SelectTermKind::Tagged);
  computed.value = 0;
  both.kind = static_cast<uint8_t>(SelectTermKind::And);
  second.kind = static_cast<uint8_t>(SelectTermKind::Index);
  second.value = 1;
  b.terms = {front, computed, both, second};
  BlockItem one, other;
  one.termCount = 3;
  other.firstTerm = 3;
  other.termCount = 1;
  other.slot = 1;
  other.selectOperator = static_cast<uint8_t>(SelectOperator::All);
  b.items = {one, other};
  return b;
}

TEST(BlockSelectors, TakeTheValuesThatTheRuleComputed) {
  BlockSelectors selectors;
  const BlockCode code = block();
  const Value values[] = {Value::string(4), Value::of(2.0)};
  const auto items = selectors.of(code, values);
  ASSERT_EQ(items.size(), 2u);
  ASSERT_EQ(items[0].terms.size(), 3u);
  EXPECT_EQ(items[0].terms[0].word, 9u);
  EXPECT_EQ(items[0].terms[1].kind, SelectorTerm::Kind::Tagged);
  EXPECT_EQ(items[0].terms[1].word, 4u);
  EXPECT_EQ(items[0].terms[2].kind, SelectorTerm::Kind::And);
  EXPECT_EQ(items[1].terms[0].number, 2);
  EXPECT_EQ(items[1].slot, 1u);
  EXPECT_EQ(items[1].op, SelectOperator::All);
}

TEST(BlockSelectors, ATruthValueDecides) {
  BlockSelectors selectors;
  const BlockCode code = block();
  const Value values[] = {Value::of(true), Value::of(false)};
  const auto items = selectors.of(code, values);
  EXPECT_EQ(items[0].terms[1].kind, SelectorTerm::Kind::Boolean);
  EXPECT_EQ(items[0].terms[1].number, 1);
  EXPECT_EQ(items[1].terms[0].kind, SelectorTerm::Kind::Boolean);
  EXPECT_EQ(items[1].terms[0].number, 0);
}

}  // namespace
}  // namespace gable
