// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Microseconds of each operation on regions, medians over polygons of 4, 20 and 200 vertices, on
// one thread, beside the figures that were measured when the kernel was chosen: each is to stay
// within twice of those. Half of the polygons of 200 vertices are shuffled tours, the worst case.
//
// bench_regions [POLYGONS [NAME]]: so many of each size (40); only operations with NAME in theirs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"
#include "geom/region/along.h"
#include "geom/region/boolean.h"
#include "geom/region/corpus.h"
#include "geom/region/grid_partition.h"
#include "geom/region/hull.h"
#include "geom/region/inner_rectangle.h"
#include "geom/region/peel.h"
#include "geom/region/places.h"
#include "geom/region/rays.h"
#include "geom/region/voronoi.h"
#include "math/trig.h"

using namespace gable;

namespace {

// A star around the origin; `rough` is how far its vertices go in and out.
Polygon starOf(int n, double rough, uint64_t seed) {
  Polygon p;
  for (int i = 0; i < n; ++i) {
    const double a = 360.0 * i / n;
    const double r = 30 * (1 - rough * randomUnit(hashCombine(seed, static_cast<uint64_t>(i))));
    p.outer.push_back({r * cosDeg(a), r * sinDeg(a)});
  }
  return p;
}

bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  return (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) &&
         (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
}

// Random points on a tour whose crossings are undone one by one.
Polygon tourOf(size_t n, uint64_t seed) {
  Ring r;
  for (uint64_t i = 0; i < n; ++i) {
    r.push_back(
        {60 * randomUnit(hashCombine(seed, 2 * i)), 60 * randomUnit(hashCombine(seed, 2 * i + 1))});
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t i = 0; i + 2 < n; ++i) {
      for (size_t k = i + 2; k < n; ++k) {
        if (i == 0 && k == n - 1) continue;
        if (!crosses(r[i], r[i + 1], r[k], r[(k + 1) % n])) continue;
        std::reverse(r.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                     r.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        changed = true;
      }
    }
  }
  if (signedArea(r) < 0) std::reverse(r.begin(), r.end());
  return {r, {}};
}

std::vector<Polygon> polygonsOf(int n, int count) {
  std::vector<Polygon> out;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<uint64_t>(i);
    out.push_back(n == 200 && i % 2 ? tourOf(200, seed) : starOf(n, n == 4 ? 0.3 : 0.5, seed));
  }
  return out;
}

struct Job {
  const char* name;
  /// What is to be stayed within twice of; 0 where there is no figure.
  std::array<double, 3> known;
  // The sites are places in the polygon for the operations that take some.
  std::function<void(const Polygon&, const std::vector<Disc>& sites)> work;
};

// Of this thread alone, so that other work on the machine does not count.
double threadMicroseconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

// Other work on the machine only adds, for moments or for seconds: each polygon's time is the best
// of several runs one after the other, and of several rounds over all polygons.
double microseconds(const std::vector<Polygon>& polygons,
                    const std::vector<std::vector<Disc>>& sites, const Job& job) {
  std::vector<double> best(polygons.size(), 1e300);
  for (int round = 0; round < 3; ++round) {
    for (size_t i = 0; i < polygons.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const double start = threadMicroseconds();
        job.work(polygons[i], sites[i]);
        best[i] = std::min(best[i], threadMicroseconds() - start);
      }
    }
  }
  std::sort(best.begin(), best.end());
  return best[best.size() / 2];
}

// How many sites polygons of each size get.
constexpr std::array<uint32_t, 3> kSites{12, 16, 30};

// The cells less half a path, smoothed; they are made once, in the first of the runs.
size_t smoothCells(const Polygon& p, const std::vector<Disc>& sites) {
  static std::map<const Polygon*, std::vector<RegionPiece>> cells;
  const auto [at, fresh] = cells.try_emplace(&p);
  if (fresh) at->second = voronoiPartition(p, sites, {}).pieces;
  Smoothing average;
  average.kind = Smoothing::Kind::Average;
  size_t made = 0;
  for (const RegionPiece& cell : at->second) {
    for (const Polygon& inner : offset({cell.polygon}, -0.5)) {
      made += smoothed(inner, average).size();
    }
  }
  return made;
}

