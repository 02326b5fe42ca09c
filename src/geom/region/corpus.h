// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests and benchmarks only: the hostile polygon corpus, seeded holes to punch into it, and
// places in a polygon. The corpus lies outside the repository; where it is absent `loadCorpus`
// gives nothing and tests skip.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/random.h"
#include "geom/region/places.h"
#include "geom/region/region.h"
#include "geom/region/segment_grid.h"
#include "math/trig.h"

namespace gable::corpus {

struct Case {
  Ring ring;
  int family = 0;
};

inline std::string corpusPath() {
  const char* shared = std::getenv("GABLE_SHARED");
  const std::string root = shared ? shared : std::string(GABLE_SOURCE_DIR) + "/../shared";
  return root + "/data/polygons/robust.txt.gz";
}

inline std::vector<Case> readCases(std::FILE* in) {
  std::vector<Case> cases;
  int n = 0, family = 0;
  double size = 0;
  while (std::fscanf(in, "%d %lf %d", &n, &size, &family) == 3) {
    Case c;
    c.family = family;
    for (int i = 0; i < n; ++i) {
      Vec2 p;
      if (std::fscanf(in, "%lf %lf", &p.x, &p.y) != 2) return cases;
      c.ring.push_back(p);
    }
    cases.push_back(std::move(c));
  }
  return cases;
}

/// Every `stride`-th polygon; empty when the file or gzip is missing.
inline std::vector<Case> loadCorpus(size_t stride = 1) {
  const std::string path = corpusPath();
  std::FILE* probe = std::fopen(path.c_str(), "rb");
  if (!probe) return {};
  std::fclose(probe);
  std::FILE* in = popen(("gzip -dc '" + path + "'").c_str(), "r");
  if (!in) return {};
  std::vector<Case> all = readCases(in);
  pclose(in);
  std::vector<Case> out;
  for (size_t i = 0; i < all.size(); i += stride) out.push_back(std::move(all[i]));
  return out;
}

inline double clearance(const Polygon& p, Vec2 at) {
  double d = 1e300;
  for (const Segment& s : edgesOf(p)) d = std::min(d, distanceTo(s, at));
  return d;
}

/// A star or convex hole round a point, clockwise.
inline Ring holeRing(Vec2 center, double radius, uint64_t seed) {
  const int n = 3 + static_cast<int>(randomUnit(seed) * 9);
  const bool star = randomUnit(hashCombine(seed, 1)) < 0.5;
  Ring r;
  for (int i = 0; i < n; ++i) {
    const double angle = -360.0 * i / n + 360 * randomUnit(hashCombine(seed, 2));
    const double reach = star && i % 2 ? 0.4 : 1.0;
    r.push_back(center + Vec2{cosDeg(angle), sinDeg(angle)} * (radius * reach));
  }
  return r;
}

/// Up to six holes that keep clear of the boundary and of each other.
inline Polygon withHoles(const Ring& outer, uint64_t seed) {
  Polygon p{outer, {}};
  const Box2 box = bounds(outer);
  const double least = 1e-3 * length(box.size());
  for (uint64_t k = 0; k < 60 && p.holes.size() < 6; ++k) {
    const uint64_t at = hashCombine(seed, k);
    const Vec2 c{randomIn(hashCombine(at, 0), box.min.x, box.max.x),
                 randomIn(hashCombine(at, 1), box.min.y, box.max.y)};
    if (locate(p, c) != Where::Inside) continue;
    const double r = clearance(p, c) * randomIn(hashCombine(at, 2), 0.3, 0.9);
    if (r > least) p.holes.push_back(holeRing(c, r, at));
  }
  return p;
}

/// Places in a polygon at random, the same for equal polygons: `count` of them, or those of 4000
/// tries.
inline std::vector<Disc> sitesIn(const Polygon& p, uint32_t count) {
  std::vector<Disc> sites;
  const Box2 b = bounds(p);
  for (uint64_t i = 0; i < 4000 && sites.size() < count; ++i) {
    const Vec2 c{randomIn(hashCombine(i, 1), b.min.x, b.max.x),
                 randomIn(hashCombine(i, 2), b.min.y, b.max.y)};
    if (locate(p, c) == Where::Inside) sites.push_back({c, 0});
  }
  return sites;
}

}  // namespace gable::corpus
