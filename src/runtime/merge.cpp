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
#include "runtime/spare_memory.h"

namespace gable {

namespace {

constexpr uint32_t kUnset = 0xffffffff;

class Merger {
 public:
  Merger(std::vector<Output>& outputs, const std::vector<const OutputUnit*>& roots,
         const std::deque<OutputUnit>& portions, const MergeInput& input)
      : outputs_(outputs),
        portions_(portions),
        input_(input),
        workers_(outputs.size() + 1),
        before_(static_cast<uint32_t>(outputs.size())),
        leaves_(outputs, input, scene_, makeRoom(roots)) {}

  void addRoot(const OutputUnit& r) {
    const std::vector<Segment> segments = segmentsOf(r);
    const uint32_t prototype =
        segments.size() == 1 ? import(r.worker, r.prototype) : joined(r, segments);
    Root root;
    root.instance = {r.frame, prototype, 0};
    scene_.roots.push_back(root);
    leaves_.addRoot(r.name);
    for (const Segment& s : segments) replay(s);
    reportsEnd_.push_back(scene_.reports.size());
  }

  /// Puts a part to where its unit came to lie in the scene.
  void place(RecallPart& part) const {
    const Worker& w = workers_[part.worker];
    const auto move = [&](Output::Mark& mark, uint32_t hole) {
      const auto at = w.segments.find(segmentKey(part.prototype, hole, part.taken));
      if (at == w.segments.end()) return;
      mark.leaves += at->second.leaves;
      mark.instances += at->second.instances;
      mark.events += at->second.events;
    };
    move(part.begin, part.holes);
    move(part.end, part.holesEnd);
    part.prototype = w.prototypes[part.prototype];
  }

  /// What the scene's numbers stand for.
  void explain(Recall& recall) {
    leaves_.explain(recall);
    const auto keyOf = [&](size_t i) { return recall.prototypes[taken_[i]].key; };
    for (size_t i = 0; i < taken_.size(); ++i) {
      if (i + KeyNumbers::kAhead < taken_.size()) byKey_.prefetch(keyOf(i + KeyNumbers::kAhead));
      byKey_.emplace(keyOf(i), taken_[i]);
    }
    recall.prototypeNumbers = std::move(byKey_);
  }

  void finish() { leaves_.finish(); }
  Merged take() {
    return {std::move(scene_), !full(), leaves_.allAttributes(), std::move(reportsEnd_)};
  }

 private:
  /// Who has made prototypes: a worker, or behind the last of them the derivation before.
  struct Worker {
    std::vector<uint32_t> prototypes;
    /// By segmentKey(), of units that were put together: how far what lies there has been moved.
    /// Unsigned differences wrap around, and back again.
    std::unordered_map<uint64_t, Output::Mark> segments;
  };

  /// What lies in a unit between two holes, or in a hole from the scene before: a part of a
  /// prototype, and where it begins there.
  struct Segment {
    uint32_t worker = 0, prototype = 0;
    Output::Mark from;
    OutputPrototype content;
    /// Where RecallParts look for it.
    uint32_t unitWorker = 0;
    uint64_t key = 0;
  };

  static uint64_t segmentKey(uint32_t prototype, size_t hole, bool taken) {
    return uint64_t{prototype} << 32 | static_cast<uint64_t>(hole) << 1 | uint64_t{taken};
  }

  // Room for what the outputs hold and what they have taken over. The number of leaves at most.
  size_t makeRoom(const std::vector<const OutputUnit*>& roots) {
    size_t instances = 0, prototypes = 0, leaves = 0, takenAsTheyWere = 0;
    for (size_t w = 0; w < outputs_.size(); ++w) {
      const Output& from = outputs_[w];
      workers_[w].prototypes.assign(from.prototypes.size(), kUnset);
      instances += from.instances.size() + from.takenInstances.size();
      prototypes += from.prototypes.size();
      leaves += from.leaves.size();
      for (const OutputPrototype& p : from.prototypes) {
        if (p.isTaken() && p.isChanged()) leaves += p.range.leafCount;
        takenAsTheyWere += p.isTaken() && !p.isChanged();
      }
    }
    if (input_.before) {
      const Scene& scene = *input_.before->scene;
      workers_[before_].prototypes.assign(scene.prototypes.size(), kUnset);
      instances += scene.instances.size();
      prototypes += scene.prototypes.size();
      leaves += scene.leaves.size();
      const auto addHoles = [&](const OutputUnit& unit) {
        for (const OutputHole& hole : unit.holes) {
          if (!hole.taken) continue;
          leaves += hole.taken->end.leaves - hole.taken->begin.leaves;
          instances += hole.taken->end.instances - hole.taken->begin.instances;
        }
      };
      for (const OutputUnit* unit : roots) addHoles(*unit);
      for (const OutputUnit& unit : portions_) addHoles(unit);
    }
    SpareBlocks none;
    SpareBlocks& spare = input_.spare ? *input_.spare : none;
    scene_.instances = withRoom(std::move(spare.instances), instances);
    scene_.prototypes = withRoom(std::move(spare.prototypes), prototypes);
    if (input_.before) scene_.leaves = withRoom(std::move(spare.leaves), leaves);
    if (input_.recall) input_.recall->prototypes = withRoom(std::move(spare.notes), prototypes);
    byKey_ = std::move(spare.prototypeNumbers);
    byKey_.restart(prototypes - takenAsTheyWere);
    return leaves;
  }

