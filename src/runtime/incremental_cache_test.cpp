// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/incremental_cache.h"

#include <gtest/gtest.h>

#include "gable/limits.h"
#include "runtime/usage.h"

namespace gable {
namespace {

constexpr ShareKey kKey{11, 12}, kInnerKey{13, 14};
constexpr uint64_t kMany = 1000, kMuch = 100'000;

class IncrementalCacheTest : public testing::Test {
 protected:
  IncrementalCacheTest() {
    program.rules.resize(2);
    program.code.resize(4);
    reach.resize(2);
    reach[0] = {100, {0}};
    reach[1] = {200, {}};
    shape.size = {1, 2, 3};
    cache = make();
    cache->begin({7, {21, 22}});
    prototypes.beginUnit();
  }
  std::unique_ptr<IncrementalCache> make(bool thrownAway = false) {
    return std::make_unique<IncrementalCache>(
        IncrementalCache::Tables{program, reach, before, thrownAway}, output, prototypes, tally);
  }
  /// The cache of the next derivation: the operation that was kept by kKey is known to it.
  void goOn(bool thrownAway = false) {
    recall.operations = cache->operations();
    recall.operationNumbers.emplace(kKey, 0);
    before.recall = &recall;
    before.scene = &scene;
    cache = make(thrownAway);
  }
  ShareKey keyOf(uint32_t rule, std::vector<Value> arguments = {}, uint32_t depth = 1,
                 uint64_t place = 0) {
    return cache->keyOf({rule, depth, shape, arguments, locals, place});
  }
  void makeLeaves(int count) {
    for (int i = 0; i < count; ++i) output.openLeaves.emplace_back();
  }
  // A call of a rule that takes so many steps.
  void derivePart(const ShareKey& key, uint64_t steps, IncrementalCache::Moment end = {0, 0}) {
    ASSERT_FALSE(cache->beginPart(key, 0, {0, 0}));
    tally.countSteps(steps);
    makeLeaves(2);
    cache->endPart(end);
  }

