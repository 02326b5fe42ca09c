// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/draw_batches.h"

#include <cmath>
#include <iterator>

#include "base/work.h"

namespace gable {

namespace {

/// Stands for the zero scale of a flat shape, which no normal survives.
constexpr double kFlat = 1e-5;

float narrow(double v) { return static_cast<float>(v); }

void put(float*& out, const Vec3& v) {
  *out++ = narrow(v.x);
  *out++ = narrow(v.y);
  *out++ = narrow(v.z);
}

// Where so many more numbers go.
template <class Number>
Number* grow(std::vector<Number>& out, size_t count) {
  const size_t size = out.size();
  out.resize(size + count);
  return out.data() + size;
}

// The geometry of a mirrored batch is mirrored in x itself, so the matrix takes that back: what a
// graphics card gets never mirrors.
void addMatrix(std::vector<float>& out, const Leaf& leaf, const Frame& world, bool mirrored) {
  const auto whole = [](double s) { return std::abs(s) < kFlat ? kFlat : s; };
  const Vec3 x = world.x * (whole(leaf.scale.x) * (mirrored ? -1 : 1));
  const Vec3 y = world.y * whole(leaf.scale.y), z = world.z * whole(leaf.scale.z);
  const Vec3& o = world.origin;
  const float matrix[] = {
      narrow(x.x), narrow(x.y), narrow(x.z), 0, narrow(y.x), narrow(y.y), narrow(y.z), 0,
      narrow(z.x), narrow(z.y), narrow(z.z), 0, narrow(o.x), narrow(o.y), narrow(o.z), 1};
  out.insert(out.end(), std::begin(matrix), std::end(matrix));
}

}  // namespace

void Batch::addRun(const BatchRun& run) {
  if (run.vertices == 0) return;
  if (!runs.empty() && runs.back().leaf == run.leaf && runs.back().color == run.color) {
    runs.back().vertices += run.vertices;
    runs.back().corners += run.corners;
  } else {
    runs.push_back(run);
  }
}

void Batch::spreadRuns() {
  for (const BatchRun& run : runs) {
    leaves.resize(leaves.size() + run.vertices, static_cast<float>(run.leaf));
    colors.resize(colors.size() + run.vertices, run.color);
  }
}

void Batch::clear() {
  own.positions.clear();
  own.normals.clear();
  own.uvs.clear();
  own.indices.clear();
  runs.clear();
  leaves.clear();
  colors.clear();
  matrices.clear();
}

void BatchBuilder::clear() {
  for (auto& [key, batch] : batches_) batch.clear();
}

// Memory for all that it will hold is taken once.
void BatchBuilder::reserve(Batch& batch, const BatchKey& key) const {
  const BatchTally* const known = plan_.tally(key);
  if (!known) return;
  const BatchTally& sum = *known;
  if (key.mesh != kMerged) {
    batch.matrices.reserve(sum.instances * 16);
    batch.leaves.reserve(sum.instances);
    batch.colors.reserve(sum.instances);
    return;
  }
  batch.own.positions.reserve(sum.corners * 3);
  batch.own.normals.reserve(sum.corners * 3);
  batch.own.uvs.reserve(sum.corners * 2);
  batch.own.indices.reserve(sum.triangles * 3);
  batch.leaves.reserve(sum.corners);
  batch.colors.reserve(sum.corners);
}

// Leaves that lie beside each other mostly go into the same batch.
Batch& BatchBuilder::batchOf(const BatchKey& key, uint32_t paint) {
  if (last_ && key == lastKey_) return *last_;
  const auto [at, fresh] = batches_.try_emplace(key);
  if (fresh) {
    at->second.geometry = key.mesh == kMerged ? &at->second.own : &geometries_[key];
    reserve(at->second, key);
    if (!met_[key.look]) looks_.push_back(paint);
    met_[key.look] = true;
  }
  lastKey_ = key;
  last_ = &at->second;
  return *last_;
}

// Faces of what is laid have coordinates of their own.
const DrawSurface& BatchBuilder::surfaceOf(uint32_t mesh, bool apart) {
  if (plan_.isSingle(mesh)) {
    single_.build(*scene_.meshes[mesh], triangulator_, apart);
    return single_;
  }
  const auto [at, fresh] = surfaces_.try_emplace({mesh, apart});
  if (fresh) at->second.build(*scene_.meshes[mesh], triangulator_, apart);
  return at->second;
}

void BatchBuilder::add(const Leaf& leaf, const Frame& world, uint32_t number) {
  const bool often = plan_.isOften(leaf);
  const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
  const DrawSurface& surface = surfaceOf(leaf.mesh, plan_.isLaidLeaf(leaf));
  if (!often) work(surface.corners.size());
  for (const SurfacePart& part : surface.parts) {
    const uint32_t paint = plan_.paintOf(leaf, part.slot);
    Batch& batch =
        batchOf(DrawPlan::keyOf(leaf, part.slot, often, plan_.paint(paint).group), paint);
    const bool laid = plan_.isLaidPaint(paint);
    if (!often) {
      const size_t vertices = batch.own.positions.size() / 3, corners = batch.own.indices.size();
      addPart(batch.own, leaf.mesh, surface, part, world, leaf.scale, laid);
      batch.addRun({number, plan_.paint(paint).color,
                    static_cast<uint32_t>(batch.own.positions.size() / 3 - vertices),
                    static_cast<uint32_t>(batch.own.indices.size() - corners)});
      continue;
    }
    if (batch.geometry->positions.empty()) {
      addPart(*batch.geometry, leaf.mesh, surface, part, {}, {mirrored ? -1.0 : 1.0, 1, 1}, laid);
    }
    addMatrix(batch.matrices, leaf, world, mirrored);
    batch.leaves.push_back(narrow(number));
    batch.colors.push_back(plan_.paint(paint).color);
  }
}

void BatchBuilder::addPart(DrawGeometry& to, uint32_t mesh, const DrawSurface& surface,
                           const SurfacePart& part, const Frame& world, const Vec3& scale,
                           bool laid) {
  const Mesh& m = *scene_.meshes[mesh];
  const bool turned = scale.x * scale.y * scale.z < 0;
  for (uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
    const SurfaceFace& face = surface.faces[f];
    const auto base = static_cast<uint32_t>(to.positions.size() / 3);
    const FaceAxes axes = laid ? layingOf(m, surface, face, world, scale) : FaceAxes{};
    float* position = grow(to.positions, size_t{face.vertexCount} * 3);
    float* normal = grow(to.normals, size_t{face.vertexCount} * 3);
    float* uv = grow(to.uvs, size_t{face.vertexCount} * 2);
    // The corners of a flat face have one normal.
    const Vec3* known = nullptr;
    Vec3 placed;
    for (uint32_t v = face.firstVertex; v < face.firstVertex + face.vertexCount; ++v) {
      const uint32_t corner = surface.corners[v];
      const Vec3 point = world.point(scaled(m.at(corner), scale));
      put(position, point);
      if (!known || !(*known == surface.normals[v])) {
        known = &surface.normals[v];
        placed = world.direction(scaledNormal(*known, scale));
      }
      put(normal, placed);
      const Vec2 at = laid ? axes.at(point) : m.hasUv(0) ? m.uvs[0][corner] : Vec2{};
      *uv++ = narrow(at.x);
      *uv++ = narrow(at.y);
    }
    uint32_t* index = grow(to.indices, size_t{face.triangleCount} * 3);
    for (uint32_t t = 0; t < face.triangleCount; ++t) {
      const auto& tri = surface.triangles[face.firstTriangle + t];
      for (int c = 0; c < 3; ++c) *index++ = base + tri[turned ? 2 - c : c];
    }
  }
}

}  // namespace gable
