// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Meshes that no modeller would make: every operation on them ends and gives a valid mesh.
#include <gtest/gtest.h>

#include <numeric>

#include "geom/mesh/cleanup.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/extrude.h"
#include "geom/mesh/face_triangles.h"
#include "geom/mesh/garbage.h"
#include "geom/mesh/topology.h"
#include "geom/mesh/uv.h"

namespace gable {
namespace {

TEST(Robust, cuttingGarbageGivesValidMeshes) {
  CutOptions cap;
  cap.cap = true;
  const double cuts[] = {0.05, 0.1, 0.1, 0.15, 0.2};
  const double uvCuts[] = {0.5, 1};
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const Mesh m = garbage(seed, true);
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
    const Mesh m = garbage(seed, true);
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
