// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Merging walks the initial shapes in their order and takes over each prototype after the ones that
// it holds. That is the order in which a single worker finishes them, so one worker or many give
// the same scene. What leaves refer to is numbered as this walk first meets it (LeafMerger).
// Scenes have millions of leaves, so the walk calls work() and can be left at any time.

#include <algorithm>
#include <unordered_map>

#include "base/check.h"
#include "base/parallel.h"
#include "base/work.h"
#include "runtime/leaf_merger.h"
#include "runtime/recall.h"

namespace gable {

namespace {

constexpr uint32_t kUnset = 0xffffffff;

class Merger {
 public:
  Merger(std::vector<Output>& outputs, const std::deque<OutputUnit>& portions,
         const MergeInput& input)
      : outputs_(outputs),
        portions_(portions),
        input_(input),
        workers_(outputs.size()),
        leaves_(outputs, input, scene_) {
    size_t instances = 0, prototypes = 0;
    for (size_t w = 0; w < outputs.size(); ++w) {
      workers_[w].prototypes.assign(outputs[w].prototypes.size(), kUnset);
      instances += outputs[w].instances.size();
      prototypes += outputs[w].prototypes.size();
    }
    scene_.instances.reserve(instances);
    scene_.prototypes.reserve(prototypes);
    if (input.recall) input.recall->prototypes.reserve(prototypes);
    byKey_.reserve(prototypes);
  }

  void addRoot(const OutputUnit& r) {
    const std::vector<Segment> segments = segmentsOf(r);
    const uint32_t prototype =
        segments.size() == 1 ? import(r.worker, r.prototype) : join(segments);
    Root root;
    root.instance = {r.frame, prototype, 0};
    scene_.roots.push_back(root);
    leaves_.addRoot(r.name);
    for (const Segment& s : segments) replay(s.worker, s.content, s.from.instances);
    reportsEnd_.push_back(scene_.reports.size());
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
    leaves_.explain(recall);
    recall.prototypeNumbers = std::move(byKey_);
  }

  void finish() { leaves_.finish(); }
  Merged take() {
    return {std::move(scene_), !full(), leaves_.allAttributes(), std::move(reportsEnd_)};
  }

 private:
  struct Worker {
    std::vector<uint32_t> prototypes;
    /// By prototype and hole of units that were put together: how far what lies behind the hole
    /// before has been moved. Unsigned differences wrap around, and back again.
    std::unordered_map<uint64_t, Output::Mark> segments;
  };

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
    leaves_.addPrototype(segments[0].content.range.name, 0, 0, 0);
    to.firstInstance = static_cast<uint32_t>(scene_.instances.size());
    to.firstLeaf = leafCount_;
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
    leaves_.addLeaves(s.worker, range.firstLeaf, range.leafCount);
    leafCount_ += range.leafCount;
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

  void remember(const Output& output, const OutputPrototype& p) {
    Recall& recall = *input_.recall;
    recall.prototypes.push_back(
        {p.key, static_cast<uint32_t>(recall.events.size()), p.eventCount, p.speaks, p.attributes});
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
    to.firstInstance = static_cast<uint32_t>(scene_.instances.size());
    for (uint32_t i = 0; i < from.range.instanceCount; ++i) {
      work();
      Instance& copy =
          scene_.instances.emplace_back(outputs_[worker].instances[from.range.firstInstance + i]);
      copy.prototype = workers_[worker].prototypes[copy.prototype];
    }
    if (outputs_.size() > 1) to.firstLeaf = leafCount_;
    leaves_.addPrototype(from.range.name, worker, from.range.firstLeaf, from.range.leafCount);
    leafCount_ += from.range.leafCount;
    to.empty = isEmpty(to);
    scene_.prototypes.push_back(to);
    if (input_.recall) remember(outputs_[worker], from);
    const auto number = static_cast<uint32_t>(scene_.prototypes.size() - 1);
    workers_[worker].prototypes[prototype] = number;
    if (isShared(from)) byKey_.emplace(from.key, number);
  }

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
  uint64_t events_ = 0, eventBytes_ = 0;
  uint32_t leafCount_ = 0;
  std::vector<size_t> reportsEnd_;
  Scene scene_;
  KeyNumbers byKey_;
  LeafMerger leaves_;
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
  merger.finish();
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
