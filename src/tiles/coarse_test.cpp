// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/coarse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/mesh/mesh.h"

namespace gable {
namespace {

// Boxes of one feature; colours by number.
class Place {
 public:
  Place() {
    scene_->materials.resize(2);
    scene_->materials[0].color = {1, 1, 1};
    scene_->materials[1].color = {0, 0, 0};
    scene_->materialLists = {{0}, {1}};
    content_.features.resize(1);
  }

  void add(const Vec3& low, const Vec3& size, uint32_t color = 0) { add(0, low, size, color); }

  // A gable across z: as wide and as high as given, its ridge in the middle.
  void addGable(const Vec3& low, double wide, double high) {
    MeshBuilder builder;
    for (const Vec3& p : {Vec3{}, Vec3{wide, 0, 0}, Vec3{wide / 2, high, 0}})
      builder.addPosition(p);
    builder.addPolygon(std::array<uint32_t, 3>{0, 1, 2});
    scene_->meshes.push_back(makeRef<Mesh>(builder.take()));
    add(static_cast<uint32_t>(scene_->meshes.size()) - 1, low, {1, 1, 1}, 0);
  }

  void add(uint32_t mesh, const Vec3& low, const Vec3& size, uint32_t color) {
    Leaf leaf;
    leaf.mesh = mesh;
    leaf.scale = size;
    leaf.materials = color;
    TileLeaf at;
    at.leaf = static_cast<uint32_t>(scene_->leaves.size());
    at.world = Frame::moved(low);
    scene_->leaves.push_back(leaf);
    content_.leaves.push_back(at);
  }

  CoarseModel parts(double tolerance = 0) {
    content_.scenes = {scene_};
    return partsOf(content_, tolerance, [](const Material& m) {
      return Finish{m.color, m.roughness};
    });
  }

  CoarseModel coarse(double tolerance) { return coarsened(parts(tolerance), tolerance); }
  // Held against what is seen of the full model.
  CoarseModel closed(double tolerance) {
    const CoarseModel full = parts();
    return coarsened(parts(tolerance), tolerance, &full);
  }

