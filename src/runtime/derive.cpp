// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One machine a worker takes initial shapes in turn; the outputs are merged in the order of the
// shapes. When rules ask about other shapes (inside, touches, ...) or for room among them (ifFree)
// there are two passes: the first collects occluders and claims and is thrown away, the second asks
// them.
//
// Where several workers together reach a limit on counts, what they made depends on which was
// faster. Then all is thrown away, and one worker alone goes as far as it may: whatever the number
// of workers, the result and the messages are those of one. Several never count less than one, so
// what they make within the limits one makes too.

#include "runtime/derive.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <unordered_set>

#include "base/dispose.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/work.h"
#include "program/reach.h"
#include "runtime/machine.h"
#include "runtime/recall.h"
#include "runtime/room_key.h"

namespace gable {

namespace {

struct Pass {
  std::vector<std::unique_ptr<Machine>> machines;
  /// Of the initial shapes, and of portions of them.
  std::vector<OutputUnit> units;
  std::unique_ptr<PortionQueue> portions;
  std::vector<uint8_t> derived;
  std::vector<std::vector<EvaluatedAttribute>> attributes;
  /// By initial shape: where its trace nodes and occluders lie in its worker's lists.
  struct Range {
    uint32_t worker = 0;
    size_t traceBegin = 0, traceEnd = 0;
    size_t noteBegin = 0, noteEnd = 0;
  };
  std::vector<Range> ranges;
  /// Memory was refused where nothing could be kept: what the workers made is of no use.
  Status failure;
};

// A unit of work is done, however it ends: others wait for that.
class UnitOfWork {
 public:
  explicit UnitOfWork(PortionQueue& queue) : queue_(queue) {}
  ~UnitOfWork() { queue_.done(); }
  UnitOfWork(const UnitOfWork&) = delete;
  UnitOfWork& operator=(const UnitOfWork&) = delete;

 private:
  PortionQueue& queue_;
};

void deriveShape(Pass& pass, Machine& machine, unsigned worker, const InitialShape& shape,
                 size_t i) {
  Tracer& tracer = machine.tracer();
  const size_t traceBegin = tracer.size();
  const size_t noteBegin = tracer.notes().size();
  pass.units[i] = machine.run(shape, static_cast<uint32_t>(i));
  pass.derived[i] = 1;
  if (!machine.isFirstPass()) {
    pass.attributes[i] = machine.attributeValues();
    pass.units[i].messages.append(machine.takeMessages());
  }
  pass.ranges[i] = {worker, traceBegin, tracer.size(), noteBegin, tracer.notes().size()};
}

// Workers begin with the memory of those of a derivation before.
void lendMemory(Pass& pass, std::vector<SpareBlocks::Worker> spare) {
  for (size_t w = 0; w < std::min(spare.size(), pass.machines.size()); ++w) {
    pass.machines[w]->output() = std::move(spare[w].output);
    pass.machines[w]->prototypeNumbers() = std::move(spare[w].numbers);
  }
}

// Each worker takes initial shapes as long as there are any, and then portions of those that others
// are at.
Pass runPass(DeriveShared& shared, const std::vector<InitialShape>& shapes, unsigned jobs,
             bool divides) {
  Pass pass;
  for (unsigned w = 0; w < jobs; ++w) {
    pass.machines.push_back(std::make_unique<Machine>(shared, w));
  }
  if (!pass.machines[0]->isFirstPass()) lendMemory(pass, std::exchange(shared.spare.workers, {}));
  pass.units.resize(shapes.size());
  pass.derived.assign(shapes.size(), 0);
  pass.attributes.resize(shapes.size());
  pass.ranges.resize(shapes.size());
  pass.portions = std::make_unique<PortionQueue>(shapes.size());
  shared.portions = divides && jobs > 1 ? pass.portions.get() : nullptr;
  std::atomic<size_t> next{0}, done{0};
  std::mutex failing;
  const auto attempt = [&](const auto& body) {
    const Status status = guarded([&] {
      body();
      return Status();
    });
    if (status.ok()) return;
    shared.usage.exhaust();
    const std::lock_guard lock(failing);
    if (pass.failure.ok()) pass.failure = status;
  };
  const auto work = [&](size_t worker, unsigned) {
    Machine& machine = *pass.machines[worker];
    for (size_t i; (i = next.fetch_add(1)) < shapes.size();) {
      const UnitOfWork unit(*pass.portions);
      if (shared.usage.cancelled() || shared.usage.exhausted()) continue;
      attempt([&] { deriveShape(pass, machine, static_cast<unsigned>(worker), shapes[i], i); });
      const size_t count = done.fetch_add(1) + 1;
      if (shared.options.progress) shared.options.progress(count, shapes.size());
    }
    if (!shared.portions) return;
    while (const std::unique_ptr<Portion> portion = pass.portions->take()) {
      const UnitOfWork unit(*pass.portions);
      attempt([&] { machine.run(*portion); });
    }
  };
  // Without portions there is no work for more of them than there are shapes.
  const size_t workers = shared.portions ? jobs : std::min<size_t>(jobs, shapes.size());
  parallelFor(workers, jobs, work);
  shared.portions = nullptr;
  for (auto& m : pass.machines) attempt([&] { m->tellUse(); });
  return pass;
}

// The first messages in the order of the initial shapes, each once: what several workers tell of
// one prototype, one worker would have told of the first shape with it.
class MessageList {
 public:
  explicit MessageList(Diagnostics& out) : out_(out) {}

