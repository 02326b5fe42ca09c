// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/boolean.h"

#include <gtest/gtest.h>

#include <map>

#include "base/random.h"
#include "geom/mesh/garbage.h"
#include "geom/mesh/topology.h"
#include "geom/primitive/solids.h"
#include "geom/region/corpus.h"
#include "math/trig.h"

namespace gable {
namespace {

Frame turned(Vec3 at, double degrees, const Vec3& axis = {0, 1, 0}) {
  const Vec3 k = normalized(axis);
  const double c = cosDeg(degrees), s = sinDeg(degrees);
  const auto turn = [&](const Vec3& v) {
    return v * c + cross(k, v) * s + k * (dot(k, v) * (1 - c));
  };
  Frame f;
  f.origin = at;
  f.x = turn({1, 0, 0});
  f.y = turn({0, 1, 0});
  f.z = turn({0, 0, 1});
  return f;
}

Mesh boxAt(const Vec3& at, const Vec3& size) {
  return transformed(makeBoxMesh(size, true), {1, 1, 1}, turned(at, 0));
}

SolidResult combined(const Mesh& a, const Mesh& b, SolidOp op) {
  Mesh both = a;
  append(both, b);
  std::vector<uint32_t> operand(both.faceCount(), 0);
  std::fill(operand.begin() + static_cast<std::ptrdiff_t>(a.faceCount()), operand.end(), 1);
  const auto result = solidBoolean(both, operand, op);
  EXPECT_TRUE(result.has_value());
  return result.value_or(SolidResult{});
}

Mesh combine(const Mesh& a, const Mesh& b, SolidOp op) {
  SolidResult r = combined(a, b, op);
  EXPECT_TRUE(r.mesh.valid());
  EXPECT_EQ(r.faceSource.size(), r.mesh.faceCount());
  EXPECT_EQ(r.edgeSource.size(), r.mesh.corners.size());
  return std::move(r.mesh);
}

// Every edge is run along as often one way as the other.
bool encloses(const Mesh& m) {
  std::map<std::pair<uint32_t, uint32_t>, int> runs;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    for (const MeshLoop& loop : m.loopsOf(f)) {
      const auto c = m.cornersOf(loop);
      for (size_t i = 0; i < c.size(); ++i) {
        const uint32_t u = c[i], v = c[(i + 1) % c.size()];
        runs[{std::min(u, v), std::max(u, v)}] += u < v ? 1 : -1;
      }
    }
  }
  return std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run.second == 0; });
}

// The four results of two closed operands agree with each other.
void expectConsistent(const Mesh& a, const Mesh& b, double slack = 1e-9) {
  const Mesh both = combine(a, b, SolidOp::Union), common = combine(a, b, SolidOp::Intersect);
  const Mesh left = combine(a, b, SolidOp::Subtract), right = combine(b, a, SolidOp::Subtract);
  for (const Mesh* m : {&both, &common, &left, &right}) EXPECT_TRUE(encloses(*m));
  const double va = volume(a), vb = volume(b), scale = slack * (std::fabs(va) + std::fabs(vb));
  EXPECT_NEAR(volume(both) + volume(common), va + vb, scale);
  EXPECT_NEAR(volume(left), va - volume(common), scale);
  EXPECT_NEAR(volume(right), vb - volume(common), scale);
  EXPECT_GE(volume(common), -scale);
  EXPECT_LE(volume(common), std::min(va, vb) + scale);
}

TEST(SolidBoolean, boxesThatOverlapAtACorner) {
  const Mesh a = boxAt({0, 0, 0}, {2, 2, 2}), b = boxAt({1, 1, 1}, {2, 2, 2});
  expectConsistent(a, b);
  const Mesh both = combine(a, b, SolidOp::Union);
  EXPECT_NEAR(volume(both), 15, 1e-12);
  EXPECT_EQ(both.faceCount(), 12u);
  const Mesh common = combine(a, b, SolidOp::Intersect);
  EXPECT_NEAR(volume(common), 1, 1e-12);
  EXPECT_EQ(common.faceCount(), 6u);
  EXPECT_EQ(common.positions.size(), 8u);
  EXPECT_NEAR(volume(combine(a, b, SolidOp::Subtract)), 7, 1e-12);
}

