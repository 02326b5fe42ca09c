// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Merging walks the initial shapes in their order and takes over each prototype after the ones that
// it holds. That is the order in which a single worker finishes them, so one worker or many give
// the same scene. Names, materials, sources and meshes are numbered as this walk first meets them.

#include <algorithm>
#include <unordered_map>

#include "base/check.h"
#include "runtime/recall.h"

namespace gable {

namespace {

constexpr uint32_t kUnset = 0xffffffff;

bool sameMesh(const Mesh& a, const Mesh& b) {
  const auto sameFace = [](const MeshFace& f, const MeshFace& g) {
    return f.firstLoop == g.firstLoop && f.loopCount == g.loopCount &&
           f.materialSlot == g.materialSlot && f.smooth == g.smooth && f.tags == g.tags;
  };
  const auto sameLoop = [](const MeshLoop& f, const MeshLoop& g) {
    return f.firstCorner == g.firstCorner && f.cornerCount == g.cornerCount;
  };
  return a.positions == b.positions && a.corners == b.corners && a.uvs == b.uvs &&
         a.normals == b.normals && a.edgeTags == b.edgeTags &&
         std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), sameFace) &&
         std::equal(a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(), sameLoop);
}

class Merger {
 public:
  Merger(std::vector<Output>& outputs, const MergeInput& input)
      : outputs_(outputs), input_(input), workers_(outputs.size()) {
    for (size_t w = 0; w < outputs.size(); ++w) {
      workers_[w].prototypes.assign(outputs[w].prototypes.size(), kUnset);
      workers_[w].meshes.assign(outputs[w].meshes.size(), kUnset);
      workers_[w].materials.assign(outputs[w].materials.size(), kUnset);
    }
    scene_.attributeSets.emplace_back();
    attributeNumbers_.emplace(0, 0);
    // A single worker finishes prototypes in the order of the walk, so its leaves stay in place.
    if (outputs.size() == 1) scene_.leaves = std::move(outputs[0].leaves);
  }

  void addRoot(const OutputRoot& r) {
    const uint32_t prototype = import(r.worker, r.prototype);
    Root root;
    root.name = static_cast<uint32_t>(scene_.names.size());
    scene_.names.push_back(r.name);
    root.instance = {r.frame, prototype, 0};
    scene_.roots.push_back(root);
    replay(r.worker, r.prototype);
  }

  /// The number in the scene of a worker's finished prototype.
  uint32_t numberOf(uint32_t worker, uint32_t prototype) const {
    return workers_[worker].prototypes[prototype];
  }

  /// What the scene's numbers stand for.
  void explain(Recall& recall) {
    inverse(nameNumbers_, recall.names, scene_.names.size());
    inverse(listNumbers_, recall.materials, scene_.materialLists.size());
    inverse(attributeNumbers_, recall.attributeSets, scene_.attributeSets.size());
    recall.sources.resize(scene_.sources.size());
    for (const auto& [instruction, number] : sourceNumbers_) {
      const int32_t rule = input_.program.ruleAt(instruction);
      if (rule < 0) continue;
      const RuleCode& code = input_.program.rules[static_cast<size_t>(rule)];
      recall.sources[number] = {code.qualifiedName, code.parameters.size(),
                                instruction - code.entry};
    }
    recall.prototypeNumbers = std::move(byKey_);
  }

  Merged take() { return {std::move(scene_), !full(), !attributesFull()}; }

 private:
  struct Worker {
    std::vector<uint32_t> prototypes, meshes, materials;
  };

  template <class Numbers, class T>
  static void inverse(const Numbers& numbers, std::vector<T>& out, size_t count) {
    out.assign(count, T{});
    for (const auto& [id, number] : numbers) out[number] = id;
  }

  void remember(const Output& output, const OutputPrototype& p) {
    Recall& recall = *input_.recall;
    recall.prototypes.push_back(
        {p.key, static_cast<uint32_t>(recall.events.size()), p.eventCount, p.speaks});
    recall.events.insert(recall.events.end(), output.events.begin() + p.firstEvent,
                         output.events.begin() + p.firstEvent + p.eventCount);
  }

  static bool isShared(const OutputPrototype& p) { return p.key.a != 0 || p.key.b != 0; }

  // True where the scene has a worker's prototype, or an equal one.
  bool imported(uint32_t worker, uint32_t prototype) {
    uint32_t& known = workers_[worker].prototypes[prototype];
    if (known != kUnset) return true;
    const OutputPrototype& from = outputs_[worker].prototypes[prototype];
    if (!isShared(from)) return false;
    const auto at = byKey_.find(from.key);
    if (at != byKey_.end()) known = at->second;
    return at != byKey_.end();
  }

