// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/layout/shared/kerbs.h"

#include <cmath>

namespace gable {

namespace {

// A kerb lies half of the width from the centre line, and farther than the ends of its stretch.
constexpr double kKerbShare = 0.4;
// The cosine of the angle between a kerb and the centre line, at least.
constexpr double kParallel = 0.8;

}  // namespace

std::vector<bool> kerbsAlong(const Polygon& roadway, std::span<const Polyline2> centres,
                             double width) {
  std::vector<Path> paths;
  for (const Polyline2& c : centres) paths.emplace_back(c.line, c.closed);
  std::vector<bool> out;
  const auto add = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], middle = (a + b) * 0.5;
      double away = HUGE_VAL;
      Vec2 tangent;
      for (const Path& path : paths) {
        const Path::Place place = path.at(path.nearest(middle));
        const double distance = length(middle - place.point);
        if (distance >= away) continue;
        away = distance;
        tangent = place.tangent;
      }
      const bool parallel = std::fabs(dot(normalized(b - a), tangent)) > kParallel;
      out.push_back(parallel && away > width * kKerbShare);
    }
  };
  add(roadway.outer);
  for (const Ring& hole : roadway.holes) add(hole);
  return out;
}

}  // namespace gable
