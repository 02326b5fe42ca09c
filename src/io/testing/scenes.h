// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Scenes for the tests of writers and readers.
#pragma once

#include <string>
#include <vector>

#include "base/random.h"
#include "io/image/image.h"
#include "scene/scene.h"

namespace gable::testing {

/// Builds scenes in the order in which a derivation does: what is shown first.
class SceneBuilder {
 public:
  SceneBuilder() {
    scene.names = {"leaf"};
    scene.sources = {{"rules.cga", 7, 1, "Facade"}};
    material({});
  }

  uint32_t name(const std::string& text) {
    scene.names.push_back(text);
    return static_cast<uint32_t>(scene.names.size() - 1);
  }
  /// A list of one material.
  uint32_t material(const Material& m) {
    scene.materials.push_back(m);
    scene.materialLists.push_back({static_cast<uint32_t>(scene.materials.size() - 1)});
    return static_cast<uint32_t>(scene.materialLists.size() - 1);
  }
  uint32_t mesh(Mesh m) {
    scene.meshes.push_back(makeRef<Mesh>(std::move(m)));
    return static_cast<uint32_t>(scene.meshes.size() - 1);
  }

  Leaf& leaf(uint32_t mesh, const Frame& frame, const Vec3& scale, uint32_t materials = 0) {
    Leaf l;
    l.mesh = mesh;
    l.frame = frame;
    l.scale = scale;
    l.materials = materials;
    openLeaves_.push_back(l);
    return openLeaves_.back();
  }
  void instance(uint32_t prototype, const Frame& frame) {
    openInstances_.push_back({frame, prototype, static_cast<uint32_t>(openLeaves_.size())});
  }
  /// Closes a prototype of what was added since the last.
  uint32_t prototype(const std::string& text) {
    Prototype p;
    p.name = name(text);
    p.firstLeaf = static_cast<uint32_t>(scene.leaves.size());
    p.leafCount = static_cast<uint32_t>(openLeaves_.size());
    p.firstInstance = static_cast<uint32_t>(scene.instances.size());
    p.instanceCount = static_cast<uint32_t>(openInstances_.size());
    p.shapes = p.leafCount;
    scene.leaves.insert(scene.leaves.end(), openLeaves_.begin(), openLeaves_.end());
    scene.instances.insert(scene.instances.end(), openInstances_.begin(), openInstances_.end());
    openLeaves_.clear();
    openInstances_.clear();
    scene.prototypes.push_back(p);
    return static_cast<uint32_t>(scene.prototypes.size() - 1);
  }
  void root(const std::string& text, uint32_t prototype, const Frame& frame) {
    scene.roots.push_back({name(text), {frame, prototype, 0}});
  }

  Scene scene;

 private:
  std::vector<Leaf> openLeaves_;
  std::vector<Instance> openInstances_;
};

inline Frame turned(double degrees, const Vec3& origin) {
  Frame f = rotationXyz(0, degrees, 0);
  f.origin = origin;
  return f;
}

inline Material colored(const std::string& name, const Vec3& color) {
  Material m;
  m.name = name;
  m.color = color;
  return m;
}

/// A slab with a hole right through its one face, uv set 0 included.
inline Mesh holedSquare() {
  MeshBuilder b;
  b.beginFace();
  for (const auto& ring : {std::vector<Vec2>{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                           std::vector<Vec2>{{3, 3}, {3, 6}, {6, 6}, {6, 3}}}) {
    b.beginLoop();
    for (const Vec2 p : ring) {
      const uint32_t c = b.addCorner(b.addPosition({p.x, 0, -p.y}));
      b.setUv(c, 0, {p.x / 10, p.y / 10});
    }
  }
  return b.take();
}

/// A ball of quads and triangles with shared positions, smooth: a large mesh.
inline Mesh ball(int rings, int sectors) {
  MeshBuilder b;
  const auto point = [&](int ring, int sector) {
    const Frame f = rotationXyz(0, 360.0 * sector / sectors, 180.0 * ring / rings);
    return f.point({0, 1, 0});
  };
  std::vector<uint32_t> ids;
  ids.push_back(b.addPosition(point(0, 0)));
  for (int r = 1; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      const Vec3 local = rotationXyz(0, 0, 180.0 * r / rings).point({0, 1, 0});
      ids.push_back(b.addPosition(rotationXyz(0, 360.0 * s / sectors, 0).point(local)));
    }
  }
  ids.push_back(b.addPosition({0, -1, 0}));
  const auto at = [&](int r, int s) {
    return r == 0       ? ids[0]
           : r == rings ? ids.back()
                        : ids[static_cast<size_t>(1 + (r - 1) * sectors + s % sectors)];
  };
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < sectors; ++s) {
      b.beginFace(0, 0, true);
      b.beginLoop();
      b.addCorner(at(r, s));
      b.addCorner(at(r + 1, s));
      if (r + 1 < rings) b.addCorner(at(r + 1, s + 1));
      if (r > 0) b.addCorner(at(r, s + 1));
    }
  }
  return b.take();
}

