// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each initial shape becomes prototypes in the machine's output, as in derive(); their instances
// are then walked and each leaf is placed. What one initial shape made is still known for the next.

#include "runtime/leaf_stream.h"

#include <algorithm>
#include <array>

#include "runtime/machine.h"

namespace gable {

namespace {

// More leaves in prototypes than this and they are forgotten.
constexpr size_t kMostKept = size_t{1} << 12;

// So many initial shapes are derived one after the other, and then placed: the consumer may write
// so much for each that little of the machine would be left in the caches for the next.
constexpr size_t kMostUnits = 64;

// Most leaves below one turned frame have its axes, and so have most that lay in the same place of
// the batch before: axes are numbered, and written only where other ones lie.
class Placer {
 public:
  using Take = std::function<void(std::span<const Leaf>)>;
  Placer(const Output& from, const Take& take) : from_(from), take_(take) {
    axesOf_.fill(kUpright);
  }

  void place(const Prototype& p, const Frame& world) {
    depth_ = 0;
    Level& root = open(p);
    root.world = world;
    root.axes = world.turned ? ++lastAxes_ : kUpright;
    while (depth_ > 0) {
      const Instance* const next = goOn(levels_[depth_ - 1]);
      if (next)
        enter(*next);
      else
        --depth_;
    }
    pass();
  }

 private:
  using AxesNumber = uint64_t;
  static constexpr AxesNumber kUpright = 0;

  struct Level {
    const Prototype* prototype;
    Frame world;
    AxesNumber axes;
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
      if (at.leaf < end) put({leaves + at.leaf, leaves + end}, at.world, at.world.origin, at.axes);
      at.leaf = end;
    };
    while (at.instance < prototype.instanceCount) {
      const Instance& next = instances[at.instance++];
      putUpTo(next.leavesBefore);
      const Prototype& inner = from_.prototypes[next.prototype].range;
      if (inner.instanceCount > 0) return &next;
      const std::span<const Leaf> within(from_.leaves.data() + inner.firstLeaf, inner.leafCount);
      if (!next.frame.turned)
        put(within, at.world, at.world.point(next.frame.origin), at.axes);
      else
        put(within, at.world * next.frame);
    }
    putUpTo(prototype.leafCount);
    return nullptr;
  }
  void enter(const Instance& instance) {
    Level& level = open(from_.prototypes[instance.prototype].range);
    const Level& around = levels_[depth_ - 2];
    level.axes = instance.frame.turned ? ++lastAxes_ : around.axes;
    // Written once: a copy of what was just written would wait for its stores.
    if (instance.frame.turned) {
      level.world = around.world * instance.frame;
    } else {
      level.world = around.world;
      level.world.origin = around.world.point(instance.frame.origin);
    }
  }
  void put(std::span<const Leaf> leaves, const Frame& world) {
    put(leaves, world, world.origin, ++lastAxes_);
  }
  // The frame that they lie in has the axes of `world`, and begins at `origin`.
  void put(std::span<const Leaf> leaves, const Frame& world, const Vec3& origin,
           AxesNumber number) {
    while (!leaves.empty()) {
      const size_t count = std::min(leaves.size(), batch_.size() - count_);
      Leaf* placed = batch_.data() + count_;
      AxesNumber* axes = axesOf_.data() + count_;
      for (const Leaf& leaf : leaves.first(count)) {
        if (leaf.frame.turned) {
          *axes = ++lastAxes_;
          placeTurned(leaf.frame, world, origin, *placed);
        } else {
          if (*axes != number) {
            *axes = number;
            placed->frame = world;
          }
          placed->frame.origin = origin + world.direction(leaf.frame.origin);
        }
        placed->scale = leaf.scale;
        placed->mesh = leaf.mesh;
        placed->materials = leaf.materials;
        placed->name = leaf.name;
        placed->source = leaf.source;
        placed->attributes = leaf.attributes;
        ++placed, ++axes;
      }
      leaves = leaves.subspan(count);
      count_ += count;
      if (count_ == batch_.size()) pass();
    }
  }
  static void placeTurned(const Frame& leaf, Frame world, const Vec3& origin, Leaf& placed) {
    world.origin = origin;
    placed.frame = world * leaf;
  }
  void pass() {
    if (count_ > 0) take_({batch_.data(), count_});
    count_ = 0;
  }

  const Output& from_;
  const Take& take_;
  /// Used again and again: those in use come first.
  std::vector<Level> levels_;
  size_t depth_ = 0;
  std::array<Leaf, 64> batch_;
  /// Of the leaves of the batch.
  std::array<AxesNumber, 64> axesOf_;
  AxesNumber lastAxes_ = kUpright;
  size_t count_ = 0;
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
                     const std::function<void(std::span<const Leaf>)>& take) {
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
