// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Colours as screens have them (sRGB, IEC 61966-2-1), and the light that they stand for. Sums and
// products of colours are those of light.
#pragma once

#include "base/elementary.h"
#include "math/vec.h"

namespace gable {

/// What lies outside 0 to 1 is the nearer end; what is no number is 0.
inline double linearOf(double srgb) {
  const double c = srgb >= 0 ? (srgb < 1 ? srgb : 1) : 0;
  return c <= 0.04045 ? c / 12.92 : powOf((c + 0.055) / 1.055, 2.4);
}
inline double srgbOf(double linear) {
  const double c = linear >= 0 ? (linear < 1 ? linear : 1) : 0;
  return c <= 0.0031308 ? 12.92 * c : 1.055 * powOf(c, 1 / 2.4) - 0.055;
}

inline Vec3 linearOf(const Vec3& srgb) {
  return {linearOf(srgb.x), linearOf(srgb.y), linearOf(srgb.z)};
}
inline Vec3 srgbOf(const Vec3& linear) {
  return {srgbOf(linear.x), srgbOf(linear.y), srgbOf(linear.z)};
}

}  // namespace gable
