// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Clipper 6.4.2 (Vatti's sweep, "A generic solution to polygon clipping", 1992) does the work on
// integers. Its results may touch or cross by a rounding step; so they are welded at one grid unit
// and united again until the exact validity test agrees, which one round almost always reaches.
// Then surviving input points get their own coordinates back, unless that would break validity.
// Most results keep clear of all that: one look tells that neither is needed.
#include "geom/region/boolean.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/moved_outline.h"
#include "geom/region/tiles.h"

namespace gable {
namespace {

using ClipperLib::cInt;
using ClipperLib::IntPoint;
using ClipperLib::Paths;

// Rounds of weld and union before the result is taken as it is.
constexpr int kMaxRounds = 6;
// Grid coordinates stay below Clipper's limit of 2^62; beyond this extent the grid gets coarser.
constexpr double kMaxUnits = 0x1.0p52;
// What reaches farther, in metres, is no place: the grid would be coarser than a city.
constexpr double kMostExtent = 1e15;
// A round join is no finer than so much of the distance, some thousand chords a turn.
constexpr double kFinestRound = 1e-7;
// In grid units: points on the grid are moved by up to 0.71 when they get their coordinates back,
// and weld takes what is nearer than 1.
constexpr double kClear = 1.5;
// Corners of both operands: from so many on it pays to leave out those that are far from the
// result, and to work box by box.
constexpr size_t kSome = 24, kMany = 1200;
// What is so many units from a result has no part in it.
constexpr double kAround = 8;

bool isFinite(const Ring& r) {
  return std::all_of(r.begin(), r.end(),
                     [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

// The grid around a local origin, and the input points by their grid place.
class Grid {
 public:
  void include(const std::vector<Ring>& rings) {
    for (const Ring& r : rings) {
      if (!isFinite(r)) continue;
      for (const Vec2 p : r) box_.include(p);
    }
  }
  // Leaves room for what is moved outward so far.
  void widen(double distance, double miterLimit) {
    if (box_.empty()) return;
    const double reach = std::min(std::fabs(distance) * std::max(miterLimit, 1.0), 1e300);
    const Vec2 d{reach, reach};
    const Vec2 low = box_.min - d, high = box_.max + d;
    box_.include(low);
    box_.include(high);
  }
  // Chooses the origin: whole metres, so that grid points are exact in map coordinates too.
  void settle() {
    if (box_.empty()) return;
    const Vec2 c = box_.min * 0.5 + box_.max * 0.5;
    origin_ = {std::floor(c.x), std::floor(c.y)};
    const double extent = std::max(box_.size().x, box_.size().y);
    const double reach = std::max(std::fabs(origin_.x), std::fabs(origin_.y));
    if (!(std::max(extent, reach) <= kMostExtent)) {
      giveUp("beyond-range", "it would reach farther than can be worked with",
             "give it smaller distances");
    }
    while (extent / unit_ > kMaxUnits) unit_ *= 2;
  }
  Paths toPaths(const std::vector<Ring>& rings) {
    Paths out;
    for (const Ring& r : rings) {
      if (r.size() < 2 || !isFinite(r)) continue;
      ClipperLib::Path path;
      for (const Vec2 p : r) {
        const IntPoint q = toGrid(p);
        originals_.push_back({q, p, originals_.size()});
        if (path.empty() || path.back() != q) path.push_back(q);
      }
      out.push_back(std::move(path));
    }
    return out;
  }
  // Call after the last toPaths.
  void sortOriginals() {
    std::sort(originals_.begin(), originals_.end(), [](const Original& a, const Original& b) {
      if (a.at.X != b.at.X) return a.at.X < b.at.X;
      if (a.at.Y != b.at.Y) return a.at.Y < b.at.Y;
      return a.order < b.order;
    });
  }
  double unit() const { return unit_; }
  // Coordinates are so much finer than the grid that points on it keep their distances.
  bool isFine() const {
    const double reach = std::max({std::fabs(box_.min.x), std::fabs(box_.min.y),
                                   std::fabs(box_.max.x), std::fabs(box_.max.y)});
    return reach * 0x1.0p-52 < unit_ / 256;
  }
  Vec2 fromGrid(Vec2 q) const { return {origin_.x + q.x * unit_, origin_.y + q.y * unit_}; }
  // The input point at a grid place; `order` is its number in the input.
  bool original(Vec2 q, Vec2& point, size_t& order) const {
    const IntPoint key(static_cast<cInt>(q.x), static_cast<cInt>(q.y));
    const auto it = std::lower_bound(originals_.begin(), originals_.end(), key,
                                     [](const Original& o, const IntPoint& k) {
                                       return o.at.X != k.X ? o.at.X < k.X : o.at.Y < k.Y;
                                     });
    if (it == originals_.end() || it->at != key) return false;
    point = it->point;
    order = it->order;
    return true;
  }

 private:
  struct Original {
    IntPoint at;
    Vec2 point;
    size_t order;
  };
  IntPoint toGrid(Vec2 p) const {
    return {static_cast<cInt>(std::llround((p.x - origin_.x) / unit_)),
            static_cast<cInt>(std::llround((p.y - origin_.y) / unit_))};
  }
  Box2 box_;
  Vec2 origin_;
  double unit_ = kRegionGrid;
  std::vector<Original> originals_;
};

std::vector<Ring> toRings(const Paths& paths) {
  std::vector<Ring> out;
  for (const ClipperLib::Path& path : paths) {
    work(path.size());
    Ring r;
    r.reserve(path.size());
    for (const IntPoint& p : path) {
      r.push_back({static_cast<double>(p.X), static_cast<double>(p.Y)});
    }
    dropDuplicates(r, 0);
    if (!r.empty()) out.push_back(std::move(r));
  }
  return out;
}

Paths toPathsExact(const std::vector<Ring>& rings) {
  Paths out;
  for (const Ring& r : rings) {
    ClipperLib::Path path;
    for (const Vec2 p : r) path.emplace_back(static_cast<cInt>(p.x), static_cast<cInt>(p.y));
    out.push_back(std::move(path));
  }
  return out;
}

// Runs Clipper's code: what it throws ends here.
template <class Body>
Paths withClipper(Body&& body) {
  Paths out;
  try {
    if (body(out)) return out;
  } catch (const ClipperLib::clipperException&) {
  }
  giveUp("cannot-be-done", "its outlines are too tangled to be combined",
         "use simpler outlines, or clean them up first");
}

Paths execute(ClipperLib::ClipType type, const Paths& a, const Paths& b,
              ClipperLib::PolyFillType fill) {
  return withClipper([&](Paths& out) {
    ClipperLib::Clipper c;
    c.StrictlySimple(true);
    c.PreserveCollinear(true);
    c.AddPaths(a, ClipperLib::ptSubject, true);
    c.AddPaths(b, ClipperLib::ptClip, true);
    return c.Execute(type, out, fill, fill);
  });
}

// X and Y exchanged, and the rings turned round, so that they keep their orientation.
void transpose(Paths& paths) {
  for (ClipperLib::Path& path : paths) {
    for (IntPoint& p : path) std::swap(p.X, p.Y);
    std::reverse(path.begin(), path.end());
  }
}

// Unites rings. Clipper may leave polygons apart that share a part of a horizontal edge, however
// often it is asked; every other round sees them with the axes exchanged.
std::vector<Ring> united(const std::vector<Ring>& rings, int round) {
  const bool across = round % 2 == 1;
  Paths paths = toPathsExact(rings);
  if (across) transpose(paths);
  Paths out = execute(ClipperLib::ctUnion, paths, {}, ClipperLib::pftPositive);
  if (across) transpose(out);
  return toRings(out);
}

// Valid polygons in grid units from Clipper's output.
Region settle(const Paths& paths) {
  std::vector<Ring> rings = toRings(paths);
  Region region;
  for (int round = 0; round < kMaxRounds; ++round) {
    // On the integer grid a distance of one unit is the nearest that a rounded crossing can err.
    const bool moved = weld(rings, 1.0);
    if (moved) rings = united(rings, round);
    splitAtRepeats(rings);
    region = nest(rings);
    if (isValid(region)) return region;
    if (!moved) rings = united(rings, round + 1);
  }
  return region;
}

constexpr size_t kNoOrder = static_cast<size_t>(-1);

struct OrderedRing {
  size_t order = kNoOrder;
  size_t start = 0;
};

bool lessXy(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Gives a ring its input coordinates back and finds where it starts: at the first input vertex in
// it, else at the lowest point.
OrderedRing restore(Ring& r, const Grid& grid, bool originalPoints) {
  OrderedRing out;
  size_t lowest = 0;
  for (size_t i = 0; i < r.size(); ++i) {
    if (lessXy(r[i], r[lowest])) lowest = i;
  }
  out.start = lowest;
  for (size_t i = 0; i < r.size(); ++i) {
    Vec2 point;
    size_t order = 0;
    const bool known = grid.original(r[i], point, order);
    r[i] = known && originalPoints ? point : grid.fromGrid(r[i]);
    if (known && order < out.order) {
      out.order = order;
      out.start = i;
    }
  }
  std::rotate(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(out.start), r.end());
  return out;
}

bool before(const std::pair<OrderedRing, Ring>& a, const std::pair<OrderedRing, Ring>& b) {
  if (a.first.order != b.first.order) return a.first.order < b.first.order;
  return lessXy(a.second[0], b.second[0]);
}

Region restored(const Region& region, const Grid& grid, bool originalPoints) {
  std::vector<std::pair<OrderedRing, Ring>> outers;
  std::vector<std::vector<Ring>> holes;
  std::vector<size_t> order;
  for (const Polygon& p : region) {
    Ring outer = p.outer;
    const OrderedRing o = restore(outer, grid, originalPoints);
    outers.emplace_back(o, std::move(outer));
    std::vector<std::pair<OrderedRing, Ring>> sorted;
    for (Ring h : p.holes) {
      const OrderedRing at = restore(h, grid, originalPoints);
      sorted.emplace_back(at, std::move(h));
    }
    std::sort(sorted.begin(), sorted.end(), before);
    holes.emplace_back();
    for (auto& [at, h] : sorted) holes.back().push_back(std::move(h));
    order.push_back(order.size());
  }
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return before(outers[a], outers[b]); });
  Region out;
  for (const size_t i : order) out.push_back({std::move(outers[i].second), std::move(holes[i])});
  return out;
}

Region restoredIfValid(const Region& region, const Grid& grid) {
  Region out = restored(region, grid, true);
  return isValid(out) ? out : restored(region, grid, false);
}

Region finish(const Paths& paths, Grid& grid) {
  grid.sortOriginals();
  Region region;
  if (grid.isFine() && nestClear(toRings(paths), kClear, region)) {
    return restored(region, grid, true);
  }
  return restoredIfValid(settle(paths), grid);
}

size_t countOf(const Paths& paths) {
  size_t n = 0;
  for (const ClipperLib::Path& p : paths) n += p.size();
  return n;
}

std::vector<Ring> gridRings(const Paths& paths) {
  std::vector<Ring> out;
  for (const ClipperLib::Path& path : paths) {
    out.emplace_back();
    for (const IntPoint& p : path) {
      out.back().push_back({static_cast<double>(p.X), static_cast<double>(p.Y)});
    }
  }
  return out;
}

Box2 boundsOf(const std::vector<Ring>& rings) {
  Box2 out;
  for (const Ring& r : rings) {
    for (const Vec2 p : r) out.include(p);
  }
  return out;
}

// Where a result can be, and some steps around it.
Box2 reachOf(ClipperLib::ClipType type, const Box2& a, const Box2& b) {
  Box2 out = a;
  if (type == ClipperLib::ctIntersection) {
    out.min = {std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)};
    out.max = {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)};
  } else if (type != ClipperLib::ctDifference && !b.empty()) {
    out.include(b.min);
    out.include(b.max);
  }
  const Vec2 around{kAround, kAround};
  out.min = out.min - around;
  out.max = out.max + around;
  return out;
}

// The result in one box, of operands that may reach beyond it.
std::vector<Ring> resultWithin(ClipperLib::ClipType type, ClipperLib::PolyFillType fill,
                               const Operands& o, const Box2& box) {
  const Vec2 low = box.min, high = box.max;
  const Paths square = toPathsExact({{low, {high.x, low.y}, high, {low.x, high.y}}});
  Paths out = execute(ClipperLib::ctIntersection, toPathsExact(o.a), square, fill);
  if (!o.b.empty()) {
    Paths b = toPathsExact(o.b);
    if (type == ClipperLib::ctUnion || type == ClipperLib::ctXor) {
      b = execute(ClipperLib::ctIntersection, b, square, fill);
    }
    out = execute(type, out, b, fill);
  } else if (type == ClipperLib::ctIntersection) {
    out.clear();
  }
  Region region;
  return ringsOf(nestClear(toRings(out), kClear, region) ? region : settle(out));
}

// Clipper's work, on as little of the operands as the result depends on. The grid is settled.
Region perform(ClipperLib::ClipType type, Paths a, Paths b, ClipperLib::PolyFillType fill,
               Grid& grid) {
  const size_t count = countOf(a) + countOf(b);
  if (count < kSome) return finish(execute(type, a, b, fill), grid);
  Operands o{gridRings(a), gridRings(b)};
  const Box2 reach = reachOf(type, boundsOf(o.a), boundsOf(o.b));
  shortenOutside(o.a, reach);
  shortenOutside(o.b, reach);
  a = toPathsExact(o.a);
  b = toPathsExact(o.b);
  if (countOf(a) + countOf(b) < kMany) return finish(execute(type, a, b, fill), grid);
  grid.sortOriginals();
  const auto isInput = [&](Vec2 p) {
    Vec2 point;
    size_t order = 0;
    return grid.original(p, point, order);
  };
  const auto within = [&](const Operands& part, const Box2& box) {
    return resultWithin(type, fill, part, box);
  };
  Region region;
  if (resultInTiles(std::move(o), reach, within, isInput, region)) {
    return restoredIfValid(region, grid);
  }
  return finish(execute(type, a, b, fill), grid);
}

std::vector<Ring> orientedRings(const Region& r) {
  Region copy = r;
  for (Polygon& p : copy) orient(p);
  return ringsOf(copy);
}

ClipperLib::ClipType clipType(BooleanOp op) {
  switch (op) {
    case BooleanOp::Union: return ClipperLib::ctUnion;
    case BooleanOp::Intersection: return ClipperLib::ctIntersection;
    case BooleanOp::Difference: return ClipperLib::ctDifference;
    case BooleanOp::SymmetricDifference: break;
  }
  return ClipperLib::ctXor;
}

ClipperLib::PolyFillType fillType(FillRule rule) {
  switch (rule) {
    case FillRule::NonZero: return ClipperLib::pftNonZero;
    case FillRule::EvenOdd: return ClipperLib::pftEvenOdd;
    case FillRule::Positive: break;
  }
  return ClipperLib::pftPositive;
}

ClipperLib::JoinType joinType(OffsetJoin join) {
  switch (join) {
    case OffsetJoin::Miter: return ClipperLib::jtMiter;
    case OffsetJoin::Round: return ClipperLib::jtRound;
    case OffsetJoin::Square: break;
  }
  return ClipperLib::jtSquare;
}

ClipperLib::EndType endType(OffsetJoin join) {
  switch (join) {
    case OffsetJoin::Miter: return ClipperLib::etOpenButt;
    case OffsetJoin::Round: return ClipperLib::etOpenRound;
    case OffsetJoin::Square: break;
  }
  return ClipperLib::etOpenSquare;
}

Region inflate(const Paths& paths, double distance, const OffsetOptions& options,
               ClipperLib::EndType end, Grid& grid) {
  const Paths out = withClipper([&](Paths& moved) {
    ClipperLib::ClipperOffset o(std::max(options.miterLimit, 1.0),
                                options.roundError / grid.unit());
    o.AddPaths(paths, joinType(options.join), end);
    o.Execute(moved, distance / grid.unit());
    return true;
  });
  return finish(out, grid);
}

// Clipper's offset is one sweep over all edges; outlines of thousands are moved here, so that the
// sweep can go box by box.
Region inflateMany(const Paths& paths, double distance, OffsetOptions options, Grid& grid) {
  options.miterLimit = std::max(options.miterLimit, 1.0);
  options.roundError /= grid.unit();
  std::vector<Ring> moved;
  for (const Ring& r : toRings(paths)) {
    Ring m = movedOutline(r, distance / grid.unit(), options);
    for (Vec2& p : m) p = {std::round(p.x), std::round(p.y)};
    moved.push_back(std::move(m));
  }
  return perform(ClipperLib::ctUnion, toPathsExact(moved), {}, ClipperLib::pftPositive, grid);
}

OffsetOptions bounded(OffsetOptions options, double distance) {
  options.roundError = std::max(options.roundError, std::fabs(distance) * kFinestRound);
  return options;
}

}  // namespace

Region combine(BooleanOp op, const Region& a, const Region& b) {
  work(64);
  const std::vector<Ring> ra = orientedRings(a), rb = orientedRings(b);
  Grid grid;
  grid.include(ra);
  grid.include(rb);
  grid.settle();
  const Paths pa = grid.toPaths(ra), pb = grid.toPaths(rb);
  return perform(clipType(op), pa, pb, ClipperLib::pftNonZero, grid);
}

Region repaired(const std::vector<Ring>& rings, FillRule rule) {
  Grid grid;
  grid.include(rings);
  grid.settle();
  const Paths paths = grid.toPaths(rings);
  return perform(ClipperLib::ctUnion, paths, {}, fillType(rule), grid);
}

Region offset(const Region& r, double distance, const OffsetOptions& given) {
  if (!std::isfinite(distance)) return {};
  const OffsetOptions options = bounded(given, distance);
  const std::vector<Ring> rings = orientedRings(r);
  // No place of a region is farther from its boundary.
  if (distance < 0 && -distance > length(boundsOf(rings).size())) return {};
  Grid grid;
  grid.include(rings);
  grid.widen(distance, options.miterLimit);
  grid.settle();
  const Paths paths = grid.toPaths(rings);
  // Clipper's offset wants clean input; what the caller has may touch or cross.
  Region clear;
  const Paths clean = nestClear(toRings(paths), kClear, clear)
                          ? toPathsExact(ringsOf(clear))
                          : execute(ClipperLib::ctUnion, paths, {}, ClipperLib::pftNonZero);
  if (countOf(clean) >= kMany) return inflateMany(clean, distance, options, grid);
  return inflate(clean, distance, options, ClipperLib::etClosedPolygon, grid);
}

Region thicken(const std::vector<Vec2>& line, double distance, const OffsetOptions& given) {
  if (!std::isfinite(distance)) return {};
  const OffsetOptions options = bounded(given, distance);
  Grid grid;
  grid.include({line});
  grid.widen(distance, options.miterLimit);
  grid.settle();
  const Paths paths = grid.toPaths({line});
  return inflate(paths, std::fabs(distance), options, endType(options.join), grid);
}

}  // namespace gable
