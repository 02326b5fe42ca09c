// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Roofs whose slopes are known without a skeleton: shed, pyramid and ridge.
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/work.h"
#include "geom/skeleton/roof.h"
#include "geom/skeleton/roof_pieces.h"
#include "math/trig.h"

namespace gable {

namespace {

using namespace skeleton;

Roof failedRoof(const char* code, const char* message, const char* hint) {
  Roof r;
  r.status = Status::failure(code, message, hint);
  return r;
}

bool goodPitch(RoofPitch pitch) {
  return pitch.by == RoofPitch::By::Angle ? pitch.value > 0 && pitch.value < 90
                                          : pitch.value > 0 && std::isfinite(pitch.value);
}

bool goodPolygon(const Polygon& p) {
  const auto good = [](const Ring& r) {
    return r.size() >= 3 && std::all_of(r.begin(), r.end(), [](Vec2 v) {
             return std::isfinite(v.x) && std::isfinite(v.y);
           });
  };
  return good(p.outer) && std::all_of(p.holes.begin(), p.holes.end(), good);
}

std::optional<Roof> refused(const Polygon& polygon, RoofPitch pitch) {
  if (!goodPitch(pitch)) {
    return failedRoof("roof-pitch",
                      "the roof's angle is not within 0 and 90 or its height not positive",
                      "Give an angle between 0 and 90 degrees or a positive height.");
  }
  if (!goodPolygon(polygon)) {
    return failedRoof("skeleton-input", "the polygon has no area or an invalid coordinate",
                      "Clean the polygon up first, or leave the roof out.");
  }
  return std::nullopt;
}

/// A polygon under a function of heights, while it is turned into faces.
class LiftedOutline {
 public:
  explicit LiftedOutline(const Polygon& polygon) : polygon_(polygon) {
    Box2 box;
    for (size_t r = 0; r <= polygon.holes.size(); ++r) {
      first_.push_back(static_cast<uint32_t>(roof.vertices.size()));
      for (const Vec2 p : ring(r)) {
        roof.vertices.push_back({p, 0});
        box.include(p);
      }
    }
    tolerance = 1e-9 * length(box.size());
  }

  size_t ringCount() const { return first_.size(); }
  const Ring& ring(size_t r) const { return r == 0 ? polygon_.outer : polygon_.holes[r - 1]; }
  uint32_t bottomOf(size_t r, size_t i) const {
    return first_[r] + static_cast<uint32_t>(i % ring(r).size());
  }
  uint32_t addVertex(Vec2 xy, double height) {
    roof.vertices.push_back({xy, height});
    return static_cast<uint32_t>(roof.vertices.size() - 1);
  }
  /// The vertex above a corner: the corner itself where the height is nothing.
  uint32_t lift(size_t r, size_t i, double height) {
    if (height <= tolerance) return bottomOf(r, i);
    return addVertex(ring(r)[i % ring(r).size()], height);
  }
  void addFace(RoofRole role, size_t r, size_t edge, std::vector<RoofLoop> loops) {
    roof.faces.push_back(
        {role, static_cast<uint32_t>(r), static_cast<uint32_t>(edge), std::move(loops)});
  }
  /// The upright face over an edge; `top` runs from over its end to over its start.
  void addSide(size_t r, size_t edge, const std::vector<uint32_t>& top) {
    std::vector<uint32_t> loop{bottomOf(r, edge), bottomOf(r, edge + 1)};
    for (const uint32_t v : top) {
      if (v != loop.front() && v != loop.back()) loop.push_back(v);
    }
    if (loop.size() < 3) return;
    addFace(r == 0 ? RoofRole::SideOuter : RoofRole::SideInner, r, edge,
            {bordered(std::move(loop))});
  }
  void addBottom() {
    std::vector<RoofLoop> loops;
    for (size_t r = 0; r < ringCount(); ++r) {
      const size_t n = ring(r).size();
      std::vector<uint32_t> loop;
      for (size_t i = 0; i < n; ++i) loop.push_back(bottomOf(r, n - i));
      loops.push_back(bordered(std::move(loop)));
    }
    addFace(RoofRole::Bottom, 0, 0, std::move(loops));
  }
  static RoofLoop bordered(std::vector<uint32_t> loop) {
    const size_t n = loop.size();
    return {std::move(loop), std::vector<RoofEdgeRole>(n, RoofEdgeRole::Border)};
  }

  Roof roof;
  double tolerance = 0;

