// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each initial shape becomes prototypes in the machine's output, as in derive(); their instances
// are then walked and each leaf is placed. What one initial shape made is still known for the next.

#include "runtime/leaf_stream.h"

#include "runtime/machine.h"

namespace gable {

namespace {

// More leaves in prototypes than this and they are forgotten.
constexpr size_t kMostKept = size_t{1} << 12;

// So many initial shapes are derived one after the other, and then placed: the consumer may write
// so much for each that little of the machine would be left in the caches for the next.
constexpr size_t kMostUnits = 64;

// Nothing is copied: leaves are passed on where they lie, with the frame around them.
class Placer {
 public:
  using Take = std::function<void(const PlacedLeaves&)>;
  Placer(const Output& from, const Take& take) : from_(from), take_(take) {}

  void place(const Prototype& p, const Frame& world) {
    depth_ = 0;
    Level& root = open(p);
    root.world = world;
    while (depth_ > 0) {
      const Instance* const next = goOn(levels_[depth_ - 1]);
      if (next)
        enter(*next);
      else
        --depth_;
    }
  }

 private:
  struct Level {
    const Prototype* prototype;
    Frame world;
    uint32_t leaf, instance;
  };

  Level& open(const Prototype& p) {
    if (depth_ == levels_.size()) levels_.emplace_back();
    Level& level = levels_[depth_++];
    level.prototype = &p;
    level.leaf = level.instance = 0;
    return level;
  }
  // Places what is left of a level up to an instance that holds others, and gives that one; null
  // where there is none. Instances that hold leaves alone, which most do, need no level.
  const Instance* goOn(Level& at) {
    const Prototype& prototype = *at.prototype;
    const Leaf* const leaves = from_.leaves.data() + prototype.firstLeaf;
    const Instance* const instances = from_.instances.data() + prototype.firstInstance;
    const auto putUpTo = [&](uint32_t end) {
      if (at.leaf < end) put({leaves + at.leaf, leaves + end}, at.world, at.world.origin);
      at.leaf = end;
    };
    while (at.instance < prototype.instanceCount) {
      const Instance& next = instances[at.instance++];
      putUpTo(next.leavesBefore);
      const Prototype& inner = from_.prototypes[next.prototype].range;
      if (inner.instanceCount > 0) return &next;
      const std::span<const Leaf> within(from_.leaves.data() + inner.firstLeaf, inner.leafCount);
      if (!next.frame.turned)
        put(within, at.world, at.world.point(next.frame.origin));
      else
        putTurned(within, at.world * next.frame);
    }
    putUpTo(prototype.leafCount);
    return nullptr;
  }
  void enter(const Instance& instance) {
    Level& level = open(from_.prototypes[instance.prototype].range);
    const Level& around = levels_[depth_ - 2];
    // Written once: a copy of what was just written would wait for its stores.
    if (instance.frame.turned) {
      level.world = around.world * instance.frame;
    } else {
      level.world = around.world;
      level.world.origin = around.world.point(instance.frame.origin);
    }
  }
  void putTurned(std::span<const Leaf> leaves, const Frame& world) {
    put(leaves, world, world.origin);
  }
  // The frame that they lie in has the axes of `world`, and begins at `origin`.
  void put(std::span<const Leaf> leaves, const Frame& world, const Vec3& origin) {
    if (!leaves.empty()) take_({leaves, world, origin});
  }

  const Output& from_;
  const Take& take_;
  /// Used again and again: those in use come first.
  std::vector<Level> levels_;
  size_t depth_ = 0;
};

DeriveOptions streamed(DeriveOptions options, const Program& program) {
  options.sharing = true;
  options.trace = false;
  if (options.startRule < 0) options.startRule = program.startRule;
  return options;
}

}  // namespace

struct LeafStream::Impl {
  Impl(const Program& program, Environment& environment, const DeriveOptions& given)
      : options(streamed(given, program)),
        usage(options.limits, options.cancel),
        shared(program, options, environment, usage),
        machine(shared, 0) {}
  const DeriveOptions options;
  Usage usage;
  DeriveShared shared;
  Diagnostics messages;
  Machine machine;
};

LeafStream::LeafStream(const Program& program, Environment& environment,
                       const DeriveOptions& options)
    : impl_(std::make_unique<Impl>(program, environment, options)) {}

LeafStream::~LeafStream() = default;

void LeafStream::run(const std::vector<InitialShape>& shapes,
                     const std::function<void(const PlacedLeaves&)>& take) {
  Machine& machine = impl_->machine;
  Output& output = machine.output();
  Placer placer(output, take);
  machine.forget();
  std::vector<OutputUnit> units;
  for (uint32_t i = 0; i < shapes.size(); ++i) {
    units.push_back(machine.run(shapes[i], i));
    const bool enough = units.size() == kMostUnits || output.leaves.size() > kMostKept;
    if (!enough && i + 1 < shapes.size()) continue;
    for (OutputUnit& unit : units) {
      placer.place(output.prototypes[unit.prototype].range, unit.frame);
      impl_->messages.append(std::move(unit.messages));
    }
    units.clear();
    if (output.leaves.size() > kMostKept) machine.forget();
  }
}

const Mesh& LeafStream::mesh(const Leaf& leaf) const {
  return *impl_->machine.output().meshes[leaf.mesh - kFirstMesh];
}

const Diagnostics& LeafStream::diagnostics() const { return impl_->messages; }

}  // namespace gable
