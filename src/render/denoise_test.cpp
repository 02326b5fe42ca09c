// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/denoise.h"

#include <gtest/gtest.h>

#include "render/sampler.h"

namespace gable::rt {
namespace {

constexpr uint32_t kWidth = 67, kHeight = 41;

/// A number in [0, 1) for a pixel.
float draw(size_t i) {
  return static_cast<float>(mix32(static_cast<uint32_t>(i) + 9) >> 8) * 0x1p-24f;
}

constexpr Vec3f kAlbedo{0.5f, 0.5f, 0.5f};

/// A wall straight ahead, whose indirect light of 1 has noise with a deviation of 0.3.
Film wall() {
  Film film;
  film.width = kWidth;
  film.height = kHeight;
  const size_t pixels = static_cast<size_t>(kWidth) * kHeight;
  film.direct.assign(pixels, {});
  film.sun.assign(pixels, {});
  film.albedo.assign(pixels, kAlbedo);
  film.normal.assign(pixels, {0, 0, 1});
  film.distance.assign(pixels, 10);
  // Of its own samples: the mean has those of its neighbours, too, and varies less.
  film.variance.assign(pixels, 0.2f);
  for (size_t i = 0; i < pixels; ++i) {
    const float light = 1 + 0.3f * std::sqrt(12.0f) * (draw(i) - 0.5f);
    film.irradiance.push_back({light, light, light});
  }
  return film;
}

/// Of the picture's luminance over albedo from 1, among the columns from `from` to `to`.
float deviation(const std::vector<Vec3f>& picture, uint32_t from, uint32_t to, float mean = 1) {
  double sum = 0;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = from; x < to; ++x) {
      const double off = luminance(picture[y * kWidth + x]) / 0.5f - mean;
      sum += off * off;
    }
  }
  return static_cast<float>(std::sqrt(sum / (kHeight * (to - from))));
}

TEST(Denoise, takesTheNoiseOfAWall) {
  const Film film = wall();
  EXPECT_GT(deviation(resolve(film, Smoothing::None, 1), 0, kWidth), 0.28f);
  EXPECT_LT(deviation(resolve(film, Smoothing::Paths, 1), 0, kWidth), 0.04f);
}

TEST(Denoise, keepsWhatIsKnownWithoutNoise) {
  Film film = wall();
  std::fill(film.variance.begin(), film.variance.end(), 0.0f);
  EXPECT_GT(deviation(resolve(film, Smoothing::Paths, 1), 0, kWidth), 0.27f);
}

TEST(Denoise, keepsApartWhatIsFarApart) {
  Film film = wall();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 30; x < kWidth; ++x) {
      film.distance[y * kWidth + x] = 14;
      film.irradiance[y * kWidth + x] *= 0.5f;
    }
  }
  const std::vector<Vec3f> picture = resolve(film, Smoothing::Paths, 1);
  EXPECT_LT(deviation(picture, 29, 30), 0.08f);
  EXPECT_LT(deviation(picture, 30, 31, 0.5f), 0.08f);
}

TEST(Denoise, keepsApartWhatIsTurned) {
  Film film = wall();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 30; x < kWidth; ++x) {
      film.normal[y * kWidth + x] = {1, 0, 0};
      film.irradiance[y * kWidth + x] *= 0.5f;
    }
  }
  EXPECT_LT(deviation(resolve(film, Smoothing::Paths, 1), 29, 30), 0.08f);
}

TEST(Denoise, leavesTheSkyAlone) {
  Film film = wall();
  film.direct[5] = {3, 2, 1};
  film.irradiance[5] = {};
  film.distance[5] = 0;
  film.normal[5] = film.albedo[5] = {};
  const std::vector<Vec3f> picture = resolve(film, Smoothing::Paths, 1);
  EXPECT_EQ(picture[5].x, 3);
  EXPECT_EQ(picture[5].z, 1);
  EXPECT_LT(deviation(picture, 6, 7), 0.08f);
}

TEST(Denoise, keepsThePixelsThatAnEdgeRunsThrough) {
  // Two walls at a corner, of which the pixels of one column see a half each.
  Film film = wall();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 30; x < kWidth; ++x) {
      const float share = x == 30 ? 0.5f : 1.0f;
      const size_t i = y * kWidth + x;
      film.normal[i] = {share, 0, 1 - share};
      film.irradiance[i] *= 1 - 0.7f * share;
    }
  }
  const std::vector<Vec3f> picture = resolve(film, Smoothing::Paths, 1);
  EXPECT_LT(deviation(picture, 29, 30), 0.12f);
  EXPECT_LT(deviation(picture, 30, 31, 0.65f), 0.12f);
  EXPECT_LT(deviation(picture, 31, 32, 0.3f), 0.12f);
}

TEST(Denoise, followsASlopeOfLight) {
  Film film = wall();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      film.irradiance[y * kWidth + x] += kAlbedo * (0.1f * static_cast<float>(x));
    }
  }
  const std::vector<Vec3f> picture = resolve(film, Smoothing::Paths, 1);
  for (const uint32_t x : {5u, 33u, 60u}) {
    EXPECT_LT(deviation(picture, x, x + 1, 1 + 0.05f * static_cast<float>(x)), 0.12f);
  }
}

TEST(Denoise, keepsWhatIsBlackOrNarrow) {
  Film film = wall();
  std::fill(film.irradiance.begin(), film.irradiance.end(), Vec3f{});
  std::fill(film.variance.begin(), film.variance.end(), 0.0f);
  for (const Vec3f& p : resolve(film, Smoothing::Paths, 1)) ASSERT_EQ(luminance(p), 0);
  Film one = wall();
  one.width = one.height = 1;
  for (std::vector<Vec3f>* v : {&one.direct, &one.sun, &one.albedo, &one.normal, &one.irradiance}) {
    v->resize(1);
  }
  one.distance.resize(1);
  one.variance.resize(1);
  EXPECT_NEAR(resolve(one, Smoothing::Paths, 1)[0].x, 0.5f * one.irradiance[0].x, 1e-4f);
}

TEST(Denoise, isTheSameForAnyNumberOfThreads) {
  const Film film = wall();
  const std::vector<Vec3f> one = resolve(film, Smoothing::Paths, 1);
  const std::vector<Vec3f> four = resolve(film, Smoothing::Paths, 4);
  for (size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i].x, four[i].x);
}

}  // namespace
}  // namespace gable::rt
