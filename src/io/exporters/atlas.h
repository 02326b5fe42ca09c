// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Atlas: one picture for many materials, so that what has them is drawn at once.
//
// Into it go plain colours, a few pixels each, and pictures that a face shows at most twice along
// and up: they stand there as often as faces repeat them. A picture that faces repeat more often,
// or that materials lay in metres, would have to be cut into as many faces or pixels, so it stays a
// texture of its own; so do materials with other maps than colour, with light of their own, or with
// extensions of glTF. How rough and metallic materials are is in a second picture, where they
// differ.
//
// Materials that can be merged are those that are equally opaque and double sided.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "io/exporters/write_model.h"

namespace gable {

/// Of the materials that faces have.
struct AtlasCounts {
  /// Those that went into the atlas, and what they became.
  uint32_t merged = 0, into = 0;
  /// Those that stay: for pictures that repeat, for other maps or light, for want of room.
  uint32_t repeating = 0, special = 0, large = 0;
};

struct AtlasScene {
  Scene scene;
  /// The pictures of the atlas as PNG, by the paths that the scene's materials name.
  std::map<std::string, std::string> pictures;
  AtlasCounts counts;
};

/// The scene with an atlas of `side` pixels at most; less than two materials to merge leave it as
/// it is. Linear in the meshes and in the pixels of the pictures. The order of materials, meshes
/// and leaves of the scene settles all, so equal scenes have equal atlases.
AtlasScene withAtlas(const Scene& scene, const TextureReader& read, uint32_t side);

}  // namespace gable
