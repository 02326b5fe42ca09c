// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A sample counts in the pixel that it lies in and, by the window of the filter, in those beside
// it: a pixel has the light of more than twice the samples that were drawn for it. The smoothing
// leaves edges and shadows as they are; so pixels whose paths disagree about them get more paths,
// which end at the first surface.

#include "render/film.h"

#include <array>
#include <atomic>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "base/parallel_work.h"
#include "base/work.h"
#include "math/trig.h"
#include "render/integrator.h"
#include "render/reporting.h"
#include "render/sampler.h"
#include "render/viewpoint.h"

namespace gable::rt {

namespace {

/// Dimensions of the sampler that no path uses.
constexpr uint32_t kPixelDimension = 0, kLensDimension = 0x40000000;
constexpr uint32_t kTile = 16;
/// Pixels are traced in blocks of so many a side, and told apart by squares of 2 x 2.
constexpr uint32_t kBlock = 4, kSquares = kBlock * kBlock / 4;
/// With Stage::ambient: whole paths of a pixel at most, and then brief ones up to all its samples;
/// and how many there are where all of a square, or of a block, see one open plane in the same
/// light.
constexpr uint32_t kMostWhole = 4, kPlainWhole = 2, kPlainestWhole = 1;
/// How much alike their light and colour are, as a share, and their normals, as a cosine.
constexpr float kAlikeLight = 0.1f, kAlikeNormal = 0.999f;
/// Else: brief paths a whole one at most. And the errors that are aimed at, on a scale from black
/// to white, by a pixel's own samples. Even samples, shared with neighbours, err a third as much:
/// the first is seen by nobody, the second by few.
constexpr uint32_t kMostBrief = 2;
constexpr float kSeenError = 0.014f, kSeenErrorDirect = 0.045f;

/// The Blackman-Harris window, 1.5 pixels to each side: what a sample weighs in its pixel and in
/// the two neighbours along one axis.
class PixelFilter {
 public:
  using Weights = std::array<float, 3>;

  PixelFilter() {
    for (size_t i = 0; i < kSteps; ++i) {
      const double at = (static_cast<double>(i) + 0.5) / kSteps - 0.5;
      for (int k = -1; k <= 1; ++k) {
        weights_[i][static_cast<size_t>(k + 1)] = static_cast<float>(window(at - k));
      }
    }
  }

  /// `u` from 0 to 1 across the pixel.
  const Weights& weights(float u) const {
    return weights_[std::min(kSteps - 1, static_cast<size_t>(u * kSteps))];
  }

 private:
  static constexpr size_t kSteps = 256;

  /// By the distance from a pixel's centre, below 1.5.
  static double window(double away) {
    const double t = away * 120;
    return 0.35875 + 0.48829 * cosDeg(t) + 0.14128 * cosDeg(2 * t) + 0.01168 * cosDeg(3 * t);
  }

  std::array<Weights, kSteps> weights_{};
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

/// What samples add to a pixel that they lie in or beside: numbers in a row, so that compilers make
/// vectors of the sums.
struct Mix {
  enum Part : size_t { kWeight, kDirect, kSun = 4, kAlbedo = 7, kNormal = 10, kDistance = 13 };
  /// Of whole paths alone.
  enum WholePart : size_t { kWholeWeight = 16, kIndirect = 17, kWholeAlbedo = 20 };
  static constexpr size_t kBriefParts = 16, kParts = 24;
  using Numbers = std::array<float, kParts>;

  Numbers sums{};

  /// The numbers of a sample; normal and distance by how bright its surface is.
  static Numbers of(const PathResult& path, float tone) {
    Numbers n{};
    n[kWeight] = n[kWholeWeight] = 1;
    put(n, kDirect, path.direct);
    put(n, kSun, path.sun);
    put(n, kAlbedo, path.albedo);
    put(n, kNormal, path.normal * tone);
    n[kDistance] = path.distance * tone;
    put(n, kIndirect, path.indirect);
    put(n, kWholeAlbedo, path.albedo);
    return n;
  }
  template <size_t kCount>
  void add(const Numbers& sample, float weight) {
    for (size_t k = 0; k < kCount; ++k) sums[k] += sample[k] * weight;
  }
  void put(size_t part, const Vec3f& v) { put(sums, part, v); }
  Vec3f at(size_t part) const { return {sums[part], sums[part + 1], sums[part + 2]}; }

