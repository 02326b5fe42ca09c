// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/leaf_merger.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <system_error>

#include "base/hash.h"
#include "base/memory.h"
#include "base/work.h"
#include "runtime/recall.h"

namespace gable {

namespace {

constexpr uint32_t kUnset = 0xffffffff;

// So many prototypes or leaves are handed over at once.
constexpr size_t kItemsOfBatch = 256, kLeavesOfBatch = 4096;

// Room is made for so many leaves at once: a few megabytes.
constexpr size_t kLeavesOfRoom = 1 << 15;

// How often who waits looks at the limits.
constexpr std::chrono::milliseconds kBetweenLooks{5};

// In all outputs.
template <class T>
size_t total(const std::vector<Output>& outputs, std::vector<T> Output::*list) {
  size_t sum = 0;
  for (const Output& o : outputs) sum += (o.*list).size();
  return sum;
}

template <class Numbers, class T>
void inverse(const Numbers& numbers, std::vector<T>& out, size_t count) {
  out.assign(count, T{});
  for (const auto& [id, number] : numbers) out[number] = id;
}

bool sameMesh(const Mesh& a, const Mesh& b) {
  if (&a == &b) return true;
  const auto sameFace = [](const MeshFace& f, const MeshFace& g) {
    return f.firstLoop == g.firstLoop && f.loopCount == g.loopCount &&
           f.materialSlot == g.materialSlot && f.smooth == g.smooth && f.tags == g.tags;
  };
  const auto sameLoop = [](const MeshLoop& f, const MeshLoop& g) {
    return f.firstCorner == g.firstCorner && f.cornerCount == g.cornerCount;
  };
  return a.positions == b.positions && a.corners == b.corners && a.uvs == b.uvs &&
         a.notes == b.notes && a.normals == b.normals && a.edgeTags == b.edgeTags &&
         a.vertexTags == b.vertexTags &&
         std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), sameFace) &&
         std::equal(a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(), sameLoop);
}

}  // namespace

LeafMerger::LeafMerger(std::vector<Output>& outputs, const MergeInput& input, Scene& scene,
                       size_t most)
    : outputs_(outputs), input_(input), scene_(scene), workers_(outputs.size()) {
  for (size_t w = 0; w < outputs.size(); ++w) {
    workers_[w].meshes.assign(outputs[w].meshes.size(), kUnset);
    workers_[w].materials.assign(outputs[w].materials.size(), kUnset);
  }
  scene_.attributeSets.emplace_back();
  attributeNumbers_.emplace(0, 0);
  meshNumbers_.reserve(total(outputs, &Output::meshes));
  // A single worker finishes prototypes in the order of the walk, so its leaves stay in place.
  if (staysInPlace()) {
    scene_.leaves = std::move(outputs[0].leaves);
    return;
  }
  // Those of the caller may be there already.
  scene_.leaves.reserve(most);
  if (input.before) {
    const Scene& from = *input.before->scene;
    before_.meshes.assign(from.meshes.size(), kUnset);
    before_.materials.assign(from.materialLists.size(), kUnset);
    before_.names.assign(from.names.size(), kUnset);
    before_.sources.assign(from.sources.size(), kUnset);
    before_.attributes.assign(from.attributeSets.size(), kUnset);
  }
  if (outputs.size() > 1) start();
}

