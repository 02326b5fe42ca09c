// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The curve is Narkowicz's fit of the ACES reference transform. As in AgX, colours are first drawn
// towards their luminance and spread again after the curve, so that bright saturated light goes to
// white instead of turning its hue.

#include "render/tone.h"

#include <algorithm>
#include <array>
#include <vector>

#include "math/trig.h"
#include "render/render.h"
#include "render/sampler.h"

namespace gable {

namespace rt {

namespace {

/// Exposure of the fit, which expects brighter light than 1 for white.
constexpr float kBefore = 0.56f;
/// Slope at black, over 0.14. The fit has 0.03 and crushes shade; film and eye do not.
constexpr float kToe = 0.08f;
/// How far colours are drawn together before the curve, and apart after it. The curve's own
/// contrast spreads colours too: with these, sunlit brick and leaves keep the saturation of their
/// base colours within a tenth.
constexpr float kInset = 0.27f, kOutset = 1.20f;

constexpr float curve(float x) {
  return (x * (2.51f * x + kToe)) / (x * (2.43f * x + 0.59f) + 0.14f);
}

/// The positive root of curve(x) = y.
float inverseCurve(float y) {
  const float a = 2.43f * y - 2.51f, b = 0.59f * y - kToe, c = 0.14f * y;
  return (-b - std::sqrt(std::max(0.0f, b * b - 4 * a * c))) / (2 * a);
}

Vec3f spread(const Vec3f& c, float by) {
  const float grey = luminance(c);
  return mix({grey, grey, grey}, c, by);
}

Vec3f clamped(const Vec3f& c, float lo, float hi) {
  return {std::clamp(c.x, lo, hi), std::clamp(c.y, lo, hi), std::clamp(c.z, lo, hi)};
}

}  // namespace

float srgbToLinear(float v) {
  if (v <= 0.04045f) return v / 12.92f;
  return static_cast<float>(powOf((static_cast<double>(v) + 0.055) / 1.055, 2.4));
}

float linearToSrgb(float v) {
  if (v <= 0.0031308f) return v * 12.92f;
  return static_cast<float>(1.055 * powOf(static_cast<double>(v), 1 / 2.4) - 0.055);
}

Vec3f srgbToLinear(const Vec3& c) {
  const Vec3f v = clamped(toVec3f(c), 0, 1);
  return {srgbToLinear(v.x), srgbToLinear(v.y), srgbToLinear(v.z)};
}

namespace {

/// The levels of even steps of the root of the light.
class SrgbLevels {
 public:
  SrgbLevels() {
    for (size_t i = 0; i < levels_.size(); ++i) {
      const float root = std::min(1.0f, static_cast<float>(i) / kSteps);
      levels_[i] = 255 * linearToSrgb(root * root);
    }
  }

  float of(float v) const {
    const float at = std::sqrt(v) * kSteps;
    const size_t cell = static_cast<size_t>(at);
    const float f = at - static_cast<float>(cell);
    return levels_[cell] * (1 - f) + levels_[cell + 1] * f;
  }

 private:
  static constexpr size_t kSteps = 4096;
  std::array<float, kSteps + 2> levels_;
};

}  // namespace

float srgbLevel(float v) {
  static const SrgbLevels levels;
  return levels.of(v);
}

Vec3f toneMapped(const Vec3f& light) {
  const Vec3f c = clamped(spread(light, 1 - kInset) * kBefore, 0, 1e4f);
  const Vec3f shown = {curve(c.x), curve(c.y), curve(c.z)};
  return clamped(spread(shown, kOutset), 0, 1);
}

Vec3f inverseToneMapped(const Vec3f& shown) {
  const Vec3f c = clamped(spread(shown, 1 / kOutset), 0, 0.98f);
  const Vec3f x = {inverseCurve(c.x), inverseCurve(c.y), inverseCurve(c.z)};
  return clamped(spread(x * (1 / kBefore), 1 / (1 - kInset)), 0, 1e4f);
}

}  // namespace rt

std::vector<uint8_t> toRgba8(const LinearImage& image) {
  using namespace rt;
  const size_t pixels = static_cast<size_t>(image.width) * image.height;
  std::vector<uint8_t> rgba(pixels * 4, 255);
  if (image.rgb.size() < pixels * 3) return rgba;

  for (size_t i = 0; i < pixels; ++i) {
    const Vec3f shown = toneMapped({image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]});
    // One dither value for the three channels keeps grey areas grey.
    const float dither = toUnit(mix32(static_cast<uint32_t>(i) + 0x51ed27U));
    const float channel[3] = {shown.x, shown.y, shown.z};
    for (size_t k = 0; k < 3; ++k) {
      rgba[4 * i + k] =
          static_cast<uint8_t>(std::clamp(srgbLevel(channel[k]) + dither, 0.0f, 255.0f));
    }
  }
  return rgba;
}

}  // namespace gable
