// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/recall.h"

#include <map>

#include "runtime/derive.h"
#include "runtime/key_hash.h"

namespace gable {

namespace {

constexpr uint32_t kUnset = 0xffffffff;

std::vector<uint32_t> instructionsOf(const std::vector<Recall::Source>& sources,
                                     const Program& program) {
  std::map<std::pair<std::string_view, size_t>, uint32_t> entries;
  for (const RuleCode& r : program.rules) {
    entries.try_emplace({r.qualifiedName, r.parameters.size()}, r.entry);
  }
  std::vector<uint32_t> out;
  out.reserve(sources.size());
  for (const Recall::Source& s : sources) {
    // Leaves of rules that are gone are never asked for.
    const auto at = entries.find({s.rule, s.parameters});
    out.push_back(at == entries.end() ? 0 : at->second + s.offset);
  }
  return out;
}

bool sameAttributes(const std::vector<std::string>& names, const Program& program) {
  if (names.size() != program.attributes.size()) return false;
  for (size_t a = 0; a < names.size(); ++a) {
    if (names[a] != program.attributes[a].name) return false;
  }
  return true;
}

}  // namespace

RecallInput recallInput(const DeriveResult* before, const Program& program,
                        const Environment& environment) {
  if (!before || !before->recall) return {};
  const Recall& recall = *before->recall;
  if (recall.tables != &environment || !sameAttributes(recall.attributes, program)) return {};
  RecallInput out{&recall, &before->scene, instructionsOf(recall.sources, program), {}};
  for (uint32_t p = 0; p < recall.prototypes.size(); ++p) {
    const Recall::PrototypeNotes& notes = recall.prototypes[p];
    if (notes.attributes) out.bare.emplace(withoutAttributes(notes.key, notes.attributes), p);
  }
  return out;
}

Recaller::Recaller(const RecallInput& input, Output& output, KeyNumbers& cache)
    : input_(input),
      recall_(*input.recall),
      scene_(*input.scene),
      output_(output),
      cache_(cache),
      prototypes_(scene_.prototypes.size(), kUnset),
      meshes_(scene_.meshes.size(), kUnset),
      materials_(recall_.materials.size(), kUnset) {}

const RecallPart* Recaller::part(const ShareKey& key) const {
  const uint32_t* const number = recall_.partNumbers.find(key);
  return number ? &recall_.parts[*number] : nullptr;
}

std::shared_ptr<const RecallOperation> Recaller::operation(const ShareKey& key) const {
  const uint32_t* const number = recall_.operationNumbers.find(key);
  return number ? recall_.operations[*number] : nullptr;
}

Recaller::Counts Recaller::counts() { return std::exchange(counts_, Counts{}); }

Leaf Recaller::leaf(const Leaf& from) {
  Leaf to = from;
  if (from.mesh >= kFirstMesh) {
    const MeshRef& mesh = scene_.meshes[from.mesh];
    uint32_t& known = meshes_[from.mesh];
    if (known == kUnset) known = output_.meshNumber(mesh);
    to.mesh = kFirstMesh + known;
    counts_.vertices += mesh->positions.size();
  }
  uint32_t& materials = materials_[from.materials];
  if (materials == kUnset) {
    const uint64_t pair = recall_.materials[from.materials];
    materials =
        output_.materialNumber(static_cast<MaterialId>(pair >> 32), static_cast<uint32_t>(pair));
  }
  to.materials = materials;
  to.name = recall_.names[from.name];
  to.source = input_.instructions[from.source];
  to.attributes = recall_.attributeSets[from.attributes];
  if (to.attributes == attributesBefore_) to.attributes = attributesNow_;
  return to;
}

uint32_t& Recaller::known(uint32_t number) {
  if (attributesBefore_ == attributesNow_) return prototypes_[number];
  return changed_.try_emplace(number, kUnset).first->second;
}

ShareKey Recaller::keyNow(uint32_t number) const {
  const Recall::PrototypeNotes& notes = recall_.prototypes[number];
  if (notes.attributes != attributesBefore_) return notes.key;
  return withAttributes(withoutAttributes(notes.key, attributesBefore_), attributesNow_);
}

// True where the output has the prototype already.
bool Recaller::isTaken(uint32_t number) {
  uint32_t& at = known(number);
  if (at != kUnset) return true;
  const uint32_t* const inOutput = cache_.find(keyNow(number));
  if (inOutput) at = *inOutput;
  return inOutput != nullptr;
}

Instance Recaller::instance(const Instance& from) {
  Instance to = from;
  if (isTaken(from.prototype)) ++counts_.shared;
  to.prototype = prototype(from.prototype);
  return to;
}

void Recaller::take(const RecallPart& part, const Output::Mark& base) {
  const Prototype& from = scene_.prototypes[part.prototype];
  const Recall::PrototypeNotes& notes = recall_.prototypes[part.prototype];
  const Output::Mark now = output_.mark();
  // Unsigned differences wrap around, and back again when they are added.
  const uint32_t leafShift = now.leaves - base.leaves - part.begin.leaves;
  const uint32_t instanceShift = now.instances - base.instances - part.begin.instances;
  for (uint32_t i = part.begin.instances; i < part.end.instances; ++i) {
    Instance copy = instance(scene_.instances[from.firstInstance + i]);
    copy.leavesBefore += leafShift;
    output_.openInstances.push_back(copy);
  }
  for (uint32_t e = part.begin.events; e < part.end.events; ++e) {
    OutputEvent copy = recall_.events[notes.firstEvent + e];
    copy.instancesBefore += instanceShift;
    output_.openEvents.push_back(copy);
  }
  for (uint32_t l = part.begin.leaves; l < part.end.leaves; ++l) {
    output_.openLeaves.push_back(leaf(scene_.leaves[from.firstLeaf + l]));
  }
}

bool Recaller::takePrototype(const ShareKey& key, uint32_t& number) {
  const uint32_t* const before = recall_.prototypeNumbers.find(key);
  if (!before) return false;
  number = prototype(*before);
  return true;
}

bool Recaller::takePrototypeAs(const ShareKey& key, uint32_t attributes, uint32_t& number) {
  const uint32_t* const before = input_.bare.find(withoutAttributes(key, attributes));
  if (!before) return false;
  attributesBefore_ = recall_.prototypes[*before].attributes;
  attributesNow_ = attributes;
  number = prototype(*before);
  attributesBefore_ = attributesNow_ = 0;
  changed_.clear();
  return true;
}

// Prototypes are finished in the order in which deriving them would have done it: those that one
// holds before itself. Shared calls nest as deep as rules do, so those at work are a list.
uint32_t Recaller::prototype(uint32_t number) {
  struct Open {
    uint32_t number, next;
  };
  std::vector<Open> open;
  if (!isTaken(number)) open.push_back({number, 0});
  while (!open.empty()) {
    Open& top = open.back();
    const Prototype& from = scene_.prototypes[top.number];
    if (top.next < from.instanceCount) {
      const uint32_t inner = scene_.instances[from.firstInstance + top.next++].prototype;
      if (isTaken(inner))
        ++counts_.shared;
      else
        open.push_back({inner, 0});
      continue;
    }
    finish(top.number);
    open.pop_back();
  }
  return known(number);
}

// Takes a prototype over whose instances have been.
void Recaller::finish(uint32_t number) {
  const Recall::PrototypeNotes& notes = recall_.prototypes[number];
  const Prototype& from = scene_.prototypes[number];
  output_.makeRoomFor(from);
  OutputPrototype to;
  to.range = from;
  to.range.name = recall_.names[from.name];
  to.key = keyNow(number);
  to.attributes = notes.attributes == attributesBefore_ ? attributesNow_ : notes.attributes;
  to.speaks = notes.speaks;
  to.range.firstInstance = static_cast<uint32_t>(output_.instances.size());
  for (uint32_t i = 0; i < from.instanceCount; ++i) {
    Instance& copy = output_.instances.emplace_back(scene_.instances[from.firstInstance + i]);
    copy.prototype = known(copy.prototype);
  }
  to.range.firstLeaf = static_cast<uint32_t>(output_.leaves.size());
  for (uint32_t l = 0; l < from.leafCount; ++l) {
    output_.leaves.push_back(leaf(scene_.leaves[from.firstLeaf + l]));
  }
  to.firstEvent = static_cast<uint32_t>(output_.events.size());
  to.eventCount = notes.eventCount;
  output_.events.insert(output_.events.end(), recall_.events.begin() + notes.firstEvent,
                        recall_.events.begin() + notes.firstEvent + notes.eventCount);
  output_.prototypes.push_back(to);
  known(number) = static_cast<uint32_t>(output_.prototypes.size() - 1);
  cache_.emplace(to.key, known(number));
}

}  // namespace gable
