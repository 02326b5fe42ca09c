// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Hip and gable roofs from the weighted straight skeleton. After Laycock and Day (2003) a gable end
// is an edge that stands still; its upright face in the skeleton is the gable. Overhangs are the
// skeleton of the ground outside, cut off where the eaves end: its faces continue the slopes
// downwards, and where overhangs run into each other they meet as valleys do. Over a gable end the
// strip outside is shared out among the slopes that end there, along the lines in which their
// planes meet.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/work.h"
#include "geom/skeleton/roof.h"
#include "geom/skeleton/roof_pieces.h"
#include "math/trig.h"

namespace gable {

namespace {

using namespace skeleton;

using Weights = std::vector<std::vector<double>>;

/// How each edge takes part: eaves carry a slope, the others are upright.
struct Plan {
  /// The cotangent of the slope; 0 where upright.
  Weights weights;
  /// How far the roof reaches out beyond each edge, level; below zero it stays behind the edge.
  Weights reach;
};

Weights uniform(const Polygon& p, double value) {
  Weights w{std::vector<double>(p.outer.size(), value)};
  for (const Ring& h : p.holes) w.emplace_back(h.size(), value);
  return w;
}

bool anyPositive(const Weights& w) {
  for (const auto& ring : w) {
    for (const double v : ring) {
      if (v > 0) return true;
    }
  }
  return false;
}

bool isUpright(double weight) { return weight <= 0; }

/// The skeleton becomes the roof's pieces; its vertices are appended after the polygon's.
void addSkeleton(const Skeleton& s, const Plan& plan, RoofPieces& roof) {
  for (size_t v = s.inputCount; v < s.vertices.size(); ++v) roof.addVertex(s.vertices[v]);
  for (const SkeletonFace& f : s.faces) {
    work(8);
    if (f.loop.size() < 3) continue;
    const uint32_t e = roof.edgeNumber(f.ring, f.edge);
    if (f.step || isUpright(plan.weights[f.ring][f.edge])) {
      roof.addSide(e, f.loop);
      continue;
    }
    roof.addSlopePiece(e, f.loop);
    for (const auto& h : f.holes) roof.addSlopePiece(e, h);
  }
}

/// A slope as height over the plan: rises by `rise` per metre from its edge.
struct SlopePlane {
  Vec2 origin, normal;
  double rise = 0;
  double heightAt(Vec2 p) const { return dot(p - origin, normal) * rise; }
};

SlopePlane slopeOf(const RoofPieces& roof, const Plan& plan, uint32_t e) {
  const uint32_t ring = roof.ringOf(e);
  const Vec2 a = roof.vertex(roof.startOf(e)).xy, b = roof.vertex(roof.endOf(e)).xy;
  const double w = plan.weights[ring][e - roof.edgeNumber(ring, 0)];
  return {a, normalized(perpendicular(b - a)), isUpright(w) ? 0 : 1 / w};
}

/// Vertices outside the polygon, told apart by height: where the overhangs of a gable and an eave
/// run into each other, the same place has two.
class OutsideVertices {
 public:
  explicit OutsideVertices(RoofPieces& roof) : roof_(roof) {}

  /// The vertex above or below `v` at the height; corners of the polygon and vertices of the inside
  /// stay what they are.
  uint32_t at(uint32_t v, double height) {
    if (v < firstOutside_) return v;
    auto& known = variants_[v];
    for (const uint32_t k : known) {
      if (std::abs(roof_.vertex(k).height - height) <= roof_.tolerance()) return k;
    }
    known.push_back(known.empty() ? v : roof_.addVertex(roof_.vertex(v)));
    roof_.setHeight(known.back(), height);
    return known.back();
  }
  uint32_t add(Vec2 xy) { return roof_.addVertex({xy, 0}); }

 private:
  RoofPieces& roof_;
  uint32_t firstOutside_ = static_cast<uint32_t>(roof_.vertexCount());
  std::map<uint32_t, std::vector<uint32_t>> variants_;
};

/// Parts a strip outside a gable end among the slopes over the gable.
class GableStrip {
 public:
  GableStrip(RoofPieces& roof, const Plan& plan, const Skeleton& inside, OutsideVertices& outside)
      : roof_(roof), plan_(plan), inside_(inside), outside_(outside) {}

  /// `strip` begins with the edge's end and start. The slopes along the gable's top are those whose
  /// faces border the upright one.
  bool add(uint32_t edge, const std::vector<uint32_t>& upright, std::vector<uint32_t> strip);

