// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Waves are a sum of sines about one wind, their lengths a geometric series, each as steep as the
// next, which is what a light breeze makes (Tessendorf 2001 has the measured spectrum). Gusts make
// some patches calmer than others. Waves that are too fine to be seen count by how their slopes
// vary (Olano and Baker 2010, LEAN Mapping): drawn one by one, they would make the sun's glitter a
// scatter of white dots.

#include "render/water.h"

#include <algorithm>
#include <array>

#include "math/trig.h"
#include "render/sampler.h"

namespace gable::rt {

namespace {

constexpr int kWaves = 20;
/// Metres from crest to crest.
constexpr float kLongest = 6, kShortest = 0.16f;
/// Each wave's slope, and how far they stray from the wind.
constexpr float kSlope = 0.0125f;
constexpr double kWind = 30, kStray = 75;
/// What the eye tells apart, in radians.
constexpr float kSharpEye = 0.0016f;
/// Relative absorption of red, green and blue.
constexpr Vec3f kAbsorption{1.9f, 0.75f, 0.62f};

struct Wave {
  float x, z, phase, length;
};

const std::array<Wave, kWaves>& waves() {
  static const std::array<Wave, kWaves> all = [] {
    std::array<Wave, kWaves> w;
    for (int i = 0; i < kWaves; ++i) {
      const float share = static_cast<float>(i) / (kWaves - 1);
      const float length = kLongest * std::pow(kShortest / kLongest, share);
      const double draw = static_cast<double>(mix32(static_cast<uint32_t>(i) + 77)) * 0x1p-32;
      const double angle = kWind + kStray * (2 * std::fmod(0.618034 * i + 0.3, 1.0) - 1);
      const float k = 2 * kPif / length;
      w[static_cast<size_t>(i)] = {static_cast<float>(cosDeg(angle)) * k,
                                   static_cast<float>(sinDeg(angle)) * k,
                                   static_cast<float>(2 * kPi * draw), length};
    }
    return w;
  }();
  return all;
}

/// 0.4 to 1.2 over tens of metres.
float gust(const Vec3f& p) {
  return 0.8f + 0.2f * std::sin(p.x / 11 + 1.3f * std::sin(p.z / 17)) +
         0.2f * std::sin(p.z / 7.3f + 1.7f * std::sin(p.x / 23));
}

/// What a pixel covers of a level surface: it is longer along the view the flatter one looks.
struct Footprint {
  float x, z, width, length;

  Footprint(const Vec3f& direction, float pixel) : width(pixel) {
    const float flat = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    x = flat > 0 ? direction.x / flat : 1;
    z = flat > 0 ? direction.z / flat : 0;
    length = pixel / std::max(1e-3f, std::abs(direction.y));
  }

  /// Its extent along the unit vector (u, w) of the plane.
  float along(float u, float w) const {
    const float ahead = (x * u + z * w) * length, aside = (x * w - z * u) * width;
    return std::sqrt(ahead * ahead + aside * aside);
  }
};

}  // namespace

void makeWater(Surface& s, const Vec3f& direction, float distance, float width) {
  if (s.opacity < 1) {
    // The share that is left after a metre is 1 - opacity.
    s.clearWater = s.opacity > 0 ? -1 / std::log(1 - s.opacity) : 1e6f;
    s.opacity = 1;
  }
  if (std::abs(s.facet.y) < 0.9f) return;
  const float strength = gust(s.point) * kSlope;
  const float eye = distance * kSharpEye;
  const Footprint footprint(direction, width);
  float slopeX = 0, slopeZ = 0, lost = 0;
  for (const Wave& w : waves()) {
    const float k = 2 * kPif / w.length;
    const float finest = std::max({eye, footprint.along(w.x / k, w.z / k), 1e-6f});
    const float seen = std::clamp((w.length / finest - 1) / 3, 0.0f, 1.0f);
    const float slope = strength * seen;
    lost += strength * strength * (1 - seen * seen) / 2;
    if (slope <= 0) continue;
    const float c = std::cos(w.x * s.point.x + w.z * s.point.z + w.phase) * slope / k;
    slopeX += c * w.x;
    slopeZ += c * w.z;
  }
  const float side = s.facet.y < 0 ? -1.0f : 1.0f;
  s.normal = normalized({-slopeX * side, side, -slopeZ * side});
  s.roughness = std::sqrt(std::sqrt(0.02f * 0.02f * 0.02f * 0.02f + 2 * lost));
}

Vec3f refracted(const Vec3f& direction, const Vec3f& normal, float index) {
  const float cosine = -dot(direction, normal), ratio = 1 / index;
  const float rest = 1 - ratio * ratio * (1 - cosine * cosine);
  if (rest <= 0) return {};
  return normalized(direction * ratio + normal * (ratio * cosine - std::sqrt(rest)));
}

Vec3f throughWater(float metres, float clearness) {
  const float t = -metres / clearness;
  return {std::exp(t * kAbsorption.x), std::exp(t * kAbsorption.y), std::exp(t * kAbsorption.z)};
}

}  // namespace gable::rt
