// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The edge-avoiding a-trous wavelet of Dammertz et al. 2010 with the variance-driven brightness
// weight of Schied et al. 2017: passes of a 5 x 5 spline kernel with growing gaps over the light
// divided by albedo; the variance shrinks along with it, so later passes stop at what is structure
// and not noise.

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

Vec3f divisor(const Vec3f& albedo) {
  return {std::max(kLeastAlbedo, albedo.x), std::max(kLeastAlbedo, albedo.y),
          std::max(kLeastAlbedo, albedo.z)};
}

struct Smoother {
  const Film& film;
  /// Change of distance from pixel to pixel, across and down.
  std::vector<Vec2f> slope;
  /// The film's normals as unit vectors, and how long they were: where a pixel's own samples
  /// disagree, its mean normal says little.
  std::vector<Vec3f> normal;
  std::vector<float> agreement;
  /// The layer at work, over albedo.
  std::vector<Vec3f> light;
  std::vector<float> variance;
  /// Of the layer at work.
  std::vector<float> brightness;
  float brightnessWeight = 1;

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * film.width + static_cast<size_t>(x);
  }
  int width() const { return static_cast<int>(film.width); }
  int height() const { return static_cast<int>(film.height); }

  void findNormals() {
    normal.resize(film.normal.size());
    agreement.resize(film.normal.size());
    for (size_t i = 0; i < normal.size(); ++i) {
      normal[i] = normalized(film.normal[i]);
      agreement[i] = length(film.normal[i]);
    }
  }

  /// The smaller of the one-sided differences: at an outline, that of the pixel's own side.
  void findSlopes() {
    slope.assign(film.direct.size(), {});
    const auto least = [](float a, float b) { return std::abs(a) < std::abs(b) ? a : b; };
    for (int y = 0; y < height(); ++y) {
      for (int x = 0; x < width(); ++x) {
        const float d = film.distance[index(x, y)];
        const float l = d - film.distance[index(std::max(0, x - 1), y)];
        const float r = film.distance[index(std::min(width() - 1, x + 1), y)] - d;
        const float t = d - film.distance[index(x, std::max(0, y - 1))];
        const float b = film.distance[index(x, std::min(height() - 1, y + 1))] - d;
        slope[index(x, y)] = {x == 0             ? r
                              : x == width() - 1 ? l
                                                 : least(l, r),
                              y == 0              ? b
                              : y == height() - 1 ? t
                                                  : least(t, b)};
      }
    }
  }

  /// The variance about a pixel: single estimates of few samples are unreliable.
  float meanVariance(int x, int y) const {
    float sum = 0, weights = 0;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const int qx = x + i, qy = y + j;
        if (qx < 0 || qy < 0 || qx >= width() || qy >= height()) continue;
        const float w = (i ? 0.5f : 1.0f) * (j ? 0.5f : 1.0f);
        sum += w * variance[index(qx, qy)];
        weights += w;
      }
    }
    return sum / weights;
  }

  void pixel(int x, int y, int gap, std::vector<Vec3f>& toLight,
             std::vector<float>& toVariance) const {
    const size_t p = index(x, y);
    toLight[p] = light[p];
    toVariance[p] = variance[p];
    if (film.distance[p] <= 0) return;
    const float deviation = brightnessWeight * std::sqrt(meanVariance(x, y)) + 1e-5f;
    const float nearness = 1 / (0.004f * film.distance[p] + 1e-3f);

    Vec3f sum;
    float weights = 0, variances = 0;
    for (int j = -2; j <= 2; ++j) {
      for (int i = -2; i <= 2; ++i) {
        const int qx = x + i * gap, qy = y + j * gap;
        if (qx < 0 || qy < 0 || qx >= width() || qy >= height()) continue;
        const size_t q = index(qx, qy);
        float w = kKernel[std::abs(i)] * kKernel[std::abs(j)];
        if (i != 0 || j != 0) {
          if (film.distance[q] <= 0) continue;
          const float agreed = agreement[p] * agreement[q];
          const float cosine = std::max(0.0f, dot(normal[p], normal[q]));
          const float bend = kSharpness * agreed * agreed * (1 - cosine);
          const float expected = film.distance[p] + slope[p].x * static_cast<float>(i * gap) +
                                 slope[p].y * static_cast<float>(j * gap);
          const float steps = std::abs(slope[p].x * static_cast<float>(i * gap)) +
                              std::abs(slope[p].y * static_cast<float>(j * gap));
          const float tolerance = 1 / nearness + 0.5f * steps + 2 * film.spread[p];
          const float apart = std::abs(film.distance[q] - expected) / tolerance;
          const float unlike = std::abs(brightness[q] - brightness[p]) / deviation;
          w *= std::exp(-apart - unlike - bend);
        }
        sum += light[q] * w;
        variances += variance[q] * w * w;
        weights += w;
      }
    }
    toLight[p] = sum * (1 / weights);
    toVariance[p] = variances / (weights * weights);
  }

  /// Leaves the smoothed layer in `light`, over albedo.
  void run(const FilmLayer& layer, int passes, float weight, unsigned threads) {
    brightnessWeight = weight;
    variance = layer.variance;
    light.resize(layer.light.size());
    for (size_t i = 0; i < light.size(); ++i) {
      const Vec3f d = divisor(film.albedo[i]);
      const Vec3f& l = layer.light[i];
      light[i] = {l.x / d.x, l.y / d.y, l.z / d.z};
    }
    std::vector<Vec3f> toLight(light.size());
    std::vector<float> toVariance(light.size());
    brightness.resize(light.size());
    for (int pass = 0; pass < passes; ++pass) {
      for (size_t i = 0; i < light.size(); ++i) brightness[i] = luminance(light[i]);
      parallelFor(
          film.height, threads,
          [&](size_t row, unsigned) {
            for (int x = 0; x < width(); ++x) {
              pixel(x, static_cast<int>(row), 1 << pass, toLight, toVariance);
            }
          },
          8);
      std::swap(toLight, light);
      std::swap(toVariance, variance);
    }
  }
};

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
  Smoother smoother{.film = film};
  smoother.findSlopes();
  smoother.findNormals();
  const auto add = [&](const FilmLayer& layer, int passes, float weight) {
    smoother.run(layer, passes, weight, threads);
    for (size_t i = 0; i < pixels; ++i) {
      picture[i] += smoother.light[i] * divisor(film.albedo[i]);
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
