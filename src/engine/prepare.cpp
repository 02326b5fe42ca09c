// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Preparing a model as an asset: the pivot becomes the origin, the declared volume the unit cube.
// What reaches beyond the volume stays, and reaches beyond the cube.

#include <cmath>

#include "engine/impl.h"
#include "geom/mesh/mesh.h"

namespace gable {

namespace {

// One leaf in its own frame, as Model::load makes it.
bool readFromFile(const Scene& scene) {
  return scene.leaves.size() == 1 && scene.instances.empty() &&
         scene.leaves[0].mesh < scene.meshes.size();
}

Vec3 vec(const Triple& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::shared_ptr<const Model::Impl> preparedOf(const Model::Impl& from,
                                              const PrepareSettings& settings) {
  auto impl = std::make_shared<Model::Impl>(from);
  Scene& scene = impl->result.scene;
  const auto fail = [&](const char* text, const char* hint) {
    impl->diagnostics.push_back(diagnosticOf(Error{"asset-volume", text, hint}));
    return impl;
  };
  if (hasErrors(impl->diagnostics)) return impl;
  if (!readFromFile(scene)) {
    return fail("only a model that was read from a file can be prepared", "load one first");
  }
  Mesh mesh = *scene.meshes[scene.leaves[0].mesh];
  if (settings.zUp) mesh = transformed(mesh, {1, 1, 1}, rotationXyz(-90, 0, 0));
  const Box3 own = mesh.bounds();
  const Vec3 pivot = settings.pivot ? vec(*settings.pivot) : own.min;
  Frame turn = rotationXyz(settings.rotate[0], settings.rotate[1], settings.rotate[2]);
  turn.origin = -turn.direction(pivot);
  mesh = transformed(mesh, {1, 1, 1}, turn);
  Vec3 volume;
  if (settings.volume) {
    volume = vec(*settings.volume);
  } else {
    // All that lies on the positive side of the pivot; a flat model keeps a metre.
    volume = mesh.bounds().max;
    for (size_t i = 0; i < 3; ++i) {
      if (!(std::fabs(volume[i]) > 1e-9)) volume[i] = 1;
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    if (volume[i] > 0 && std::isfinite(volume[i]) && std::isfinite(pivot[i])) continue;
    return fail("the volume of an asset has three sizes above zero",
                "give it with --size 4,7,1; it begins at the pivot and extends to +x, +y and +z");
  }
  scene.meshes[scene.leaves[0].mesh] =
      makeRef<Mesh>(transformed(mesh, {1 / volume.x, 1 / volume.y, 1 / volume.z}, Frame{}));
  if (settings.name) scene.names[0] = *settings.name;
  impl->makeSound();
  return impl;
}

std::optional<BoundingBox> Model::bounds() const {
  Box3 box;
  const Scene& scene = impl_->scene();
  if (readFromFile(scene)) box = scene.meshes[scene.leaves[0].mesh]->bounds();
  if (box.empty()) return std::nullopt;
  return boundingBoxOf(box);
}

}  // namespace gable
