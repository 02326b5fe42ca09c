// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The edge-avoiding a-trous wavelet of Dammertz et al. 2010 with the variance-driven brightness
// weight of Schied et al. 2017: passes of a 5 x 5 spline kernel with growing gaps over the light
// divided by albedo; the variance shrinks along with it, so later passes stop at what is structure
// and not noise. As in Rousselle et al. 2012, the difference that noise alone makes counts as none.
//
// All is kept as planes of single numbers, and a pass goes through the neighbours of a whole row
// one place after the other, so that compilers make vectors of the inner loops.

#include "render/denoise.h"

#include "base/parallel.h"

namespace gable::rt {

namespace {

/// The sun's light has noise in penumbras only: small, and next to edges to be kept.
constexpr int kSunPasses = 1, kIndirectPasses = 4, kSkyPasses = 2;
constexpr float kKernel[3] = {3.0f / 8, 1.0f / 4, 1.0f / 16};
/// Least albedo to divide by.
constexpr float kLeastAlbedo = 0.02f;
/// Brightness differences count in standard deviations times this.
constexpr float kSunBrightness = 1.0f, kIndirectBrightness = 3.0f;
/// Weight of a normal that is turned by 20 degrees: a half.
constexpr float kSharpness = 10;

using Plane = std::vector<float>;

Vec3f divisor(const Vec3f& albedo) {
  return {std::max(kLeastAlbedo, albedo.x), std::max(kLeastAlbedo, albedo.y),
          std::max(kLeastAlbedo, albedo.z)};
}

/// About exp(-t), from 1 down to almost 0 for t of 0 and more. Numbers so small that processors are
/// slow at them are kept out.
inline float falling(float t) {
  const float u = 1 + std::min(t, 100.0f) * 0.125f, u2 = u * u, u4 = u2 * u2;
  return 1 / (u4 * u4);
}

/// What guides the smoothing, by pixel.
struct Guide {
  int width = 0, height = 0;
  /// Distance, its change from pixel to pixel across and down, and how far it may be off.
  Plane distance, across, down, slack;
  /// Normals as long as a pixel's own samples agree on them, and that length: where they do not,
  /// the mean says little.
  Plane nx, ny, nz, agreement;

  explicit Guide(const Film& film)
      : width(static_cast<int>(film.width)), height(static_cast<int>(film.height)) {
    const size_t pixels = film.direct.size();
    for (Plane* p : {&distance, &across, &down, &slack, &nx, &ny, &nz, &agreement}) {
      p->resize(pixels);
    }
    for (size_t i = 0; i < pixels; ++i) {
      // Nothing is near what is nowhere.
      distance[i] = film.distance[i] > 0 ? film.distance[i] : kNowhere;
      slack[i] = 0.004f * film.distance[i] + 1e-3f + 2 * film.spread[i];
      nx[i] = film.normal[i].x;
      ny[i] = film.normal[i].y;
      nz[i] = film.normal[i].z;
      agreement[i] = length(film.normal[i]);
    }
    findSlopes(film);
  }

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
  }

 private:
  static constexpr float kNowhere = 1e18f;

  /// The smaller of the one-sided differences: at an outline, that of the pixel's own side.
  void findSlopes(const Film& film) {
    const auto least = [](float a, float b) { return std::abs(a) < std::abs(b) ? a : b; };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float d = film.distance[index(x, y)];
        const float l = d - film.distance[index(std::max(0, x - 1), y)];
        const float r = film.distance[index(std::min(width - 1, x + 1), y)] - d;
        const float t = d - film.distance[index(x, std::max(0, y - 1))];
        const float b = film.distance[index(x, std::min(height - 1, y + 1))] - d;
        across[index(x, y)] = x == 0 ? r : x == width - 1 ? l : least(l, r);
        down[index(x, y)] = y == 0 ? b : y == height - 1 ? t : least(t, b);
      }
    }
  }
};

