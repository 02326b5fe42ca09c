// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/face_triangles.h"

#include <gtest/gtest.h>

#include "math/trig.h"

namespace gable {
namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

Mesh polygon(const std::vector<std::vector<Vec2>>& rings) {
  MeshBuilder b;
  b.beginFace();
  for (const auto& ring : rings) {
    b.beginLoop();
    for (const Vec2 p : ring) b.addCorner(b.addPosition({p.x, p.y, 0}));
  }
  return b.take();
}

// Every triangle has area and the direction of its face; the areas sum up.
void expectCovers(const Mesh& m, size_t triangles) {
  Triangles out;
  FaceTriangulator t;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const size_t first = out.size();
    t.add(m, f, out);
    double sum = 0;
    for (size_t i = first; i < out.size(); ++i) {
      const Vec3 n = cross(m.at(out[i][1]) - m.at(out[i][0]), m.at(out[i][2]) - m.at(out[i][0]));
      EXPECT_GT(dot(n, m.normal(f)), 0);
      sum += length(n) / 2;
    }
    EXPECT_NEAR(sum, m.area(f), 1e-9 * m.area(f));
  }
  EXPECT_EQ(out.size(), triangles);
}

TEST(FaceTriangles, coverFacesInEveryDirection) {
  const Mesh ring =
      polygon({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{3, 3}, {3, 6}, {6, 6}, {6, 3}}});
  const Mesh ell = polygon({{{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 10}, {0, 10}}});
  const Mesh box = makeBoxMesh({1, 2, 3}, false);
  for (int i = 0; i < 40; ++i) {
    const Frame f = rotationXyz(i * 37.0, i * 53.0, i * 71.0);
    const Vec3 scale{i % 2 ? -1.0 : 1.0, 1, i % 3 ? 2.0 : -1.0};
    expectCovers(transformed(ring, scale, f), 8);
    expectCovers(transformed(ell, scale, f), 4);
    expectCovers(transformed(box, scale, f), 12);
  }
}

TEST(FaceTriangles, cornersOnAnEdgeMakeNoEmptyTriangle) {
  expectCovers(polygon({{{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}}}), 3);
  expectCovers(polygon({{{0, 0}, {5, 0}, {10, 0}, {10, 5}, {10, 10}, {5, 10}, {0, 10}, {0, 5}}}),
               6);
  expectCovers(polygon({{{0, 0}, {4, 0}, {2, 1}, {2, 4}}}), 2);
}

TEST(FaceTriangles, facesWithoutAreaGiveNone) {
  Triangles out;
  FaceTriangulator t;
  for (const Mesh& m : {polygon({{{0, 0}, {1, 0}, {2, 0}}}), polygon({{{0, 0}, {1, 1}}}),
                        polygon({{{1, 1}, {1, 1}, {1, 1}, {1, 1}}})}) {
    t.add(m, 0, out);
  }
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace gable
