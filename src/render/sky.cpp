// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Hillaire 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique: single
// scattering along the view, with all further orders as a geometric series of isotropic ones. The
// air is that of Bruneton and Neyret 2008, with the ozone of Bruneton 2017. Lengths in kilometres.

#include "render/sky.h"

#include <array>
#include <optional>

#include "math/trig.h"
#include "render/sampler.h"

namespace gable::rt {

namespace {

constexpr float kGround = 6360, kTop = 6460;
/// Where the camera stands above the sea.
constexpr float kEye = kGround + 0.2f;
constexpr Vec3f kRayleigh{5.802e-3f, 13.558e-3f, 33.1e-3f};
constexpr float kMie = 3.996e-3f, kMieExtinction = 4.44e-3f, kMieForward = 0.8f;
constexpr Vec3f kOzone{0.650e-3f, 1.881e-3f, 0.085e-3f};
constexpr float kRayleighHeight = 8, kMieHeight = 1.2f;
constexpr float kEarthAlbedo = 0.2f;
constexpr Vec3f kOne{1, 1, 1};

/// Steps of the table of radiance, by the square root of the sine of elevation and that of the
/// angle from the sun.
constexpr int kUps = 64, kAsides = 48;

Vec3f decay(const Vec3f& v) { return {std::exp(v.x), std::exp(v.y), std::exp(v.z)}; }

struct Air {
  Vec3f rayleigh;
  float mie = 0;
  Vec3f extinction;
};

/// A point on a ray through the air: distance from the Earth's centre, and the cosine between the
/// ray and the way up.
struct Place {
  float radius, up;
  Place along(float t) const {
    const float r = std::sqrt(std::max(0.0f, radius * radius + t * t + 2 * radius * up * t));
    return {r, std::clamp((radius * up + t) / std::max(1.0f, r), -1.0f, 1.0f)};
  }
  bool meetsGround() const {
    return up < 0 && radius * radius * (up * up - 1) + kGround * kGround >= 0;
  }
  float toGround() const {
    const float d = radius * radius * (up * up - 1) + kGround * kGround;
    return std::max(0.0f, -radius * up - std::sqrt(std::max(0.0f, d)));
  }
  float toTop() const {
    const float d = radius * radius * (up * up - 1) + kTop * kTop;
    return std::max(0.0f, -radius * up + std::sqrt(std::max(0.0f, d)));
  }
};

class Atmosphere {
 public:
  explicit Atmosphere(float haze) : haze_(haze) {
    for (int h = 0; h < kHeights; ++h) {
      for (int u = 0; u < kAngles; ++u) clear_[cell(h, u)] = tracedClearness(h, u);
    }
    for (int h = 0; h < kMultiHeights; ++h) {
      for (int u = 0; u < kMultiAngles; ++u)
        multi_[static_cast<size_t>(h * kMultiAngles + u)] = gathered(h, u);
    }
  }

  Air at(float radius) const {
    const float h = std::max(0.0f, radius - kGround);
    Air air;
    air.rayleigh = kRayleigh * std::exp(-h / kRayleighHeight);
    const float dust = haze_ * std::exp(-h / kMieHeight);
    air.mie = kMie * dust;
    const float ozone = std::max(0.0f, 1 - std::abs(h - 25) / 15);
    air.extinction = air.rayleigh + kOne * (kMieExtinction * dust) + kOzone * ozone;
    return air;
  }

  /// Share of light that comes through the air from outside, from a direction; none through the
  /// Earth.
  Vec3f clearness(const Place& p) const {
    if (p.meetsGround()) return {};
    const float rho = std::sqrt(std::max(0.0f, p.radius * p.radius - kGround * kGround));
    const float least = kTop - p.radius, most = rho + horizon();
    const float u = (p.toTop() - least) / std::max(1e-3f, most - least);
    return interpolated(clear_, kHeights, kAngles, rho / horizon(), u);
  }

  /// Light of all orders above the first that a point sends into each direction, over its
  /// scattering.
  Vec3f multiple(float radius, float sunUp) const {
    return interpolated(multi_, kMultiHeights, kMultiAngles,
                        std::sqrt(std::max(0.0f, radius - kGround) / (kTop - kGround)),
                        multiShare(sunUp));
  }

 private:
  static constexpr int kHeights = 32, kAngles = 96, kMultiHeights = 12, kMultiAngles = 48;
  static constexpr int kSteps = 40, kDirections = 48, kMultiSteps = 16;

  static size_t cell(int h, int u) { return static_cast<size_t>(h * kAngles + u); }
  /// From sea level to the edge of the air, along the horizon.
  static float horizon() { return std::sqrt(kTop * kTop - kGround * kGround); }
  /// Finer about the horizon, where twilight happens.
  static float multiShare(float up) {
    return 0.5f + 0.5f * std::copysign(std::sqrt(std::abs(up)), up);
  }

