// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "scene/vertex_buffer.h"

#include <gtest/gtest.h>

#include <cstring>

namespace gable {
namespace {

Leaf box(const Vec3& at, const Vec3& size) {
  Leaf leaf;
  leaf.frame.origin = at;
  leaf.scale = size;
  return leaf;
}

void expectSame(const VertexBuffer& a, const VertexBuffer& b) {
  ASSERT_EQ(a.vertexCount(), b.vertexCount());
  ASSERT_EQ(a.indexCount(), b.indexCount());
  EXPECT_EQ(0, std::memcmp(a.vertices(), b.vertices(), a.vertexCount() * sizeof(BufferVertex)));
  EXPECT_EQ(0, std::memcmp(a.indices(), b.indices(), a.indexCount() * sizeof(uint32_t)));
}

// Boxes of a batch, and the same boxes one by one.
void expectBatchIsOneByOne(const Frame& axes) {
  std::vector<Leaf> boxes{box({1, 2, 3}, {4, 5, 6}), box({0.1, 0, 0}, {1, 1, 1}),
                          box({0, 0, 0}, {-1, 2, 3}), box({7, 0, 1e6}, {1e-9, 2, 0}),
                          box({1, 1, 1}, {2, 3, 4})};
  boxes[4].frame = Frame::of({1, 1, 1}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0});
  const Vec3 origin{10, 20, 30};
  VertexBuffer together, single;
  // A batch goes behind what is there.
  appendBox(axes, {}, {1, 1, 1}, together);
  appendBox(axes, {}, {1, 1, 1}, single);
  appendBoxes(axes, origin, boxes, together);
  Frame around = axes;
  around.origin = origin;
  for (const Leaf& leaf : boxes) {
    const Frame world = around * leaf.frame;
    appendBox(world, world.origin, leaf.scale, single);
  }
  expectSame(together, single);
}

TEST(VertexBuffer, aBatchOfBoxesIsTheBoxesOneByOne) {
  expectBatchIsOneByOne(Frame{});
  expectBatchIsOneByOne(Frame::of({}, {0.6, 0, -0.8}, {0, 1, 0}, {0.8, 0, 0.6}));
}

TEST(VertexBuffer, aBoxHas24VerticesWithNormalsOutwards) {
  for (const Vec3& size : {Vec3{2, 3, 4}, Vec3{-2, 3, 4}, Vec3{2, -3, -4}, Vec3{-2, -3, -4}}) {
    VertexBuffer out;
    appendBox(Frame{}, {}, size, out);
    ASSERT_EQ(24u, out.vertexCount());
    ASSERT_EQ(36u, out.indexCount());
    const Vec3 middle = size * 0.5;
    for (size_t t = 0; t < 36; t += 3) {
      const auto at = [&](size_t k) {
        const float* p = out.vertices()[out.indices()[t + k]].position;
        return Vec3{p[0], p[1], p[2]};
      };
      const Vec3 n = cross(at(1) - at(0), at(2) - at(0));
      const float* stored = out.vertices()[out.indices()[t]].normal;
      EXPECT_GT(dot(n, at(0) - middle), 0);
      EXPECT_GT(dot(n, Vec3{stored[0], stored[1], stored[2]}), 0);
    }
  }
}

}  // namespace
}  // namespace gable
