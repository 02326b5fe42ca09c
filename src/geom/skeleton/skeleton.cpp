// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Puts the polygon on an integer grid, finds the edges that lie in one plane, runs the wavefront
// and hands its trace to faces.cpp.
#include "geom/skeleton/skeleton.h"

#include <algorithm>
#include <cmath>

#include "geom/skeleton/faces.h"
#include "geom/skeleton/planes.h"
#include "geom/skeleton/wavefront.h"

namespace gable {

namespace {

using namespace skeleton;

constexpr int kGridBits = 51;

struct InputEdge {
  uint32_t from = 0, to = 0;
  double weight = 1;
  /// The face it makes, by promise 1.
  uint32_t face = 0;
};

struct Input {
  std::vector<std::vector<InputEdge>> rings;
  std::vector<GridPoint> points;
  double step = 1;
  Vec2 center;
  double topWeight = 0;
  /// Per ring the face of its first edge.
  std::vector<uint32_t> firstFace;
};

bool finite(const Ring& r) {
  return std::all_of(r.begin(), r.end(),
                     [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

/// Rounds the polygon to the grid and turns its rings the right way round.
bool readInput(const Polygon& polygon, std::span<const std::vector<double>> weights, Input& in) {
  std::vector<const Ring*> rings{&polygon.outer};
  for (const Ring& h : polygon.holes) rings.push_back(&h);
  Box2 box;
  for (const Ring* r : rings) {
    if (!finite(*r)) return false;
    for (const Vec2 p : *r) box.include(p);
  }
  if (polygon.outer.size() < 3 || !(std::max(box.size().x, box.size().y) > 0)) return false;
  const double extent = std::max(box.size().x, box.size().y);
  in.step = std::ldexp(1.0, std::ilogb(extent) + 1 - kGridBits);
  in.center = box.center();
  uint32_t face = 0;
  for (size_t k = 0; k < rings.size(); ++k) {
    const Ring& r = *rings[k];
    const auto first = static_cast<uint32_t>(in.points.size());
    const auto n = static_cast<uint32_t>(r.size());
    for (const Vec2 p : r) {
      in.points.push_back({static_cast<int64_t>(std::nearbyint((p.x - in.center.x) / in.step)),
                           static_cast<int64_t>(std::nearbyint((p.y - in.center.y) / in.step))});
    }
    std::vector<InputEdge> edges;
    in.firstFace.push_back(face);
    for (uint32_t i = 0; i < n; ++i) {
      InputEdge e{first + i, first + (i + 1) % n, 1, face++};
      if (!weights.empty()) {
        if (k >= weights.size() || i >= weights[k].size()) return false;
        e.weight = weights[k][i];
        if (!std::isfinite(e.weight) || e.weight < 0) return false;
      }
      in.topWeight = std::max(in.topWeight, e.weight);
      edges.push_back(e);
    }
    in.rings.push_back(std::move(edges));
  }
  return true;
}

/// Twice the area, exact.
Int128 doubleArea(const Input& in, const std::vector<InputEdge>& ring) {
  Int128 sum = 0;
  for (const InputEdge& e : ring) {
    const GridPoint &p = in.points[e.from], &q = in.points[e.to];
    sum += static_cast<Int128>(p.x) * q.y - static_cast<Int128>(q.x) * p.y;
  }
  return sum;
}

Int128 crossOf(GridPoint a, GridPoint b, GridPoint c) {
  return static_cast<Int128>(b.x - a.x) * (c.y - a.y) -
         static_cast<Int128>(b.y - a.y) * (c.x - a.x);
}

/// True where the ring turns back at b exactly.
bool isSpike(GridPoint a, GridPoint b, GridPoint c) {
  if (crossOf(a, b, c) != 0) return false;
  return static_cast<Int128>(b.x - a.x) * (c.x - b.x) +
             static_cast<Int128>(b.y - a.y) * (c.y - b.y) <
         0;
}

/// Takes out edges without length and tips where the ring turns back on itself.
void dropDegenerate(Input& in, std::vector<InputEdge>& ring) {
  bool changed = true;
  while (changed && ring.size() >= 3) {
    changed = false;
    std::vector<InputEdge> kept;
    for (const InputEdge& e : ring) {
      if (in.points[e.from] == in.points[e.to]) {
        changed = true;
        if (!kept.empty()) kept.back().to = e.to;
        continue;
      }
      if (!kept.empty()) {
        InputEdge& last = kept.back();
        last.to = e.from;
        if (isSpike(in.points[last.from], in.points[e.from], in.points[e.to])) {
          // Only the longer of the two survives, over what sticks out.
          changed = true;
          last.to = e.to;
          if (crossOf(in.points[last.from], in.points[e.from], in.points[e.to]) == 0 &&
              in.points[last.from] == in.points[last.to]) {
            kept.pop_back();
          }
          continue;
        }
      }
      kept.push_back(e);
    }
    if (!kept.empty()) kept.back().to = kept.front().from;
    if (kept.size() >= 2 && isSpike(in.points[kept.back().from], in.points[kept.front().from],
                                    in.points[kept.front().to])) {
      changed = true;
      kept.front().from = kept.back().from;
      kept.pop_back();
      if (!kept.empty()) kept.back().to = kept.front().from;
    }
    ring = std::move(kept);
  }
}

/// True where two planes are one: the same line, the same direction, the same speed.
bool samePlane(const Input& in, const InputEdge& a, const InputEdge& b) {
  if (a.weight != b.weight) return false;
  const GridPoint &p = in.points[a.from], &q = in.points[a.to];
  const GridPoint &r = in.points[b.from], &s = in.points[b.to];
  if (crossOf(p, q, r) != 0 || crossOf(p, q, s) != 0) return false;
  return static_cast<Int128>(q.x - p.x) * (s.x - r.x) +
             static_cast<Int128>(q.y - p.y) * (s.y - r.y) >
         0;
}

/// Gives each edge a plane; edges in one plane share it.
std::vector<PlaneId> assignPlanes(const Input& in, const std::vector<const InputEdge*>& edges,
                                  Planes& planes) {
  // Candidates lie next to each other once sorted by direction and distance, both rounded; an edge
  // looks a little way back only, so rounding at a bucket's border is met by looking at both sides.
  struct Key {
    double angle, offset;
    size_t edge;
  };
  std::vector<Key> keys;
  for (size_t i = 0; i < edges.size(); ++i) {
    const GridPoint &p = in.points[edges[i]->from], &q = in.points[edges[i]->to];
    const Vec2 d = normalized(Vec2{static_cast<double>(q.x - p.x), static_cast<double>(q.y - p.y)});
    const double offset = d.x * static_cast<double>(p.y) - d.y * static_cast<double>(p.x);
    // A pseudo angle that grows with the direction.
    keys.push_back({d.y >= 0 ? -d.x : 2 + d.x, offset, i});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.offset != b.offset ? a.offset < b.offset : a.edge < b.edge;
  });
  std::vector<size_t> leader(edges.size());
  const double slack = 16.0;
  for (size_t i = 0; i < keys.size(); ++i) {
    leader[keys[i].edge] = keys[i].edge;
    for (size_t j = i; j-- > 0 && keys[i].offset - keys[j].offset < slack;) {
      if (std::abs(keys[i].angle - keys[j].angle) > 1e-9) continue;
      if (!samePlane(in, *edges[keys[j].edge], *edges[keys[i].edge])) continue;
      leader[keys[i].edge] = leader[keys[j].edge];
      break;
    }
  }
  std::vector<PlaneId> planeOf(edges.size(), kNone);
  for (size_t i = 0; i < edges.size(); ++i) {
    PlaneId& plane = planeOf[leader[i]];
    if (plane == kNone) {
      const InputEdge& e = *edges[leader[i]];
      plane = planes.add(in.points[e.from], in.points[e.to], e.weight / in.topWeight);
    }
    planeOf[i] = plane;
  }
  return planeOf;
}

/// True where a ring goes on so straight (10^-6) that a difference in weight cannot be met by a
/// hip.
bool collinear(const Input& in, const InputEdge& a, const InputEdge& b) {
  const GridPoint &p = in.points[a.from], &q = in.points[a.to], &r = in.points[b.to];
  const Vec2 d{static_cast<double>(q.x - p.x), static_cast<double>(q.y - p.y)};
  const Vec2 e{static_cast<double>(r.x - q.x), static_cast<double>(r.y - q.y)};
  return dot(d, e) > 0 && std::abs(cross(d, e)) <= 1e-6 * dot(d, e);
}

/// The chains for the wavefront. Where collinear neighbours move at two speeds, an upright edge
/// without length goes between them and grows as the faster one gets ahead.
std::vector<std::vector<WaveInput>> makeRings(const Input& in, const std::vector<PlaneId>& planeOf,
                                              Planes& planes, FaceInput& out) {
  std::vector<std::vector<WaveInput>> rings;
  auto stepFace = static_cast<uint32_t>(in.points.size());
  size_t next = 0;
  for (uint32_t k = 0; k < in.rings.size(); ++k) {
    const auto& ring = in.rings[k];
    auto& wave = rings.emplace_back();
    for (size_t i = 0; i < ring.size(); ++i) {
      const InputEdge& e = ring[i];
      const InputEdge& before = ring[(i + ring.size() - 1) % ring.size()];
      if (before.weight != e.weight && collinear(in, before, e)) {
        const GridPoint &p = in.points[e.from], &q = in.points[e.to];
        const int64_t dx = q.x - p.x, dy = q.y - p.y;
        const GridPoint left{p.x - dy, p.y + dx}, right{p.x + dy, p.y - dx};
        wave.push_back({planes.add(p, before.weight > e.weight ? right : left, 0), e.from});
        out.edges.push_back({e.from, e.from, stepFace++});
        out.steps.push_back({k, e.face - in.firstFace[k]});
      }
      wave.push_back({planeOf[next++], e.from});
      out.edges.push_back({e.from, e.to, e.face});
    }
  }
  return rings;
}

Skeleton failed(const char* code, const char* message, const char* hint) {
  Skeleton s;
  s.status = Status::failure(code, message, hint);
  return s;
}

}  // namespace

double Skeleton::maxHeight() const {
  double h = 0;
  for (const SkeletonVertex& v : vertices) h = std::max(h, v.height);
  return h;
}

Skeleton buildSkeleton(const Polygon& polygon, std::span<const std::vector<double>> weights,
                       double maxHeight) {
  constexpr const char* kInputHint = "Clean the polygon up first, or leave the roof out.";
  Input in;
  if (!readInput(polygon, weights, in) || !(maxHeight > 0)) {
    return failed("skeleton-input", "the polygon has no area, or a coordinate or weight is invalid",
                  kInputHint);
  }
  if (in.topWeight <= 0) {
    return failed("skeleton-unbounded", "no edge of the polygon moves",
                  "Give at least one edge a slope.");
  }
  for (size_t k = 0; k < in.rings.size(); ++k) {
    auto& ring = in.rings[k];
    if ((doubleArea(in, ring) > 0) != (k == 0)) {
      return failed("skeleton-input", "a ring of the polygon is turned the wrong way round",
                    "Outer rings are counter-clockwise, holes clockwise.");
    }
    dropDegenerate(in, ring);
    if (ring.size() < 3) {
      return failed("skeleton-input", "a ring of the polygon encloses nothing", kInputHint);
    }
  }

  FaceInput faceInput;
  std::vector<const InputEdge*> edges;
  for (const auto& ring : in.rings) {
    for (const InputEdge& e : ring) edges.push_back(&e);
  }
  Planes planes;
  const std::vector<PlaneId> planeOf = assignPlanes(in, edges, planes);
  Trace trace;
  for (const GridPoint& p : in.points) {
    trace.nodes.push_back({{static_cast<double>(p.x), static_cast<double>(p.y), 0}});
  }
  const std::vector<std::vector<WaveInput>> rings = makeRings(in, planeOf, planes, faceInput);
  uint32_t top = kNone;
  const double timeStep = in.step / in.topWeight;
  if (maxHeight / timeStep < 0x1p70) top = planes.addLevel(maxHeight / timeStep);
  const WaveEnd end = runWavefront(planes, rings, top, trace);
  if (end == WaveEnd::Unbounded) {
    return failed("skeleton-unbounded", "part of the polygon is never swept",
                  "Give at least one edge of each part a slope.");
  }

  Skeleton result;
  if (end == WaveEnd::Done) {
    faceInput.inputPoints.push_back(polygon.outer);
    for (const Ring& h : polygon.holes) faceInput.inputPoints.push_back(h);
    faceInput.center = in.center;
    faceInput.step = in.step;
    faceInput.timeStep = timeStep;
    faceInput.top = top == kNone ? 0 : maxHeight;
    if (assembleFaces(faceInput, trace, result)) return result;
  }
  return failed("skeleton-failed", "the polygon's skeleton could not be found",
                "The polygon may touch or cross itself; clean it up first.");
}

}  // namespace gable