/// Light over albedo, with the variance of its luminance.
struct Layer {
  Plane r, g, b, variance;

  explicit Layer(size_t pixels) : r(pixels), g(pixels), b(pixels), variance(pixels) {}
};

class Smoother {
 public:
  Smoother(const Guide& guide, Layer& layer, float brightness, unsigned threads)
      : guide_(guide),
        layer_(layer),
        brightness_(brightness),
        threads_(threads),
        next_(layer.r.size()),
        luminance_(layer.r.size()),
        noise_(layer.r.size()) {}

  void pass(int gap) {
    eachRow([&](int y) { prepareRow(y); });
    eachRow([&](int y) { smoothRow(y, gap); });
    std::swap(layer_, next_);
  }

 private:
  template <class Row>
  void eachRow(Row&& row) {
    parallelFor(
        static_cast<size_t>(guide_.height), threads_,
        [&](size_t y, unsigned) { row(static_cast<int>(y)); }, 8);
  }

  /// Luminance, and the variance about a pixel: single estimates of few samples are unreliable.
  void prepareRow(int y) {
    const int w = guide_.width;
    const size_t row = guide_.index(0, y);
    const float* const up = &layer_.variance[guide_.index(0, std::max(0, y - 1))];
    const float* const at = &layer_.variance[row];
    const float* const low = &layer_.variance[guide_.index(0, std::min(guide_.height - 1, y + 1))];
    Plane column(static_cast<size_t>(w));
    for (int x = 0; x < w; ++x) {
      column[static_cast<size_t>(x)] = 0.25f * (up[x] + low[x]) + 0.5f * at[x];
    }
    for (int x = 0; x < w; ++x) {
      const size_t i = row + static_cast<size_t>(x);
      const float left = column[static_cast<size_t>(std::max(0, x - 1))];
      const float right = column[static_cast<size_t>(std::min(w - 1, x + 1))];
      noise_[i] = 0.25f * (left + right) + 0.5f * column[static_cast<size_t>(x)];
      luminance_[i] = luminance(Vec3f{layer_.r[i], layer_.g[i], layer_.b[i]});
    }
  }

  /// Sums of a row.
  struct Sums {
    Plane r, g, b, variance, weight;
    explicit Sums(size_t n) : r(n), g(n), b(n), variance(n), weight(n) {}
  };

  void smoothRow(int y, int gap) {
    Sums sums(static_cast<size_t>(guide_.width));
    for (int j = -2; j <= 2; ++j) {
      if (y + j * gap < 0 || y + j * gap >= guide_.height) continue;
      for (int i = -2; i <= 2; ++i) {
        addPlace(y, i * gap, j * gap, kKernel[std::abs(i)] * kKernel[std::abs(j)], sums);
      }
    }
    const size_t row = guide_.index(0, y);
    for (size_t x = 0; x < sums.r.size(); ++x) {
      const float share = 1 / sums.weight[x];
      next_.r[row + x] = sums.r[x] * share;
      next_.g[row + x] = sums.g[x] * share;
      next_.b[row + x] = sums.b[x] * share;
      next_.variance[row + x] = sums.variance[x] * share * share;
    }
  }

