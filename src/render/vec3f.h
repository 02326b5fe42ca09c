// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Single-precision vectors of the path tracer. Geometry comes in doubles and is moved near the
// origin before it is rounded; light needs no more than this.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vec.h"

namespace gable::rt {

constexpr float kPif = 3.14159265f;

struct Vec3f {
  float x = 0, y = 0, z = 0;
};

struct Vec2f {
  float x = 0, y = 0;
};

constexpr Vec3f operator+(const Vec3f& a, const Vec3f& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3f operator-(const Vec3f& a, const Vec3f& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3f operator-(const Vec3f& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3f operator*(const Vec3f& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3f operator*(float s, const Vec3f& a) { return a * s; }
/// Component by component: colours filter light.
constexpr Vec3f operator*(const Vec3f& a, const Vec3f& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
constexpr Vec3f& operator+=(Vec3f& a, const Vec3f& b) { return a = a + b; }
constexpr Vec3f& operator*=(Vec3f& a, const Vec3f& b) { return a = a * b; }
constexpr Vec3f& operator*=(Vec3f& a, float s) { return a = a * s; }
constexpr float dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3f cross(const Vec3f& a, const Vec3f& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3f& a) { return std::sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Vec3f normalized(const Vec3f& a) {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : Vec3f{};
}
constexpr Vec3f mix(const Vec3f& a, const Vec3f& b, float t) { return a * (1 - t) + b * t; }
constexpr float luminance(const Vec3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
constexpr float maxOf(const Vec3f& c) { return std::max(c.x, std::max(c.y, c.z)); }
inline bool isFinite(const Vec3f& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
inline Vec3f toVec3f(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
constexpr Vec3 toVec3(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// Two unit vectors that make a right-handed frame with the unit vector `n` (Duff et al. 2017).
inline void basisAround(const Vec3f& n, Vec3f& t, Vec3f& b) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float c = n.x * n.y * a;
  t = {1 + sign * n.x * n.x * a, sign * c, -sign * n.x};
  b = {c, sign + n.y * n.y * a, -n.y};
}

}  // namespace gable::rt
