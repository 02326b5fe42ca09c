// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/recall.h"

#include <algorithm>
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
    if (r.reached) entries.try_emplace({r.qualifiedName, r.parameters.size()}, r.entry);
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
                        const Environment& environment, KeyNumbers bare) {
  if (!before || !before->recall) return {};
  const Recall& recall = *before->recall;
  if (recall.tables != &environment || !sameAttributes(recall.attributes, program)) return {};
  RecallInput out{&recall, &before->scene, instructionsOf(recall.sources, program),
                  std::move(bare)};
  const auto hasAttributes = [](const auto& notes) { return notes.attributes != 0; };
  out.bare.restart(static_cast<size_t>(
      std::count_if(recall.prototypes.begin(), recall.prototypes.end(), hasAttributes)));
  const auto keyOf = [&](uint32_t p) {
    const Recall::PrototypeNotes& notes = recall.prototypes[p];
    return withoutAttributes(notes.key, notes.attributes);
  };
  for (uint32_t p = 0; p < recall.prototypes.size(); ++p) {
    const uint32_t later = p + KeyNumbers::kAhead;
    if (later < recall.prototypes.size()) out.bare.prefetch(keyOf(later));
    if (hasAttributes(recall.prototypes[p])) out.bare.emplace(keyOf(p), p);
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
      counted_(scene_.prototypes.size()) {}

const RecallPart* Recaller::part(const ShareKey& key) const {
  const uint32_t* const number = recall_.partNumbers.find(key);
  return number ? &recall_.parts[*number] : nullptr;
}

std::shared_ptr<const RecallOperation> Recaller::operation(const ShareKey& key) const {
  const uint32_t* const number = recall_.operationNumbers.find(key);
  return number ? recall_.operations[*number] : nullptr;
}

Recaller::Counts Recaller::counts() { return std::exchange(counts_, Counts{}); }

void Recaller::countLeaves(const Leaf* leaves, uint32_t count) {
  for (uint32_t l = 0; l < count; ++l) {
    const uint32_t mesh = leaves[l].mesh;
    if (mesh >= kFirstMesh) counts_.vertices += scene_.meshes[mesh]->positions.size();
  }
}

ShareKey Recaller::keyNow(uint32_t number) const {
  const Recall::PrototypeNotes& notes = recall_.prototypes[number];
  if (notes.attributes != attributesBefore_) return notes.key;
  return withAttributes(withoutAttributes(notes.key, attributesBefore_), attributesNow_);
}

void Recaller::take(const RecallPart& part) {
  const Prototype& from = scene_.prototypes[part.prototype];
  for (uint32_t i = part.begin.instances; i < part.end.instances; ++i) {
    count(scene_.instances[from.firstInstance + i].prototype);
  }
  countLeaves(scene_.leaves.data() + from.firstLeaf + part.begin.leaves,
              part.end.leaves - part.begin.leaves);
}

bool Recaller::takePrototype(const ShareKey& key, uint32_t& number) {
  const uint32_t* const before = recall_.prototypeNumbers.find(key);
  if (!before) return false;
  count(*before);
  number = asItWas(*before);
  return true;
}

bool Recaller::takePrototypeAs(const ShareKey& key, uint32_t attributes, uint32_t& number) {
  const uint32_t* const before = input_.bare.find(withoutAttributes(key, attributes));
  if (!before) return false;
  attributesBefore_ = recall_.prototypes[*before].attributes;
  attributesNow_ = attributes;
  number = changed(*before);
  attributesBefore_ = attributesNow_ = 0;
  changed_.clear();
  return true;
}

// Shared calls nest as deep as rules do, so those at work are a list.
void Recaller::count(uint32_t number) {
  std::vector<uint32_t> open;
  const auto meet = [&](uint32_t prototype) {
    if (counted_[prototype]) {
      ++counts_.shared;
      return;
    }
    counted_[prototype] = true;
    open.push_back(prototype);
  };
  meet(number);
  while (!open.empty()) {
    const Prototype& from = scene_.prototypes[open.back()];
    open.pop_back();
    countLeaves(scene_.leaves.data() + from.firstLeaf, from.leafCount);
    for (uint32_t i = 0; i < from.instanceCount; ++i) {
      meet(scene_.instances[from.firstInstance + i].prototype);
    }
  }
}

// As it was, but for its key.
OutputPrototype Recaller::taken(uint32_t number) const {
  const Recall::PrototypeNotes& notes = recall_.prototypes[number];
  OutputPrototype to;
  to.range = scene_.prototypes[number];
  to.range.name = recall_.names[to.range.name];
  to.attributes = notes.attributes;
  to.speaks = notes.speaks;
  to.taken = number;
  return to;
}

// What it holds is known by it, and is not looked at before somebody asks.
uint32_t Recaller::asItWas(uint32_t number) {
  uint32_t& known = prototypes_[number];
  if (known != kUnset) return known;
  OutputPrototype to = taken(number);
  to.key = recall_.prototypes[number].key;
  known = output_.addTaken(to);
  cache_.emplace(to.key, known);
  return known;
}

// The output's number of one with the attributes that are changed at present; kUnset: not yet.
// What the scene before has with these attributes is taken as it was, so that no two prototypes of
// one key are taken by different ways.
uint32_t& Recaller::knownChanged(uint32_t number) {
  uint32_t& known = changed_.try_emplace(number, kUnset).first->second;
  if (known != kUnset) return known;
  const ShareKey key = keyNow(number);
  if (const uint32_t* const inOutput = cache_.find(key)) return known = *inOutput;
  if (const uint32_t* const before = recall_.prototypeNumbers.find(key)) {
    count(*before);
    known = asItWas(*before);
  }
  return known;
}

// Prototypes are finished in the order in which deriving them would have done it: those that one
// holds before itself.
uint32_t Recaller::changed(uint32_t number) {
  struct Open {
    uint32_t number, next;
  };
  std::vector<Open> open;
  if (knownChanged(number) == kUnset) open.push_back({number, 0});
  while (!open.empty()) {
    Open& top = open.back();
    const Prototype& from = scene_.prototypes[top.number];
    if (top.next < from.instanceCount) {
      const uint32_t inner = scene_.instances[from.firstInstance + top.next++].prototype;
      if (knownChanged(inner) == kUnset)
        open.push_back({inner, 0});
      else
        ++counts_.shared;
      continue;
    }
    finishChanged(top.number);
    open.pop_back();
  }
  return knownChanged(number);
}

// Takes a prototype over whose instances have been.
void Recaller::finishChanged(uint32_t number) {
  OutputPrototype to = taken(number);
  to.key = keyNow(number);
  if (to.attributes == attributesBefore_) to.attributes = attributesNow_;
  to.attributesBefore = attributesBefore_;
  to.attributesNow = attributesNow_;
  const Prototype& from = scene_.prototypes[number];
  to.range.firstInstance = static_cast<uint32_t>(output_.takenInstances.size());
  for (uint32_t i = 0; i < from.instanceCount; ++i) {
    const uint32_t inner = scene_.instances[from.firstInstance + i].prototype;
    output_.takenInstances.push_back(knownChanged(inner));
  }
  countLeaves(scene_.leaves.data() + from.firstLeaf, from.leafCount);
  const uint32_t known = output_.addTaken(to);
  knownChanged(number) = known;
  cache_.emplace(to.key, known);
}

}  // namespace gable
