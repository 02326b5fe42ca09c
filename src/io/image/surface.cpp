// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Normals are the slopes of the heights between neighbours. Occlusion compares a height with the
// mean of what lies around it, near and farther: what is lower sees less of the sky.
#include "io/image/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"
#include "io/image/jpeg.h"
#include "io/image/surface_noise.h"

namespace gable {

namespace {

constexpr int kSize = static_cast<int>(kSurfaceSize);

surface::Draw drawOf(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::Masonry: return surface::drawMasonry;
    case SurfaceKind::Stones: return surface::drawStones;
    case SurfaceKind::Furrows: return surface::drawFurrows;
    case SurfaceKind::Flakes: return surface::drawFlakes;
    case SurfaceKind::Grain: return surface::drawGrain;
    case SurfaceKind::Boards: return surface::drawBoards;
    case SurfaceKind::LappedBoards: return surface::drawLappedBoards;
    case SurfaceKind::Courses: return surface::drawCourses;
    case SurfaceKind::Rolls: return surface::drawRolls;
    case SurfaceKind::Seams: return surface::drawSeams;
    case SurfaceKind::Frame: return surface::drawFrame;
    case SurfaceKind::Panes: return surface::drawPanes;
    case SurfaceKind::Water: return surface::drawWater;
    case SurfaceKind::Weave: return surface::drawWeave;
    case SurfaceKind::Strands:
    case SurfaceKind::Leaves: break;
  }
  return nullptr;
}

uint8_t byteOf(double v) {
  return static_cast<uint8_t>(std::floor(std::clamp(v, 0.0, 1.0) * 255 + 0.5));
}

// The mean over a square of 2 r + 1 pixels: along rows, then along columns.
std::vector<double> blurred(const std::vector<double>& from, int r) {
  std::vector<double> rows(from.size()), out(from.size());
  const auto index = [](int x, int y) {
    return static_cast<size_t>((y + kSize) % kSize) * kSurfaceSize +
           static_cast<size_t>((x + kSize) % kSize);
  };
  for (int y = 0; y < kSize; ++y) {
    work(kSurfaceSize);
    for (int x = 0; x < kSize; ++x) {
      double sum = 0;
      for (int k = -r; k <= r; ++k) sum += from[index(x + k, y)];
      rows[index(x, y)] = sum / (2 * r + 1);
    }
  }
  for (int y = 0; y < kSize; ++y) {
    work(kSurfaceSize);
    for (int x = 0; x < kSize; ++x) {
      double sum = 0;
      for (int k = -r; k <= r; ++k) sum += rows[index(x, y + k)];
      out[index(x, y)] = sum / (2 * r + 1);
    }
  }
  return out;
}

// Occlusion in [0, 1], 1 in the open.
std::vector<double> openness(const SurfaceField& field, const LibraryMaterial& m) {
  std::vector<double> heights;
  heights.reserve(field.texels.size());
  for (const SurfaceTexel& t : field.texels) heights.push_back(t.height);
  std::vector<double> out(heights.size(), 1);
  const double pixel = std::sqrt(m.width * m.height) / kSize;
  for (const int r : {2, 7}) {
    const std::vector<double> around = blurred(heights, r);
    for (size_t i = 0; i < out.size(); ++i) {
      const double deep = std::max(0.0, around[i] - heights[i]) / (r * pixel);
      out[i] *= 1 / (1 + 0.8 * deep);
    }
  }
  return out;
}

// The picture row of field row y: v runs up, rows run down.
size_t rowOf(int y, int size) { return static_cast<size_t>(size - 1 - y); }

Image normalPicture(const SurfaceField& field, const LibraryMaterial& m) {
  Image image{kSurfaceSize, kSurfaceSize, {}};
  image.rgba.resize(field.texels.size() * 4);
  const double acrossU = 2 * m.width / kSize, acrossV = 2 * m.height / kSize;
  for (int y = 0; y < kSize; ++y) {
    work(kSurfaceSize);
    for (int x = 0; x < kSize; ++x) {
      const double du = (field.at(x + 1, y).height - field.at(x - 1, y).height) / acrossU;
      const double dv = (field.at(x, y + 1).height - field.at(x, y - 1).height) / acrossV;
      const double length = std::sqrt(du * du + dv * dv + 1);
      uint8_t* out =
          image.rgba.data() + (rowOf(y, kSize) * kSurfaceSize + static_cast<size_t>(x)) * 4;
      out[0] = byteOf(0.5 - 0.5 * du / length);
      out[1] = byteOf(0.5 - 0.5 * dv / length);
      out[2] = byteOf(0.5 + 0.5 / length);
      out[3] = 255;
    }
  }
  return image;
}

Image surfacePicture(const SurfaceField& field, const LibraryMaterial& m) {
  constexpr int kHalf = kSize / 2;
  const std::vector<double> open = openness(field, m);
  Image image{kSurfaceSize / 2, kSurfaceSize / 2, {}};
  image.rgba.resize(size_t{kHalf} * kHalf * 4);
  for (int y = 0; y < kHalf; ++y) {
    work(kSurfaceSize);
    for (int x = 0; x < kHalf; ++x) {
      double occlusion = 0, roughness = 0, metallic = 0;
      for (int k = 0; k < 4; ++k) {
        const int i = 2 * x + k % 2, j = 2 * y + k / 2;
        const SurfaceTexel& t = field.at(i, j);
        occlusion += open[static_cast<size_t>(j) * kSurfaceSize + static_cast<size_t>(i)] / 4;
        roughness += std::clamp(t.roughness, 0.03, 1.0) / 4;
        metallic += t.metallic / 4;
      }
      uint8_t* out = image.rgba.data() +
                     (rowOf(y, kHalf) * static_cast<size_t>(kHalf) + static_cast<size_t>(x)) * 4;
      out[0] = byteOf(occlusion);
      out[1] = byteOf(roughness);
      out[2] = byteOf(metallic);
      out[3] = 255;
    }
  }
  return image;
}

Image colorPicture(const SurfaceField& field) {
  Image image{kSurfaceSize, kSurfaceSize, {}};
  image.rgba.resize(field.texels.size() * 4);
  for (int y = 0; y < kSize; ++y) {
    work(kSurfaceSize);
    for (int x = 0; x < kSize; ++x) {
      uint8_t* out =
          image.rgba.data() + (rowOf(y, kSize) * kSurfaceSize + static_cast<size_t>(x)) * 4;
      for (size_t k = 0; k < 3; ++k) out[k] = byteOf(field.at(x, y).color[k]);
      out[3] = 255;
    }
  }
  return image;
}

}  // namespace

