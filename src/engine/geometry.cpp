// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The model as triangles: each mesh once, and the place of every leaf.

#include <map>

#include "engine/impl.h"
#include "io/exporters/surface.h"
#include "scene/flatten.h"

namespace gable {

namespace {

void append(std::vector<double>& out, const Vec3& v) {
  for (const double d : {v.x, v.y, v.z}) out.push_back(d);
}

TriangleMesh triangleMeshOf(const Mesh& m, FaceTriangulator& triangulator) {
  DrawSurface surface;
  surface.build(m, triangulator);
  TriangleMesh out;
  for (size_t v = 0; v < surface.corners.size(); ++v) {
    append(out.positions, m.at(surface.corners[v]));
    const Vec3& n = surface.normals[v];
    for (const double d : {n.x, n.y, n.z}) out.normals.push_back(static_cast<float>(d));
    if (!m.hasUv(0)) continue;
    const Vec2 uv = m.uvs[0][surface.corners[v]];
    for (const double d : {uv.x, uv.y}) out.uvs.push_back(static_cast<float>(d));
  }
  for (const SurfacePart& part : surface.parts) {
    const auto first = static_cast<uint32_t>(out.triangles.size() / 3);
    for (uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
      const SurfaceFace& face = surface.faces[f];
      for (uint32_t t = face.firstTriangle; t < face.firstTriangle + face.triangleCount; ++t) {
        for (const uint32_t v : surface.triangles[t]) {
          out.triangles.push_back(face.firstVertex + v);
        }
      }
    }
    const auto end = static_cast<uint32_t>(out.triangles.size() / 3);
    out.parts.push_back({part.slot, first, end - first});
  }
  return out;
}

class GeometryBuilder {
 public:
  GeometryBuilder(const Scene& scene, uint64_t most)
      : scene_(scene), most_(most), leaves_(prototypeLeafCounts(scene)) {
    for (const Material& m : scene.materials) out_.materials.push_back(materialInfoOf(m));
    out_.names = scene.names;
  }

  ModelGeometry build() {
    for (const Root& r : scene_.roots) {
      add(scene_.prototypes[r.instance.prototype], r.instance.frame);
    }
    return std::move(out_);
  }

 private:
  // As forEachLeaf, but it ends: instances of instances can stand for more than memory holds.
  void add(const Prototype& p, const Frame& world) {
    uint32_t leaf = 0;
    const auto addUpTo = [&](uint32_t end) {
      for (; leaf < end && out_.leaves.size() < most_; ++leaf) {
        const Leaf& l = scene_.leaves[p.firstLeaf + leaf];
        add(l, world * l.frame);
      }
    };
    for (uint32_t i = 0; i < p.instanceCount && out_.leaves.size() < most_; ++i) {
      const Instance& instance = scene_.instances[p.firstInstance + i];
      // Of prototypes without leaves there can be as many instances as of others.
      if (leaves_[instance.prototype] == 0) continue;
      addUpTo(instance.leavesBefore);
      add(scene_.prototypes[instance.prototype], world * instance.frame);
    }
    addUpTo(p.leafCount);
  }

  void add(const Leaf& leaf, const Frame& world) {
    PlacedMesh placed;
    placed.mesh = meshOf(leaf.mesh);
    placed.name = leaf.name;
    size_t i = 0;
    for (const Vec3& v :
         {world.origin, world.x * leaf.scale.x, world.y * leaf.scale.y, world.z * leaf.scale.z}) {
      for (const double d : {v.x, v.y, v.z}) placed.transform[i++] = d;
    }
    if (leaf.materials < scene_.materialLists.size()) {
      placed.materials = scene_.materialLists[leaf.materials];
    }
    out_.leaves.push_back(std::move(placed));
  }

  uint32_t meshOf(uint32_t mesh) {
    const auto [at, fresh] = numbers_.try_emplace(mesh, static_cast<uint32_t>(out_.meshes.size()));
    if (fresh) out_.meshes.push_back(triangleMeshOf(*scene_.meshes[mesh], triangulator_));
    return at->second;
  }

  const Scene& scene_;
  const uint64_t most_;
  const std::vector<uint64_t> leaves_;
  ModelGeometry out_;
  std::map<uint32_t, uint32_t> numbers_;
  FaceTriangulator triangulator_;
};

}  // namespace

ModelGeometry geometryOf(const Scene& scene, uint64_t mostLeaves) {
  return GeometryBuilder(scene, mostLeaves).build();
}

}  // namespace gable
