// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A regression of first order, as Moon et al. 2014, Adaptive Rendering Based on Weighted Local
// Regression, and Bitterli et al. 2016, Nonlinearly Weighted First-order Regression for Denoising
// Monte Carlo Renderings: about each pixel the light over albedo is fitted by a plane over normal,
// distance and place, and the pixel gets the plane's value. Where an edge runs through a pixel, its
// light, normal and distance are mixed alike, so the fit keeps the edge. Neighbours count by how
// far they differ in brightness; as in Rousselle et al. 2012, what noise alone makes of a
// difference counts as none. How steep planes are on surfaces is known beforehand, and counts the
// more the noisier the light is: ridge regression.
//
// A block of pixels is fitted at once, each sum an array over the block, so that compilers make
// vectors of the inner loops.

#include "render/denoise.h"

#include <array>

#include "base/parallel_work.h"

namespace gable::rt {

namespace {

/// Pixels to each side that a fit looks at, and the gaps between them by pass: the first takes what
/// jitters from pixel to pixel, the second the blotches that are left of it on plain walls.
constexpr int kReach = 3, kGaps[] = {1, 3};
/// The same of light that comes straight from the sky. On plain ground, blocks of 4 x 4 pixels have
/// one light (see film.cpp): the second pass goes from block to block.
constexpr int kSkyReach = 2, kBlockReach = 1, kBlockGap = 4;
/// The samples of a pixel count in its neighbours, too, so its mean varies less than its own
/// samples say: by this.
constexpr float kShared = 0.3f;
/// Brightness differences count in standard deviations times this.
constexpr float kBrightness = 1.2f;
/// The least albedo that tells normals and distances.
constexpr float kLeastTone = 1e-4f;
/// Distances count by this share of themselves, and beyond so many of it no more.
constexpr float kDepth = 0.05f, kMostDepths = 3;

/// What is fitted over: the normal, the distance, the place across and down, and the constant. It
/// comes last, where its own factor is known without going back through the others.
enum Feature : size_t { kNormalX, kNormalY, kNormalZ, kDistance, kAcross, kDown, kConstant };
constexpr size_t kFeatures = kConstant + 1, kProducts = kFeatures * (kFeatures + 1) / 2;
/// One over the square of how much the light changes with each, in its own size.
constexpr std::array<float, kFeatures> kStiffness{1.1f, 1.1f, 1.1f, 0.28f, 0.62f, 0.62f, 0};
/// Keeps features that are the same everywhere from dividing by 0.
constexpr float kLeastStiffness = 1e-5f;

constexpr size_t kBlock = 32;
using Lanes = std::array<float, kBlock>;
using Plane = std::vector<float>;

constexpr size_t product(size_t row, size_t column) { return row * (row + 1) / 2 + column; }

/// About exp(-t), from 1 down to almost 0 for t of 0 and more. Numbers so small that processors are
/// slow at them are kept out.
inline float falling(float t) {
  const float u = 1 + std::min(t, 100.0f) * 0.125f, u2 = u * u, u4 = u2 * u2;
  return 1 / (u4 * u4);
}

/// Light, and the variance of its luminance, as planes of single numbers.
struct Planes {
  Plane r, g, b, luminance, noise;

  explicit Planes(size_t pixels)
      : r(pixels), g(pixels), b(pixels), luminance(pixels), noise(pixels) {}

  void set(size_t i, const Vec3f& light, float variance) {
    r[i] = light.x;
    g[i] = light.y;
    b[i] = light.z;
    luminance[i] = rt::luminance(light);
    noise[i] = variance;
  }
};

/// The film in planes.
struct Guide {
  int width = 0, height = 0;
  Planes light;
  Plane nx, ny, nz, distance, known;

