// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// IncrementalCache: what one worker keeps of a derivation for the next one, and takes over from the
// one before; see runtime/recall.h for what a Recall holds.
//
// A call is kept as a part when calls of its rule cost enough that a key is little beside them. A
// part that warned is not kept: the warning would be lost. Nor is one of which another worker made
// a portion. An operation is kept when it was much work() for what it made, counted and not timed,
// so that the same is kept each time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "program/program.h"
#include "program/reach.h"
#include "runtime/local_values.h"
#include "runtime/output.h"
#include "runtime/prototypes.h"
#include "runtime/recall.h"
#include "runtime/tally.h"
#include "shape/op_call.h"

namespace gable {

class IncrementalCache {
 public:
  struct Tables {
    const Program& program;
    /// By rule.
    const std::vector<Reach>& reach;
    const RecallInput& before;
    /// What is made is thrown away: operations are taken over, and nothing is kept.
    bool thrownAway = false;
  };
  /// What it takes over goes into the output, with its prototypes, and is counted. All must outlive
  /// the cache.
  IncrementalCache(const Tables& tables, Output& output, Prototypes& prototypes, Tally& tally);
  ~IncrementalCache();

  /// What the initial shape at work is, in keys: itself, and by attribute the value given from
  /// outside, 0 for none.
  struct Inputs {
    uint64_t shape = 0;
    std::vector<uint64_t> given;
  };
  static Inputs inputsOf(const InitialShapeInfo& shape, std::vector<uint64_t> given);
  /// An initial shape, or a portion of one.
  void begin(Inputs inputs);
  const Inputs& inputs() const { return inputs_; }

  // Rule calls.

  /// Whether calls of the rule are worth a key, as far as it is known. Every so often a rule whose
  /// calls were small is looked at again.
  bool isRuleDue(uint32_t rule);
  struct Call {
    uint32_t rule = 0;
    uint32_t depth = 0;
    const Shape& shape;
    std::span<const Value> arguments;
    const LocalValues& locals;
    /// A hash of its place among the calls, where what comes of it depends on that.
    uint64_t place = 0;
  };
  ShareKey keyOf(const Call& call);
  /// What tells whether a part is whole and silent, and where it is.
  struct Moment {
    /// What was told by now, and what will be told of shapes that nobody gave room.
    uint64_t warnings = 0;
    /// Holes that were placed in the unit by now: those of portions, and all.
    size_t portions = 0, holes = 0;
  };
  /// The part, when the result is known: it has been counted, and the caller leaves a hole for it
  /// at this moment. Else null.
  const RecallPart* beginPart(const ShareKey& key, uint32_t rule, const Moment& now);
  void endPart(const Moment& now);

  // Prototypes.

  /// The prototype of a call, taken over from the derivation before; also that of a call on a shape
  /// with other attributes, if these change nothing. `attributes`: the set that the shape has.
  std::optional<uint32_t> takePrototype(const ShareKey& key, uint32_t rule, uint32_t attributes);

  // Operations.

  /// Whether the operation at an instruction is worth a key; as with rules.
  bool isOperationDue(uint32_t instruction);
  /// Of a call with these arguments; none where it takes code to know what they say. What the
  /// rules have set for the shape does not count: operations neither read nor change it.
  std::optional<ShareKey> keyOf(OpCall& call, std::span<const Value> arguments,
                                const BlockInput* block, const LocalValues& locals) const;
  /// True when it is known what the operation does to the shape, and that has been done.
  bool takeOperation(const ShareKey& key, uint32_t instruction, Shape& shape,
                     std::vector<BlockChild>& children);
  /// It ran, with so many units of work(). `result`: the shape that it left and the children that
  /// it made; null where that cannot be repeated.
  struct OperationResult {
    const Shape& shape;
    std::span<const BlockChild> children;
    /// The set of attributes of the shape that it worked on.
    uint32_t attributes = 0;
  };
  void endOperation(const ShareKey& key, uint32_t instruction, uint64_t units,
                    const OperationResult* result);

  /// The unit of work has ended and become a prototype of the worker's output.
  void endUnit(uint32_t worker, uint32_t prototype);
  /// The parts of all units, each after those inside it.
  const std::vector<RecallPart>& parts() const { return parts_; }
  const std::vector<std::shared_ptr<const RecallOperation>>& operations() const {
    return operations_;
  }
  /// Shapes taken over, instances expanded; and instances of prototypes among them that the output
  /// had already.
  uint64_t taken() const { return taken_; }
  uint64_t shared() const { return shared_; }

 private:
  uint64_t inputsOf(uint32_t rule);
  void takePart(const RecallPart& known, size_t holes);
  void countTaken();

  /// How often something came, and what it took where it was looked at.
  struct Cost {
    uint64_t calls = 0, measured = 0, sum = 0;
    bool isDue(uint64_t worthwhile);
    void add(uint64_t cost) {
      ++measured;
      sum += cost;
    }
  };
  struct OpenPart {
    RecallPart part;
    uint32_t rule = 0;
    uint64_t warnings = 0;
    size_t portions = 0;
  };

  const Program& program_;
  const std::vector<Reach>& reach_;
  Output& output_;
  Prototypes& prototypes_;
  Tally& tally_;
  const bool thrownAway_;
  /// Null where there is nothing to take over.
  std::unique_ptr<Recaller> recaller_;
  Inputs inputs_;
  /// By rule: the code within reach, the shape and what was given, in one; 0 where not known yet.
  std::vector<uint64_t> ruleInputs_;
  /// By rule in steps, by instruction in units of work().
  std::vector<Cost> ruleCosts_, operationCosts_;
  std::vector<OpenPart> open_;
  std::vector<RecallPart> parts_;
  size_t unitBegin_ = 0;
  std::vector<std::shared_ptr<const RecallOperation>> operations_;
  uint64_t taken_ = 0, shared_ = 0;
};

}  // namespace gable