 private:
  const Polygon& polygon_;
  std::vector<uint32_t> first_;
};

/// Border edges of a slope that lie on the bottom become eaves; the loop begins with one.
void markEaves(const Roof& roof, double tolerance, RoofLoop& loop) {
  const size_t n = loop.vertices.size();
  std::optional<size_t> first;
  for (size_t i = 0; i < n; ++i) {
    work();
    const double a = roof.vertices[loop.vertices[i]].height;
    const double b = roof.vertices[loop.vertices[(i + 1) % n]].height;
    if (loop.edges[i] != RoofEdgeRole::Border || a > tolerance || b > tolerance) continue;
    loop.edges[i] = RoofEdgeRole::Eave;
    if (!first) first = i;
  }
  const auto shift = static_cast<std::ptrdiff_t>(first.value_or(0));
  std::rotate(loop.vertices.begin(), loop.vertices.begin() + shift, loop.vertices.end());
  std::rotate(loop.edges.begin(), loop.edges.begin() + shift, loop.edges.end());
}

}  // namespace

Roof shedRoof(const Polygon& given, RoofPitch pitch, int64_t edge) {
  if (auto no = refused(given, pitch)) return *no;
  std::vector<bool> reversed;
  const Polygon polygon = orientedCopy(given, reversed);
  const Ring& outer = polygon.outer;
  const auto n = static_cast<int64_t>(outer.size());
  const int64_t wrapped = ((edge % n) + n) % n;
  const auto hinge = static_cast<size_t>(reversed[0] ? n - 1 - wrapped : wrapped);
  const Vec2 along = normalized(outer[(hinge + 1) % outer.size()] - outer[hinge]);
  const Vec2 up = perpendicular(along);
  const auto depth = [&](Vec2 p) { return dot(p - outer[hinge], up); };
  double nearest = 0, farthest = 0;
  for (const Vec2 p : outer) {
    nearest = std::min(nearest, depth(p));
    farthest = std::max(farthest, depth(p));
  }
  if (!(length(along) > 0) || !(farthest > nearest)) {
    return failedRoof("skeleton-input", "the edge that the roof rises from has no length",
                      "Choose another edge.");
  }
  const double rise =
      pitch.by == RoofPitch::By::Angle ? tanDeg(pitch.value) : pitch.value / (farthest - nearest);
  LiftedOutline lifted(polygon);
  std::vector<std::vector<uint32_t>> tops(lifted.ringCount());
  for (size_t r = 0; r < tops.size(); ++r) {
    for (size_t i = 0; i < lifted.ring(r).size(); ++i) {
      const bool onHinge = r == 0 && (i == hinge || i == (hinge + 1) % outer.size());
      const double d = onHinge ? 0 : depth(lifted.ring(r)[i]);
      tops[r].push_back(lifted.lift(r, i, (d - nearest) * rise));
    }
  }
  std::vector<RoofLoop> slope;
  for (const auto& top : tops) slope.push_back(LiftedOutline::bordered(top));
  std::rotate(slope[0].vertices.begin(),
              slope[0].vertices.begin() + static_cast<std::ptrdiff_t>(hinge),
              slope[0].vertices.end());
  for (RoofLoop& l : slope) markEaves(lifted.roof, lifted.tolerance, l);
  lifted.addFace(RoofRole::Slope, 0, hinge, std::move(slope));
  for (size_t r = 0; r < tops.size(); ++r) {
    const size_t count = tops[r].size();
    for (size_t i = 0; i < count; ++i) lifted.addSide(r, i, {tops[r][(i + 1) % count], tops[r][i]});
  }
  lifted.addBottom();
  restoreEdgeNumbers(lifted.roof, given, reversed);
  return std::move(lifted.roof);
}

Roof pyramidRoof(const Polygon& given, RoofPitch pitch) {
  if (auto no = refused(given, pitch)) return *no;
  std::vector<bool> reversed;
  const Polygon polygon = orientedCopy(given, reversed);
  LiftedOutline lifted(polygon);
  // The mean relative to the first point loses nothing far from the origin.
  Vec2 sum;
  const Vec2 origin = polygon.outer[0];
  size_t count = 0;
  for (size_t r = 0; r < lifted.ringCount(); ++r) {
    for (const Vec2 p : lifted.ring(r)) {
      sum = sum + (p - origin);
      ++count;
    }
  }
  const Vec2 center = origin + sum * (1.0 / static_cast<double>(count));
  double height = pitch.value;
  if (pitch.by == RoofPitch::By::Angle) {
    const size_t n = polygon.outer.size(), first = reversed[0] ? n - 1 : 0;
    const Vec2 a = polygon.outer[first], b = polygon.outer[(first + 1) % n];
    height = std::abs(dot(center - a, normalized(perpendicular(b - a)))) * tanDeg(pitch.value);
  }
  if (!(height > lifted.tolerance)) {
    return failedRoof("skeleton-input", "the middle of the polygon lies on its first edge",
                      "Give the roof's height instead of its angle.");
  }
  const uint32_t top = lifted.addVertex(center, height);
  for (size_t r = 0; r < lifted.ringCount(); ++r) {
    for (size_t i = 0; i < lifted.ring(r).size(); ++i) {
      RoofLoop l{{lifted.bottomOf(r, i), lifted.bottomOf(r, i + 1), top},
                 {RoofEdgeRole::Eave, RoofEdgeRole::Hip, RoofEdgeRole::Hip}};
      lifted.addFace(RoofRole::Slope, r, i, {std::move(l)});
    }
  }
  // Which of the arrises are hollow is known from the corners.
  for (size_t r = 0, f = 0; r < lifted.ringCount(); ++r) {
    const size_t n = lifted.ring(r).size();
    for (size_t i = 0; i < n; ++i) {
      const Vec2 a = lifted.ring(r)[i] - lifted.ring(r)[(i + n - 1) % n];
      const Vec2 b = lifted.ring(r)[(i + 1) % n] - lifted.ring(r)[i];
      if (cross(a, b) >= 0) continue;
      lifted.roof.faces[f + i].loops[0].edges[2] = RoofEdgeRole::Valley;
      lifted.roof.faces[f + (i + n - 1) % n].loops[0].edges[1] = RoofEdgeRole::Valley;
    }
    f += n;
  }
  lifted.addBottom();
  restoreEdgeNumbers(lifted.roof, given, reversed);
  return std::move(lifted.roof);
}

namespace {

/// A directed border of one side of the ridge; `edge` is the polygon's edge it runs along, if any.
struct SideBorder {
  uint32_t from = 0, to = 0;
  int64_t edge = -1;
};

/// Cuts an outline along the line v = 0 of its (u, v) coordinates into what lies on either side.
class RidgeCut {
 public:
  RidgeCut(LiftedOutline& lifted, const Polygon& polygon, Vec2 along, double middle, double half,
           double rise)
      : lifted_(lifted),
        polygon_(polygon),
        along_(along),
        up_(perpendicular(along)),
        middle_(middle),
        half_(half),
        rise_(rise) {}