  // The scene's number of a worker's prototype, which comes after those that it holds. Shared calls
  // nest as deep as rules do, so the prototypes at work are a list.
  uint32_t import(uint32_t worker, uint32_t prototype) {
    struct Open {
      uint32_t prototype, next;
    };
    std::vector<Open> open;
    if (!imported(worker, prototype)) open.push_back({prototype, 0});
    while (!open.empty()) {
      Open& top = open.back();
      const Prototype& range = outputs_[worker].prototypes[top.prototype].range;
      if (top.next < range.instanceCount) {
        const uint32_t inner =
            outputs_[worker].instances[range.firstInstance + top.next++].prototype;
        if (!imported(worker, inner)) open.push_back({inner, 0});
        continue;
      }
      takeOver(worker, top.prototype);
      open.pop_back();
    }
    return workers_[worker].prototypes[prototype];
  }

  void takeOver(uint32_t worker, uint32_t prototype) {
    const OutputPrototype& from = outputs_[worker].prototypes[prototype];
    Prototype to = from.range;
    to.name = nameNumber(from.range.name);
    to.firstInstance = static_cast<uint32_t>(scene_.instances.size());
    for (uint32_t i = 0; i < from.range.instanceCount; ++i) {
      Instance& copy =
          scene_.instances.emplace_back(outputs_[worker].instances[from.range.firstInstance + i]);
      copy.prototype = workers_[worker].prototypes[copy.prototype];
    }
    if (outputs_.size() == 1) {
      Leaf* leaves = scene_.leaves.data() + from.range.firstLeaf;
      for (uint32_t i = 0; i < from.range.leafCount; ++i) renumber(leaves[i], worker);
    } else {
      to.firstLeaf = static_cast<uint32_t>(scene_.leaves.size());
      for (uint32_t i = 0; i < from.range.leafCount; ++i) {
        scene_.leaves.push_back(outputs_[worker].leaves[from.range.firstLeaf + i]);
        renumber(scene_.leaves.back(), worker);
      }
    }
    scene_.prototypes.push_back(to);
    if (input_.recall) remember(outputs_[worker], from);
    const auto number = static_cast<uint32_t>(scene_.prototypes.size() - 1);
    workers_[worker].prototypes[prototype] = number;
    if (isShared(from)) byKey_.emplace(from.key, number);
  }

  void renumber(Leaf& leaf, uint32_t worker) {
    if (leaf.mesh >= kFirstMesh) leaf.mesh = meshNumber(worker, leaf.mesh - kFirstMesh);
    leaf.materials = materialsNumber(worker, leaf.materials);
    // Neighbours often agree, which spares the look-ups.
    if (leaf.name != lastName_.first) lastName_ = {leaf.name, nameNumber(leaf.name)};
    leaf.name = lastName_.second;
    if (leaf.source != lastSource_.first) lastSource_ = {leaf.source, sourceNumber(leaf.source)};
    leaf.source = lastSource_.second;
    if (leaf.attributes != 0) leaf.attributes = attributesNumber(leaf.attributes);
  }

  uint32_t meshNumber(uint32_t worker, uint32_t mesh) {
    uint32_t& known = workers_[worker].meshes[mesh];
    if (known != kUnset) return known;
    const MeshRef& m = outputs_[worker].meshes[mesh];
    const uint64_t hash = m->sharedHash();
    auto [first, last] = meshNumbers_.equal_range(hash);
    for (; first != last; ++first) {
      if (sameMesh(*scene_.meshes[first->second], *m)) return known = first->second;
    }
    known = static_cast<uint32_t>(scene_.meshes.size());
    scene_.meshes.push_back(m);
    meshNumbers_.emplace(hash, known);
    return known;
  }

  uint32_t materialsNumber(uint32_t worker, uint32_t list) {
    uint32_t& known = workers_[worker].materials[list];
    if (known != kUnset) return known;
    const uint64_t pair = outputs_[worker].materials[list];
    const auto [at, fresh] =
        listNumbers_.try_emplace(pair, static_cast<uint32_t>(scene_.materialLists.size()));
    if (fresh) {
      std::vector<uint32_t> slots{materialNumber(static_cast<MaterialId>(pair >> 32))};
      for (MaterialId m : input_.attributes.materials(static_cast<uint32_t>(pair))) {
        slots.push_back(materialNumber(m));
      }
      scene_.materialLists.push_back(std::move(slots));
    }
    return known = at->second;
  }

  uint32_t materialNumber(MaterialId id) {
    const auto [at, fresh] =
        materialNumbers_.try_emplace(id, static_cast<uint32_t>(scene_.materials.size()));
    if (fresh) scene_.materials.push_back(input_.materials.get(id));
    return at->second;
  }

  uint32_t nameNumber(StringId id) {
    const auto [at, fresh] =
        nameNumbers_.try_emplace(id, static_cast<uint32_t>(scene_.names.size()));
    if (fresh) scene_.names.emplace_back(input_.program.pool->text(id));
    return at->second;
  }

  uint32_t sourceNumber(uint32_t instruction) {
    const auto [at, fresh] =
        sourceNumbers_.try_emplace(instruction, static_cast<uint32_t>(scene_.sources.size()));
    if (fresh) scene_.sources.push_back(placeOf(instruction));
    return at->second;
  }

