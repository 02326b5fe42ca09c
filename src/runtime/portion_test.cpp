// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/portion.h"

#include <gtest/gtest.h>

#include <thread>

namespace gable {
namespace {

TEST(Portions, goToWhoeverWaits) {
  PortionQueue queue(1);
  EXPECT_FALSE(queue.isHungry());
  std::unique_ptr<Portion> taken;
  std::thread waiter([&] {
    taken = queue.take();
    queue.done();
    EXPECT_EQ(queue.take(), nullptr);
  });
  while (!queue.isHungry()) std::this_thread::yield();
  auto portion = std::make_unique<Portion>();
  portion->rule = 7;
  EXPECT_EQ(queue.push(std::move(portion)), 0u);
  queue.done();
  waiter.join();
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->rule, 7u);
  EXPECT_EQ(taken->unit, &queue.units()[0]);
}

TEST(Portions, waitingOnesAreNoReasonToOfferMore) {
  PortionQueue queue(1);
  queue.push(std::make_unique<Portion>());
  EXPECT_FALSE(queue.isHungry());
  EXPECT_TRUE(queue.take());
  EXPECT_FALSE(queue.isHungry());
}

TEST(Portions, segmentsComeInPathOrder) {
  std::deque<OutputUnit> portions(3);
  OutputUnit root;
  root.number = 100;
  for (uint32_t i = 0; i < 3; ++i) portions[i].number = i;
  root.holes = {{1, {}, 0}, {0, {}, 0}};
  portions[1].holes = {{2, {}, 0}};
  std::string order;
  forEachSegment(root, portions, [&](const OutputUnit& u, size_t hole) {
    order += std::to_string(u.number) + "." + std::to_string(hole) + " ";
  });
  EXPECT_EQ(order, "100.0 1.0 2.0 1.1 100.1 0.0 100.2 ");
}

}  // namespace
}  // namespace gable
