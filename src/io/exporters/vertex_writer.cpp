// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/vertex_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "geom/mesh/corner_normals.h"

namespace gable {
namespace {

bool isUnitBox(uint32_t mesh) { return mesh == kUnitBox || mesh == kUnitBoxUv; }

// Zero has one sign, so that equal vertices have equal bytes.
float* put(float* p, const Vec3& v) {
  for (size_t i = 0; i < 3; ++i) p[i] = static_cast<float>(v[i]) + 0.0f;
  return p + 3;
}

void setOnGrid(float* p, const VertexGrid& grid) {
  for (size_t i = 0; i < 3; ++i) {
    // Told apart later: faces with such a number are left out.
    if (!std::isfinite(p[i])) continue;
    const double steps = std::round((double{p[i]} - grid.low[i]) / grid.step);
    p[i] = static_cast<float>(std::clamp(steps, 0.0, VertexGrid::kMostSteps));
  }
}

char* putSteps(char* to, const float* position) {
  uint16_t q[4]{};
  for (size_t i = 0; i < 3; ++i) q[i] = static_cast<uint16_t>(position[i]);
  std::memcpy(to, q, 8);
  return to + 8;
}

// A direction in bytes; the fourth is zero.
char* putBytes(char* to, const float* v) {
  int8_t q[4]{};
  for (size_t i = 0; i < 3; ++i) {
    q[i] = static_cast<int8_t>(std::round(std::clamp(v[i], -1.0f, 1.0f) * 127));
  }
  std::memcpy(to, q, 4);
  return to + 4;
}

uint16_t narrow(double v) {
  return static_cast<uint16_t>(std::round(std::clamp(v, 0.0, 1.0) * 65535));
}

// Uv sets as they are written: `vertices` are floats, uv sets at `first`.
struct UvPacker {
  const VertexLayout& layout;
  const double repeats = repeatsOf(layout.uvForm);
  // By uv set: where its repeats begin.
  std::array<Vec2, kTextureLayers> start{};

  UvPacker(const VertexLayout& l, const float* vertices, uint32_t count, size_t first) : layout(l) {
    if (repeats == 0) return;
    for (size_t i = 0; i < layout.uvCount; ++i) {
      Vec2 low{HUGE_VAL, HUGE_VAL};
      for (uint32_t v = 0; v < count; ++v) {
        const Vec2 at = repeatsAt(vertices + v * size_t{layout.floats()} + first + 2 * i);
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      }
      start[i] = {std::floor(low.x / kUvStart) * kUvStart, std::floor(low.y / kUvStart) * kUvStart};
    }
  }

  Vec2 repeatsAt(const float* uv) const {
    return {uv[0] * layout.uvRepeats.x, uv[1] * layout.uvRepeats.y};
  }

