// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// SpareMemory: the large blocks of a scene that nobody needs any more, for the next derivation. The
// system clears each page that it gives out, which takes as long as putting the scene of a town
// together.
//
// Any thread may call. It holds the blocks of one derivation at most.
#pragma once

#include <functional>
#include <mutex>
#include <vector>

#include "runtime/output.h"
#include "runtime/recall.h"
#include "scene/scene.h"

namespace gable {

/// Nothing but room; any of them may have none.
struct SpareBlocks {
  std::vector<Leaf> leaves;
  std::vector<Instance> instances;
  std::vector<Prototype> prototypes;
  std::vector<Recall::PrototypeNotes> notes;
  KeyNumbers prototypeNumbers, bare;
  struct Worker {
    Output output;
    KeyNumbers numbers;
  };
  std::vector<Worker> workers;
};

class SpareMemory {
 public:
  /// Of each block the larger one is kept, and the other freed; of workers the newer ones.
  void keep(SpareBlocks blocks);
  /// Blocks for a result like this one, where there are none that large: their pages are there.
  void prepare(const DeriveResult& result);
  SpareBlocks take();

 private:
  bool has(const std::function<bool(const SpareBlocks&)>& what);

  std::mutex mutex_;
  SpareBlocks blocks_;
};

/// The blocks of a result that nobody needs any more.
SpareBlocks blocksOf(DeriveResult& result);

/// An empty list with room for so many: the spare one, unless that has too little or many times too
/// much. A new one has some room more: the next model may be a little larger, and pages that nobody
/// touches cost nothing.
template <class T>
std::vector<T> withRoom(std::vector<T> spare, size_t count) {
  constexpr size_t kTimesTooLarge = 4;
  if (spare.capacity() < count || spare.capacity() > kTimesTooLarge * count) {
    spare = std::vector<T>();
    spare.reserve(count + count / 8);
  }
  spare.clear();
  return spare;
}

}  // namespace gable