  Guide(const Film& film, unsigned threads)
      : width(static_cast<int>(film.width)),
        height(static_cast<int>(film.height)),
        light(film.direct.size()) {
    for (Plane* p : {&nx, &ny, &nz, &distance, &known}) p->resize(film.direct.size());
    parallelWork(film.height, threads, [&](size_t y, unsigned) {
      work(film.width);
      for (int x = 0; x < width; ++x) set(film, x, static_cast<int>(y));
    });
  }

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }
  /// Whether the block of pixels that begins there sees anything but sky.
  bool isAnyKnown(int x, int y) const {
    const size_t first = index(x, y), count = std::min(kBlock, static_cast<size_t>(width - x));
    for (size_t i = first; i < first + count; ++i) {
      if (known[i] > 0) return true;
    }
    return false;
  }

 private:
  void set(const Film& film, int x, int y) {
    const size_t i = index(x, y);
    nx[i] = film.normal[i].x;
    ny[i] = film.normal[i].y;
    nz[i] = film.normal[i].z;
    distance[i] = film.distance[i];
    known[i] = luminance(film.albedo[i]) > kLeastTone ? 1.0f : 0.0f;
    light.set(i, film.irradiance[i], noiseAbout(film, x, y));
  }

  /// The variance about a pixel: single estimates of few samples are unreliable.
  float noiseAbout(const Film& film, int x, int y) const {
    float sum = 0;
    for (int j = -1; j <= 1; ++j) {
      const int v = std::clamp(y + j, 0, height - 1);
      for (int i = -1; i <= 1; ++i) {
        const int u = std::clamp(x + i, 0, width - 1);
        sum +=
            static_cast<float>((2 - std::abs(i)) * (2 - std::abs(j))) * film.variance[index(u, v)];
      }
    }
    return sum / 16;
  }
};

/// The fits of a block of pixels of a row.
class Fits {
 public:
  Fits(const Guide& guide, int reach, int gap, int x, int y)
      : guide_(guide),
        reach_(reach),
        x_(x),
        y_(y),
        count_(std::min(static_cast<int>(kBlock), guide.width - x)) {
    features_[kConstant].fill(1);
    for (int j = -reach; j <= reach; ++j) {
      if (y + j * gap < 0 || y + j * gap >= guide.height) continue;
      for (int i = -reach; i <= reach; ++i) add(i * gap, j * gap, share(i), share(j));
    }
    stiffen();
    factor();
    solve();
  }

  int count() const { return count_; }
  /// What the fit says of the block's pixel `i`; nowhere darker than black.
  Vec3f value(size_t i) const {
    const float last = inverse_[kConstant][i];
    const auto of = [&](size_t channel) {
      return std::max(0.0f, sums_[kConstant][channel][i] * last);
    };
    return {of(0), of(1), of(2)};
  }
  /// The variance of its luminance.
  float noise(size_t i) const {
    const float weight = weightSum_[i];
    return weight > 0
               ? noises_[i] / weight * std::min(1.0f, kShared * squared(inverse_[kConstant][i]))
               : 0;
  }

 private:
  static float squared(float v) { return v * v; }
  float share(int steps) const { return static_cast<float>(steps) / static_cast<float>(reach_); }

  /// Adds the neighbours that lie `dx`, `dy` from the pixels, `across` and `down` of the reach.
  void add(int dx, int dy, float across, float down) {
    const int from = std::max(0, -dx - x_), to = std::min(count_, guide_.width - dx - x_);
    if (from >= to) return;
    describe(dx, dy, across, down, from, to);
    const size_t begin = static_cast<size_t>(from), end = static_cast<size_t>(to);
    const size_t q = guide_.index(x_ + dx + from, y_ + dy) - begin;
    for (size_t f = 0; f < kFeatures; ++f) {
      Lanes weighed;
      for (size_t i = begin; i < end; ++i) weighed[i] = weights_[i] * features_[f][i];
      for (size_t e = 0; e <= f; ++e) {
        Lanes& sum = products_[product(f, e)];
        const Lanes& other = features_[e];
        for (size_t i = begin; i < end; ++i) sum[i] += weighed[i] * other[i];
      }
      const Plane* const channels[3] = {&guide_.light.r, &guide_.light.g, &guide_.light.b};
      for (size_t c = 0; c < 3; ++c) {
        const float* const light = channels[c]->data() + q;
        Lanes& sum = sums_[f][c];
        for (size_t i = begin; i < end; ++i) sum[i] += weighed[i] * light[i];
      }
    }
    const float* const noise = guide_.light.noise.data() + q;
    for (size_t i = begin; i < end; ++i) noises_[i] += weights_[i] * noise[i];
  }

