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

/// Derives on the calling thread, for consumers that turn leaves into something of their own at
/// once. What is alike is derived once and placed as often as it occurs. Keeps its memory between
/// runs.
class LeafStream {
 public:
  /// All must outlive the stream.
  LeafStream(const Program& program, Environment& environment, const DeriveOptions& options);
  ~LeafStream();
  /// Calls `take` with the leaves of one initial shape after the other, placed in the world, in
  /// path order, some at a time while they are still at hand. Leaf::mesh is valid for the unit
  /// primitives (below kFirstMesh); other meshes are given by mesh(). The span is good until `take`
  /// returns.
  void run(const std::vector<InitialShape>& shapes,
           const std::function<void(std::span<const Leaf>)>& take);
  const Mesh& mesh(const Leaf& leaf) const;
  const Diagnostics& diagnostics() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gable