  void add(const Diagnostics& messages, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const Diagnostics::Entry& d = messages.all()[i];
      // A file that is missing is missing wherever it is named.
      const bool aboutFile = d.code == "missing-asset" || d.code == "missing-texture" ||
                             d.code == "missing-file" || d.code == "read-with-loss";
      const uint64_t place = aboutFile ? 0 : uint64_t{d.span.file} << 32 | d.span.begin;
      const std::string_view what = isToldOncePerPlace(d.code) ? std::string_view() : d.message;
      if (!told_.insert(hashBytes(what, hashBytes(d.code, place))).second) continue;
      size_t& count = d.severity == Severity::Error ? errors_ : warnings_;
      if (++count <= kMostDiagnostics) out_.add(d);
    }
  }

 private:
  Diagnostics& out_;
  std::unordered_set<uint64_t> told_;
  size_t warnings_ = 0, errors_ = 0;
};

void takeMessages(const Pass& pass, Diagnostics& out) {
  MessageList list(out);
  for (const OutputUnit& unit : pass.units) {
    forEachSegment(unit, pass.portions->units(), [&](const OutputUnit& u, size_t hole) {
      list.add(u.messages, hole > 0 ? u.holes[hole - 1].messages : 0,
               hole < u.holes.size() ? u.holes[hole].messages : u.messages.all().size());
    });
  }
}

// Occluders in the order of the initial shapes, whatever worker found them: those that come to be.
std::vector<Occluder> takeOccluders(Pass& pass, const RoomPlan* rooms) {
  std::vector<Occluder> all;
  for (size_t w = 0; w < pass.machines.size(); ++w) {
    for (Occluder& o : pass.machines[w]->context().occluders()) {
      if (!rooms || rooms->holds(w, o.condition)) all.push_back(std::move(o));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Occluder& a, const Occluder& b) {
    return a.initialShape < b.initialShape;
  });
  return all;
}

// The trace in the order of the initial shapes, and what its rules drew and saw.
void takeTrace(Pass& pass, const TagTable& tags, DeriveResult& result) {
  std::vector<TraceNode>& all = result.trace;
  std::map<TagSetId, uint32_t> known{{0, 0}};
  result.traceTags.assign(1, {});
  const auto tagsOf = [&](TagSetId set) {
    const auto [at, isNew] = known.try_emplace(set, result.traceTags.size());
    if (isNew) result.traceTags.push_back(tags.names(set));
    return at->second;
  };
  size_t count = 0;
  for (const Pass::Range& r : pass.ranges) count += r.traceEnd - r.traceBegin;
  all.reserve(count);
  for (const Pass::Range& r : pass.ranges) {
    Tracer& tracer = pass.machines[r.worker]->tracer();
    const std::vector<TraceNode>& nodes = tracer.nodes();
    const size_t shift = all.size();
    for (size_t i = r.traceBegin; i < r.traceEnd; ++i) {
      work();
      TraceNode n = nodes[i];
      if (n.parent != TraceNode::kNone) {
        n.parent = static_cast<uint32_t>(n.parent - r.traceBegin + shift);
      }
      n.tags = tagsOf(n.tags);
      all.push_back(n);
    }
    for (size_t i = r.noteBegin; i < r.noteEnd; ++i) {
      work();
      TraceNote note = std::move(tracer.notes()[i]);
      note.node = static_cast<uint32_t>(note.node - r.traceBegin + shift);
      result.notes.push_back(std::move(note));
    }
  }
}

// The parts of all workers, each after those inside it.
void gatherParts(const Pass& pass, Recall& recall) {
  for (const auto& m : pass.machines) {
    const auto shift = static_cast<uint32_t>(recall.parts.size());
    const auto operationShift = static_cast<uint32_t>(recall.operations.size());
    const IncrementalCache& cache = *m->incremental();
    for (RecallPart p : cache.parts()) {
      p.firstInside += shift;
      p.firstOperation += operationShift;
      p.endOperation += operationShift;
      recall.parts.push_back(p);
    }
    const auto& operations = cache.operations();
    recall.operations.insert(recall.operations.end(), operations.begin(), operations.end());
  }
  recall.partNumbers.reserve(recall.parts.size());
  for (uint32_t i = 0; i < recall.parts.size(); ++i) {
    recall.partNumbers.emplace(recall.parts[i].key, i);
  }
  for (uint32_t i = 0; i < recall.operations.size(); ++i) {
    recall.operationNumbers.emplace(recall.operations[i]->key, i);
  }
}

// Whether a rule that shapes start with, or one that it reaches, has one of the effects.
bool anyHas(uint32_t effects, const Program& program, const std::vector<InitialShape>& shapes,
            int32_t start) {
  const auto asks = [&](int32_t rule) {
    return rule >= 0 && (program.rules[static_cast<size_t>(rule)].reads.effects & effects) != 0;
  };
  return asks(start) || std::any_of(shapes.begin(), shapes.end(), [&](const InitialShape& s) {
           return !s.startRule.empty() && asks(program.findRule(s.startRule));
         });
}

// The attributes of leaves may take a fourth of the memory, as they are no part of what is counted.
MergeInput mergeInput(DeriveShared& shared, Recall* recall) {
  const Environment& e = shared.environment;
  MergeInput input{shared.program, e.materials, e.attributes, shared.options.sources, recall};
  if (shared.before.recall) input.before = &shared.before;
  if (recall) input.spare = &shared.spare;
  if (const auto bytes = shared.options.limits.bytes) input.mostAttributeBytes = *bytes / 4;
  return input;
}

// What the workers made, until merge() has emptied it. Who has stopped the derivation does not wait
// until it is freed.
struct MadeOutputs {
  explicit MadeOutputs(Pass& pass, const Usage& use) : usage(use) {
    for (auto& m : pass.machines) all.push_back(std::move(m->output()));
  }
  ~MadeOutputs() {
    if (usage.cancelled() && !all.empty()) disposeLater(std::move(all));
  }
  MadeOutputs(const MadeOutputs&) = delete;
  MadeOutputs& operator=(const MadeOutputs&) = delete;