LeafMerger::~LeafMerger() {
  abandoned_ = true;
  {
    const std::lock_guard lock(mutex_);
    complete_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void LeafMerger::start() {
  try {
    thread_ = std::thread([this] { takeAll(); });
  } catch (const std::system_error&) {
    // The machine gives no more threads: each leaf is taken over as it comes.
  }
}

void LeafMerger::addPrototype(StringId name, const Range& leaves) { put({nullptr, name, leaves}); }

void LeafMerger::addLeaves(const Range& leaves) { put({nullptr, kNoName, leaves}); }

void LeafMerger::addRoot(const std::string& name) { put({&name, kNoName, {}}); }

void LeafMerger::put(const Item& item) {
  if (!thread_.joinable()) return take(item);
  batch_.push_back(item);
  leavesOfBatch_ += item.leaves.count;
  if (batch_.size() >= kItemsOfBatch || leavesOfBatch_ >= kLeavesOfBatch) handOver();
}

void LeafMerger::handOver() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(batch_));
  }
  changed_.notify_all();
  batch_.clear();
  leavesHandedOver_ += leavesOfBatch_;
  leavesOfBatch_ = 0;
}

// Has the system give out the memory that the thread is about to write, from its end on, so that
// the thread meets memory that is there: half of its time goes into that otherwise.
void LeafMerger::makeRoom() {
  Leaf* const leaves = scene_.leaves.data();
  for (size_t end = leavesHandedOver_; end > taken_ + 2 * kLeavesOfRoom; end -= kLeavesOfRoom) {
    if (!populate(leaves + end - kLeavesOfRoom, kLeavesOfRoom * sizeof(Leaf))) return;
    work(kWorkBetweenLooks);
  }
}

void LeafMerger::finish() {
  if (thread_.joinable()) {
    handOver();
    {
      const std::lock_guard lock(mutex_);
      complete_ = true;
    }
    changed_.notify_all();
    makeRoom();
    for (bool done = false; !done;) {
      work(kWorkBetweenLooks);
      std::unique_lock lock(mutex_);
      done = changed_.wait_for(lock, kBetweenLooks, [&] { return done_; });
    }
    thread_.join();
    if (thrown_) std::rethrow_exception(thrown_);
  }
  for (size_t i = 0; i < prototypeNames_.size(); ++i)
    scene_.prototypes[i].name = prototypeNames_[i];
  for (size_t i = 0; i < rootNames_.size(); ++i) scene_.roots[i].name = rootNames_[i];
}

// On the thread of its own.
void LeafMerger::takeAll() noexcept {
  try {
    for (;;) {
      std::vector<std::vector<Item>> taken;
      {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !waiting_.empty() || complete_; });
        taken.swap(waiting_);
      }
      if (taken.empty() || abandoned_) break;
      for (const std::vector<Item>& batch : taken) {
        for (const Item& item : batch) {
          if (!abandoned_) take(item);
        }
      }
    }
  } catch (...) {
    thrown_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  done_ = true;
  changed_.notify_all();
}

void LeafMerger::take(const Item& item) {
  if (item.root) {
    rootNames_.push_back(static_cast<uint32_t>(scene_.names.size()));
    scene_.names.push_back(*item.root);
    return;
  }
  if (item.prototypeName != kNoName) prototypeNames_.push_back(nameNumber(item.prototypeName));
  takeLeaves(item.leaves);
}

void LeafMerger::takeLeaves(const Range& range) {
  const bool isTaken = range.worker == outputs_.size();
  Leaf* leaves = nullptr;
  if (staysInPlace()) {
    leaves = scene_.leaves.data() + range.first;
  } else {
    const std::vector<Leaf>& all =
        isTaken ? input_.before->scene->leaves : outputs_[range.worker].leaves;
    const auto from = all.begin() + range.first;
    scene_.leaves.insert(scene_.leaves.end(), from, from + range.count);
    leaves = scene_.leaves.data() + scene_.leaves.size() - range.count;
    taken_ = scene_.leaves.size();
  }
  for (uint32_t i = 0; i < range.count; ++i) {
    work();
    if (isTaken)
      renumberTaken(leaves[i], range);
    else
      renumber(leaves[i], range.worker);
  }
}

