// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Three by three glimpses a pixel; a line runs where neighbours differ in thing, plane or depth
// (Saito and Takahashi 1990, Comprehensible Rendering of 3-D Shapes). Outlines are broader than
// creases, creases than changes of material. Ink has a hand: its lines waver by a pixel, shade is
// hatched along the light and dark matter across it, and a thin wash keeps the colours apart.

#include "render/drawing.h"

#include "base/parallel.h"
#include "render/layers.h"
#include "render/reporting.h"
#include "render/sampler.h"
#include "render/tone.h"
#include "render/viewpoint.h"

namespace gable::rt {

namespace {

/// Glimpses along a pixel's side, and those beside a band that its lines reach over.
constexpr int kFine = 3, kMargin = 3;
/// Rows of pixels that a task draws.
constexpr uint32_t kBand = 16;
/// Of lines, by what they divide.
constexpr float kOutline = 1, kGap = 0.8f, kCrease = 0.55f, kSeam = 0.3f, kFoliage = 0.3f;
/// Cosine between normals from which on an edge is a crease.
constexpr float kBent = 0.88f;

constexpr Vec3 kPaper{0xfa / 255.0, 0xf6 / 255.0, 0xec / 255.0};
constexpr Vec3 kInk{0x1d / 255.0, 0x1b / 255.0, 0x1e / 255.0};
constexpr Vec3 kBlue{0x1c / 255.0, 0x4b / 255.0, 0x8c / 255.0};
constexpr Vec3 kChalk{0xe9 / 255.0, 0xf1 / 255.0, 0xfb / 255.0};
/// How much of a colour the wash keeps.
constexpr float kWash = 0.34f;
/// Pixels between hatches and the width of one, in a picture 900 pixels high.
constexpr float kHatch = 6.5f, kHatchWidth = 1.0f;
/// Of the blueprint's grid.
constexpr float kGrid = 40;

Vec3f shown(const Vec3& srgb) { return srgbToLinear(srgb); }

struct Spot {
  Glimpse seen;
  float line = 0;
};

/// Coverage of a line `width` broad, whose middle is `away`.
float stroke(float away, float width) { return std::clamp(width / 2 - away + 0.5f, 0.0f, 1.0f); }

/// Hatches at 45 degrees in either direction.
float hatch(float x, float y, float spacing, float width, bool rising) {
  const float wave = 0.9f * std::sin(y * 0.021f) + 0.9f * std::sin(x * 0.017f + 1);
  const float across = ((rising ? x + y : x - y) * 0.70710678f + wave) / spacing;
  return stroke(std::abs(across - std::floor(across) - 0.5f) * spacing, width);
}

class Drawing {
 public:
  Drawing(const Stage& stage, const Scene& scene, const Camera& camera,
          const RenderOptions& options)
      : stage_(stage), scene_(scene), camera_(camera), options_(options) {
    scale_ = static_cast<float>(std::clamp(options.height / 900.0, 0.5, 8.0));
    pixel_ = static_cast<float>(2 * camera.halfWidth / options.width);
  }

  /// `reporting` is asked row by row; where it says no the band stays black.
  void band(uint32_t y0, uint32_t y1, LinearImage& image, Reporting& reporting) const {
    const int columns = static_cast<int>(options_.width) * kFine + 2 * kMargin;
    const int rows = static_cast<int>(y1 - y0) * kFine + 2 * kMargin;
    std::vector<Spot> spots(static_cast<size_t>(columns) * static_cast<size_t>(rows));
    const auto at = [&](int x, int y) -> Spot& {
      return spots[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
    };
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        at(x, y).seen = look((x - kMargin + 0.5) / kFine,
                             static_cast<double>(y0) + (y - kMargin + 0.5) / kFine);
      }
      if (!reporting.add(0)) return;
    }
    for (int y = 0; y + 1 < rows; ++y) {
      for (int x = 0; x + 1 < columns; ++x) {
        Spot& s = at(x, y);
        s.line = std::max(between(s.seen, at(x + 1, y).seen), between(s.seen, at(x, y + 1).seen));
      }
    }
    for (uint32_t y = y0; y < y1; ++y) {
      for (uint32_t x = 0; x < options_.width; ++x) {
        const int cx = kMargin + static_cast<int>(x) * kFine + kFine / 2;
        const int cy = kMargin + static_cast<int>(y - y0) * kFine + kFine / 2;
        const Vec3f c = inverseToneMapped(colour(at, cx, cy, x, y));
        float* const to = &image.rgb[(static_cast<size_t>(y) * options_.width + x) * 3];
        to[0] = c.x;
        to[1] = c.y;
        to[2] = c.z;
      }
    }
  }

