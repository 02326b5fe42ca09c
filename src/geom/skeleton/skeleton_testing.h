// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests only: the promises of skeleton.h as checks that say in words what is broken.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "base/random.h"
#include "geom/region/region.h"
#include "geom/skeleton/skeleton.h"

namespace gable::skeleton_testing {

inline const Ring& ringOf(const Polygon& p, size_t k) { return k == 0 ? p.outer : p.holes[k - 1]; }

inline std::vector<std::vector<double>> randomWeights(const Polygon& p, uint64_t seed) {
  std::vector<std::vector<double>> w;
  for (size_t k = 0; k <= p.holes.size(); ++k) {
    w.emplace_back();
    for (size_t i = 0; i < ringOf(p, k).size(); ++i) {
      w.back().push_back(randomIn(hashCombine(hashCombine(seed, k), i), 0.5, 2));
    }
  }
  return w;
}

/// True where two segments cross by more than `tolerance` on all four sides.
inline bool crossClearly(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double tolerance) {
  const double ab = length(b - a), cd = length(d - c);
  if (ab < tolerance || cd < tolerance) return false;
  const double sides[4] = {cross(b - a, c - a) / ab, cross(b - a, d - a) / ab,
                           cross(d - c, a - c) / cd, cross(d - c, b - c) / cd};
  for (const double s : sides) {
    if (std::abs(s) <= tolerance) return false;
  }
  return (sides[0] > 0) != (sides[1] > 0) && (sides[2] > 0) != (sides[3] > 0);
}

inline bool isSimple(const Ring& r, double tolerance) {
  for (size_t i = 0; i < r.size(); ++i) {
    for (size_t j = i + 2; j < r.size(); ++j) {
      if (i == 0 && j + 1 == r.size()) continue;
      if (crossClearly(r[i], r[i + 1], r[j], r[(j + 1) % r.size()], tolerance)) return false;
    }
  }
  return true;
}

inline Ring planOf(const Skeleton& s, const std::vector<uint32_t>& loop) {
  Ring r;
  for (const uint32_t v : loop) r.push_back(s.vertices[v].xy);
  return r;
}

/// Empty where all promises hold; else what is wrong with the first face that breaks one.
inline std::string broken(const Polygon& p, const Skeleton& s,
                          std::span<const std::vector<double>> weights = {},
                          double maxHeight = std::numeric_limits<double>::infinity()) {
  if (!s.status.ok()) return std::string("status ") + s.status.code();
  const double extent = length(bounds(p).size());
  const double tolerance = 1e-9 * extent;
  size_t edges = 0, steps = 0;
  for (size_t k = 0; k <= p.holes.size(); ++k) edges += ringOf(p, k).size();
  for (const SkeletonFace& f : s.faces) steps += f.step ? 1 : 0;
  if (s.faces.size() != edges + steps) return "not one face an edge";
  if (s.inputCount != edges) return "the polygon's points are not the first vertices";
  // A planar graph of n + 1 faces whose inner vertices have three arcs or more.
  if (s.vertices.size() > 3 * (edges + steps) + 2 * p.holes.size()) return "too many vertices";
  double sum = 0;
  for (const SkeletonFace& f : s.faces) {
    const std::string name = std::to_string(f.ring) + ":" + std::to_string(f.edge) + ": ";
    for (const uint32_t v : f.loop) {
      const SkeletonVertex& u = s.vertices[v];
      if (!std::isfinite(u.xy.x) || !std::isfinite(u.xy.y)) return name + "coordinate not finite";
      if (!(u.height >= 0 && u.height <= maxHeight * (1 + 1e-12)))
        return name + "height out of range";
    }
    if (f.step) continue;
    const Ring& ring = ringOf(p, f.ring);
    const Vec2 a = ring[f.edge], b = ring[(f.edge + 1) % ring.size()];
    const Ring plan = planOf(s, f.loop);
    if (plan.size() < 3) return name + "no face";
    if (!(plan[0] == a && plan[1] == b)) return name + "does not begin with its edge";
    const double own = signedArea(plan);
    if (own < -tolerance * extent) return name + "turned over";
    sum += own;
    for (const auto& h : f.holes) sum += signedArea(planOf(s, h));
    if (!isSimple(plan, tolerance)) return name + "crosses itself";
    if (length(b - a) < 1e-6 * extent) continue;
    const Vec2 normal = normalized(perpendicular(b - a));
    const double w = weights.empty() ? 1 : weights[f.ring][f.edge];
    for (const uint32_t v : f.loop) {
      const double off = dot(s.vertices[v].xy - a, normal) - w * s.vertices[v].height;
      if (std::abs(off) > 1e-7 * extent) return name + "not in its plane";
    }
  }
  if (std::isinf(maxHeight) && std::abs(sum - area(p)) > 1e-6 * area(p))
    return "areas do not add up";
  return {};
}

/// The edges of all faces that have no neighbour and are not the polygon's own: T-junctions or
/// gaps.
inline size_t openEdges(const Skeleton& s) {
  std::vector<std::pair<uint32_t, uint32_t>> halves;
  const auto addLoop = [&](const std::vector<uint32_t>& l) {
    for (size_t i = 0; i < l.size(); ++i) halves.emplace_back(l[i], l[(i + 1) % l.size()]);
  };
  for (const SkeletonFace& f : s.faces) {
    addLoop(f.loop);
    for (const auto& h : f.holes) addLoop(h);
  }
  std::sort(halves.begin(), halves.end());
  size_t open = 0;
  for (const auto& [a, b] : halves) {
    if (a < s.inputCount && b < s.inputCount) continue;
    if (!std::binary_search(halves.begin(), halves.end(), std::pair{b, a})) ++open;
  }
  return open;
}

}  // namespace gable::skeleton_testing