  Program program;
  std::vector<Reach> reach;
  RecallInput before;
  /// What the derivation before has left.
  Recall recall;
  Scene scene;
  Limits limits;
  Usage usage{limits, nullptr};
  Tally tally{usage};
  Output output;
  Prototypes prototypes{output};
  LocalValues locals;
  Shape shape;
  std::unique_ptr<IncrementalCache> cache;
};

TEST_F(IncrementalCacheTest, KeysHoldAllThatACallDependsOn) {
  const ShareKey plain = keyOf(0);
  EXPECT_EQ(plain, keyOf(0));
  EXPECT_NE(plain, keyOf(1));
  EXPECT_NE(plain, keyOf(0, {Value::of(1.0)}));
  EXPECT_NE(plain, keyOf(0, {}, 2));
  EXPECT_NE(plain, keyOf(0, {}, 1, 99));
  shape.path = 5;
  EXPECT_NE(plain, keyOf(0));
  shape.path = 0;
  shape.locals = locals.bind(0, 3, Value::of(1.0));
  const ShareKey bound = keyOf(0);
  EXPECT_NE(plain, bound);
  shape.locals = locals.bind(0, 3, Value::of(2.0));
  EXPECT_NE(bound, keyOf(0));
}

TEST_F(IncrementalCacheTest, KeysHoldWhatIsGivenToAttributesWithinReach) {
  const ShareKey reading = keyOf(0), other = keyOf(1);
  cache->begin({7, {21, 99}});
  EXPECT_EQ(keyOf(0), reading);
  cache->begin({7, {99, 22}});
  EXPECT_NE(keyOf(0), reading);
  EXPECT_EQ(keyOf(1), other);
  cache->begin({8, {21, 22}});
  EXPECT_NE(keyOf(0), reading);
  EXPECT_NE(keyOf(1), other);
  reach[0].code = 101;
  cache->begin({7, {21, 22}});
  EXPECT_NE(keyOf(0), reading);
}

TEST_F(IncrementalCacheTest, TheInitialShapeIsPartOfAllKeys) {
  InitialShapeInfo info;
  const auto hash = [&] { return IncrementalCache::inputsOf(info, {}).shape; };
  const uint64_t plain = hash();
  info.seed = 4;
  EXPECT_NE(hash(), plain);
  info.seed = 0;
  info.origin = Frame::moved({1, 0, 0});
  EXPECT_NE(hash(), plain);
  info.origin = {};
  info.name = "lot";
  EXPECT_NE(hash(), plain);
  info.name.clear();
  EXPECT_EQ(hash(), plain);
}

TEST_F(IncrementalCacheTest, KeepsCostlyPartsWithWhatTheyCounted) {
  makeLeaves(3);
  ASSERT_FALSE(cache->beginPart(kKey, 0, {0, 0}));
  tally.countShapes(5);
  tally.countSteps(kMany);
  makeLeaves(4);
  cache->endPart({0, 0});
  ASSERT_EQ(cache->parts().size(), 1u);
  const RecallPart& part = cache->parts()[0];
  EXPECT_EQ(part.key, kKey);
  EXPECT_EQ(part.begin.leaves, 3u);
  EXPECT_EQ(part.end.leaves, 7u);
  EXPECT_EQ(part.shapes, 5u);
  EXPECT_EQ(part.steps, kMany);
  cache->endUnit(2, 9);
  EXPECT_EQ(cache->parts()[0].worker, 2u);
  EXPECT_EQ(cache->parts()[0].prototype, 9u);
}

TEST_F(IncrementalCacheTest, KeepsNoPartThatIsSmallOrWarnedOrWasDivided) {
  derivePart(kKey, 10);
  EXPECT_TRUE(cache->parts().empty());
  derivePart(kKey, kMany, {1, 0});
  EXPECT_TRUE(cache->parts().empty());
  derivePart(kKey, kMany, {0, 1});
  EXPECT_TRUE(cache->parts().empty());
  derivePart(kKey, kMany);
  EXPECT_EQ(cache->parts().size(), 1u);
}

TEST_F(IncrementalCacheTest, PartsComeAfterThoseInsideThem) {
  ASSERT_FALSE(cache->beginPart(kKey, 0, {0, 0}));
  derivePart(kInnerKey, kMany);
  derivePart({15, 16}, kMany);
  cache->endPart({0, 0});
  ASSERT_EQ(cache->parts().size(), 3u);
  EXPECT_EQ(cache->parts()[2].key, kKey);
  EXPECT_EQ(cache->parts()[2].firstInside, 0u);
  EXPECT_EQ(cache->parts()[1].firstInside, 1u);
  EXPECT_EQ(cache->parts()[2].steps, 2 * kMany);
}

TEST_F(IncrementalCacheTest, LooksSeldomAtRulesWhoseCallsAreSmall) {
  int due = 0;
  for (int call = 0; call < 160; ++call) {
    if (!cache->isRuleDue(0)) continue;
    ++due;
    derivePart(kKey, 1);
  }
  EXPECT_GE(due, 10);
  EXPECT_LE(due, 11);
  for (int call = 0; call < 160; ++call) {
    ASSERT_TRUE(cache->isRuleDue(1));
    ASSERT_FALSE(cache->beginPart(kKey, 1, {0, 0}));
    tally.countSteps(kMany);
    cache->endPart({0, 0});
  }
}

TEST_F(IncrementalCacheTest, KeepsOperationsThatAreMuchWork) {
  const std::vector<BlockChild> children{{shape, 1}, {shape, 2}};
  const IncrementalCache::OperationResult result{shape, children};
  cache->endOperation(kKey, 0, 10, &result);
  EXPECT_TRUE(cache->operations().empty());
  cache->endOperation(kKey, 0, kMuch, nullptr);
  EXPECT_TRUE(cache->operations().empty());
  cache->endOperation(kKey, 0, kMuch, &result);
  ASSERT_EQ(cache->operations().size(), 1u);
  EXPECT_EQ(cache->operations()[0]->children.size(), 2u);
  // So much for so many shapes is no more than it takes to keep them.
  const std::vector<BlockChild> many(1000, {shape, 1});
  const IncrementalCache::OperationResult large{shape, many};
  cache->endOperation(kInnerKey, 0, 3000, &large);
  EXPECT_EQ(cache->operations().size(), 1u);
  cache->endOperation(kInnerKey, 0, 3000, &result);
  EXPECT_EQ(cache->operations().size(), 2u);
  cache->endOperation(kInnerKey, 0, kMuch, &large);
  EXPECT_EQ(cache->operations().size(), 3u);
}

TEST_F(IncrementalCacheTest, TakesAnOperationOverWithTheLocalValuesOfNow) {
  shape.extra = makeRef<ShapeExtra>();
  shape.locals = 3;
  const std::vector<BlockChild> children{{shape, 1}, {shape, 2}};
  const IncrementalCache::OperationResult result{shape, children};
  cache->endOperation(kKey, 0, kMuch, &result);
  goOn();
  Shape now;
  now.locals = 8;
  std::vector<BlockChild> taken;
  EXPECT_FALSE(cache->takeOperation(kInnerKey, 1, now, taken));
  ASSERT_TRUE(cache->takeOperation(kKey, 1, now, taken));
  EXPECT_EQ(now.size, shape.size);
  EXPECT_EQ(now.locals, 8u);
  ASSERT_EQ(taken.size(), 2u);
  EXPECT_EQ(taken[1].slot, 2u);
  EXPECT_EQ(taken[1].shape.locals, 8u);
  // What is known stays known for the derivation after this one, and is looked for again.
  EXPECT_EQ(cache->operations().size(), 1u);
  for (int call = 0; call < 20; ++call) EXPECT_TRUE(cache->isOperationDue(1));
}

TEST_F(IncrementalCacheTest, OperationsThatChangeTheSetOfAttributesAreNotKept) {
  const std::vector<BlockChild> children{{shape, 1}};
  Shape other = shape;
  other.attributes = 5;
  const IncrementalCache::OperationResult changed{other, children};
  cache->endOperation(kKey, 0, kMuch, &changed);
  const IncrementalCache::OperationResult changedChild{other, children, 5};
  cache->endOperation(kKey, 0, kMuch, &changedChild);
  EXPECT_TRUE(cache->operations().empty());
}

TEST_F(IncrementalCacheTest, AnOperationIsTheSameForShapesWithOtherAttributes) {
  shape.attributes = 5;
  const std::vector<BlockChild> children{{shape, 1}};
  const IncrementalCache::OperationResult result{shape, children, 5};
  cache->endOperation(kKey, 0, kMuch, &result);
  ASSERT_EQ(cache->operations().size(), 1u);
  goOn();
  Shape now;
  now.attributes = 6;
  std::vector<BlockChild> taken;
  ASSERT_TRUE(cache->takeOperation(kKey, 1, now, taken));
  EXPECT_EQ(now.attributes, 6u);
  EXPECT_EQ(now.size, shape.size);
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].shape.attributes, 6u);
}

