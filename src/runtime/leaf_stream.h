// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// LeafStream: a derivation whose leaves are taken one after the other, without a scene.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "runtime/derive.h"

namespace gable {

/// Leaves that lie in one frame of the world.
struct PlacedLeaves {
  /// As they were made. Leaf::mesh is valid for the unit primitives (below kFirstMesh); other
  /// meshes are given by LeafStream::mesh().
  std::span<const Leaf> leaves;
  /// Has the axes of the frame, and another origin.
  const Frame& axes;
  Vec3 origin;

  /// Where a leaf begins in the world.
  Vec3 originOf(const Leaf& leaf) const { return origin + axes.direction(leaf.frame.origin); }
  /// The frame of a leaf in the world.
  Frame frameOf(const Leaf& leaf) const {
    Frame frame = axes;
    frame.origin = origin;
    return frame * leaf.frame;
  }
};

/// Derives on the calling thread, for consumers that turn leaves into something of their own at
/// once. What is alike is derived once and placed as often as it occurs. Keeps its memory between
/// runs.
class LeafStream {
 public:
  /// All must outlive the stream.
  LeafStream(const Program& program, Environment& environment, const DeriveOptions& options);
  ~LeafStream();
  /// Calls `take` with the leaves of one initial shape after the other, in path order. What it is
  /// given is good until it returns.
  void run(const std::vector<InitialShape>& shapes,
           const std::function<void(const PlacedLeaves&)>& take);
  const Mesh& mesh(const Leaf& leaf) const;
  const Diagnostics& diagnostics() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gable
