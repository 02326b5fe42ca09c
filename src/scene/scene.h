// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Scene: what a derivation made. It outlives its rules: names are text, places are file and line.
//
// A prototype is a list of leaves and of instances of other prototypes, in its own frame; a root is
// the placed prototype of one initial shape. Nothing in the scene refers to itself, so flattening
// terminates: an instance's prototype has a smaller index than the prototype that holds it.
// The order of a prototype's content is the order of derivation: `Instance::leavesBefore` says
// where between the leaves an instance stands.
//
// World placement is composed from the outside in, one product an instance level:
// world(leaf) = root * instance * ... * leaf.frame, evaluated from the left. A point m of the
// leaf's mesh lies at world(leaf).point(scaled(m, leaf.scale)).
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/work.h"
#include "geom/mesh/mesh.h"
#include "material/material.h"
#include "math/box.h"
#include "math/frame.h"

namespace gable {

/// Meshes 0 to kFirstMesh - 1 are the unit primitives, which writers may treat specially.
enum PrimitiveMesh : uint32_t {
  kUnitBox = 0,
  /// With uv set 0 on each face.
  kUnitBoxUv = 1,
  /// [0,1] x [0,1] in xy, normal +z.
  kUnitQuadXy = 2,
  kUnitQuadXyUv = 3,
  /// The same in xz, normal +y.
  kUnitQuadXz = 4,
  kUnitQuadXzUv = 5,
  kFirstMesh = 6,
};

struct Leaf {
  Frame frame;
  /// May mirror (negative); flat meshes may have a zero component.
  Vec3 scale{1, 1, 1};
  uint32_t mesh = kUnitBox;
  /// Index into Scene::materialLists: the materials of the mesh's slots.
  uint32_t materials = 0;
  /// Index into Scene::names: the leaf's symbol.
  uint32_t name = 0;
  /// Index into Scene::sources: the rule and line that made it.
  uint32_t source = 0;
  /// Index into Scene::attributeSets, 0 for none.
  uint32_t attributes = 0;
};

struct Instance {
  Frame frame;
  uint32_t prototype = 0;
  uint32_t leavesBefore = 0;
};

struct Prototype {
  uint32_t name = 0;
  /// Ranges of Scene::leaves and Scene::instances.
  uint32_t firstLeaf = 0, leafCount = 0;
  uint32_t firstInstance = 0, instanceCount = 0;
  /// Shapes made while deriving it, instances expanded, dropped ones included.
  uint64_t shapes = 0;
  /// True where neither it nor its instances have a leaf. Shared rules that make nothing may stand
  /// for more instances than can be walked through.
  bool empty = false;
};

struct Root {
  /// Index into Scene::names: the initial shape's name.
  uint32_t name = 0;
  Instance instance;
};

struct SourcePlace {
  std::string file;
  uint32_t line = 0;
  uint32_t column = 0;
  /// The rule with its module, as the author wrote it.
  std::string rule;
};

/// A value in a report, an attribute or a print, free of any pool.
struct PlainValue {
  enum class Kind : uint8_t { Number, Bool, Text } kind = Kind::Number;
  double number = 0;
  std::string text;
};

struct Report {
  std::string key;
  PlainValue value;
};

struct AttributeValue {
  std::string name;
  /// Arrays have one element an entry; single values have one entry and no brackets.
  std::vector<PlainValue> values;
  uint32_t rows = 0, columns = 0;
};

/// Where local metres lie on the Earth; absent for local input.
struct GeoOrigin {
  bool present = false;
  double longitude = 0, latitude = 0;
};

struct Scene {
  std::vector<Root> roots;
  std::vector<Prototype> prototypes;
  std::vector<Leaf> leaves;
  std::vector<Instance> instances;
  /// The first kFirstMesh entries are the unit primitives (Scene() fills them in).
  std::vector<MeshRef> meshes;
  std::vector<Material> materials;
  /// Each list gives a material index a mesh slot; a mesh with more slots than entries uses the
  /// first for the rest.
  std::vector<std::vector<uint32_t>> materialLists;
  std::vector<std::string> names;
  std::vector<SourcePlace> sources;
  /// What leaves have as attributes, each value of each attribute once; a set lists places in it.
  std::vector<AttributeValue> attributeValues;
  std::vector<std::vector<uint32_t>> attributeSets;
  /// In path order, instances expanded.
  std::vector<Report> reports;
  std::vector<std::string> prints;
  GeoOrigin geoOrigin;
  /// Around the initial shapes, in the world; empty where nobody knows. Rules may add land about
  /// it.
  Box3 place;

