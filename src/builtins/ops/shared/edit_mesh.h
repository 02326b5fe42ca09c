// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edits of a shape's mesh that leave its positions: texture coordinates, normals, orientation.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "shape/op_call.h"
#include "shape/shape.h"

namespace gable {

/// Gives the shape a changed copy of its mesh, whatever its present scale; a primitive becomes a
/// mesh. Nothing to do without geometry.
template <class Edit>
void editMesh(Shape& s, Edit edit) {
  if (s.geometry.kind == GeometryKind::None) return;
  const bool isMesh = s.geometry.kind == GeometryKind::Mesh;
  Mesh mesh = isMesh ? *s.geometry.mesh : *meshInScope(s);
  edit(mesh);
  s.geometry = {GeometryKind::Mesh, false, isMesh ? s.geometry.refSize : s.size,
                makeRef<Mesh>(std::move(mesh))};
}

inline bool hasUvSet(const Shape& s, int set) {
  if (s.geometry.kind == GeometryKind::None) return false;
  if (s.geometry.kind != GeometryKind::Mesh) return s.geometry.uv && set == 0;
  return s.geometry.mesh->hasUv(set);
}

/// The hint where an operation needs texture coordinates in a set that has none.
inline std::string howToMakeUvs(const Shape& s, int set) {
  for (int other = 0; other < kUvSets; ++other) {
    if (!hasUvSet(s, other)) continue;
    return "copy those of set " + std::to_string(other) + " with copyUV(" + std::to_string(other) +
           ", " + std::to_string(set) + "), or make some with setupProjection and projectUV";
  }
  return "make some with setupProjection and projectUV";
}

}  // namespace gable
