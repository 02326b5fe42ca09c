// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// LightParts: the fast path for plain parts. Most leaves of a facade come of rules like
//
//   Bay   --> split(x) { 0.15 : Frame | ~1 : Glass. | 0.15 : Frame }
//   Frame --> s('1, '1, 0.2) primitiveCube()
//
// whose code is a straight line of plain operations with constant arguments, and perhaps a split by
// constant sizes at its end. Such parts are never made as shapes: the steps run on a LightPart, a
// few numbers, and write the leaf. What they cannot do (a size of zero, a box that a trim plane
// meets, a length that was not divided before) is done the long way, part by part, and both ways
// give the same leaves, counts and numbers of children.
#pragma once

#include <cstdint>
#include <span>

#include "gable/limits.h"
#include "program/program.h"
#include "runtime/light_slots.h"
#include "runtime/output.h"
#include "runtime/split_cache.h"
#include "runtime/tally.h"
#include "shape/part.h"
#include "shape/shape.h"

namespace gable {

class LightParts {
 public:
  struct Around {
    const Program& program;
    const Limits& limits;
    const SplitCache& splits;
    /// Leaves are placed in the world at once.
    bool flat = false;
  };
  /// Leaves go into the output and are counted. All must outlive the parts.
  LightParts(const Around& around, Output& output, Tally& tally)
      : limits_(around.limits),
        splits_(around.splits),
        flat_(around.flat),
        output_(output),
        tally_(tally),
        slots_(around.program, around.flat) {}

  /// A shape that is being divided.
  struct Parent {
    const Shape& shape;
    const PartPlan& plan;
    /// Where leaves in the local frame are placed.
    const Frame& world;
    uint32_t rule = 0, block = 0, depth = 0;
    /// Of the rule call that the parts belong to.
    uint32_t* childCount = nullptr;
  };
  /// Makes parts from the first on as long as they are light and no look at the limits is due. Says
  /// how many it made.
  size_t make(const Parent& parent, std::span<const SplitPiece> pieces);
  const LightSlot& slot(uint32_t block, uint32_t rule, uint32_t number) {
    return slots_.of(block, rule)[number];
  }

 private:
  /// What parts are cut from.
  struct Source {
    /// Where the local frame lies in the frame of the leaves: the axes of `world`, at `place`.
    const Frame& world;
    Vec3 place;
    /// The scope in the local frame: the axes of `axes`, at `origin`.
    const Frame& axes;
    Vec3 origin;
    /// What the leaves have in common: attributes, materials, and the axes of the scope, or of the
    /// world below a rule that works in a frame of its own.
    const Leaf *leaf, *worldLeaf;
    /// The scope's axis that it is divided along.
    Vec3 along;
    Vec3 size;
    GeometryKind kind;
    const LightTrim* trim;
    /// Of the rule call that the parts belong to; null when it is light itself.
    uint32_t* childCount;
  };
  /// Where the local frame of a part lies in the frame of the leaves, and what its leaf is like.
  struct Place {
    Vec3 origin;
    const Leaf* leaf;
  };
  bool makePart(const Source& from, const PartPlan& plan, const SplitPiece& piece,
                const LightSlot& slot, uint32_t depth, uint32_t nested);
  bool splitPart(const Source& from, const Place& place, const LightPart& part,
                 const LightSlot& slot, uint32_t depth, uint32_t nested);

  const Limits& limits_;
  const SplitCache& splits_;
  const bool flat_;
  Output& output_;
  Tally& tally_;
  LightSlots slots_;
};

}  // namespace gable
