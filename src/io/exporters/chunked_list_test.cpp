// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/chunked_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/text.h"
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
  EXPECT_EQ(bytes.substr(0, 4), "GBU2");
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

/// Reads what lies behind each other.
class Reader {
 public:
  Reader(const std::string& bytes, size_t at) : bytes_(bytes), at_(at) {}
  uint32_t number() {
    uint32_t out = 0;
    std::memcpy(&out, bytes_.data() + at_, sizeof out);
    at_ += sizeof out;
    return out;
  }
  /// Of so many values of four bytes.
  std::string words(size_t count) {
    at_ += count * 4;
    return bytes_.substr(at_ - count * 4, count * 4);
  }

 private:
  const std::string& bytes_;
  size_t at_;
};

/// What a page holds after the updates that it has applied, as docs/dev/studio-protocol.md tells.
class Page {
 public:
  struct Batch {
    double roughness = 0;
    /// What instances have in common; empty for merged triangles.
    std::string geometry;
    bool operator==(const Batch&) const = default;
  };
  struct Chunk {
    uint32_t leaves = 0;
    std::vector<std::pair<uint32_t, std::string>> pieces;
    bool operator==(const Chunk&) const = default;
  };
  std::vector<Batch> batches;
  std::vector<Chunk> chunks;
  bool operator==(const Page&) const = default;

  void apply(const std::string& bytes) {
    const Head head = headOf(bytes);
    const size_t begin = 8 + Reader(bytes, 4).number();
    const Page before = std::move(*this);
    *this = {};
    std::map<uint32_t, uint32_t> numbers;
    for (const JsonValue& batch : head.json["batches"].items()) {
      const auto kept = static_cast<uint32_t>(batch["kept"].number(kNew));
      if (kept != kNew) numbers[kept] = static_cast<uint32_t>(batches.size());
      Batch& made = batches.emplace_back();
      const auto look = static_cast<size_t>(batch["look"].number(0));
      made.roughness = head.json["looks"].at(look)["roughness"].number(0);
      if (kept != kNew) made.geometry = before.batches.at(kept).geometry;
      for (const char* name : {"position", "normal", "index"}) {
        if (!batch.find(name)) continue;
        const JsonValue& section = batch[name];
        made.geometry += Reader(bytes, begin + static_cast<size_t>(section.at(0).number(0)))
                             .words(static_cast<size_t>(section.at(1).number(0)));
      }
    }
    const size_t at = begin + static_cast<size_t>(head.json["chunks"].at(0).number(0));
    Reader leaves(bytes, at + head.kept.size() * 4);
    Reader news(bytes, at + head.kept.size() * 8);
    for (const uint32_t kept : head.kept) {
      Chunk& chunk = chunks.emplace_back();
      if (kept == kNew) {
        for (uint32_t pieces = news.number(); pieces > 0; --pieces)
          chunk.pieces.push_back(piece(news));
      } else {
        chunk = before.chunks.at(kept);
        for (auto& [batch, content] : chunk.pieces) batch = numbers.at(batch);
      }
      chunk.leaves = leaves.number();
    }
  }

 private:
  std::pair<uint32_t, std::string> piece(Reader& from) const {
    const uint32_t batch = from.number();
    // Of an instance: its matrix, colour and leaf.
    if (!batches.at(batch).geometry.empty()) return {batch, from.words(from.number() * size_t{18})};
    const uint32_t vertices = from.number(), corners = from.number(), runs = from.number();
    const uint32_t normals = from.number();
    // Numbers of vertices have 16 bits.
    EXPECT_LE(vertices, 1u << 16);
    const size_t narrow = (vertices + size_t{1}) / 2 + (corners + size_t{1}) / 2;
    return {batch, from.words((vertices + normals) * size_t{3} + runs * size_t{4} + narrow)};
  }
};

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
  EXPECT_EQ(joined(list.bytes).substr(0, 4), "GBL1");
  EXPECT_EQ(list.drawn, nullptr);
}

TEST(ChunkedList, whatIsKnownIsNotSentAgain) {
  const Scene scene = street();
  const ChunkedList first = chunkedList(scene, nullptr);
  const Head all = headOf(joined(first.bytes));
  EXPECT_GT(all.kept.size(), 20u);
  EXPECT_EQ(all.news(), all.kept.size());
  const ChunkedList again = chunkedList(street(), first.drawn.get());
  EXPECT_EQ(headOf(joined(again.bytes)).news(), 0u);
  EXPECT_LT(joined(again.bytes).size() * 50, joined(first.bytes).size());
  EXPECT_EQ(again.drawn->keys, first.drawn->keys);
  EXPECT_EQ(again.drawn->used, first.drawn->used);
}

TEST(ChunkedList, anEditSendsTheChunksAroundIt) {
  const ChunkedList first = chunkedList(street(), nullptr);
  const ChunkedList changed = chunkedList(street(9000), first.drawn.get());
  EXPECT_GE(headOf(joined(changed.bytes)).news(), 1u);
  EXPECT_LE(headOf(joined(changed.bytes)).news(), 2u);
  const ChunkedList shorter = chunkedList(street(9000, 12000), changed.drawn.get());
  EXPECT_GE(headOf(joined(shorter.bytes)).news(), 1u);
  EXPECT_LE(headOf(joined(shorter.bytes)).news(), 3u);
  // Undone: the list before is not the one at the beginning.
  const ChunkedList undone = chunkedList(street(), shorter.drawn.get());
  EXPECT_LE(headOf(joined(undone.bytes)).news(), 4u);
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

TEST(ChunkedList, aSeriesOfEditsLeavesWhatAFreshModelGives) {
  Page page;
  std::shared_ptr<const DrawnChunks> held;
  for (const auto& [changed, left] :
       {std::pair{-1, -1}, {9000, -1}, {9000, 12000}, {3, 12000}, {23999, 7}, {-1, 0}, {-1, -1}}) {
    const Scene scene = street(changed, left);
    const ChunkedList update = chunkedList(scene, held.get());
    page.apply(joined(update.bytes));
    held = update.drawn;
    Page fresh;
    fresh.apply(joined(chunkedList(scene, nullptr).bytes));
    EXPECT_GT(fresh.chunks.size(), 20u);
    EXPECT_TRUE(page == fresh) << changed << ' ' << left;
  }
}

TEST(ChunkedList, theBytesAreTheSameForAnyNumberOfJobs) {
  const ChunkedList first = chunkedList(street(), nullptr, 1);
  for (const unsigned jobs : {2u, 3u, 7u}) {
    EXPECT_EQ(joined(chunkedList(street(), nullptr, jobs).bytes), joined(first.bytes)) << jobs;
    EXPECT_EQ(joined(chunkedList(street(99), first.drawn.get(), jobs).bytes),
              joined(chunkedList(street(99), first.drawn.get(), 1).bytes))
        << jobs;
  }
}

TEST(ChunkedList, thePiecesOfAnotherAreUsedAgain) {
  const std::string expected = joined(chunkedList(street(), nullptr, 2).bytes);
  std::vector<std::string> room{"small", std::string(64 << 20, 'x')};
  const char* const large = room[1].data();
  const ChunkedList again = chunkedList(street(), nullptr, 2, std::move(room));
  EXPECT_EQ(joined(again.bytes), expected);
  EXPECT_TRUE(std::any_of(again.bytes.begin(), again.bytes.end(),
                          [&](const std::string& piece) { return piece.data() == large; }));
}

}  // namespace
}  // namespace gable
