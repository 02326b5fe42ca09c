// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a tile's file holds: few primitives, one a look. Materials that differ in colour alone share
// one, as colours are data of vertices; so is the number of the feature.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "io/exporters/gltf_materials.h"
#include "tiles/coarse.h"
#include "tiles/tile_content.h"

namespace gable {

/// Interleaved: position 3, normal 3, colour 2 (four numbers of 16 bits), feature 1, 2 a uv set.
struct TilePrimitive {
  uint32_t variant = 0;
  uint32_t uvCount = 0;
  std::vector<uint32_t> words;
  std::vector<uint32_t> indices;
  std::array<float, 3> min, max;

  TilePrimitive();
  uint32_t floats() const { return 9 + 2 * uvCount; }
  uint32_t vertexCount() const { return static_cast<uint32_t>(words.size()) / floats(); }
};

/// A part that is there once and placed several times: primitives in its own frame, whose vertices
/// say nothing of features.
struct TileInstances {
  struct Place {
    Frame frame;
    uint32_t feature = 0;
  };
  std::vector<TilePrimitive> primitives;
  /// The origins of frames count from the middle of the tile.
  std::vector<Place> places;
};

struct TileMesh {
  /// Positions count from here.
  Vec3 center;
  std::vector<TileFeature> features;
  std::vector<TilePrimitive> primitives;
  std::vector<TileInstances> instances;
  /// The materials of the primitives, which `materials` looks into.
  std::shared_ptr<Scene> looks;
  std::shared_ptr<GltfMaterials> materials;
  std::vector<std::string> warnings;
  /// Of the vertices as they are written, in the frame of the place.
  Box3 box;
  /// As they are shown, each as often as it is placed; and what they cost (TileContent::triangles).
  uint64_t triangles = 0, cost = 0;
};

/// Metres: positions are integers where that moves none by more.
constexpr double kMostQuantized = 0.002;

/// How parts that are placed several times are shown.
enum class TileInstancing : uint8_t {
  /// By nodes of EXT_mesh_gpu_instancing and EXT_instance_features.
  Gpu,
  /// By nodes that share vertices and triangles; those of one feature share a mesh.
  Nodes,
  /// Not at all: they are written as often as they are placed.
  None,
};

/// How a tile is written.
struct TileForm {
  /// EXT_meshopt_compression, where the build has the library.
  bool compressed = false;
  /// Single precision, no KHR_mesh_quantization.
  bool floats = false;
  TileInstancing instancing = TileInstancing::Gpu;
};

/// Triangles without area in single precision are left out.
TileMesh meshOf(const TileContent& content, const WriteOptions& options);
TileMesh meshOf(const CoarseModel& model);

/// As it was written, to tell whether it still is.
struct TileFile {
  std::string name;
  uint64_t bytes = 0, checksum = 0;
};

class TileImages;

/// Writes it as GLB to `folder` + `name`, and its pictures to `images`: EXT_mesh_features,
/// EXT_structural_metadata with a table of features. A vertex is at most kMostQuantized from its
/// place where the tile is compressed, WriteOptions::kMostQuantized where it is not, and in its
/// place where it has floats. Codes: file-unwritable, model-too-large.
Result<TileFile> writeTile(const TileMesh& mesh, const std::string& folder, const std::string& name,
                           const TileForm& form, TileImages& images);

}  // namespace gable