 private:
  uint32_t slopeAt(uint32_t from, uint32_t to) const;
  void addPiece(uint32_t slope, std::vector<uint32_t> piece);
  bool cut(std::vector<uint32_t>& strip, uint32_t at, Vec2 direction, std::vector<uint32_t>& rest);

  RoofPieces& roof_;
  const Plan& plan_;
  const Skeleton& inside_;
  OutsideVertices& outside_;
};

uint32_t GableStrip::slopeAt(uint32_t from, uint32_t to) const {
  for (const SkeletonFace& f : inside_.faces) {
    for (size_t i = 0; i < f.loop.size(); ++i) {
      work();
      if (f.loop[i] == from && f.loop[(i + 1) % f.loop.size()] == to) {
        return roof_.edgeNumber(f.ring, f.edge);
      }
    }
  }
  return roof_.edgeCount();
}

/// Parts the strip along a ray from one of its vertices; `rest` gets what follows the vertex.
bool GableStrip::cut(std::vector<uint32_t>& strip, uint32_t vertex, Vec2 direction,
                     std::vector<uint32_t>& rest) {
  const size_t n = strip.size();
  const size_t s =
      static_cast<size_t>(std::find(strip.begin(), strip.end(), vertex) - strip.begin());
  if (s == n) return false;
  const Vec2 origin = roof_.vertex(vertex).xy, side = perpendicular(direction);
  double nearest = std::numeric_limits<double>::infinity(), share = 0;
  size_t hit = n;
  for (size_t i = 0; i < n; ++i) {
    work();
    const size_t j = (i + 1) % n;
    if (i == s || j == s) continue;
    const Vec2 p = roof_.vertex(strip[i]).xy - origin, q = roof_.vertex(strip[j]).xy - origin;
    const double ps = dot(p, side), qs = dot(q, side);
    if ((ps < 0) == (qs < 0)) continue;
    const double k = ps / (ps - qs);
    const double reach = dot(p + (q - p) * k, direction);
    if (reach > 0 && reach < nearest) {
      nearest = reach;
      hit = i;
      share = k;
    }
  }
  if (hit == n) return false;
  const Vec2 p = roof_.vertex(strip[hit]).xy, q = roof_.vertex(strip[(hit + 1) % n]).xy;
  const uint32_t fresh = outside_.add(p + (q - p) * share);
  std::vector<uint32_t> one{fresh}, two{vertex};
  for (size_t i = (hit + 1) % n;; i = (i + 1) % n) {
    one.push_back(strip[i]);
    if (i == s) break;
  }
  for (size_t i = (s + 1) % n;; i = (i + 1) % n) {
    two.push_back(strip[i]);
    if (i == hit) break;
  }
  two.push_back(fresh);
  strip = std::move(one);
  rest = std::move(two);
  return true;
}

bool GableStrip::add(uint32_t edge, const std::vector<uint32_t>& upright,
                     std::vector<uint32_t> strip) {
  // The upright face runs start, end, then back along the top from over the end to over the start.
  std::vector<uint32_t> top(upright.begin() + 1, upright.end());
  top.push_back(upright[0]);
  std::vector<uint32_t> slopes;
  for (size_t i = 0; i + 1 < top.size(); ++i) {
    work();
    slopes.push_back(slopeAt(top[i + 1], top[i]));
    if (slopes.back() == roof_.edgeCount()) return false;
  }
  // The strip's first edge runs the same way, end to start; the top's corners lie on it.
  strip.insert(strip.begin() + 1, top.begin() + 1, top.end() - 1);
  const Vec2 outwards = slopeOf(roof_, plan_, edge).normal * -1.0;
  for (size_t i = 0; i + 1 < slopes.size(); ++i) {
    work();
    const SlopePlane a = slopeOf(roof_, plan_, slopes[i]), b = slopeOf(roof_, plan_, slopes[i + 1]);
    Vec2 ridge = normalized(perpendicular(a.normal * a.rise - b.normal * b.rise));
    if (dot(ridge, outwards) < 0) ridge = -ridge;
    std::vector<uint32_t> rest;
    if (dot(ridge, outwards) < 1e-3 || !cut(strip, top[i + 1], ridge, rest)) return false;
    addPiece(slopes[i], strip);
    strip = std::move(rest);
  }
  addPiece(slopes.back(), strip);
  return true;
}

void GableStrip::addPiece(uint32_t slope, std::vector<uint32_t> piece) {
  const SlopePlane plane = slopeOf(roof_, plan_, slope);
  for (uint32_t& v : piece) v = outside_.at(v, plane.heightAt(roof_.vertex(v).xy));
  roof_.addSlopePiece(slope, std::move(piece));
}

/// The ground outside one ring: the ring reversed, in a wide frame if it is the outer one.
struct Outside {
  Polygon polygon;
  Weights weights;
};

Outside outsideOf(const RoofPieces& roof, const Plan& plan, uint32_t r) {
  const Ring& ring = roof.ring(r);
  const size_t n = ring.size();
  Ring back(n);
  std::vector<double> reach(n);
  double farthest = 0;
  for (size_t i = 0; i < n; ++i) {
    work();
    back[i] = ring[n - 1 - i];
    reach[i] = std::max(0.0, plan.reach[r][(2 * n - 2 - i) % n]);
    farthest = std::max(farthest, reach[i]);
  }
  Outside out;
  if (r > 0) {
    out.polygon.outer = std::move(back);
    out.weights = {std::move(reach)};
    return out;
  }
  // Sharp corners reach out farther than the overhang; the frame ends them at ten times as far.
  Box2 box;
  for (const Vec2 p : ring) box.include(p);
  const Vec2 margin{10 * farthest, 10 * farthest};
  const Vec2 lo = box.min - margin, hi = box.max + margin;
  out.polygon.outer = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
  out.polygon.holes.push_back(std::move(back));
  out.weights = {std::vector<double>(4, 0.0), std::move(reach)};
  return out;
}

Status addOverhangs(RoofPieces& roof, const Plan& plan, const Skeleton& inside) {
  if (!anyPositive(plan.reach)) return {};
  OutsideVertices outsideVertices(roof);
  GableStrip gables(roof, plan, inside, outsideVertices);
  for (uint32_t r = 0; r < roof.ringCount(); ++r) {
    const Outside outside = outsideOf(roof, plan, r);
    if (!anyPositive(outside.weights)) continue;
    const Skeleton s = buildSkeleton(outside.polygon, outside.weights, 1);
    if (!s.status.ok()) return s.status;
    const auto n = static_cast<uint32_t>(roof.ring(r).size());
    const uint32_t frame = r == 0 ? 4 : 0;
    const uint32_t first = roof.edgeNumber(r, 0);
    std::vector<uint32_t> number(s.vertices.size());
    for (uint32_t v = 0; v < s.vertices.size(); ++v) {
      work();
      const bool corner = v >= frame && v < frame + n;
      number[v] = corner ? first + n - 1 - (v - frame) : outsideVertices.add(s.vertices[v].xy);
    }
    for (const SkeletonFace& f : s.faces) {
      work(8);
      if (f.step || f.loop.size() < 3 || (r == 0 && f.ring == 0)) continue;
      const uint32_t k = (2 * n - 2 - f.edge) % n;
      if (plan.reach[r][k] <= 0) continue;
      std::vector<uint32_t> loop;
      for (const uint32_t v : f.loop) loop.push_back(number[v]);
      if (isUpright(plan.weights[r][k])) {
        const uint32_t e = first + k;
        for (const SkeletonFace& g : inside.faces) {
          work(4);
          if (!g.step && roof.edgeNumber(g.ring, g.edge) == e && g.loop.size() > 2) {
            gables.add(e, g.loop, loop);
          }
        }
        continue;
      }
      const SlopePlane slope = slopeOf(roof, plan, first + k);
      for (uint32_t& v : loop) v = outsideVertices.at(v, slope.heightAt(roof.vertex(v).xy));
      roof.addSlopePiece(first + k, std::move(loop));
    }
  }
  return {};
}

Roof failedRoof(Status status) {
  Roof r;
  r.status = std::move(status);
  return r;
}

Status pitchStatus(RoofPitch pitch) {
  const bool good = pitch.by == RoofPitch::By::Angle
                        ? pitch.value > 0 && pitch.value < 90
                        : pitch.value > 0 && std::isfinite(pitch.value);
  if (good) return {};
  return Status::failure("roof-pitch",
                         "the roof's angle is not within 0 and 90 or its height not positive",
                         "Give an angle between 0 and 90 degrees or a positive height.");
}

void scaleHeights(Skeleton& s, double factor) {
  for (SkeletonVertex& v : s.vertices) v.height *= factor;
}

/// Slope cotangents become those of the pitch: `plan.weights` holds 1 at eaves. Heights follow.
void applyPitch(RoofPitch pitch, Skeleton& s, Plan& plan) {
  double rise = 1;
  if (pitch.by == RoofPitch::By::Angle) {
    rise = tanDeg(pitch.value);
  } else if (s.maxHeight() > 0) {
    rise = pitch.value / s.maxHeight();
  }
  scaleHeights(s, rise);
  for (auto& ring : plan.weights) {
    for (double& w : ring) w /= rise;
  }
}

/// The level part of a length measured down a slope of cotangent w.
double levelPart(double lengthDown, double w) { return lengthDown * w / std::sqrt(1 + w * w); }

/// The part of the plan that is below zero.
RoofRetreat retreatOf(const RoofPieces& roof, const Plan& plan) {
  RoofRetreat retreat;
  for (uint32_t r = 0; r < roof.ringCount(); ++r) {
    for (uint32_t k = 0; k < plan.reach[r].size(); ++k) {
      const double reach = plan.reach[r][k], weight = plan.weights[r][k];
      if (reach >= 0) continue;
      if (isUpright(weight)) {
        retreat.ends[roof.edgeNumber(r, k)] = -reach;
      } else {
        retreat.eaves = std::max(retreat.eaves, -reach / weight);
      }
    }
  }
  return retreat;
}

Roof finishRoof(const Polygon& given, const Polygon& polygon, const std::vector<bool>& reversed,
                const Skeleton& s, const Plan& plan, bool even) {
  RoofPieces pieces(polygon);
  addSkeleton(s, plan, pieces);
  if (Status status = addOverhangs(pieces, plan, s); !status.ok()) return failedRoof(status);
  Roof roof = pieces.finish(even, retreatOf(pieces, plan));
  restoreEdgeNumbers(roof, given, reversed);
  return roof;
}

}  // namespace

Roof hipRoof(const Polygon& given, RoofPitch pitch, double overhang, bool even) {
  if (Status status = pitchStatus(pitch); !status.ok()) return failedRoof(status);
  std::vector<bool> reversed;
  const Polygon polygon = orientedCopy(given, reversed);
  Skeleton s = buildSkeleton(polygon);
  if (!s.status.ok()) return failedRoof(s.status);
  Plan plan{uniform(polygon, 1), uniform(polygon, 0)};
  applyPitch(pitch, s, plan);
  if (overhang != 0) plan.reach = uniform(polygon, levelPart(overhang, plan.weights[0][0]));
  return finishRoof(given, polygon, reversed, s, plan, even);
}

Roof hipRoof(const Polygon& given, std::span<const std::vector<double>> angles, double overhang) {
  std::vector<bool> reversed;
  const Polygon polygon = orientedCopy(given, reversed);
  Plan plan{uniform(polygon, 1), uniform(polygon, 0)};
  double drop = std::numeric_limits<double>::infinity();
  for (size_t r = 0; r < plan.weights.size(); ++r) {
    const size_t n = plan.weights[r].size();
    for (size_t k = 0; k < n; ++k) {
      work();
      const size_t source = reversed[r] ? n - 1 - k : k;
      const double angle = r < angles.size() && source < angles[r].size() ? angles[r][source] : 0;
      if (!(angle > 0 && angle <= 90)) return failedRoof(pitchStatus({RoofPitch::By::Angle, 0}));
      plan.weights[r][k] = angle == 90 ? 0 : 1 / tanDeg(angle);
      if (angle < 90) drop = std::min(drop, overhang * sinDeg(angle));
    }
  }
  const Skeleton s = buildSkeleton(polygon, plan.weights);
  if (!s.status.ok()) return failedRoof(s.status);
  if (overhang > 0) {
    // Slopes that meet at a corner must end at one height, so the flattest one sets it.
    for (size_t r = 0; r < plan.weights.size(); ++r) {
      for (size_t k = 0; k < plan.weights[r].size(); ++k) {
        plan.reach[r][k] = drop * plan.weights[r][k];
      }
    }
  }
  return finishRoof(given, polygon, reversed, s, plan, false);
}

namespace {

/// Edges whose faces are triangles between two convex corners, with no two neighbours.
std::vector<std::vector<char>> gableEnds(const Polygon& polygon, const Skeleton& s) {
  struct End {
    double length;
    uint32_t ring, edge;
  };
  std::vector<End> ends;
  const auto ringOf = [&](uint32_t r) -> const Ring& {
    return r == 0 ? polygon.outer : polygon.holes[r - 1];
  };
  const auto convexAt = [&](const Ring& r, size_t i) {
    const size_t n = r.size();
    const Vec2 in = r[i] - r[(i + n - 1) % n], out = r[(i + 1) % n] - r[i];
    return cross(in, out) > 1e-6 * length(in) * length(out);
  };
  for (const SkeletonFace& f : s.faces) {
    if (f.loop.size() != 3) continue;
    const Ring& r = ringOf(f.ring);
    const size_t next = (f.edge + 1) % r.size();
    if (!convexAt(r, f.edge) || !convexAt(r, next)) continue;
    ends.push_back({length(r[next] - r[f.edge]), f.ring, f.edge});
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    const double slack = 1e-6 * std::max(a.length, b.length);
    if (std::abs(a.length - b.length) > slack) return a.length < b.length;
    if (a.ring != b.ring) return a.ring < b.ring;
    // Of equal ends edge 0 comes last, so that it stays an eave.
    return (a.edge == 0 ? 0xffffffff : a.edge) < (b.edge == 0 ? 0xffffffff : b.edge);
  });
  std::vector<std::vector<char>> chosen{std::vector<char>(polygon.outer.size(), 0)};
  for (const Ring& h : polygon.holes) chosen.emplace_back(h.size(), 0);
  for (const End& e : ends) {
    auto& c = chosen[e.ring];
    const size_t n = c.size();
    if (c[(e.edge + 1) % n] == 0 && c[(e.edge + n - 1) % n] == 0) c[e.edge] = 1;
  }
  return chosen;
}

bool isConvex(const Ring& r) {
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 a = r[(i + 1) % r.size()] - r[i];
    const Vec2 b = r[(i + 2) % r.size()] - r[(i + 1) % r.size()];
    if (cross(a, b) < -1e-9 * length(a) * length(b)) return false;
  }
  return true;
}