SurfaceField drawSurface(const LibraryMaterial& m) {
  const surface::Draw draw = drawOf(m.kind);
  if (!draw) return surface::drawPlants(m);
  SurfaceField field;
  field.texels.reserve(size_t{kSurfaceSize} * kSurfaceSize);
  for (int y = 0; y < kSize; ++y) {
    work(kSurfaceSize);
    for (int x = 0; x < kSize; ++x) {
      field.texels.push_back(draw(m, (x + 0.5) / kSize, (y + 0.5) / kSize));
    }
  }
  return field;
}

Image pictureOf(const SurfaceField& field, const LibraryMaterial& m, MaterialPicture picture) {
  if (picture == MaterialPicture::Color) return colorPicture(field);
  return picture == MaterialPicture::Normal ? normalPicture(field, m) : surfacePicture(field, m);
}

Result<std::string> encodeMaterialPicture(Image image, MaterialPicture picture) {
  // Of normals, more pixels of less quality are nearer than fewer of more, down to the least
  // quality. Grass and leaves are noise, which takes the most and shows the least.
  constexpr std::array<size_t, 3> kMostBytes{56'000, 44'000, 20'000};
  constexpr int kLeast = 30;
  const bool color = picture == MaterialPicture::Color;
  const int best = color ? 75 : 60;
  for (int quality = best;; quality -= 10) {
    work(kWorkBetweenLooks);
    Result<std::string> bytes = encodeJpeg(image, quality, color);
    if (!bytes.ok() || bytes->size() <= kMostBytes[static_cast<size_t>(picture)]) return bytes;
    if (quality > kLeast) continue;
    image = halved(image);
    quality = best + 10;
  }
}

}  // namespace gable
