// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Footing: how big the things of a scene are and where they meet the ground, so that a tree, a lamp
// or a car is laid on terrain as one thing, and stays shared. In metres, in the frame of each
// prototype, y up. Boxes hold what is in them, and may be larger where parts are turned.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/box.h"
#include "scene/scene.h"

namespace gable {

struct Footing {
  Box3 box;
  /// Of the parts that reach the ground, the lowest ones.
  Box3 foot;
  /// Some part lies on the ground, such as paving: it must go along with what is around it.
  bool lies = false;
};

/// Of each prototype when it is asked for. What has more leaves than any single thing has an empty
/// box: no more than kMostLeaves are looked at for each prototype. Outlives no change of the scene.
class Footings {
 public:
  static constexpr uint64_t kMostLeaves = 8192;

  explicit Footings(const Scene& scene);
  const Footing& of(uint32_t prototype);

 private:
  Footing measured(const Prototype& p);
  const Box3& boundsOf(uint32_t mesh);

  const Scene& scene_;
  std::vector<uint64_t> counts_;
  std::vector<std::optional<Box3>> meshes_;
  std::vector<std::optional<Footing>> known_;
  std::vector<Box3> parts_;
};

}  // namespace gable