  // What a worker made, or the derivation before.

  const Prototype& rangeOf(uint32_t worker, uint32_t prototype) const {
    return worker == before_ ? input_.before->scene->prototypes[prototype]
                             : outputs_[worker].prototypes[prototype].range;
  }
  const Instance* instancesOf(uint32_t worker) const {
    return (worker == before_ ? input_.before->scene->instances : outputs_[worker].instances)
        .data();
  }
  const OutputEvent* eventsOf(uint32_t worker) const {
    return (worker == before_ ? input_.before->recall->events : outputs_[worker].events).data();
  }
  /// The number in the scene before of a prototype that comes from there; OutputPrototype::kOwn.
  uint32_t takenOf(uint32_t worker, uint32_t prototype) const {
    return worker == before_ ? prototype : outputs_[worker].prototypes[prototype].taken;
  }
  /// The worker's number of what it holds in the place of an instance.
  uint32_t innerOf(uint32_t worker, uint32_t prototype, uint32_t instance) const {
    const uint32_t at = rangeOf(worker, prototype).firstInstance + instance;
    if (worker != before_ && outputs_[worker].prototypes[prototype].isTaken()) {
      return outputs_[worker].takenInstances[at];
    }
    return instancesOf(worker)[at].prototype;
  }

  std::vector<Segment> segmentsOf(const OutputUnit& unit) const {
    std::vector<Segment> out;
    const auto own = [&](const OutputUnit& u, size_t hole) {
      const OutputPrototype& whole = outputs_[u.worker].prototypes[u.prototype];
      const Output::Mark begin = hole > 0 ? u.holes[hole - 1].at : Output::Mark{};
      const Output::Mark end =
          hole < u.holes.size()
              ? u.holes[hole].at
              : Output::Mark{whole.range.leafCount, whole.range.instanceCount, whole.eventCount};
      Segment s{u.worker, u.prototype, begin,
                whole,    u.worker,    segmentKey(u.prototype, hole, false)};
      cut(s, end);
      // Each unit counts its shapes once.
      if (hole > 0) s.content.range.shapes = 0;
      out.push_back(s);
    };
    const auto taken = [&](const OutputUnit& u, size_t hole) {
      const RecallPart& part = *u.holes[hole].taken;
      const Recall::PrototypeNotes& notes = input_.before->recall->prototypes[part.prototype];
      Segment s{before_, part.prototype, part.begin,
                {},      u.worker,       segmentKey(u.prototype, hole, true)};
      s.content.range = rangeOf(before_, part.prototype);
      s.content.firstEvent = notes.firstEvent;
      s.content.speaks = notes.speaks;
      cut(s, part.end);
      // The unit has counted them.
      s.content.range.shapes = 0;
      out.push_back(s);
    };
    forEachSegment(unit, portions_, own, taken);
    return out;
  }

  // Leaves of a whole prototype what lies from the begin of the segment to its end.
  static void cut(Segment& s, const Output::Mark& end) {
    s.content.range.firstLeaf += s.from.leaves;
    s.content.range.leafCount = end.leaves - s.from.leaves;
    s.content.range.firstInstance += s.from.instances;
    s.content.range.instanceCount = end.instances - s.from.instances;
    s.content.firstEvent += s.from.events;
    s.content.eventCount = end.events - s.from.events;
  }

  // The prototype of a root of several units, which an equal root may have already.
  uint32_t joined(const OutputUnit& root, const std::vector<Segment>& segments) {
    const ShareKey key = keyOf(root.worker, root.prototype);
    if (!isShared(key)) return join(segments);
    const uint32_t* const known = byKey_.find(key);
    const uint32_t number = known ? *known : join(segments);
    if (!known) byKey_.emplace(key, number);
    return number;
  }