 private:
  static void put(Numbers& n, size_t part, const Vec3f& v) {
    n[part] = v.x;
    n[part + 1] = v.y;
    n[part + 2] = v.z;
  }
};

/// Of the mean of so many samples, by their sum and that of their squares.
float varianceOf(float sum, float squares, uint32_t n) {
  const float share = 1 / static_cast<float>(n), mean = sum * share;
  // With one sample nothing is known of the spread; assume it as large as the light.
  if (n < 2) return mean * mean;
  return std::max(0.0f, squares * share - mean * mean) / static_cast<float>(n - 1);
}

/// The paths of a pixel: what they add to it and its neighbours, row by row, and how far they
/// disagree.
struct PixelSum {
  std::array<Mix, 9> mixes;
  /// Of what brief paths find, as luminance before the tone curve.
  float level = 0, levels = 0;
  /// Of indirect light over albedo; the variance of its mean where it is known otherwise.
  float indirect = 0, indirects = 0;
  std::optional<float> variance;
  uint64_t rays = 0;

  void add(const PathResult& path, const PixelFilter::Weights& across,
           const PixelFilter::Weights& down, bool brief, float exposure) {
    const float tone = luminance(path.albedo);
    const Mix::Numbers sample = Mix::of(path, tone);
    for (size_t j = 0; j < 3; ++j) {
      for (size_t i = 0; i < 3; ++i) {
        Mix& mix = mixes[3 * j + i];
        const float w = across[i] * down[j];
        if (brief)
          mix.add<Mix::kBriefParts>(sample, w);
        else
          mix.add<Mix::kParts>(sample, w);
      }
    }
    if (!brief) note(luminance(path.indirect) / std::max(kLeastTone, tone), indirect, indirects);
    note(std::min(4.0f, luminance(path.direct + path.sun) * exposure), level, levels);
    rays += path.rays;
  }

 private:
  static constexpr float kLeastTone = 0.02f;

  static void note(float value, float& sum, float& squares) {
    sum += value;
    squares += value * value;
  }
};

struct Tile {
  uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// What samples have added to the pixels of a film, and how far those of each disagree.
class FilmSums {
 public:
  FilmSums(const Film& film, unsigned threads)
      : rows_(film.height), variance_(static_cast<size_t>(film.width) * film.height) {
    parallelWork(film.height, threads, [&](size_t y, unsigned) {
      work(kWorkBetweenLooks + 1);
      rows_[y].resize(film.width);
    });
  }

  /// `share` for what all paths know, `wholeShare` for what whole ones do.
  void add(uint32_t x, uint32_t y, const Mix& m, float share, float wholeShare) {
    Mix::Numbers& sums = rows_[y][x].sums;
    for (size_t k = 0; k < Mix::kBriefParts; ++k) sums[k] += m.sums[k] * share;
    for (size_t k = Mix::kBriefParts; k < Mix::kParts; ++k) sums[k] += m.sums[k] * wholeShare;
  }
  void setVariance(size_t i, float variance) { variance_[i] = variance; }

  /// Fills the film with the means.
  void finish(Film& film, unsigned threads) {
    for (std::vector<Vec3f>* v :
         {&film.direct, &film.sun, &film.albedo, &film.normal, &film.irradiance}) {
      work(kWorkBetweenLooks + 1);
      v->resize(variance_.size());
    }
    film.distance.resize(variance_.size());
    parallelWork(film.height, threads, [&](size_t y, unsigned) {
      work(kWorkBetweenLooks);
      for (size_t x = 0; x < film.width; ++x) setMeans(rows_[y][x], y * film.width + x, film);
    });
    film.variance = std::move(variance_);
  }

 private:
  static void setMeans(const Mix& m, size_t i, Film& film) {
    const float weight = m.sums[Mix::kWeight], share = weight > 0 ? 1 / weight : 0.0f;
    film.direct[i] = m.at(Mix::kDirect) * share;
    film.sun[i] = m.at(Mix::kSun) * share;
    film.albedo[i] = m.at(Mix::kAlbedo) * share;
    const float tone = luminance(m.at(Mix::kAlbedo)), byTone = tone > 0 ? 1 / tone : 0.0f;
    film.normal[i] = m.at(Mix::kNormal) * byTone;
    film.distance[i] = m.sums[Mix::kDistance] * byTone;
    const float wholeWeight = m.sums[Mix::kWholeWeight];
    const float whole = wholeWeight > 0 ? 1 / wholeWeight : 0.0f;
    const Vec3f divisor = albedoDivisor(m.at(Mix::kWholeAlbedo) * whole);
    const Vec3f light = m.at(Mix::kIndirect) * whole;
    film.irradiance[i] = {light.x / divisor.x, light.y / divisor.y, light.z / divisor.z};
  }

