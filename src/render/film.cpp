// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pixels are filtered by where their samples lie, so each belongs to one pixel and no thread waits
// for another. The smoothing leaves edges and shadows as they are; so pixels whose paths disagree
// about them get more paths, which end at the first surface.

#include "render/film.h"

#include <array>
#include <atomic>
#include <mutex>

#include "base/parallel.h"
#include "math/trig.h"
#include "render/integrator.h"
#include "render/sampler.h"
#include "render/viewpoint.h"

namespace gable::rt {

namespace {

/// Dimensions of the sampler that no path uses.
constexpr uint32_t kPixelDimension = 0, kLensDimension = 0x40000000;
constexpr uint32_t kTile = 16;
/// With Stage::ambient: whole paths of a pixel at most, and then brief ones up to all its samples.
constexpr uint32_t kMostWhole = 4;
/// Else: brief paths a whole one at most. And the error that nobody sees, on a scale from black to
/// white, and the one that few see. Even samples err about half as much as their spread says.
constexpr uint32_t kMostBrief = 2;
constexpr float kSeenError = 0.014f, kSeenErrorDirect = 0.02f;

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

/// A ray through a point of the lens, to what the ray through its middle shows sharp.
Ray throughLens(const Ray& middle, const Camera& camera, const Lens& lens, const Sampler& sampler) {
  const float ahead = dot(middle.direction, toVec3f(camera.forward));
  if (lens.radius <= 0 || !(ahead > 0)) return middle;
  const Vec2f d = onDisc(sampler.point(kLensDimension));
  const Vec3f sharp = middle.origin + middle.direction * (lens.focus / ahead);
  Ray ray = middle;
  ray.origin +=
      toVec3f(camera.right) * (d.x * lens.radius) + toVec3f(camera.up) * (d.y * lens.radius);
  ray.direction = normalized(sharp - ray.origin);
  return ray;
}

/// Adds up a pixel's paths.
struct PixelSum {
  Vec3f direct, albedo, normal;
  LayerSum sun, indirect;
  float distance = 0, distances = 0, hits = 0;
  /// Of what brief paths find, as luminance before the tone curve.
  float level = 0, levels = 0;
  uint64_t rays = 0;

  /// All but what is indirect.
  void add(const PathResult& path, float exposure) {
    direct += path.direct;
    sun.add(path.sun, path.albedo);
    albedo += path.albedo;
    normal += path.normal;
    distance += path.distance;
    distances += path.distance * path.distance;
    hits += path.distance > 0 ? 1.0f : 0.0f;
    const float l = std::min(4.0f, luminance(path.direct + path.sun) * exposure);
    level += l;
    levels += l * l;
    rays += path.rays;
  }

  /// Of `all` paths the first `whole` knew what is indirect, on surfaces of `wholeAlbedo` on
  /// average; it is carried over to the better known mean of all.
  void store(Film& film, size_t i, uint32_t whole, uint32_t all, const Vec3f& wholeAlbedo) const {
    const float k = 1 / static_cast<float>(all);
    film.direct[i] = direct * k;
    film.albedo[i] = albedo * k;
    sun.store(film.sun, i, k);
    indirect.store(film.indirect, i, 1 / static_cast<float>(whole));
    constexpr float kLeast = 0.02f;
    const auto ratio = [](float better, float known) {
      return std::clamp((better + kLeast) / (known + kLeast), 0.25f, 4.0f);
    };
    const Vec3f& better = film.albedo[i];
    film.indirect.light[i] *= Vec3f{ratio(better.x, wholeAlbedo.x), ratio(better.y, wholeAlbedo.y),
                                    ratio(better.z, wholeAlbedo.z)};
    if (hits > 0) {
      film.normal[i] = normal * (1 / hits);
      film.distance[i] = distance / hits;
      film.spread[i] =
          std::sqrt(std::max(0.0f, distances / hits - film.distance[i] * film.distance[i]));
    }
  }
};

struct Tile {
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Traces the pixels of a tile.
struct TileTask {
  const Stage& stage;
  const Camera& camera;
  const Lens& lens;
  const RenderOptions& options;
  const PixelFilter& filter;
  Film& film;

