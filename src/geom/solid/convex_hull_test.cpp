// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/solid/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/random.h"

namespace gable {
namespace {

// Six times what the triangles enclose; each edge has to occur once in either direction.
double volumeOf(const ConvexHull& hull) {
  double sum = 0;
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const auto& t : hull.triangles) {
    const Vec3 &a = hull.corners[t[0]], &b = hull.corners[t[1]], &c = hull.corners[t[2]];
    sum += dot(a, cross(b, c));
    for (size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [e, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({e.second, e.first}));
  }
  return sum / 6;
}

std::vector<Vec3> boxPoints(const Vec3& size) {
  std::vector<Vec3> out;
  for (int i = 0; i < 8; ++i) {
    out.push_back({i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0});
  }
  return out;
}

TEST(ConvexHull, BoxHasItsCornersAndItsVolume) {
  std::vector<Vec3> points = boxPoints({4, 30, 0.5});
  for (const Vec3& p : boxPoints({4, 30, 0.5})) points.push_back(p * 0.5 + Vec3{1, 1, 0.1});
  const ConvexHull hull = convexHull3(points);
  EXPECT_EQ(hull.corners.size(), 8u);
  EXPECT_EQ(hull.triangles.size(), 12u);
  EXPECT_NEAR(volumeOf(hull), 60, 1e-3);
}

TEST(ConvexHull, PointsInAPlaneHaveNone) {
  EXPECT_TRUE(convexHull3({}).triangles.empty());
  EXPECT_TRUE(convexHull3(std::vector<Vec3>(5, {1, 2, 3})).triangles.empty());
  EXPECT_TRUE(convexHull3(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}).triangles.empty());
  EXPECT_TRUE(
      convexHull3(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}).triangles.empty());
  EXPECT_TRUE(convexHull3(std::vector<Vec3>{{0, 0, 0}, {NAN, 0, 0}}).triangles.empty());
}

TEST(ConvexHull, ManyPointsBecomeFewCornersThatEncloseThem) {
  std::vector<Vec3> points;
  for (uint64_t i = 0; i < 20'000; ++i) {
    const auto at = [i](uint64_t k) {
      return 2 * static_cast<double>(mix64(3 * i + k) >> 11) * 0x1p-53 - 1;
    };
    const Vec3 p{at(0), at(1), at(2)};
    if (length(p) > 0.1) points.push_back(normalized(p) * 10);
  }
  const ConvexHull hull = convexHull3(points);
  EXPECT_LE(hull.corners.size(), kMostHullCorners);
  EXPECT_LE(hull.triangles.size(), 255u);
  const double sphere = 4.0 / 3 * 3.14159265358979 * 1000;
  EXPECT_GT(volumeOf(hull), 0.85 * sphere);
  EXPECT_LT(volumeOf(hull), sphere);
  // Convex: no corner lies outside a face.
  for (const auto& t : hull.triangles) {
    const Vec3& a = hull.corners[t[0]];
    const Vec3 n = cross(hull.corners[t[1]] - a, hull.corners[t[2]] - a);
    EXPECT_GT(length(n), 0);
    for (const Vec3& c : hull.corners) EXPECT_LE(dot(n, c - a), 1e-9);
  }
}

}  // namespace
}  // namespace gable
