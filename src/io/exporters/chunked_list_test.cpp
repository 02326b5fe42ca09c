// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/chunked_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "base/json.h"
#include "io/testing/scenes.h"

namespace gable {
namespace {

using testing::SceneBuilder;

constexpr uint32_t kNew = 0xffffffff;

struct Head {
  JsonValue json;
  std::vector<uint32_t> kept;
  uint64_t news() const {
    return static_cast<uint64_t>(std::count(kept.begin(), kept.end(), kNew));
  }
};

Head headOf(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "GBU1");
  uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 4, sizeof size);
  Head out{parseJson(bytes.substr(8, size)).value(), {}};
  const JsonValue& chunks = out.json["chunks"];
  out.kept.resize(static_cast<size_t>(chunks.at(1).number(0)));
  std::memcpy(out.kept.data(),
              bytes.data() + 8 + size + static_cast<size_t>(chunks.at(0).number(0)),
              out.kept.size() * sizeof(uint32_t));
  return out;
}

/// Boxes and balls in a row, some of them in towers; `changed` has another size, `left` is left
/// out.
Scene street(int changed = -1, int left = -1) {
  SceneBuilder b;
  const uint32_t ball = b.mesh(testing::ball(6, 8));
  std::vector<uint32_t> materials;
  for (int i = 0; i < 21; ++i) {
    Material m;
    m.color = {i % 7 / 7.0, 0.5, 1};
    if (i % 3 == 0) m.roughness = 0.2;
    materials.push_back(b.material(m));
  }
  for (int i = 0; i < 5; ++i) b.leaf(kUnitBox, Frame::moved({0, 3.0 * i, 9}), {1, 1, 1});
  const uint32_t tower = b.prototype("tower");
  std::vector<Frame> towers;
  for (int i = 0; i < 24000; ++i) {
    if (i == left) continue;
    const Frame at = Frame::moved({3.0 * i, 0, 0});
    if (i % 50 == 7) towers.push_back(at);
    const uint32_t material = materials[static_cast<size_t>(i % 21)];
    b.leaf(i % 4 ? kUnitBox : ball, at, {i == changed ? 2.0 : 1.0, 1, 2}, material);
  }
  for (const Frame& at : towers) b.instance(tower, at);
  b.root("lot", b.prototype("lot"), {});
  return b.scene;
}

TEST(ChunkedList, smallScenesAreSentWhole) {
  SceneBuilder b;
  b.leaf(kUnitBox, Frame{}, {1, 1, 1});
  b.root("lot", b.prototype("lot"), {});
  const ChunkedList list = chunkedList(b.scene, nullptr);
  EXPECT_EQ(list.bytes.substr(0, 4), "GBL1");
  EXPECT_EQ(list.drawn, nullptr);
}

TEST(ChunkedList, whatIsKnownIsNotSentAgain) {
  const Scene scene = street();
  const ChunkedList first = chunkedList(scene, nullptr);
  const Head all = headOf(first.bytes);
  EXPECT_GT(all.kept.size(), 20u);
  EXPECT_EQ(all.news(), all.kept.size());
  const ChunkedList again = chunkedList(street(), first.drawn.get());
  EXPECT_EQ(headOf(again.bytes).news(), 0u);
  EXPECT_LT(again.bytes.size() * 50, first.bytes.size());
  EXPECT_EQ(again.drawn->keys, first.drawn->keys);
  EXPECT_EQ(again.drawn->used, first.drawn->used);
}

TEST(ChunkedList, anEditSendsTheChunksAroundIt) {
  const ChunkedList first = chunkedList(street(), nullptr);
  const ChunkedList changed = chunkedList(street(9000), first.drawn.get());
  EXPECT_GE(headOf(changed.bytes).news(), 1u);
  EXPECT_LE(headOf(changed.bytes).news(), 2u);
  const ChunkedList shorter = chunkedList(street(9000, 12000), changed.drawn.get());
  EXPECT_GE(headOf(shorter.bytes).news(), 1u);
  EXPECT_LE(headOf(shorter.bytes).news(), 3u);
  // Undone: the list before is not the one at the beginning.
  const ChunkedList undone = chunkedList(street(), shorter.drawn.get());
  EXPECT_LE(headOf(undone.bytes).news(), 4u);
  EXPECT_EQ(undone.drawn->keys, first.drawn->keys);
}

TEST(ChunkedList, batchesAreNumberedAlikeWithAndWithoutOneBefore) {
  const ChunkedList first = chunkedList(street(), nullptr);
  const Scene scene = street(5, 6);
  const ChunkedList update = chunkedList(scene, first.drawn.get());
  const ChunkedList whole = chunkedList(scene, nullptr);
  ASSERT_EQ(update.drawn->batches.size(), whole.drawn->batches.size());
  for (size_t i = 0; i < whole.drawn->batches.size(); ++i) {
    EXPECT_EQ(update.drawn->batches[i].key, whole.drawn->batches[i].key);
  }
  EXPECT_EQ(update.drawn->used, whole.drawn->used);
  EXPECT_EQ(update.drawn->usedEnd, whole.drawn->usedEnd);
}

TEST(ChunkedList, theBytesAreTheSameForAnyNumberOfJobs) {
  const ChunkedList first = chunkedList(street(), nullptr, 1);
  for (const unsigned jobs : {2u, 3u, 7u}) {
    EXPECT_EQ(chunkedList(street(), nullptr, jobs).bytes, first.bytes) << jobs;
    EXPECT_EQ(chunkedList(street(99), first.drawn.get(), jobs).bytes,
              chunkedList(street(99), first.drawn.get(), 1).bytes)
        << jobs;
  }
}

}  // namespace
}  // namespace gable
