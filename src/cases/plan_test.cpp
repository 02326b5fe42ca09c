// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "cases/plan.h"

#include <gtest/gtest.h>

#include "geom/mesh/mesh.h"

namespace gable::cases {
namespace {

/// A quad at a height, counter-clockwise seen from above.
Mesh quad(double x, double y, double width, double depth, double height) {
  MeshBuilder b;
  std::vector<uint32_t> corners;
  for (const Vec3& p : {Vec3{x, height, -y}, Vec3{x + width, height, -y},
                        Vec3{x + width, height, -(y + depth)}, Vec3{x, height, -(y + depth)}}) {
    corners.push_back(b.addPosition(p));
  }
  b.addPolygon(corners);
  return b.take();
}

/// A wall on edge from (x0, y0) to (x1, y1).
Mesh wall(double x0, double y0, double x1, double y1) {
  MeshBuilder b;
  std::vector<uint32_t> corners;
  for (const Vec3& p : {Vec3{x0, 0, -y0}, Vec3{x1, 0, -y1}, Vec3{x1, 3, -y1}, Vec3{x0, 3, -y0}}) {
    corners.push_back(b.addPosition(p));
  }
  b.addPolygon(corners);
  return b.take();
}

/// A U with its notch from (4, 3) to (6, 10).
Region notched() {
  return {{{{0, 0}, {10, 0}, {10, 10}, {6, 10}, {6, 3}, {4, 3}, {4, 10}, {0, 10}}, {}}};
}

TEST(Plan, isTheUnionOfFaces) {
  EXPECT_NEAR(area(planOf(quad(1, 2, 3, 4, 5))), 12, 1e-3);
  EXPECT_TRUE(planOf(wall(0, 0, 5, 5)).empty());
}

TEST(Plan, reachesBeyondWhereACornerDoes) {
  EXPECT_EQ(reachBeyond(quad(0, 0, 3, 10, 0), notched()), 0);
  EXPECT_NEAR(reachBeyond(quad(9, 0, 3, 3, 0), notched()), 2, 1e-9);
}

TEST(Plan, reachesBeyondWhereAnEdgeDoesAlone) {
  // Both ends lie in the arms of the U.
  EXPECT_NEAR(reachBeyond(wall(2, 8, 8, 8), notched()), 1, 1e-9);
  EXPECT_EQ(reachBeyond(wall(2, 2, 8, 2), notched()), 0);
  // Along the boundary and through its corners.
  EXPECT_EQ(reachBeyond(wall(4, 3, 6, 3), notched()), 0);
  EXPECT_EQ(reachBeyond(wall(0, 0, 10, 0), notched()), 0);
  EXPECT_GT(reachBeyond(wall(0, 10, 10, 10), notched()), 0.9);
}

TEST(Plan, reachesInfinitelyBeyondNothing) { EXPECT_GT(reachBeyond(quad(0, 0, 1, 1, 0), {}), 1e9); }

TEST(Plan, isSharedWhereHeightsAreToo) {
  const auto box = [](double x, double bottom) {
    Mesh mesh = quad(x, 0, 4, 4, bottom);
    const Mesh top = quad(x, 0, 4, 4, bottom + 3);
    MeshBuilder b;
    std::vector<uint32_t> first(mesh.positions.size(), MeshBuilder::kNoPosition);
    std::vector<uint32_t> second(top.positions.size(), MeshBuilder::kNoPosition);
    b.copyFace(mesh, 0, first, true);
    b.copyFace(top, 0, second);
    return PlacedLeaf{nullptr, "House", b.take(), {}};
  };
  EXPECT_NEAR(sharedPlan(box(0, 0), box(3, 0)), 4, 1e-3);
  EXPECT_EQ(sharedPlan(box(0, 0), box(4, 0)), 0);
  EXPECT_EQ(sharedPlan(box(0, 0), box(0, 3)), 0);
  EXPECT_NEAR(sharedPlan(box(0, 0), box(0, 2.9)), 16, 1e-3);
}

}  // namespace
}  // namespace gable::cases
