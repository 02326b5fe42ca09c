// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "runtime/leaf_merger.h"

#include <gtest/gtest.h>

#include "runtime/recall.h"

namespace gable {
namespace {

constexpr uint32_t kMany = 20000;

class LeafMergerTest : public testing::Test {
 protected:
  LeafMergerTest() {
    program_.pool = std::make_shared<ValuePool>();
    for (const char* name : {"Lot", "Wall", "Roof"}) names_.push_back(program_.pool->intern(name));
  }
  // Leaves in the numbers of a worker; each stands at its own place.
  Output outputWith(uint32_t leaves, double firstPlace) {
    Output out;
    for (uint32_t i = 0; i < leaves; ++i) {
      Leaf& leaf = out.leaves.emplace_back();
      leaf.frame = Frame::moved({firstPlace + i, 0, 0});
      leaf.name = names_[1 + i % 2];
      leaf.materials = out.materialNumber(0, 0);
    }
    return out;
  }

  Program program_;
  MaterialTable materials_;
  AttributePool attributes_;
  std::vector<StringId> names_;
  MergeInput input_{program_, materials_, attributes_};
};

TEST_F(LeafMergerTest, leavesOfSeveralWorkersLieInTheOrderInWhichTheyWereAdded) {
  std::vector<Output> outputs;
  outputs.push_back(outputWith(kMany, 0));
  outputs.push_back(outputWith(kMany, kMany));
  Scene scene;
  scene.prototypes.resize(2 * kMany / 10);
  scene.roots.resize(1);
  const std::string root = "here";
  LeafMerger merger(outputs, input_, scene, 2 * kMany);
  // The second worker's first, in prototypes of ten leaves.
  for (const uint32_t worker : {1u, 0u}) {
    for (uint32_t i = 0; i < kMany; i += 10) {
      merger.addPrototype(names_[0], {worker, i, 4});
      merger.addLeaves({worker, i + 4, 6});
    }
  }
  merger.addRoot(root);
  merger.finish();

  ASSERT_EQ(2 * kMany, scene.leaves.size());
  for (uint32_t i = 0; i < 2 * kMany; ++i) {
    EXPECT_EQ((i + kMany) % (2 * kMany), scene.leaves[i].frame.origin.x);
    EXPECT_EQ(i % 2 == 0 ? "Wall" : "Roof", scene.names[scene.leaves[i].name]);
  }
  EXPECT_EQ((std::vector<std::string>{"Lot", "Wall", "Roof", "here"}), scene.names);
  EXPECT_EQ("Lot", scene.names[scene.prototypes.back().name]);
  EXPECT_EQ("here", scene.names[scene.roots[0].name]);
  EXPECT_EQ(1u, scene.materialLists.size());
}

TEST_F(LeafMergerTest, theLeavesOfOneWorkerStayWhereTheyAre) {
  std::vector<Output> outputs;
  outputs.push_back(outputWith(10, 0));
  const Leaf* const first = outputs[0].leaves.data();
  Scene scene;
  scene.prototypes.resize(1);
  LeafMerger merger(outputs, input_, scene, 10);
  merger.addPrototype(names_[0], {0, 0, 10});
  merger.finish();
  EXPECT_EQ(first, scene.leaves.data());
  EXPECT_EQ("Roof", scene.names[scene.leaves[9].name]);
}

// What the scene before calls by its numbers gets those of the scene that is made.
TEST_F(LeafMergerTest, leavesOfTheSceneBeforeAreNumberedAnew) {
  Scene before;
  before.names = {"Roof", "Wall"};
  before.materialLists = {{0}, {0}};
  before.sources.resize(1);
  before.attributeSets.resize(3);
  before.leaves.resize(3);
  for (uint32_t i = 0; i < 3; ++i) before.leaves[i] = {.name = i % 2, .attributes = i};
  before.leaves[2].materials = 1;
  Recall recall;
  recall.names = {names_[2], names_[1]};
  recall.materials = {0, 0};
  recall.attributeSets = {0, 0, 0};
  const uint32_t first = attributes_.with(0, 0, Value::of(1.0));
  const uint32_t second = attributes_.with(0, 0, Value::of(2.0));
  recall.attributeSets = {0, second, first};
  program_.attributes.resize(1);
  program_.attributes[0].name = "height";
  RecallInput from;
  from.recall = &recall;
  from.scene = &before;
  from.instructions = {0};
  input_.before = &from;
  std::vector<Output> outputs;
  outputs.push_back(outputWith(1, 7));
  Scene scene;
  scene.prototypes.resize(2);
  LeafMerger merger(outputs, input_, scene, 4);
  merger.addPrototype(names_[0], {0, 0, 1});
  merger.addPrototype(names_[0], {1, 0, 3, second, first});
  merger.finish();
  ASSERT_EQ(4u, scene.leaves.size());
  EXPECT_EQ((std::vector<std::string>{"Lot", "Wall", "Roof"}), scene.names);
  EXPECT_EQ("Roof", scene.names[scene.leaves[1].name]);
  EXPECT_EQ("Wall", scene.names[scene.leaves[2].name]);
  EXPECT_EQ(1u, scene.materialLists.size());
  EXPECT_EQ(0u, scene.leaves[3].materials);
  EXPECT_EQ(0u, scene.leaves[1].attributes);
  EXPECT_EQ(1u, scene.leaves[2].attributes);
  EXPECT_EQ(1u, scene.leaves[3].attributes);
  EXPECT_EQ(1, scene.attributeValues[scene.attributeSets[1][0]].values[0].number);
}

TEST_F(LeafMergerTest, whatIsNotFinishedIsLeft) {
  std::vector<Output> outputs;
  outputs.push_back(outputWith(kMany, 0));
  outputs.push_back(outputWith(kMany, 0));
  Scene scene;
  LeafMerger merger(outputs, input_, scene, kMany);
  for (uint32_t i = 0; i < kMany; ++i) merger.addPrototype(names_[0], {0, i, 1});
  SUCCEED();
}

}  // namespace
}  // namespace gable
