// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each leaf's mesh is brought into the world and written as it comes.

#include "scene/dump.h"

#include <cstdio>

#include "base/work.h"

namespace gable {

namespace {

std::string pointText(const Vec3& p) {
  return roundedText(p.x) + " " + roundedText(p.y) + " " + roundedText(p.z);
}

void dumpFace(const Mesh& mesh, size_t face, std::string& out) {
  out += "  ";
  bool firstLoop = true;
  for (const MeshLoop& loop : mesh.loopsOf(face)) {
    out += firstLoop ? "" : " | ";
    firstLoop = false;
    bool firstCorner = true;
    for (uint32_t position : mesh.cornersOf(loop)) {
      out += firstCorner ? "" : "  ";
      firstCorner = false;
      out += pointText(mesh.positions[position]);
    }
  }
  out += '\n';
}

void dumpLeaf(const Scene& scene, const Leaf& leaf, const Frame& world, std::string& out) {
  const Mesh& unit = *scene.meshes[leaf.mesh];
  const Box3 own = unit.bounds();
  out += scene.names[leaf.name] + " at " + pointText(world.origin);
  if (world.turned) out += " turn " + pointText(anglesXyz(world));
  out += " size " + pointText(scaled(own.size(), leaf.scale));
  if (leaf.materials < scene.materialLists.size() && !scene.materialLists[leaf.materials].empty()) {
    const Material& material = scene.materials[scene.materialLists[leaf.materials].front()];
    if (material.color != Vec3{1, 1, 1}) out += " color " + colorText(material.color);
    if (!material.map(TextureLayer::Color).path.empty()) {
      out += " map " + material.map(TextureLayer::Color).path;
    }
  }
  out += '\n';
  const Mesh placed = transformed(unit, leaf.scale, world);
  work(3 * placed.corners.size());
  for (size_t face = 0; face < placed.faceCount(); ++face) dumpFace(placed, face, out);
}

}  // namespace

std::string roundedText(double v) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f", v);
  std::string result = text;
  if (result.find('.') != std::string::npos) {
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
  }
  return result == "-0" ? "0" : result;
}

std::string dumpText(const Scene& scene) {
  std::string out;
  forEachLeaf(scene,
              [&](const Leaf& leaf, const Frame& world) { dumpLeaf(scene, leaf, world, out); });
  return out;
}

}  // namespace gable