  /// Adds the neighbours that lie `dx`, `dy` from the pixels of a row.
  void addPlace(int y, int dx, int dy, float kernel, Sums& sums) const {
    const int from = std::max(0, -dx), to = std::min(guide_.width, guide_.width - dx);
    const float fx = static_cast<float>(dx), fy = static_cast<float>(dy);
    const size_t p = guide_.index(0, y);
    const size_t q = guide_.index(from + dx, y + dy);
    const auto here = [p, from](const Plane& v) { return v.data() + p + from; };
    const auto there = [q](const Plane& v) { return v.data() + q; };
    const Guide& u = guide_;
    const float *const d = here(u.distance), *const dq = there(u.distance);
    const float *const ax = here(u.across), *const ay = here(u.down), *const sl = here(u.slack);
    const float *const nx = here(u.nx), *const ny = here(u.ny), *const nz = here(u.nz);
    const float *const mx = there(u.nx), *const my = there(u.ny), *const mz = there(u.nz);
    const float *const ag = here(u.agreement), *const aq = there(u.agreement);
    const float *const l = here(luminance_), *const lq = there(luminance_);
    const float *const v = here(noise_), *const vq = there(noise_);
    const float *const r = there(layer_.r), *const g = there(layer_.g), *const b = there(layer_.b);
    const float* const variance = there(layer_.variance);
    float *const sr = sums.r.data() + from, *const sg = sums.g.data() + from;
    float *const sb = sums.b.data() + from, *const sv = sums.variance.data() + from;
    float* const sw = sums.weight.data() + from;
    const float scale = 1 / (brightness_ * brightness_);
    // The sums are no part of what is read; g++ would check that for too many pairs and give up.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (int x = 0; x < to - from; ++x) {
      const float step = ax[x] * fx + ay[x] * fy;
      const float slack = sl[x] + 0.5f * (std::abs(ax[x] * fx) + std::abs(ay[x] * fy));
      const float apart = std::abs(dq[x] - d[x] - step) / slack;
      const float agreed = ag[x] * aq[x];
      const float along = nx[x] * mx[x] + ny[x] * my[x] + nz[x] * mz[x];
      const float bend = kSharpness * agreed * std::max(0.0f, agreed - along);
      const float off = lq[x] - l[x], noise = v[x] + vq[x] + 1e-9f;
      const float unlike = std::max(0.0f, off * off / noise - 1) * scale;
      const float w = kernel * falling(apart + bend + unlike);
      sr[x] += r[x] * w;
      sg[x] += g[x] * w;
      sb[x] += b[x] * w;
      sv[x] += variance[x] * w * w;
      sw[x] += w;
    }
  }

  const Guide& guide_;
  Layer& layer_;
  float brightness_;
  unsigned threads_;
  Layer next_;
  Plane luminance_, noise_;
};

Layer overAlbedo(const Film& film, const FilmLayer& from) {
  Layer layer(from.light.size());
  for (size_t i = 0; i < from.light.size(); ++i) {
    const Vec3f d = divisor(film.albedo[i]);
    layer.r[i] = from.light[i].x / d.x;
    layer.g[i] = from.light[i].y / d.y;
    layer.b[i] = from.light[i].z / d.z;
  }
  layer.variance = from.variance;
  return layer;
}

}  // namespace

std::vector<Vec3f> resolve(const Film& film, Smoothing smoothing, unsigned threads) {
  const size_t pixels = film.direct.size();
  std::vector<Vec3f> picture = film.direct;
  const auto addPlain = [&](const FilmLayer& layer) {
    for (size_t i = 0; i < pixels; ++i) picture[i] += layer.light[i];
  };
  if (smoothing == Smoothing::None) {
    addPlain(film.sun);
    addPlain(film.indirect);
    return picture;
  }
  const Guide guide(film);
  const auto add = [&](const FilmLayer& from, int passes, float brightness) {
    Layer layer = overAlbedo(film, from);
    Smoother smoother(guide, layer, brightness, threads);
    for (int pass = 0; pass < passes; ++pass) smoother.pass(1 << pass);
    for (size_t i = 0; i < pixels; ++i) {
      picture[i] += Vec3f{layer.r[i], layer.g[i], layer.b[i]} * divisor(film.albedo[i]);
    }
  };
  if (smoothing == Smoothing::Sky)
    addPlain(film.sun);
  else
    add(film.sun, kSunPasses, kSunBrightness);
  add(film.indirect, smoothing == Smoothing::Sky ? kSkyPasses : kIndirectPasses,
      kIndirectBrightness);
  return picture;
}

}  // namespace gable::rt
