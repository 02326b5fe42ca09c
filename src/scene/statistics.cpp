// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Counts of a scene, instances expanded, in time linear in what is stored: a prototype counts as
// often as it stands, which is known of its users before (they have larger indices).
//
// Bounds cannot be summed so: a turned box around a box is too large. They are taken from the
// points of expanded leaves, as every writer places them, but a prototype or a leaf whose own box,
// placed, lies within the bounds found so far is passed over: it cannot change them. That keeps the
// result exact and independent of sharing, while repeated content costs one test.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/flatten.h"
#include "scene/scene.h"

namespace gable {
namespace {

struct Tally {
  uint64_t leaves = 0, faces = 0, vertices = 0, triangles = 0, encoderFaces = 0;
  void add(const Tally& t) {
    leaves = saturatingAdd(leaves, t.leaves);
    faces = saturatingAdd(faces, t.faces);
    vertices = saturatingAdd(vertices, t.vertices);
    triangles = saturatingAdd(triangles, t.triangles);
    encoderFaces = saturatingAdd(encoderFaces, t.encoderFaces);
  }
  Tally times(uint64_t n) const {
    return {saturatingMultiply(leaves, n), saturatingMultiply(faces, n),
            saturatingMultiply(vertices, n), saturatingMultiply(triangles, n),
            saturatingMultiply(encoderFaces, n)};
  }
};

Tally tallyOf(const Mesh& m) {
  Tally t{1, m.faces.size(), m.positions.size(), 0, 0};
  for (size_t f = 0; f < m.faces.size(); ++f) {
    // A polygon of n corners in all and h holes has n + 2h - 2 triangles.
    uint64_t corners = 0;
    for (const MeshLoop& loop : m.loopsOf(f)) corners += loop.cornerCount;
    const uint64_t holes = m.faces[f].loopCount > 0 ? m.faces[f].loopCount - 1 : 0;
    const uint64_t triangles = corners >= 3 ? corners + 2 * holes - 2 : 0;
    t.triangles += triangles;
    t.encoderFaces += holes > 0 ? triangles : 1;
  }
  return t;
}

// Around the corners of the box, as they are placed.
Box3 placed(const Box3& box, const Vec3& scale, const Frame& frame) {
  if (box.empty()) return box;
  const Vec3 middle = frame.point(scaled((box.min + box.max) * 0.5, scale));
  const Vec3 half = scaled((box.max - box.min) * 0.5, scale);
  const auto along = [&](double Vec3::*axis) {
    return std::fabs(frame.x.*axis * half.x) + std::fabs(frame.y.*axis * half.y) +
           std::fabs(frame.z.*axis * half.z);
  };
  const Vec3 reach{along(&Vec3::x), along(&Vec3::y), along(&Vec3::z)};
  return {middle - reach, middle + reach};
}

// Larger by more than the rounding of one placement, also of a part of what lies in the box.
Box3 widened(Box3 b) {
  if (b.empty()) return b;
  const Vec3 most{std::max(std::fabs(b.min.x), std::fabs(b.max.x)),
                  std::max(std::fabs(b.min.y), std::fabs(b.max.y)),
                  std::max(std::fabs(b.min.z), std::fabs(b.max.z))};
  const double d = 1e-14 * (most.x + most.y + most.z);
  b.min = b.min - Vec3{d, d, d};
  b.max = b.max + Vec3{d, d, d};
  return b;
}

bool within(const Box3& inner, const Box3& outer) {
  return inner.empty() ||
         (inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
          inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z);
}

/// Around a prototype in its own frame, with room for rounding. There are as many as prototypes, so
/// it is half as large as a Box3.
struct RoughBox {
  std::array<float, 3> min, max;

  explicit RoughBox(const Box3& b)
      : min{below(b.min.x), below(b.min.y), below(b.min.z)},
        max{above(b.max.x), above(b.max.y), above(b.max.z)} {}
  Box3 box() const { return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}}; }

 private:
  static float below(double d) {
    const auto f = static_cast<float>(d);
    return f > d ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
  }
  static float above(double d) { return -below(-d); }
};

/// What is known of meshes and prototypes.
struct Parts {
  std::vector<Tally> tallies;
  std::vector<Box3> meshes;
  std::vector<RoughBox> prototypes;
};