  // One prototype of the scene, of several units.
  uint32_t join(const std::vector<Segment>& segments) {
    for (const Segment& s : segments) {
      const Prototype& range = s.content.range;
      const Instance* const from = instancesOf(s.worker) + range.firstInstance;
      for (uint32_t i = 0; i < range.instanceCount; ++i) import(s.worker, from[i].prototype);
    }
    Prototype to;
    leaves_.addPrototype(segments[0].content.range.name, {});
    to.firstInstance = static_cast<uint32_t>(scene_.instances.size());
    to.firstLeaf = leafCount_;
    Recall::PrototypeNotes notes;
    if (input_.recall) notes.firstEvent = static_cast<uint32_t>(input_.recall->events.size());
    const auto number = static_cast<uint32_t>(scene_.prototypes.size());
    for (const Segment& s : segments) {
      const Output::Mark shift{to.leafCount - s.from.leaves, to.instanceCount - s.from.instances,
                               notes.eventCount - s.from.events};
      if (s.worker != before_) workers_[s.worker].prototypes[s.prototype] = number;
      workers_[s.unitWorker].segments.emplace(s.key, shift);
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
    const Prototype& range = s.content.range;
    const Instance* const from = instancesOf(s.worker) + range.firstInstance;
    for (uint32_t i = 0; i < range.instanceCount; ++i) {
      work();
      Instance& copy = scene_.instances.emplace_back(from[i]);
      copy.prototype = workers_[s.worker].prototypes[copy.prototype];
      copy.leavesBefore += shift.leaves;
    }
    leaves_.addLeaves({s.worker, range.firstLeaf, range.leafCount});
    leafCount_ += range.leafCount;
    to.instanceCount += range.instanceCount;
    to.leafCount += range.leafCount;
  }

  void remember(const Segment& s, const Output::Mark& shift, Recall::PrototypeNotes& notes) {
    const OutputEvent* const from = eventsOf(s.worker) + s.content.firstEvent;
    for (uint32_t e = 0; e < s.content.eventCount; ++e) {
      OutputEvent copy = from[e];
      copy.instancesBefore += shift.instances;
      input_.recall->events.push_back(copy);
    }
    notes.eventCount += s.content.eventCount;
    notes.speaks = notes.speaks || s.content.speaks;
  }

  void remember(uint32_t worker, uint32_t prototype) {
    Recall& recall = *input_.recall;
    Recall::PrototypeNotes notes;
    const uint32_t taken = takenOf(worker, prototype);
    if (taken != OutputPrototype::kOwn) notes = input_.before->recall->prototypes[taken];
    if (worker != before_) {
      const OutputPrototype& p = outputs_[worker].prototypes[prototype];
      notes.key = p.key;
      notes.attributes = p.attributes;
      notes.speaks = p.speaks;
      if (!p.isTaken()) notes.firstEvent = p.firstEvent, notes.eventCount = p.eventCount;
    }
    const OutputEvent* const events =
        eventsOf(taken == OutputPrototype::kOwn ? worker : before_) + notes.firstEvent;
    notes.firstEvent = static_cast<uint32_t>(recall.events.size());
    recall.events.insert(recall.events.end(), events, events + notes.eventCount);
    recall.prototypes.push_back(notes);
  }

  ShareKey keyOf(uint32_t worker, uint32_t prototype) const {
    return worker == before_ ? input_.before->recall->prototypes[prototype].key
                             : outputs_[worker].prototypes[prototype].key;
  }
  static bool isShared(const ShareKey& key) { return key.a != 0 || key.b != 0; }

  // True where the scene has a worker's prototype, or an equal one. What is taken over as it was
  // comes from the scene before, and has a key that nothing else has.
  bool imported(uint32_t worker, uint32_t prototype) {
    uint32_t& known = workers_[worker].prototypes[prototype];
    if (known != kUnset) return true;
    if (worker == before_) return false;
    const OutputPrototype& from = outputs_[worker].prototypes[prototype];
    if (from.isTaken() && !from.isChanged()) {
      known = import(before_, from.taken);
      return true;
    }
    if (!isShared(from.key)) return false;
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
    if (imported(worker, prototype)) return workers_[worker].prototypes[prototype];
    std::vector<Open> open{{prototype, 0}};
    while (!open.empty()) {
      work();
      Open& top = open.back();
      if (top.next < rangeOf(worker, top.prototype).instanceCount) {
        const uint32_t inner = innerOf(worker, top.prototype, top.next++);
        if (!imported(worker, inner)) open.push_back({inner, 0});
        continue;
      }
      takeOver(worker, top.prototype);
      open.pop_back();
    }
    return workers_[worker].prototypes[prototype];
  }

  void takeOver(uint32_t worker, uint32_t prototype) {
    const uint32_t taken = takenOf(worker, prototype);
    const uint32_t source = taken == OutputPrototype::kOwn ? worker : before_;
    const Prototype& content = rangeOf(source, source == worker ? prototype : taken);
    const Prototype& range = rangeOf(worker, prototype);
    Prototype to = range;
    to.firstInstance = static_cast<uint32_t>(scene_.instances.size());
    const Instance* const from = instancesOf(source) + content.firstInstance;
    for (uint32_t i = 0; i < range.instanceCount; ++i) {
      work();
      const uint32_t inner = innerOf(worker, prototype, i);
      Instance& copy = scene_.instances.emplace_back(from[i]);
      copy.prototype = workers_[worker].prototypes[inner];
    }
    LeafMerger::Range leaves{source, content.firstLeaf, content.leafCount};
    StringId name = range.name;
    if (worker == before_) {
      name = input_.before->recall->names[name];
    } else {
      leaves.attributesBefore = outputs_[worker].prototypes[prototype].attributesBefore;
      leaves.attributesNow = outputs_[worker].prototypes[prototype].attributesNow;
    }
    if (outputs_.size() > 1 || input_.before) to.firstLeaf = leafCount_;
    leaves_.addPrototype(name, leaves);
    leafCount_ += range.leafCount;
    to.empty = isEmpty(to);
    scene_.prototypes.push_back(to);
    if (input_.recall) remember(worker, prototype);
    const auto number = static_cast<uint32_t>(scene_.prototypes.size() - 1);
    workers_[worker].prototypes[prototype] = number;
    const ShareKey key = keyOf(worker, prototype);
    if (!isShared(key)) return;
    if (worker == before_ && input_.recall)
      taken_.push_back(number);
    else
      byKey_.emplace(key, number);
  }

  bool full() const { return events_ > input_.mostEvents || eventBytes_ > input_.mostEventBytes; }

  /// What a prototype, or a segment of one, reports and prints.
  struct Speech {
    uint32_t worker = 0, prototype = 0;
    const OutputEvent* events = nullptr;
    uint32_t eventCount = 0, firstInstance = 0, instanceCount = 0;
    bool speaks = false;
    /// Those that come next.
    uint32_t event = 0, instance = 0;
  };

  Speech speechOf(uint32_t worker, uint32_t prototype) const {
    const uint32_t count = rangeOf(worker, prototype).instanceCount;
    const uint32_t taken = takenOf(worker, prototype);
    if (taken == OutputPrototype::kOwn) {
      const OutputPrototype& p = outputs_[worker].prototypes[prototype];
      return {worker, prototype, eventsOf(worker) + p.firstEvent, p.eventCount, 0, count, p.speaks};
    }
    const Recall::PrototypeNotes& notes = input_.before->recall->prototypes[taken];
    const bool isChanged = worker != before_ && outputs_[worker].prototypes[prototype].isChanged();
    return {isChanged ? worker : before_,
            isChanged ? prototype : taken,
            eventsOf(before_) + notes.firstEvent,
            notes.eventCount,
            0,
            count,
            notes.speaks};
  }

  // Instances multiply: a few nested calls can stand for more prints than memory holds.
  void replay(const Segment& s) {
    std::vector<Speech> open{{s.worker, s.prototype, eventsOf(s.worker) + s.content.firstEvent,
                              s.content.eventCount, s.from.instances, s.content.range.instanceCount,
                              s.content.speaks}};
    while (!open.empty() && !full()) {
      work();
      Speech& top = open.back();
      for (; top.event < top.eventCount; ++top.event) {
        const OutputEvent& e = top.events[top.event];
        if (e.instancesBefore != top.firstInstance + top.instance) break;
        speak(e);
      }
      if (!top.speaks || top.instance == top.instanceCount) {
        open.pop_back();
        continue;
      }
      const uint32_t next = innerOf(top.worker, top.prototype, top.firstInstance + top.instance++);
      open.push_back(speechOf(top.worker, next));
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
  /// The number among the workers of the derivation before.
  const uint32_t before_;
  uint64_t events_ = 0, eventBytes_ = 0;
  uint32_t leafCount_ = 0;
  std::vector<size_t> reportsEnd_;
  Scene scene_;
  KeyNumbers byKey_;
  /// Of the scene, those from the scene before whose keys byKey_ lacks until explain(): nobody
  /// looks for them here.
  std::vector<uint32_t> taken_;
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
  Merger merger(outputs, roots, portions, input);
  for (const OutputUnit* r : roots) merger.addRoot(*r);
  merger.finish();
  if (input.recall) {
    for (RecallPart& p : input.recall->parts) merger.place(p);
    merger.explain(*input.recall);
  }
  // Millions of small blocks: each in a worker of its own.
  const auto workers = static_cast<unsigned>(outputs.size());
  parallelFor(workers, workers, [&](size_t w, unsigned) { outputs[w].drop(); });
  return merger.take();
}

}  // namespace gable
