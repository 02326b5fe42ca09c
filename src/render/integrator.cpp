// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A path tracer in the manner of Kajiya: at each hit the sun is asked directly, then one direction
// is followed, and a ray that leaves the scene brings the sky's light. The sun's disc is only ever
// found by asking, so nothing counts twice. Paths are cut short where they carry little (Russian
// roulette); the last surface gets a share of the sky in place of what it would have gathered.

#include "render/integrator.h"

#include <array>
#include <mutex>

#include "base/parallel.h"
#include "math/trig.h"
#include "render/sampler.h"
#include "render/viewpoint.h"

namespace gable::rt {

namespace {

/// Dimensions of the sampler: the pixel, then a block a bounce.
constexpr uint32_t kPixelDimension = 0, kFirstBlock = 1, kBlock = 5;
enum BlockPart : uint32_t { kOpacity, kSun, kDirection, kPick, kRoulette };

/// Straight passages through clear things a path may make.
constexpr int kMostPassages = 24;
/// A light sample may exceed sunlit white by this factor before it counts as a firefly.
constexpr float kClamp = 4;
/// Share of the open sky's light that stands for the bounces that are not traced.
constexpr float kUntracedShare = 0.4f;
/// Coats smoother than this show a picture of their surroundings, which must not be smoothed.
constexpr float kMirror = 0.35f;
constexpr uint32_t kTile = 16;
/// Paling of far ground by squared metres: 63 % after a kilometre.
constexpr float kGroundFade = 1e-6f;

/// A smooth random value in [-1, 1] over the plane, with features of about one unit.
float smoothNoise(float x, float z, uint32_t seed) {
  const float fx = std::floor(x), fz = std::floor(z);
  const auto corner = [&](int i, int j) {
    const uint32_t cx = static_cast<uint32_t>(static_cast<int64_t>(fx) + i);
    const uint32_t cz = static_cast<uint32_t>(static_cast<int64_t>(fz) + j);
    return static_cast<float>(mix32(cx + mix32(cz + seed)) >> 8) * 0x1p-23f - 1;
  };
  const float tx = x - fx, tz = z - fz;
  const float sx = tx * tx * (3 - 2 * tx), sz = tz * tz * (3 - 2 * tz);
  return (corner(0, 0) * (1 - sx) + corner(1, 0) * sx) * (1 - sz) +
         (corner(0, 1) * (1 - sx) + corner(1, 1) * sx) * sz;
}

/// Soil is nowhere of one tone: a few percent over metres, finer ones near the camera only.
float groundTone(const Vec3f& p, float distance) {
  float tone = 1 + 0.05f * smoothNoise(p.x / 19, p.z / 19, 1);
  const float fine = 60 / (60 + distance);
  tone += fine * 0.04f * smoothNoise(p.x / 2.3f, p.z / 2.3f, 2);
  tone += fine * fine * 0.05f * smoothNoise(p.x / 0.31f, p.z / 0.31f, 3);
  return tone;
}

bool intersect(const Stage& stage, const Ray& ray, bool ordered, Surface& surface,
               float& distance) {
  Hit hit;
  const bool found =
      ordered ? stage.tracer.intersectOrdered(ray, hit) : stage.tracer.intersect(ray, hit);
  if (stage.ground && ray.direction.y < 0) {
    const float t = (stage.groundHeight - ray.origin.y) / ray.direction.y;
    // What lies on the ground, within 3 mm, wins over it.
    const float lead = 0.003f / -ray.direction.y;
    if (t > ray.from && t < ray.to && (!found || t + lead < hit.distance)) {
      surface = Surface();
      surface.point = ray.origin + ray.direction * t;
      surface.point.y = stage.groundHeight;
      surface.facet = surface.normal = {0, 1, 0};
      surface.base = stage.light.groundAlbedo * groundTone(surface.point, distance);
      surface.isGround = true;
      distance = t;
      return true;
    }
  }
  if (!found) return false;
  distance = hit.distance;
  surface = surfaceAt(stage.world, hit, ray);
  return true;
}

/// A start that does not meet its own surface again; grows with the coordinates' rounding.
Vec3f offset(const Vec3f& point, const Vec3f& facet, const Vec3f& direction) {
  const float most = std::max(std::abs(point.x), std::max(std::abs(point.y), std::abs(point.z)));
  const float by = 2e-4f + 1e-6f * most;
  return point + facet * (dot(facet, direction) < 0 ? -by : by);
}

Vec3f withoutFireflies(const Vec3f& c, float limit) {
  const float l = luminance(c);
  return l > limit ? c * (limit / l) : c;
}

Vec3f sunlight(const Stage& stage, const Surface& surface, const Lobes& lobes, const Vec3f& view,
               Vec2f u, uint32_t& rays) {
  if (maxOf(stage.light.sun) <= 0) return {};
  const Vec3f towards = stage.light.towardsSun(u);
  const Vec3f value = evaluate(surface, lobes, view, towards);
  if (maxOf(value) <= 0) return {};
  Ray shadow;
  shadow.origin = offset(surface.point, surface.facet, towards);
  shadow.direction = towards;
  ++rays;
  return value * stage.light.sun * stage.tracer.visibility(shadow);
}

}  // namespace

PathResult tracePath(const Stage& stage, Ray ray, uint32_t x, uint32_t y, uint32_t sample,
                     uint32_t seed) {
  const Light& light = stage.light;
  const Sampler sampler(x, y, sample, seed);
  PathResult result;
  Vec3f carried{1, 1, 1};
  // Until a rough surface is met, light belongs to the part that is not smoothed.
  bool sharp = true;
  bool mirrored = false;
  int passages = 0;
  float travelled = 0;
  const float limit = kClamp / light.exposure;

  for (uint32_t depth = 0;; ++depth) {
    const uint32_t block = kFirstBlock + kBlock * depth;
    Surface surface;
    float distance = 0;
    ++result.rays;
    if (!intersect(stage, ray, sharp, surface, distance)) {
      const Vec3f sky = sharp ? light.shownSky(ray.direction) : light.sky(ray.direction);
      Vec3f& to = sharp ? result.direct : result.indirect;
      to += withoutFireflies(carried * sky, limit * 4);
      break;
    }
    if (sharp && stage.haze > 0) {
      const float far = surface.isGround ? std::max(0.0f, distance - stage.nearGround) : 0;
      const float clear = std::exp(-distance * stage.haze - far * far * kGroundFade);
      result.direct += carried * light.horizon() * (1 - clear);
      carried *= clear;
    }
    if (!mirrored && sharp) travelled += distance;

    const Vec3f view = -ray.direction;
    const Lobes lobes = lobesOf(surface, view);
    if (surface.opacity < 1) {
      // A smooth pane mirrors fully however clear it is.
      const float mirror = surface.roughness < kMirror ? luminance(lobes.coat) : 0;
      const float pass = (1 - surface.opacity) * (1 - mirror);
      if (sampler.number(block + kOpacity + 7919u * static_cast<uint32_t>(passages)) < pass) {
        if (++passages > kMostPassages) break;
        ray.origin = offset(surface.point, surface.facet, ray.direction);
        --depth;
        continue;
      }
    }

    if (maxOf(surface.emissive) > 0) {
      // An emissive 1 shows a little under white in sunlight.
      Vec3f& to = sharp ? result.direct : result.indirect;
      to += carried * surface.emissive * (0.9f / light.exposure);
    }
    if (sharp && !mirrored) {
      result.albedo = lobes.diffuse + lobes.through + lobes.coat;
      result.normal = surface.normal;
      result.distance = travelled;
    }
    const Vec3f direct =
        sunlight(stage, surface, lobes, view, sampler.point(block + kSun), result.rays);
    (mirrored && sharp ? result.direct
     : sharp           ? result.sun
             : result.indirect) += withoutFireflies(carried * direct, sharp ? limit * 4 : limit);

    if (depth >= stage.bounces) {
      const Vec3f rest = lobes.diffuse * light.skyIrradiance * (kUntracedShare / kPif);
      (sharp ? result.direct : result.indirect) += carried * rest;
      break;
    }
    const Scatter next = scatter(surface, lobes, view, sampler.number(block + kPick),
                                 sampler.point(block + kDirection));
    if (maxOf(next.weight) <= 0) break;
    carried *= next.weight;
    if (next.coat && surface.roughness < kMirror) {
      mirrored = true;
    } else {
      sharp = false;
    }
    if (depth >= 1) {
      const float stay = std::clamp(maxOf(carried) * 1.5f, 0.08f, 1.0f);
      if (sampler.number(block + kRoulette) >= stay) break;
      carried *= 1 / stay;
    }
    ray = Ray();
    ray.origin = offset(surface.point, surface.facet, next.direction);
    ray.direction = next.direction;
  }
  for (Vec3f* part : {&result.direct, &result.sun, &result.indirect}) {
    if (!isFinite(*part)) *part = {};
  }
  return result;
}

namespace {

/// Offsets from the pixel's centre with the density of the Blackman-Harris window, 1.5 pixels to
/// each side: averaging such samples is filtering with that window.
class PixelFilter {
 public:
  PixelFilter() {
    double sum = 0;
    for (size_t i = 0; i < kSteps; ++i) {
      const double t = 360.0 * (static_cast<double>(i) + 0.5) / kSteps;
      sum += 0.35875 - 0.48829 * cosDeg(t) + 0.14128 * cosDeg(2 * t) - 0.01168 * cosDeg(3 * t);
      cumulative_[i + 1] = static_cast<float>(sum);
    }
    for (float& c : cumulative_) c /= static_cast<float>(sum);
  }

