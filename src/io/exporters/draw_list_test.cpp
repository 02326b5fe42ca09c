// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/draw_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/json.h"
#include "io/testing/scenes.h"
#include "material/library.h"

namespace gable {
namespace {

using testing::SceneBuilder;

struct Read {
  JsonValue head;
  std::string blob;
  std::vector<float> floats(const JsonValue& section) const {
    std::vector<float> out(static_cast<size_t>(section.at(1).number(0)));
    std::memcpy(out.data(), blob.data() + static_cast<size_t>(section.at(0).number(0)),
                out.size() * sizeof(float));
    return out;
  }
  std::vector<uint32_t> numbers(const JsonValue& section) const {
    std::vector<uint32_t> out(static_cast<size_t>(section.at(1).number(0)));
    std::memcpy(out.data(), blob.data() + static_cast<size_t>(section.at(0).number(0)),
                out.size() * sizeof(uint32_t));
    return out;
  }
};

Read readBack(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "GBL1");
  uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 4, sizeof size);
  return {parseJson(bytes.substr(8, size)).value(), bytes.substr(8 + size)};
}

// What was added to the builder, as the one initial shape.
const Scene& placed(SceneBuilder& b) {
  b.root("lot", b.prototype("lot"), {});
  return b.scene;
}

// The volume inside of all triangles of a batch, by the signed tetrahedra over its instances.
double volume(const Read& r, const JsonValue& batch) {
  const auto p = r.floats(batch["position"]);
  const auto index = r.numbers(batch["index"]);
  std::vector<float> matrices{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  if (batch.find("matrix")) matrices = r.floats(batch["matrix"]);
  double sum = 0;
  for (size_t m = 0; m < matrices.size(); m += 16) {
    const auto at = [&](uint32_t i) {
      Vec3 out{matrices[m + 12], matrices[m + 13], matrices[m + 14]};
      for (size_t axis = 0; axis < 3; ++axis) {
        out +=
            Vec3{matrices[m + axis * 4], matrices[m + axis * 4 + 1], matrices[m + axis * 4 + 2]} *
            static_cast<double>(p[i * 3 + axis]);
      }
      return out;
    };
    for (size_t i = 0; i < index.size(); i += 3) {
      sum += dot(at(index[i]), cross(at(index[i + 1]), at(index[i + 2]))) / 6;
    }
  }
  return sum;
}

// The coordinates of one are metres, those of the other its own.
TEST(DrawList, whatIsLaidIsALookOfItsOwn) {
  SceneBuilder b;
  Material laid;
  laid.map(TextureLayer::Color).path = "wall.png";
  Material plain = laid;
  laid.shader = std::string(kLaidShader) + "own";
  b.leaf(kUnitBoxUv, Frame{}, {4, 2, 1}, b.material(plain));
  b.leaf(kUnitBoxUv, Frame::moved({9, 0, 0}), {4, 2, 1}, b.material(laid));
  const Read r = readBack(drawList(placed(b)));
  EXPECT_EQ(r.head["looks"].size(), 2u);
}

TEST(DrawList, boxesAreInstancesWhateverTheirColourAndMirroring) {
  SceneBuilder b;
  double expected = 0;
  for (int i = 0; i < 12; ++i) {
    Material m;
    m.color = {i / 12.0, 0.5, 1};
    const Vec3 scale{i % 3 == 1 ? -2.0 : 2.0, 1.0 + i, i % 4 == 2 ? -0.5 : 0.5};
    b.leaf(kUnitBox, testing::turned(i % 2 ? 30.0 * i : 0, {3.0 * i, 1, 2}), scale, b.material(m));
    expected += 2 * (1.0 + i) * 0.5;
  }
  const Read r = readBack(drawList(placed(b)));
  // One batch for those as they are, one for the mirrored.
  EXPECT_EQ(r.head["batches"].size(), 2u);
  EXPECT_EQ(r.head["leaves"].number(0), 12);
  double sum = 0;
  size_t instances = 0;
  for (const JsonValue& batch : r.head["batches"].items()) {
    EXPECT_EQ(r.floats(batch["position"]).size(), 24u * 3);
    instances += r.floats(batch["matrix"]).size() / 16;
    sum += volume(r, batch);
  }
  EXPECT_EQ(instances, 12u);
  EXPECT_NEAR(sum, expected, 1e-3);
}

TEST(DrawList, meshesThatStandOnceAreMerged) {
  SceneBuilder b;
  for (int i = 0; i < 5; ++i) {
    b.leaf(b.mesh(testing::ball(6 + i, 8)), testing::turned(0, {5.0 * i, 0, 0}), {1, 2, 1});
  }
  const Read r = readBack(drawList(placed(b)));
  ASSERT_EQ(r.head["batches"].size(), 1u);
  const JsonValue& batch = r.head["batches"].at(0);
  EXPECT_FALSE(batch.find("matrix"));
  EXPECT_GT(volume(r, batch), 0);
  const auto leaves = r.floats(batch["leaf"]);
  EXPECT_EQ(leaves.front(), 0);
  EXPECT_EQ(leaves.back(), 4);
  for (const float n : r.floats(batch["normal"])) EXPECT_TRUE(std::isfinite(n));
}

TEST(DrawList, flatLeavesHaveFiniteMatrices) {
  SceneBuilder b;
  b.leaf(kUnitQuadXy, {}, {2, 3, 0});
  b.leaf(kUnitQuadXz, {}, {2, 0, 3});
  const Read r = readBack(drawList(placed(b)));
  for (const JsonValue& batch : r.head["batches"].items()) {
    const auto m = r.floats(batch["matrix"]);
    for (size_t column = 0; column < 3; ++column) {
      const Vec3 v{m[column * 4], m[column * 4 + 1], m[column * 4 + 2]};
      EXPECT_GT(length(v), 0);
    }
  }
}

TEST(DrawList, theBytesAreTheSameForAnyNumberOfJobs) {
  SceneBuilder b;
  for (int i = 0; i < 30; ++i) {
    Material m;
    m.color = {i / 30.0, 0.5, 1};
    m.roughness = 0.1 * (i % 4);
    if (i % 5 == 0) m.maps[static_cast<size_t>(TextureLayer::Color)].path = "wall.png";
    const Frame at = testing::turned(10.0 * i, {3.0 * i, 1, 2});
    const uint32_t material = b.material(m);
    b.leaf(i % 3 ? kUnitBox : b.mesh(testing::ball(6 + i, 8)), at, {i % 2 ? -1.0 : 1.0, 1, 2},
           material);
  }
  const uint32_t tower = b.prototype("tower");
  for (int i = 0; i < 4; ++i) b.instance(tower, testing::turned(5.0 * i, {0, 0, 9.0 * i}));
  const Scene& scene = placed(b);
  const std::string one = drawList(scene, 1);
  EXPECT_EQ(readBack(one).head["leaves"].number(0), 120);
  for (const unsigned jobs : {2u, 3u, 7u, 200u}) EXPECT_EQ(drawList(scene, jobs), one) << jobs;
}

// Doubling forty times: 2^40 instances, once with a leaf at the end and once with none.
TEST(DrawList, endsWhereInstancesOutgrowTime) {
  for (const uint32_t leaves : {0u, 1u}) {
    Scene s;
    Leaf leaf;
    leaf.frame = Frame::moved({1, 0, 0});
    if (leaves) s.leaves.push_back(leaf);
    for (uint32_t level = 0; level < 40; ++level) {
      Prototype p;
      p.leafCount = level == 0 ? leaves : 0;
      p.firstInstance = static_cast<uint32_t>(s.instances.size());
      p.firstLeaf = level == 0 ? 0 : leaves;
      p.instanceCount = level == 0 ? 0 : 2;
      for (uint32_t i = 0; i < p.instanceCount; ++i) s.instances.push_back({{}, level - 1, 0});
      s.prototypes.push_back(p);
    }
    s.roots = {{0, {{}, 39, 0}}};
    const std::string bytes = drawList(s);
    uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 4, sizeof size);
    const auto head = parseJson(bytes.substr(8, size)).value();
    EXPECT_EQ(head["leaves"].number(-1), leaves ? kMostLeaves : 0);
    EXPECT_EQ(head["truncated"].boolean(false), leaves == 1);
  }
}

}  // namespace
}  // namespace gable
