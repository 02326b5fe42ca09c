// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the readers of meshes have in common: only faces that have an area come in, only positions
// that faces use are kept.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geom/mesh/mesh.h"
#include "io/importers/asset.h"

namespace gable {

class FaceFilter {
 public:
  /// `positions` must outlive the filter and may grow. With `zUp`, z becomes y and y becomes -z.
  FaceFilter(const std::vector<Vec3>& positions, bool zUp) : positions_(positions), zUp_(zUp) {}

  /// Whether the polygon has an area in finite numbers; kept() then tells which corners remain when
  /// repetitions of the same position are left out.
  bool accept(const std::vector<uint32_t>& corners);
  const std::vector<uint32_t>& kept() const { return kept_; }

  /// The number of a position in the mesh.
  uint32_t position(uint32_t index);
  Vec3 direction(const Vec3& d) const { return zUp_ ? Vec3{d.x, d.z, -d.y} : d; }
  MeshBuilder& builder() { return builder_; }
  uint64_t dropped() const { return dropped_; }

 private:
  const std::vector<Vec3>& positions_;
  bool zUp_;
  std::vector<uint32_t> numbers_, kept_;
  MeshBuilder builder_;
  uint64_t dropped_ = 0;
};

/// Of an asset that needs more of what a table of ours can hold.
Error tooManyOf(const char* what, size_t most, const AssetOptions& options, const char* hint);

/// Checks the mesh and fills in what the asset still lacks.
Result<Asset> finishAsset(Mesh mesh, Asset asset, const AssetOptions& options);

}  // namespace gable
