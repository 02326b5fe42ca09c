// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines become a graph of samples a few metres apart. The natural height of each sample is smoothed
// along the lines. The highest function below these heights with bounded slopes and the lowest one
// above are shortest paths in the graph (E. J. McShane, "Extension of range of functions", 1934);
// halfway between both, what is cut and what is filled balance, and the slopes are bounded still.
// Roads that bend the ground to their own profile, and a bank beside them, are those of
// E. Galin et al., "Procedural generation of roads" (2010).
//
// Off the lines, the heights of those near are mixed by the inverse square of their distance
// (D. Shepard, 1968), each less wide a reach than `kReach`, and faded out into the natural ground.
#include "city/street_grade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "base/work.h"
#include "city/grid_point.h"
#include "city/ground.h"
#include "city/ribbon.h"

namespace gable {
namespace {

constexpr double kSample = 6;
// Metres beyond the area within which lines still count.
constexpr double kAround = 60;
// How far from its edge a line bends the ground at most, and at least.
constexpr double kReach = 30, kLeastReach = 4;
// Metres of bank for each of height.
constexpr double kBank = 2.5;
constexpr double kMostSamples = 2'000'000;
constexpr int kSmoothings = 4;

struct LessPoint {
  bool operator()(Vec2 a, Vec2 b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

double smoothStep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct Edge {
  uint32_t a, b;
  double slope;
  // From the middle to where the ground is no longer the line's.
  double half;
  // Streets go before paths.
  double weight;
};

struct Graph {
  std::vector<Vec2> places;
  std::vector<double> heights;
  std::vector<Edge> edges;
  std::vector<std::vector<std::pair<uint32_t, double>>> links;
};

class GraphMaker {
 public:
  GraphMaker(const HeightField& field, const Box2& area) : field_(field), area_(area) {
    area_.min = area_.min - Vec2{kAround, kAround};
    area_.max = area_.max + Vec2{kAround, kAround};
  }

  /// `slopeAt` says how steep the line may be so many metres from its beginning.
  template <class SlopeAt>
  void add(const std::vector<Vec2>& line, double half, double weight, SlopeAt&& slopeAt) {
    double along = 0;
    uint32_t last = kNone;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
      const Vec2 a = line[i], b = line[i + 1];
      const double l = length(b - a);
      if (!isNear(a, b)) {
        last = kNone;
        along += l;
        continue;
      }
      if (static_cast<double>(graph.places.size()) >= kMostSamples) return;
      const auto steps = static_cast<int>(std::clamp(std::ceil(l / kSample), 1.0, 1e4));
      if (last == kNone) last = shared(a);
      for (int k = 1; k <= steps; ++k) {
        work();
        const double t = static_cast<double>(k) / steps;
        const uint32_t next = k == steps ? shared(b) : sample(a + (b - a) * t);
        if (next != last) {
          const double slope = slopeAt(along + l * (t - 0.5 / steps));
          graph.edges.push_back({last, next, slope, half, weight});
        }
        last = next;
      }
      along += l;
    }
  }

  Graph graph;

 private:
  static constexpr uint32_t kNone = 0xffffffff;

  bool isNear(Vec2 a, Vec2 b) const {
    return std::max(a.x, b.x) >= area_.min.x && std::min(a.x, b.x) <= area_.max.x &&
           std::max(a.y, b.y) >= area_.min.y && std::min(a.y, b.y) <= area_.max.y;
  }
  uint32_t sample(Vec2 p) {
    graph.places.push_back(p);
    graph.heights.push_back(field_.at(p));
    return static_cast<uint32_t>(graph.places.size() - 1);
  }
  uint32_t shared(Vec2 p) {
    const auto [at, isNew] = shared_.emplace(p, 0);
    if (isNew) at->second = sample(p);
    return at->second;
  }

  const HeightField& field_;
  Box2 area_;
  std::map<Vec2, uint32_t, LessPoint> shared_;
};

void addStreets(const Streets& streets, GraphMaker& maker) {
  for (const Stretch& s : streets.stretches) {
    const double half =
        s.profile.width / 2 + std::max({s.profile.leftWalk, s.profile.rightWalk, 0.0});
    const double whole = lineLength(s.line);
    maker.add(s.line, half, 1, [&](double along) {
      const bool crosses = along < s.cutBegin || along > whole - s.cutEnd;
      return crosses ? kJunctionSlope : kStreetSlope;
    });
  }
}

void addPaths(const std::vector<MapFeature>& features, GraphMaker& maker) {
  for (const MapFeature& f : features) {
    const auto line = lineGroundOf(f);
    if (!line || line->surface == Surface::Water || line->surface == Surface::Pier) continue;
    const bool steps = f.tag("highway") == "steps", rail = line->surface == Surface::Track;
    const double slope = steps ? kStepsSlope : rail ? kRailSlope : kPathSlope;
    maker.add(f.points, line->width / 2, rail ? 0.3 : 0.02, [&](double) { return slope; });
  }
}

void smooth(Graph& g) {
  std::vector<double> next(g.heights.size());
  for (int pass = 0; pass < kSmoothings; ++pass) {
    for (size_t i = 0; i < next.size(); ++i) {
      work(4);
      double sum = 0;
      for (const auto& link : g.links[i]) sum += g.heights[link.first];
      const size_t n = g.links[i].size();
      next[i] = n == 0 ? g.heights[i] : 0.5 * g.heights[i] + 0.5 * sum / static_cast<double>(n);
    }
    g.heights.swap(next);
  }
}

// The highest function with bounded slopes that is nowhere above the heights; with sign -1 the
// negative of the lowest that is nowhere below them.
std::vector<double> bounded(const Graph& g, double sign) {
  std::vector<double> out(g.heights.size());
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (uint32_t i = 0; i < out.size(); ++i) {
    out[i] = sign * g.heights[i];
    queue.emplace(out[i], i);
  }
  while (!queue.empty()) {
    work(4);
    const auto [height, i] = queue.top();
    queue.pop();
    if (height > out[i]) continue;
    for (const auto& [other, rise] : g.links[i]) {
      if (height + rise >= out[other]) continue;
      out[other] = height + rise;
      queue.emplace(out[other], other);
    }
  }
  return out;
}

Graph graded(const HeightField& field, const std::vector<MapFeature>& features,
             const Streets& streets, const Box2& area) {
  GraphMaker maker(field, area);
  addStreets(streets, maker);
  addPaths(features, maker);
  Graph g = std::move(maker.graph);
  g.links.resize(g.places.size());
  for (const Edge& e : g.edges) {
    const double rise = e.slope * length(g.places[e.b] - g.places[e.a]);
    g.links[e.a].emplace_back(e.b, rise);
    g.links[e.b].emplace_back(e.a, rise);
  }
  smooth(g);
  const std::vector<double> low = bounded(g, 1), high = bounded(g, -1);
  for (size_t i = 0; i < g.heights.size(); ++i) g.heights[i] = 0.5 * (low[i] - high[i]);
  return g;
}

}  // namespace

struct StreetGrade::Lines {
  Lines(Graph graph, const Box2& area)
      : g(std::move(graph)),
        grid(gridPoint(area.min), gridPoint(area.max), cellsOf(area)),
        lists(grid.size(), [&](const auto& put) {
          for (uint32_t i = 0; i < g.edges.size(); ++i) {
            Box2 box;
            box.include(g.places[g.edges[i].a]);
            box.include(g.places[g.edges[i].b]);
            const double more = g.edges[i].half + kReach;
            const GridPoint low = gridPoint(box.min - Vec2{more, more});
            const GridPoint high = gridPoint(box.max + Vec2{more, more});
            for (int64_t r = grid.row(low.y); r <= grid.row(high.y); ++r) {
              for (int64_t c = grid.column(low.x); c <= grid.column(high.x); ++c) {
                work();
                put(grid.cell(c, r), i);
              }
            }
          }
        }) {}
  // Of some 30 metres each.
  static size_t cellsOf(const Box2& area) {
    const double cells = area.size().x * area.size().y / 1000;
    return static_cast<size_t>(std::clamp(cells, 1.0, 4e6));
  }

