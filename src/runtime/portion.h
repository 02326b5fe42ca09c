// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Portions: how several workers derive one initial shape.
//
// A worker that has nothing to do waits in the queue. Another one that sees it waiting hands over
// the last half of the children of the outermost block that it is at: a portion. Children of one
// block know nothing of each other, and draws have addresses, so a portion comes out the same
// wherever it is derived. What a worker makes in one go, an initial shape or a portion of one, is a
// unit. A unit remembers holes, the places where its portions belong, and merge() puts the units of
// an initial shape together in path order.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "runtime/attribute_values.h"
#include "runtime/derive.h"
#include "runtime/incremental_cache.h"
#include "runtime/kept_shape.h"
#include "runtime/local_values.h"
#include "runtime/output.h"
#include "runtime/room.h"
#include "shape/part.h"
#include "shape/services.h"

namespace gable {

/// What all portions of one initial shape have in common.
struct PortionBase {
  InitialShapeInfo info;
  StringId name = 0;
  /// For keys of the incremental cache.
  IncrementalCache::Inputs inputs;
};

/// Children of a block, and all that they can see.
struct Portion {
  std::shared_ptr<const PortionBase> base;
  /// The unit that it makes.
  OutputUnit* unit = nullptr;

  // The values of attributes that are known by now.
  AttributeValues attributeValues;
  // The shape that was divided, its rule, and what the rule is called with.
  KeptShape parent;
  uint32_t rule = 0, block = 0, depth = 0;
  std::vector<Value> parameters;
  LocalValues locals;
  /// Rules that are run in place.
  uint32_t inPlace = 0;
  /// Where the shape that was divided stands in the tree, the number of the first child there, and
  /// whether it asked for room (Activation).
  PlacePath place;
  uint32_t firstStep = 0;
  bool asked = false;
  /// Where the frame of the rule call lies.
  Frame world;
  /// The rules from the initial shape to here, for messages, and how many they are.
  std::string path;
  uint32_t pathLength = 0;

  // The children: shapes, or pieces to be made by the plan.
  std::vector<KeptShape> children;
  std::vector<SplitPiece> pieces;
  PartPlan plan;
};

/// What waits for a worker, and workers that wait.
class PortionQueue {
 public:
  /// `open`: units of work that are not done, the initial shapes.
  explicit PortionQueue(size_t open) : open_(open) {}

  /// More workers wait than portions. Costs a load.
  bool isHungry() const { return hungry_.load(std::memory_order_relaxed) > 0; }
  /// Gives the number of its unit.
  uint32_t push(std::unique_ptr<Portion> portion);
  /// Waits for a portion; null when all work is done.
  std::unique_ptr<Portion> take();
  /// A unit of work is done.
  void done();
  /// The units of all portions, by number.
  std::deque<OutputUnit>& units() { return units_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::unique_ptr<Portion>> waiting_;
  std::deque<OutputUnit> units_;
  size_t open_;
  std::atomic<int> hungry_{0};
};

}  // namespace gable