 private:
  bool ink() const { return options_.look == PictureLook::Ink; }

  Glimpse look(double x, double y) const {
    if (ink()) {
      // A hand's tremor, the same for all lines that pass.
      const double reach = 0.55 * static_cast<double>(scale_);
      const double u = x / static_cast<double>(scale_), v = y / static_cast<double>(scale_);
      const double tx =
          std::sin(v * 0.11 + 2 * std::sin(u * 0.023)) + std::sin(v * 0.031 + u * 0.017);
      const double ty =
          std::sin(u * 0.097 + 2 * std::sin(v * 0.027)) + std::sin(u * 0.037 - v * 0.013);
      x += reach * tx;
      y += reach * ty;
    }
    const double w = options_.width, h = options_.height;
    return glimpse(stage_, scene_, camera_, cameraRay(camera_, w / h, x / w, 1 - y / h));
  }

  /// How strong a line is between two neighbours.
  float between(const Glimpse& a, const Glimpse& b) const {
    const bool skyA = a.depth == 0, skyB = b.depth == 0;
    if (skyA && skyB) return 0;
    if (skyA != skyB) return (skyA ? b : a).isGround ? 0 : kOutline;
    if (a.isGround && b.isGround) return 0;
    if (a.isCut != b.isCut) return kOutline;
    const bool foliage = a.matter == Matter::Foliage && b.matter == Matter::Foliage;
    const float depth = std::min(a.depth, b.depth);
    const float fine = pixel_ * (camera_.parallel ? 1 : depth) / kFine;
    // How far each lies off the plane of the other; a slope's own step does not count.
    const Vec3f to = b.point - a.point;
    const float off = std::min(std::abs(dot(to, a.normal)), std::abs(dot(to, b.normal)));
    const float gap = off / (0.03f + 2.5f * fine);
    // Far off, lines would lie closer than the pen is broad.
    const float far = std::clamp(0.07f / fine, 0.35f, 1.0f);
    if (foliage) return off > 0.5f + 4 * fine ? kFoliage * far : 0;
    if (gap > 12) return kOutline * std::max(far, 0.5f);
    if (gap > 1) return kGap * far;
    if (dot(a.normal, b.normal) < kBent) return kCrease * far;
    if (a.material != b.material || a.isGround != b.isGround) return kSeam * far;
    return 0;
  }