  /// Small enough each to be had again from one picture to the next.
  std::vector<std::vector<Mix>> rows_;
  std::vector<float> variance_;
};

/// Whether all paths that are noted see one plane under the open sky in the same light, or nothing
/// but the sky.
class Alike {
 public:
  void note(const PathResult& path) {
    if (!any_) first_ = path;
    any_ = true;
    const bool hit = path.distance > 0;
    all_ = all_ && hit == (first_.distance > 0) &&
           isNear(luminance(path.direct + path.sun), luminance(first_.direct + first_.sun));
    if (!all_ || !hit) return;
    all_ = path.open >= 1 && dot(path.normal, first_.normal) > kAlikeNormal &&
           isNear(luminance(path.albedo), luminance(first_.albedo));
  }
  bool all() const { return all_; }

 private:
  static bool isNear(float a, float b) { return std::abs(a - b) <= kAlikeLight * std::max(a, b); }

  PathResult first_;
  bool any_ = false, all_ = true;
};

/// A pixel whose paths are being traced.
struct Pixel {
  uint32_t x = 0, y = 0;
  /// The samples that are due, and how many of all are whole.
  uint32_t begin = 0, end = 0, whole = 0;
  PixelSum sum;
  Alike* square = nullptr;
};

/// The pixels of a block, square by square.
struct Block {
  std::array<Pixel, kBlock * kBlock> all;
  std::array<Alike, kSquares> squares;
  Alike whole;
  /// Sums over its paths.
  Vec3f indirect, albedo;
  size_t count = 0;

  Block(uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1) {
    size_t square = 0;
    for (uint32_t y = y0; y < y1; y += 2) {
      for (uint32_t x = x0; x < x1; x += 2, ++square) {
        for (uint32_t v = y; v < std::min(y + 2, y1); ++v) {
          for (uint32_t u = x; u < std::min(x + 2, x1); ++u) add(u, v, &squares[square]);
        }
      }
    }
  }

  std::span<Pixel> pixels() { return {all.data(), count}; }

 private:
  void add(uint32_t x, uint32_t y, Alike* square) {
    Pixel& p = all[count++];
    p.x = x;
    p.y = y;
    p.square = square;
  }
};

/// Traces the pixels of a tile.
struct TileTask {
  const Stage& stage;
  const Camera& camera;
  const Lens& lens;
  const RenderOptions& options;
  const PixelFilter& filter;
  FilmSums& sums;

  /// The pixels of a tile block by block, whose rays run side by side. `pixels` is told how many
  /// are done, and ends it.
  uint64_t run(const Tile& tile, Reporting& pixels) const {
    uint64_t rays = 0;
    for (uint32_t y = tile.y0; y < tile.y1; y += kBlock) {
      const uint32_t down = std::min(kBlock, tile.y1 - y);
      for (uint32_t x = tile.x0; x < tile.x1; x += kBlock) {
        Block block(x, y, std::min(x + kBlock, tile.x1), y + down);
        rays += traceBlock(block);
      }
      if (!pixels.add((tile.x1 - tile.x0) * down)) break;
    }
    return rays;
  }

 private:
  uint64_t traceBlock(Block& block) const {
    const uint32_t samples = std::max(1u, options.samples);
    const bool spares = stage.ambient && options.denoise;
    const uint32_t most = spares ? std::min(samples, kMostWhole) : samples;
    for (Pixel& p : block.pixels()) p.whole = most;
    if (spares) sparePaths(block, most);
    traceWhole(block);
    for (Pixel& p : block.pixels()) {
      p.end += briefPaths(p.sum, p.whole, stage.ambient ? samples - p.whole : kMostBrief * p.whole);
    }
    trace(block, true);
    uint64_t rays = 0;
    for (const Pixel& p : block.pixels()) {
      deposit(p);
      rays += p.sum.rays;
    }
    return rays;
  }

  /// Traces some paths of each pixel, and finds which need no more.
  void sparePaths(Block& block, uint32_t most) const {
    for (Pixel& p : block.pixels()) p.whole = std::min(most, kPlainestWhole);
    traceWhole(block);
    if (block.whole.all()) return evenOut(block);
    for (Pixel& p : block.pixels()) p.whole = std::min(most, kPlainWhole);
    traceWhole(block);
    for (Pixel& p : block.pixels()) p.whole = p.square->all() ? p.whole : most;
  }

  /// All pixels of one plane have the same light from the sky.
  static void evenOut(Block& block) {
    float sum = 0, squares = 0;
    for (const Pixel& p : block.pixels()) {
      sum += p.sum.indirect;
      squares += p.sum.indirects;
    }
    const Vec3f& all = block.albedo;
    const auto share = [](float of, float albedo) { return albedo > 0 ? of / albedo : 0.0f; };
    const Vec3f light{share(block.indirect.x, all.x), share(block.indirect.y, all.y),
                      share(block.indirect.z, all.z)};
    const float variance = varianceOf(sum, squares, static_cast<uint32_t>(block.pixels().size()));
    for (Pixel& p : block.pixels()) {
      p.sum.variance = variance;
      for (Mix& m : p.sum.mixes) m.put(Mix::kIndirect, m.at(Mix::kWholeAlbedo) * light);
    }
  }