  const Usage& usage;
  std::vector<Output> all;
};

// Outputs that merge() has emptied, where they were large enough to be worth it: those of a small
// derivation behind a large one would hold the memory of that.
void keepMemory(Pass& pass, MadeOutputs& outputs, size_t prototypes, SpareBlocks& spare) {
  constexpr size_t kFewPrototypes = 1 << 14;
  if (prototypes < kFewPrototypes) return;
  for (size_t w = 0; w < outputs.all.size(); ++w) {
    KeyNumbers& numbers = pass.machines[w]->prototypeNumbers();
    numbers.clear();
    spare.workers.push_back({std::move(outputs.all[w]), std::move(numbers)});
  }
}

// The scene of all that the workers made, the messages and the trace.
void assemble(Pass& pass, DeriveShared& shared, const std::vector<InitialShape>& shapes,
              const std::shared_ptr<RoomPlan>& rooms, DeriveResult& result) {
  for (auto& m : pass.machines) {
    result.shared += m->cacheHits();
    if (const IncrementalCache* cache = m->incremental()) result.recalled += cache->taken();
  }
  result.portions = pass.portions->units().size();
  takeMessages(pass, result.diagnostics);
  takeTrace(pass, shared.environment.tags, result);
  std::shared_ptr<Recall> recall;
  if (shared.options.remember && !shared.limitReached && !shared.unrepeatable) {
    recall = std::make_shared<Recall>();
    recall->tables = &shared.environment;
    for (const AttributeCode& a : shared.program.attributes) recall->attributes.push_back(a.name);
    gatherParts(pass, *recall);
    if (shared.roomKey) {
      recall->rooms = rooms;
      recall->roomsKey = *shared.roomKey;
    }
  }
  MadeOutputs outputs(pass, shared.usage);
  std::vector<const OutputUnit*> roots;
  for (size_t i = 0; i < shapes.size(); ++i) {
    if (!pass.derived[i]) continue;
    roots.push_back(&pass.units[i]);
    result.roots.push_back({i, 0});
  }
  result.attributes = std::move(pass.attributes);
  size_t prototypes = 0;
  for (const Output& o : outputs.all) prototypes += o.prototypes.size();
  Merged merged =
      merge(outputs.all, roots, pass.portions->units(), mergeInput(shared, recall.get()));
  if (recall) keepMemory(pass, outputs, prototypes, shared.spare);
  result.scene = std::move(merged.scene);
  for (size_t r = 0; r < result.roots.size(); ++r) {
    result.roots[r].reportsEnd = merged.reportsEnd[r];
  }
  if (!merged.allEvents) {
    result.diagnostics.warning("too-many-reports", Span{},
                               "the rules report or print more than can be kept",
                               "report sums, or report in rules that are called less often");
    shared.limitReached = true;
  }
  if (!merged.allAttributes) {
    result.diagnostics.warning("out-of-memory", Span{},
                               "the attributes of leaves take more memory than there may be, and "
                               "some are left out",
                               "raise the limit on memory (--max-memory), or set shorter arrays");
    shared.limitReached = true;
  }
  result.end = shared.usage.cancelled() ? End::Cancelled
               : shared.limitReached    ? End::LimitReached
                                        : End::Done;
  if (result.end == End::Done) result.recall = std::move(recall);
  result.diagnostics.sortByPlace();
}

// Holds what comes after the derivation against the limits, where none has been reached before:
// what was made until then is put together however long that takes. It always looks at the wish to
// stop.
class AfterwardsMeter final : public WorkMeter {
 public:
  explicit AfterwardsMeter(Usage& usage)
      : usage_(usage), tally_(usage), limited_(!usage.exhausted()) {}
  bool look(uint64_t, uint64_t bytes) override {
    if (usage_.cancelled()) return false;
    if (limited_ && !excess_) excess_ = tally_.look(bytes);
    return !excess_;
  }
  const std::optional<Usage::Excess>& excess() const { return excess_; }

