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

// More leaves in prototypes than this and they are forgotten.
constexpr size_t kMostKept = size_t{1} << 12;

class Placer {
 public:
  using Take = std::function<void(std::span<const Leaf>)>;
  Placer(const Output& from, const Take& take) : from_(from), take_(take) {}

  void place(const Prototype& p, const Frame& world) {
    levels_.clear();
    levels_.push_back({&p, world});
    while (!levels_.empty()) {
      Level& at = levels_.back();
      const Prototype& prototype = *at.prototype;
      const bool more = at.instance < prototype.instanceCount;
      const Instance* const next =
          more ? &from_.instances[prototype.firstInstance + at.instance++] : nullptr;
      const uint32_t end = more ? next->leavesBefore : prototype.leafCount;
      const Leaf* const leaves = from_.leaves.data() + prototype.firstLeaf;
      for (; at.leaf < end; ++at.leaf) put(leaves[at.leaf], at.world);
      if (more)
        levels_.push_back({&from_.prototypes[next->prototype].range, at.world * next->frame});
      else
        levels_.pop_back();
    }
    pass();
  }

 private:
  struct Level {
    const Prototype* prototype;
    Frame world;
    uint32_t leaf = 0, instance = 0;
  };

  void put(const Leaf& leaf, const Frame& world) {
    Leaf& placed = batch_[count_++];
    placed = leaf;
    placed.frame = world * leaf.frame;
    if (count_ == batch_.size()) pass();
  }
  void pass() {
    if (count_ > 0) take_({batch_.data(), count_});
    count_ = 0;
  }

  const Output& from_;
  const Take& take_;
  std::vector<Level> levels_;
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
