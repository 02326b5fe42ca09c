// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/spare_memory.h"

#include <utility>

#include "runtime/derive.h"

namespace gable {

namespace {

template <class T>
size_t bytesOf(const std::vector<T>& block) {
  return block.capacity() * sizeof(T);
}

size_t bytesOf(const KeyNumbers& block) { return block.bytes(); }

template <class Block>
void keepLarger(Block& kept, Block& other) {
  if (bytesOf(other) > bytesOf(kept)) std::swap(kept, other);
}

}  // namespace

// What is not kept is freed when the lock is open again.
void SpareMemory::keep(SpareBlocks blocks) {
  const std::lock_guard lock(mutex_);
  keepLarger(blocks_.leaves, blocks.leaves);
  keepLarger(blocks_.instances, blocks.instances);
  keepLarger(blocks_.prototypes, blocks.prototypes);
  keepLarger(blocks_.notes, blocks.notes);
  keepLarger(blocks_.prototypeNumbers, blocks.prototypeNumbers);
  keepLarger(blocks_.bare, blocks.bare);
  if (!blocks.workers.empty()) std::swap(blocks_.workers, blocks.workers);
}

SpareBlocks SpareMemory::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(blocks_, {});
}

SpareBlocks blocksOf(DeriveResult& result) {
  SpareBlocks out;
  out.leaves.swap(result.scene.leaves);
  out.instances.swap(result.scene.instances);
  out.prototypes.swap(result.scene.prototypes);
  if (result.recall && result.recall.use_count() == 1) {
    out.notes.swap(result.recall->prototypes);
    std::swap(out.prototypeNumbers, result.recall->prototypeNumbers);
  }
  return out;
}

}  // namespace gable