  SourcePlace placeOf(uint32_t instruction) const {
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

  uint32_t attributesNumber(uint32_t set) {
    const auto [at, fresh] =
        attributeNumbers_.try_emplace(set, static_cast<uint32_t>(scene_.attributeSets.size()));
    if (!fresh) return at->second;
    for (const auto& e : input_.attributes.entries(set)) attributeBytes_ += bytesOf(e.value);
    std::vector<AttributeValue> values;
    for (const auto& e : input_.attributes.entries(set)) {
      if (attributesFull()) break;
      values.push_back(
          plainAttribute(input_.program.attributes[e.key].name, e.value, *input_.program.pool));
    }
    scene_.attributeSets.push_back(std::move(values));
    return at->second;
  }

  // What a value takes in the scene.
  uint64_t bytesOf(const Value& v) const {
    const ValuePool& pool = *input_.program.pool;
    if (v.type == ValueType::String) return sizeof(AttributeValue) + pool.text(v.id).size();
    if (!v.isArray()) return sizeof(AttributeValue);
    uint64_t bytes = sizeof(AttributeValue) + pool.array(v).size() * sizeof(PlainValue);
    for (const StringId s : pool.array(v).strings) bytes += pool.text(s).size();
    return bytes;
  }

  bool attributesFull() const { return attributeBytes_ > input_.mostAttributeBytes; }

  bool full() const { return events_ > input_.mostEvents || eventBytes_ > input_.mostEventBytes; }

  // Instances multiply: a few nested calls can stand for more prints than memory holds.
  void replay(uint32_t worker, uint32_t prototype) {
    struct Open {
      const OutputPrototype* prototype;
      uint32_t event, instance;
    };
    const Output& out = outputs_[worker];
    std::vector<Open> open{{&out.prototypes[prototype], 0, 0}};
    while (!open.empty() && !full()) {
      Open& top = open.back();
      const OutputPrototype& p = *top.prototype;
      for (; top.event < p.eventCount; ++top.event) {
        const OutputEvent& e = out.events[p.firstEvent + top.event];
        if (e.instancesBefore != top.instance) break;
        speak(e);
      }
      if (!p.speaks || top.instance == p.range.instanceCount) {
        open.pop_back();
        continue;
      }
      const Instance& next = out.instances[p.range.firstInstance + top.instance++];
      open.push_back({&out.prototypes[next.prototype], 0, 0});
    }
  }

  void speak(const OutputEvent& e) {
    const ValuePool& pool = *input_.program.pool;
    const std::string_view text = pool.text(e.text);
    ++events_;
    eventBytes_ += text.size();
    if (e.print) {
      if (!full()) scene_.prints.emplace_back(text);
      return;
    }
    PlainValue value = plainValue(e.value, pool);
    eventBytes_ += value.text.size();
    if (!full()) scene_.reports.push_back({std::string(text), std::move(value)});
  }

  std::vector<Output>& outputs_;
  const MergeInput& input_;
  std::vector<Worker> workers_;
  /// What was asked for last, and its number.
  std::pair<uint32_t, uint32_t> lastName_{kUnset, 0}, lastSource_{kUnset, 0};
  uint64_t events_ = 0, eventBytes_ = 0, attributeBytes_ = 0;
  Scene scene_;
  PrototypeNumbers byKey_;
  std::unordered_multimap<uint64_t, uint32_t> meshNumbers_;
  std::unordered_map<uint64_t, uint32_t> listNumbers_;
  std::unordered_map<uint32_t, uint32_t> materialNumbers_, nameNumbers_, sourceNumbers_,
      attributeNumbers_;
};

}  // namespace

PlainValue plainValue(const Value& v, const ValuePool& pool) {
  switch (v.type) {
    case ValueType::Float: return {PlainValue::Kind::Number, v.number, {}};
    case ValueType::Bool: return {PlainValue::Kind::Bool, v.number, {}};
    default: return {PlainValue::Kind::Text, 0, pool.str(v)};
  }
}

AttributeValue plainAttribute(const std::string& name, const Value& v, const ValuePool& pool) {
  AttributeValue out{name, {}, 0, 0};
  if (!v.isArray()) {
    out.values.push_back(plainValue(v, pool));
    return out;
  }
  const Array& a = pool.array(v);
  out.rows = a.rows;
  out.columns = a.columns;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a.element == ValueType::String) {
      out.values.push_back({PlainValue::Kind::Text, 0, std::string(pool.text(a.strings[i]))});
    } else {
      const bool isBool = a.element == ValueType::Bool;
      out.values.push_back(
          {isBool ? PlainValue::Kind::Bool : PlainValue::Kind::Number, a.numbers[i], {}});
    }
  }
  return out;
}

Merged merge(std::vector<Output>& outputs, const std::vector<OutputRoot>& roots,
             const MergeInput& input) {
  Merger merger(outputs, input);
  for (const OutputRoot& r : roots) merger.addRoot(r);
  if (input.recall) {
    for (RecallPart& p : input.recall->parts) p.prototype = merger.numberOf(p.worker, p.prototype);
    merger.explain(*input.recall);
  }
  outputs.clear();
  return merger.take();
}

}  // namespace gable
