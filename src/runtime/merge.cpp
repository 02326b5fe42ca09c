// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Merging walks the initial shapes in their order and takes over each prototype after the ones that
// it holds. That is the order in which a single worker finishes them, so one worker or many give
// the same scene. Names, materials, sources and meshes are numbered as this walk first meets them.
// Scenes have millions of leaves, so the walk calls work() and can be left at any time.

#include <algorithm>
#include <unordered_map>

#include "base/check.h"
#include "base/parallel.h"
#include "base/work.h"
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
         a.notes == b.notes && a.normals == b.normals && a.edgeTags == b.edgeTags &&
         a.vertexTags == b.vertexTags &&
         std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), sameFace) &&
         std::equal(a.loops.begin(), a.loops.end(), b.loops.begin(), b.loops.end(), sameLoop);
}

class Merger {
 public:
  Merger(std::vector<Output>& outputs, const std::deque<OutputUnit>& portions,
         const MergeInput& input)
      : outputs_(outputs), portions_(portions), input_(input), workers_(outputs.size()) {
    for (size_t w = 0; w < outputs.size(); ++w) {
      workers_[w].prototypes.assign(outputs[w].prototypes.size(), kUnset);
      workers_[w].meshes.assign(outputs[w].meshes.size(), kUnset);
      workers_[w].materials.assign(outputs[w].materials.size(), kUnset);
    }
    scene_.attributeSets.emplace_back();
    attributeNumbers_.emplace(0, 0);
    // A single worker finishes prototypes in the order of the walk, so its leaves stay in place.
    if (outputs.size() == 1)
      scene_.leaves = std::move(outputs[0].leaves);
    else
      scene_.leaves.reserve(total(&Output::leaves));
    scene_.instances.reserve(total(&Output::instances));
    scene_.prototypes.reserve(total(&Output::prototypes));
    byKey_.reserve(total(&Output::prototypes));
    meshNumbers_.reserve(total(&Output::meshes));
  }

  void addRoot(const OutputUnit& r) {
    const std::vector<Segment> segments = segmentsOf(r);
    const uint32_t prototype =
        segments.size() == 1 ? import(r.worker, r.prototype) : join(segments);
    Root root;
    root.name = static_cast<uint32_t>(scene_.names.size());
    scene_.names.push_back(r.name);
    root.instance = {r.frame, prototype, 0};
    scene_.roots.push_back(root);
    for (const Segment& s : segments) replay(s.worker, s.content, s.from.instances);
  }

  /// Puts a part to where its unit came to lie in the scene.
  void place(RecallPart& part) const {
    const Worker& w = workers_[part.worker];
    const auto at = w.segments.find(uint64_t{part.prototype} << 32 | part.holes);
    part.prototype = w.prototypes[part.prototype];
    if (at == w.segments.end()) return;
    for (Output::Mark* mark : {&part.begin, &part.end}) {
      mark->leaves += at->second.leaves;
      mark->instances += at->second.instances;
      mark->events += at->second.events;
    }
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
    /// By prototype and hole of units that were put together: how far what lies behind the hole
    /// before has been moved. Unsigned differences wrap around, and back again.
    std::unordered_map<uint64_t, Output::Mark> segments;
  };

  // In all outputs.
  template <class T>
  size_t total(std::vector<T> Output::*list) const {
    size_t sum = 0;
    for (const Output& o : outputs_) sum += (o.*list).size();
    return sum;
  }

  /// What lies in a unit between two holes: part of a prototype, and where it begins there.
  struct Segment {
    uint32_t worker = 0, prototype = 0, hole = 0;
    Output::Mark from;
    OutputPrototype content;
  };

