// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Scenes made in code for the tests of pictures: single shapes, and a street of houses with
// everything a picture has to cope with (reveals, roofs, trees, glass, placed prototypes).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "math/trig.h"
#include "render/render.h"
#include "scene/scene.h"

namespace gable {

/// Collects a prototype's content and puts it into a scene.
struct SceneMaker {
  Scene scene;
  std::vector<Leaf> leaves;
  std::vector<Instance> instances;

  SceneMaker() {
    scene.names.push_back("test");
    scene.attributeSets.emplace_back();
    scene.sources.emplace_back();
  }

  /// A list with one material; gives the list's index.
  uint32_t material(const Material& m) {
    scene.materials.push_back(m);
    scene.materialLists.push_back({static_cast<uint32_t>(scene.materials.size() - 1)});
    return static_cast<uint32_t>(scene.materialLists.size() - 1);
  }
  uint32_t material(const std::string& hex, double roughness = 1, double metallic = 0) {
    Material m;
    parseColor(hex, m.color, m.opacity);
    m.roughness = roughness;
    m.metallic = metallic;
    return material(m);
  }
  void box(const Vec3& min, const Vec3& size, uint32_t materials) {
    Leaf leaf;
    leaf.frame = Frame::moved(min);
    leaf.scale = size;
    leaf.materials = materials;
    leaves.push_back(leaf);
  }
  void mesh(Mesh m, uint32_t materials, const Frame& at = {}, const Vec3& scale = {1, 1, 1}) {
    Leaf leaf;
    leaf.frame = at;
    leaf.scale = scale;
    leaf.mesh = static_cast<uint32_t>(scene.meshes.size());
    leaf.materials = materials;
    scene.meshes.push_back(makeRef<Mesh>(std::move(m)));
    leaves.push_back(leaf);
  }
  void place(uint32_t prototype, const Frame& at) {
    instances.push_back({at, prototype, static_cast<uint32_t>(leaves.size())});
  }
  /// Closes the prototype that was being filled.
  uint32_t prototype() {
    Prototype p;
    p.firstLeaf = static_cast<uint32_t>(scene.leaves.size());
    p.leafCount = static_cast<uint32_t>(leaves.size());
    p.firstInstance = static_cast<uint32_t>(scene.instances.size());
    p.instanceCount = static_cast<uint32_t>(instances.size());
    scene.leaves.insert(scene.leaves.end(), leaves.begin(), leaves.end());
    scene.instances.insert(scene.instances.end(), instances.begin(), instances.end());
    leaves.clear();
    instances.clear();
    scene.prototypes.push_back(p);
    return static_cast<uint32_t>(scene.prototypes.size() - 1);
  }
  /// Closes the prototype and makes it a root.
  Scene& finish() {
    Root root;
    root.instance.prototype = prototype();
    scene.roots.push_back(root);
    return scene;
  }
};

/// For pictures that are measured, not looked at.
inline RenderOptions smallOptions(uint32_t width = 64, uint32_t height = 36, uint32_t samples = 4) {
  RenderOptions o;
  o.width = width;
  o.height = height;
  o.samples = samples;
  return o;
}

/// A ball of radius 1 about the origin with smooth faces.
Mesh ballMesh(int rings = 24);

/// Two rows of town houses on a street with pavements, trees and lamps: about 1e5 triangles.
Scene streetScene();

}  // namespace gable
