// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/parts.h"

#include <cmath>
#include <string>

namespace gable {

Shape scopePart(const Shape& parent, Axis axis, double start, double size) {
  Shape child = parent;
  const auto a = static_cast<size_t>(axis);
  const double sign = parent.size[a] < 0 ? -1 : 1;
  Vec3 offset;
  offset[a] = sign * start;
  child.scope.origin = parent.scope.point(offset);
  child.size[a] = sign * size;
  return child;
}

void setPartMesh(Shape& child, const Shape& parent, Mesh mesh, bool adjust) {
  if (!adjust) {
    const Vec3 moved = parent.scope.toLocal(child.scope.origin);
    if (moved != Vec3{}) {
      for (Vec3& p : mesh.positions) p = p - moved;
    }
    setMesh(child, std::move(mesh), ScopeFit::Keep);
    return;
  }
  child.scope = parent.scope;
  child.size = parent.size;
  setMesh(child, std::move(mesh), ScopeFit::Refit);
  if (parent.size.x >= 0 && parent.size.y >= 0 && parent.size.z >= 0) return;
  // The scope keeps its handedness: its origin goes to the far corner of the mirrored axes.
  Vec3 corner;
  Vec3 size = child.size;
  for (size_t i = 0; i < 3; ++i) {
    if (parent.size[i] >= 0) continue;
    corner[i] = size[i];
    size[i] = -size[i];
  }
  Mesh moved = *meshInScope(child);
  for (Vec3& p : moved.positions) p = p - corner;
  child.scope.origin = child.scope.point(corner);
  child.size = size;
  setMesh(child, std::move(moved), ScopeFit::Keep);
}

Status flatAlong(const OpCall& call, Axis axis) {
  const std::string name(1, "xyz"[static_cast<size_t>(axis)]);
  return call.fail("split-flat", "the shape is flat: its scope has no extent in " + name,
                   axis == Axis::Y ? "extrude it first, or split along x or z"
                                   : "split along another axis, or give the scope a size first");
}

}  // namespace gable
