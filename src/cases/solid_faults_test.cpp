// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Scenes made by hand: boxes and quads, by their least corner and their size.

#include "cases/solid_faults.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gable::cases {
namespace {

struct Made {
  Scene scene;

  Made() {
    scene.names = {"Lot"};
    scene.prototypes = {Prototype{}};
    scene.roots = {Root{}};
    scene.sources = {SourcePlace{}};
    for (const double red : {0.2, 0.4, 0.6, 0.8}) {
      Material material;
      material.color.x = red;
      scene.materialLists.push_back({static_cast<uint32_t>(scene.materials.size())});
      scene.materials.push_back(material);
    }
  }
  Made& add(uint32_t mesh, const Frame& frame, const Vec3& size) {
    Leaf leaf;
    leaf.frame = frame;
    leaf.scale = size;
    leaf.mesh = mesh;
    leaf.materials = static_cast<uint32_t>(scene.leaves.size() % scene.materialLists.size());
    scene.leaves.push_back(leaf);
    scene.prototypes[0].leafCount = static_cast<uint32_t>(scene.leaves.size());
    return *this;
  }
  Made& box(const Vec3& corner, const Vec3& size) {
    return add(kUnitBox, Frame::moved(corner), size);
  }
  Made& floor(const Vec3& corner, const Vec3& size) {
    return add(kUnitQuadXz, Frame::moved(corner), size);
  }
  Made& mesh(Mesh m) {
    scene.meshes.push_back(makeRef<Mesh>(std::move(m)));
    return add(static_cast<uint32_t>(scene.meshes.size() - 1), {}, {1, 1, 1});
  }

  size_t coplanar() const { return coplanarFaces(Parts(scene), 0).size(); }
  size_t floating() const { return floatingParts(Parts(scene), 0).size(); }
  size_t overlapping() const { return overlaps(Parts(scene)).size(); }
};

// A closed body without a top or a bottom that sees all of it: an L of two metres, one metre high.
Mesh angle() {
  const Vec2 ring[] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  MeshBuilder b;
  for (const double y : {0.0, 1.0}) {
    for (const Vec2 p : ring) b.addPosition(fromPlan(p, y));
  }
  b.addPolygon(std::vector<uint32_t>{5, 4, 3, 2, 1, 0});
  b.addPolygon(std::vector<uint32_t>{6, 7, 8, 9, 10, 11});
  for (uint32_t i = 0; i < 6; ++i) {
    const uint32_t k = (i + 1) % 6;
    b.addPolygon(std::vector<uint32_t>{i, k, k + 6, i + 6});
  }
  return b.take();
}

TEST(SolidFaults, findsFacesInOnePlane) {
  // Two boxes side by side whose fronts run into each other.
  Made both;
  both.box({0, 0, 0}, {2, 3, 1}).box({1, 1, 0.5}, {3, 1, 0.5});
  EXPECT_EQ(both.coplanar(), 1u);
  const std::vector<SolidFault> faults = coplanarFaces(Parts(both.scene), 0);
  EXPECT_EQ(faults[0].first, 0u);
  EXPECT_EQ(faults[0].second, 1u);
  EXPECT_NEAR(faults[0].amount, 1, 1e-9);
  EXPECT_NEAR(faults[0].at.z, 1, 1e-9);
}

TEST(SolidFaults, facesThatTouchOrStandOffAreNotInOnePlane) {
  // Side by side, one on the other, and two millimetres before it.
  EXPECT_EQ(Made().box({0, 0, 0}, {1, 1, 1}).box({1, 0, 0}, {1, 1, 1}).coplanar(), 0u);
  EXPECT_EQ(Made().box({0, 0, 0}, {1, 1, 1}).box({0, 1, 0}, {1, 1, 1}).coplanar(), 0u);
  EXPECT_EQ(Made().floor({0, 0, 0}, {4, 1, 4}).floor({1, 0.002, 1}, {1, 1, 1}).coplanar(), 0u);
  EXPECT_EQ(Made().floor({0, 0, 0}, {4, 1, 4}).floor({1, 0.0005, 1}, {1, 1, 1}).coplanar(), 1u);
}

TEST(SolidFaults, facesOfOneMaterialDoNotFlicker) {
  Made made;
  made.floor({0, 0, 0}, {4, 1, 4}).floor({1, 0, 1}, {1, 1, 1});
  EXPECT_EQ(made.coplanar(), 1u);
  made.scene.materials[1] = made.scene.materials[0];
  EXPECT_EQ(made.coplanar(), 0u);
}

TEST(SolidFaults, nobodySeesWhatLooksDownAtTheGround) {
  EXPECT_EQ(Made().box({0, 0, 0}, {2, 1, 2}).box({1, 0, 0.5}, {2, 0.5, 1}).coplanar(), 0u);
  EXPECT_EQ(Made().box({0, 3, 0}, {2, 1, 2}).box({1, 3, 0.5}, {2, 0.5, 1}).coplanar(), 1u);
}

TEST(SolidFaults, seesLeavesThatAreMirroredOrTurned) {
  Frame turned = rotationXyz(0, 30, 0);
  EXPECT_EQ(Made().floor({0, 0, 0}, {4, 1, 4}).add(kUnitQuadXz, turned, {1, 1, 1}).coplanar(), 1u);
  // Mirrored it looks the same way from the other side of its corner.
  EXPECT_EQ(Made().floor({-2, 0, 0}, {4, 1, 4}).floor({0, 0, 1}, {-1, 1, 1}).coplanar(), 1u);
}

TEST(SolidFaults, findsWhatNothingCarries) {
  // A lamp that is ten centimetres above its post, and a wall with a sill far from it.
  EXPECT_EQ(Made().box({0, 0, 0}, {0.1, 3, 0.1}).box({0, 3.1, 0}, {0.3, 0.3, 0.3}).floating(), 1u);
  EXPECT_EQ(Made().box({0, 0, 0}, {4, 3, 0.2}).box({1, 1, 0.25}, {1, 0.1, 0.1}).floating(), 1u);
  // Of two that hold each other up, the group is told once, by its lowest.
  Made pair;
  pair.box({0, 3, 0}, {1, 1, 1}).box({0, 2, 0}, {1, 1, 1});
  const std::vector<SolidFault> faults = floatingParts(Parts(pair.scene), 0);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].first, 1u);
  EXPECT_EQ(faults[0].second, 2u);
  EXPECT_NEAR(faults[0].amount, 2, 1e-9);
}

