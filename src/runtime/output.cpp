// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/output.h"

#include <algorithm>
#include <new>

#include "base/hash.h"

namespace gable {

// Listed before they are numbered: where memory is refused, no number of nothing stays behind. The
// mesh remembers its hash, which merge() asks for when one worker is left.
uint32_t Output::meshNumber(const MeshRef& m) {
  const auto address = static_cast<uint64_t>(reinterpret_cast<uintptr_t>(m.get()));
  const ShareKey key{mix64(address), address};
  if (const uint32_t* const known = meshIndex.find(key)) return *known;
  const auto number = static_cast<uint32_t>(meshes.size());
  m->sharedHash();
  meshes.push_back(m);
  meshIndex.emplace(key, number);
  return number;
}

uint32_t Output::materialNumber(MaterialId material, uint32_t assetMaterials) {
  const uint64_t pair = uint64_t{material} << 32 | assetMaterials;
  if (pair == lastMaterial_) return lastMaterialNumber_;
  auto known = materialIndex.find(pair);
  if (known == materialIndex.end()) {
    const auto number = static_cast<uint32_t>(materials.size());
    materials.push_back(pair);
    known = materialIndex.emplace(pair, number).first;
  }
  lastMaterial_ = pair;
  lastMaterialNumber_ = known->second;
  return lastMaterialNumber_;
}

Output::Mark Output::mark() const {
  return {static_cast<uint32_t>(openLeaves.size()), static_cast<uint32_t>(openInstances.size()),
          static_cast<uint32_t>(openEvents.size())};
}

void Output::drop() {
  prototypes.clear();
  leaves.clear();
  instances.clear();
  events.clear();
  takenInstances.clear();
  openLeaves.clear();
  openInstances.clear();
  openEvents.clear();
  meshes.clear();
  meshIndex.clear();
  materials.clear();
  materialIndex.clear();
  lastMaterial_ = ~uint64_t{0};
}

namespace {

// Lists of more bytes than this grow by more than double.
constexpr size_t kLarge = size_t{1} << 20;

// Every page that is touched for the first time costs the system as much as the leaves in it cost
// the machine, and workers wait for each other there. What is reserved and never touched is free.
// Before anything is moved: where memory is refused, all stays as it was.
template <class T>
void makeRoom(std::vector<T>& to, size_t more) {
  if (to.capacity() - to.size() >= more) return;
  const size_t least = to.size() + more, twice = std::max(2 * to.capacity(), least);
  if (to.size() * sizeof(T) >= kLarge) {
    try {
      return to.reserve(std::max(16 * to.capacity(), least));
    } catch (const std::bad_alloc&) {
      // So much is not to be had at once.
    }
  }
  to.reserve(twice);
}

template <class T>
void makeRoomForTail(const std::vector<T>& from, uint32_t begin, std::vector<T>& to) {
  if (begin != 0 || !to.empty()) makeRoom(to, from.size() - begin);
}

template <class T>
uint32_t moveTail(std::vector<T>& from, uint32_t begin, std::vector<T>& to, uint32_t& count) {
  const auto first = static_cast<uint32_t>(to.size());
  count = static_cast<uint32_t>(from.size()) - begin;
  // A large model of one initial shape need not be copied.
  if (begin == 0 && to.empty()) {
    to.swap(from);
    return 0;
  }
  to.insert(to.end(), from.begin() + begin, from.end());
  from.resize(begin);
  return first;
}

}  // namespace

uint32_t Output::addTaken(const OutputPrototype& prototype) {
  makeRoom(prototypes, 1);
  prototypes.push_back(prototype);
  return static_cast<uint32_t>(prototypes.size() - 1);
}

uint32_t Output::close(const Mark& from, StringId name, uint64_t shapes, const ShareKey& key) {
  makeRoomForTail(openLeaves, from.leaves, leaves);
  makeRoomForTail(openInstances, from.instances, instances);
  makeRoomForTail(openEvents, from.events, events);
  makeRoom(prototypes, 1);
  OutputPrototype p;
  p.range.name = name;
  p.range.shapes = shapes;
  p.key = key;
  p.range.firstLeaf = moveTail(openLeaves, from.leaves, leaves, p.range.leafCount);
  p.range.firstInstance = moveTail(openInstances, from.instances, instances, p.range.instanceCount);
  p.firstEvent = moveTail(openEvents, from.events, events, p.eventCount);
  p.speaks = p.eventCount > 0;
  for (uint32_t i = 0; i < p.range.instanceCount && !p.speaks; ++i) {
    p.speaks = prototypes[instances[p.range.firstInstance + i].prototype].speaks;
  }
  prototypes.push_back(p);
  return static_cast<uint32_t>(prototypes.size() - 1);
}

}  // namespace gable
