// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Output: what one worker of a derivation has made so far, in the worker's own numbering. merge()
// puts the outputs of all workers into one scene whose order depends on the initial shapes alone.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "program/program.h"
#include "runtime/key_numbers.h"
#include "scene/scene.h"
#include "shape/services.h"

namespace gable {

/// A report or a print, placed between the instances of its prototype.
struct OutputEvent {
  uint32_t instancesBefore = 0;
  bool print = false;
  /// The key of a report, or the text of a print.
  StringId text = 0;
  Value value;
};

struct OutputPrototype {
  static constexpr uint32_t kOwn = 0xffffffff;

  Prototype range;
  uint32_t firstEvent = 0, eventCount = 0;
  /// It or something inside reports or prints.
  bool speaks = false;
  /// (0, 0) for the prototype of an initial shape, which is never shared.
  ShareKey key;
  /// The set of attributes of the shape that the call worked on, which is a part of the key.
  uint32_t attributes = 0;

  // Of one that was taken over; nothing of it lies in the output.
  /// Its number in the scene before; kOwn: it was derived.
  uint32_t taken = kOwn;
  /// Leaves that had the one set of attributes get the other.
  uint32_t attributesBefore = 0, attributesNow = 0;
  bool isTaken() const { return taken != kOwn; }
  /// It differs from the one before, and range.firstInstance is the place in takenInstances of the
  /// output's numbers of what it holds.
  bool isChanged() const { return attributesBefore != attributesNow; }
};

/// Leaves hold the worker's own numbers: mesh by Output::meshes, materials by Output::materials,
/// name a StringId, source an instruction, attributes a set of the AttributePool.
struct Output {
  /// Finished prototypes and their content.
  std::vector<OutputPrototype> prototypes;
  std::vector<Leaf> leaves;
  std::vector<Instance> instances;
  std::vector<OutputEvent> events;
  std::vector<uint32_t> takenInstances;
  /// Content of the prototypes that are still open, the innermost last.
  std::vector<Leaf> openLeaves;
  std::vector<Instance> openInstances;
  std::vector<OutputEvent> openEvents;

  std::vector<MeshRef> meshes;
  /// By the address of the mesh.
  KeyNumbers meshIndex;
  /// (material, asset material list) pairs.
  std::vector<uint64_t> materials;
  std::unordered_map<uint64_t, uint32_t> materialIndex;

  uint32_t meshNumber(const MeshRef& m);
  uint32_t materialNumber(MaterialId material, uint32_t assetMaterials);
  struct Mark {
    uint32_t leaves = 0, instances = 0, events = 0;
  };
  Mark mark() const;
  /// Adds a prototype that was taken over, and gives its number.
  uint32_t addTaken(const OutputPrototype& prototype);
  /// Forgets all, with the numbering of meshes and materials. Keeps its memory.
  void drop();
  /// Moves what lies open beyond the marks into a finished prototype and gives its number. Where
  /// memory is refused (std::bad_alloc), all stays as it was.
  uint32_t close(const Mark& from, StringId name, uint64_t shapes, const ShareKey& key);

 private:
  uint64_t lastMaterial_ = ~uint64_t{0};
  uint32_t lastMaterialNumber_ = 0;
};

struct RecallPart;

/// A place in a unit where what a portion of it made belongs, or what was taken over from the scene
/// before and stays there until the outputs are merged.
struct OutputHole {
  /// The number of the portion's unit.
  uint32_t unit = 0;
  /// Counted from the beginning of the unit.
  Output::Mark at;
  size_t messages = 0;
  /// What was taken over; null for a portion.
  const RecallPart* taken = nullptr;
};

/// What a worker made in one go: an initial shape, or a portion of one (runtime/portion.h). Its
/// content is a prototype in the worker's output.
struct OutputUnit {
  uint32_t number = 0;
  uint32_t worker = 0;
  uint32_t prototype = 0;
  /// In path order.
  std::vector<OutputHole> holes;
  Diagnostics messages;
  // Of an initial shape.
  Frame frame;
  std::string name;
};

struct MergeInput {
  const Program& program;
  const MaterialTable& materials;
  const AttributePool& attributes;
  const Sources* sources = nullptr;
  /// Gets what the scene's numbers stand for, where it is not null; see runtime/recall.h.
  struct Recall* recall = nullptr;
  /// Where what was taken over lies; null where nothing can have been.
  const struct RecallInput* before = nullptr;
  /// Memory for the scene; null where there is none.
  struct SpareBlocks* spare = nullptr;
  /// Reports and prints, instances expanded, and the bytes of their texts.
  uint64_t mostEvents = 20'000'000;
  uint64_t mostEventBytes = uint64_t{1} << 30;
  /// The values of the attributes of leaves, each set once.
  uint64_t mostAttributeBytes = uint64_t{1} << 30;
};

struct Merged {
  Scene scene;
  /// False when there were more reports and prints than allowed.
  bool allEvents = true;
  /// False when leaves are without attributes, for which there was no room.
  bool allAttributes = true;
  /// By root: before which of the scene's reports its own end.
  std::vector<size_t> reportsEnd;
};

PlainValue plainValue(const Value& v, const ValuePool& pool);
AttributeValue plainAttribute(const std::string& name, const Value& v, const ValuePool& pool);

/// Empties the outputs, which keep their memory. `portions`: by number the units that fill the
/// holes of others.
Merged merge(std::vector<Output>& outputs, const std::vector<const OutputUnit*>& roots,
             const std::deque<OutputUnit>& portions, const MergeInput& input);

/// Calls visit(unit, hole) for a unit and those that fill its holes, in path order: for each, the
/// content that lies before its hole of that number, or behind the last hole. Calls taken(unit,
/// hole) for a hole with what was taken over.
template <class Visit, class Taken>
void forEachSegment(const OutputUnit& unit, const std::deque<OutputUnit>& portions, Visit&& visit,
                    Taken&& taken) {
  struct Open {
    const OutputUnit* unit;
    size_t hole;
  };
  std::vector<Open> open{{&unit, 0}};
  while (!open.empty()) {
    const Open at = open.back();
    visit(*at.unit, at.hole);
    if (at.hole == at.unit->holes.size()) {
      open.pop_back();
      continue;
    }
    ++open.back().hole;
    const OutputHole& hole = at.unit->holes[at.hole];
    if (hole.taken)
      taken(*at.unit, at.hole);
    else
      open.push_back({&portions[hole.unit], 0});
  }
}

template <class Visit>
void forEachSegment(const OutputUnit& unit, const std::deque<OutputUnit>& portions, Visit&& visit) {
  forEachSegment(unit, portions, visit, [](const OutputUnit&, size_t) {});
}

}  // namespace gable
