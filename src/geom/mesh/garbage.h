// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests only: meshes that no modeller would make, the same for equal seeds.
#pragma once

#include <cstdint>

#include "base/random.h"
#include "geom/mesh/mesh.h"

namespace gable {

/// Random corners over few positions on a coarse lattice: repeated points, flat, crossing and
/// warped faces, holes outside their outer loop, edges of many faces; uv coordinates, and normals
/// if wanted.
inline Mesh garbage(uint64_t seed, bool withNormals) {
  uint64_t n = 0;
  const auto pick = [&](uint64_t count) {
    return static_cast<uint32_t>(randomUnit(hashCombine(seed, ++n)) * static_cast<double>(count));
  };
  MeshBuilder b;
  const uint32_t positions = 4 + pick(9);
  const bool flat = pick(3) == 0;
  for (uint32_t i = 0; i < positions; ++i) {
    b.addPosition(Vec3{double(pick(4)), double(pick(4)), flat ? 0.0 : double(pick(4))} * 0.1);
  }
  const uint32_t faces = 1 + pick(6);
  for (uint32_t f = 0; f < faces; ++f) {
    b.beginFace(0, pick(2));
    const uint32_t loops = 1 + pick(3);
    for (uint32_t l = 0; l < loops; ++l) {
      b.beginLoop();
      const uint32_t corners = 1 + pick(7);
      for (uint32_t c = 0; c < corners; ++c) {
        const uint32_t corner = b.addCorner(pick(positions), pick(3));
        b.setUv(corner, 0, {double(pick(3)), double(pick(3))});
        if (!withNormals) continue;
        b.setNormal(corner, {double(pick(3)) - 1, double(pick(3)) - 1, 0});
      }
    }
  }
  return b.take();
}

}  // namespace gable