TEST(SolidBoolean, aBoxThroughABoxLeavesAHole) {
  const Mesh a = boxAt({0, 0, 0}, {3, 3, 3}), b = boxAt({1, -1, 1}, {1, 5, 1});
  expectConsistent(a, b);
  const Mesh left = combine(a, b, SolidOp::Subtract);
  EXPECT_NEAR(volume(left), 24, 1e-12);
  EXPECT_EQ(left.faceCount(), 10u);
  EXPECT_EQ(holeCount(left), 2u);
}

TEST(SolidBoolean, touchingBoxesLoseTheFaceBetween) {
  const Mesh a = boxAt({0, 0, 0}, {2, 2, 2}), b = boxAt({2, 0, 0}, {3, 2, 2});
  expectConsistent(a, b);
  const Mesh both = combine(a, b, SolidOp::Union);
  EXPECT_NEAR(volume(both), 20, 1e-12);
  EXPECT_EQ(both.faceCount(), 10u);
  EXPECT_TRUE(combine(a, b, SolidOp::Intersect).empty());
  EXPECT_EQ(combine(a, b, SolidOp::Subtract).faceCount(), 6u);
}

TEST(SolidBoolean, identicalNestedAndDisjointBoxes) {
  const Mesh a = boxAt({0, 0, 0}, {2, 2, 2}), in = boxAt({0.5, 0.5, 0.5}, {1, 1, 1});
  const Mesh away = boxAt({5, 0, 0}, {1, 1, 1});
  for (const Mesh* b : {&a, &in, &away}) expectConsistent(a, *b);
  EXPECT_EQ(combine(a, a, SolidOp::Union).faceCount(), 6u);
  EXPECT_TRUE(combine(a, a, SolidOp::Subtract).empty());
  EXPECT_EQ(combine(a, in, SolidOp::Union).faceCount(), 6u);
  EXPECT_EQ(combine(a, in, SolidOp::Subtract).faceCount(), 12u);
  EXPECT_NEAR(volume(combine(a, in, SolidOp::Subtract)), 7, 1e-12);
  EXPECT_EQ(combine(a, away, SolidOp::Union).faceCount(), 12u);
}

TEST(SolidBoolean, facesOnEachOtherStayApartByOperand) {
  // The tops lie in one plane and overlap.
  const Mesh a = boxAt({0, 0, 0}, {4, 2, 4}), b = boxAt({2, 1, 1}, {4, 1, 2});
  expectConsistent(a, b);
  const SolidResult r = combined(a, b, SolidOp::Union);
  EXPECT_NEAR(volume(r.mesh), 32 + 4, 1e-12);
  size_t shared = 0;
  for (const auto& others : r.faceOthers) shared += others.size();
  EXPECT_EQ(shared, 1u);
}

TEST(SolidBoolean, roundSolids) {
  const Mesh sphere = makeSphere(24, 12), box = boxAt({-0.3, -0.3, -0.3}, {2, 2, 2});
  expectConsistent(sphere, box);
  expectConsistent(makeCylinder(16), sphere);
  expectConsistent(sphere, transformed(sphere, {1, 1, 1}, turned({0.4, 0.1, 0}, 17)));
  expectConsistent(sphere, transformed(sphere, {1, 1, 1}, turned({}, 7.5)));
  expectConsistent(makeCone(32), makeCylinder(32));
}

