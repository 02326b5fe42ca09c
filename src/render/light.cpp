// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The physical sky is balanced as film and eye do it: at a sun of 38 degrees, stone in the sun is
// almost white and its shade cool but not blue. What the camera sees of the sky has a balance of
// its own, since a photograph of a facade shows its sky a little brighter than it would light the
// facade. Both balances are factors by channel, so the sky keeps its gradients and its hours.

#include "render/light.h"

#include "math/trig.h"
#include "render/sampler.h"
#include "render/tone.h"

namespace gable::rt {

namespace {

/// The sun for which pictures are balanced.
constexpr double kBalanced = 38;
/// Linear colours of that sun, for 5,500 K, and of its sky at luminance 1. The sky's tint is
/// between the measured one (0.79, 1.02, 1.46) and its half: the full tint turns shade under pale
/// walls plainly blue.
constexpr Vec3f kSun{1.0f, 0.93f, 0.83f};
constexpr Vec3f kSkyTint{0.86f, 1.01f, 1.30f};
/// Irradiance of the sky on a horizontal plane while the sun gives 1. Measured skies give 0.16; a
/// little more brings a shaded wall to a quarter of a sunlit one without neighbours to light it.
constexpr float kSkyShare = 0.178f;
/// How that sky is shown at 45 degrees, across from the sun.
constexpr Vec3 kShownSky{0x7d / 255.0, 0xa7 / 255.0, 0xd1 / 255.0};
constexpr double kSunRadius = 0.5;
/// Display level of sunlit stone of albedo 0.55.
constexpr float kStoneAlbedo = 0.55f, kStoneLevel = 211 / 255.0f;

/// The least that a night has, as light on a level surface: a moon behind clouds.
constexpr float kNightShare = 2e-5f;
constexpr Vec3f kNightTint{0.62f, 0.85f, 1.6f};
/// The least share of the day's brightness that a picture of the night has.
constexpr double kNightLevel = 0.045;
/// An emissive 1 shows a little under white by day and far above it at night.
constexpr float kGlowByDay = 0.9f, kGlowAtNight = 5;
/// How much brighter than they are shown lamps are at night.
constexpr float kLampPower = 600;
/// How much of a moonlit sky is shown, at the horizon and above: to an eye that lamps dazzle it is
/// dark.
constexpr float kDarkHorizon = 0.3f, kDarkAbove = 0.13f;
/// Stars: cells along the side of a cube about the eye, the share of cells with one, and the radius
/// in radians of its disc.
constexpr float kStarCells = 90, kStarShare = 0.11f, kStarRadius = 0.0008f;
/// Sine of the elevation whose sky stands for the light of haze.
constexpr float kHazeUp = 0.05f;
constexpr int kHorizonSteps = 256;
/// The sun's disc, and the radius in degrees of the glare that a lens adds.
constexpr float kShownDisc = 40, kGlare = 2.2f;

/// The sky for which pictures are balanced.
const Sky& balancedSky() {
  static const Sky sky(kBalanced);
  return sky;
}

/// By day film is balanced for the day; at dusk a balance that takes the blue from shade would make
/// everything red.
Vec3f dusky(const Vec3f& scale, double sunElevation) {
  const float day = static_cast<float>(std::clamp((sunElevation + 2) / 16, 0.0, 1.0));
  const float even = luminance(scale);
  return mix({even, even, even}, scale, day * day * (3 - 2 * day));
}

/// In the dark the eye sees less of colours, and red least of all.
constexpr Vec3f kDarkTint{0.72f, 0.92f, 1.4f};
Vec3f adapted(const Vec3f& light, float night) {
  return mix(light, kDarkTint * luminance(light), 0.62f * night);
}

Vec3f over(const Vec3f& a, const Vec3f& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

/// Display levels of stone and sky as light before the exposure.
float stoneWanted() {
  return luminance(inverseToneMapped(srgbToLinear(Vec3{kStoneLevel, kStoneLevel, kStoneLevel})));
}

/// The exposure for stone in that light.
float exposureFor(const Vec3f& onStone) {
  return stoneWanted() / (kStoneAlbedo * luminance(onStone) / kPif);
}

/// On a stone wall that the sun meets at 45 degrees in plan: sun, half the sky, half the ground.
Vec3f onStone(double elevation, const Vec3f& sun, const Vec3f& sky, const Vec3f& ground) {
  const float facing = static_cast<float>(std::max(0.0, cosDeg(elevation) * cosDeg(45)));
  return sun * facing + (sky + ground * kPif) * 0.5f;
}

}  // namespace

Vec3f towardsSun(double elevation, double azimuth) {
  const double flat = cosDeg(elevation);
  return toVec3f({flat * sinDeg(azimuth), sinDeg(elevation), -flat * cosDeg(azimuth)});
}

Light::Light(const RenderOptions& options, double sunElevation, double sunAzimuth,
             std::shared_ptr<const Clouds> clouds)
    : clouds_(std::move(clouds)) {
  sunDirection = rt::towardsSun(sunElevation, sunAzimuth);
  sunPlan_ = {static_cast<float>(sinDeg(sunAzimuth)), static_cast<float>(-cosDeg(sunAzimuth))};
  groundAlbedo = srgbToLinear(options.groundColor);
  basisAround(sunDirection, acrossSun_, upSun_);
  sunRadius_ = static_cast<float>(tanDeg(kSunRadius));

  if (options.uniformSky) {
    uniform_ = ground_ = toVec3f(*options.uniformSky);
    skyIrradiance = uniform_ * kPif;
    shownGlow = glow = kGlowByDay;
    return;
  }

  const Sky& balanced = balancedSky();
  sky_.emplace(sunElevation, options.haziness);
  sun = sky_->sun * over(kSun, balanced.sun);
  lightScale_ = dusky(over(kSkyTint * kSkyShare, balanced.irradiance), sunElevation);
  nightLight_ = kNightTint * (kSkyShare * kNightShare / kPif);
  night = static_cast<float>(std::clamp((2 - sunElevation) / 8, 0.0, 1.0));
  night = night * night * (3 - 2 * night);
  dark_ = static_cast<float>(std::clamp((-3 - sunElevation) / 9, 0.0, 1.0));
  skyIrradiance = adapted(sky_->irradiance, night) * lightScale_ + nightLight_ * kPif;
  const auto groundUnder = [&](const Vec3f& sunlight, double elevation, const Vec3f& sky) {
    const float up = static_cast<float>(std::max(0.0, sinDeg(elevation)));
    return groundAlbedo * (sunlight * up + sky) * (1 / kPif);
  };
  ground_ = groundUnder(sun, sunElevation, skyIrradiance);

  // Dusk stays darker than noon: the eye does not adapt fully.
  const double level = std::clamp((sunElevation + 8) / 18, kNightLevel, 1.0);
  exposure =
      exposureFor(onStone(sunElevation, sun, skyIrradiance, ground_)) * static_cast<float>(level);
  shownGlow = (kGlowByDay + (kGlowAtNight - kGlowByDay) * night) / exposure;
  glow = shownGlow * (1 + (kLampPower - 1) * night) * static_cast<float>(options.lampPower);

  const float exposureThen = exposureFor(onStone(
      kBalanced, kSun, kSkyTint * kSkyShare, groundUnder(kSun, kBalanced, kSkyTint * kSkyShare)));
  const Vec3f shown = inverseToneMapped(srgbToLinear(kShownSky)) * (1 / exposureThen);
  shownScale_ =
      dusky(over(shown, balanced.radiance(static_cast<float>(sinDeg(45)), 0)), sunElevation);
  nightShown_ = nightLight_ * over(shownScale_, lightScale_);
  makeHorizon();
}

Vec3f Light::towardsSun(Vec2f u) const {
  const Vec2f d = onDisc(u);
  return normalized(sunDirection + acrossSun_ * (d.x * sunRadius_) + upSun_ * (d.y * sunRadius_));
}

float Light::cosineFromSun(const Vec3f& d) const {
  const float flat = std::sqrt(d.x * d.x + d.z * d.z);
  return flat > 0 ? (d.x * sunPlan_.x + d.z * sunPlan_.y) / flat : 0;
}

Vec3f Light::radiance(const Vec3f& d, float up) const {
  return adapted(sky_->radiance(up, cosineFromSun(d)), night);
}

Vec3f Light::sky(const Vec3f& direction) const {
  if (!sky_) return uniform_;
  if (direction.y < 0) return ground_;
  return radiance(direction, direction.y) * lightScale_ + nightLight_;
}

Vec3f Light::shownSky(const Vec3f& direction) const {
  return behindClouds(shownAir(direction), direction);
}

Vec3f Light::shown(const Vec3f& direction) const {
  return behindClouds(shownAir(direction) + shownSun(direction) + shownStars(direction), direction);
}

Vec3f Light::behindClouds(const Vec3f& behind, const Vec3f& d) const {
  if (!clouds_) return behind;
  const Vec3f fromSun{d.x * sunPlan_.x + d.z * sunPlan_.y, d.y,
                      d.z * sunPlan_.x - d.x * sunPlan_.y};
  const Clouds::Seen seen = clouds_->seen(fromSun);
  const Vec3f lit =
      sun * (seen.sun * Clouds::forward(dot(d, sunDirection))) + skyIrradiance * seen.sky;
  return behind * seen.clear + lit * shownShare(d.y);
}

Vec3f Light::shownAir(const Vec3f& direction) const {
  if (!sky_) return uniform_;
  return (radiance(direction, direction.y) * shownScale_ + nightShown_) * shownShare(direction.y);
}

Vec3f Light::horizon(const Vec3f& direction) const {
  if (!sky_) return uniform_;
  const float half = std::clamp((1 - cosineFromSun(direction)) / 2, 0.0f, 1.0f);
  const float at = std::sqrt(std::sqrt(half)) * kHorizonSteps;
  const size_t cell = std::min<size_t>(kHorizonSteps - 1, static_cast<size_t>(at));
  return mix(horizon_[cell], horizon_[cell + 1], at - static_cast<float>(cell));
}

void Light::makeHorizon() {
  for (int i = 0; i <= kHorizonSteps; ++i) {
    const float root = static_cast<float>(i) / kHorizonSteps, half = root * root * root * root;
    const Vec3f seen = adapted(sky_->radiance(kHazeUp, 1 - 2 * half), night);
    horizon_.push_back((seen * shownScale_ + nightShown_) * shownShare(kHazeUp));
  }
}

float Light::shownShare(float up) const {
  const float above = std::sqrt(std::clamp(up, 0.0f, 1.0f));
  return 1 + dark_ * (kDarkHorizon + (kDarkAbove - kDarkHorizon) * above - 1);
}

Vec3f Light::shownStars(const Vec3f& d) const {
  if (!sky_ || dark_ <= 0 || d.y <= 0) return {};
  // On the face of a cube about the eye, in cells with one star at most.
  const float ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  const bool onX = ax >= ay && ax >= az, onY = !onX && ay >= az;
  const float w = onX ? d.x : onY ? d.y : d.z, u = onX ? d.y : d.x, v = onX || onY ? d.z : d.y;
  const float s = (u / std::abs(w) + 1) * (kStarCells / 2);
  const float t = (v / std::abs(w) + 1) * (kStarCells / 2);
  const uint32_t face = (onX ? 0u : onY ? 2u : 4u) + (w < 0 ? 1u : 0u);
  const uint32_t cell =
      mix32(static_cast<uint32_t>(s) + mix32(static_cast<uint32_t>(t) + mix32(face + 0x5741u)));
  const auto draw = [cell](uint32_t k) { return drawnBy(cell, k); };
  if (draw(1) >= kStarShare) return {};
  // A cell is this wide where it is, in radians.
  const float wide = 2 * w * w / kStarCells;
  const float du = s - std::floor(s) - 0.15f - 0.7f * draw(2);
  const float dv = t - std::floor(t) - 0.15f - 0.7f * draw(3);
  const float away = std::sqrt(du * du + dv * dv) * wide / kStarRadius;
  if (away >= 1) return {};
  // Few are bright; haze takes those near the horizon.
  const float bright = draw(4), power = 0.12f + 1.6f * bright * bright * bright * bright * bright;
  const float clear = std::clamp((d.y - 0.03f) / 0.35f, 0.0f, 1.0f);
  const Vec3f tint = mix({1, 0.86f, 0.72f}, {0.78f, 0.88f, 1}, draw(5));
  return tint * (dark_ * dark_ * clear * power * (1 - away * away) / exposure);
}

Vec3f Light::shownSun(const Vec3f& direction) const {
  if (!sky_ || maxOf(sun) <= 0) return {};
  const float sine = length(cross(direction, sunDirection));
  if (dot(direction, sunDirection) <= 0) return {};
  const float degrees = sine * (180 / kPif);
  const Vec3f colour = sun * (1 / (std::max(1e-6f, luminance(sun)) * exposure));
  if (degrees < kSunRadius / 2) return colour * kShownDisc;
  const float glare = std::exp(-degrees / kGlare) * std::min(1.0f, luminance(sun) * 2);
  return colour * (0.6f * glare);
}

}  // namespace gable::rt
