// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each initial shape becomes prototypes in the machine's output, as in derive(); their instances
// are then walked and each leaf is placed. What one initial shape made is still known for the next.

#include "runtime/leaf_stream.h"

#include <array>

#include "runtime/machine.h"

namespace gable {

namespace {

// placed = world * inner, written once: a copy of what was just written would wait for its stores.
void place(const Frame& world, const Frame& inner, Frame& placed) {
  if (!world.turned) {
    placed = inner;
    placed.origin = world.origin + inner.origin;
  } else if (!inner.turned) {
    placed = world;
    placed.origin = world.point(inner.origin);
  } else {
    placed = world * inner;
  }
}

// More leaves in prototypes than this and they are forgotten.
constexpr size_t kMostKept = size_t{1} << 12;

class Placer {
 public:
  using Take = std::function<void(std::span<const Leaf>)>;
  Placer(const Output& from, const Take& take) : from_(from), take_(take) {}

  void place(const Prototype& p, const Frame& world) {
    depth_ = 0;
    open(p).world = world;
    while (depth_ > 0) {
      Level& at = levels_[depth_ - 1];
      const Prototype& prototype = *at.prototype;
      const bool more = at.instance < prototype.instanceCount;
      const Instance* const next =
          more ? &from_.instances[prototype.firstInstance + at.instance++] : nullptr;
      const uint32_t end = more ? next->leavesBefore : prototype.leafCount;
      const Leaf* const leaves = from_.leaves.data() + prototype.firstLeaf;
      for (; at.leaf < end; ++at.leaf) put(leaves[at.leaf], at.world);
      if (more) {
        Level& inner = open(from_.prototypes[next->prototype].range);
        gable::place(levels_[depth_ - 2].world, next->frame, inner.world);
      } else {
        --depth_;
      }
    }
    pass();
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
  void put(const Leaf& leaf, const Frame& world) {
    Leaf& placed = batch_[count_++];
    gable::place(world, leaf.frame, placed.frame);
    placed.scale = leaf.scale;
    placed.mesh = leaf.mesh;
    placed.materials = leaf.materials;
    placed.name = leaf.name;
    placed.source = leaf.source;
    placed.attributes = leaf.attributes;
    if (count_ == batch_.size()) pass();
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
  for (uint32_t i = 0; i < shapes.size(); ++i) {
    if (output.leaves.size() > kMostKept) machine.forget();
    OutputUnit unit = machine.run(shapes[i], i);
    placer.place(output.prototypes[unit.prototype].range, unit.frame);
    impl_->messages.append(std::move(unit.messages));
  }
}

const Mesh& LeafStream::mesh(const Leaf& leaf) const {
  return *impl_->machine.output().meshes[leaf.mesh - kFirstMesh];
}

const Diagnostics& LeafStream::diagnostics() const { return impl_->messages; }

}  // namespace gable
