// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Meshes that no modeller would make: every operation on them ends and gives a valid mesh.
#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"
#include "geom/mesh/cleanup.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/extrude.h"
#include "geom/mesh/face_triangles.h"
#include "geom/mesh/topology.h"
#include "geom/mesh/uv.h"

namespace gable {
namespace {

// Random corners over few positions on a coarse lattice: repeated points, flat, crossing and warped
// faces, holes outside their outer loop, edges of many faces.
Mesh garbage(uint64_t seed) {
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
        b.setNormal(corner, {double(pick(3)) - 1, double(pick(3)) - 1, 0});
      }
    }
  }
  return b.take();
}

TEST(Robust, cuttingGarbageGivesValidMeshes) {
  CutOptions cap;
  cap.cap = true;
  const double cuts[] = {0.05, 0.1, 0.1, 0.15, 0.2};
  const double uvCuts[] = {0.5, 1};
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const Mesh m = garbage(seed);
    ASSERT_TRUE(m.valid());
    for (int axis = 0; axis < 3; ++axis) {
      for (const MeshPart& p : sliceAxis(m, axis, cuts, cap)) {
        ASSERT_TRUE(p.mesh.valid()) << seed;
        ASSERT_EQ(p.faceSource.size(), p.mesh.faceCount());
        ASSERT_EQ(p.edgeSource.size(), p.mesh.corners.size());
      }
    }
    const PlaneCut cut = cutByPlane(m, {{1, 2, -1}, 0.1}, cap);
    ASSERT_TRUE(cut.back.mesh.valid() && cut.front.mesh.valid()) << seed;
    std::vector<double> u;
    for (const Vec2 uv : m.uvs[0]) u.push_back(uv.x);
    for (const MeshPart& p : sliceField(m, u, uvCuts)) ASSERT_TRUE(p.mesh.valid()) << seed;
  }
}

TEST(Robust, editingGarbageGivesValidMeshes) {
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const Mesh m = garbage(seed);
    for (const ExtrudeMode mode : {ExtrudeMode::FaceNormal, ExtrudeMode::VertexNormal,
                                   ExtrudeMode::Along, ExtrudeMode::FlatTop}) {
      for (const double d : {-0.3, 0.0, 0.3}) {
        const ExtrudeResult r = extrude(m, {mode, d, {0, 1, 0}});
        ASSERT_TRUE(r.mesh.valid()) << seed;
        ASSERT_EQ(r.roles.size(), r.mesh.faceCount());
      }
    }
    for (const double t : {0.0, 0.05, 1.0}) {
      Mesh clean = m;
      const FaceSources sources = cleanup(clean, {true, true, true, t});
      ASSERT_TRUE(clean.valid()) << seed;
      ASSERT_EQ(sources.size(), clean.faceCount());
    }
    Mesh soft = m;
    softenNormals(soft, 30);
    normalizeUv(soft, 0, UvNormalize::Uniform, true);
    tileUv(soft, 0, {0.3, true}, {-1, false});
    ASSERT_TRUE(soft.valid()) << seed;
    ASSERT_TRUE(std::isfinite(volume(m)) && std::isfinite(boundaryLength(m)));
    isConcave(m), isPlanar(m, 1), isRectangular(m, 1);
    FaceTriangulator triangulator;
    std::vector<std::array<uint32_t, 3>> triangles;
    for (size_t f = 0; f < m.faceCount(); ++f) triangulator.add(m, f, triangles);
    for (const auto& t : triangles) {
      for (const uint32_t c : t) ASSERT_LT(c, m.corners.size());
    }
  }
}

}  // namespace
}  // namespace gable
