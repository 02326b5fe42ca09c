// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/mesh/clip.h"

#include <gtest/gtest.h>

#include "geom/mesh/extrude.h"
#include "geom/mesh/face_plane.h"
#include "geom/mesh/topology.h"
#include "geom/region/clean.h"
#include "geom/region/corpus.h"

namespace gable {
namespace {

Mesh prism(const Polygon& p, double height) {
  // Plan coordinates on the ground, facing up.
  const Frame ground = Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  return extrude(meshOf({p}, ground), {ExtrudeMode::FaceNormal, height, {}}).mesh;
}

// No face is thinner than the promise, all indices are right.
bool sound(const Mesh& m) {
  if (!m.valid()) return false;
  for (size_t f = 0; f < m.faces.size(); ++f) {
    Box3 box;
    for (const MeshLoop& loop : m.loopsOf(f)) {
      if (loop.cornerCount < 3) return false;
      for (const uint32_t p : m.cornersOf(loop)) box.include(m.positions[p]);
    }
    if (!(m.area(f) > 1e-12 * dot(box.size(), box.size()))) return false;
  }
  return true;
}

TEST(Clip, cutsABoxIntoClosedHalves) {
  CutOptions options{true, 3, 9, 5};
  const PlaneCut cut = cutByPlane(makeBoxMesh({2, 3, 5}, true), {{0, 2, 0}, 2}, options);
  for (const MeshPart* part : {&cut.back, &cut.front}) {
    EXPECT_TRUE(sound(part->mesh));
    EXPECT_TRUE(Topology(part->mesh).closed());
    EXPECT_EQ(part->mesh.faceCount(), 6u);
    EXPECT_EQ(part->mesh.positions.size(), 8u);
    EXPECT_EQ(part->mesh.faces.back().tags, 9u);
    EXPECT_EQ(part->mesh.faces.back().materialSlot, 3);
    EXPECT_EQ(part->faceSource.back(), MeshPart::kNone);
  }
  EXPECT_DOUBLE_EQ(volume(cut.back.mesh), 10);
  EXPECT_DOUBLE_EQ(volume(cut.front.mesh), 20);
  EXPECT_EQ(cut.back.mesh.normal(5), (Vec3{0, 1, 0}));
  EXPECT_EQ(cut.front.mesh.normal(5), (Vec3{0, -1, 0}));
}

TEST(Clip, sidesKeepUvAndStartAndTagTheCut) {
  CutOptions options;
  options.cutEdgeTags = 5;
  const double cuts[] = {0.5, 1.5};
  const std::vector<MeshPart> parts = sliceAxis(makeBoxMesh({2, 3, 5}, true), 0, cuts, options);
  ASSERT_EQ(parts.size(), 3u);
  const Mesh& m = parts[1].mesh;
  ASSERT_EQ(m.faceCount(), 4u);
  // The front face of the middle part starts at its lower left corner.
  const uint32_t c = m.loopsOf(2)[0].firstCorner;
  EXPECT_EQ(m.normal(2), (Vec3{0, 0, 1}));
  EXPECT_EQ(m.at(c), (Vec3{0.5, 0, 5}));
  EXPECT_EQ(m.uvs[0][c], (Vec2{0.25, 0}));
  EXPECT_EQ(m.uvs[0][c + 2], (Vec2{0.75, 1}));
  EXPECT_EQ(m.edgeTags[c], 0u);
  EXPECT_EQ(m.edgeTags[c + 1], 5u);
  EXPECT_EQ(parts[1].edgeSource[c], 8u);
  EXPECT_EQ(parts[1].edgeSource[c + 1], MeshPart::kNone);
  EXPECT_EQ(parts[1].faceSource[2], 2u);
}

TEST(Clip, flatFacesGoToOneSide) {
  const Mesh box = makeBoxMesh({1, 1, 1}, false);
  const double atTop[] = {1}, atBottom[] = {0};
  CutOptions cap;
  cap.cap = true;
  std::vector<MeshPart> parts = sliceAxis(box, 1, atTop, cap);
  EXPECT_EQ(parts[0].mesh.faceCount(), 6u);
  EXPECT_EQ(parts[1].mesh.faceCount(), 0u);
  parts = sliceAxis(box, 1, atBottom, cap);
  EXPECT_EQ(parts[0].mesh.faceCount(), 0u);
  EXPECT_EQ(parts[1].mesh.faceCount(), 6u);
}

TEST(Clip, cutAtAStepCapsOnlyTheOpening) {
  // An L of two boxes seen from the front, cut at the height of the step.
  const Mesh step =
      extrude(meshOf({{{{0, 0}, {4, 0}, {4, 1}, {2, 1}, {2, 3}, {0, 3}}, {}}}, Frame()),
              {ExtrudeMode::FaceNormal, 2, {}})
          .mesh;
  const double cuts[] = {1};
  CutOptions cap;
  cap.cap = true;
  const std::vector<MeshPart> parts = sliceAxis(step, 1, cuts, cap);
  EXPECT_TRUE(Topology(parts[0].mesh).closed());
  EXPECT_TRUE(Topology(parts[1].mesh).closed());
  EXPECT_DOUBLE_EQ(volume(parts[0].mesh), 8);
  EXPECT_DOUBLE_EQ(volume(parts[1].mesh), 8);
  EXPECT_EQ(parts[0].mesh.faceCount(), 7u);
  EXPECT_DOUBLE_EQ(parts[0].mesh.area(parts[0].mesh.faceCount() - 1), 4);
}

TEST(Clip, capsHaveHoles) {
  const Ring outer = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, hole = {{1, 1}, {1, 3}, {3, 3}, {3, 1}};
  const Mesh tube = prism({outer, {hole}}, 10);
  const double cuts[] = {2, 5};
  CutOptions cap;
  cap.cap = true;
  const std::vector<MeshPart> parts = sliceAxis(tube, 1, cuts, cap);
  for (const MeshPart& p : parts) {
    EXPECT_TRUE(sound(p.mesh));
    EXPECT_TRUE(Topology(p.mesh).closed());
    EXPECT_EQ(holeCount(p.mesh), 2u);
  }
  EXPECT_DOUBLE_EQ(volume(parts[1].mesh), 36);
}

TEST(Clip, openMeshesGetNoCaps) {
  Mesh box = makeBoxMesh({1, 1, 1}, false);
  box.faces.pop_back();
  CutOptions cap;
  cap.cap = true;
  const double cuts[] = {0.5};
  for (const MeshPart& p : sliceAxis(box, 1, cuts, cap)) {
    for (const uint32_t f : p.faceSource) EXPECT_NE(f, MeshPart::kNone);
  }
}

TEST(Clip, aHoleThatIsCutOpensIntoTheRing) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}}};
  const double cuts[] = {1, 2};
  const std::vector<MeshPart> parts = sliceAxis(meshOf({p}, Frame()), 0, cuts);
  EXPECT_EQ(parts[0].mesh.faceCount(), 1u);
  EXPECT_EQ(parts[1].mesh.faceCount(), 2u);
  EXPECT_EQ(parts[2].mesh.faceCount(), 1u);
  EXPECT_EQ(holeCount(parts[2].mesh), 0u);
  EXPECT_DOUBLE_EQ(parts[0].mesh.area(), 4);
  EXPECT_DOUBLE_EQ(parts[1].mesh.area(), 2);
  EXPECT_DOUBLE_EQ(parts[2].mesh.area(), 6);
  // The hole's side lies on the first cut: the part beside it has its corners as well.
  EXPECT_EQ(parts[0].mesh.loopsOf(0)[0].cornerCount, 6u);
}

