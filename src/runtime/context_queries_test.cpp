// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/context_queries.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gable {
namespace {

constexpr StringId kTree = 5;

Shape boxAt(double x) {
  Shape s;
  s.scope = Frame::moved({x, 0, 0});
  s.size = {1, 1, 1};
  s.geometry.kind = GeometryKind::Box;
  return s;
}

class ContextQueriesTest : public testing::Test {
 protected:
  Frame world = Frame::moved({0, 0, 50});
  ContextQueries first{true, nullptr};

  ContextQueries::Place at(uint32_t child) const { return {0, {child}, world}; }
};

TEST_F(ContextQueriesTest, TheFirstPassCollectsInTheWorld) {
  EXPECT_TRUE(first.collects());
  first.add(kTree, boxAt(3), at(2));
  first.add(0, Shape{}, at(3));
  ASSERT_EQ(first.occluders().size(), 1u) << "a shape without geometry occludes nothing";
  const Occluder& o = first.occluders()[0];
  EXPECT_EQ(o.label, kTree);
  EXPECT_EQ(o.scope.origin, (Vec3{3, 0, 50}));
  EXPECT_EQ(o.path, std::vector<uint32_t>{2});
  EXPECT_EQ(o.mesh.faceCount(), 6u);
  EXPECT_EQ(o.mesh.positions[0].z, 50);
}

TEST_F(ContextQueriesTest, WithoutAnIndexThereIsNothing) {
  EXPECT_FALSE(first.test(ContextTest::Overlaps, ContextScope::All, 0, boxAt(0), at(1)));
  EXPECT_TRUE(std::isinf(first.distance(ContextScope::All, kTree, boxAt(0), at(1))));
  EXPECT_EQ(first.count(ContextScope::All, kTree, boxAt(0), at(1)), 0);
}

TEST_F(ContextQueriesTest, TheSecondPassAnswersFromTheIndex) {
  first.add(kTree, boxAt(4), at(0));
  first.add(0, boxAt(0.5), at(1));
  const OccluderIndex index(std::move(first.occluders()));
  const ContextQueries second(false, &index);
  EXPECT_EQ(second.count(ContextScope::All, kTree, boxAt(0), at(2)), 1);
  EXPECT_EQ(second.distance(ContextScope::All, kTree, boxAt(0), at(2)), 3);
  EXPECT_TRUE(second.test(ContextTest::Overlaps, ContextScope::All, 0, boxAt(0), at(2)));
  EXPECT_FALSE(second.test(ContextTest::Overlaps, ContextScope::All, 0, boxAt(0), at(1)))
      << "a shape does not meet itself";
  EXPECT_FALSE(second.test(ContextTest::Overlaps, ContextScope::All, 0, boxAt(20), at(2)));
}

}  // namespace
}  // namespace gable
