// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The JSON half of a glTF file: from what was put into the buffer to the text that describes it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/exporters/gltf_materials.h"
#include "io/exporters/plan.h"

namespace gable {

/// One primitive in the buffer: interleaved vertices, then triangle indices. Small ones of one
/// layout follow each other as a run: the vertices of all, which the first has, then the indices of
/// all. Each accessor costs more text than a small primitive has numbers.
struct GltfPrimitive {
  uint32_t variant = 0;
  /// Of the run; 0 behind the first.
  uint32_t vertexCount = 0;
  uint32_t indexCount = 0;
  /// Of the run, where this is its first.
  uint32_t runIndices = 0;
  bool first = true;
  bool wideIndices = false;
  uint64_t vertexOffset = 0, indexOffset = 0;
  std::array<float, 3> min{}, max{};
};

/// Placements of one unit as columns of numbers (EXT_mesh_gpu_instancing), 40 bytes an instance:
/// translations, rotations, scales.
struct GltfInstances {
  uint64_t offset = 0;
  uint32_t count = 0;
};

/// A run of bytes that is an image.
struct GltfImageRange {
  uint64_t offset = 0, bytes = 0;
};

struct GltfContent {
  /// By unit.
  std::vector<std::vector<GltfPrimitive>> meshes;
  /// By unit.
  std::vector<VertexGrid> grids;
  /// By unit, a list entry for each group of equal children; empty when nodes show them one by one.
  std::vector<std::vector<GltfInstances>> instances;
  /// By image; empty for a file whose images lie beside it.
  std::vector<GltfImageRange> images;
  uint64_t bufferBytes = 0;
  /// The file of the buffer; empty inside a GLB.
  std::string bufferUri;
  /// By image, when they lie beside the file.
  std::vector<std::string> imageUris;
};

class GltfDocument {
 public:
  GltfDocument(const Scene& scene, const ScenePlan& plan, const GltfMaterials& materials,
               const WriteOptions& options);

  /// Numbers nodes and meshes, and gives the number of nodes: it may be too large to write them.
  /// Grids are by unit: what a node shows is placed by its scale, so a mesh on a grid whose unit
  /// has children has a node of its own.
  uint64_t planNodes(const std::vector<bool>& hasMesh, const std::vector<VertexGrid>& grids,
                     bool instanced);
  /// Where an instance of a unit stands, its grid included.
  static Vec3 placeOf(const PlannedChild& c, const VertexGrid& grid);
  static Vec3 scaleOf(const Vec3& scale, const VertexGrid& grid);
  /// Nodes depend on nothing but which units have a mesh.
  void writeNodes();
  /// The whole text. With `roomy`, numbers that are not known yet take as much room as they can
  /// ever need, so that the final text is not longer: the content then has the most that its counts
  /// and bytes can become.
  std::string text(const GltfContent& content, bool roomy) const;

  /// Children of a unit that one node can show together: equal units without children of their own,
  /// in the order of their first; singles are groups of one.
  struct Group {
    uint32_t unit = 0;
    std::vector<uint32_t> children;
  };
  static std::vector<Group> groupsOf(const ScenePlan& plan, uint32_t unit, bool instanced);

 private:
  struct NodePlace {
    const Frame* frame;
    Vec3 scale;
    const std::string* name;
    uint32_t leaf;
    /// The nodes of its levels of detail, or null.
    const std::vector<uint64_t>* levels = nullptr;
  };
  uint64_t nodesFor(const Group& g) const;
  uint64_t nodeCount(uint32_t unit) const { return nodeCounts_[unit]; }
  void countNodes();
  /// A unit whose nodes are being written.
  struct OpenUnit {
    uint32_t unit = 0;
    /// Of the next child: its node's number, and its accessors where it is a group.
    uint64_t next = 0;
    uint32_t accessor = 0;
    size_t group = 0;
    std::vector<Group> groups;
  };
  void writeTree(JsonWriter& w, uint32_t unit, const NodePlace& place, uint64_t index);
  void writeNode(JsonWriter& w, const OpenUnit& open, const NodePlace& place) const;
  void writeMeshNode(JsonWriter& w, uint32_t unit) const;
  void writeGroup(JsonWriter& w, const Group& g, uint32_t accessor) const;
  void writeExtras(JsonWriter& w, const Leaf& leaf) const;
  std::vector<std::vector<uint64_t>> levelNodes() const;
  void writeLevels(JsonWriter& w, const std::vector<uint64_t>& levels) const;
  const std::string& nameOf(uint32_t unit) const;
  void writeMeshes(JsonWriter& w, const GltfContent& content) const;
  void writeAccessors(JsonWriter& w, const GltfContent& content, bool roomy) const;
  void writeViews(JsonWriter& w, const GltfContent& content, bool roomy) const;
  void writeImages(JsonWriter& w, const GltfContent& content) const;

  const Scene& scene_;
  const ScenePlan& plan_;
  const GltfMaterials& materials_;
  const WriteOptions& options_;
  bool instanced_ = false;
  // By unit: nodes that showing it takes (0 when it shows nothing), and its mesh's number.
  std::vector<uint64_t> nodeCounts_;
  std::vector<int64_t> meshNumbers_;
  std::vector<VertexGrid> grids_;
  // By unit: whether its mesh has a node of its own.
  std::vector<bool> apart_;
  std::vector<uint32_t> instanceBase_;
  std::string nodes_, roots_;
  uint64_t nodesWritten_ = 0;
  bool hasLevels_ = false;
};

}  // namespace gable
