// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/gltf_compression.h"

#include <gtest/gtest.h>

#include "base/child_process.h"
#include "base/hash.h"
#include "base/random.h"
#include "io/importers/base64.h"

namespace gable {
namespace {

// Two triangles with positions and texture coordinates.
constexpr const char* kDraco =
    "data:;base64,"
    "RFJBQ08CAgEBAAAABAIBAgAAAR//ARH/AREC/wAAAAAAAQAJAwAAAgEDCQIAAQIBAQEADwMBIC8BIAMA8INYVQMA"
    "AIBVBQAAAAAAAAAA/z8AAAAAAAAAAAAAAAAAAAAAQEAOAQEBAAMDASABIAMA8IOmAAAAAAD/DwAAAAAAAAAAAAAAAIA/"
    "DA==";

std::string dracoBytes() {
  std::string mime, bytes;
  EXPECT_TRUE(readDataUri(kDraco, mime, bytes));
  return bytes;
}

class GltfCompression : public ::testing::Test {
 protected:
  void SetUp() override {
    const PackedBuffer one{PackedBuffer::Draco, 0, 0, PackedBuffer::None, "x"};
    if (!unpackBuffers({one}, "a.glb").ok())
      GTEST_SKIP() << "gable-convert is not built with Draco";
  }
};

TEST_F(GltfCompression, dracoGivesTrianglesAndNumbers) {
  const std::string bytes = dracoBytes();
  const auto made =
      unpackBuffers({{PackedBuffer::Draco, 0, 0, PackedBuffer::None, bytes}}, "a.glb");
  ASSERT_TRUE(made.ok());
  DracoMesh mesh;
  ASSERT_TRUE(readDracoMesh(made.value().at(0), mesh));
  EXPECT_EQ(mesh.indices.size(), 6u);
  ASSERT_EQ(mesh.attributes.size(), 2u);
  EXPECT_EQ(mesh.attributes.at(0).components, 3u);
  EXPECT_EQ(mesh.attributes.at(0).numbers.size(), 12u);
  EXPECT_EQ(mesh.attributes.at(1).components, 2u);
}

TEST_F(GltfCompression, brokenBuffersAreEmptyAndLeaveTheOthers) {
  const std::string good = dracoBytes();
  constexpr uint64_t kTries = 40;
  std::vector<std::string> changed;
  for (uint64_t seed = 0; seed < kTries; ++seed) {
    changed.push_back(good.substr(0, seed % 4 == 0 ? seed : good.size()));
    if (changed.back().empty()) changed.back() = "x";
    const uint64_t bits = randomBits(seed);
    changed.back()[bits % changed.back().size()] = static_cast<char>(bits >> 32);
  }
  std::vector<PackedBuffer> jobs;
  for (const std::string& bytes : changed) {
    jobs.push_back({PackedBuffer::Draco, 0, 0, PackedBuffer::None, bytes});
    jobs.push_back({PackedBuffer::Vertices, 0xffffffff, 256, PackedBuffer::Quaternion, bytes});
    jobs.push_back({PackedBuffer::Triangles, 7, 3, PackedBuffer::None, bytes});
  }
  jobs.push_back({PackedBuffer::Draco, 0, 0, PackedBuffer::None, good});
  const auto made = unpackBuffers(jobs, "a.glb");
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_EQ(made.value().size(), jobs.size());
  EXPECT_TRUE(made.value()[0].empty());
  DracoMesh mesh;
  EXPECT_TRUE(readDracoMesh(made.value().back(), mesh));
}

TEST(DracoMesh, whatIsCutOffIsRefused) {
  for (const char* text : {"", "abc", "\xff\xff\xff\xff\xff\xff\xff\xff"}) {
    DracoMesh mesh;
    EXPECT_FALSE(readDracoMesh(text, mesh));
  }
}

}  // namespace
}  // namespace gable
