// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/shared_pictures.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace gable {
namespace {

TEST(SharedPictures, drawsEachOnceWithoutHelp) {
  SharedPictures shared;
  std::vector<int> drawn(5);
  shared.drawAll(5, [&](uint32_t k) { ++drawn[k]; });
  EXPECT_EQ(drawn, std::vector<int>(5, 1));
}

TEST(SharedPictures, whoHasNothingLeftHelps) {
  SharedPictures shared;
  std::vector<int> drawn(2);
  std::atomic<int> begun{0};
  auto coming = std::make_unique<SharedPictures::Coming>(shared);
  std::thread helper([&] { shared.help(); });
  // Each waits for the other, so two threads draw or the test does not end.
  shared.drawAll(2, [&](uint32_t k) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
    ++drawn[k];
  });
  EXPECT_EQ(drawn, std::vector<int>(2, 1));
  coming.reset();
  helper.join();
}

TEST(SharedPictures, helpEndsWhereNothingIsComing) {
  SharedPictures shared;
  shared.help();
}

TEST(SharedPictures, aFailureHereLeavesNobodyBehind) {
  SharedPictures shared;
  {
    const SharedPictures::Coming coming(shared);
    EXPECT_THROW(shared.drawAll(3, [](uint32_t) { throw std::runtime_error("no"); }),
                 std::runtime_error);
  }
  shared.help();
}

}  // namespace
}  // namespace gable
