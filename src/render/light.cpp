// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The sky is a gradient of four display colours. What lights the scene has the gradient's shape and
// is scaled by channel to the irradiance that a clear sky has beside the sun; what the camera sees
// is the gradient itself, taken back through the tone curve, since a photograph of a facade shows
// its sky a little brighter than it would light the facade.

#include "render/light.h"

#include "math/trig.h"
#include "render/sampler.h"
#include "render/tone.h"

namespace gable::rt {

namespace {

/// Linear colours of the noon sun, balanced for 5,500 K, and of the sky at luminance 1. The sky's
/// tint is between the measured one (0.79, 1.02, 1.46) and its half: the full tint turns shade
/// under pale walls plainly blue.
constexpr Vec3f kSun{1.0f, 0.93f, 0.83f};
constexpr Vec3f kSkyTint{0.86f, 1.01f, 1.30f};
/// Irradiance of the sky on a horizontal plane while the sun gives 1. Measured skies give 0.16; a
/// little more brings a shaded wall to a quarter of a sunlit one without neighbours to light it.
constexpr float kSkyShare = 0.178f;
constexpr double kSunRadius = 0.5;
/// Display level of sunlit stone of albedo 0.55.
constexpr float kStoneAlbedo = 0.55f, kStoneLevel = 211 / 255.0f;

struct Stop {
  double elevation;
  Vec3 color;
};
/// The sky as shown.
const Stop kStops[] = {{0, {0xdd / 255.0, 0xe4 / 255.0, 0xe4 / 255.0}},
                       {10, {0xc3 / 255.0, 0xd7 / 255.0, 0xe4 / 255.0}},
                       {45, {0x8f / 255.0, 0xb4 / 255.0, 0xd8 / 255.0}},
                       {90, {0x4f / 255.0, 0x7d / 255.0, 0xb3 / 255.0}}};

Vec3f shownAt(double elevation) {
  size_t i = 1;
  while (i < 3 && elevation > kStops[i].elevation) ++i;
  const Stop &a = kStops[i - 1], &b = kStops[i];
  const double t = (elevation - a.elevation) / (b.elevation - a.elevation);
  return srgbToLinear(a.color * (1 - t) + b.color * t);
}

double sineOf(int step, int steps) {
  const double t = static_cast<double>(step) / steps;
  return t * t;
}

}  // namespace

Light::Light(const RenderOptions& options, double sunElevation, double sunAzimuth) {
  const double c = cosDeg(sunElevation);
  sunDirection = toVec3f({c * sinDeg(sunAzimuth), sinDeg(sunElevation), -c * cosDeg(sunAzimuth)});
  sunPlan_ = {static_cast<float>(sinDeg(sunAzimuth)), static_cast<float>(-cosDeg(sunAzimuth))};
  groundAlbedo = srgbToLinear(options.groundColor);

  if (options.uniformSky) {
    uniform_ = true;
    light_.fill(toVec3f(*options.uniformSky));
    shown_ = light_;
    ground_ = light_[0];
    skyIrradiance = light_[0] * kPif;
    return;
  }

  // The sun fades and reddens while it sets; dusk leaves a tenth of the sky.
  const float high = static_cast<float>(std::clamp((sunElevation + 1) / 12, 0.0, 1.0));
  const Vec3f reddened = mix({1, 0.45f, 0.18f}, kSun, high);
  sun = sunElevation > 0 ? reddened * high : Vec3f{};
  const float day = static_cast<float>(std::clamp((sunElevation + 8) / 16, 0.02, 1.0));

  Gradient shape;
  for (int i = 0; i <= kSteps; ++i)
    shape[static_cast<size_t>(i)] = shownAt(asinDeg(sineOf(i, kSteps)));
  // Irradiance is the integral of radiance * sine over the solid angle: pi * L d(sine^2).
  Vec3f sum;
  for (int i = 0; i < kSteps; ++i) {
    const double lo = sineOf(i, kSteps), hi = sineOf(i + 1, kSteps);
    const Vec3f mean = (shape[static_cast<size_t>(i)] + shape[static_cast<size_t>(i) + 1]) * 0.5f;
    sum += mean * static_cast<float>(kPi * (hi * hi - lo * lo));
  }
  skyIrradiance = kSkyTint * (kSkyShare * day);
  const Vec3f scale = {skyIrradiance.x / sum.x, skyIrradiance.y / sum.y, skyIrradiance.z / sum.z};
  for (int i = 0; i <= kSteps; ++i) {
    light_[static_cast<size_t>(i)] = shape[static_cast<size_t>(i)] * scale;
  }
  const Vec3f onGround = sun * std::max(0.0f, sunDirection.y) + skyIrradiance;
  ground_ = groundAlbedo * onGround * (1 / kPif);

  // A stone wall that the sun meets at 45 degrees in plan: sun, half the sky, half the ground.
  const float facing = static_cast<float>(std::max(0.0, c) * cosDeg(45));
  const Vec3f onStone = sun * facing + (skyIrradiance + ground_ * kPif) * 0.5f;
  const float wanted =
      luminance(inverseToneMapped(srgbToLinear(Vec3{kStoneLevel, kStoneLevel, kStoneLevel})));
  const float stone = kStoneAlbedo * luminance(onStone) / kPif;
  // Dusk stays darker than noon: the eye does not adapt fully.
  exposure = wanted / stone * static_cast<float>(std::clamp((sunElevation + 8) / 18, 0.06, 1.0));

  for (int i = 0; i <= kSteps; ++i) {
    shown_[static_cast<size_t>(i)] =
        inverseToneMapped(shape[static_cast<size_t>(i)] * std::min(1.0f, 0.25f + 0.75f * day)) *
        (1 / exposure);
  }
}

Vec3f Light::towardsSun(Vec2f u) const {
  const Vec2f d = onDisc(u);
  Vec3f t, b;
  basisAround(sunDirection, t, b);
  const float r = static_cast<float>(tanDeg(kSunRadius));
  return normalized(sunDirection + t * (d.x * r) + b * (d.y * r));
}

Vec3f Light::at(const Gradient& gradient, float up) {
  const float x = std::sqrt(std::clamp(up, 0.0f, 1.0f)) * kSteps;
  const size_t i = std::min<size_t>(kSteps - 1, static_cast<size_t>(x));
  return mix(gradient[i], gradient[i + 1], x - static_cast<float>(i));
}

float Light::sunSide(const Vec3f& d) const {
  const float flat = d.x * sunPlan_.x + d.z * sunPlan_.y;
  return 1 + 0.09f * flat;
}

Vec3f Light::sky(const Vec3f& direction) const {
  if (uniform_) return light_[0];
  if (direction.y < 0) return ground_;
  return at(light_, direction.y) * sunSide(direction);
}

Vec3f Light::shownSky(const Vec3f& direction) const {
  if (uniform_) return shown_[0];
  return at(shown_, direction.y) * sunSide(direction);
}

}  // namespace gable::rt
