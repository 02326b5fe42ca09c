// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Puts the polygon on an integer grid, finds the edges that lie in one plane, runs the wavefront
// and hands its trace to faces.cpp.
#include "geom/skeleton/skeleton.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/work.h"
#include "geom/region/segment_grid.h"
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
  /// What counts as in line, in grid steps: 2^-30 of the extent and the rounding of far
  /// coordinates.
  double slack = 0;
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
  const double far = std::max(
      {std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
  in.slack = 0x1p21 + far * 0x1p-51 / in.step;
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
      work();
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

Vec2 gridVec(GridPoint p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

/// The line of an edge and its speed, as a leader of edges in one plane.
struct Line {
  Vec2 origin, direction;
  double weight = 0;
  size_t edge = 0;
};

/// True where an edge lies in the leader's plane: both ends within `slack` of its line, or exactly
/// on it where slack is nothing.
bool liesOn(const Input& in, const Line& line, const InputEdge& leader, const InputEdge& e,
            double slack) {
  if (line.weight != e.weight) return false;
  const Vec2 p = gridVec(in.points[e.from]) - line.origin;
  // Doubles see a grid point on the line within two steps.
  if (std::abs(cross(line.direction, p)) > slack + 2) return false;
  const Vec2 q = gridVec(in.points[e.to]) - line.origin;
  if (std::abs(cross(line.direction, q)) > slack + 2) return false;
  const double along = dot(line.direction, q - p);
  if (along <= 0) return false;
  // A short edge must point the same way too, since its face may reach far.
  if (slack > 0) return std::abs(cross(line.direction, q - p)) <= 5e-8 * along + 2;
  const GridPoint &a = in.points[leader.from], &b = in.points[leader.to];
  return crossOf(a, b, in.points[e.from]) == 0 && crossOf(a, b, in.points[e.to]) == 0;
}

/// Gives each edge a plane; edges in one plane share it, that of the longest. O(n * planes).
std::vector<PlaneId> assignPlanes(const Input& in, const std::vector<const InputEdge*>& edges,
                                  double slack, Planes& planes) {
  std::vector<size_t> order(edges.size());
  std::vector<double> lengths;
  for (const InputEdge* e : edges) {
    lengths.push_back(length(gridVec(in.points[e->to]) - gridVec(in.points[e->from])));
  }
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return lengths[a] > lengths[b]; });
  std::vector<Line> lines;
  std::vector<size_t> lineOf(edges.size());
  for (const size_t i : order) {
    work();
    const InputEdge& e = *edges[i];
    const auto known = std::find_if(lines.begin(), lines.end(), [&](const Line& l) {
      return liesOn(in, l, *edges[l.edge], e, slack);
    });
    lineOf[i] = static_cast<size_t>(known - lines.begin());
    if (known != lines.end()) continue;
    const Vec2 from = gridVec(in.points[e.from]);
    lines.push_back({from, normalized(gridVec(in.points[e.to]) - from), e.weight, i});
  }
  // Numbered in the order of the edges, so that a plane's hair does not hang on lengths.
  std::vector<PlaneId> planeOfLine(lines.size(), kNone), planeOf(edges.size());
  for (size_t i = 0; i < edges.size(); ++i) {
    PlaneId& plane = planeOfLine[lineOf[i]];
    if (plane == kNone) {
      const InputEdge& e = *edges[lines[lineOf[i]].edge];
      plane = planes.add(in.points[e.from], in.points[e.to], e.weight / in.topWeight);
    }
    planeOf[i] = plane;
  }
  return planeOf;
}

/// True where the corners in which shared planes meet are still the polygon's corners, but for
/// `reach`, and no edge is so short that this turns it round.
bool keepsCorners(const Input& in, const std::vector<PlaneId>& planeOf, double reach,
                  const Planes& planes) {
  size_t first = 0;
  for (const auto& ring : in.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const PlaneId p = planeOf[first + (i + ring.size() - 1) % ring.size()];
      const PlaneId q = planeOf[first + i];
      const Vec2 corner = gridVec(in.points[ring[i].from]);
      if (length(gridVec(in.points[ring[i].to]) - corner) < 4 * reach) return false;
      if (p == q) continue;
      const Plane &a = planes[p], &b = planes[q];
      const double det = a.na * b.nb - b.na * a.nb;
      const double fa = a.na * corner.x + a.nb * corner.y + a.nc;
      const double fb = b.na * corner.x + b.nb * corner.y + b.nc;
      const Vec2 shift{fa * b.nb - fb * a.nb, a.na * fb - b.na * fa};
      if (!(length(shift) <= reach * std::abs(det))) return false;
    }
    first += ring.size();
  }
  return true;
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
        out.edges.push_back({e.from, e.from, stepFace++, true});
        out.steps.push_back({k, e.face - in.firstFace[k]});
      }
      wave.push_back({planeOf[next++], e.from});
      out.edges.push_back({e.from, e.to, e.face, e.weight == 0});
    }
  }
  return rings;
}