  template <class At>
  Vec3f colour(const At& at, int cx, int cy, uint32_t x, uint32_t y) const {
    float line = 0;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        float here = at(cx + i, cy + j).line;
        // Strong lines reach over their neighbours.
        for (int k = 0; k < 4; ++k) {
          const int dx = k == 0 ? -1 : k == 1 ? 1 : 0, dy = k == 2 ? -1 : k == 3 ? 1 : 0;
          here = std::max(here, 1.6f * at(cx + i + dx, cy + j + dy).line - 0.6f);
        }
        line += here;
      }
    }
    line = std::min(1.0f, line * (1.5f / (kFine * kFine)));
    const Glimpse& g = at(cx, cy).seen;
    return ink() ? inked(g, line, x, y) : printed(g, line, x, y);
  }

  bool isLit(const Glimpse& g) const {
    const Vec3f& sun = stage_.light.sunDirection;
    if (sun.y <= 0) return true;
    if (dot(g.normal, sun) <= 0) return false;
    Ray shadow;
    shadow.origin = offsetFrom(g.point, g.normal, sun);
    shadow.origin += g.normal * (0.002f + 2e-4f * g.depth);
    shadow.direction = sun;
    return visibility(stage_, shadow) > 0.5f;
  }

  Vec3f inked(const Glimpse& g, float line, uint32_t x, uint32_t y) const {
    const Vec3f paper = shown(kPaper), pen = shown(kInk);
    if (g.depth == 0) return mix(paper, pen, line);
    if (g.isCut) return mix(paper, pen, 0.93f);
    Vec3f c = paper;
    if (!g.isGround) {
      const Vec3f pale = {std::sqrt(g.albedo.x), std::sqrt(g.albedo.y), std::sqrt(g.albedo.z)};
      c = c * mix({1, 1, 1}, pale, kWash);
    }
    const float px = static_cast<float>(x), py = static_cast<float>(y);
    float dark = 0;
    if (!isLit(g)) {
      c = c * Vec3f{0.88f, 0.89f, 0.91f};
      dark = 0.8f * hatch(px, py, kHatch * scale_, kHatchWidth * scale_, true);
      if (g.normal.y < -0.3f) {
        dark = std::max(dark, hatch(px, py, kHatch * scale_, kHatchWidth * scale_, false));
      }
    }
    if (!g.isGround && (g.isPane || luminance(g.albedo) < 0.09f)) {
      dark =
          std::max(dark, 0.7f * hatch(px, py, 0.7f * kHatch * scale_, kHatchWidth * scale_, false));
    }
    return mix(c, pen, std::max(line, dark));
  }

  Vec3f printed(const Glimpse& g, float line, uint32_t x, uint32_t y) const {
    const Vec3f chalk = shown(kChalk);
    Vec3f c = shown(kBlue);
    const float px = static_cast<float>(x), py = static_cast<float>(y), cell = kGrid * scale_;
    const auto off = [cell](float v) {
      const float f = v / cell;
      return std::abs(f - std::floor(f + 0.5f)) * cell;
    };
    if (g.depth == 0 || g.isGround) {
      c = mix(c, chalk, 0.07f * std::max(stroke(off(px), 1), stroke(off(py), 1)));
    } else if (g.isCut) {
      c = mix(c, chalk, 0.25f + 0.5f * hatch(px, py, kHatch * scale_, kHatchWidth * scale_, true));
    } else {
      // A breath of chalk on what looks at the sun keeps the volumes apart.
      const float facing = std::max(0.0f, dot(g.normal, stage_.light.sunDirection));
      c = mix(c, chalk, (g.isPane ? 0.0f : 0.02f) + 0.09f * facing);
    }
    return mix(c, chalk, 0.95f * line);
  }

  const Stage& stage_;
  const Scene& scene_;
  const Camera& camera_;
  const RenderOptions& options_;
  float scale_ = 1;
  /// A pixel's side at distance 1, or in metres with a parallel camera.
  float pixel_ = 0;
};

}  // namespace

bool drawLines(const Stage& stage, const Scene& scene, const Camera& camera,
               const RenderOptions& options, LinearImage& image) {
  image.width = options.width;
  image.height = options.height;
  image.rgb.assign(static_cast<size_t>(options.width) * options.height * 3, 0);
  const Drawing drawing(stage, scene, camera, options);
  const size_t bands = (options.height + kBand - 1) / kBand;
  Reporting reporting(options, static_cast<double>(bands));
  parallelFor(bands, options.threads, [&](size_t band, unsigned) {
    if (reporting.ended()) return;
    const uint32_t y0 = static_cast<uint32_t>(band) * kBand;
    drawing.band(y0, std::min(y0 + kBand, options.height), image, reporting);
    reporting.add(1);
  });
  return !reporting.ended();
}

}  // namespace gable::rt
