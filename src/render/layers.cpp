// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/layers.h"

#include "base/parallel.h"
#include "render/viewpoint.h"

namespace gable::rt {

namespace {

constexpr int kMostPassages = 64;

/// The leaf and the root that a piece is of, as its number among all says.
void identify(const World& world, const Scene& scene, uint32_t number, Glimpse& g) {
  const auto after =
      std::upper_bound(world.placements.begin(), world.placements.end(), number,
                       [](uint32_t n, const Placement& p) { return n < p.firstPiece; });
  const Placement* const placement = after == world.placements.begin() ? nullptr : &*(after - 1);
  const Part& part = world.parts[placement ? placement->part : 0];
  const Piece& piece = part.pieces[number - (placement ? placement->firstPiece : 0)];
  g.instance = number + 1;
  g.object = (placement ? placement->root : piece.root) + 1;
  g.source = scene.leaves[piece.leaf].source + 1;
}

}  // namespace

Glimpse glimpse(const Stage& stage, const Scene& scene, const Camera& camera, const Ray& start) {
  Glimpse g;
  Ray ray = start;
  for (int passages = 0; passages < kMostPassages; ++passages) {
    Surface s;
    float distance = 0;
    if (!meet(stage, ray, true, s, distance)) return g;
    if (s.opacity < 0.5f) {
      ray.origin = offsetFrom(s.point, s.facet, ray.direction);
      continue;
    }
    g.point = ray.origin + ray.direction * distance;
    g.depth = dot(g.point - toVec3f(camera.eye), toVec3f(camera.forward));
    g.normal = s.normal;
    // What shines looks bright whatever it would reflect.
    g.albedo = mix(s.base, {1, 1, 1}, std::min(1.0f, maxOf(s.emissive)));
    g.isGround = s.isGround;
    g.isCut = s.isCut;
    g.isPane = s.pane;
    g.matter = s.matter;
    if (s.piece != kNone) {
      identify(stage.world, scene, s.piece, g);
      g.material = stage.world.materials[s.material].source + 1;
    }
    return g;
  }
  return g;
}

RawLayers traceLayers(const Stage& stage, const Scene& scene, const Camera& camera,
                      const RenderOptions& options) {
  const size_t pixels = static_cast<size_t>(options.width) * options.height;
  RawLayers layers;
  layers.depth.resize(pixels);
  layers.normals.resize(3 * pixels);
  layers.albedo.resize(3 * pixels);
  for (std::vector<uint32_t>* ids :
       {&layers.objects, &layers.instances, &layers.sources, &layers.materials}) {
    ids->resize(pixels);
  }
  const double width = options.width, height = options.height;
  parallelFor(options.height, options.threads, [&](size_t y, unsigned) {
    for (uint32_t x = 0; x < options.width; ++x) {
      const Ray ray = cameraRay(camera, width / height, (x + 0.5) / width,
                                1 - (static_cast<double>(y) + 0.5) / height);
      const Glimpse g = glimpse(stage, scene, camera, ray);
      const size_t i = y * options.width + x;
      layers.depth[i] = g.depth;
      const float normal[3] = {g.normal.x, g.normal.y, g.normal.z};
      const float albedo[3] = {g.albedo.x, g.albedo.y, g.albedo.z};
      for (size_t k = 0; k < 3; ++k) {
        layers.normals[3 * i + k] = normal[k];
        layers.albedo[3 * i + k] = albedo[k];
      }
      layers.objects[i] = g.object;
      layers.instances[i] = g.instance;
      layers.sources[i] = g.source;
      layers.materials[i] = g.material;
    }
  });
  return layers;
}

}  // namespace gable::rt