  char* put(char* to, const float* uv, size_t set) const {
    if (layout.uvForm == UvForm::Float) {
      std::memcpy(to, uv, 8);
      return to + 8;
    }
    Vec2 at{uv[0], uv[1]};
    if (repeats > 0) at = (repeatsAt(uv) - start[set]) * (1 / repeats);
    const uint16_t q[2] = {narrow(at.x), narrow(at.y)};
    std::memcpy(to, q, 4);
    return to + 4;
  }
};

// Corners of a box, and the normals of its sides, as they are written.
template <size_t kPosition, size_t kNormal, class Box, class Uv>
char* fillBox(char* p, const Box& box, const char (&corners)[8][12], const char (&normals)[6][12],
              const Uv* uv) {
  for (size_t v = 0; v < 24; ++v) {
    std::memcpy(p, corners[box.corner[v]], kPosition);
    std::memcpy(p + kPosition, normals[box.side[v]], kNormal);
    p += kPosition + kNormal;
    if (uv) {
      std::memcpy(p, uv + v, sizeof *uv);
      p += sizeof *uv;
    }
  }
  return p;
}

// Differences and products of floats are exact in double precision or at least keep their sign, so
// the area is zero exactly when the triangle has none. False for NaN.
bool hasArea(const float* a, const float* b, const float* c) {
  const Vec3 u{double{b[0]} - a[0], double{b[1]} - a[1], double{b[2]} - a[2]};
  const Vec3 v{double{c[0]} - a[0], double{c[1]} - a[1], double{c[2]} - a[2]};
  const Vec3 n = cross(u, v);
  return dot(n, n) > 0;
}

void include(PrimitiveState& s, const float* p) {
  for (size_t i = 0; i < 3; ++i) {
    s.min[i] = std::min(s.min[i], p[i]);
    s.max[i] = std::max(s.max[i], p[i]);
  }
}

// A unit tangent perpendicular to the normal; any where the uv set does not say.
Vec3 tangentFor(const Vec3& normal, const Vec3& u) {
  Vec3 t = u - normal * dot(u, normal);
  if (!(dot(t, t) > 0)) {
    const Vec3 other = std::fabs(normal.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    t = other - normal * dot(other, normal);
  }
  return unitOf(t);
}

}  // namespace

VertexWriter::VertexWriter(const Scene& scene, FileWriter& out)
    : scene_(scene),
      out_(out),
      boxes_{boxTemplate(*scene.meshes[kUnitBox]), boxTemplate(*scene.meshes[kUnitBoxUv])},
      uses_(scene.meshes.size()),
      cache_(scene.meshes.size()),
      laidCache_(scene.meshes.size()) {
  for (const Leaf& l : scene.leaves) uses_[l.mesh] += uses_[l.mesh] < 2 ? 1 : 0;
  for (const Instance& in : scene.instances) {
    // A placed prototype may be expanded several times.
    const Prototype& p = scene.prototypes[in.prototype];
    for (uint32_t i = 0; i < p.leafCount; ++i) uses_[scene.leaves[p.firstLeaf + i].mesh] = 2;
  }
}

VertexWriter::BoxTemplate VertexWriter::boxTemplate(const Mesh& m) {
  BoxTemplate box{};
  DrawSurface s;
  FaceTriangulator triangulator;
  s.build(m, triangulator);
  for (size_t v = 0; v < 24; ++v) {
    const Vec3 p = m.at(s.corners[v]);
    box.corner[v] = static_cast<uint8_t>((p.x > 0 ? 1 : 0) | (p.y > 0 ? 2 : 0) | (p.z > 0 ? 4 : 0));
    const Vec3 n = s.normals[v];
    const int axis = n.x != 0 ? 0 : n.y != 0 ? 1 : 2;
    box.side[v] = static_cast<uint8_t>(2 * axis + (n[static_cast<size_t>(axis)] > 0 ? 1 : 0));
    if (m.hasUv(0)) {
      const Vec2 uv = m.uvs[0][s.corners[v]];
      box.uv[v] = {static_cast<float>(uv.x), static_cast<float>(1 - uv.y)};
      box.narrowUv[v] = {narrow(uv.x), narrow(1 - uv.y)};
    }
  }
  size_t i = 0;
  for (const SurfaceFace& f : s.faces) {
    for (uint32_t t = 0; t < f.triangleCount; ++t) {
      for (const uint32_t v : s.triangles[f.firstTriangle + t]) {
        box.indices[i++] = static_cast<uint8_t>(f.firstVertex + v);
      }
    }
  }
  return box;
}

// False when the box needs the general way: mirrored textures, or thin against its distance, where
// single precision may leave a side without area.
bool VertexWriter::addBox(uint32_t mesh, const Frame& frame, const Vec3& scale,
                          const VertexLayout& layout, PrimitiveState& state) {
  const bool mirrors = scale.x < 0 || scale.y < 0 || scale.z < 0;
  if (layout.laid || layout.baked || layout.tangentSet >= 0 || layout.uvCount > 1 ||
      (layout.uvCount > 0 && (layout.uvForm == UvForm::Unit) != layout.compact) ||
      ((mirrors || !layout.normals) && layout.uvCount > 0))
    return false;
  const Vec3 size{std::fabs(scale.x), std::fabs(scale.y), std::fabs(scale.z)};
  const double reach = std::fabs(frame.origin.x) + std::fabs(frame.origin.y) +
                       std::fabs(frame.origin.z) + size.x + size.y + size.z;
  const double thin = std::min(std::min(size.x, size.y), size.z);
  const VertexGrid& grid = state.grid;
  if (!(thin > 1e-6 * reach) || !(reach < 1e18)) return false;
  if (grid.on && thin < 4 * grid.step) return false;

  // A mirrored box is the box from its other corner.
  const Vec3 low{std::min(scale.x, 0.0), std::min(scale.y, 0.0), std::min(scale.z, 0.0)};
  const Vec3 high{std::max(scale.x, 0.0), std::max(scale.y, 0.0), std::max(scale.z, 0.0)};
  char corners[8][12];
  for (unsigned i = 0; i < 8; ++i) {
    float at[3];
    put(at, frame.point({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}));
    if (grid.on) setOnGrid(at, grid);
    include(state, at);
    if (grid.on)
      putSteps(corners[i], at);
    else
      std::memcpy(corners[i], at, 12);
  }
  char normals[6][12];
  for (unsigned i = 0; i < 6; ++i) {
    const Vec3& axis = i < 2 ? frame.x : i < 4 ? frame.y : frame.z;
    float n[3];
    put(n, i & 1 ? axis : -axis);
    if (layout.compact)
      putBytes(normals[i], n);
    else
      std::memcpy(normals[i], n, 12);
  }
  const BoxTemplate& box = boxes_[mesh == kUnitBoxUv ? 1 : 0];
  if (!layout.normals) {
    appendCorners(corners, box, layout.positionBytes(grid.on), state);
    return true;
  }
  const auto* const uv = layout.uvCount == 1 ? box.uv.data() : nullptr;
  const auto* const narrowUv = layout.uvCount == 1 ? box.narrowUv.data() : nullptr;
  char* const to = out_.reserve(24 * size_t{layout.stride(grid.on)});
  out_.advanceTo(grid.on          ? fillBox<8, 4>(to, box, corners, normals, narrowUv)
                 : layout.compact ? fillBox<12, 4>(to, box, corners, normals, narrowUv)
                                  : fillBox<12, 12>(to, box, corners, normals, uv));
  const uint32_t base = state.vertexCount;
  const size_t first = state.indices.size();
  state.indices.resize(first + 36);
  for (size_t i = 0; i < 36; ++i) state.indices[first + i] = base + box.indices[i];
  state.vertexCount += 24;
  return true;
}

// A box without normals has eight vertices.
void VertexWriter::appendCorners(const char (&corners)[8][12], const BoxTemplate& box, size_t bytes,
                                 PrimitiveState& state) {
  for (const char* corner : corners) out_.append(corner, bytes);
  for (const uint8_t i : box.indices) {
    state.indices.push_back(state.vertexCount + box.corner[i]);
  }
  state.vertexCount += 8;
}

VertexWriter::CachedSurface& VertexWriter::surfaceOf(uint32_t mesh, bool laid) {
  const auto fill = [&](CachedSurface& c) {
    c.surface.build(*scene_.meshes[mesh], triangulator_, laid);
    c.tangents.clear();
  };
  if (mesh >= kFirstMesh && uses_[mesh] < 2) {
    // Its slots follow one another.
    if (singleMesh_ != mesh || singleLaid_ != laid) fill(single_);
    singleMesh_ = mesh;
    singleLaid_ = laid;
    return single_;
  }
  std::unique_ptr<CachedSurface>& cached = (laid ? laidCache_ : cache_)[mesh];
  if (!cached) {
    cached = std::make_unique<CachedSurface>();
    fill(*cached);
    cachedVertices_ += cached->surface.corners.size();
  }
  return *cached;
}

void VertexWriter::trimCache() {
  // About 100 MB of surfaces.
  constexpr uint64_t kMostVertices = 1'500'000;
  if (cachedVertices_ < kMostVertices) return;
  for (auto& c : cache_) c.reset();
  for (auto& c : laidCache_) c.reset();
  cachedVertices_ = 0;
}

void VertexWriter::add(uint32_t mesh, uint16_t slot, const Frame& frame, const Vec3& scale,
                       const VertexLayout& layout, PrimitiveState& state) {
  if (state.vertexCount == 0) written_.begin(layout.stride(state.grid.on));
  if (isUnitBox(mesh) && addBox(mesh, frame, scale, layout, state)) return;
  frame_ = frame;
  scale_ = scale;
  mirrored_ = ((scale.x < 0) != (scale.y < 0)) != (scale.z < 0);
  CachedSurface& cached = surfaceOf(mesh, layout.laid);
  const Mesh& m = *scene_.meshes[mesh];
  const Tangents* tangents = nullptr;
  if (layout.tangentSet >= 0 && !layout.laid) {
    const auto [at, isNew] = cached.tangents.try_emplace(layout.tangentSet);
    if (isNew) at->second = tangentsOf(m, cached.surface, layout.tangentSet);
    tangents = &at->second;
  }
  const SurfacePart* part = cached.surface.part(slot);
  if (!part) return;
  for (uint32_t f = 0; f < part->faceCount; ++f) {
    addFace(m, cached.surface, tangents, cached.surface.faces[part->firstFace + f], layout, state);
  }
}

// Vertices in floats become what the layout says.
char* VertexWriter::pack(const float* vertices, uint32_t count, const VertexLayout& layout,
                         bool quantized) {
  packed_.resize(size_t{count} * layout.stride(quantized));
  char* p = packed_.data();
  if (!layout.compact) {
    std::memcpy(p, vertices, packed_.size());
    return p;
  }
  const UvPacker uv(layout, vertices, count, 6);
  for (uint32_t v = 0; v < count; ++v) {
    if (quantized) {
      p = putSteps(p, vertices);
    } else {
      std::memcpy(p, vertices, 12);
      p += 12;
    }
    if (layout.normals) p = putBytes(p, vertices + 3);
    vertices += 6;
    for (size_t i = 0; i < layout.uvCount; ++i, vertices += 2) p = uv.put(p, vertices, i);
  }
  return packed_.data();
}

const float* VertexWriter::writeVertices(const Mesh& m, const DrawSurface& s,
                                         const Tangents* tangents, const SurfaceFace& face,
                                         const VertexLayout& layout, const VertexGrid& grid) {
  scratch_.resize(static_cast<size_t>(face.vertexCount) * layout.floats());
  if (layout.laid) axes_ = layingOf(m, s, face, frame_, scale_);
  float* p = scratch_.data();
  Vec3 localNormal, normal;
  for (uint32_t v = face.firstVertex; v < face.firstVertex + face.vertexCount; ++v) {
    const uint32_t corner = s.corners[v];
    put(p, frame_.point(scaled(m.at(corner), scale_)));
    if (grid.on) setOnGrid(p, grid);
    p += 3;
    if (v == face.firstVertex || s.normals[v] != localNormal) {
      localNormal = s.normals[v];
      normal = frame_.direction(scaledNormal(localNormal, scale_));
    }
    p = put(p, normal);
    if (layout.laid && layout.tangentSet >= 0) {
      const Vec3 t = tangentFor(normal, axes_.u);
      p = put(p, t);
      *p++ = dot(cross(normal, t), axes_.v) < 0 ? -1.0f : 1.0f;
    } else if (tangents) {
      const Vec3 u = frame_.direction(scaled(tangents->u[v], scale_));
      const Vec3 up = frame_.direction(scaled(tangents->v[v], scale_));
      const Vec3 t = tangentFor(normal, u);
      p = put(p, t);
      *p++ = dot(cross(normal, t), up) < 0 ? -1.0f : 1.0f;
    }
    for (uint32_t i = 0; i < layout.uvCount; ++i) {
      const std::vector<Vec2>& uv = m.uvs[layout.uvSets[i]];
      const Vec2 own = layout.laid  ? axes_.at(frame_.point(scaled(m.at(corner), scale_)))
                       : uv.empty() ? Vec2{}
                                    : uv[corner];
      const Vec2 at = layout.places[i].at(own);
      *p++ = static_cast<float>(at.x);
      *p++ = static_cast<float>(1 - at.y);
    }
  }
  return scratch_.data();
}

void VertexWriter::addFace(const Mesh& m, const DrawSurface& s, const Tangents* tangents,
                           const SurfaceFace& face, const VertexLayout& layout,
                           PrimitiveState& state) {
  const float* vertices = writeVertices(m, s, tangents, face, layout, state.grid);
  if (!std::all_of(scratch_.begin(), scratch_.end(), [](float f) { return std::isfinite(f); })) {
    ++brokenFaces_;
    return;
  }
  const size_t floats = layout.floats();
  const size_t first = state.indices.size();
  for (uint32_t t = 0; t < face.triangleCount; ++t) {
    const auto& tri = s.triangles[face.firstTriangle + t];
    if (!hasArea(vertices + tri[0] * floats, vertices + tri[1] * floats,
                 vertices + tri[2] * floats)) {
      continue;
    }
    state.indices.insert(state.indices.end(),
                         {tri[0], tri[mirrored_ ? 2 : 1], tri[mirrored_ ? 1 : 2]});
  }
  if (state.indices.size() == first) return;
  // Those that are new are moved together and written.
  const size_t stride = layout.stride(state.grid.on);
  char* const packed = pack(vertices, face.vertexCount, layout, state.grid.on);
  numbers_.resize(face.vertexCount);
  size_t fresh = 0;
  for (uint32_t v = 0; v < face.vertexCount; ++v) {
    const char* const vertex = packed + v * stride;
    numbers_[v] = written_.add(vertex, state.vertexCount);
    if (numbers_[v] != state.vertexCount) continue;
    include(state, vertices + v * floats);
    std::memmove(packed + fresh++ * stride, vertex, stride);
    ++state.vertexCount;
  }
  out_.append(packed, fresh * stride);
  for (size_t i = first; i < state.indices.size(); ++i) {
    state.indices[i] = numbers_[state.indices[i]];
  }
}

}  // namespace gable