  std::vector<Segment> segmentsOf(const OutputUnit& unit) const {
    std::vector<Segment> out;
    forEachSegment(unit, portions_, [&](const OutputUnit& u, size_t hole) {
      const OutputPrototype& whole = outputs_[u.worker].prototypes[u.prototype];
      Segment s{u.worker, u.prototype, static_cast<uint32_t>(hole), {}, whole};
      if (hole > 0) s.from = u.holes[hole - 1].at;
      const Output::Mark end =
          hole < u.holes.size()
              ? u.holes[hole].at
              : Output::Mark{whole.range.leafCount, whole.range.instanceCount, whole.eventCount};
      s.content.range.firstLeaf += s.from.leaves;
      s.content.range.leafCount = end.leaves - s.from.leaves;
      s.content.range.firstInstance += s.from.instances;
      s.content.range.instanceCount = end.instances - s.from.instances;
      s.content.firstEvent += s.from.events;
      s.content.eventCount = end.events - s.from.events;
      // Each unit counts its shapes once.
      if (hole > 0) s.content.range.shapes = 0;
      out.push_back(s);
    });
    return out;
  }

  // One prototype of the scene, of several units.
  uint32_t join(const std::vector<Segment>& segments) {
    for (const Segment& s : segments) {
      const Prototype& range = s.content.range;
      for (uint32_t i = 0; i < range.instanceCount; ++i) {
        import(s.worker, outputs_[s.worker].instances[range.firstInstance + i].prototype);
      }
    }
    Prototype to;
    to.name = nameNumber(segments[0].content.range.name);
    to.firstInstance = static_cast<uint32_t>(scene_.instances.size());
    to.firstLeaf = static_cast<uint32_t>(scene_.leaves.size());
    Recall::PrototypeNotes notes;
    if (input_.recall) notes.firstEvent = static_cast<uint32_t>(input_.recall->events.size());
    const auto number = static_cast<uint32_t>(scene_.prototypes.size());
    for (const Segment& s : segments) {
      Worker& w = workers_[s.worker];
      const Output::Mark shift{to.leafCount - s.from.leaves, to.instanceCount - s.from.instances,
                               notes.eventCount - s.from.events};
      w.prototypes[s.prototype] = number;
      w.segments.emplace(uint64_t{s.prototype} << 32 | s.hole, shift);
      append(s, shift, to);
      if (input_.recall) remember(s, shift, notes);
      to.shapes += s.content.range.shapes;
    }
    to.empty = isEmpty(to);
    scene_.prototypes.push_back(to);
    if (input_.recall) input_.recall->prototypes.push_back(notes);
    return number;
  }

  // Of a prototype that has its leaves and instances.
  bool isEmpty(const Prototype& p) const {
    const Instance* const begin = scene_.instances.data() + p.firstInstance;
    return p.leafCount == 0 && std::all_of(begin, begin + p.instanceCount, [&](const Instance& i) {
             return scene_.prototypes[i.prototype].empty;
           });
  }

  void append(const Segment& s, const Output::Mark& shift, Prototype& to) {
    const Output& from = outputs_[s.worker];
    const Prototype& range = s.content.range;
    for (uint32_t i = 0; i < range.instanceCount; ++i) {
      work();
      Instance& copy = scene_.instances.emplace_back(from.instances[range.firstInstance + i]);
      copy.prototype = workers_[s.worker].prototypes[copy.prototype];
      copy.leavesBefore += shift.leaves;
    }
    for (uint32_t i = 0; i < range.leafCount; ++i) {
      scene_.leaves.push_back(from.leaves[range.firstLeaf + i]);
      renumber(scene_.leaves.back(), s.worker);
    }
    to.instanceCount += range.instanceCount;
    to.leafCount += range.leafCount;
  }

