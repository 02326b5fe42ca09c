// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/files.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
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
  ASSERT_TRUE(writeFile(folder_ + "town.cga", "").ok());
  EXPECT_EQ(readFile(folder_ + "twon.cga").error().hint, "did you mean 'town.cga'?");
  EXPECT_EQ(readFile(folder_ + "no/town.cga").error().hint, "there is no such folder");
  ASSERT_TRUE(writeFile(folder_ + "b", "12345").ok());
  EXPECT_EQ(readFile(folder_ + "b", 4).error().code, "file-too-large");
  EXPECT_EQ(readFile(folder_ + "b", 5).value(), "12345");
  EXPECT_EQ(writeFile(folder_ + "no/such/folder", "x").error().code, "file-unwritable");
}

// Each of them would block, flood or act when it is opened.
TEST_F(Files, onlyRegularFilesAreOpened) {
  const std::string pipe = folder_ + "pipe", socket = folder_ + "socket", link = folder_ + "link";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ASSERT_EQ(symlink("pipe", link.c_str()), 0);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(socket.size(), sizeof address.sun_path);
  socket.copy(address.sun_path, socket.size());
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  for (const std::string& path : {pipe, link, socket, std::string("/dev/zero")}) {
    EXPECT_EQ(readFile(path).error().code, "file-unreadable") << path;
    EXPECT_FALSE(fileExists(path)) << path;
  }
  for (const std::string& path : {pipe, link, socket, folder_}) {
    EXPECT_EQ(writeFile(path, "x").error().code, "file-unwritable") << path;
  }
  close(listener);
}

TEST_F(Files, aFullDiskLosesNothing) {
  const std::string path = folder_ + "a.txt";
  ASSERT_TRUE(writeFile(path, "old").ok());
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  // A limit on the size of files fails as a full disk does, without the signal.
  const auto old = signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto failed = writeFile(path, std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, old);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().code, "file-unwritable");
  EXPECT_EQ(readFile(path).value(), "old");
  EXPECT_EQ(entries(), 1u);
  ASSERT_TRUE(writeFile(path, "new").ok());
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
  EXPECT_EQ(writeFile("/dev/full", "x").error().code, "file-unwritable");
}

// A child process that writes half a file and ends as `end` does.
void leaveHalf(const std::string& path, void (*end)()) {
  const pid_t child = fork();
  if (child == 0) {
    FileWriter half(path);
    half.append(std::string(1 << 20, 'x'));
    end();
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
}

TEST_F(Files, killedProcessesLeaveNothingForLong) {
  const std::string path = folder_ + "a.txt";
  leaveHalf(path, [] { raise(SIGKILL); });
  EXPECT_EQ(entries(), 1u);
  {
    // Another path's rest, a living writer's file and other names stay.
    const FileWriter other(folder_ + "a");
    EXPECT_EQ(entries(), 2u);
    const FileWriter living(folder_ + "b");
    ASSERT_TRUE(writeFile(folder_ + "a.txt.part12-x", "mine").ok());
    ASSERT_TRUE(writeFile(path, "whole").ok());
    EXPECT_EQ(entries(), 4u);
    ASSERT_TRUE(writeFile(folder_ + "b", "whole").ok());
    EXPECT_EQ(entries(), 5u);
  }
  EXPECT_EQ(entries(), 3u);
}

TEST_F(Files, aSignalHandlerRemovesWhatIsUnfinished) {
  leaveHalf(folder_ + "a.txt", [] {
    removeUnfinishedFiles();
    _exit(0);
  });
  EXPECT_EQ(entries(), 0u);
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