  /// The pixels of a tile in squares of 2 x 2, whose rays run side by side, and their sums.
  uint64_t run(const Tile& tile) const {
    const uint32_t samples = std::max(1u, options.samples);
    const uint32_t whole = stage.ambient ? std::min(samples, kMostWhole) : samples;
    const uint32_t most = stage.ambient ? samples - whole : kMostBrief * whole;
    std::vector<Pixel> pixels;
    for (uint32_t y = tile.y0; y < tile.y1; y += 2) {
      for (uint32_t x = tile.x0; x < tile.x1; x += 2) {
        for (uint32_t k = 0; k < 4; ++k) {
          const uint32_t px = x + (k & 1), py = y + (k >> 1);
          if (px < tile.x1 && py < tile.y1) pixels.push_back({px, py, whole, {}, {}});
        }
      }
    }
    trace(pixels, 0, false);
    for (Pixel& p : pixels) {
      p.albedo = p.sum.albedo * (1 / static_cast<float>(whole));
      p.all = whole + briefPaths(p.sum, whole, most);
    }
    trace(pixels, whole, true);
    uint64_t rays = 0;
    for (const Pixel& p : pixels) {
      p.sum.store(film, place(p.x, p.y), whole, p.all, p.albedo);
      rays += p.sum.rays;
    }
    return rays;
  }

 private:
  struct Pixel {
    uint32_t x = 0, y = 0, all = 0;
    PixelSum sum;
    /// Of whole paths.
    Vec3f albedo;
  };

  /// The samples of all pixels from number `first` on.
  void trace(std::vector<Pixel>& pixels, uint32_t first, bool brief) const {
    PathStart starts[Tracer::kMostTogether];
    Pixel* owners[Tracer::kMostTogether];
    PathResult results[Tracer::kMostTogether];
    size_t count = 0;
    const auto flush = [&] {
      traceTogether(stage, {starts, count}, options.seed, brief, results);
      for (size_t i = 0; i < count; ++i) {
        owners[i]->sum.add(results[i], stage.light.exposure);
        if (!brief) owners[i]->sum.indirect.add(results[i].indirect, results[i].albedo);
      }
      count = 0;
    };
    for (Pixel& p : pixels) {
      for (uint32_t s = first; s < p.all; ++s) {
        owners[count] = &p;
        starts[count++] = {ray(p.x, p.y, s), p.x, p.y, s};
        if (count == Tracer::kMostTogether) flush();
      }
    }
    if (count > 0) flush();
  }

  size_t place(uint32_t x, uint32_t y) const { return static_cast<size_t>(y) * options.width + x; }

  Ray ray(uint32_t x, uint32_t y, uint32_t s) const {
    const double width = options.width, height = options.height, aspect = width / height;
    const Sampler sampler(x, y, s, options.seed);
    const Vec2f u = sampler.point(kPixelDimension);
    const double px = x + 0.5 + static_cast<double>(filter.offset(u.x));
    const double py = y + 0.5 + static_cast<double>(filter.offset(u.y));
    const Ray middle = cameraRay(camera, aspect, px / width, 1 - py / height);
    return throughLens(middle, camera, lens, sampler);
  }

  /// How many brief paths bring a pixel's edges and shadows below what the eye tells apart.
  uint32_t briefPaths(const PixelSum& sum, uint32_t n, uint32_t most) const {
    if (!options.denoise) return stage.ambient ? most : 0;
    if (n < 2) return 0;
    const float k = 1 / static_cast<float>(n);
    const float mean = sum.level * k;
    const float variance = std::max(0.0f, sum.levels * k - mean * mean) * k;
    // On a scale of even steps for the eye, about the square root.
    const float error = std::sqrt(variance) / (2 * std::sqrt(mean + 0.02f));
    const float wanted = error / (stage.ambient ? kSeenErrorDirect : kSeenError);
    const float more = static_cast<float>(n) * (wanted * wanted - 1);
    return static_cast<uint32_t>(std::clamp(more, 0.0f, static_cast<float>(most)));
  }
};

}  // namespace

bool tracePicture(const Stage& stage, const Camera& camera, const Lens& lens,
                  const RenderOptions& options, Film& film, uint64_t& rays) {
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
  const TileTask task{stage, camera, lens, options, filter, film};
  const uint32_t across = (options.width + kTile - 1) / kTile;
  const uint32_t down = (options.height + kTile - 1) / kTile;
  const size_t tiles = static_cast<size_t>(across) * down;
  std::atomic<uint64_t> allRays = 0;
  std::atomic<bool> ended = false;
  std::mutex reporting;
  size_t done = 0;
  parallelFor(tiles, options.threads, [&](size_t tile, unsigned) {
    if (ended.load(std::memory_order_relaxed)) return;
    Tile t;
    t.x0 = static_cast<uint32_t>(tile % across) * kTile;
    t.y0 = static_cast<uint32_t>(tile / across) * kTile;
    t.x1 = std::min(t.x0 + kTile, options.width);
    t.y1 = std::min(t.y0 + kTile, options.height);
    allRays += task.run(t);
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