TEST(SolidBoolean, boxesTurnedAtRandom) {
  for (uint64_t seed = 0; seed < 150; ++seed) {
    const auto r = [&](uint64_t k, double lo, double hi) {
      return randomIn(hashCombine(seed, k), lo, hi);
    };
    const Frame f = turned({r(1, -1, 1), r(2, -1, 1), r(3, -1, 1)}, r(4, 0, 360),
                           {r(5, -1, 1), r(6, -1, 1), r(7, -1, 1)});
    const Mesh a = makeBoxMesh({1, 1.5, 2}, false);
    const Mesh b = transformed(a, {r(8, 0.2, 2), r(9, 0.2, 2), r(10, 0.2, 2)}, f);
    expectConsistent(a, b);
    if (HasFailure()) FAIL() << seed;
  }
}

// Stacks on a lattice, all turned together: faces share planes but for the rounding.
TEST(SolidBoolean, coplanarStacksTurnedAtRandom) {
  for (uint64_t seed = 0; seed < 150; ++seed) {
    const auto pick = [&](uint64_t k, double n) {
      return std::floor(randomUnit(hashCombine(seed, k)) * n);
    };
    const Frame f = turned({pick(1, 9) * 0.1, 0.3, 0}, randomIn(hashCombine(seed, 2), 0, 360),
                           {pick(3, 5), 1 + pick(4, 3), pick(5, 5)});
    const auto stack = [&](uint64_t k) {
      const Mesh m = boxAt({pick(k, 4), pick(k + 1, 4), pick(k + 2, 4)},
                           {1 + pick(k + 3, 3), 1 + pick(k + 4, 3), 1 + pick(k + 5, 3)});
      return transformed(m, {1, 1, 1}, f);
    };
    expectConsistent(stack(10), stack(20));
    if (HasFailure()) FAIL() << seed;
  }
}

Mesh prismOf(const Ring& ring, double bottom, double top) {
  MeshBuilder b;
  const auto n = static_cast<uint32_t>(ring.size());
  for (const double y : {bottom, top}) {
    for (const Vec2 p : ring) b.addPosition(fromPlan(p, y));
  }
  std::vector<uint32_t> loop(n);
  for (uint32_t i = 0; i < n; ++i) loop[i] = n - 1 - i;
  b.addPolygon(loop);
  for (uint32_t i = 0; i < n; ++i) loop[i] = n + i;
  b.addPolygon(loop);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    b.addPolygon(std::vector<uint32_t>{i, j, n + j, n + i});
  }
  return b.take();
}

// A prism of a hostile polygon and a turned box through it.
TEST(SolidBoolean, prismsOfTheCorpus) {
  const auto cases = corpus::loadCorpus(23);
  if (cases.empty()) GTEST_SKIP() << "no corpus";
  for (size_t k = 0; k < cases.size(); ++k) {
    Box2 box;
    for (const Vec2 p : cases[k].ring) box.include(p);
    const double size = length(box.size());
    const Mesh a = prismOf(cases[k].ring, 0, size * 0.5);
    const auto r = [&](uint64_t n) { return randomUnit(hashCombine(k, n)); };
    const Frame f = turned(fromPlan(box.center(), size * 0.2 * r(1)), 360 * r(2), {r(3), 1, r(4)});
    const Mesh b = transformed(makeBoxMesh(Vec3{0.4, 0.3, 0.2} * size, false), {1, 1, 1}, f);
    expectConsistent(a, b, 1e-7);
    if (HasFailure()) FAIL() << "case " << 23 * k << " of family " << cases[k].family;
  }
}

// Prisms of two hostile polygons on one ground, of the same height: tops and bottoms overlap.
TEST(SolidBoolean, prismsOfTheCorpusOnEachOther) {
  const auto cases = corpus::loadCorpus(61);
  if (cases.empty()) GTEST_SKIP() << "no corpus";
  for (size_t k = 0; k + 1 < cases.size(); ++k) {
    const auto unit = [](const Ring& ring) {
      Box2 box;
      for (const Vec2 p : ring) box.include(p);
      Ring out;
      for (const Vec2 p : ring) out.push_back((p - box.min) * (1 / length(box.size())));
      return out;
    };
    expectConsistent(prismOf(unit(cases[k].ring), 0, 0.5), prismOf(unit(cases[k + 1].ring), 0, 0.5),
                     1e-6);
    if (HasFailure()) FAIL() << "case " << 61 * k;
  }
}

