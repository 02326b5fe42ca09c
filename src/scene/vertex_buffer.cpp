// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "scene/vertex_buffer.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "geom/mesh/face_triangles.h"

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

void appendMesh(const Mesh& mesh, const Frame& frame, const Vec3& scale, VertexBuffer& out) {
  const Mesh placed = transformed(mesh, scale, frame);
  FaceTriangulator faces;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (size_t f = 0; f < placed.faceCount(); ++f) {
    triangles.clear();
    faces.add(placed, f, triangles);
    if (triangles.empty()) continue;
    const Vec3f n = narrow(placed.normal(f));
    const auto loops = placed.loopsOf(f);
    const uint32_t first = loops[0].firstCorner;
    uint32_t end = first;
    for (const MeshLoop& l : loops) end = std::max(end, l.firstCorner + l.cornerCount);
    BufferVertex* v = out.reserveVertices(end - first);
    const auto base = static_cast<uint32_t>(out.vertexCount());
    for (uint32_t c = first; c < end; ++c, ++v) {
      const Vec3f p = narrow(placed.at(c));
      const Vec2 uv = placed.hasUv(0) ? placed.uvs[0][c] : Vec2{};
      *v = {{p.x, p.y, p.z}, {n.x, n.y, n.z}, {static_cast<float>(uv.x), static_cast<float>(uv.y)}};
    }
    uint32_t* i = out.reserveIndices(triangles.size() * 3);
    for (const auto& t : triangles) {
      for (uint32_t c : t) *i++ = base + c - first;
    }
    out.advance(end - first, triangles.size() * 3);
  }
}

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
  const bool mirrored = size.x * size.y * size.z < 0;
  BufferVertex* v = out.reserveVertices(24);
  uint32_t* index = out.reserveIndices(36);
  const auto base = static_cast<uint32_t>(out.vertexCount());
  for (int f = 0; f < 6; ++f) {
    const Vec3f& axis = axisOf[kBoxAxis[f]];
    const float sign = mirrored ? -kBoxSign[f] : kBoxSign[f];
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

void flatten(const Scene& scene, VertexBuffer& out) {
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    if (leaf.mesh == kUnitBox || leaf.mesh == kUnitBoxUv)
      appendBox(world, world.origin, leaf.scale, out);
    else
      appendMesh(*scene.meshes[leaf.mesh], world, leaf.scale, out);
  });
}

}  // namespace gable