  /// Weights and features of neighbours, as their pixels see them.
  void describe(int dx, int dy, float across, float down, int from, int to) {
    const size_t begin = static_cast<size_t>(from), end = static_cast<size_t>(to);
    const size_t p = guide_.index(x_ + from, y_) - begin;
    const size_t q = guide_.index(x_ + dx + from, y_ + dy) - begin;
    const auto here = [p](const Plane& v) { return v.data() + p; };
    const auto there = [q](const Plane& v) { return v.data() + q; };
    const float kernel = falling(across * across + down * down);
    const float scale = 1 / (kBrightness * kBrightness);
    const float *const l = here(guide_.light.luminance), *const lq = there(guide_.light.luminance);
    const float *const v = here(guide_.light.noise), *const vq = there(guide_.light.noise);
    const float *const d = here(guide_.distance), *const dq = there(guide_.distance);
    const float* const known = there(guide_.known);
    for (size_t i = begin; i < end; ++i) {
      const float off = lq[i] - l[i], noise = v[i] + vq[i] + 1e-9f;
      const float unlike = std::max(0.0f, off * off / noise - 1) * scale;
      weights_[i] = known[i] * kernel * falling(unlike);
      const float step = (dq[i] - d[i]) / (kDepth * d[i] + 1e-6f);
      features_[kDistance][i] = std::max(-kMostDepths, std::min(kMostDepths, step));
      features_[kAcross][i] = across;
      features_[kDown][i] = down;
    }
    const Plane* const normals[3] = {&guide_.nx, &guide_.ny, &guide_.nz};
    for (size_t k = 0; k < 3; ++k) {
      const float *const n = here(*normals[k]), *const nq = there(*normals[k]);
      for (size_t i = begin; i < end; ++i) features_[kNormalX + k][i] = nq[i] - n[i];
    }
  }

  /// Adds what is known of the planes beforehand, by how noisy the light is.
  void stiffen() {
    weightSum_ = products_[product(kConstant, kConstant)];
    const Lanes& weight = weightSum_;
    const std::array<Lanes, 3>& light = sums_[kConstant];
    for (size_t i = 0; i < kBlock; ++i) {
      const float mean = luminance(Vec3f{light[0][i], light[1][i], light[2][i]});
      const float noise = noises_[i] * weight[i] / (mean * mean + 1e-12f);
      for (size_t f = 0; f < kFeatures; ++f) {
        products_[product(f, f)][i] += noise * kStiffness[f] + kLeastStiffness * weight[i] + 1e-12f;
      }
    }
  }

  /// Cholesky's factors, in place.
  void factor() {
    for (size_t c = 0; c < kFeatures; ++c) {
      for (size_t r = c; r < kFeatures; ++r) {
        Lanes& sum = products_[product(r, c)];
        for (size_t k = 0; k < c; ++k) {
          const Lanes &a = products_[product(r, k)], &b = products_[product(c, k)];
          for (size_t i = 0; i < kBlock; ++i) sum[i] -= a[i] * b[i];
        }
      }
      const Lanes &pivot = products_[product(c, c)], &weight = weightSum_;
      for (size_t i = 0; i < kBlock; ++i) {
        inverse_[c][i] = 1 / std::sqrt(std::max(pivot[i], 1e-7f * weight[i] + 1e-20f));
      }
      for (size_t r = c + 1; r < kFeatures; ++r) {
        Lanes& sum = products_[product(r, c)];
        for (size_t i = 0; i < kBlock; ++i) sum[i] *= inverse_[c][i];
      }
    }
  }