 private:
  Usage& usage_;
  Tally tally_;
  bool limited_;
  std::optional<Usage::Excess> excess_;
};

// A derivation that ends without a model.
std::unique_ptr<DeriveResult> failed(const Status& why) {
  auto result = std::make_unique<DeriveResult>();
  result->end = End::LimitReached;
  result->diagnostics.error(why.code(), Span{}, "the derivation cannot go on: " + why.message(),
                            why.hint());
  return result;
}

// That of a derivation whose user has stopped it.
std::unique_ptr<DeriveResult> stopped() {
  auto result = std::make_unique<DeriveResult>();
  result->end = End::Cancelled;
  return result;
}

std::unique_ptr<DeriveResult> assembled(Pass& pass, DeriveShared& shared,
                                        const std::vector<InitialShape>& shapes,
                                        const std::shared_ptr<RoomPlan>& rooms) {
  AfterwardsMeter meter(shared.usage);
  auto result = std::make_unique<DeriveResult>();
  const Status status = guarded([&] {
    const WorkScope scope(meter);
    assemble(pass, shared, shapes, rooms, *result);
    return Status();
  });
  if (status.ok()) return result;
  if (meter.excess()) {
    const Usage::Excess& e = *meter.excess();
    return failed(Status::failure(e.code, e.message, e.hint));
  }
  if (status.code() != kWorkStopped) return failed(status);
  return stopped();
}

struct Way {
  unsigned jobs = 1;
  /// What the derivation before has found out about room is of use.
  bool takesRooms = true;
  /// Initial shapes are divided among workers.
  bool divides = false;
  /// Rules ask about other shapes, or for room among them.
  bool asks = false, asksForRoom = false;
};

// Counts what is worked out between the passes like what operations do.
class BetweenMeter final : public WorkMeter {
 public:
  explicit BetweenMeter(Usage& usage) : usage_(usage), tally_(usage) {}
  bool look(uint64_t units, uint64_t bytes) override {
    if (usage_.cancelled()) return false;
    tally_.countWork(units);
    if (!excess_) excess_ = tally_.look(bytes);
    return !excess_;
  }
  const std::optional<Usage::Excess>& excess() const { return excess_; }

