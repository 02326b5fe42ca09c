// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/layers.h"

#include "base/parallel_work.h"
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

constexpr float kLookedThrough = 0.5f;

/// What there is to say of a surface at a point.
Glimpse glimpseOf(const Stage& stage, const Scene& scene, const Camera& camera, const Surface& s,
                  const Vec3f& point) {
  Glimpse g;
  g.point = point;
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

/// Glimpses of pixels that lie side by side.
void glimpseTogether(const Stage& stage, const Scene& scene, const Camera& camera,
                     std::span<const Ray> rays, Glimpse* glimpses) {
  Surface surfaces[Tracer::kMostTogether];
  float distances[Tracer::kMostTogether] = {};
  const uint32_t met = meetTogether(stage, rays, surfaces, distances);
  for (size_t i = 0; i < rays.size(); ++i) {
    const Vec3f point = rays[i].origin + rays[i].direction * distances[i];
    if (!(met >> i & 1))
      glimpses[i] = Glimpse();
    else if (surfaces[i].opacity < kLookedThrough)
      glimpses[i] = glimpse(stage, scene, camera, rays[i]);
    else
      glimpses[i] = glimpseOf(stage, scene, camera, surfaces[i], point);
  }
}

/// Puts a glimpse into the place of a pixel.
void store(const Glimpse& g, size_t i, RawLayers& layers) {
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

}  // namespace

Glimpse glimpse(const Stage& stage, const Scene& scene, const Camera& camera, const Ray& start) {
  Ray ray = start;
  for (int passages = 0; passages < kMostPassages; ++passages) {
    Surface s;
    float distance = 0;
    if (!meet(stage, ray, true, s, distance)) break;
    if (s.opacity < kLookedThrough) {
      ray.origin = offsetFrom(s.point, s.facet, ray.direction);
      continue;
    }
    return glimpseOf(stage, scene, camera, s, ray.origin + ray.direction * distance);
  }
  return {};
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
  constexpr uint32_t kMost = Tracer::kMostTogether;
  const double width = options.width, height = options.height;
  parallelWork(options.height, options.threads, [&](size_t y, unsigned) {
    work(kWorkBetweenLooks);
    for (uint32_t x = 0; x < options.width; x += kMost) {
      const uint32_t count = std::min(kMost, options.width - x);
      Ray rays[kMost];
      for (uint32_t k = 0; k < count; ++k) {
        rays[k] = cameraRay(camera, width / height, (x + k + 0.5) / width,
                            1 - (static_cast<double>(y) + 0.5) / height);
      }
      Glimpse glimpses[kMost];
      glimpseTogether(stage, scene, camera, {rays, count}, glimpses);
      for (uint32_t k = 0; k < count; ++k) store(glimpses[k], y * options.width + x + k, layers);
    }
  });
  return layers;
}

}  // namespace gable::rt
