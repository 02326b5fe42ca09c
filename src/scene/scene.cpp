// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "scene/scene.h"

namespace gable {

Scene::Scene() {
  meshes.push_back(makeRef<Mesh>(makeBoxMesh({1, 1, 1}, false)));
  meshes.push_back(makeRef<Mesh>(makeBoxMesh({1, 1, 1}, true)));
  for (QuadPlane plane : {QuadPlane::Xy, QuadPlane::Xz}) {
    meshes.push_back(makeRef<Mesh>(makeQuadMesh(1, 1, plane, false)));
    meshes.push_back(makeRef<Mesh>(makeQuadMesh(1, 1, plane, true)));
  }
}

}  // namespace gable