  void solve() {
    for (size_t r = 0; r < kFeatures; ++r) {
      for (size_t c = 0; c < 3; ++c) {
        Lanes& sum = sums_[r][c];
        for (size_t k = 0; k < r; ++k) {
          const Lanes &a = products_[product(r, k)], &known = sums_[k][c];
          for (size_t i = 0; i < kBlock; ++i) sum[i] -= a[i] * known[i];
        }
        for (size_t i = 0; i < kBlock; ++i) sum[i] *= inverse_[r][i];
      }
    }
  }

  const Guide& guide_;
  int reach_, x_, y_, count_;
  Lanes weights_{}, weightSum_{}, noises_{};
  std::array<Lanes, kFeatures> features_{}, inverse_{};
  /// Of features with each other, the lower half, and with the light of each channel.
  std::array<Lanes, kProducts> products_{};
  std::array<std::array<Lanes, 3>, kFeatures> sums_{};
};

// A copy each for processors with wider vectors, chosen as the program starts. All give the same
// numbers: no product and sum are contracted. Sanitizers do not bear the choosing.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GABLE_WIDE __attribute__((target_clones("avx512f", "avx2", "default"), flatten))
#else
#define GABLE_WIDE
#endif

/// A pass over a row of pixels.
GABLE_WIDE void smoothRow(const Guide& guide, Planes& next, int reach, int gap, int y) {
  for (int x = 0; x < guide.width; x += static_cast<int>(kBlock)) {
    if (!guide.isAnyKnown(x, y)) continue;
    const Fits fits(guide, reach, gap, x, y);
    const size_t first = guide.index(x, y);
    for (size_t k = 0; k < static_cast<size_t>(fits.count()); ++k) {
      if (guide.known[first + k] > 0) next.set(first + k, fits.value(k), fits.noise(k));
    }
  }
}

/// A pass over all pixels.
void smooth(Guide& guide, int reach, int gap, unsigned threads) {
  Planes next = guide.light;
  constexpr int kRows = 8;
  const int tasks = (guide.height + kRows - 1) / kRows;
  parallelWork(static_cast<size_t>(tasks), threads, [&](size_t task, unsigned) {
    const int from = static_cast<int>(task) * kRows;
    for (int y = from; y < std::min(from + kRows, guide.height); ++y) {
      work(kWorkBetweenLooks + 1);
      smoothRow(guide, next, reach, gap, y);
    }
  });
  guide.light = std::move(next);
}

}  // namespace

std::vector<Vec3f> resolve(const Film& film, Smoothing smoothing, unsigned threads) {
  std::vector<Vec3f> picture(film.direct.size());
  const auto put = [&](const auto& irradiance) {
    parallelWork(film.height, threads, [&](size_t y, unsigned) {
      work(film.width);
      for (size_t i = y * film.width; i < (y + 1) * film.width; ++i) {
        picture[i] = film.direct[i] + film.sun[i] + irradiance(i) * albedoDivisor(film.albedo[i]);
      }
    });
  };
  if (smoothing == Smoothing::None) {
    put([&](size_t i) { return film.irradiance[i]; });
    return picture;
  }
  Guide guide(film, threads);
  if (smoothing == Smoothing::Sky) {
    smooth(guide, kSkyReach, 1, threads);
    smooth(guide, kBlockReach, kBlockGap, threads);
  } else {
    for (const int gap : kGaps) smooth(guide, kReach, gap, threads);
  }
  put([&](size_t i) { return Vec3f{guide.light.r[i], guide.light.g[i], guide.light.b[i]}; });
  return picture;
}

}  // namespace gable::rt
