// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Worlds: where the frames of the rule calls at work lie. A shared rule works in the frame of its
// shape; what it makes is placed in the world, or, where an operation waits for leaves, in the
// frame of the call that waits.
#pragma once

#include <cstddef>
#include <vector>

#include "math/frame.h"

namespace gable {

class Worlds {
 public:
  Worlds() = default;
  Worlds(const Worlds&) = delete;
  Worlds& operator=(const Worlds&) = delete;

  /// An initial shape, or a portion of one: forgets all that is open.
  void begin(const Frame& outermost);
  /// A call works in a frame of its own, which is given in that of the call around.
  void open(const Frame& frame);
  void close();
  /// Leaves are placed in the present frame until the end.
  void beginGather();
  void endGather();

  /// The present frame in the world.
  const Frame& present() const { return calls_.back(); }
  /// Where what lies in the present frame is placed.
  const Frame& ofLeaves() const { return leaves_->back(); }
  /// After `calls` calls with a frame of their own.
  const Frame& after(size_t calls) const { return calls_[calls]; }

 private:
  std::vector<Frame> calls_;
  /// While leaves are gathered: the frames in that of the call that gathers; and where each began.
  std::vector<Frame> gathered_;
  std::vector<size_t> gathers_;
  const std::vector<Frame>* leaves_ = &calls_;
};

}  // namespace gable
