// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/archive/archive_files.h"

#include <gtest/gtest.h>

#include <string>

namespace gable {
namespace {

const ArchiveFiles kFiles{{"rules/main.cga", "Lot --> X."},
                          {"assets/\xc3\xa4.txt", std::string(5000, 'a')},
                          {"assets/empty", ""}};

std::string made(ArchiveKind kind, const ArchiveFiles& files = kFiles) {
  Result<std::string> bytes = writeArchive(files, kind);
  return bytes.ok() ? bytes.value() : std::string();
}

std::string codeOf(std::string_view bytes, const ArchiveLimits& limits = {}) {
  const Result<ArchiveFiles> read = readArchive(bytes, "x.rpk", limits);
  return read.ok() ? "" : read.error().code;
}

class BothKinds : public testing::TestWithParam<ArchiveKind> {};
INSTANTIATE_TEST_SUITE_P(Archive, BothKinds,
                         testing::Values(ArchiveKind::SevenZip, ArchiveKind::Zip));

TEST_P(BothKinds, comeBackAsTheyWere) {
  const std::string bytes = made(GetParam());
  EXPECT_LT(bytes.size(), 1000u);
  const Result<ArchiveFiles> read = readArchive(bytes, "x.rpk");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), kFiles);
}

TEST_P(BothKinds, haveTheSameBytesEachTime) { EXPECT_EQ(made(GetParam()), made(GetParam())); }

TEST_P(BothKinds, thatAreBrokenOffAreRefused) {
  const std::string bytes = made(GetParam());
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_EQ(codeOf(std::string_view(bytes).substr(0, length)), "archive-unreadable") << length;
  }
}

TEST_P(BothKinds, withBrokenBytesNeverCrash) {
  const std::string bytes = made(GetParam());
  for (size_t at = 0; at < bytes.size(); ++at) {
    for (const char c : {'\0', '\x7f', '\xff'}) {
      std::string broken = bytes;
      broken[at] = c;
      codeOf(broken);
    }
  }
}

TEST_P(BothKinds, thatLeadOutsideAreRefused) {
  for (const char* path : {"../x.cga", "/etc/passwd", "a/../../b", "C:/x", "a\\..\\..\\b", ".."}) {
    EXPECT_EQ(codeOf(made(GetParam(), {{path, "x"}})), "archive-path") << path;
  }
}

TEST_P(BothKinds, thatAreTooLargeAreRefused) {
  EXPECT_EQ(codeOf(made(GetParam()), {.files = 2}), "archive-too-large");
  EXPECT_EQ(codeOf(made(GetParam()), {.bytes = 4999}), "archive-too-large");
  const std::string bomb = made(GetParam(), {{"zeros", std::string(1 << 20, '\0')}});
  EXPECT_EQ(codeOf(bomb), "");
  EXPECT_EQ(codeOf(bomb, {.ratio = 100, .free = 1 << 16}), "archive-too-large");
}

TEST(Archive, pathsArePlain) {
  const Result<ArchiveFiles> read =
      readArchive(made(ArchiveKind::Zip, {{"./a//b\\c.txt", "x"}}), "x.zip");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), (ArchiveFiles{{"a/b/c.txt", "x"}}));
}

TEST(Archive, otherFilesAreRefused) {
  for (const char* text : {"", "PK", "7z\xbc\xaf\x27\x1c", "Lot --> X."}) {
    EXPECT_EQ(codeOf(text), "archive-unreadable") << text;
  }
}

}  // namespace
}  // namespace gable
