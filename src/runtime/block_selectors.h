// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// BlockSelectors: the selectors of a block with the values that its rule has computed for them.
#pragma once

#include <span>
#include <vector>

#include "program/program.h"
#include "shape/op_call.h"

namespace gable {

class BlockSelectors {
 public:
  /// `values`: those of the block. Good until the next call.
  std::span<const SelectorItem> of(const BlockCode& block, const Value* values);

 private:
  std::vector<SelectorItem> items_;
  std::vector<SelectorTerm> terms_;
};

}  // namespace gable
