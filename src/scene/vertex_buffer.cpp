// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "scene/vertex_buffer.h"

#include <algorithm>
#include <cstring>

namespace gable {

namespace {

template <class T>
T* reserve(std::unique_ptr<T[]>& data, size_t used, size_t& capacity, size_t more) {
  if (used + more > capacity) {
    const size_t grown = std::max(used + more, capacity * 2 + 4096);
    std::unique_ptr<T[]> moved(new T[grown]);
    if (used > 0) std::memcpy(moved.get(), data.get(), used * sizeof(T));
    data = std::move(moved);
    capacity = grown;
  }
  return data.get() + used;
}

// Corners of the unit box by bits (x 1, y 2, z 4), face by face, counter-clockwise from outside.
constexpr uint8_t kBoxCorners[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7},
                                       {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
constexpr int kBoxAxis[6] = {2, 2, 0, 0, 1, 1};
constexpr float kBoxSign[6] = {1, -1, 1, -1, 1, -1};
constexpr float kUv[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
constexpr uint32_t kFaceIndices[6] = {0, 1, 2, 0, 2, 3};

struct Vec3f {
  float x, y, z;
};

Vec3f narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Along one axis or along three.
bool isMirrored(const Vec3& size) { return size.x * size.y * size.z < 0; }

// Boxes with the same axes: their normals, texture coordinates and indices are made once. Only the
// corners differ from box to box.
class BoxBatch {
 public:
  explicit BoxBatch(const Frame& axes) : x_(axes.x), y_(axes.y), z_(axes.z) {
    const Vec3f axisOf[3] = {narrow(x_), narrow(y_), narrow(z_)};
    for (int f = 0; f < 6; ++f) {
      const Vec3f& axis = axisOf[kBoxAxis[f]];
      const float sign = kBoxSign[f];
      for (int c = 0; c < 4; ++c) {
        vertices_[f * 4 + c] = {
            {}, {axis.x * sign, axis.y * sign, axis.z * sign}, {kUv[c][0], kUv[c][1]}};
      }
      for (int i = 0; i < 6; ++i)
        indices_[f * 6 + i] = static_cast<uint32_t>(f) * 4 + kFaceIndices[i];
    }
  }

  /// `size` mirrors nothing.
  void write(const Vec3& o, const Vec3& size, BufferVertex* v, uint32_t* index,
             uint32_t base) const {
    const Vec3 ex = x_ * size.x, ey = y_ * size.y, oz = o + z_ * size.z;
    const Vec3f corners[8] = {narrow(o),  narrow(o + ex),  narrow(o + ey),  narrow(o + ex + ey),
                              narrow(oz), narrow(oz + ex), narrow(oz + ey), narrow(oz + ex + ey)};
    std::memcpy(v, vertices_, sizeof vertices_);
    for (int f = 0; f < 6; ++f) {
      for (int c = 0; c < 4; ++c, ++v)
        std::memcpy(v->position, &corners[kBoxCorners[f][c]], sizeof v->position);
    }
    for (int i = 0; i < 36; ++i) index[i] = base + indices_[i];
  }

 private:
  Vec3 x_, y_, z_;
  BufferVertex vertices_[24];
  uint32_t indices_[36];
};

}  // namespace

BufferVertex* VertexBuffer::reserveVertices(size_t count) {
  return reserve(vertices_, vertexCount_, vertexCapacity_, count);
}

uint32_t* VertexBuffer::reserveIndices(size_t count) {
  return reserve(indices_, indexCount_, indexCapacity_, count);
}

void appendBox(const Frame& axes, const Vec3& o, const Vec3& size, VertexBuffer& out) {
  const Vec3f axisOf[3] = {narrow(axes.x), narrow(axes.y), narrow(axes.z)};
  const Vec3 ex = axes.x * size.x, ey = axes.y * size.y, ez = axes.z * size.z;
  const Vec3 oz = o + ez;
  const Vec3f corners[8] = {narrow(o),  narrow(o + ex),  narrow(o + ey),  narrow(o + ex + ey),
                            narrow(oz), narrow(oz + ex), narrow(oz + ey), narrow(oz + ex + ey)};
  // A mirrored box turns its faces round.
  const bool mirrored = isMirrored(size);
  BufferVertex* v = out.reserveVertices(24);
  uint32_t* index = out.reserveIndices(36);
  const auto base = static_cast<uint32_t>(out.vertexCount());
  for (int f = 0; f < 6; ++f) {
    const Vec3f& axis = axisOf[kBoxAxis[f]];
    const float sign = size[kBoxAxis[f]] < 0 ? -kBoxSign[f] : kBoxSign[f];
    const Vec3f n{axis.x * sign, axis.y * sign, axis.z * sign};
    for (int c = 0; c < 4; ++c, ++v) {
      const Vec3f& p = corners[kBoxCorners[f][c]];
      *v = {{p.x, p.y, p.z}, {n.x, n.y, n.z}, {kUv[c][0], kUv[c][1]}};
    }
    for (int i = 0; i < 6; ++i) {
      *index++ = base + static_cast<uint32_t>(f) * 4 + kFaceIndices[mirrored ? 5 - i : i];
    }
  }
  out.advance(24, 36);
}

void appendBoxes(const Frame& axes, const Vec3& origin, std::span<const Leaf> boxes,
                 VertexBuffer& out) {
  const BoxBatch batch(axes);
  BufferVertex* v = out.reserveVertices(24 * boxes.size());
  uint32_t* index = out.reserveIndices(36 * boxes.size());
  for (const Leaf& box : boxes) {
    const Vec3& size = box.scale;
    const Vec3 o = origin + axes.direction(box.frame.origin);
    if (box.frame.turned || size.x < 0 || size.y < 0 || size.z < 0)
      appendBox(axes * box.frame, o, size, out);
    else {
      batch.write(o, size, v, index, static_cast<uint32_t>(out.vertexCount()));
      out.advance(24, 36);
    }
    v += 24, index += 36;
  }
}

}  // namespace gable
