// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Recall: what a derivation keeps so that the next one, of nearly the same rules, derives only what
// has changed.
//
// It keeps no geometry of its own: a part is the result of one costly rule call, as ranges of the
// scene that was made, under a key of all that the call depended on: the code within reach, the
// attributes that were given from outside, the initial shape, the shape with its address. Where the
// next derivation comes to a call with that key it takes the ranges over. Prototypes are found
// under the keys of sharing, and single operations that took long (the streets of a town) with the
// shapes that they made. The scene is the same, to the byte, as one derived from nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "program/program.h"
#include "runtime/kept_shape.h"
#include "runtime/output.h"
#include "shape/shape.h"

namespace gable {

struct Environment;
struct DeriveResult;
class RoomPlan;

/// A rule call's result, as ranges of the leaves, instances and events of the prototype of its
/// initial shape.
struct RecallPart {
  ShareKey key;
  /// Of the scene; of the worker's output until the outputs are merged.
  uint32_t prototype = 0, worker = 0;
  /// Until then: how many holes of the unit lie before its begin and its end. None within is that
  /// of a portion.
  uint32_t holes = 0, holesEnd = 0;
  /// Until then: it lies in the hole of that number, which was filled from the scene before, and
  /// begin and end are places there.
  bool taken = false;
  Output::Mark begin, end;
  /// Parts from this one up to the part itself lie inside of it.
  uint32_t firstInside = 0;
  /// Operations that were kept inside of it.
  uint32_t firstOperation = 0, endOperation = 0;
  /// What the call counted.
  uint64_t shapes = 0, shapesExpanded = 0, steps = 0;
};

/// What an operation that took long did to its shape.
struct RecallOperation {
  ShareKey key;
  /// Units of work() for what it made.
  uint64_t worth = 0;
  KeptShape shape;
  std::vector<KeptShape> children;
};

struct Recall {
  /// Keys hold ids of these tables, which must be the same objects.
  const Environment* tables = nullptr;
  /// Names of the program's attributes: attribute sets go by their order.
  std::vector<std::string> attributes;

  std::vector<RecallPart> parts;
  KeyNumbers partNumbers;
  KeyNumbers prototypeNumbers;
  std::vector<std::shared_ptr<const RecallOperation>> operations;
  KeyNumbers operationNumbers;
  /// Who has room, and what that depends on; null where no rule asks or that cannot be told.
  std::shared_ptr<RoomPlan> rooms;
  ShareKey roomsKey;

  /// By prototype of the scene: its key, and its events in `events`.
  struct PrototypeNotes {
    ShareKey key;
    uint32_t firstEvent = 0, eventCount = 0;
    bool speaks = false;
    /// The set of attributes of the shape that the call worked on.
    uint32_t attributes = 0;
  };
  std::vector<PrototypeNotes> prototypes;
  std::vector<OutputEvent> events;

  // What the numbers in the scene's leaves stand for in the tables.
  std::vector<StringId> names;
  /// Pairs as Output::materials has them.
  std::vector<uint64_t> materials;
  std::vector<uint32_t> attributeSets;
  /// An instruction, told so that it is found again in another program.
  struct Source {
    std::string rule;
    size_t parameters = 0;
    uint32_t offset = 0;
  };
  std::vector<Source> sources;
};

/// Why a derivation before is of use, worked out once for all workers.
struct RecallInput {
  const Recall* recall = nullptr;
  const Scene* scene = nullptr;
  /// By source of the scene: the instruction of the program at work.
  std::vector<uint32_t> instructions;
  /// Prototypes of calls on shapes with attributes, by their keys without these.
  KeyNumbers bare;
};

/// Empty where nothing can be taken over: there is no recall, or it is of other tables. `bare`: for
/// the memory that it has.
RecallInput recallInput(const DeriveResult* before, const Program& program,
                        const Environment& environment, KeyNumbers bare);

/// Takes results of the derivation before over into the output of one worker. Their content stays
/// in the scene before until merge() takes it from there; what is worked out here is what deriving
/// them would have counted.
class Recaller {
 public:
  Recaller(const RecallInput& input, Output& output, KeyNumbers& cache);

  /// Null when there is none.
  const RecallPart* part(const ShareKey& key) const;
  const Recall& recall() const { return recall_; }
  std::shared_ptr<const RecallOperation> operation(const ShareKey& key) const;
  /// The part's content is to lie where a hole is left for it.
  void take(const RecallPart& part);
  /// Finishes the prototype with that key, and those that it holds, in the output and the cache.
  /// False when it is not known.
  bool takePrototype(const ShareKey& key, uint32_t& number);
  /// The same where the key was that of a shape with other attributes, of which the rule read none
  /// that differ and set none: its leaves get the set that they have now.
  bool takePrototypeAs(const ShareKey& key, uint32_t attributes, uint32_t& number);

  /// Since the last call of it: vertices of meshes of the leaves taken over, and instances of
  /// prototypes that the output had already.
  struct Counts {
    uint64_t vertices = 0, shared = 0;
  };
  Counts counts();

 private:
  ShareKey keyNow(uint32_t number) const;
  OutputPrototype taken(uint32_t number) const;
  uint32_t asItWas(uint32_t number);
  uint32_t& knownChanged(uint32_t number);
  uint32_t changed(uint32_t number);
  void finishChanged(uint32_t number);
  void count(uint32_t number);
  void countLeaves(const Leaf* leaves, uint32_t count);

  const RecallInput& input_;
  const Recall& recall_;
  const Scene& scene_;
  Output& output_;
  KeyNumbers& cache_;
  /// By number in the scene before: that in the output, and whether it has been counted.
  std::vector<uint32_t> prototypes_;
  std::vector<bool> counted_;
  /// The set of attributes that leaves get in the place of another; the same while none is changed.
  uint32_t attributesBefore_ = 0, attributesNow_ = 0;
  /// As `prototypes_`, of all with the set that is changed at present.
  std::unordered_map<uint32_t, uint32_t> changed_;
  Counts counts_;
};

}  // namespace gable
