// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

namespace gable {
namespace {

class Files : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "gable-files-XXXXXX";
    folder_ = std::string(mkdtemp(pattern.data())) + "/";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  size_t entries() const {
    size_t n = 0;
    for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(folder_)) ++n;
    return n;
  }
  std::string folder_;
};

TEST_F(Files, whatIsWrittenReadsBack) {
  const std::string path = folder_ + "a.bin";
  const std::string big(3'000'000, 'x');
  {
    FileWriter w(path);
    w.append("head");
    w.append(big);
    w.fill('-', 700'000);
    char* p = w.reserve(3);
    p[0] = 'e', p[1] = 'n', p[2] = 'd';
    w.advance(3);
    w.patch(0, "HEAD", 4);
    w.append("!");
    EXPECT_EQ(w.offset(), 4 + big.size() + 700'000 + 4);
    EXPECT_FALSE(fileExists(path));
    ASSERT_TRUE(w.finish().ok());
  }
  auto back = readFile(path);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(*back, "HEAD" + big + std::string(700'000, '-') + "end!");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, anUnfinishedFileLeavesTheOldOne) {
  const std::string path = folder_ + "a.txt";
  ASSERT_TRUE(writeFile(path, "old").ok());
  { FileWriter(path).append("new"); }
  EXPECT_EQ(readFile(path).value(), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, failuresAreToldByCode) {
  EXPECT_EQ(readFile(folder_ + "none").error().code, "file-missing");
  EXPECT_EQ(readFile(folder_).error().code, "file-unreadable");
  ASSERT_TRUE(writeFile(folder_ + "b", "12345").ok());
  EXPECT_EQ(readFile(folder_ + "b", 4).error().code, "file-too-large");
  EXPECT_EQ(readFile(folder_ + "b", 5).value(), "12345");
  EXPECT_EQ(readFile("/dev/zero", 1000).error().code, "file-too-large");
  EXPECT_EQ(writeFile(folder_ + "no/such/folder", "x").error().code, "file-unwritable");
}

TEST_F(Files, devicesAndLinksAreWrittenThrough) {
  EXPECT_TRUE(writeFile("/dev/null", "x").ok());
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/null"));
  ASSERT_TRUE(writeFile(folder_ + "target", "old").ok());
  ASSERT_EQ(symlink("target", (folder_ + "link").c_str()), 0);
  ASSERT_TRUE(writeFile(folder_ + "link", "new").ok());
  EXPECT_EQ(readFile(folder_ + "target").value(), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ + "link"));
}

TEST(FileNames, areTakenApart) {
  EXPECT_EQ(extensionOf("a/b.c/out.tar.GLB"), "glb");
  EXPECT_EQ(extensionOf("a.b/c"), "");
  EXPECT_EQ(folderOf("a/b/c.x"), "a/b/");
  EXPECT_EQ(folderOf("c.x"), "");
  EXPECT_EQ(fileNameOf("a/b/c.x"), "c.x");
}

}  // namespace
}  // namespace gable
