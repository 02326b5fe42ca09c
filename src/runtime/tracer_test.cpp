// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/tracer.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

constexpr uint32_t kNone = TraceNode::kNone;

class TracerTest : public testing::Test {
 protected:
  TracerTest() {
    program.pool = std::make_shared<ValuePool>();
    program.attributes.resize(2);
    program.attributes[0].name = "height";
    program.attributes[1].name = "width";
  }
  static Tracer::Made made(uint32_t parent, StringId name) {
    Tracer::Made m;
    m.parent = parent;
    m.name = name;
    return m;
  }

  Program program;
  DeriveOptions options;
  Tracer tracer{program, options};
};

TEST_F(TracerTest, KeepsTheTree) {
  const uint32_t lot = tracer.addCall(made(kNone, 1), 0);
  const uint32_t wall = tracer.addCall(made(lot, 2), 0);
  tracer.addLeaf(made(wall, 3), 5);
  const uint32_t roof = tracer.addCall(made(lot, 4), 0);
  tracer.endAsLeaf(roof, 6);
  const uint32_t gone = tracer.addCall(made(lot, 5), 0);
  tracer.drop(gone);
  ASSERT_EQ(tracer.size(), 5u);
  const std::vector<TraceNode>& nodes = tracer.nodes();
  EXPECT_EQ(nodes[wall].parent, lot);
  EXPECT_EQ(nodes[wall].rule, 0u);
  EXPECT_FALSE(nodes[wall].leaf);
  EXPECT_EQ(nodes[2].parent, wall);
  EXPECT_TRUE(nodes[2].leaf);
  EXPECT_EQ(nodes[2].rule, kNone);
  EXPECT_EQ(nodes[2].leafIndex, 5u);
  EXPECT_TRUE(nodes[roof].leaf);
  EXPECT_EQ(nodes[roof].rule, 0u);
  EXPECT_TRUE(nodes[gone].dropped);
}

TEST_F(TracerTest, AnAttributeIsNotedOnceARule) {
  const uint32_t lot = tracer.addCall(made(kNone, 1), 0);
  const uint32_t wall = tracer.addCall(made(lot, 2), 0);
  tracer.noteAttribute(lot, 0, Value::of(3.0));
  tracer.noteAttribute(lot, 1, Value::of(4.0));
  tracer.noteAttribute(lot, 0, Value::of(3.0));
  tracer.noteAttribute(wall, 0, Value::of(3.0));
  ASSERT_EQ(tracer.notes().size(), 3u);
  EXPECT_EQ(tracer.notes()[1].value.name, "width");
  EXPECT_EQ(tracer.notes()[2].node, wall);
}

TEST_F(TracerTest, NotesWhatWasDrawnChosenAndHandedOver) {
  const uint32_t lot = tracer.addCall(made(kNone, 1), 0);
  RuleCode rule;
  rule.parameters = {{program.pool->intern("deep"), ValueType::Float}};
  const Value deep = Value::of(7.0);
  tracer.noteParameters(lot, rule, &deep);
  tracer.noteChoice(lot, Span{0, 4, 9}, {0.25, 0.5, 1, 3});
  tracer.noteDraw(lot, Span{0, 10, 14}, "rand", Value::of(0.75));
  ASSERT_EQ(tracer.notes().size(), 3u);
  EXPECT_EQ(tracer.notes()[0].value.name, "deep");
  EXPECT_EQ(tracer.notes()[1].chosen, 1u);
  EXPECT_EQ(tracer.notes()[1].chance, 0.5);
  EXPECT_EQ(tracer.notes()[2].span.begin, 10u);
  // Outside of all rules there is nobody to note it for.
  tracer.noteDraw(kNone, Span{}, "rand", Value::of(0.75));
  EXPECT_EQ(tracer.notes().size(), 3u);
}

TEST_F(TracerTest, NotesEnd) {
  const uint32_t lot = tracer.addCall(made(kNone, 1), 0);
  for (size_t i = 0; i < Tracer::kMostNotes + 10; ++i) tracer.noteChoice(lot, Span{}, {});
  EXPECT_EQ(tracer.notes().size(), Tracer::kMostNotes);
}

TEST_F(TracerTest, FollowsLeavesThatAreGathered) {
  const uint32_t before = tracer.addCall(made(kNone, 1), 0);
  tracer.endAsLeaf(before, 3);
  const size_t from = tracer.size();
  const uint32_t shown = tracer.addCall(made(before, 2), 0);
  tracer.showShape(shown, 10);
  tracer.addLeaf(made(shown, 3), 11);
  tracer.addLeaf(made(shown, 4), 12);
  EXPECT_EQ(tracer.shownShapes(from, 10, 3), (std::vector<bool>{true, false, false}));
  // The second of the three has been taken.
  tracer.renumberLeaves(from, 10, {10, kNone, 11});
  EXPECT_EQ(tracer.nodes()[before].leafIndex, 3u);
  EXPECT_EQ(tracer.nodes()[shown].shapeIndex, 10u);
  EXPECT_EQ(tracer.nodes()[from + 1].leafIndex, kNone);
  EXPECT_EQ(tracer.nodes()[from + 2].leafIndex, 11u);
}

TEST_F(TracerTest, FiltersByRuleAndPath) {
  const std::string lot = "Lot", house = "House", roof = "Roof";
  EXPECT_FALSE(tracer.choosesTops());
  options.traceFilter.rule = house;
  EXPECT_TRUE(tracer.choosesTops());
  EXPECT_TRUE(tracer.isTop({&lot, &house}));
  EXPECT_FALSE(tracer.isTop({&lot, &house, &roof}));
  options.traceFilter = {{}, {lot, house}, {}};
  EXPECT_TRUE(tracer.isTop({&lot, &house}));
  EXPECT_FALSE(tracer.isTop({&lot}));
  EXPECT_FALSE(tracer.isTop({&house}));
  EXPECT_FALSE(tracer.isTop({&lot, &house, &roof}));
}

TEST_F(TracerTest, FiltersByLevel) {
  options.traceFilter.depth = 1;
  const uint32_t lot = tracer.addCall(made(kNone, 1), 0);
  ASSERT_TRUE(tracer.reachesBelow(kNone));
  ASSERT_TRUE(tracer.reachesBelow(lot));
  const uint32_t wall = tracer.addCall(made(lot, 2), 0);
  EXPECT_FALSE(tracer.reachesBelow(wall));
  EXPECT_FALSE(tracer.reachesBelow(TraceNode::kCut));
  tracer.noteDraw(TraceNode::kCut, {}, "rand", Value::of(1.0));
  EXPECT_TRUE(tracer.notes().empty());
}

}  // namespace
}  // namespace gable
