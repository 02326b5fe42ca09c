// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/leaf_shape.h"

namespace gable {

void setShape(Leaf& leaf, const Shape& s, Output& output) {
  const Geometry& g = s.geometry;
  leaf.frame = s.scope;
  leaf.scale = s.size;
  switch (g.kind) {
    case GeometryKind::Box: leaf.mesh = g.uv ? kUnitBoxUv : kUnitBox; break;
    case GeometryKind::QuadXy: leaf.mesh = g.uv ? kUnitQuadXyUv : kUnitQuadXy; break;
    case GeometryKind::QuadXz: leaf.mesh = g.uv ? kUnitQuadXzUv : kUnitQuadXz; break;
    default:
      leaf.mesh = kFirstMesh + output.meshNumber(g.mesh);
      for (size_t k = 0; k < 3; ++k)
        leaf.scale[k] = g.refSize[k] != 0 ? s.size[k] / g.refSize[k] : 1;
  }
}

Shape shapeOf(const Leaf& leaf, const Output& output) {
  Shape s;
  s.scope = leaf.frame;
  s.size = leaf.scale;
  s.attributes = leaf.attributes;
  if (leaf.materials < output.materials.size()) {
    s.material = static_cast<MaterialId>(output.materials[leaf.materials] >> 32);
    s.assetMaterials = static_cast<uint32_t>(output.materials[leaf.materials]);
  }
  Geometry& g = s.geometry;
  g.uv = leaf.mesh == kUnitBoxUv || leaf.mesh == kUnitQuadXyUv || leaf.mesh == kUnitQuadXzUv;
  switch (leaf.mesh) {
    case kUnitBox:
    case kUnitBoxUv: g.kind = GeometryKind::Box; break;
    case kUnitQuadXy:
    case kUnitQuadXyUv: g.kind = GeometryKind::QuadXy; break;
    case kUnitQuadXz:
    case kUnitQuadXzUv: g.kind = GeometryKind::QuadXz; break;
    default:
      g.kind = GeometryKind::Mesh;
      g.mesh = meshOf(leaf, output);
      g.refSize = {1, 1, 1};
  }
  return s;
}

MeshRef meshOf(const Leaf& leaf, const Output& output) {
  return leaf.mesh < kFirstMesh ? MeshRef() : output.meshes[leaf.mesh - kFirstMesh];
}

}  // namespace gable