 private:
  Usage& usage_;
  Tally tally_;
  std::optional<Usage::Excess> excess_;
};

// What the first pass found out.
struct FirstPass {
  std::shared_ptr<RoomPlan> rooms;
  std::unique_ptr<OccluderIndex> occluders;
  /// The first initial shape that a limit ended there.
  std::optional<Machine::LimitOfShape> limit;
  /// Why there is nothing to go on with; null where all is well.
  std::unique_ptr<DeriveResult> failure;
};

FirstPass firstPassOf(Pass& pass, const DeriveShared& shared) {
  FirstPass out;
  BetweenMeter meter(shared.usage);
  const Status status = guarded([&] {
    const WorkScope scope(meter);
    if (shared.collectClaims) {
      std::vector<RoomClaims> claims;
      for (auto& m : pass.machines) claims.push_back(std::move(m->claims()));
      out.rooms = std::make_shared<RoomPlan>(std::move(claims));
    }
    if (shared.collectOccluders) {
      out.occluders = std::make_unique<OccluderIndex>(takeOccluders(pass, out.rooms.get()));
    }
    return Status();
  });
  for (const auto& m : pass.machines) {
    const auto& limit = m->firstPassLimit();
    if (!limit || !shared.collectClaims) continue;
    if (!out.limit || limit->initialShape < out.limit->initialShape) out.limit = limit;
  }
  if (status.ok()) return out;
  if (meter.excess()) {
    const Usage::Excess& e = *meter.excess();
    out.failure = failed(Status::failure(e.code, e.message, e.hint));
  } else if (status.code() != kWorkStopped) {
    out.failure = failed(status);
  } else {
    out.failure = stopped();
  }
  return out;
}

// What messages call the operation that asks for room.
std::string askingOperation(const Program& program) {
  for (const auto& op : program.operations) {
    if ((op->effects & kAsksForRoom) != 0) return "'" + std::string(op->name) + "'";
  }
  return {};
}

// How many shapes had room, and which of them nobody can tell. A note is for those that are lost:
// where a block has an 'otherwise', its author knows of them.
void tellRooms(const Pass& pass, const RoomPlan& rooms, const DeriveShared& shared,
               DeriveResult& result) {
  const std::string asking = askingOperation(shared.program);
  const ValuePool& pool = *shared.environment.pool;
  std::map<std::string, RoomTotal> totals;
  size_t told = 0;
  for (const RoomCount& c : rooms.counts()) {
    RoomTotal& total = totals[std::string(pool.text(c.group))];
    total.kept += c.kept;
    total.dropped += c.dropped;
    if (c.lost == 0 || ++told > kMostDiagnostics) continue;
    result.diagnostics.add({Severity::Note,
                            "no-room",
                            c.span,
                            asking + ": " + std::to_string(c.dropped) + " of " +
                                std::to_string(c.kept + c.dropped) + " shapes have no room in '" +
                                std::string(pool.text(c.group)) + "'",
                            "'otherwise' in the block says what becomes of them",
                            {},
                            {}});
  }
  for (auto& [group, total] : totals) {
    total.group = group;
    result.rooms.push_back(total);
  }
  uint64_t strangers = 0;
  for (const auto& m : pass.machines) strangers += m->strangers();
  if (strangers == 0) return;
  result.diagnostics.warning(
      "room-unknown", Span{},
      asking + ": " + std::to_string(strangers) + (strangers == 1 ? " shape has" : " shapes have") +
          " no room, because they asked only after questions about other shapes were answered",
      "ask for room first, and inside of its block for overlaps, touches and the like");
}

// The keys of rules, of the scene before and of who has room.
void prepareRecall(DeriveShared& shared, const Way& way, const std::vector<InitialShape>& shapes) {
  const auto task = [&](size_t i, unsigned) {
    if (i == 0) {
      const Reaches reaches(shared.program);
      shared.reach = reaches.all();
      if (way.asksForRoom) {
        shared.roomKey = roomKey(shared.program, reaches, shapes, shared.options);
      }
    } else {
      shared.before = recallInput(shared.options.before, shared.program, shared.environment,
                                  std::move(shared.spare.bare));
    }
  };
  // Threads are worth it where there is a scene to look into.
  parallelFor(2, shared.options.before ? way.jobs : 1, task);
}

// What the workers made together; null where it is not what one alone would have made.
std::unique_ptr<DeriveResult> deriveIn(Way way, const Program& program,
                                       const std::vector<InitialShape>& shapes,
                                       Environment& environment, const DeriveOptions& options,
                                       Usage& usage) {
  DeriveShared shared(program, options, environment, usage);
  if (options.remember) prepareRecall(shared, way, shapes);
  FirstPass known;
  bool tookRooms = false;
  if (options.remember && way.asksForRoom) {
    const Recall* const before = way.takesRooms ? shared.before.recall : nullptr;
    tookRooms = before && before->rooms && shared.roomKey == before->roomsKey;
    if (tookRooms) known.rooms = before->rooms;
  }
  if (way.asks || (way.asksForRoom && !tookRooms)) {
    shared.collectOccluders = way.asks;
    shared.collectClaims = way.asksForRoom;
    Pass first = runPass(shared, shapes, way.jobs, false);
    if (way.jobs > 1 && usage.exhaustedByCount()) return nullptr;
    if (!first.failure.ok()) return failed(first.failure);
    known = firstPassOf(first, shared);
    if (known.failure) return std::move(known.failure);
    shared.occluders = known.occluders.get();
    shared.collectOccluders = shared.collectClaims = false;
    usage.startAgain();
    // What a limit has cut is of no use to anyone else.
    if (shared.limitReached) shared.roomKey.reset();
  }
  shared.rooms = known.rooms.get();
  Pass pass = runPass(shared, shapes, way.jobs, way.divides);
  if (way.jobs > 1 && usage.exhaustedByCount()) return nullptr;
  // What is over by the clock, by memory or by the user's wish is told as it is.
  if (shared.indivisible && !usage.exhausted() && !usage.cancelled()) return nullptr;

  // A limit may have been reached in the first pass already, had there been one.
  const bool outOfTimeOrMemory = usage.exhausted() && !usage.exhaustedByCount();
  if (tookRooms && shared.limitReached && !outOfTimeOrMemory) {
    usage.startAgain();
    way.takesRooms = false;
    return deriveIn(way, program, shapes, environment, options, usage);
  }
  if (!pass.failure.ok()) return failed(pass.failure);
  // The scene needs their room.
  if (known.rooms && !shared.roomKey) known.rooms->forgetAnswers();
  known.occluders.reset();
  // There would be no scene, and making room for one takes long.
  if (usage.cancelled()) {
    const MadeOutputs freed(pass, usage);
    return stopped();
  }
  auto result = assembled(pass, shared, shapes, known.rooms);
  if (known.rooms && result->end != End::Cancelled) {
    tellRooms(pass, *known.rooms, shared, *result);
    if (known.limit) {
      Diagnostics::Entry& message = known.limit->message;
      message.message += ", where both ways of " + askingOperation(program) +
                         " are followed to find out who asks for room";
      result->diagnostics.add(std::move(message));
    }
    result->diagnostics.sortByPlace();
  }
  return result;
}

}  // namespace

