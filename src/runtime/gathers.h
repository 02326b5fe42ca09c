// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gathers: operations that wait for what comes of their children. These are derived as ever, but
// without prototypes and in the frame of the call that waits, so that sharing makes no difference;
// then the operation sees their leaves, and those that it takes leave the result. Gathers nest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/output.h"
#include "runtime/tracer.h"
#include "runtime/worlds.h"
#include "shape/op_call.h"

namespace gable {

class Gathers {
 public:
  /// All must outlive the gathers.
  Gathers(Output& output, Tracer& tracer, Worlds& worlds)
      : output_(output), tracer_(tracer), worlds_(worlds) {}

  /// An operation that waits, and how things were when it began.
  struct Call {
    const Instruction* at = nullptr;
    /// The activation on whose shape it works.
    uint32_t activation = 0;
    /// Children that the activation had made before.
    uint32_t made = 0;
    /// Leaves were placed in the world at once.
    bool flat = false;
    /// Plain parts took the fast path.
    bool light = false;
    std::vector<Value> arguments;
    /// The operation wants the tags of its leaves.
    bool tagged = false;
    /// Its leaves have origins, and it is given the deleted ones too (OpCall::gather).
    bool keepsOrigins = false;
  };
  void begin(Call call);
  bool anyOpen() const { return !open_.empty(); }
  bool anyTagged() const;
  /// Whether the innermost call wants to know where its leaves come from, and what is deleted.
  bool keepsOrigins() const { return !open_.empty() && open_.back().call.keepsOrigins; }
  /// The number of a shape that begins within the innermost call; the call gives out smaller ones.
  double nextShape() { return 0x1.0p32 + static_cast<double>(open_.back().shapes++); }
  /// There must be one.
  const Call& outermost() const { return open_.front().call; }
  const Call& innermost() const { return open_.back().call; }
  /// Whether the innermost call waits for the children of the activation at work, the last of so
  /// many.
  bool isDue(uint32_t activations) const { return due_ == activations; }
  /// The next leaves come of a child that works on that slot.
  void beginChild(uint32_t slot);

  /// A call whose children are done.
  struct Ended {
    Call call;
    /// What came of them, in the frame of the call. The operation marks what it takes, and may give
    /// the others another mesh.
    std::vector<Gathered> leaves;
    /// By leaf: the block slot of the child that it came of.
    std::vector<uint32_t> slots;
    /// By open leaf since the call began: only a trace shows it.
    std::vector<bool> shown;
    uint32_t firstLeaf = 0, firstNode = 0;
  };
  /// Ends the innermost call.
  Ended end();
  /// Places the leaves of an ended call where they lie outside of it. `done`: the operation has
  /// done its work; otherwise all stay as they were.
  void putBack(const Ended& ended, bool done);
  /// A limit struck within the innermost call: what has not been gathered goes.
  Call drop();

 private:
  struct Open {
    Call call;
    /// So many open leaves and nodes of the trace were there before.
    uint32_t firstLeaf = 0, firstNode = 0;
    uint64_t shapes = 0;
    /// By child: its first leaf, and its slot.
    std::vector<std::pair<uint32_t, uint32_t>> children;
  };
  Open close();
  bool forgetOrigins(const Shape& s, Leaf& leaf);
  void keepLeaves(uint32_t firstLeaf, uint32_t firstNode, bool flat, const std::vector<bool>& gone);

  Output& output_;
  Tracer& tracer_;
  Worlds& worlds_;
  std::vector<Open> open_;
  /// As many activations as there are when the children of the innermost have ended; 0: none is.
  uint32_t due_ = 0;
};

}  // namespace gable
