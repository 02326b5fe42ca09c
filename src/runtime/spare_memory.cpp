// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/spare_memory.h"

#include <utility>

#include "base/memory.h"
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

// merge() asks for room for all that there may be, which is up to twice what there is then; what
// nobody touches costs nothing.
constexpr size_t kTimesAsked = 2;

// A list with pages for so many, and some more.
template <class T>
std::vector<T> ready(size_t count) {
  std::vector<T> out = withRoom(std::vector<T>(), kTimesAsked * count);
  populate(out.data(), (count + count / 64) * sizeof(T));
  return out;
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

bool SpareMemory::has(const std::function<bool(const SpareBlocks&)>& what) {
  const std::lock_guard lock(mutex_);
  return what(blocks_);
}

void SpareMemory::prepare(const DeriveResult& result) {
  const Scene& scene = result.scene;
  SpareBlocks made;
  const auto make = [&]<class T>(std::vector<T> SpareBlocks::*block, size_t count) {
    if (!has([&](const SpareBlocks& b) { return (b.*block).capacity() >= kTimesAsked * count; }))
      made.*block = ready<T>(count);
  };
  make(&SpareBlocks::leaves, scene.leaves.size());
  make(&SpareBlocks::instances, scene.instances.size());
  make(&SpareBlocks::prototypes, scene.prototypes.size());
  make(&SpareBlocks::notes, scene.prototypes.size());
  const size_t keys = kTimesAsked * scene.prototypes.size();
  for (const auto numbers : {&SpareBlocks::prototypeNumbers, &SpareBlocks::bare}) {
    if (!has([&](const SpareBlocks& b) { return (b.*numbers).hasRoom(keys); }))
      (made.*numbers).restart(keys);
  }
  keep(std::move(made));
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