 private:
  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
  TileContent content_;
};

Box3 boundsOf(const CoarseModel& m) {
  Box3 box;
  for (const Vec3& v : m.vertices) box.include(v);
  return box;
}

TEST(Coarse, keepsWhatIsLarge) {
  Place place;
  place.add({0, 0, 0}, {10, 6, 8});
  const CoarseModel m = place.coarse(1);
  EXPECT_EQ(m.triangles.size(), 12u);
  EXPECT_EQ(boundsOf(m).max, Vec3(10, 6, 8));
  EXPECT_LE(m.error, 1);
}

TEST(Coarse, detailsColourWhatTheyLieOn) {
  Place place;
  place.add({0, 0, 0}, {10, 6, 8});
  for (int i = 0; i < 8; ++i) place.add({i * 1.2, 3, -0.1}, {0.9, 0.9, 0.1}, 1);
  const CoarseModel m = place.coarse(1);
  ASSERT_EQ(m.parts.size(), 1u);
  EXPECT_LT(m.parts[0].finish.color.x, 0.99);
  EXPECT_GT(m.parts[0].finish.color.x, 0.8);
  EXPECT_EQ(m.triangles.size(), 12u);
}

TEST(Coarse, manySmallThingsBecomeBoxes) {
  Place place;
  for (int i = 0; i < 512; ++i) {
    place.add({0.5 * (i % 8), 0.5 * (i / 8 % 8), 0.5 * (i / 64)}, {0.4, 0.4, 0.4});
  }
  const CoarseModel m = place.coarse(2);
  ASSERT_FALSE(m.parts.empty());
  EXPECT_LE(m.parts.size(), 8u);
  const Box3 box = boundsOf(m);
  EXPECT_NEAR(box.min.x, 0, m.error);
  EXPECT_NEAR(box.max.z, 4, m.error);
  EXPECT_GT(box.size().y, 2);
}

TEST(Coarse, singleNarrowThingsGo) {
  Place place;
  place.add({0, 0, 0}, {0.1, 6, 0.1});
  EXPECT_TRUE(place.coarse(2).parts.empty());
  EXPECT_TRUE(place.coarse(2).features.empty());
}

TEST(Coarse, everyLevelIsAtMostItsErrorAway) {
  Place place;
  for (int i = 0; i < 200; ++i) {
    place.add({7.0 * (i % 20), 0, 9.0 * (i / 20)}, {6.5, 3.0 + i % 5, 8.3}, i % 2);
  }
  CoarseModel m = place.coarse(0.5);
  const size_t full = m.triangles.size();
  const Box3 before = boundsOf(m);
  double error = m.error;
  for (double tolerance = 1; tolerance < 20; tolerance *= 2) {
    m = coarsened(m, tolerance);
    EXPECT_GT(m.error, error);
    error = m.error;
    if (m.parts.empty()) break;
    const Box3 box = boundsOf(m);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(box.min[i], before.min[i], m.error);
      EXPECT_NEAR(box.max[i], before.max[i], m.error);
    }
  }
  EXPECT_LT(m.triangles.size(), full / 4);
}

double distanceOf(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  // Points all over the triangle are near enough for a test.
  constexpr int kSteps = 16;
  double best = 1e9;
  for (int u = 0; u <= kSteps; ++u) {
    for (int v = 0; u + v <= kSteps; ++v) {
      const Vec3 at = a + (b - a) * (u / double{kSteps}) + (c - a) * (v / double{kSteps});
      best = std::min(best, length(p - at));
    }
  }
  return best;
}

double distanceOf(const Vec3& p, const CoarseModel& m) {
  double best = 1e9;
  for (const CoarsePart& part : m.parts) {
    for (uint32_t t = 0; t < part.triangleCount; ++t) {
      const auto at = [&](size_t k) {
        return m.vertices[part.firstVertex + m.triangles[part.firstTriangle + t][k]];
      };
      best = std::min(best, distanceOf(p, at(0), at(1), at(2)));
    }
  }
  return best;
}

// A house with cornices, a chimney, a rail with its posts, and a lamp before it.
TEST(Coarse, whatIsNotShownIsWithinTheError) {
  struct Thing {
    Vec3 low, size;
  };
  std::vector<Thing> things = {
      {{0, 0, 0}, {10, 8, 9}},          {{-0.2, 3, -0.2}, {10.4, 0.3, 0.2}},
      {{4, 8, 4}, {0.6, 1.5, 0.6}},     {{0, 3.3, -1.2}, {10, 0.1, 1.2}},
      {{0, 4.3, -1.2}, {10, 0.1, 0.1}}, {{-4, 0, -5}, {0.2, 6, 0.2}},
      {{-5, 5.8, -5}, {2, 0.3, 0.3}}};
  for (int i = 0; i < 20; ++i) things.push_back({{0.5 * i, 3.4, -1.2}, {0.08, 0.9, 0.08}});
  Place place;
  for (const Thing& t : things) place.add(t.low, t.size);
  for (const double tolerance : {0.1, 0.3, 0.5, 1.0, 2.0, 3.0}) {
    const CoarseModel m = place.coarse(tolerance);
    EXPECT_LT(m.error, 4 * tolerance);
    for (const Thing& t : things) {
      std::array<double, 3> sides = {t.size.x, t.size.y, t.size.z};
      std::sort(sides.begin(), sides.end());
      if (sides[1] < m.error / 8 || sides[2] <= m.error) continue;
      for (const double u : {0.0, 1.0}) {
        for (const double v : {0.0, 1.0}) {
          for (const double w : {0.0, 1.0}) {
            const Vec3 p = t.low + Vec3{u * t.size.x, v * t.size.y, w * t.size.z};
            EXPECT_LE(distanceOf(p, m), m.error + 0.5) << tolerance << " " << p.x << " " << p.y;
          }
        }
      }
    }
  }
}

// Lamps and rails are seen from where crowns of trees are boxes.
TEST(Coarse, longThingsStayAsSheets) {
  Place place;
  place.add({0, 0, 0}, {0.4, 8, 0.4});
  const CoarseModel m = place.coarse(2);
  EXPECT_EQ(boundsOf(m).max, Vec3(0.4, 8, 0.4));
  EXPECT_EQ(m.triangles.size(), 4u);
  EXPECT_LE(m.error, 0.3);
  const CoarseModel again = coarsened(m, 3);
  EXPECT_EQ(boundsOf(again).max, Vec3(0.4, 8, 0.4));
}

// Square metres of all triangles.
double areaOf(const CoarseModel& m) {
  double area = 0;
  for (const CoarsePart& part : m.parts) {
    for (uint32_t t = 0; t < part.triangleCount; ++t) {
      const auto at = [&](size_t k) {
        return m.vertices[part.firstVertex + m.triangles[part.firstTriangle + t][k]];
      };
      area += length(cross(at(1) - at(0), at(2) - at(0))) / 2;
    }
  }
  return area;
}

// A facade of strips, each narrower than what is left out: from far away it is one wall.
TEST(Coarse, stripsOfOneWallBecomeAPlate) {
  Place place;
  for (int i = 0; i < 96; ++i) place.add({0.25 * i, 0, 0}, {0.25, 30, 0}, i % 2);
  const CoarseModel m = place.coarse(0.75);
  ASSERT_EQ(m.parts.size(), 1u);
  EXPECT_NEAR(m.parts[0].finish.color.x, 0.5, 0.01);
  EXPECT_EQ(m.triangles.size(), 2u);
  EXPECT_NEAR(areaOf(m), 24 * 30, 1);
  EXPECT_LE(m.error, 0.75);
}

// Houses of a row keep their colours.
TEST(Coarse, platesEndWhereColoursDo) {
  Place place;
  for (int i = 0; i < 96; ++i) place.add({0.25 * i, 0, 0}, {0.25, 12, 0}, i / 48);
  const CoarseModel m = place.coarse(0.75);
  ASSERT_GE(m.parts.size(), 2u);
  EXPECT_LE(m.parts.size(), 4u);
  EXPECT_NEAR(m.parts.front().finish.color.x, 1, 0.01);
  EXPECT_NEAR(m.parts.back().finish.color.x + m.parts[1].finish.color.x, 0, 1);
  EXPECT_NEAR(areaOf(m), 24 * 12, 1);
}

// Windows that are large stay before a wall of strips and panels, which is closed around them.
TEST(Coarse, wallsOfStripsAreClosedAroundWindows) {
  Place place;
  for (int floor = 0; floor < 8; ++floor) {
    for (int bay = 0; bay < 8; ++bay) {
      const Vec3 at{3.0 * bay, 3.0 * floor, 0};
      place.add(at, {0.7, 3, 0});
      place.add(at + Vec3{2.3, 0, 0}, {0.7, 3, 0});
      place.add(at + Vec3{0.7, 0, 0}, {1.6, 0.7, 0});
      place.add(at + Vec3{0.7, 2.3, 0}, {1.6, 0.7, 0});
      place.add(at + Vec3{0.7, 0.7, -0.2}, {1.6, 1.6, 0}, 1);
    }
  }
  const CoarseModel m = place.coarse(0.8);
  const auto isDark = [](const CoarsePart& p) { return p.finish.color.x < 0.1; };
  EXPECT_EQ(std::count_if(m.parts.begin(), m.parts.end(), isDark), 64);
  // Points between the windows and at their edges are near something.
  for (double x = 0.1; x < 24; x += 0.47) {
    for (double y = 0.1; y < 24; y += 0.53) {
      double nearest = 1e9;
      for (const CoarsePart& p : m.parts) {
        const Vec3 at = p.frame.toLocal({x, y, 0});
        const auto beyond = [&](size_t i) {
          return std::max({p.box.min[i] - at[i], at[i] - p.box.max[i], 0.0});
        };
        nearest = std::min(nearest, std::hypot(beyond(0), beyond(1), beyond(2)));
      }
      EXPECT_LE(nearest, 0.5) << x << " " << y;
    }
  }
}

// Whether a point of the front is before or behind something, at most `depth` away, or in a slit of
// twice the `slack`.
bool isClosedAt(const CoarseModel& m, double x, double y, double depth, double slack) {
  return std::any_of(m.parts.begin(), m.parts.end(), [&](const CoarsePart& p) {
    Box3 box;
    for (uint32_t v = 0; v < p.vertexCount; ++v) box.include(m.vertices[p.firstVertex + v]);
    return x >= box.min.x - slack && x <= box.max.x + slack && y >= box.min.y - slack &&
           y <= box.max.y + slack && box.min.z <= depth && box.max.z >= -depth;
  });
}

// Floors and bays of many sizes, with sills, and a cornice: every level is a wall without holes.
TEST(Coarse, levelsOfAFrontHaveNoHoles) {
  for (const double width : {11.0, 13.0, 15.0, 18.0, 24.0}) {
    Place place;
    const int bays = static_cast<int>(std::round((width - 1.6) / 2.8)), floors = 5;
    const double bay = (width - 1.6) / bays, high = 3.1, side = (bay - 1.3) / 2;
    for (int floor = 0; floor < floors; ++floor) {
      const double y = floor * high;
      place.add({0, y, 0}, {0.8, high, 0});
      place.add({width - 0.8, y, 0}, {0.8, high, 0});
      for (int i = 0; i < bays; ++i) {
        const double x = 0.8 + i * bay;
        place.add({x, y, 0}, {side, high, 0});
        place.add({x + side + 1.3, y, 0}, {side, high, 0});
        place.add({x + side, y, 0}, {1.3, 0.9, 0});
        place.add({x + side, y + 0.9, 0}, {1.3, 0.12, 0.12});
        place.add({x + side, y + 1.02, -0.15}, {1.3, 1.6, 0}, 1);
        place.add({x + side, y + 2.62, 0}, {1.3, high - 2.62, 0});
      }
    }
    place.add({-0.2, floors * high, 0}, {width + 0.4, 0.4, 0.3});
    for (const double tolerance : {0.3, 0.45, 0.65, 1.0}) {
      CoarseModel m = place.coarse(tolerance);
      for (const double coarser : {0.0, 2.5}) {
        if (coarser > 0) m = coarsened(m, coarser * tolerance);
        for (double x = 0.07; x < width; x += 0.31) {
          for (double y = 0.07; y < floors * high; y += 0.29) {
            ASSERT_TRUE(isClosedAt(m, x, y, 2.5 * tolerance, tolerance / 4))
                << width << " wide, " << tolerance << " and " << coarser << ", at " << x << " "
                << y;
          }
        }
      }
    }
  }
}

// Whether someone before the front, which looks along z, sees a part at a point of it, at most
// `depth` behind its plane.
bool isSeenAt(const CoarseModel& m, double x, double y, double depth) {
  for (const CoarsePart& p : m.parts) {
    for (uint32_t t = 0; t < p.triangleCount; ++t) {
      const auto at = [&](size_t k) {
        return m.vertices[p.firstVertex + m.triangles[p.firstTriangle + t][k]];
      };
      const Vec3 a = at(0), b = at(1), c = at(2);
      const auto twice = [](const Vec3& u, const Vec3& v, double px, double py) {
        return (v.x - u.x) * (py - u.y) - (v.y - u.y) * (px - u.x);
      };
      const double whole = twice(a, b, c.x, c.y);
      if (!(std::abs(whole) > 1e-9)) continue;
      const double u = twice(b, c, x, y) / whole, v = twice(c, a, x, y) / whole, w = 1 - u - v;
      if (std::min({u, v, w}) < -1e-9) continue;
      if (u * a.z + v * b.z + w * c.z >= -depth) return true;
    }
  }
  return false;
}

// A wall of large pieces around windows in reveals, each of a pane and a sill that nothing lies
// behind: no level whose holes are closed opens them, whatever becomes of the pane.
TEST(Coarse, windowsInRevealsStayClosed) {
  for (const double wide : {0.5, 0.8, 1.1}) {
    Place place;
    for (int i = 0; i < 4; ++i) {
      const double x = 4.0 * i;
      place.add({x, 0, 0}, {4 - wide, 6, 0});
      place.add({x + 4 - wide, 0, 0}, {wide, 2, 0});
      place.add({x + 4 - wide, 2, 0}, {wide, 0.1, 0.15});
      place.add({x + 4 - wide, 2.1, -0.12}, {wide, 1.4, 0}, 1);
      place.add({x + 4 - wide, 3.5, 0}, {wide, 2.5, 0});
    }
    for (const double tolerance : {0.4, 0.7, 1.0}) {
      CoarseModel m = place.closed(tolerance);
      for (const double coarser : {0.0, 2.5}) {
        if (coarser > 0) m = coarsened(m, coarser * tolerance, &m);
        for (double x = 3.11; x < 13; x += 0.17) {
          for (double y = 2.2; y < 3.4; y += 0.13) {
            ASSERT_TRUE(isSeenAt(m, x, y, tolerance * (1 + coarser)))
                << wide << " wide, " << tolerance << " and " << coarser << ", at " << x << " " << y;
          }
        }
      }
    }
  }
}

// A front of strips with windows of frames and panes, and doors: 24 m by 12 m.
Place frontOfWindows() {
  Place place;
  for (int floor = 0; floor < 4; ++floor) {
    for (int bay = 0; bay < 8; ++bay) {
      const Vec3 at{3.0 * bay, 3.0 * floor, 0};
      const double wide = (bay + floor) % 3 == 0 ? 1.4 : 1.2, side = (3 - wide) / 2;
      place.add(at, {side, 3, 0});
      place.add(at + Vec3{3 - side, 0, 0}, {side, 3, 0});
      place.add(at + Vec3{side, 0, 0}, {wide, 0.9, 0});
      place.add(at + Vec3{side, 2.4, 0}, {wide, 0.6, 0});
      const double pane = (wide - 0.24) / 2;
      for (int i = 0; i < 3; ++i) {
        place.add(at + Vec3{side + i * (pane + 0.08), 0.9, -0.12}, {0.08, 1.5, 0});
      }
      for (int i = 0; i < 2; ++i) {
        place.add(at + Vec3{side + 0.08 + i * (pane + 0.08), 0.9, -0.12}, {pane, 1.5, 0}, 1);
      }
    }
  }
  return place;
}

// Windows of 1.2 m and of 1.4 m stay together or go together, whatever the tolerance.
TEST(Coarse, windowsOfAFrontStayAlike) {
  for (const double tolerance : {0.6, 0.86, 1.1, 1.3, 2.2, 2.5, 2.7, 3.5, 5.0}) {
    const CoarseModel m = frontOfWindows().coarse(tolerance);
    const auto isWindow = [](const CoarsePart& p) { return p.finish.color.x < 0.4; };
    const auto count = std::count_if(m.parts.begin(), m.parts.end(), isWindow);
    EXPECT_EQ(count, tolerance < 2.4 ? 32 : 0) << tolerance;
  }
}

// Seen from the front, square by square, the light of a level is that of the full model.
TEST(Coarse, levelsKeepTheMeanLight) {
  const auto lightOf = [](const CoarseModel& m) {
    double sum = 0;
    int count = 0;
    for (double x = 0.05; x < 24; x += 0.1) {
      for (double y = 0.05; y < 12; y += 0.1) {
        double nearest = -1e9, light = 0;
        for (const CoarsePart& p : m.parts) {
          Box3 box;
          for (const Vec3& c : {p.box.min, p.box.max}) box.include(p.frame.point(c));
          const bool isThere = x >= box.min.x && x <= box.max.x && y >= box.min.y && y <= box.max.y;
          if (!isThere || box.max.z <= nearest) continue;
          nearest = box.max.z;
          light = p.finish.color.x;
        }
        sum += light;
        ++count;
      }
    }
    return sum / count;
  };
  const double full = lightOf(frontOfWindows().parts());
  EXPECT_GT(full, 0.7);
  EXPECT_LT(full, 0.9);
  for (const double tolerance : {0.6, 0.86, 2.2, 3.5, 5.0}) {
    EXPECT_NEAR(lightOf(frontOfWindows().coarse(tolerance)), full, 0.02) << tolerance;
  }
}

// The bars of a railing do not become a block, however they lie in the cells.
TEST(Coarse, railingsAreNoBlocks) {
  for (double x = 0; x < 0.9; x += 0.1) {
    Place place;
    place.add({0, 0, 0}, {10, 6, 8});
    for (int i = 0; i < 12; ++i) place.add({x + 0.16 * i, 3, -1.2}, {0.04, 0.9, 0.0}, 1);
    for (int i = 0; i < 6; ++i) place.add({x, 3, -1.2 + 0.16 * i}, {0.0, 0.9, 0.04}, 1);
    for (const CoarsePart& p : place.coarse(0.86).parts) EXPECT_GT(p.finish.color.x, 0.9) << x;
  }
}

// A wall with windows on it is one wall: nothing is put behind it.
TEST(Coarse, wallsThatAreLargeGetNoPlate) {
  Place place;
  place.add({0, 0, 0}, {24, 12, 0});
  for (int i = 0; i < 60; ++i) {
    place.add({0.3 + 2.0 * (i % 12), 1 + 2.2 * (i / 12), 0.1}, {0.15, 1.2, 0}, 1);
  }
  for (int i = 0; i < 2; ++i) place.add({i * 24.0 - i * 0.3, 0, 0.05}, {0.3, 12, 0}, 1);
  EXPECT_EQ(place.coarse(0.8).parts.size(), 1u);
}

// Pieces of one stone with more windows on one than on the other are of one colour.
TEST(Coarse, piecesOfOneColourKeepOne) {
  Place place;
  for (int i = 0; i < 4; ++i) place.add({5.0 * i, 0, 0}, {5, 12, 0});
  for (int i = 0; i < 5; ++i) place.add({1.0 + 0.5 * i, 3, 0.1}, {0.4, 1, 0}, 1);
  const CoarseModel m = place.coarse(1);
  ASSERT_EQ(m.parts.size(), 4u);
  for (const CoarsePart& p : m.parts) EXPECT_EQ(p.finish.color, m.parts[0].finish.color);
  EXPECT_LT(m.parts[0].finish.color.x, 1);
}

TEST(Coarse, partsInOneDirectionThatLieApartMakeNoPlate) {
  Place place;
  // Railings: less than half is there.
  for (int i = 0; i < 40; ++i) place.add({0.5 * i, 0, 0}, {0.1, 8, 0.1});
  EXPECT_LT(areaOf(place.coarse(1)), 0.5 * 20 * 8);
  Place far;
  far.add({-1e30, 0, 0}, {0.5, 30, 0});
  far.add({1e30, 0, 0}, {0.5, 30, 0});
  for (int i = 0; i < 10; ++i) far.add({0.5 * i, 0, 0}, {1e9, 0.5, 0});
  EXPECT_NO_FATAL_FAILURE(far.coarse(1));
}

TEST(Coarse, hugeAndOddNumbersEnd) {
  Place place;
  place.add({1e30, 0, -1e30}, {1e30, 1, 1e30});
  place.add({0, 0, 0}, {0, 0, 0});
  place.add({0, 0, 0}, {-5, 5, 5});
  EXPECT_NO_FATAL_FAILURE(place.coarse(1));
}

// A wall of strips with a low rail beside it ends where it did, not where a cell does.
TEST(Coarse, platesEndWithTheirWall) {
  Place place;
  for (int i = 0; i < 32; ++i) place.add({0.25 * i, 0, 0}, {0.25, 6, 0});
  for (int i = 0; i < 4; ++i) place.add({8, 0.2 * i, 0}, {1.3, 0.2, 0});
  const CoarseModel m = place.coarse(1);
  for (double y = 2.1; y < 6; y += 0.3) {
    EXPECT_TRUE(isSeenAt(m, 7.9, y, 1)) << y;
    EXPECT_FALSE(isSeenAt(m, 8.1, y, 1)) << y;
  }
}

// What lies behind a front is not seen, and gives it no colour.
TEST(Coarse, platesHaveTheColourOfTheirFront) {
  Place place;
  place.add({0, 0, -9}, {24, 12, 7});
  for (int i = 0; i < 96; ++i) {
    place.add({0.25 * i, 0, 0}, {0.25, 12, 0}, 0);
    for (const double behind : {0.2, 0.4}) place.add({0.25 * i, 0, -behind}, {0.25, 12, 0}, 1);
  }
  const CoarseModel m = place.closed(0.75);
  for (double x = 0.3; x < 24; x += 0.7) {
    for (const CoarsePart& p : m.parts) {
      Box3 box;
      for (const Vec3& c : {p.box.min, p.box.max}) box.include(p.frame.point(c));
      if (box.max.x < x || box.min.x > x) continue;
      EXPECT_GT(p.finish.color.x, 0.9) << x;
    }
  }
}

TEST(Coarse, wallsTakeNoColourOfWhatTheyHide) {
  Place place;
  place.add({0, 0, 0}, {10, 6, 8});
  for (int i = 0; i < 8; ++i) place.add({i * 1.2, 3, 0.3}, {0.9, 0.9, 0.1}, 1);
  const CoarseModel m = place.closed(1);
  ASSERT_EQ(m.parts.size(), 1u);
  EXPECT_GT(m.parts[0].finish.color.x, 0.999);
}

// Windows lie on the front; the side of the same stone keeps its colour.
TEST(Coarse, wallsTakeTheColourThatOneSees) {
  Place place;
  place.add({0, 0, 0}, {10, 6, 0});
  place.add({0, 0, -8}, {0, 6, 8});
  place.add({0.2, 0, -8}, {9.8, 6, 7.8});
  for (int i = 0; i < 20; ++i) {
    place.add({0.1 + 0.49 * i, 2, 0.05}, {0.4, 0.9, 0}, 1);
    // Frames behind the panes.
    place.add({0.1 + 0.49 * i, 2, 0.02}, {0.4, 0.9, 0}, 0);
  }
  const CoarseModel m = place.closed(1);
  ASSERT_EQ(m.parts.size(), 3u);
  constexpr double kDark = 20 * 0.4 * 0.9 / 60;
  for (const CoarsePart& p : m.parts) {
    EXPECT_NEAR(p.finish.color.x, p.box.size().z == 0 ? 1 - kDark : 1, 0.02);
  }
}

// Strips below a gable are a wall; it ends where the gable does.
TEST(Coarse, platesKeepBelowTheSlopesOfGables) {
  Place place;
  for (int i = 0; i < 32; ++i) place.add({0.25 * i, 0, 0}, {0.25, 3, 0});
  place.addGable({0, 3, 0}, 8, 6);
  // A chimney beside it, as high as the ridge.
  place.add({-0.2, 0, 0}, {0.2, 9, 0}, 1);
  const CoarseModel m = place.coarse(0.8);
  for (double x = 0.2; x < 8; x += 0.2) {
    for (double y = 0.3; y < 10; y += 0.3) {
      const double top = 3 + 6 * (1 - std::abs(x - 4) / 4);
      if (y > top + 1.2) {
        EXPECT_FALSE(isSeenAt(m, x, y, 1)) << x << " " << y;
      }
      if (y < top - 0.8) {
        EXPECT_TRUE(isSeenAt(m, x, y, 1)) << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace gable