  static Vec3f interpolated(const std::vector<Vec3f>& table, int rows, int columns, float row,
                            float column) {
    const float y = std::clamp(row, 0.0f, 1.0f) * static_cast<float>(rows - 1);
    const float x = std::clamp(column, 0.0f, 1.0f) * static_cast<float>(columns - 1);
    const int j = std::min(rows - 2, static_cast<int>(y));
    const int i = std::min(columns - 2, static_cast<int>(x));
    const Vec3f* const t = &table[static_cast<size_t>(j * columns + i)];
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    return mix(mix(t[0], t[1], fx), mix(t[columns], t[columns + 1], fx), fy);
  }

  Vec3f tracedClearness(int h, int u) const {
    const float rho = horizon() * static_cast<float>(h) / (kHeights - 1);
    const float radius = std::sqrt(rho * rho + kGround * kGround);
    const float least = kTop - radius, most = rho + horizon();
    const float way = least + (most - least) * static_cast<float>(u) / (kAngles - 1);
    const float up =
        way > 0 ? (kTop * kTop - radius * radius - way * way) / (2 * radius * way) : 1.0f;
    const Place p{radius, std::clamp(up, -1.0f, 1.0f)};
    Vec3f depth;
    for (int i = 0; i < kSteps; ++i) {
      depth += at(p.along(way * (static_cast<float>(i) + 0.5f) / kSteps).radius).extinction;
    }
    return decay(depth * (-way / kSteps));
  }

  /// The second order at a point, and the share of light that is scattered into it again: their
  /// quotient sums up all orders.
  Vec3f gathered(int h, int u) const {
    const float share = static_cast<float>(h) / (kMultiHeights - 1);
    const float radius = kGround + std::max(0.01f, share * share * (kTop - kGround) * 0.999f);
    const float m = 2 * static_cast<float>(u) / (kMultiAngles - 1) - 1;
    const float sunUp = m * std::abs(m);
    const Vec3f toSun{std::sqrt(std::max(0.0f, 1 - sunUp * sunUp)), sunUp, 0};
    Vec3f light, again;
    for (int d = 0; d < kDirections; ++d) {
      // Even over the sphere: the golden spiral.
      const float y = 1 - 2 * (static_cast<float>(d) + 0.5f) / kDirections;
      const float flat = std::sqrt(1 - y * y), a = 2.3999632f * static_cast<float>(d);
      gatherFrom({radius, y}, {flat * std::cos(a), y, flat * std::sin(a)}, toSun, light, again);
    }
    const Vec3f l = light * (1.0f / kDirections), f = again * (1.0f / kDirections);
    return {l.x / (1 - f.x), l.y / (1 - f.y), l.z / (1 - f.z)};
  }

  void gatherFrom(const Place& p, const Vec3f& direction, const Vec3f& toSun, Vec3f& light,
                  Vec3f& again) const {
    const bool down = p.meetsGround();
    const float way = down ? p.toGround() : p.toTop(), step = way / kMultiSteps;
    Vec3f through = kOne;
    for (int i = 0; i < kMultiSteps; ++i) {
      const float t = step * (static_cast<float>(i) + 0.5f);
      const Place at3 = p.along(t);
      const Air air = at(at3.radius);
      const Vec3f scattering = air.rayleigh + kOne * air.mie;
      const Vec3f kept = decay(air.extinction * -step);
      const Vec3f part = through * (kOne - kept) * over(scattering, air.extinction);
      light +=
          part * clearness({at3.radius, sunUpAt(p.radius, direction, t, toSun)}) * (1 / (4 * kPif));
      again += part;
      through *= kept;
    }
    if (!down) return;
    const float sunUp = sunUpAt(p.radius, direction, way, toSun);
    light += through * clearness({kGround + 0.01f, sunUp}) *
             (std::max(0.0f, sunUp) * kEarthAlbedo / kPif);
  }

 public:
  /// The sun's cosine from the way up after `t` along a ray from a point on the y axis.
  static float sunUpAt(float radius, const Vec3f& direction, float t, const Vec3f& toSun) {
    return dot(normalized(Vec3f{0, radius, 0} + direction * t), toSun);
  }
  static Vec3f over(const Vec3f& a, const Vec3f& b) {
    return {a.x / std::max(1e-9f, b.x), a.y / std::max(1e-9f, b.y), a.z / std::max(1e-9f, b.z)};
  }