/// How often each prototype stands in the scene.
std::vector<uint64_t> usesOf(const Scene& scene) {
  std::vector<uint64_t> uses(scene.prototypes.size());
  const auto use = [&](uint32_t prototype, uint64_t times) {
    uses[prototype] = saturatingAdd(uses[prototype], times);
  };
  for (const Root& r : scene.roots) use(r.instance.prototype, 1);
  for (size_t p = scene.prototypes.size(); p-- > 0;) {
    const Prototype& user = scene.prototypes[p];
    for (uint32_t i = 0; i < user.instanceCount; ++i) {
      use(scene.instances[user.firstInstance + i].prototype, uses[p]);
    }
  }
  return uses;
}

/// Leaves and instances are most of a scene, so they are gone through once for both.
Tally measure(const Scene& scene, const Prototype& p, Parts& known) {
  Tally own;
  Box3 box;
  for (uint32_t i = 0; i < p.leafCount; ++i) {
    const Leaf& l = scene.leaves[p.firstLeaf + i];
    own.add(known.tallies[l.mesh]);
    box.include(placed(known.meshes[l.mesh], l.scale, l.frame));
  }
  for (uint32_t i = 0; i < p.instanceCount; ++i) {
    const Instance& in = scene.instances[p.firstInstance + i];
    box.include(placed(known.prototypes[in.prototype].box(), {1, 1, 1}, in.frame));
  }
  known.prototypes.emplace_back(widened(box));
  return own;
}

/// The counts of all; `parts` becomes known.
Tally measure(const Scene& scene, Parts& parts) {
  for (const MeshRef& m : scene.meshes) {
    parts.tallies.push_back(tallyOf(*m));
    parts.meshes.push_back(m->bounds());
  }
  parts.prototypes.reserve(scene.prototypes.size());
  const std::vector<uint64_t> uses = usesOf(scene);
  Tally all;
  for (size_t p = 0; p < scene.prototypes.size(); ++p) {
    all.add(measure(scene, scene.prototypes[p], parts).times(uses[p]));
  }
  return all;
}

class Bounds {
 public:
  Bounds(const Scene& scene, const Parts& parts) : scene_(scene), parts_(parts) {}

  Box3 take() {
    for (const Root& r : scene_.roots) grow(r.instance.prototype, r.instance.frame);
    return found_;
  }

 private:
  void grow(uint32_t prototype, const Frame& world) {
    const auto leaf = [&](uint32_t l, const Frame& around, size_t) {
      grow(scene_.leaves[l], around);
    };
    const auto enter = [&](const Instance& in, const Frame& at, size_t) {
      return couldGrow(in.prototype, at);
    };
    if (couldGrow(prototype, world)) walk(scene_, scene_.prototypes[prototype], world, leaf, enter);
  }

  bool couldGrow(uint32_t prototype, const Frame& world) {
    const Box3 box = widened(placed(parts_.prototypes[prototype].box(), {1, 1, 1}, world));
    if (within(box, found_)) return false;
    if (visits_++ < kMaxVisits) return true;
    found_.include(box);
    return false;
  }

  void grow(const Leaf& leaf, const Frame& around) {
    const Frame world = around * leaf.frame;
    if (within(widened(placed(parts_.meshes[leaf.mesh], leaf.scale, world)), found_)) return;
    for (const Vec3& p : scene_.meshes[leaf.mesh]->positions) {
      found_.include(world.point(scaled(p, leaf.scale)));
    }
  }

  // More placed prototypes than any writer could write: beyond, boxes are taken whole, so that a
  // small scene that stands for 2^70 leaves is measured at all.
  static constexpr uint64_t kMaxVisits = 20'000'000;

  const Scene& scene_;
  const Parts& parts_;
  uint64_t visits_ = 0;
  Box3 found_;
};

}  // namespace

SceneCounts count(const Scene& scene) {
  Parts parts;
  const Tally all = measure(scene, parts);
  SceneCounts counts;
  for (const Root& r : scene.roots) {
    counts.shapes = saturatingAdd(counts.shapes, scene.prototypes[r.instance.prototype].shapes);
  }
  counts.leaves = all.leaves;
  counts.faces = all.faces;
  counts.vertices = all.vertices;
  counts.triangles = all.triangles;
  counts.encoderFaces = all.encoderFaces;
  counts.instances = scene.instances.size();
  counts.prototypes = scene.prototypes.size();
  counts.materials = scene.materials.size();
  counts.bounds = Bounds(scene, parts).take();
  return counts;
}

}  // namespace gable
