// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The vertices of a tile as its file has them. Primitives whose vertices have the same attributes
// in the same bytes are one stream: they share its vertices, and so the accessors that describe
// them, and each has a range of its triangles. A tile has few streams, and its JSON is short.
//
// Integers for positions (KHR_mesh_quantization) count steps of one size from a corner of the tile,
// or of a part that is placed several times: then the places scale the steps.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf_format.h"
#include "tiles/tile_mesh.h"

namespace gable {

/// Where an attribute of a vertex lies, and as what numbers.
struct TileField {
  uint32_t offset = 0;
  int component = gltf::kFloat;
  bool normalized = false;
};

struct TileLayout {
  TileField position, normal, color, feature, uv;
  /// Whether vertices say what they are part of.
  bool features = false;
  uint32_t uvCount = 0;
  uint32_t stride = 0;

  uint32_t attributes() const { return 3 + (features ? 1 : 0) + uvCount; }
};

/// Of the tile's own mesh, or of instances.
struct TileSteps {
  bool on = false;
  std::array<float, 3> low{};
  double size = 0;

  Vec3 corner() const { return on ? Vec3{double{low[0]}, double{low[1]}, double{low[2]}} : Vec3{}; }
};

struct TileStream {
  TileLayout layout;
  std::string vertices;
  std::vector<uint32_t> indices;
  /// Of positions as they are written.
  std::array<float, 3> low, high;

  TileStream();
  uint32_t count() const { return static_cast<uint32_t>(vertices.size() / layout.stride); }
  /// Of an index: the highest number of 16 bits is not one.
  bool isShort() const { return count() <= 65535; }
};

/// A primitive of the file: of the mesh 0, the tile's own, or of that of instances `mesh` - 1.
struct TileRange {
  const TilePrimitive* primitive = nullptr;
  size_t mesh = 0, stream = 0;
  uint64_t firstIndex = 0, indexCount = 0;
};

class TileStreams {
 public:
  /// Where instances are nodes, each mesh has streams of its own.
  TileStreams(const TileMesh& mesh, const TileForm& form);

  const std::vector<TileStream>& all() const { return streams_; }
  /// Those of a mesh follow one another, in the order of meshes.
  const std::vector<TileRange>& ranges() const { return ranges_; }
  /// Of a mesh, ascending.
  std::vector<size_t> of(size_t mesh) const;
  /// By mesh.
  const TileSteps& steps(size_t mesh) const { return steps_[mesh]; }

 private:
  TileSteps stepsOf(const std::vector<TilePrimitive>& primitives, bool own) const;
  TileLayout layoutOf(const TilePrimitive& p, size_t mesh) const;
  size_t streamOf(const TileLayout& layout, size_t mesh);
  void add(const TilePrimitive& p, size_t mesh);
  void measure(TileStream& stream) const;

  const TileMesh& mesh_;
  const TileForm form_;
  std::vector<TileSteps> steps_;
  std::vector<TileStream> streams_;
  /// By stream: the mesh that alone has it, where they are apart.
  std::vector<size_t> meshOfStream_;
  std::vector<TileRange> ranges_;
};

}  // namespace gable