 private:
  float haze_;
  std::vector<Vec3f> clear_ = std::vector<Vec3f>(kHeights * kAngles);
  std::vector<Vec3f> multi_ = std::vector<Vec3f>(kMultiHeights * kMultiAngles);
};

/// The air of most pictures: its tables take longer than a sky made with them.
const Atmosphere& clearAir() {
  static const Atmosphere air(1);
  return air;
}

float rayleighPhase(float cosine) { return 3 / (16 * kPif) * (1 + cosine * cosine); }

/// Cornette and Shanks 1992.
float miePhase(float cosine) {
  const float g = kMieForward, g2 = g * g;
  const float away = 1 + g2 - 2 * g * cosine;
  return 3 / (8 * kPif) * (1 - g2) * (1 + cosine * cosine) / ((2 + g2) * away * std::sqrt(away));
}

/// A step of the way that one looks along through the air: all of it that does not depend on where
/// the sun is.
struct Step {
  float t = 0, radius = 0;
  Air air;
  /// The share of light that the step takes and that then gets to the eye.
  Vec3f share;
};
constexpr int kSteps = 48;
using Way = std::array<Step, kSteps>;

/// The way at a sine of elevation.
Way wayAt(const Atmosphere& air, float up) {
  const Place eye{kEye, up};
  const float length = eye.meetsGround() ? eye.toGround() : eye.toTop();
  Way way;
  Vec3f through = kOne;
  float before = 0;
  for (int i = 0; i < kSteps; ++i) {
    // Short steps first: most of the air is near.
    const float share = static_cast<float>(i + 1) / kSteps;
    const float end = length * share * share, step = end - before;
    Step& s = way[static_cast<size_t>(i)];
    s.t = (end + before) / 2;
    before = end;
    s.radius = eye.along(s.t).radius;
    s.air = air.at(s.radius);
    const Vec3f kept = decay(s.air.extinction * -step);
    s.share = through * (kOne - kept);
    through *= kept;
  }
  return way;
}

Vec3f seen(const Atmosphere& air, const Way& way, const Vec3f& direction, const Vec3f& toSun) {
  const float cosine = dot(direction, toSun);
  const float rayleigh = rayleighPhase(cosine), mie = miePhase(cosine);
  Vec3f light;
  for (const Step& s : way) {
    const Air& a = s.air;
    const float sunUp = Atmosphere::sunUpAt(kEye, direction, s.t, toSun);
    const Vec3f once =
        (a.rayleigh * rayleigh + kOne * (a.mie * mie)) * air.clearness({s.radius, sunUp});
    const Vec3f often = (a.rayleigh + kOne * a.mie) * air.multiple(s.radius, sunUp);
    light += s.share * Atmosphere::over(once + often, a.extinction);
  }
  return light;
}

}  // namespace

Sky::Sky(double sunElevation, double haze) {
  std::optional<Atmosphere> own;
  if (haze != 1) own.emplace(static_cast<float>(std::clamp(haze, 0.0, 50.0)));
  const Atmosphere& air = own ? *own : clearAir();
  const float sunUp = static_cast<float>(sinDeg(sunElevation));
  const Vec3f toSun{static_cast<float>(cosDeg(sunElevation)), sunUp, 0};
  // While the disc sets, the share of it that is above the horizon.
  const float disc = static_cast<float>(std::clamp(sunElevation / 0.53 + 0.5, 0.0, 1.0));
  const float risen = static_cast<float>(sinDeg(std::max(0.1, sunElevation)));
  sun = air.clearness({kEye, risen}) * disc;

  table_.resize(static_cast<size_t>((kUps + 1) * (kAsides + 1)));
  for (int j = 0; j <= kUps; ++j) {
    const float r = static_cast<float>(j) / kUps, up = r * r;
    const float flat = std::sqrt(std::max(0.0f, 1 - up * up));
    const Way way = wayAt(air, up);
    for (int i = 0; i <= kAsides; ++i) {
      const float s = static_cast<float>(i) / kAsides, a = kPif * s * s;
      const Vec3f direction{flat * std::cos(a), up, flat * std::sin(a)};
      table_[static_cast<size_t>(j * (kAsides + 1) + i)] = seen(air, way, direction, toSun);
    }
  }
  // The integral of radiance * sine over the hemisphere, by rings of equal sine squared.
  constexpr int kRings = 32, kTurns = 64;
  for (int j = 0; j < kRings; ++j) {
    const float up = std::sqrt((static_cast<float>(j) + 0.5f) / kRings);
    for (int i = 0; i < kTurns; ++i) {
      irradiance += radiance(up, std::cos(kPif * (static_cast<float>(i) + 0.5f) / kTurns));
    }
  }
  irradiance *= kPif / (kRings * kTurns);
}

namespace {

/// The angle with that cosine, to a few thousandths of a degree (Abramowitz and Stegun 1964,
/// 4.4.45): a third of the time of the library's.
float angleOf(float cosine) {
  const float c = std::abs(cosine);
  const float angle =
      std::sqrt(1 - c) * (1.5707288f + c * (-0.2121144f + c * (0.0742610f - c * 0.0187293f)));
  return cosine < 0 ? kPif - angle : angle;
}

}  // namespace

Vec3f Sky::radiance(float up, float cosineFromSun) const {
  const float y = std::sqrt(std::clamp(up, 0.0f, 1.0f)) * kUps;
  const float angle = angleOf(std::clamp(cosineFromSun, -1.0f, 1.0f));
  const float x = std::sqrt(angle / kPif) * kAsides;
  const int j = std::min(kUps - 1, static_cast<int>(y));
  const int i = std::min(kAsides - 1, static_cast<int>(x));
  const Vec3f* const t = &table_[static_cast<size_t>(j * (kAsides + 1) + i)];
  const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
  return mix(mix(t[0], t[1], fx), mix(t[kAsides + 1], t[kAsides + 2], fx), fy);
}

}  // namespace gable::rt