// Whether a point is inside, by the parity of a ray, for convex faces.
bool isInside(const Mesh& m, const Vec3& p) {
  const Vec3 d{0.3571, 0.7391, 0.5712};
  bool inside = false;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const auto c = m.cornersOf(m.loopsOf(f)[0]);
    const Vec3 n = m.normal(f);
    const double t = dot(n, m.positions[c[0]] - p) / dot(n, d);
    if (!(t > 0)) continue;
    bool hit = true;
    for (size_t i = 0; i < c.size(); ++i) {
      const Vec3 a = m.positions[c[i]], b = m.positions[c[(i + 1) % c.size()]];
      hit = hit && dot(cross(b - a, p + d * t - a), n) > 0;
    }
    if (hit) inside = !inside;
  }
  return inside;
}

// Winding number of a mesh with concave faces and holes, by triangles from a point.
double windingOf(const Mesh& m, const Vec3& p) {
  double sum = 0;
  for (const MeshLoop& loop : m.loops) {
    const auto c = m.cornersOf(loop);
    for (size_t i = 1; i + 1 < c.size(); ++i) {
      const Vec3 a = m.positions[c[0]] - p, b = m.positions[c[i]] - p,
                 d = m.positions[c[i + 1]] - p;
      const double la = length(a), lb = length(b), ld = length(d);
      sum += 2 * atan2Deg(dot(a, cross(b, d)),
                          la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
    }
  }
  return sum / 720;
}

TEST(SolidBoolean, pointsAreInsideWhatTheyShouldBe) {
  const Mesh a = makeSphere(20, 10);
  const Mesh b = transformed(makeBoxMesh({1.1, 1.3, 1.7}, false), {1, 1, 1},
                             turned({-0.2, -0.4, 0.1}, 33, {1, 2, 3}));
  const Mesh both = combine(a, b, SolidOp::Union), common = combine(a, b, SolidOp::Intersect);
  const Mesh left = combine(a, b, SolidOp::Subtract);
  for (uint64_t k = 0; k < 500; ++k) {
    const auto r = [&](uint64_t n) { return randomIn(hashCombine(k, n), -1.5, 1.5); };
    const Vec3 p{r(1), r(2), r(3)};
    const bool inA = isInside(a, p), inB = isInside(b, p);
    ASSERT_NEAR(windingOf(both, p), inA || inB ? 1 : 0, 1e-6) << k;
    ASSERT_NEAR(windingOf(common, p), inA && inB ? 1 : 0, 1e-6) << k;
    ASSERT_NEAR(windingOf(left, p), inA && !inB ? 1 : 0, 1e-6) << k;
  }
}

Mesh plateAt(double y, double size, bool down) {
  Mesh m = transformed(makeQuadMesh(size, size, QuadPlane::Xz, true), {1, 1, 1},
                       turned({-size / 2, y, -size / 2}, 0));
  if (down) reverseFace(m, 0);
  return m;
}

// What is behind an open operand counts as inside of it.
TEST(SolidBoolean, aPlaneThroughASolidIsAHalfSpace) {
  const Mesh solid = boxAt({-1, -1, -1}, {2, 2, 2});
  for (const bool down : {false, true}) {
    // The upper side of the plane is free unless it looks down.
    const double above = down ? 1.5 : 0.5;
    const Mesh plate = plateAt(0.5, 6, down);
    const Mesh left = combine(solid, plate, SolidOp::Subtract);
    EXPECT_TRUE(encloses(left));
    EXPECT_NEAR(volume(left), 8 - 4 * (down ? 0.5 : 1.5), 1e-12);
    const Mesh common = combine(solid, plate, SolidOp::Intersect);
    EXPECT_TRUE(encloses(common));
    EXPECT_NEAR(volume(common), 8 - 4 * above, 1e-12);
    // The plane without its middle, and the half of the box that stands out of it.
    const Mesh both = combine(solid, plate, SolidOp::Union);
    EXPECT_NEAR(both.area(), 36 - 4 + 4 + 4 * 2 * (down ? 1.5 : 0.5), 1e-12);
    EXPECT_NEAR(combine(plate, solid, SolidOp::Subtract).area(),
                36 - 4 + 4 + 4 * 2 * (down ? 0.5 : 1.5), 1e-12);
  }
}

TEST(SolidBoolean, aPlaneThatEndsWithinASolidEnclosesNothing) {
  const Mesh solid = boxAt({-1, -1, -1}, {2, 2, 2});
  const Mesh plate = transformed(plateAt(0, 2, false), {1, 1, 1}, turned({1, 0.5, 0}, 0));
  EXPECT_NEAR(combine(solid, plate, SolidOp::Union).area(), 24 + 2, 1e-12);
  EXPECT_NEAR(combine(solid, plate, SolidOp::Subtract).area(), 24 + 2, 1e-12);
  EXPECT_NEAR(combine(plate, solid, SolidOp::Subtract).area(), 2, 1e-12);
  EXPECT_NEAR(combine(solid, plate, SolidOp::Intersect).area(), 2, 1e-12);
  EXPECT_NEAR(combine(solid, plateAt(0.5, 6, false), SolidOp::Unify).area(), 24 + 32, 1e-12);
}

Mesh withoutFace(const Mesh& m, size_t face) {
  MeshBuilder b;
  std::vector<uint32_t> map(m.positions.size(), MeshBuilder::kNoPosition);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    if (f != face) b.copyFace(m, f, map);
  }
  return b.take();
}

