// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// VertexBuffer: boxes as one flat list of triangles, the form that graphics memory takes. Buffers
// keep their memory between uses, so that a benchmark can fill one again and again.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "scene/scene.h"

namespace gable {

/// Position, normal and uv set 0, in the world: 32 bytes.
struct BufferVertex {
  float position[3];
  float normal[3];
  float uv[2];
};
static_assert(sizeof(BufferVertex) == 32);

class VertexBuffer {
 public:
  /// Drops the content, keeps the memory.
  void clear() { vertexCount_ = indexCount_ = 0; }
  const BufferVertex* vertices() const { return vertices_.get(); }
  const uint32_t* indices() const { return indices_.get(); }
  size_t vertexCount() const { return vertexCount_; }
  size_t indexCount() const { return indexCount_; }

  /// Room for more; what is written there counts after advance().
  BufferVertex* reserveVertices(size_t count);
  uint32_t* reserveIndices(size_t count);
  void advance(size_t vertices, size_t indices) {
    vertexCount_ += vertices;
    indexCount_ += indices;
  }

 private:
  std::unique_ptr<BufferVertex[]> vertices_;
  std::unique_ptr<uint32_t[]> indices_;
  size_t vertexCount_ = 0, vertexCapacity_ = 0;
  size_t indexCount_ = 0, indexCapacity_ = 0;
};

/// Appends the unit box scaled by `size`, with the axes of `axes`, beginning at `origin`: 24
/// vertices, since faces are flat-shaded, and 36 indices.
void appendBox(const Frame& axes, const Vec3& origin, const Vec3& size, VertexBuffer& out);

/// Appends leaves that are unit boxes. They lie in a frame with the axes of `axes` that begins at
/// `origin`.
void appendBoxes(const Frame& axes, const Vec3& origin, std::span<const Leaf> boxes,
                 VertexBuffer& out);

}  // namespace gable