  float offset(float u) const {
    const auto at = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
    const size_t i = static_cast<size_t>(at - cumulative_.begin()) - 1;
    const float step = std::max(1e-9f, cumulative_[i + 1] - cumulative_[i]);
    const float t = (static_cast<float>(i) + std::clamp((u - cumulative_[i]) / step, 0.0f, 1.0f));
    return 1.5f * (2 * t / kSteps - 1);
  }

 private:
  static constexpr size_t kSteps = 256;
  std::array<float, kSteps + 1> cumulative_{};
};

/// Adds up a layer's samples.
struct LayerSum {
  Vec3f light;
  float sum = 0, squares = 0;

  void add(const Vec3f& sample, const Vec3f& albedo) {
    light += sample;
    const float l = luminance(sample) / std::max(0.02f, luminance(albedo));
    sum += l;
    squares += l * l;
  }
  /// `share` is one over the number of samples.
  void store(FilmLayer& layer, size_t i, float share) const {
    layer.light[i] = light * share;
    const float mean = sum * share, spread = squares * share - mean * mean;
    // With one sample nothing is known of the spread; assume it as large as the light.
    layer.variance[i] = share < 1 ? std::max(0.0f, spread) * share / (1 - share) : mean * mean;
  }
};

struct PixelTask {
  const Stage& stage;
  const Camera& camera;
  const RenderOptions& options;
  const PixelFilter& filter;
  Film& film;

