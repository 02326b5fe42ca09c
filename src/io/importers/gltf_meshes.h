// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Collects the triangles of placed glTF meshes into one mesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "io/importers/face_filter.h"
#include "io/importers/gltf_file.h"
#include "io/importers/gltf_materials.h"

namespace gable {

class GltfMeshes {
 public:
  /// Slots and groups of the faces go to `asset`.
  GltfMeshes(const GltfFile& file, const std::vector<GltfMaterial>& materials, Asset& asset,
             bool zUp)
      : file_(file), materials_(materials), asset_(asset), filter_(points_, zUp) {}

  /// False when there is too much of it.
  bool add(const GltfPlacement& placement, uint32_t group);
  Mesh take();
  uint64_t dropped() const { return filter_.dropped(); }
  /// Numbers read so far; a small file can show one mesh a million times.
  uint64_t work() const { return work_; }
  static constexpr uint64_t kMostWork = 200'000'000;
  /// Primitives that are no triangles or whose data is wrong.
  uint64_t broken() const { return broken_; }
  /// More than a mesh has slots for.
  bool tooManyMaterials() const { return tooManyMaterials_; }

 private:
  struct PositionHash {
    size_t operator()(const std::array<double, 3>& p) const;
  };
  bool readPrimitive(const JsonValue& p);
  void readColors(const JsonValue& attributes, size_t count);
  void place(const Affine& world);
  int texcoordFor(size_t material, int set) const;
  const Material& materialOf(size_t material) const;
  uint16_t slotOf(size_t material);
  uint16_t coloredSlotOf(size_t material, const uint32_t (&vertices)[3]);
  uint16_t newSlot(const Material& m);
  void addTriangles(const JsonValue& primitive, size_t material, const Affine& world,
                    uint32_t group);

  const GltfFile& file_;
  const std::vector<GltfMaterial>& materials_;
  Asset& asset_;
  std::vector<Vec3> points_;
  FaceFilter filter_;
  std::unordered_map<std::array<double, 3>, uint32_t, PositionHash> known_;
  std::vector<uint32_t> slots_;
  /// Slots of materials with a colour of vertices: red, green, blue and alpha as bytes.
  std::map<std::pair<size_t, std::array<uint8_t, 4>>, uint16_t> coloredSlots_;
  uint64_t work_ = 0, broken_ = 0;
  bool tooManyMaterials_ = false;
  // Of the primitive at hand. Colours are four numbers a vertex, in linear light; none where white.
  std::vector<double> positions_, normals_, colors_;
  std::vector<std::vector<double>> uvs_;
  std::vector<uint32_t> indices_, numbers_, triangle_;
};

}  // namespace gable
