// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/corner_normals.h"

#include <gtest/gtest.h>

#include <limits>

namespace gable {
namespace {

TEST(CornerNormals, anyVectorWithADirectionHasAUnit) {
  for (const double size : {1e-320, 1e-200, 1e-160, 1e-80, 1.0, 1e80, 1e160, 1e300}) {
    EXPECT_NEAR(length(unitOf({size, -2 * size, 2 * size})), 1, 1e-12) << size;
  }
  EXPECT_EQ(unitOf({}), Vec3{});
  EXPECT_EQ(unitOf({std::numeric_limits<double>::quiet_NaN(), 1, 0}), Vec3{});
  EXPECT_EQ(unitOf({std::numeric_limits<double>::infinity(), 1, 0}), Vec3{});
}

TEST(CornerNormals, areAlwaysOfLengthOne) {
  Mesh m = makeBoxMesh({1, 1, 1}, false);
  m.faces[1].smooth = true;
  m.normals.assign(m.corners.size(), Vec3{});
  m.normals[0] = {0, 0, 5};
  // A face without area, and one whose area is too small for a square of it.
  for (uint32_t& c : std::span(m.corners).subspan(8, 4)) c = 0;
  m.positions[4] = {0, 0, 0};
  for (const Vec3& n : cornerNormals(m)) EXPECT_NEAR(length(n), 1, 1e-12);
  EXPECT_EQ(cornerNormals(m)[0], (Vec3{0, 0, 1}));
  m = makeBoxMesh({1e-90, 1e-90, 1e-90}, false);
  EXPECT_EQ(cornerNormals(m)[0], (Vec3{0, -1, 0}));
}

}  // namespace
}  // namespace gable