TEST(SolidFaults, whatIsJoinedToTheGroundDoesNotFloat) {
  // A post, an arm along it, and a lamp below the arm; and what is joined only where two boxes
  // cross.
  EXPECT_EQ(Made()
                .box({0, 0, 0}, {0.1, 3, 0.1})
                .box({0.1, 2.8, 0}, {1, 0.1, 0.1})
                .box({1, 2.5, 0}, {0.1, 0.3, 0.1})
                .floating(),
            0u);
  EXPECT_EQ(Made().box({0, 0, 0}, {1, 9, 1}).box({-3, 4, 0.4}, {7, 0.2, 0.2}).floating(), 0u);
  // A hair less than the tolerance.
  EXPECT_EQ(Made().box({0, 0, 0}, {1, 1, 1}).box({0, 1.009, 0}, {1, 1, 1}).floating(), 0u);
  EXPECT_EQ(Made().floor({0, -2, 0}, {1, 1, 1}).floating(), 0u);
}

TEST(SolidFaults, findsBoxesThatStandInEachOther) {
  EXPECT_EQ(Made().box({0, 0, 0}, {1, 1, 1}).box({0.9, 0, 0}, {1, 1, 1}).overlapping(), 1u);
  // Beams that cross, neither with a corner in the other.
  EXPECT_EQ(Made().box({0, 0, 0}, {4, 0.2, 0.2}).box({1, -2, 0.05}, {0.1, 4, 0.1}).overlapping(),
            1u);
  EXPECT_EQ(Made().box({0, 0, 0}, {1, 1, 1}).box({0.995, 0, 0}, {1, 1, 1}).overlapping(), 0u);
  // Their boxes meet, they do not.
  EXPECT_EQ(Made()
                .box({0, 0, 0}, {1, 1, 1})
                .add(kUnitBox,
                     [] {
                       Frame f = rotationXyz(0, 45, 0);
                       f.origin = {1.2, 0, 1.2};
                       return f;
                     }(),
                     {1, 1, 1})
                .overlapping(),
            0u);
}

TEST(SolidFaults, findsBodiesThatAreNotConvex) {
  EXPECT_EQ(Made().mesh(angle()).box({0.4, 0.2, -3}, {0.2, 0.2, 4}).overlapping(), 1u);
  EXPECT_EQ(Made().mesh(angle()).box({0.2, 0.2, -0.8}, {0.2, 0.2, 0.2}).overlapping(), 1u);
  // In the corner that the L leaves free.
  EXPECT_EQ(Made().mesh(angle()).box({1.1, 0.2, -1.9}, {0.5, 0.5, 0.5}).overlapping(), 0u);
  EXPECT_EQ(Made().mesh(angle()).box({1, 0, -2}, {1, 1, 1}).overlapping(), 0u);
}

TEST(SolidFaults, asksNothingOfWhatMayStandInEachOther) {
  Made made;
  made.box({0, 0, 0}, {1, 1, 1}).box({0.5, 0, 0}, {1, 1, 1}).box({0, 0.5, 0}, {1, 1, 1});
  const auto withFirst = [](uint32_t a, uint32_t) { return a == 0; };
  EXPECT_EQ(made.overlapping(), 3u);
  EXPECT_EQ(overlaps(Parts(made.scene), withFirst).size(), 1u);
}

}  // namespace
}  // namespace gable::cases
