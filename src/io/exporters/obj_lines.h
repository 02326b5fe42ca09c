// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The lines of leaves in an OBJ file. Leaves come in blocks: how many vertices, texture coordinates
// and normals stand before a block is counted first, so threads can write blocks at a time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/text_buffer.h"
#include "io/exporters/triangle_cache.h"
#include "scene/scene.h"

namespace gable {

/// A word without what OBJ takes for an end: spaces and control characters become underscores.
std::string objWord(const std::string& name, const char* fallback);

/// Numbers that lines of faces count from.
struct ObjCounts {
  uint64_t vertices = 0, uvs = 0, normals = 0;
};

/// What all blocks share: the words of materials and groups, and how much a leaf adds to the
/// counts.
class ObjPlan {
 public:
  explicit ObjPlan(const Scene& scene);

  const Scene& scene() const { return scene_; }
  /// By material; the last is the default one.
  const std::vector<std::string>& materialNames() const { return materialNames_; }
  /// Whole lines.
  const std::string& groupLine(const Leaf& leaf) const { return groupLines_[groupOf(leaf)]; }
  std::string materialLine(uint32_t material) const;
  std::string rootLine(const Root& root) const;
  /// Equal for leaves in one group.
  uint32_t groupOf(const Leaf& leaf) const;
  uint32_t materialOf(const Leaf& leaf, uint32_t slot) const;

  /// The material's texture lies in metres, or is turned besides.
  bool isLaid(const Leaf& leaf, uint32_t slot) const { return laid_[materialOf(leaf, slot)]; }
  bool isTurned(const Leaf& leaf, uint32_t slot) const { return turned_[materialOf(leaf, slot)]; }
  /// A box that has six different numbers, where it is not turned, and eight vertices.
  bool isPlainBox(const Leaf& leaf, const Frame& world) const;
  /// Whether texture coordinates are written; of what is no plain box.
  bool hasUvs(const Leaf& leaf) const;
  ObjCounts countsOf(const Leaf& leaf, const Frame& world) const;

 private:
  const Scene& scene_;
  std::vector<std::string> groupLines_, materialNames_;
  std::vector<bool> turned_, laid_;
  /// By mesh: the material slots of its faces, each once.
  std::vector<std::vector<uint16_t>> slots_;
};

/// Writes blocks as text, one thread. The state that lines take over from those before, group and
/// material, begins anew with each block. On cache lines of its own.
class alignas(64) ObjLines {
 public:
  explicit ObjLines(const ObjPlan& plan);

  /// Begins a block behind so much. The text has to last until the next one.
  void begin(const ObjCounts& before, TextBuffer& text);
  void addRoot(const Root& root);
  void add(const Leaf& leaf, const Frame& world);

  /// Of all blocks since it was made.
  uint64_t triangles() const { return triangles_; }
  /// By material: whether a face has it.
  const std::vector<bool>& used() const { return used_; }

 private:
  void addBox(const Leaf& leaf, const Frame& world);
  void addMesh(const Leaf& leaf, const Frame& world);
  void addFace(const Mesh& m, size_t face, const Leaf& leaf, bool turn);
  void putPolygon(const Mesh& m, const uint32_t* corners, size_t count, bool turn);
  bool hasArea(const Mesh& m, const uint32_t* corners, size_t count) const;
  void useMaterial(const Leaf& leaf, uint32_t slot);
  void layFace(const Mesh& m, size_t face, bool mirrored, std::vector<Vec2>& uvs) const;
  void putUvs(const Mesh& m, const Leaf& leaf);
  void putLine(const char* word, const Vec3& v);

  const ObjPlan& plan_;
  TriangleCache meshTriangles_;
  TextBuffer* out_ = nullptr;
  ObjCounts at_;
  uint32_t group_ = 0, material_ = 0;
  uint64_t triangles_ = 0;
  std::vector<bool> used_;
  // Of the leaf at hand.
  std::vector<Vec3> placed_;
  std::vector<uint32_t> corners_;
  uint64_t uvBase_ = 0, normalBase_ = 0;
  bool hasUv_ = false, hasNormals_ = false;
};

}  // namespace gable