TEST_F(IncrementalCacheTest, APassThatIsThrownAwayTakesOperationsAndKeepsNone) {
  const IncrementalCache::OperationResult result{shape, {}};
  cache->endOperation(kKey, 0, kMuch, &result);
  goOn(true);
  Shape now;
  std::vector<BlockChild> taken;
  ASSERT_TRUE(cache->takeOperation(kKey, 1, now, taken));
  EXPECT_EQ(now.size, shape.size);
  cache->endOperation(kInnerKey, 0, kMuch, &result);
  EXPECT_TRUE(cache->operations().empty());
}

TEST_F(IncrementalCacheTest, TakesAPartOverToWhereItIsCalledNow) {
  scene.prototypes.resize(1);
  scene.prototypes[0].leafCount = 6;
  scene.leaves.resize(6);
  for (uint32_t l = 0; l < 6; ++l) scene.leaves[l].scale.x = l;
  recall.prototypes.resize(1);
  recall.names = {4};
  recall.materials = {uint64_t{0}};
  recall.attributeSets = {0};
  RecallPart part;
  part.key = kKey;
  part.begin.leaves = 2;
  part.end.leaves = 5;
  part.shapes = part.shapesExpanded = 3;
  part.steps = kMany;
  recall.parts = {part};
  recall.partNumbers.emplace(kKey, 0);
  before.recall = &recall;
  before.scene = &scene;
  before.instructions = {1};
  cache = make();
  makeLeaves(10);
  prototypes.beginUnit();
  makeLeaves(1);
  EXPECT_EQ(cache->beginPart(kKey, 0, {0, 0, 5}), &recall.parts[0]);
  EXPECT_EQ(output.openLeaves.size(), 11u);
  EXPECT_EQ(tally.made(), 3u);
  EXPECT_EQ(tally.steps(), kMany);
  EXPECT_EQ(cache->taken(), 3u);
  // It is kept for the derivation after this one.
  ASSERT_EQ(cache->parts().size(), 1u);
  EXPECT_TRUE(cache->parts()[0].taken);
  EXPECT_EQ(cache->parts()[0].holes, 5u);
  EXPECT_EQ(cache->parts()[0].begin.leaves, 2u);
  EXPECT_EQ(cache->parts()[0].end.leaves, 5u);
}

// What was taken over within a part leaves a hole there, and the part is kept.
TEST_F(IncrementalCacheTest, KeepsPartsAroundWhatWasTakenOver) {
  ASSERT_FALSE(cache->beginPart(kKey, 0, {0, 1, 2}));
  tally.countSteps(kMany);
  cache->endPart({0, 1, 4});
  ASSERT_EQ(cache->parts().size(), 1u);
  EXPECT_EQ(cache->parts()[0].holes, 2u);
  EXPECT_EQ(cache->parts()[0].holesEnd, 4u);
}

}  // namespace
}  // namespace gable