  uint64_t run(uint32_t x, uint32_t y) const {
    const double width = options.width, height = options.height, aspect = width / height;
    const uint32_t n = std::max(1u, options.samples);
    Vec3f direct, albedo, normal;
    LayerSum sun, indirect;
    float distance = 0, distances = 0, hits = 0;
    uint64_t rays = 0;
    for (uint32_t s = 0; s < n; ++s) {
      const Vec2f u = Sampler(x, y, s, options.seed).point(kPixelDimension);
      const double px = x + 0.5 + static_cast<double>(filter.offset(u.x));
      const double py = y + 0.5 + static_cast<double>(filter.offset(u.y));
      const Ray ray = cameraRay(camera, aspect, px / width, 1 - py / height);
      const PathResult path = tracePath(stage, ray, x, y, s, options.seed);
      direct += path.direct;
      sun.add(path.sun, path.albedo);
      indirect.add(path.indirect, path.albedo);
      albedo += path.albedo;
      normal += path.normal;
      distance += path.distance;
      distances += path.distance * path.distance;
      hits += path.distance > 0 ? 1.0f : 0.0f;
      rays += path.rays;
    }
    const float k = 1 / static_cast<float>(n);
    const size_t i = static_cast<size_t>(y) * options.width + x;
    film.direct[i] = direct * k;
    sun.store(film.sun, i, k);
    indirect.store(film.indirect, i, k);
    film.albedo[i] = albedo * k;
    if (hits > 0) {
      film.normal[i] = normal * (1 / hits);
      film.distance[i] = distance / hits;
      film.spread[i] =
          std::sqrt(std::max(0.0f, distances / hits - film.distance[i] * film.distance[i]));
    }
    return rays;
  }
};

}  // namespace

bool tracePicture(const Stage& stage, const Camera& camera, const RenderOptions& options,
                  Film& film, uint64_t& rays) {
  film.width = options.width;
  film.height = options.height;
  const size_t pixels = static_cast<size_t>(options.width) * options.height;
  for (std::vector<Vec3f>* v :
       {&film.direct, &film.sun.light, &film.indirect.light, &film.albedo, &film.normal}) {
    v->assign(pixels, {});
  }
  for (std::vector<float>* v :
       {&film.distance, &film.spread, &film.sun.variance, &film.indirect.variance}) {
    v->assign(pixels, 0);
  }

  const PixelFilter filter;
  const PixelTask task{stage, camera, options, filter, film};
  const uint32_t across = (options.width + kTile - 1) / kTile;
  const uint32_t down = (options.height + kTile - 1) / kTile;
  const size_t tiles = static_cast<size_t>(across) * down;
  std::atomic<uint64_t> allRays = 0;
  std::atomic<bool> ended = false;
  std::mutex reporting;
  size_t done = 0;
  parallelFor(tiles, options.threads, [&](size_t tile, unsigned) {
    if (ended.load(std::memory_order_relaxed)) return;
    const uint32_t x0 = static_cast<uint32_t>(tile % across) * kTile;
    const uint32_t y0 = static_cast<uint32_t>(tile / across) * kTile;
    uint64_t count = 0;
    for (uint32_t y = y0; y < std::min(y0 + kTile, options.height); ++y) {
      for (uint32_t x = x0; x < std::min(x0 + kTile, options.width); ++x) count += task.run(x, y);
    }
    allRays += count;
    const std::lock_guard lock(reporting);
    ++done;
    if (options.progress &&
        !options.progress(static_cast<double>(done) / static_cast<double>(tiles))) {
      ended = true;
    }
  });
  rays += allRays;
  return !ended;
}

}  // namespace gable::rt