  Graph g;
  CellGrid grid;
  CellLists lists;
};

StreetGrade::StreetGrade(const HeightField& field, const std::vector<MapFeature>& features,
                         const Streets& streets, const Box2& area)
    : field_(field),
      lines_(std::make_unique<Lines>(graded(field, features, streets, area), area)) {}
StreetGrade::~StreetGrade() = default;

double StreetGrade::heightAt(Vec2 p) const {
  const Lines& l = *lines_;
  const double natural = field_.at(p);
  const size_t cell = l.grid.cellOf(gridPoint(p));
  double sum = 0, weights = 0, nearest = kReach;
  for (const uint32_t* i = l.lists.begin(cell); i != l.lists.end(cell); ++i) {
    work();
    const Edge& e = l.g.edges[*i];
    const Vec2 a = l.g.places[e.a], d = l.g.places[e.b] - a;
    const double square = dot(d, d);
    const double t = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
    const double middle = length(p - (a + d * t));
    const double beside = std::max(0.0, middle - e.half);
    if (beside >= kReach) continue;
    // Within its width a line is alone but for those that cross it there.
    const double apart = beside + 0.02 * middle + 0.01;
    const double fade = 1 - beside / kReach;
    const double w = e.weight * fade * fade / (apart * apart);
    sum += w * (l.g.heights[e.a] + t * (l.g.heights[e.b] - l.g.heights[e.a]));
    weights += w;
    nearest = std::min(nearest, beside);
  }
  if (!(weights > 0)) return natural;
  const double height = sum / weights;
  const double reach =
      std::clamp(kLeastReach + kBank * std::fabs(height - natural), kLeastReach, kReach);
  return natural + smoothStep(1 - nearest / reach) * (height - natural);
}

std::vector<StreetGrade::Piece> StreetGrade::pieces() const {
  std::vector<Piece> out;
  const Graph& g = lines_->g;
  for (const Edge& e : g.edges) {
    out.push_back({g.places[e.a], g.places[e.b], g.heights[e.a], g.heights[e.b], e.slope});
  }
  return out;
}

}  // namespace gable
