// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sound scenes: what writers, viewers and pictures are given. Rules can compute anything, so a
// derived scene may have places, sizes and normals that are not numbers, or larger than the single
// precision of model files; no reader of a scene looks for them again.
//
// In a sound scene
// 1. every frame is rigid, and every coordinate of a frame, and of a mesh as its leaf scales it, is
//    finite and at most kFarthest;
// 2. every normal of a mesh has a length to go by, or is zero, which leaves it to the face;
// 3. every texture coordinate and every number of a material is finite and at most kFarthest.
// Prototypes, instances and leaves keep their numbers and their order.
#pragma once

#include <cstdint>
#include <optional>

#include "scene/scene.h"

namespace gable {

/// Far below the largest float, so that sums along a chain of frames stay below it, too.
constexpr double kFarthest = 1e30;

struct SoundScene {
  /// Without a value the scene was sound already.
  std::optional<Scene> scene;
  /// Leaves left out, instances expanded: they have an empty mesh.
  uint64_t leavesLeftOut = 0;
  /// The first of them in storage order, in Scene::leaves; kNone: none.
  uint32_t firstLeft = kNone;
  static constexpr uint32_t kNone = 0xffffffff;
  /// Normals, texture coordinates and numbers of materials that were replaced.
  uint64_t valuesReplaced = 0;
};

/// Linear in what the scene stores. `jobs` as in parallelFor(); the result is that of one.
SoundScene soundOf(const Scene& scene, unsigned jobs = 1);

}  // namespace gable