/// All edges are gable ends but the given one and the one that faces it most.
std::vector<std::vector<char>> gableEndsAlong(const Ring& r, size_t edge) {
  const size_t n = r.size();
  const auto direction = [&](size_t i) { return normalized(r[(i + 1) % n] - r[i % n]); };
  size_t facing = edge;
  double best = -0.1;
  for (size_t i = 0; i < n; ++i) {
    // Longer edges win over shorter ones that face the edge equally.
    const double d = dot(direction(i), direction(edge));
    if (d < best - 1e-9) {
      best = d;
      facing = i;
    }
  }
  std::vector<char> chosen(n, 1);
  for (size_t i = 0; i < n; ++i) {
    const bool eave = dot(direction(i), direction(edge)) > 1 - 1e-6 ||
                      (facing != edge && dot(direction(i), direction(facing)) > 1 - 1e-6);
    if (eave) chosen[i] = 0;
  }
  return {chosen};
}

}  // namespace

Roof gableRoof(const Polygon& given, RoofPitch pitch, const GableOptions& options) {
  if (Status status = pitchStatus(pitch); !status.ok()) return failedRoof(status);
  std::vector<bool> reversed;
  const Polygon polygon = orientedCopy(given, reversed);
  const auto n = static_cast<int64_t>(polygon.outer.size());
  bool even = options.even;
  std::vector<std::vector<char>> ends;
  if (options.ridgeEdge && n >= 3 && polygon.holes.empty() && isConvex(polygon.outer)) {
    const int64_t wrapped = ((*options.ridgeEdge % n) + n) % n;
    ends =
        gableEndsAlong(polygon.outer, static_cast<size_t>(reversed[0] ? n - 1 - wrapped : wrapped));
    even = false;
  } else {
    const Skeleton hip = buildSkeleton(polygon);
    if (!hip.status.ok()) return failedRoof(hip.status);
    ends = gableEnds(polygon, hip);
  }
  Plan plan{uniform(polygon, 1), uniform(polygon, 0)};
  for (size_t r = 0; r < ends.size(); ++r) {
    for (size_t k = 0; k < ends[r].size(); ++k) {
      if (ends[r][k]) plan.weights[r][k] = 0;
    }
  }
  Skeleton s = buildSkeleton(polygon, plan.weights);
  if (!s.status.ok()) return failedRoof(s.status);
  applyPitch(pitch, s, plan);
  for (size_t r = 0; r < ends.size(); ++r) {
    for (size_t k = 0; k < ends[r].size(); ++k) {
      plan.reach[r][k] =
          ends[r][k] ? options.overhangY : levelPart(options.overhangX, plan.weights[r][k]);
    }
  }
  return finishRoof(given, polygon, reversed, s, plan, even);
}

}  // namespace gable
