// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/placement.h"

#include <cmath>
#include <optional>

#include "io/geo/wgs84.h"
#include "math/trig.h"
#include "math/vec.h"

namespace gable {
namespace {

using wgs84::kFlattening;
using wgs84::kSemiMajor;
// Far enough to tell a direction, near enough to be straight.
constexpr double kStep = 100;

Vec3 upAt(const GeoPlace::Degrees& d) {
  const double c = cosDeg(d.latitude);
  return {c * cosDeg(d.longitude), c * sinDeg(d.longitude), sinDeg(d.latitude)};
}

Vec3 earthOf(const GeoPlace::Degrees& d) {
  constexpr double kSquared = kFlattening * (2 - kFlattening);
  const Vec3 up = upAt(d);
  const double n = kSemiMajor / std::sqrt(1 - kSquared * up.z * up.z);
  return {n * up.x, n * up.y, n * (1 - kSquared) * up.z};
}

}  // namespace

std::vector<double> placementOf(const GeoFrame* frame) {
  if (!frame) return {};
  const auto origin = frame->at({0, 0}).degrees, beside = frame->at({kStep, 0}).degrees;
  if (!origin || !beside) return {};
  const Vec3 at = earthOf(*origin), up = upAt(*origin);
  const Vec3 along = earthOf(*beside) - at;
  const Vec3 east = normalized(along - up * dot(along, up));
  if (!isFinite(at) || !isFinite(east) || !(dot(east, east) > 0.5)) return {};
  const Vec3 north = cross(up, east);
  return {east.x, east.y, east.z, 0, north.x, north.y, north.z, 0,
          up.x,   up.y,   up.z,   0, at.x,    at.y,    at.z,    1};
}

}  // namespace gable
