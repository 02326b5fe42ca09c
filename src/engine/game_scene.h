// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What game engines want beside a model: collision shapes, coarser levels of detail, and names by
// which the engine knows them. Each initial shape has its own; what equal ones have is made once.
#pragma once

#include <string>
#include <vector>

#include "gable/model.h"
#include "scene/scene.h"
#include "tiles/coarse.h"

namespace gable {

struct GameScene {
  Scene scene;
  /// By file, the model's first: its roots, of the prototypes of the scene.
  std::vector<std::vector<Root>> files;
  /// Of the first file, as in WriteOptions.
  std::vector<std::vector<uint32_t>> levels;
  std::vector<double> coverage;
};

/// Whether the settings ask for anything of it.
bool asksForGameScene(const WriteSettings& settings);

/// The scene is copied. Linear in the flattened leaves, n log n in the triangles of coarse levels.
GameScene gameSceneOf(const Scene& scene, const WriteSettings& settings, const FinishOf& finishOf);

}  // namespace gable