// A box without its right side: open where it is free, and open where it is in the other.
TEST(SolidBoolean, aBoxWithoutAFace) {
  const Mesh a = boxAt({0, 0, 0}, {2, 2, 2});
  const Mesh freeSide = withoutFace(boxAt({1, 1, 1}, {2, 2, 2}), 3);
  EXPECT_NEAR(combine(a, freeSide, SolidOp::Union).area(), 42 - 4, 1e-12);
  const Mesh heldSide = withoutFace(boxAt({-1, 1, 1}, {2, 2, 2}), 3);
  EXPECT_NEAR(combine(a, heldSide, SolidOp::Union).area(), 24 + 20 - 2, 1e-12);
  // Standing on the other like a house without a floor: the ground under it is not seen.
  const Mesh house = withoutFace(boxAt({0.5, 2, 0.5}, {1, 1, 1}), 0);
  const Mesh both = combine(a, house, SolidOp::Union);
  EXPECT_TRUE(encloses(both));
  EXPECT_NEAR(volume(both), 9, 1e-12);
}

TEST(SolidBoolean, platesInOnePlaneAreRegions) {
  const Mesh a = plateAt(0, 4, false);
  for (const bool down : {false, true}) {
    Mesh b = transformed(plateAt(0, 4, down), {1, 1, 1}, turned({2, 0, 2}, 0));
    const SolidResult both = combined(a, b, SolidOp::Union);
    EXPECT_NEAR(both.mesh.area(), 28, 1e-12);
    EXPECT_EQ(both.mesh.faceCount(), 3u);
    EXPECT_NEAR(combine(a, b, SolidOp::Intersect).area(), 4, 1e-12);
    const Mesh left = combine(a, b, SolidOp::Subtract);
    EXPECT_NEAR(left.area(), 12, 1e-12);
    EXPECT_EQ(left.corners.size(), 6u);
  }
  const Mesh in = plateAt(0, 2, false);
  EXPECT_NEAR(combine(a, in, SolidOp::Subtract).area(), 12, 1e-12);
  EXPECT_EQ(holeCount(combine(a, in, SolidOp::Subtract)), 1u);
  EXPECT_EQ(combine(a, in, SolidOp::Union).faceCount(), 2u);
}