  void traceWhole(Block& block) const {
    for (Pixel& p : block.pixels()) p.end = p.whole;
    trace(block, false);
  }

  /// Traces what samples of pixels are due.
  void trace(Block& block, bool brief) const {
    PathStart starts[Tracer::kMostTogether];
    Vec2f places[Tracer::kMostTogether];
    Pixel* owners[Tracer::kMostTogether];
    PathResult results[Tracer::kMostTogether];
    size_t count = 0;
    const auto flush = [&] {
      traceTogether(stage, {starts, count}, options.seed, brief, results);
      for (size_t i = 0; i < count; ++i) {
        owners[i]->sum.add(results[i], filter.weights(places[i].x), filter.weights(places[i].y),
                           brief, stage.light.exposure);
        if (brief) continue;
        owners[i]->square->note(results[i]);
        block.whole.note(results[i]);
        block.indirect += results[i].indirect;
        block.albedo += results[i].albedo;
      }
      count = 0;
    };
    for (Pixel& p : block.pixels()) {
      for (; p.begin < p.end; ++p.begin) {
        owners[count] = &p;
        const Sampler sampler(p.x, p.y, p.begin, options.seed);
        places[count] = sampler.point(kPixelDimension);
        starts[count] = {ray(p.x, p.y, places[count], sampler), p.x, p.y, p.begin};
        if (++count == Tracer::kMostTogether) flush();
      }
    }
    if (count > 0) flush();
  }

  /// Adds a pixel's samples to the film: each pixel counts the same, however many it has.
  void deposit(const Pixel& p) const {
    sums.setVariance(place(p.x, p.y),
                     p.sum.variance.value_or(varianceOf(p.sum.indirect, p.sum.indirects, p.whole)));
    const float share = 1 / static_cast<float>(p.end);
    const float wholeShare = 1 / static_cast<float>(p.whole);
    for (uint32_t j = 0; j < 3; ++j) {
      for (uint32_t i = 0; i < 3; ++i) {
        // Off the left and the upper edge numbers wrap around and are too large as well.
        const uint32_t x = p.x + i - 1, y = p.y + j - 1;
        if (x >= options.width || y >= options.height) continue;
        sums.add(x, y, p.sum.mixes[3 * j + i], share, wholeShare);
      }
    }
  }

  size_t place(uint32_t x, uint32_t y) const { return static_cast<size_t>(y) * options.width + x; }

  Ray ray(uint32_t x, uint32_t y, Vec2f u, const Sampler& sampler) const {
    const double width = options.width, height = options.height, aspect = width / height;
    const double px = x + static_cast<double>(u.x), py = y + static_cast<double>(u.y);
    const Ray middle = cameraRay(camera, aspect, px / width, 1 - py / height);
    return throughLens(middle, camera, lens, sampler);
  }

  /// How many brief paths bring a pixel's edges and shadows below what the eye tells apart.
  uint32_t briefPaths(const PixelSum& sum, uint32_t n, uint32_t most) const {
    if (!options.denoise || n < 2) return 0;
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
  FilmSums sums(film, options.threads);
  const PixelFilter filter;
  const TileTask task{stage, camera, lens, options, filter, sums};
  const uint32_t across = (options.width + kTile - 1) / kTile;
  const uint32_t down = (options.height + kTile - 1) / kTile;
  std::atomic<uint64_t> allRays = 0;
  Reporting pixels(options, static_cast<double>(options.width) * options.height);
  // Tiles add to pixels beside them. So every other one of every other row is traced, then those
  // between: no two of a round touch the same pixel, and its sums come in the same order always.
  for (uint32_t round = 0; round < 4; ++round) {
    const uint32_t fromX = round & 1, fromY = round >> 1;
    const uint32_t columns = (across + 1 - fromX) / 2, rows = (down + 1 - fromY) / 2;
    parallelFor(static_cast<size_t>(columns) * rows, options.threads, [&](size_t tile, unsigned) {
      if (pixels.ended()) return;
      Tile t;
      t.x0 = (static_cast<uint32_t>(tile % columns) * 2 + fromX) * kTile;
      t.y0 = (static_cast<uint32_t>(tile / columns) * 2 + fromY) * kTile;
      t.x1 = std::min(t.x0 + kTile, options.width);
      t.y1 = std::min(t.y0 + kTile, options.height);
      allRays += task.run(t, pixels);
    });
  }
  sums.finish(film, options.threads);
  rays += allRays;
  return !pixels.ended();
}

}  // namespace gable::rt
