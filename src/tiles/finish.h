// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What parts of coarse models look like, and how looks are mixed: by area, as light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "math/vec.h"

namespace gable {

struct Finish {
  /// Linear light.
  Vec3 color{1, 1, 1};
  double roughness = 1;
  bool operator==(const Finish&) const = default;
};

/// Looks and how much there is of each.
struct Tint {
  Vec3 sum;
  double roughness = 0, weight = 0;
  void add(const Finish& finish, double area) {
    sum += finish.color * area;
    roughness += finish.roughness * area;
    weight += area;
  }
  void add(const Tint& other) {
    sum += other.sum;
    roughness += other.roughness;
    weight += other.weight;
  }
  Finish mean(const Finish& otherwise) const {
    return weight > 0 ? Finish{sum * (1 / weight), roughness / weight} : otherwise;
  }
};

/// Equal for equal colours: means of them differ in their last digits.
inline std::array<int64_t, 3> tintKey(const Finish& finish) {
  constexpr double kSteps = 1024, kMost = 1e12;
  std::array<int64_t, 3> key{};
  for (size_t i = 0; i < 3; ++i) {
    key[i] =
        static_cast<int64_t>(std::clamp(std::floor(finish.color[i] * kSteps + 0.5), -kMost, kMost));
  }
  return key;
}

/// How far two colours are from each other for the eye, about in steps of sRGB: the largest of
/// three. Roots are near enough to its curve.
inline double distanceOf(const Finish& a, const Finish& b) {
  double most = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double d = std::sqrt(std::max(a.color[i], 0.0)) - std::sqrt(std::max(b.color[i], 0.0));
    most = std::max(most, std::abs(d));
  }
  return most;
}

}  // namespace gable