// Each adds what it makes to `sum`, so that no work can be left out.
std::vector<Job> allJobs(double& sum) {
  const auto use = [&sum](size_t n) { sum += static_cast<double>(n); };
  const auto half = [](const Polygon& p) {
    std::vector<PeelEdge> out;
    for (uint32_t i = 0; i < p.outer.size(); i += 2) out.push_back({i, 0, 1, 1});
    return out;
  };
  const auto corners = [](const Polygon& p) {
    std::vector<RayTarget> out;
    for (const Vec2 v : p.outer) out.push_back({RayTarget::Kind::Point, v});
    return out;
  };
  const Region square{{{{-10, -10}, {25, -10}, {25, 25}, {-10, 25}}, {}}};
  GridOptions grid;
  grid.x.count = grid.y.count = 3;
  grid.pathWidth = 1;
  return {
      {"inset",
       {5.7, 15, 215},
       [=, &sum](const Polygon& p, const auto&) { use(offset({p}, -1).size()); }},
      {"difference",
       {4.6, 16, 362},
       [=, &sum](const Polygon& p, const auto&) { use(subtract({p}, square).size()); }},
      {"peel, follow",
       {11, 67, 2500},
       [=, &sum](const Polygon& p, const auto&) {
         use(peel(p, half(p), PeelEnds::Follow).rest.size());
       }},
      {"peel, orthogonal",
       {11, 67, 2500},
       [=, &sum](const Polygon& p, const auto&) {
         use(peel(p, half(p), PeelEnds::Orthogonal).rest.size());
       }},
      {"contract",
       {5.7, 15, 215},
       [=, &sum](const Polygon& p, const auto&) { use(contract(p, 1).size()); }},
      {"voronoi",
       {48, 107, 887},
       [=, &sum](const Polygon& p, const std::vector<Disc>& sites) {
         use(voronoiPartition(p, sites, {}).pieces.size());
       }},
      {"smoothing of cells",
       {147, 233, 1231},
       [=, &sum](const Polygon& p, const std::vector<Disc>& sites) { use(smoothCells(p, sites)); }},
      {"voronoi, smooth paths",
       // Nobody has measured this with sections and junctions of the paths.
       {},
       [=, &sum](const Polygon& p, const std::vector<Disc>& sites) {
         VoronoiOptions o;
         o.pathWidth = 1;
         o.smoothing.kind = Smoothing::Kind::Average;
         use(voronoiPartition(p, sites, o).pieces.size());
       }},
      {"rays",
       {0.9, 7.6, 69},
       [=, &sum](const Polygon& p, const auto&) {
         const Vec2 c[] = {p.outer.size() == 200 ? p.outer[0] * 0.999 : Vec2{0.1, 0.2}};
         use(castRays(p, c, corners(p), {}).pieces.size());
       }},
      {"rays with paths",
       {65, 367, 1224},
       [=, &sum](const Polygon& p, const std::vector<Disc>& sites) {
         RayOptions o;
         o.pathWidth = 0.5;
         o.centre = {PlanShape::Circle, 2, 0, 24};
         // Tours do not go round the origin; a centre outside would be moved, at a price of its
         // own.
         const bool round = contains(p, {0.1, 0.2});
         const Vec2 c[] = {round || sites.empty() ? Vec2{0.1, 0.2} : sites[0].centre};
         use(castRays(p, c, corners(p), o).pieces.size());
       }},
      {"grid 3 x 3 with paths",
       {88, 172, 1342},
       [=, &sum](const Polygon& p, const auto&) { use(gridPartition(p, grid).pieces.size()); }},
      {"oriented box",
       {0.2, 1.1, 8.5},
       [=, &sum](const Polygon& p, const auto&) { sum += smallestRect(p.outer).width; }},
      {"inner rectangle",
       {227, 471, 3736},
       [=, &sum](const Polygon& p, const auto&) {
         sum += largestInnerRect(p, {1, 0}).width;
       }},
      {"pole",
       {8.2, 23, 473},
       [=, &sum](const Polygon& p, const auto&) { sum += poleOf(p).radius; }},
      {"ribbon",
       {2.4, 15, 438},
       [=, &sum](const Polygon& p, const auto&) {
         std::vector<Vec2> line = p.outer;
         use(thicken(line, 0.3).size());
       }},
      {"scatter 190 points",
       {79, 103, 266},
       [=, &sum](const Polygon& p, const auto&) {
         const double d = std::sqrt(area(p) / 260);
         use(scatterPoisson(p, d, 0, 190, 1).size());
       }},
  };
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::max(1, std::atoi(argv[1])) : 40;
  constexpr std::array<int, 3> kSizes{4, 20, 200};
  std::array<std::vector<Polygon>, 3> polygons;
  std::array<std::vector<std::vector<Disc>>, 3> sites;
  for (size_t s = 0; s < 3; ++s) {
    polygons[s] = polygonsOf(kSizes[s], count);
    for (const Polygon& p : polygons[s]) sites[s].push_back(corpus::sitesIn(p, kSites[s]));
  }
  double sum = 0;
  const std::vector<Job> jobs = allJobs(sum);
  std::printf("%-24s %28s %28s\n%-24s %8s %9s %9s %10s %8s %8s\n", "microseconds", "measured",
              "to stay within twice of", "", "n4", "n20", "n200", "n4", "n20", "n200");
  const std::string only = argc > 2 ? argv[2] : "";
  int over = 0;
  for (const Job& j : jobs) {
    if (std::string(j.name).find(only) == std::string::npos) continue;
    std::array<double, 3> t{};
    for (size_t s = 0; s < 3; ++s) {
      t[s] = microseconds(polygons[s], sites[s], j);
    }
    std::string late;
    for (size_t s = 0; s < 3; ++s) {
      if (j.known[s] > 0 && t[s] > 2 * j.known[s]) late += " n" + std::to_string(kSizes[s]);
    }
    over += !late.empty();
    std::printf("%-24s %8.1f %9.1f %9.1f %10.1f %8.1f %8.1f %s%s\n", j.name, t[0], t[1], t[2],
                j.known[0], j.known[1], j.known[2], late.empty() ? "" : "over:", late.c_str());
  }
  std::printf("%d of %zu operations over twice (checksum %.3f)\n", over, jobs.size(), sum);
  return 0;
}