DeriveResult derive(const Program& program, const std::vector<InitialShape>& shapes,
                    Environment& environment, const DeriveOptions& given) {
  DeriveOptions options = given;
  if (options.startRule < 0) options.startRule = program.startRule;
  Way way;
  way.jobs = options.jobs > 0 ? static_cast<unsigned>(options.jobs) : defaultJobs();
  way.asks = anyHas(kReadsContext, program, shapes, options.startRule);
  way.asksForRoom = anyHas(kAsksForRoom, program, shapes, options.startRule);
  // Children are counted for the paths of shapes.
  way.divides = way.jobs > 1 && !way.asks && !options.trace &&
                !anyHas(kReadsPath, program, shapes, options.startRule);
  if (way.asks || options.trace || !options.sharing) options.remember = false;
  Usage usage(options.limits, options.cancel);
  auto made = deriveIn(way, program, shapes, environment, options, usage);
  if (!made && !usage.exhaustedByCount()) {
    usage.startAgain();
    way.divides = false;
    made = deriveIn(way, program, shapes, environment, options, usage);
  }
  if (!made) {
    usage.startAgain();
    made = deriveIn(Way{1, true, false, way.asks, way.asksForRoom}, program, shapes, environment,
                    options, usage);
  }
  return std::move(*made);
}

}  // namespace gable