TEST(SolidBoolean, attributesComeFromTheSourceFace) {
  Mesh a = boxAt({0, 0, 0}, {4, 2, 4}), b = boxAt({1, 1, 1}, {2, 5, 2});
  for (MeshFace& f : a.faces) f.materialSlot = 1;
  for (MeshFace& f : b.faces) f.tags = 7;
  a.edgeTags.assign(a.corners.size(), 3);
  b.edgeTags.assign(b.corners.size(), 4);
  const SolidResult r = combined(a, b, SolidOp::Subtract);
  const Mesh& m = r.mesh;
  ASSERT_TRUE(m.hasUv(0));
  size_t ofB = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const bool fromB = r.faceSource[f] >= a.faceCount();
    ofB += fromB ? 1 : 0;
    EXPECT_EQ(m.faces[f].tags, fromB ? 7u : 0u);
    EXPECT_EQ(m.faces[f].materialSlot, fromB ? 0 : 1);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t c = loop.firstCorner; c < loop.firstCorner + loop.cornerCount; ++c) {
        const Vec3 p = m.at(c);
        const bool cutEdge = r.edgeSource[c] == SolidResult::kNone;
        EXPECT_EQ(m.edgeTags[c], cutEdge ? 0u : fromB ? 4u : 3u);
        // The top of the large box: u and v run with x and -z.
        if (!fromB && m.normal(f).y > 0.9) {
          EXPECT_NEAR(m.uvs[0][c].x, p.x / 4, 1e-12);
          EXPECT_NEAR(m.uvs[0][c].y, 1 - p.z / 4, 1e-12);
        }
        // The sides of the hole: v runs with y.
        if (fromB && std::fabs(m.normal(f).y) < 0.1) {
          EXPECT_NEAR(m.uvs[0][c].y, (p.y - 1) / 5, 1e-12);
        }
      }
    }
  }
  EXPECT_EQ(ofB, 5u);
}

TEST(SolidBoolean, manyBoxesBecomeOneSolid) {
  Mesh all;
  std::vector<uint32_t> operand;
  for (uint32_t k = 0; k < 18; ++k) {
    // Steps of a spiral stair.
    append(all, transformed(makeBoxMesh({0.4, 0.3, 1}, true), {1, 1, 1},
                            turned({0, 0.18 * k, 0}, 20.0 * k)));
    operand.insert(operand.end(), 6, k);
  }
  const auto r = solidBoolean(all, operand, SolidOp::Unify);
  ASSERT_TRUE(r);
  EXPECT_TRUE(encloses(r->mesh));
  EXPECT_LT(volume(r->mesh), 18 * 0.12);
  EXPECT_GT(volume(r->mesh), 9 * 0.12);
}

TEST(SolidBoolean, garbageGivesValidMeshesOrNothing) {
  for (uint64_t seed = 0; seed < 500; ++seed) {
    const Mesh a = garbage(2 * seed, false), b = garbage(2 * seed + 1, false);
    Mesh both = a;
    append(both, b);
    std::vector<uint32_t> operand(both.faceCount(), 1);
    std::fill_n(operand.begin(), a.faceCount(), 0);
    for (const SolidOp op :
         {SolidOp::Union, SolidOp::Subtract, SolidOp::Intersect, SolidOp::Unify}) {
      const auto r = solidBoolean(both, operand, op);
      ASSERT_TRUE(!r || r->mesh.valid()) << seed;
    }
  }
}

TEST(SolidBoolean, withoutExtentThereIsNothing) {
  EXPECT_FALSE(
      solidBoolean(boxAt({0, 0, 0}, {0, 0, 0}), std::vector<uint32_t>(6, 0), SolidOp::Unify));
  EXPECT_TRUE(solidBoolean(Mesh{}, {}, SolidOp::Union)->mesh.empty());
  EXPECT_FALSE(
      solidBoolean(boxAt({0, 0, 0}, {1e200, 1, 1}), std::vector<uint32_t>(6, 0), SolidOp::Unify));
}

}  // namespace
}  // namespace gable
