// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/dispose.h"

#include <gtest/gtest.h>

#include <future>
#include <memory>

namespace gable {
namespace {

TEST(DisposeLater, DestroysOnAThreadOfItsOwn) {
  std::promise<std::thread::id> destroyed;
  const auto tell = [&](const int* value) {
    delete value;
    destroyed.set_value(std::this_thread::get_id());
  };
  disposeLater(std::unique_ptr<const int, decltype(tell)>(new int(1), tell));
  EXPECT_NE(destroyed.get_future().get(), std::this_thread::get_id());
}

}  // namespace
}  // namespace gable
