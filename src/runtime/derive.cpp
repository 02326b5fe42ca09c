// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One machine a worker takes initial shapes in turn; the outputs are merged in the order of the
// shapes. When rules ask about other shapes (inside, touches, ...) there are two passes: the first
// collects occluders and is thrown away, the second asks them.

#include "runtime/derive.h"

#include <algorithm>
#include <memory>

#include "base/parallel.h"
#include "program/reach.h"
#include "runtime/machine.h"
#include "runtime/recall.h"

namespace gable {

namespace {

struct Pass {
  std::vector<std::unique_ptr<Machine>> machines;
  std::vector<OutputRoot> roots;
  std::vector<uint8_t> derived;
  std::vector<std::vector<AttributeValue>> attributes;
  /// By initial shape: where its trace nodes and occluders lie in its worker's lists.
  struct Range {
    uint32_t worker = 0;
    size_t traceBegin = 0, traceEnd = 0;
    size_t noteBegin = 0, noteEnd = 0;
  };
  std::vector<Range> ranges;
};

Pass runPass(DeriveShared& shared, const std::vector<InitialShape>& shapes) {
  Pass pass;
  const unsigned jobs =
      shared.options.jobs > 0 ? static_cast<unsigned>(shared.options.jobs) : defaultJobs();
  for (unsigned w = 0; w < jobs; ++w) {
    pass.machines.push_back(std::make_unique<Machine>(shared, w));
  }
  pass.roots.resize(shapes.size());
  pass.derived.assign(shapes.size(), 0);
  pass.attributes.resize(shapes.size());
  pass.ranges.resize(shapes.size());
  std::atomic<size_t> done{0};
  parallelFor(shapes.size(), jobs, [&](size_t i, unsigned worker) {
    if (shared.options.cancel && shared.options.cancel->load(std::memory_order_relaxed)) return;
    if (shared.exhausted.load(std::memory_order_relaxed)) return;
    Machine& machine = *pass.machines[worker];
    const size_t traceBegin = machine.trace().size();
    const size_t noteBegin = machine.notes().size();
    pass.roots[i] = machine.run(shapes[i], static_cast<uint32_t>(i));
    pass.derived[i] = 1;
    if (!shared.collectOccluders) pass.attributes[i] = machine.attributeValues();
    pass.ranges[i] = {worker, traceBegin, machine.trace().size(), noteBegin,
                      machine.notes().size()};
    const size_t count = done.fetch_add(1) + 1;
    if (shared.options.progress) shared.options.progress(count, shapes.size());
  });
  return pass;
}

// Occluders in the order of the initial shapes, whatever worker found them.
std::vector<Occluder> takeOccluders(Pass& pass) {
  std::vector<Occluder> all;
  for (auto& m : pass.machines) {
    for (Occluder& o : m->occluders()) all.push_back(std::move(o));
  }
  std::stable_sort(all.begin(), all.end(), [](const Occluder& a, const Occluder& b) {
    return a.initialShape < b.initialShape;
  });
  return all;
}

// The trace in the order of the initial shapes, and what its rules drew and saw.
void takeTrace(Pass& pass, DeriveResult& result) {
  std::vector<TraceNode>& all = result.trace;
  for (const Pass::Range& r : pass.ranges) {
    const auto& nodes = pass.machines[r.worker]->trace();
    const size_t shift = all.size();
    for (size_t i = r.traceBegin; i < r.traceEnd; ++i) {
      TraceNode n = nodes[i];
      if (n.parent != TraceNode::kNone) {
        n.parent = static_cast<uint32_t>(n.parent - r.traceBegin + shift);
      }
      all.push_back(n);
    }
    for (size_t i = r.noteBegin; i < r.noteEnd; ++i) {
      TraceNote note = std::move(pass.machines[r.worker]->notes()[i]);
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
    for (RecallPart p : m->parts()) {
      p.firstInside += shift;
      p.firstOperation += operationShift;
      p.endOperation += operationShift;
      recall.parts.push_back(p);
    }
    const auto& operations = m->keptOperations();
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

bool asksContext(const Program& program, const std::vector<InitialShape>& shapes, int32_t start) {
  const auto asks = [&](int32_t rule) {
    return rule >= 0 &&
           (program.rules[static_cast<size_t>(rule)].reads.effects & kReadsContext) != 0;
  };
  return asks(start) || std::any_of(shapes.begin(), shapes.end(), [&](const InitialShape& s) {
           return !s.startRule.empty() && asks(program.findRule(s.startRule));
         });
}

}  // namespace

DeriveResult derive(const Program& program, const std::vector<InitialShape>& shapes,
                    Environment& environment, const DeriveOptions& given) {
  DeriveOptions options = given;
  if (options.startRule < 0) options.startRule = program.startRule;
  const bool asks = asksContext(program, shapes, options.startRule);
  if (asks || options.trace || !options.sharing) options.remember = false;
  DeriveShared shared(program, options, environment);
  if (options.remember) {
    shared.reach = reachOf(program);
    shared.before = recallInput(options.before, program, environment);
  }
  std::unique_ptr<OccluderIndex> occluders;
  if (asks) {
    shared.collectOccluders = true;
    Pass first = runPass(shared, shapes);
    occluders = std::make_unique<OccluderIndex>(takeOccluders(first));
    shared.occluders = occluders.get();
    shared.collectOccluders = false;
    shared.shapes = 0;
    shared.steps = 0;
  }
  Pass pass = runPass(shared, shapes);

  DeriveResult result;
  std::vector<Output> outputs;
  for (auto& m : pass.machines) {
    result.shared += m->cacheHits();
    result.recalled += m->recalled();
    result.diagnostics.append(m->diagnostics());
  }
  takeTrace(pass, result);
  std::shared_ptr<Recall> recall;
  if (options.remember && !shared.limitReached && !shared.unrepeatable) {
    recall = std::make_shared<Recall>();
    recall->tables = &environment;
    for (const AttributeCode& a : program.attributes) recall->attributes.push_back(a.name);
    gatherParts(pass, *recall);
  }
  for (auto& m : pass.machines) outputs.push_back(std::move(m->output()));
  std::vector<OutputRoot> roots;
  for (size_t i = 0; i < shapes.size(); ++i) {
    if (pass.derived[i]) roots.push_back(std::move(pass.roots[i]));
  }
  result.attributes = std::move(pass.attributes);
  MergeLoss loss;
  MergeInput input{program, environment.materials, environment.attributes, options.sources,
                   recall.get()};
  if (options.limits.bytes > 0) {
    const uint64_t most = shared.bytesBefore + options.limits.bytes, held = residentBytes();
    input.mostAttributeBytes = most > held ? most - held : 0;
  }
  result.scene = merge(outputs, roots, input, loss);
  if (loss.attributes) {
    result.diagnostics.warning("out-of-memory", Span{},
                               "the attributes of leaves take more memory than there may be, and "
                               "some are left out",
                               "raise the limit on memory, or set shorter arrays");
    shared.limitReached = true;
  }
  if (loss.events) {
    result.diagnostics.warning("too-many-reports", Span{},
                               "the rules report or print more than can be kept",
                               "report sums, or report in rules that are called less often");
    shared.limitReached = true;
  }
  const bool cancelled = options.cancel && options.cancel->load(std::memory_order_relaxed);
  result.end = cancelled             ? DeriveEnd::Cancelled
               : shared.limitReached ? DeriveEnd::LimitReached
                                     : DeriveEnd::Done;
  if (!loss.events && !loss.attributes && result.end == DeriveEnd::Done)
    result.recall = std::move(recall);
  result.diagnostics.sortByPlace();
  return result;
}

struct LeafStream::Impl {
  Impl(const Program& program, Environment& environment, const DeriveOptions& given)
      : options(given), shared(program, options, environment) {
    options.sharing = false;
    options.trace = false;
    if (options.startRule < 0) options.startRule = program.startRule;
    machine = std::make_unique<Machine>(shared, 0);
  }
  DeriveOptions options;
  DeriveShared shared;
  std::unique_ptr<Machine> machine;
};

LeafStream::LeafStream(const Program& program, Environment& environment,
                       const DeriveOptions& options)
    : impl_(std::make_unique<Impl>(program, environment, options)) {}

LeafStream::~LeafStream() = default;

void LeafStream::run(const std::vector<InitialShape>& shapes,
                     const std::function<void(std::span<const Leaf>)>& take) {
  Output& output = impl_->machine->output();
  impl_->machine->setSink(&take);
  for (uint32_t i = 0; i < shapes.size(); ++i) {
    impl_->machine->derive(shapes[i], i);
    if (!output.openLeaves.empty()) take(output.openLeaves);
    output.drop();
  }
  impl_->machine->setSink(nullptr);
}

const Mesh& LeafStream::mesh(const Leaf& leaf) const {
  return *impl_->machine->output().meshes[leaf.mesh - kFirstMesh];
}

const Diagnostics& LeafStream::diagnostics() const { return impl_->machine->diagnostics(); }

}  // namespace gable
