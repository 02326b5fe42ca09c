// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/split_cache.h"

namespace gable {

SplitBlock SplitCache::at(uint32_t number, const Value* sizes) {
  const BlockCode& block = program_.blocks[number];
  State& state = states_[number];
  const bool fixed = !block.constantSizes.empty();
  const bool fresh = state.items.empty();
  if (fresh) {
    // All or nothing: memory may be refused.
    state.items.reserve(block.items.size());
    for (const BlockItem& item : block.items) {
      SplitItem s;
      s.group = item.group;
      s.repeat = item.repeat;
      s.length = item.length;
      s.slot = item.slot;
      state.items.push_back(s);
    }
  }
  if (fresh || !fixed) {
    const Value* v = fixed ? block.constantSizes.data() : sizes;
    for (SplitItem& s : state.items) {
      if (s.group) continue;
      // Written so that what is no number counts as changed.
      if (!(s.size == v->number) || s.unit != v->unit) state.memo.known = false;
      s.size = v->number;
      s.unit = v->unit;
      ++v;
    }
  }
  return {state.items, block.repeat, &state.memo};
}

}  // namespace gable
