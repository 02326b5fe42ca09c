// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/gathers.h"

#include <gtest/gtest.h>

#include "geom/mesh/mesh.h"

namespace gable {
namespace {

class GathersTest : public testing::Test {
 protected:
  GathersTest() { worlds.begin(Frame::moved({100, 0, 0})); }

  // A box whose frame is given as it is stored, the number its size.
  void leaf(double size) {
    Leaf& l = output.openLeaves.emplace_back();
    l.scale = {size, size, size};
  }
  std::vector<double> sizes() const {
    std::vector<double> out;
    for (const Leaf& l : output.openLeaves) out.push_back(l.scale.x);
    return out;
  }

  Program program;
  DeriveOptions options;
  Output output;
  Tracer tracer{program, options};
  Worlds worlds;
  Gathers gathers{output, tracer, worlds};
};

TEST_F(GathersTest, GivesTheLeavesMadeSince) {
  leaf(1);
  gathers.begin({});
  leaf(2);
  leaf(3);
  const Gathers::Ended ended = gathers.end();
  ASSERT_EQ(ended.leaves.size(), 2u);
  EXPECT_EQ(ended.leaves[0].shape.size.x, 2);
  EXPECT_EQ(ended.leaves[1].shape.geometry.kind, GeometryKind::Box);
  gathers.putBack(ended, true);
  EXPECT_EQ(sizes(), (std::vector<double>{1, 2, 3}));
}

TEST_F(GathersTest, WhatIsTakenLeavesTheResult) {
  gathers.begin({});
  for (const double size : {1, 2, 3}) leaf(size);
  Gathers::Ended ended = gathers.end();
  ended.leaves[1].taken = true;
  gathers.putBack(ended, true);
  EXPECT_EQ(sizes(), (std::vector<double>{1, 3}));
}

TEST_F(GathersTest, AnOperationThatFailsLeavesAll) {
  gathers.begin({});
  for (const double size : {1, 2}) leaf(size);
  Gathers::Ended ended = gathers.end();
  ended.leaves[0].taken = true;
  gathers.putBack(ended, false);
  EXPECT_EQ(sizes(), (std::vector<double>{1, 2}));
}

TEST_F(GathersTest, ALeafMayGetAnotherMesh) {
  gathers.begin({});
  leaf(1);
  output.openLeaves[0].name = 7;
  Gathers::Ended ended = gathers.end();
  Shape& s = ended.leaves[0].shape;
  s.geometry.kind = GeometryKind::Mesh;
  s.geometry.mesh = makeRef<Mesh>();
  s.geometry.refSize = {2, 2, 2};
  s.size = {6, 6, 6};
  gathers.putBack(ended, true);
  ASSERT_EQ(output.openLeaves.size(), 1u);
  EXPECT_EQ(output.openLeaves[0].mesh, kFirstMesh);
  EXPECT_EQ(output.openLeaves[0].scale.x, 3);
  EXPECT_EQ(output.openLeaves[0].name, 7u);
}

TEST_F(GathersTest, LeavesGoWhereTheyLieOutside) {
  Gathers::Call call;
  call.flat = true;
  gathers.begin(call);
  leaf(1);
  gathers.putBack(gathers.end(), true);
  EXPECT_EQ(output.openLeaves[0].frame.origin.x, 100);
  // With sharing they stay in the frame of the prototype around.
  gathers.begin({});
  leaf(2);
  gathers.putBack(gathers.end(), true);
  EXPECT_EQ(output.openLeaves[1].frame.origin.x, 0);
}

TEST_F(GathersTest, TheInnermostIsDueFirst) {
  EXPECT_FALSE(gathers.isDue(1));
  Gathers::Call outer, inner;
  outer.activation = 0;
  inner.activation = 4;
  gathers.begin(outer);
  EXPECT_TRUE(gathers.isDue(1));
  gathers.begin(inner);
  EXPECT_TRUE(gathers.isDue(5));
  EXPECT_FALSE(gathers.isDue(1));
  EXPECT_EQ(gathers.outermost().activation, 0u);
  gathers.end();
  EXPECT_TRUE(gathers.isDue(1));
}

TEST_F(GathersTest, WhatALimitEndsIsDropped) {
  leaf(1);
  gathers.begin({});
  leaf(2);
  gathers.begin({});
  leaf(3);
  gathers.drop();
  EXPECT_EQ(sizes(), (std::vector<double>{1, 2}));
  gathers.drop();
  EXPECT_EQ(sizes(), (std::vector<double>{1}));
  EXPECT_FALSE(gathers.anyOpen());
}

}  // namespace
}  // namespace gable