void LeafMerger::explain(Recall& recall) const {
  inverse(nameNumbers_, recall.names, scene_.names.size());
  inverse(listNumbers_, recall.materials, scene_.materialLists.size());
  inverse(attributeNumbers_, recall.attributeSets, scene_.attributeSets.size());
  recall.sources.resize(scene_.sources.size());
  for (const auto& [instruction, number] : sourceNumbers_) {
    const int32_t rule = input_.program.ruleAt(instruction);
    if (rule < 0) continue;
    const RuleCode& code = input_.program.rules[static_cast<size_t>(rule)];
    recall.sources[number] = {code.qualifiedName, code.parameters.size(), instruction - code.entry};
  }
}

void LeafMerger::renumber(Leaf& leaf, uint32_t worker) {
  Worker& w = workers_[worker];
  if (leaf.mesh >= kFirstMesh) {
    const uint32_t mesh = leaf.mesh - kFirstMesh;
    uint32_t& known = w.meshes[mesh];
    if (known == kUnset) known = meshNumber(outputs_[worker].meshes[mesh]);
    leaf.mesh = known;
  }
  uint32_t& materials = w.materials[leaf.materials];
  if (materials == kUnset) materials = materialsNumber(outputs_[worker].materials[leaf.materials]);
  leaf.materials = materials;
  // Neighbours often agree, which spares the look-ups.
  if (leaf.name != lastName_.first) lastName_ = {leaf.name, nameNumber(leaf.name)};
  leaf.name = lastName_.second;
  if (leaf.source != lastSource_.first) lastSource_ = {leaf.source, sourceNumber(leaf.source)};
  leaf.source = lastSource_.second;
  if (leaf.attributes == 0) return;
  if (leaf.attributes != lastAttributes_.first) {
    lastAttributes_ = {leaf.attributes, attributesNumber(leaf.attributes)};
  }
  leaf.attributes = lastAttributes_.second;
}

// What the leaf refers to in the scene before, in the order in which renumber() has it.
void LeafMerger::renumberTaken(Leaf& leaf, const Range& range) {
  const Recall& recall = *input_.before->recall;
  const auto now = [](std::vector<uint32_t>& numbers, uint32_t& number, auto&& made) {
    uint32_t& known = numbers[number];
    if (known == kUnset) known = made(number);
    number = known;
  };
  if (leaf.mesh >= kFirstMesh) {
    now(before_.meshes, leaf.mesh,
        [&](uint32_t mesh) { return meshNumber(input_.before->scene->meshes[mesh]); });
  }
  now(before_.materials, leaf.materials,
      [&](uint32_t list) { return materialsNumber(recall.materials[list]); });
  now(before_.names, leaf.name, [&](uint32_t name) { return nameNumber(recall.names[name]); });
  now(before_.sources, leaf.source,
      [&](uint32_t source) { return sourceNumber(input_.before->instructions[source]); });
  if (leaf.attributes == 0) return;
  const uint32_t set = recall.attributeSets[leaf.attributes];
  if (set == range.attributesBefore && set != range.attributesNow) {
    leaf.attributes = range.attributesNow == 0 ? 0 : attributesNumber(range.attributesNow);
    return;
  }
  now(before_.attributes, leaf.attributes, [&](uint32_t) { return attributesNumber(set); });
}

uint32_t LeafMerger::meshNumber(const MeshRef& m) {
  work(m->positions.size());
  // Others of the same hash have the next keys.
  ShareKey key{m->sharedHash(), 0};
  for (; const uint32_t* const at = meshNumbers_.find(key); ++key.b) {
    if (sameMesh(*scene_.meshes[*at], *m)) return *at;
  }
  const auto number = static_cast<uint32_t>(scene_.meshes.size());
  scene_.meshes.push_back(m);
  meshNumbers_.emplace(key, number);
  return number;
}