TEST(Clip, aVertexThatTouchesTheCutSplitsNothing) {
  const Polygon p{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {2, 2}, {3, 1}}}};
  const double cuts[] = {2};
  const std::vector<MeshPart> parts = sliceAxis(meshOf({p}, Frame()), 1, cuts);
  EXPECT_EQ(parts[0].mesh.faceCount(), 1u);
  EXPECT_EQ(holeCount(parts[0].mesh), 1u);
  EXPECT_DOUBLE_EQ(parts[0].mesh.area(), 7);
  EXPECT_DOUBLE_EQ(parts[1].mesh.area(), 8);
}

TEST(Clip, cornersWithinTheToleranceMakeNoSlivers) {
  CutOptions options;
  options.cap = true;
  options.tolerance = 1e-6;
  // Through two edges of a unit cube, but for a rounding.
  const double across = std::sqrt(0.5);
  const PlaneCut cut =
      cutByPlane(makeBoxMesh({1, 1, 1}, true), {{across, 0, across}, across + 4e-8}, options);
  for (const MeshPart* part : {&cut.back, &cut.front}) {
    EXPECT_EQ(part->mesh.faceCount(), 5u);
    EXPECT_NEAR(std::fabs(volume(part->mesh)), 0.5, 1e-6);
  }
}

