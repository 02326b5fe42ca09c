// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The town of Monaco: 1218 real footprints with courts, towers within other footprints, kiosks of
// two metres and blocks of two hundred. What its rules promise holds for every one of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"
#include "geom/region/places.h"
#include "scene_faults.h"

namespace gable {
namespace {

std::string folder() { return std::string(GABLE_SOURCE_DIR) + "/examples/monaco/"; }

/// What stands for a window or a door in a wall: the panes, and the leaves of closed shutters.
const std::set<std::string> kOpenings = {"Glass", "Shutter", "Louvres", "Slit", "Door", "Leaf"};
/// A wall without a window may be so long at most, in metres.
constexpr double kBlindWall = 3;
/// Balconies and slabs reach so far over a court.
constexpr double kReach = 1.3;

struct Part {
  const Leaf* leaf;
  Frame world;
  Vec2 centre;
  Box3 box;

  const std::string* name;
  const std::string* rule;
};

Mesh meshOf(const Scene& scene, const Part& p) {
  return transformed(*scene.meshes[p.leaf->mesh], p.leaf->scale, p.world);
}

struct Building {
  Polygon plan;
  std::vector<Part> parts;
};

Polygon planOf(const ShapeFootprint& f) {
  const Mesh world = transformed(f.mesh, {1, 1, 1}, f.origin);
  const Frame ground = Frame::of({0, world.bounds().min.y, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  Polygon plan = world.faceCount() > 0 ? facePolygon(world, 0, ground) : Polygon{};
  orient(plan);
  return plan;
}

/// The example as `./run` makes it, derived once for all tests.
class Monaco : public testing::Test {
 protected:
  struct Town {
    Shapes uncut = Shapes::load(folder() + "buildings.geojson");
    Shapes shapes = uncut.withNestedCut();
    Rules rules = Rules::load(folder() + "monaco.cga");
    Model model = derive(rules, shapes, {});
    std::vector<Building> buildings;

    Town() {
      const Scene& scene = model.impl().result.scene;
      for (size_t i = 0; i < scene.roots.size(); ++i) {
        Building b;
        b.plan = planOf(shapes.impl().footprints[i]);
        const Instance& root = scene.roots[i].instance;
        forEachLeaf(scene, scene.prototypes[root.prototype], root.frame,
                    [&](const Leaf& leaf, const Frame& world) {
                      Part p;
                      p.leaf = &leaf;
                      p.world = world;
                      p.box = meshOf(scene, p).bounds();
                      const Vec3 c = (p.box.min + p.box.max) * 0.5;
                      p.centre = {c.x, -c.z};
                      p.name = &scene.names[leaf.name];
                      p.rule = &scene.sources[leaf.source].rule;
                      b.parts.push_back(std::move(p));
                    });
        buildings.push_back(std::move(b));
      }
    }
  };

  static Town& town() {
    static Town made;
    return made;
  }
  static const Scene& scene() { return town().model.impl().result.scene; }
};

bool apart(const Box2& a, const Box2& b) {
  return a.max.x < b.min.x || b.max.x < a.min.x || a.max.y < b.min.y || b.max.y < a.min.y;
}

double distanceTo(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double along = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-12), 0.0, 1.0);
  return length(p - (a + d * along));
}

double distanceTo(const Ring& ring, Vec2 p) {
  double least = 1e300;
  for (size_t i = 0; i < ring.size(); ++i) {
    least = std::min(least, distanceTo(p, ring[i], ring[(i + 1) % ring.size()]));
  }
  return least;
}

TEST_F(Monaco, derivesEveryFootprint) {
  ASSERT_TRUE(town().rules.ok() && town().shapes.ok());
  ASSERT_EQ(town().shapes.size(), 1218u);
  EXPECT_FALSE(hasErrors(town().model.diagnostics())) << render(town().model.diagnostics());
  ASSERT_EQ(scene().roots.size(), 1218u);
  for (size_t i = 0; i < town().buildings.size(); ++i) {
    EXPECT_FALSE(town().buildings[i].parts.empty()) << "footprint " << i;
  }
  EXPECT_EQ(joined(faults(scene())), "");
  // What makes it a town and not a model of blocks.
  EXPECT_GE(count(scene()).leaves, 300u * 1218u);
}

/// Of a grid of points, the one deepest in a ring.
Vec2 deepest(const Ring& ring) {
  const Box2 box = bounds(ring);
  Vec2 best = box.min;
  double depth = -1;
  for (int i = 1; i < 40; ++i) {
    for (int k = 1; k < 40; ++k) {
      const Vec2 p = {box.min.x + (box.max.x - box.min.x) * i / 40,
                      box.min.y + (box.max.y - box.min.y) * k / 40};
      if (locate(ring, p) != Where::Inside || distanceTo(ring, p) <= depth) continue;
      depth = distanceTo(ring, p);
      best = p;
    }
  }
  return best;
}

/// Whether a part stands in a court or covers the middle of it. Balconies and eaves may reach in.
bool obstructs(const Scene& scene, const Part& p, const Ring& court, Vec2 middle) {
  const Mesh mesh = meshOf(scene, p);
  for (const Vec3& v : mesh.positions) {
    const Vec2 at = {v.x, -v.z};
    if (locate(court, at) == Where::Inside && distanceTo(court, at) > kReach) return true;
  }
  if (middle.x < p.box.min.x || middle.x > p.box.max.x || -middle.y < p.box.min.z ||
      -middle.y > p.box.max.z) {
    return false;
  }
  const Frame ground = Frame::of({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    Polygon polygon = facePolygon(mesh, face, ground);
    orient(polygon);
    if (area(polygon) > 1e-6 && locate(polygon, middle) == Where::Inside) return true;
  }
  return false;
}

TEST_F(Monaco, leavesCourtsFree) {
  size_t courts = 0;
  for (size_t i = 0; i < town().buildings.size(); ++i) {
    const Building& b = town().buildings[i];
    for (const Ring& court : b.plan.holes) {
      ++courts;
      const Vec2 middle = deepest(court);
      const auto found = std::find_if(b.parts.begin(), b.parts.end(), [&](const Part& p) {
        return obstructs(scene(), p, court, middle);
      });
      if (found == b.parts.end()) continue;
      ADD_FAILURE() << *found->name << " of footprint " << i << " by " << *found->rule
                    << " stands in a court";
    }
  }
  EXPECT_GT(courts, 30u);
}

// Walls shared with a neighbour count too: the rules do not know of neighbours, and above a lower
// one a wall is seen.
TEST_F(Monaco, everyLongWallHasAWindow) {
  size_t walls = 0, blind = 0;
  for (size_t i = 0; i < town().buildings.size(); ++i) {
    const Building& b = town().buildings[i];
    std::vector<Vec2> openings;
    for (const Part& p : b.parts) {
      if (kOpenings.count(*p.rule) > 0) openings.push_back(p.centre);
    }
    std::vector<const Ring*> rings = {&b.plan.outer};
    for (const Ring& hole : b.plan.holes) rings.push_back(&hole);
    for (const Ring* ring : rings) {
      for (size_t k = 0; k < ring->size(); ++k) {
        const Vec2 from = (*ring)[k], to = (*ring)[(k + 1) % ring->size()];
        if (length(to - from) <= kBlindWall) continue;
        ++walls;
        // Not those of the next wall, round the corner.
        const Vec2 step = (to - from) * (0.3 / length(to - from));
        const bool open = std::any_of(openings.begin(), openings.end(), [&](Vec2 at) {
          return distanceTo(at, from + step, to - step) < 0.4;
        });

        if (open) continue;
        ++blind;
        if (blind <= 20) {
          ADD_FAILURE() << "footprint " << i << ": a wall of " << length(to - from) << " m from ("
                        << from.x << ", " << from.y << ") has no window";
        }
      }
    }
  }
  EXPECT_GT(walls, 5000u);
  EXPECT_EQ(blind, 0u) << "of " << walls;
}

TEST_F(Monaco, smallBuildingsAreSimpleAndLongOnesDivided) {
  size_t small = 0, large = 0;
  for (size_t i = 0; i < town().buildings.size(); ++i) {
    const Building& b = town().buildings[i];
    const Vec2 size = bounds(b.plan).max - bounds(b.plan).min;
    if (std::max(size.x, size.y) < 6) {
      ++small;
      EXPECT_LT(b.parts.size(), 120u) << "footprint " << i;
    }
    if (std::max(size.x, size.y) <= 60) continue;
    ++large;
    // No piece of wall goes on for longer than a few houses.
    for (const Part& p : b.parts) {
      const Vec3 extent = p.box.size();
      if (extent.y < 1.5 || std::hypot(extent.x, extent.z) < 46) continue;
      const Mesh mesh = meshOf(scene(), p);
      for (size_t face = 0; face < mesh.faceCount(); ++face) {
        if (std::fabs(mesh.normal(face).y) > 0.1) continue;
        ADD_FAILURE() << *p.name << " of footprint " << i << " is not divided";
        break;
      }
    }
  }
  EXPECT_GT(small, 10u);
  EXPECT_GT(large, 50u);
}

// What lies in another or overlaps it is cut out of it; where nothing would be left of the larger
// one, it is drawn in, so that no wall of it lies in one of theirs.
TEST_F(Monaco, nestedFootprintsShareNoWall) {
  std::vector<Polygon> before;
  for (const ShapeFootprint& f : town().uncut.impl().footprints) before.push_back(planOf(f));
  size_t centred = 0;
  std::set<size_t> nested;
  for (size_t inner = 0; inner < before.size(); ++inner) {
    const double size = area(before[inner]);
    const Vec2 middle = centroid(Polygon{before[inner].outer, {}});
    for (size_t outer = 0; outer < before.size(); ++outer) {
      if (inner == outer || apart(bounds(before[outer]), bounds(before[inner]))) continue;
      centred += contains(Polygon{before[outer].outer, {}}, middle);
      if (area(before[outer]) <= size) continue;
      if (area(intersect({before[outer]}, {before[inner]})) < 0.01 * size) continue;
      nested.insert(inner);
      const Polygon& left = town().buildings[outer].plan;
      if (area(intersect({left}, {town().buildings[inner].plan})) < 0.01 * size) continue;
      for (const Vec2 corner : left.outer) {
        EXPECT_GT(distanceTo(before[outer].outer, corner), 0.4)
            << "footprint " << inner << " in " << outer;
      }
    }
  }
  // 41 times the middle of one lies within the outline of another, some of them in its court or in
  // the angle of an L; 27 share ground.
  EXPECT_EQ(centred, 41u);
  EXPECT_EQ(nested.size(), 27u);
}

}  // namespace
}  // namespace gable