uint32_t LeafMerger::materialsNumber(uint64_t pair) {
  const auto [at, fresh] =
      listNumbers_.try_emplace(pair, static_cast<uint32_t>(scene_.materialLists.size()));
  if (fresh) {
    std::vector<uint32_t> slots{materialNumber(static_cast<MaterialId>(pair >> 32))};
    for (MaterialId m : input_.attributes.materials(static_cast<uint32_t>(pair))) {
      slots.push_back(materialNumber(m));
    }
    scene_.materialLists.push_back(std::move(slots));
  }
  return at->second;
}

uint32_t LeafMerger::materialNumber(MaterialId id) {
  const auto [at, fresh] =
      materialNumbers_.try_emplace(id, static_cast<uint32_t>(scene_.materials.size()));
  if (fresh) scene_.materials.push_back(input_.materials.get(id));
  return at->second;
}

uint32_t LeafMerger::nameNumber(StringId id) {
  const auto [at, fresh] = nameNumbers_.try_emplace(id, static_cast<uint32_t>(scene_.names.size()));
  if (fresh) scene_.names.emplace_back(input_.program.pool->text(id));
  return at->second;
}

uint32_t LeafMerger::sourceNumber(uint32_t instruction) {
  const auto [at, fresh] =
      sourceNumbers_.try_emplace(instruction, static_cast<uint32_t>(scene_.sources.size()));
  if (fresh) scene_.sources.push_back(placeOf(instruction));
  return at->second;
}

SourcePlace LeafMerger::placeOf(uint32_t instruction) const {
  const Program& p = input_.program;
  const int32_t rule = p.ruleAt(instruction);
  SourcePlace place;
  if (rule < 0) return place;
  const RuleCode& code = p.rules[static_cast<size_t>(rule)];
  place.rule = code.qualifiedName;
  place.file = p.files[code.file];
  const Span span = instruction == code.entry ? code.span : p.spans[instruction];
  if (input_.sources && span.valid()) {
    const LineColumn at = input_.sources->locate(span.file, span.begin);
    place.line = at.line;
    place.column = at.column;
  }
  return place;
}

uint32_t LeafMerger::attributesNumber(uint32_t set) {
  const auto [at, fresh] =
      attributeNumbers_.try_emplace(set, static_cast<uint32_t>(scene_.attributeSets.size()));
  if (!fresh) return at->second;
  const auto& entries = input_.attributes.entries(set);
  std::vector<uint32_t> values;
  values.reserve(entries.size());
  attributeBytes_ += sizeof values + entries.size() * sizeof values[0];
  for (const auto& e : entries) {
    if (attributesFull()) break;
    values.push_back(attributeNumber(e));
  }
  scene_.attributeSets.push_back(std::move(values));
  return at->second;
}

// An import gives each shape all of its attributes, so most sets differ in few values.
uint32_t LeafMerger::attributeNumber(const AttributePool::Entry& entry) {
  const Value& v = entry.value;
  const auto bits = std::bit_cast<uint64_t>(v.number);
  const uint64_t kind = uint64_t{entry.key} << 8 | static_cast<uint64_t>(v.type);
  const ShareKey key{hashCombine(hashCombine(kind, v.id), bits), bits};
  if (const uint32_t* const known = valueNumbers_.find(key)) return *known;
  const auto number = static_cast<uint32_t>(scene_.attributeValues.size());
  attributeBytes_ += bytesOf(v);
  scene_.attributeValues.push_back(
      plainAttribute(input_.program.attributes[entry.key].name, v, *input_.program.pool));
  valueNumbers_.emplace(key, number);
  return number;
}

// What a value takes in the scene.
uint64_t LeafMerger::bytesOf(const Value& v) const {
  const ValuePool& pool = *input_.program.pool;
  if (v.type == ValueType::String) return sizeof(AttributeValue) + pool.text(v.id).size();
  if (!v.isArray()) return sizeof(AttributeValue);
  uint64_t bytes = sizeof(AttributeValue) + pool.array(v).size() * sizeof(PlainValue);
  for (const StringId s : pool.array(v).strings) bytes += pool.text(s).size();
  return bytes;
}

}  // namespace gable
