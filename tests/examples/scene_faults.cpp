// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "scene_faults.h"

#include <cmath>

namespace gable {

namespace {

// A face smaller than this is a sliver that nobody meant: a tenth of a square millimetre.
constexpr double kLeastArea = 1e-7;

}  // namespace

std::set<std::string> faults(const Scene& scene) {
  std::set<std::string> found;
  for (const Leaf& leaf : scene.leaves) {
    const std::string& name = scene.names[leaf.name];
    const Mesh placed = transformed(*scene.meshes[leaf.mesh], leaf.scale, leaf.frame);
    for (const Vec3& p : placed.positions) {
      if (!isFinite(p)) found.insert(name + ": a coordinate is not finite");
    }
    for (size_t face = 0; face < placed.faceCount(); ++face) {
      if (!(placed.area(face) > kLeastArea)) found.insert(name + ": a face without area");
    }
  }
  return found;
}

std::string joined(const std::set<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

}  // namespace gable
