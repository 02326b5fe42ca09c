// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Vectors of doubles. World frame: right-handed, metres, +x east, +y up, -z north.
#pragma once

#include <cmath>
#include <cstddef>

namespace gable {

struct Vec2 {
  double x = 0, y = 0;
  constexpr double operator[](size_t i) const { return i == 0 ? x : y; }
  friend constexpr bool operator==(Vec2, Vec2) = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
constexpr Vec2 operator*(Vec2 a, double s) { return {a.x * s, a.y * s}; }
constexpr Vec2 operator*(double s, Vec2 a) { return a * s; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// The z of the cross product: positive when b is counter-clockwise from a.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Vec2 normalized(Vec2 a) {
  const double l = length(a);
  return l > 0 ? Vec2{a.x / l, a.y / l} : Vec2{};
}
/// A quarter turn counter-clockwise.
constexpr Vec2 perpendicular(Vec2 a) { return {-a.y, a.x}; }

struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr double operator[](size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr double& operator[](size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return a * s; }
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
/// Component by component.
constexpr Vec3 scaled(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The zero vector stays zero.
inline Vec3 normalized(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? Vec3{a.x / l, a.y / l, a.z / l} : Vec3{};
}
inline bool isFinite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Plan coordinates of a point: (x, -z), so that counter-clockwise seen from above stays so.
constexpr Vec2 planOf(const Vec3& p) { return {p.x, -p.z}; }
constexpr Vec3 fromPlan(Vec2 p, double y = 0) { return {p.x, y, -p.y}; }

}  // namespace gable