TEST(Clip, fieldsCutByUv) {
  Mesh quad = makeQuadMesh(4, 2, QuadPlane::Xy, true);
  std::vector<double> u;
  for (const Vec2 uv : quad.uvs[0]) u.push_back(uv.x);
  const double cuts[] = {0.25, 0.5};
  const std::vector<MeshPart> parts = sliceField(quad, u, cuts, 4);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_DOUBLE_EQ(parts[0].mesh.area(), 2);
  EXPECT_DOUBLE_EQ(parts[1].mesh.area(), 2);
  EXPECT_DOUBLE_EQ(parts[2].mesh.area(), 4);
  EXPECT_EQ(parts[1].mesh.uvs[0][0], (Vec2{0.25, 0}));
}

TEST(Clip, edgesAreCutIntoEdges) {
  MeshBuilder b;
  const uint32_t edge[] = {b.addPosition({3, 0, 0}), b.addPosition({0, 0, 0})};
  b.addPolygon(edge);
  const double cuts[] = {1, 2};
  const std::vector<MeshPart> parts = sliceAxis(b.take(), 0, cuts);
  for (size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(parts[i].mesh.faceCount(), 1u);
    EXPECT_DOUBLE_EQ(parts[i].mesh.at(1).x, static_cast<double>(i));
    EXPECT_DOUBLE_EQ(parts[i].mesh.at(0).x, static_cast<double>(i + 1));
  }
}

// Cuts through vertices, along edges, and at random places; by an axis and by slanted planes.
void expectCutKeepsVolume(const Mesh& solid, const std::vector<MeshPart>& parts, size_t i) {
  double sum = 0, capArea = 0;
  for (const MeshPart& p : parts) {
    ASSERT_TRUE(sound(p.mesh)) << i;
    const Topology t(p.mesh);
    for (uint32_t c = 0; c < t.componentCount(); ++c) ASSERT_TRUE(t.componentEncloses(c)) << i;
    sum += volume(p.mesh);
    for (size_t f = 0; f < p.mesh.faceCount(); ++f) {
      capArea += p.faceSource[f] == MeshPart::kNone ? p.mesh.area(f) : 0;
    }
  }
  double outer = 0;
  for (const MeshPart& p : parts) outer += p.mesh.area();
  const double v = volume(solid);
  ASSERT_NEAR(sum, v, 1e-7 * v) << i;
  ASSERT_NEAR(outer - capArea, solid.area(), 1e-7 * solid.area()) << i;
}

TEST(Clip, corpusPrismsKeepTheirVolumeAndStayClosed) {
  const std::vector<corpus::Case> cases = corpus::loadCorpus();
  if (cases.empty()) GTEST_SKIP() << "the polygon corpus is not beside the repository";
  CutOptions cap;
  cap.cap = true;
  for (size_t i = 0; i < cases.size(); ++i) {
    Polygon p = corpus::withHoles(cases[i].ring, i);
    // Edges of a picometre make side faces that are too thin before any cut.
    dropDuplicates(p.outer, 1e-9);
    const Mesh solid = prism(p, 3);
    const Box3 box = solid.bounds();
    std::vector<double> cuts = {cases[i].ring[1].x, cases[i].ring[cases[i].ring.size() / 2].x};
    for (uint64_t k = 0; k < 4; ++k) {
      cuts.push_back(randomIn(hashCombine(i, k), box.min.x, box.max.x));
    }
    std::sort(cuts.begin(), cuts.end());
    ASSERT_NO_FATAL_FAILURE(expectCutKeepsVolume(solid, sliceAxis(solid, 0, cuts, cap), i));
    const Vec3 n = normalized(Vec3{1, randomIn(hashCombine(i, 7), -1, 1), 0.3});
    const double through = dot(n, solid.positions[i % solid.positions.size()]);
    PlaneCut cut = cutByPlane(solid, {n, through}, cap);
    std::vector<MeshPart> halves;
    halves.push_back(std::move(cut.back));
    halves.push_back(std::move(cut.front));
    ASSERT_NO_FATAL_FAILURE(expectCutKeepsVolume(solid, halves, i));
  }
}

}  // namespace
}  // namespace gable
