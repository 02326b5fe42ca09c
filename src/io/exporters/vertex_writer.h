// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Turns leaves into interleaved vertices and triangle indices, straight into the buffer of the
// file. Positions are single precision, or whole steps of a grid. Triangles without area in those
// numbers, and faces with a number that is not finite, are left out; mirrored leaves are turned
// round. Faces share vertices that are equal. Boxes, of which most leaves are made, have a way of
// their own and share none.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "base/files.h"
#include "io/exporters/gltf_materials.h"
#include "io/exporters/surface.h"
#include "io/exporters/written_vertices.h"
#include "scene/scene.h"

namespace gable {

/// What has been written of one primitive so far.
struct PrimitiveState {
  VertexGrid grid;
  uint32_t vertexCount = 0;
  std::vector<uint32_t> indices;
  /// As they are written: steps on a grid.
  std::array<float, 3> min, max;
  /// All but the grid.
  void clear() {
    vertexCount = 0;
    indices.clear();
    min.fill(std::numeric_limits<float>::infinity());
    max.fill(-std::numeric_limits<float>::infinity());
  }
};

class VertexWriter {
 public:
  VertexWriter(const Scene& scene, FileWriter& out);

  /// Appends what the leaf's mesh has in `slot`, placed by `frame` and `scale`.
  void add(uint32_t mesh, uint16_t slot, const Frame& frame, const Vec3& scale,
           const VertexLayout& layout, PrimitiveState& state);

  /// Forgets prepared surfaces when they have become many; call it where content changes.
  void trimCache();

  /// Faces left out because of numbers that are not finite.
  uint64_t brokenFaces() const { return brokenFaces_; }

 private:
  // A box with normals and uv in place; only positions (and normals, when turned) are filled in.
  struct BoxTemplate {
    std::array<uint8_t, 24> corner;
    std::array<uint8_t, 24> side;
    std::array<std::array<float, 2>, 24> uv;
    /// The same as UvForm::Unit.
    std::array<std::array<uint16_t, 2>, 24> narrowUv;
    std::array<uint8_t, 36> indices;
  };
  struct CachedSurface {
    DrawSurface surface;
    std::map<int, Tangents> tangents;
  };

  static BoxTemplate boxTemplate(const Mesh& m);
  char* pack(const float* vertices, uint32_t count, const VertexLayout& layout, bool quantized);
  void appendCorners(const char (&corners)[8][12], const BoxTemplate& box, size_t bytes,
                     PrimitiveState& state);
  bool addBox(uint32_t mesh, const Frame& frame, const Vec3& scale, const VertexLayout& layout,
              PrimitiveState& state);
  void addFace(const Mesh& m, const DrawSurface& s, const Tangents* tangents,
               const SurfaceFace& face, const VertexLayout& layout, PrimitiveState& state);
  const float* writeVertices(const Mesh& m, const DrawSurface& s, const Tangents* tangents,
                             const SurfaceFace& face, const VertexLayout& layout,
                             const VertexGrid& grid);
  CachedSurface& surfaceOf(uint32_t mesh, bool laid);

  const Scene& scene_;
  FileWriter& out_;
  FaceTriangulator triangulator_;
  std::array<BoxTemplate, 2> boxes_;
  // By mesh; meshes that one leaf shows are made anew each time.
  std::vector<uint32_t> uses_;
  // Faces of what is laid stay apart: each has coordinates of its own.
  std::vector<std::unique_ptr<CachedSurface>> cache_, laidCache_;
  CachedSurface single_;
  uint32_t singleMesh_ = 0xffffffff;
  bool singleLaid_ = false;
  uint64_t cachedVertices_ = 0;
  // Of the leaf at hand.
  Frame frame_;
  Vec3 scale_;
  bool mirrored_ = false;
  // Of the face at hand, where it is laid.
  FaceAxes axes_;
  std::vector<float> scratch_;
  std::vector<char> packed_;
  std::vector<uint32_t> numbers_;
  WrittenVertices written_;
  uint64_t brokenFaces_ = 0;
};

}  // namespace gable