  Scene();
};

/// A prototype on the way from a root to a leaf.
struct WalkLevel {
  const Prototype* prototype = nullptr;
  Frame world;
  /// Those that come next.
  uint32_t instance = 0, leaf = 0;
};

/// Goes through a prototype placed at `world` in path order, on a stack of its own: instances nest
/// as deep as rules do. Calls `visit(leaf, world, level)` with the index of each leaf and the frame
/// of its prototype, and `enter(instance, world, level)` before an instance that is not empty,
/// which it goes into where that is true. The level counts from 0 for the prototype itself.
/// Instances of instances can stand for more than anyone can wait for: it calls work().
template <class Visit, class Enter>
void walk(const Scene& scene, const Prototype& prototype, const Frame& world, Visit&& visit,
          Enter&& enter);

/// Calls `visit(leaf, world)` for every leaf in path order, instances expanded.
template <class Visit>
void forEachLeaf(const Scene& scene, Visit&& visit);
/// The same for one prototype placed at `world`.
template <class Visit>
void forEachLeaf(const Scene& scene, const Prototype& prototype, const Frame& world, Visit&& visit);

/// Counts with instances expanded, as `--stats` reports them (DESIGN, the command line).
struct SceneCounts {
  uint64_t shapes = 0, leaves = 0, faces = 0, vertices = 0, triangles = 0;
  uint64_t instances = 0, prototypes = 0, materials = 0;
  /// Faces as CityEngine's encoders count them: polygons, but faces with holes as triangles.
  uint64_t encoderFaces = 0;
  Box3 bounds;
};
SceneCounts count(const Scene& scene);

// ---------------------------------------------------------------------------------------------

template <class Visit, class Enter>
void walk(const Scene& scene, const Prototype& prototype, const Frame& world, Visit&& visit,
          Enter&& enter) {
  std::vector<WalkLevel> levels{{&prototype, world}};
  while (!levels.empty()) {
    WalkLevel& at = levels.back();
    const Prototype& p = *at.prototype;
    const Instance* next =
        at.instance < p.instanceCount ? &scene.instances[p.firstInstance + at.instance++] : nullptr;
    for (const uint32_t end = next ? next->leavesBefore : p.leafCount; at.leaf < end; ++at.leaf) {
      work();
      visit(p.firstLeaf + at.leaf, at.world, levels.size() - 1);
    }
    work();
    if (!next) {
      levels.pop_back();
    } else if (scene.prototypes[next->prototype].empty) {
      continue;
    } else if (const Frame inner = at.world * next->frame; enter(*next, inner, levels.size())) {
      levels.push_back({&scene.prototypes[next->prototype], inner});
    }
  }
}

template <class Visit>
void forEachLeaf(const Scene& scene, const Prototype& prototype, const Frame& world,
                 Visit&& visit) {
  const auto leafOf = [&](uint32_t leaf, const Frame& at, size_t) {
    const Leaf& l = scene.leaves[leaf];
    visit(l, at * l.frame);
  };
  walk(scene, prototype, world, leafOf, [](const Instance&, const Frame&, size_t) { return true; });
}

template <class Visit>
void forEachLeaf(const Scene& scene, Visit&& visit) {
  for (const Root& root : scene.roots) {
    forEachLeaf(scene, scene.prototypes[root.instance.prototype], root.instance.frame, visit);
  }
}

}  // namespace gable