  void run();

 private:
  double sideOf(Vec2 p) const {
    const double v = dot(p, up_) - middle_;
    return std::abs(v) <= lifted_.tolerance ? 0 : v;
  }
  double heightAt(Vec2 p) const { return (half_ - std::abs(sideOf(p))) * rise_; }
  Vec2 at(uint32_t v) const { return lifted_.roof.vertices[v].xy; }
  void cutRings();
  void joinAcross();
  void addSlopes(const std::vector<SideBorder>& borders);
  static size_t sharpestLeft(const std::vector<SideBorder>& borders, const std::vector<char>& used,
                             size_t last, const RidgeCut& cut);

  LiftedOutline& lifted_;
  const Polygon& polygon_;
  Vec2 along_, up_;
  double middle_, half_, rise_;
  /// Of the sides v > 0 and v < 0.
  std::vector<SideBorder> borders_[2];
  std::vector<uint32_t> onLine_;
};

/// Lifts the rings, puts vertices where they meet the line and adds the upright sides.
void RidgeCut::cutRings() {
  int64_t number = 0;
  for (size_t r = 0; r < lifted_.ringCount(); ++r) {
    const Ring& ring = lifted_.ring(r);
    const size_t n = ring.size();
    std::vector<uint32_t> top;
    for (size_t i = 0; i < n; ++i) {
      top.push_back(lifted_.lift(r, i, heightAt(ring[i])));
      if (sideOf(ring[i]) == 0) onLine_.push_back(top.back());
    }
    for (size_t i = 0; i < n; ++i, ++number) {
      const size_t j = (i + 1) % n;
      const double a = sideOf(ring[i]), b = sideOf(ring[j]);
      if (a * b < 0) {
        const Vec2 p = ring[i] + (ring[j] - ring[i]) * (a / (a - b));
        const uint32_t v = lifted_.addVertex(p, half_ * rise_);
        onLine_.push_back(v);
        borders_[a > 0 ? 0 : 1].push_back({top[i], v, number});
        borders_[b > 0 ? 0 : 1].push_back({v, top[j], number});
        lifted_.addSide(r, i, {top[j], v, top[i]});
        continue;
      }
      // An edge on the line bounds the side that its inside lies on.
      const bool above = a + b != 0 ? a + b > 0 : dot(ring[j] - ring[i], along_) > 0;
      borders_[above ? 0 : 1].push_back({top[i], top[j], number});
      lifted_.addSide(r, i, {top[j], top[i]});
    }
  }
}

/// The ridge: pieces of the line inside the polygon.
void RidgeCut::joinAcross() {
  std::sort(onLine_.begin(), onLine_.end(), [this](uint32_t a, uint32_t b) {
    const double ua = dot(at(a), along_), ub = dot(at(b), along_);
    return ua != ub ? ua < ub : a < b;
  });
  const auto bordered = [&](uint32_t a, uint32_t b) {
    for (const auto& side : borders_) {
      for (const SideBorder& s : side) {
        if ((s.from == a && s.to == b) || (s.from == b && s.to == a)) return true;
      }
    }
    return false;
  };
  for (size_t i = 0; i + 1 < onLine_.size(); ++i) {
    work();
    const uint32_t a = onLine_[i], b = onLine_[i + 1];
    if (bordered(a, b) || !contains(polygon_, (at(a) + at(b)) * 0.5)) continue;
    borders_[0].push_back({a, b, -1});
    borders_[1].push_back({b, a, -1});
  }
}

/// Where several borders go on from the end of one, the sharpest turn to the left keeps parts apart
/// that touch in a point.
size_t RidgeCut::sharpestLeft(const std::vector<SideBorder>& borders, const std::vector<char>& used,
                              size_t last, const RidgeCut& cut) {
  size_t best = borders.size();
  double least = 0;
  const Vec2 back = cut.at(borders[last].from) - cut.at(borders[last].to);
  for (size_t i = 0; i < borders.size(); ++i) {
    work();
    if (used[i] || borders[i].from != borders[last].to) continue;
    const Vec2 out = cut.at(borders[i].to) - cut.at(borders[i].from);
    double inside = atan2Deg(cross(out, back), dot(out, back));
    if (inside <= 0) inside += 360;
    if (best == borders.size() || inside < least) {
      best = i;
      least = inside;
    }
  }
  return best;
}

void RidgeCut::addSlopes(const std::vector<SideBorder>& borders) {
  struct Part {
    RoofLoop loop;
    Ring plan;
    int64_t edge = -1;
  };
  std::vector<Part> outer, inner;
  std::vector<char> used(borders.size(), 0);
  for (size_t i = 0; i < borders.size(); ++i) {
    work();
    if (used[i]) continue;
    Part part;
    for (size_t k = i; k < borders.size(); k = sharpestLeft(borders, used, k, *this)) {
      used[k] = 1;
      part.loop.vertices.push_back(borders[k].from);
      part.loop.edges.push_back(borders[k].edge < 0 ? RoofEdgeRole::Ridge : RoofEdgeRole::Border);
      part.plan.push_back(at(borders[k].from));
      if (part.edge < 0) part.edge = borders[k].edge;
    }
    if (part.plan.size() < 3) continue;
    (signedArea(part.plan) > 0 ? outer : inner).push_back(std::move(part));
  }
  for (Part& p : outer) {
    std::vector<RoofLoop> loops;
    markEaves(lifted_.roof, lifted_.tolerance, p.loop);
    loops.push_back(std::move(p.loop));
    for (Part& h : inner) {
      if (!contains(Polygon{p.plan, {}}, h.plan[0])) continue;
      markEaves(lifted_.roof, lifted_.tolerance, h.loop);
      loops.push_back(h.loop);
    }
    size_t r = 0;
    auto edge = static_cast<size_t>(std::max<int64_t>(p.edge, 0));
    while (edge >= lifted_.ring(r).size()) edge -= lifted_.ring(r++).size();
    lifted_.addFace(RoofRole::Slope, r, edge, std::move(loops));
  }
}

void RidgeCut::run() {
  cutRings();
  joinAcross();
  std::vector<RoofFace> sides = std::move(lifted_.roof.faces);
  lifted_.roof.faces.clear();
  for (const auto& borders : borders_) addSlopes(borders);
  lifted_.roof.faces.insert(lifted_.roof.faces.end(), sides.begin(), sides.end());
  lifted_.addBottom();
}

}  // namespace

Roof ridgeRoof(const Polygon& given, RoofPitch pitch, Vec2 direction) {
  if (auto no = refused(given, pitch)) return *no;
  const Vec2 along = normalized(direction);
  std::vector<bool> reversed;
  const Polygon polygon = orientedCopy(given, reversed);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2 p : polygon.outer) {
    low = std::min(low, dot(p, perpendicular(along)));
    high = std::max(high, dot(p, perpendicular(along)));
  }
  LiftedOutline lifted(polygon);
  const double half = (high - low) / 2;
  if (!(length(along) > 0) || !(half > lifted.tolerance)) {
    return failedRoof("skeleton-input",
                      "the polygon is flat across the ridge or the ridge has no "
                      "direction",
                      "Give the ridge another direction.");
  }
  const double rise = pitch.by == RoofPitch::By::Angle ? tanDeg(pitch.value) : pitch.value / half;
  RidgeCut(lifted, polygon, along, low + half, half, rise).run();
  restoreEdgeNumbers(lifted.roof, given, reversed);
  return std::move(lifted.roof);
}

}  // namespace gable