double distanceTo(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double share = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-300), 0.0, 1.0);
  return length(p - (a + d * share));
}

/// Moves corners that touch another part of the boundary (within `reach`, in grid units) back from
/// it by twice as much, into the outside of their own ring. True if there are any. O(n^2).
bool loosenContacts(Input& in, double reach) {
  const auto at = [&](uint32_t i) {
    return Vec2{static_cast<double>(in.points[i].x), static_cast<double>(in.points[i].y)};
  };
  struct Move {
    uint32_t point;
    Vec2 by;
  };
  std::vector<Move> moves;
  for (const auto& own : in.rings) {
    for (size_t i = 0; i < own.size(); ++i) {
      const uint32_t before = own[(i + own.size() - 1) % own.size()].from;
      const uint32_t p = own[i].from, after = own[i].to;
      const Vec2 to = normalized(at(p) - at(before)), from = normalized(at(after) - at(p));
      // Only corners that stick into the polygon or lie straight can be in the way.
      if (cross(to, from) > 1e-6) continue;
      bool touches = false;
      for (const auto& ring : in.rings) {
        for (const InputEdge& e : ring) {
          work(2);
          if (e.from == p || e.to == p) continue;
          touches = touches || distanceTo(at(p), at(e.from), at(e.to)) <= reach;
        }
      }
      if (!touches) continue;
      const Vec2 back = normalized(from - to), right = normalized(perpendicular(from + to)) * -1.0;
      moves.push_back({p, (length(from - to) > 1e-6 ? back : right) * (2 * reach)});
    }
  }
  for (const Move& m : moves) {
    in.points[m.point].x += static_cast<int64_t>(std::nearbyint(m.by.x));
    in.points[m.point].y += static_cast<int64_t>(std::nearbyint(m.by.y));
  }
  return !moves.empty();
}

/// One run over the polygon as it is on the grid; edges within `slack` of one line share a plane.
WaveEnd sweep(const Polygon& polygon, const Input& in, double slack, double maxHeight,
              Skeleton& out) {
  std::vector<const InputEdge*> edges;
  for (const auto& ring : in.rings) {
    for (const InputEdge& e : ring) edges.push_back(&e);
  }
  Planes planes;
  const std::vector<PlaneId> planeOf = assignPlanes(in, edges, slack, planes);
  if (slack > 0 && !keepsCorners(in, planeOf, 8 * slack, planes)) return WaveEnd::Stuck;
  Trace trace;
  for (const GridPoint& p : in.points) {
    trace.nodes.push_back({{static_cast<double>(p.x), static_cast<double>(p.y), 0}});
  }
  FaceInput faceInput;
  const std::vector<std::vector<WaveInput>> rings = makeRings(in, planeOf, planes, faceInput);
  uint32_t top = kNone;
  const double timeStep = in.step / in.topWeight;
  // Nothing is that high, and what is lower than a grid step is no height.
  const double topTime = std::max(maxHeight / timeStep, 0x1p-20);
  if (topTime < 0x1p70) top = planes.addLevel(topTime);
  const WaveEnd end = runWavefront(planes, rings, top, trace);
  if (end != WaveEnd::Done) return end;
  faceInput.inputPoints.push_back(polygon.outer);
  for (const Ring& h : polygon.holes) faceInput.inputPoints.push_back(h);
  faceInput.center = in.center;
  faceInput.step = in.step;
  faceInput.timeStep = timeStep;
  faceInput.top = top == kNone ? 0 : maxHeight;
  return assembleFaces(faceInput, trace, out) ? end : WaveEnd::Stuck;
}

