// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SplitCache: the items of the split blocks of a program with the sizes of the last time. What was
// divided by the same sizes is known as long as they stay the same.
#pragma once

#include <cstdint>
#include <vector>

#include "program/program.h"
#include "shape/op_call.h"

namespace gable {

class SplitCache {
 public:
  /// Must outlive the cache.
  explicit SplitCache(const Program& program) : program_(program), states_(program.blocks.size()) {}

  /// The block, with these sizes where the program has none. Good until the next call for it.
  SplitBlock at(uint32_t block, const Value* sizes);
  /// What is known of the last division by the block.
  const SplitMemo& memo(uint32_t block) const { return states_[block].memo; }

 private:
  struct State {
    std::vector<SplitItem> items;
    SplitMemo memo;
  };
  const Program& program_;
  std::vector<State> states_;
};

}  // namespace gable