/// A small picture, alpha included where asked for.
inline std::string picture(uint32_t size, bool alpha, uint64_t seed = 1) {
  Image image;
  image.width = image.height = size;
  for (uint32_t i = 0; i < size * size; ++i) {
    const uint64_t bits = randomBits(hashCombine(seed, i));
    for (int c = 0; c < 4; ++c) image.rgba.push_back(static_cast<uint8_t>(bits >> (8 * c)));
  }
  return encodePng(image, alpha ? 4 : 3).value();
}

/// Houses of boxes with shared windows, some turned; trees of a large shared mesh; a yard with a
/// hole.
inline Scene street(int houses, bool withTrees = true) {
  SceneBuilder b;
  const uint32_t wall = b.material(colored("wall", {0.8, 0.7, 0.6}));
  const uint32_t glass = b.material(colored("glass", {0.3, 0.4, 0.5}));
  b.scene.materials.back().opacity = 0.5;
  const uint32_t tree = b.mesh(ball(24, 32));
  const uint32_t yard = b.mesh(holedSquare());
  b.leaf(kUnitBox, Frame{}, {1, 0.1, 0.2}, wall);
  b.leaf(kUnitBox, Frame::moved({0, 1.4, 0}), {1, 0.1, 0.2}, wall);
  b.leaf(kUnitBoxUv, Frame::moved({0, 0.1, 0.05}), {1, 1.3, 0.02}, glass).name = b.name("Glass");
  b.leaf(kUnitBox, Frame::moved({0, 0.1, 0}), {0.1, 1.3, 0.2}, wall);
  const uint32_t window = b.prototype("Window");
  for (int h = 0; h < houses; ++h) {
    b.leaf(kUnitBox, Frame{}, {10, 12.0 + h % 3, 8}, wall).name = b.name("Core");
    for (int i = 0; i < 12; ++i) {
      b.instance(window, Frame::moved({1 + i % 4 * 2.0, 1 + i / 4 * 3.0, 8}));
      b.instance(window, turned(90, {10, 1 + i / 4 * 3.0, 7 - i % 4 * 2.0}));
    }
    b.leaf(yard, Frame::moved({0, 0.01, 0}), {1.5, 1, 1.5}, wall);
    b.leaf(kUnitQuadXz, Frame::moved({0, 12.0 + h % 3, 0}), {10, 0, 8}, glass);
    for (int i = 0; withTrees && i < 3; ++i) {
      b.leaf(tree, turned(40.0 * i, {12.0 + i, 2, 4}), {1, 2.0 + 0.5 * i, i == 2 ? -1.0 : 1.0},
             wall);
    }
    const uint32_t p = b.prototype("House");
    b.root("house " + std::to_string(h), p, turned(15.0 * h, {25.0 * h, 0, 3.0 * h}));
  }
  return b.scene;
}

}  // namespace gable::testing