/// True where corners of the boundary share a place.
bool hasContacts(const Input& in) {
  std::vector<std::pair<int64_t, int64_t>> places;
  for (const auto& ring : in.rings) {
    for (const InputEdge& e : ring) places.emplace_back(in.points[e.from].x, in.points[e.from].y);
  }
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

/// True where two edges cross clearly, on all four sides.
bool crossClearly(const Segment& s, const Segment& t, double tolerance) {
  const Vec2 along = s.b - s.a, other = t.b - t.a;
  const double reach = tolerance * length(along), otherReach = tolerance * length(other);
  const double a = cross(along, t.a - s.a), b = cross(along, t.b - s.a);
  const double c = cross(other, s.a - t.a), d = cross(other, s.b - t.a);
  const auto parts = [](double u, double v, double least) {
    return std::min(std::abs(u), std::abs(v)) > least && (u > 0) != (v > 0);
  };
  return parts(a, b, reach) && parts(c, d, otherReach);
}

/// True where faces overlap in plan: parts of a polygon that touch each other at a corner may have
/// been swept across each other.
bool overlaps(const Skeleton& s, double tolerance) {
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for (const SkeletonFace& f : s.faces) {
    work(f.loop.size());
    for (size_t i = 0; i < f.loop.size(); ++i) {
      pairs.push_back(std::minmax(f.loop[i], f.loop[(i + 1) % f.loop.size()]));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Segment> edges;
  for (const auto& [a, b] : pairs) edges.push_back({s.vertices[a].xy, s.vertices[b].xy});
  SegmentGrid grid(edges);
  for (uint32_t i = 0; i < edges.size(); ++i) {
    Box2 box;
    box.include(edges[i].a);
    box.include(edges[i].b);
    bool found = false;
    grid.query(box, [&](uint32_t k) {
      work();
      found = found || (k < i && crossClearly(edges[i], edges[k], tolerance));
    });
    if (found) return true;
  }
  return false;
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

  // First with walls in line as they were meant, then as they are to the last bit; a polygon that
  // touches itself is taken apart there by a hair, then by more of it.
  Skeleton result;
  const bool touches = hasContacts(in);
  const double tolerance = 0x1p20 * in.step;
  const auto run = [&](double slack) {
    const WaveEnd end = sweep(polygon, in, slack, maxHeight, result = {});
    return end == WaveEnd::Done && touches && overlaps(result, tolerance) ? WaveEnd::Stuck : end;
  };
  WaveEnd end = run(in.slack);
  if (end == WaveEnd::Stuck) end = run(0);
  for (const double reach : {0x1p18, 0x1p30}) {
    if (end != WaveEnd::Stuck) break;
    if (loosenContacts(in, reach)) end = run(0);
  }
  if (end == WaveEnd::Done) return result;
  if (end == WaveEnd::Unbounded) {
    return failed("skeleton-unbounded", "part of the polygon is never swept",
                  "Give one of the edges around it a slope.");
  }
  return failed("skeleton-failed", "the polygon's skeleton could not be found",
                "The polygon may cross itself; clean it up first.");
}

}  // namespace gable
