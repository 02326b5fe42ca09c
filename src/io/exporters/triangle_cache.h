// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Triangles of a scene's meshes for writers that need no normals, made when first asked for and
// kept while they are few.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "geom/mesh/face_triangles.h"
#include "scene/scene.h"

namespace gable {

struct MeshTriangles {
  /// Corner indices of the mesh.
  std::vector<std::array<uint32_t, 3>> triangles;
  /// By face: where its triangles end.
  std::vector<size_t> faceEnds;
};

class TriangleCache {
 public:
  explicit TriangleCache(const Scene& scene) : scene_(scene), all_(scene.meshes.size()) {}

  /// Good until the next call.
  const MeshTriangles& of(uint32_t mesh) {
    if (!all_[mesh]) {
      if (kept_ > kMostTriangles) {
        for (auto& m : all_) m.reset();
        kept_ = 0;
      }
      all_[mesh] = std::make_unique<MeshTriangles>();
      MeshTriangles& t = *all_[mesh];
      const Mesh& m = *scene_.meshes[mesh];
      for (size_t f = 0; f < m.faceCount(); ++f) {
        triangulator_.add(m, f, t.triangles);
        t.faceEnds.push_back(t.triangles.size());
      }
      kept_ += t.triangles.size() + 8;
    }
    return *all_[mesh];
  }

 private:
  // About 60 MB.
  static constexpr size_t kMostTriangles = 4'000'000;
  const Scene& scene_;
  FaceTriangulator triangulator_;
  std::vector<std::unique_ptr<MeshTriangles>> all_;
  size_t kept_ = 0;
};

}  // namespace gable