  void remember(const Segment& s, const Output::Mark& shift, Recall::PrototypeNotes& notes) {
    const Output& from = outputs_[s.worker];
    for (uint32_t e = 0; e < s.content.eventCount; ++e) {
      OutputEvent copy = from.events[s.content.firstEvent + e];
      copy.instancesBefore += shift.instances;
      input_.recall->events.push_back(copy);
    }
    notes.eventCount += s.content.eventCount;
    notes.speaks = notes.speaks || s.content.speaks;
  }

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
    const uint32_t* const inScene = byKey_.find(from.key);
    if (inScene) known = *inScene;
    return inScene != nullptr;
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
      work();
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
      work();
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
    to.empty = isEmpty(to);
    scene_.prototypes.push_back(to);
    if (input_.recall) remember(outputs_[worker], from);
    const auto number = static_cast<uint32_t>(scene_.prototypes.size() - 1);
    workers_[worker].prototypes[prototype] = number;
    if (isShared(from)) byKey_.emplace(from.key, number);
  }

  void renumber(Leaf& leaf, uint32_t worker) {
    work();
    if (leaf.mesh >= kFirstMesh) leaf.mesh = meshNumber(worker, leaf.mesh - kFirstMesh);
    leaf.materials = materialsNumber(worker, leaf.materials);
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

  uint32_t meshNumber(uint32_t worker, uint32_t mesh) {
    uint32_t& known = workers_[worker].meshes[mesh];
    if (known != kUnset) return known;
    const MeshRef& m = outputs_[worker].meshes[mesh];
    work(m->positions.size());
    // Others of the same hash have the next keys.
    ShareKey key{m->sharedHash(), 0};
    for (; const uint32_t* const at = meshNumbers_.find(key); ++key.b) {
      if (sameMesh(*scene_.meshes[*at], *m)) return known = *at;
    }
    known = static_cast<uint32_t>(scene_.meshes.size());
    scene_.meshes.push_back(m);
    meshNumbers_.emplace(key, known);
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
  // `before`: instances of the prototype that lie before `content`.
  void replay(uint32_t worker, const OutputPrototype& content, uint32_t before) {
    struct Open {
      const OutputPrototype* prototype;
      uint32_t before, event, instance;
    };
    const Output& out = outputs_[worker];
    std::vector<Open> open{{&content, before, 0, 0}};
    while (!open.empty() && !full()) {
      work();
      Open& top = open.back();
      const OutputPrototype& p = *top.prototype;
      for (; top.event < p.eventCount; ++top.event) {
        const OutputEvent& e = out.events[p.firstEvent + top.event];
        if (e.instancesBefore != top.before + top.instance) break;
        speak(e);
      }
      if (!p.speaks || top.instance == p.range.instanceCount) {
        open.pop_back();
        continue;
      }
      const Instance& next = out.instances[p.range.firstInstance + top.instance++];
      open.push_back({&out.prototypes[next.prototype], 0, 0, 0});
    }
  }

  void speak(const OutputEvent& e) {
    work();
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
  const std::deque<OutputUnit>& portions_;
  const MergeInput& input_;
  std::vector<Worker> workers_;
  /// What was asked for last, and its number.
  std::pair<uint32_t, uint32_t> lastName_{kUnset, 0}, lastSource_{kUnset, 0},
      lastAttributes_{kUnset, 0};
  uint64_t events_ = 0, eventBytes_ = 0, attributeBytes_ = 0;
  Scene scene_;
  KeyNumbers byKey_, meshNumbers_;
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

Merged merge(std::vector<Output>& outputs, const std::vector<const OutputUnit*>& roots,
             const std::deque<OutputUnit>& portions, const MergeInput& input) {
  Merger merger(outputs, portions, input);
  for (const OutputUnit* r : roots) merger.addRoot(*r);
  if (input.recall) {
    for (RecallPart& p : input.recall->parts) merger.place(p);
    merger.explain(*input.recall);
  }
  // Millions of small blocks: each in a worker of its own.
  const auto workers = static_cast<unsigned>(outputs.size());
  parallelFor(workers, workers, [&](size_t w, unsigned) { outputs[w] = {}; });
  outputs.clear();
  return merger.take();
}

}  // namespace gable
