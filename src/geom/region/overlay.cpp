// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// All outlines are snap rounded together. Across an edge the winding numbers of the layers that run
// along it change and no others, so a walk over the faces tells which layers cover each; the last
// one has it. Faces of one layer that share an edge are one piece. What is left of the edges is
// traced once more around the pieces.
#include "geom/region/overlay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/disjoint_sets.h"
#include "geom/region/plane_map.h"
#include "geom/region/snap_round.h"

namespace gable {
namespace {

constexpr uint32_t kNone = OverlayPiece::kNothing;
// What lies farther out is cut off at this distance around the area, in metres.
constexpr double kMargin = 1;
// Beyond, a number is no place, in metres.
constexpr double kFarthest = 1e12;
// How often pieces may be taken away because others have grown thin by it.
constexpr int kThinRounds = 3;

Box2 boundsOf(std::span<const Ring> rings) {
  Box2 box;
  for (const Ring& r : rings) {
    for (const Vec2 p : r) {
      if (std::fabs(p.x) < kFarthest && std::fabs(p.y) < kFarthest) box.include(p);
    }
  }
  return box;
}

// The part of a ring on one side of a line across axis 0 or 1 (Sutherland and Hodgman, 1974). Ways
// along the line may be gone to and fro, which leaves winding numbers inside as they are.
void clipSide(Ring& ring, int axis, double at, bool keepLess) {
  Ring out;
  const auto value = [&](Vec2 p) { return axis == 0 ? p.x : p.y; };
  const auto inside = [&](Vec2 p) { return keepLess ? value(p) <= at : value(p) >= at; };
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if (inside(a)) out.push_back(a);
    if (inside(a) == inside(b)) continue;
    const double t = (at - value(a)) / (value(b) - value(a));
    Vec2 p = a + (b - a) * t;
    (axis == 0 ? p.x : p.y) = at;
    out.push_back(p);
  }
  ring = std::move(out);
}

class IntegerGrid {
 public:
  IntegerGrid(const Box2& box, double unit) : box_(box), unit_(unit) {
    const Vec2 margin{kMargin, kMargin};
    box_.min = box_.min - margin;
    box_.max = box_.max + margin;
    const Vec2 middle = box_.center();
    origin_ = {std::floor(middle.x), std::floor(middle.y)};
    const double extent = std::max(box_.size().x, box_.size().y);
    while (extent / unit_ > static_cast<double>(kMostGrid)) unit_ *= 2;
  }
  GridPoint toGrid(Vec2 p) const {
    return {std::llround((p.x - origin_.x) / unit_), std::llround((p.y - origin_.y) / unit_)};
  }
  Vec2 fromGrid(GridPoint p) const {
    return {origin_.x + static_cast<double>(p.x) * unit_,
            origin_.y + static_cast<double>(p.y) * unit_};
  }
  double unit() const { return unit_; }

  /// The corners of a ring, or of what of it lies in the box.
  std::vector<GridPoint> ring(Ring r) const {
    const auto beyond = [&](Vec2 p) {
      return !(std::fabs(p.x) < kFarthest && std::fabs(p.y) < kFarthest);
    };
    if (std::any_of(r.begin(), r.end(), beyond)) return {};
    const auto outside = [&](Vec2 p) {
      return p.x < box_.min.x || p.x > box_.max.x || p.y < box_.min.y || p.y > box_.max.y;
    };
    if (std::any_of(r.begin(), r.end(), outside)) {
      clipSide(r, 0, box_.min.x, false);
      clipSide(r, 0, box_.max.x, true);
      clipSide(r, 1, box_.min.y, false);
      clipSide(r, 1, box_.max.y, true);
    }
    std::vector<GridPoint> out;
    for (const Vec2 p : r) {
      const GridPoint q = toGrid(p);
      if (out.empty() || !(out.back() == q)) out.push_back(q);
    }
    while (out.size() > 1 && out.back() == out.front()) out.pop_back();
    return out;
  }

 private:
  Box2 box_;
  double unit_;
  Vec2 origin_;
};

struct Winding {
  uint32_t layer;
  int32_t turns;
  bool operator==(const Winding&) const = default;
};
using Cover = std::vector<Winding>;

bool covers(int32_t turns, FillRule fill) {
  switch (fill) {
    case FillRule::NonZero: return turns != 0;
    case FillRule::EvenOdd: return turns % 2 != 0;
    case FillRule::Positive: break;
  }
  return turns > 0;
}

// Two lists sorted by layer, the second with a factor.
Cover added(const Cover& a, std::span<const Winding> b, int32_t factor) {
  Cover out;
  size_t i = 0, k = 0;
  while (i < a.size() || k < b.size()) {
    work();
    if (k == b.size() || (i < a.size() && a[i].layer < b[k].layer)) {
      out.push_back(a[i++]);
    } else if (i == a.size() || b[k].layer < a[i].layer) {
      out.push_back({b[k].layer, factor * b[k].turns});
      ++k;
    } else {
      const int32_t turns = a[i].turns + factor * b[k].turns;
      if (turns != 0) out.push_back({a[i].layer, turns});
      ++i;
      ++k;
    }
  }
  return out;
}

// The edges of all layers and which layers run along each.
struct Edges {
  std::vector<GridPoint> points;
  std::vector<PlaneMap::Edge> edges;
  std::vector<Winding> windings;
  // Of edge e from windingStarts[e] on.
  std::vector<uint32_t> windingStarts{0};

  std::span<const Winding> along(uint32_t edge) const {
    return std::span(windings).subspan(windingStarts[edge],
                                       windingStarts[edge + 1] - windingStarts[edge]);
  }
};

Edges edgesOfLayers(std::span<const OverlayLayer> layers, const IntegerGrid& grid) {
  std::vector<GridSegment> segments;
  std::vector<uint32_t> layerOf;
  for (uint32_t l = 0; l < layers.size(); ++l) {
    for (const Ring& r : layers[l].rings) {
      work(r.size());
      const std::vector<GridPoint> ring = grid.ring(r);
      if (ring.size() < 3) continue;
      for (size_t i = 0; i < ring.size(); ++i) {
        segments.push_back({ring[i], ring[(i + 1) % ring.size()]});
        layerOf.push_back(l);
      }
    }
  }
  Snapped snapped = snapRound(segments);
  struct Run {
    uint32_t low, high, layer;
    int32_t turns;
  };
  std::vector<Run> runs;
  runs.reserve(snapped.pieces.size());
  for (const SnappedPiece& p : snapped.pieces) {
    const bool up = p.from < p.to;
    runs.push_back(
        {std::min(p.from, p.to), std::max(p.from, p.to), layerOf[p.segment], up ? 1 : -1});
  }
  std::sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.layer < b.layer;
  });
  Edges out;
  out.points = std::move(snapped.points);
  for (size_t i = 0; i < runs.size();) {
    const Run& first = runs[i];
    const size_t before = out.windings.size();
    while (i < runs.size() && runs[i].low == first.low && runs[i].high == first.high) {
      work();
      const uint32_t layer = runs[i].layer;
      int32_t turns = 0;
      for (; i < runs.size() && runs[i].low == first.low && runs[i].high == first.high &&
             runs[i].layer == layer;
           ++i) {
        turns += runs[i].turns;
      }
      if (turns != 0) out.windings.push_back({layer, turns});
    }
    if (out.windings.size() == before) continue;
    out.edges.push_back({first.low, first.high});
    out.windingStarts.push_back(static_cast<uint32_t>(out.windings.size()));
  }
  return out;
}

// Half-edges by the face on their left.
struct FaceEdges {
  std::vector<uint32_t> starts, items;

  explicit FaceEdges(const PlaneMap& map) : starts(map.faceCount() + 1, 0) {
    const uint32_t count = map.halfEdgeCount();
    items.resize(count);
    for (uint32_t h = 0; h < count; ++h) ++starts[map.left(h) + 1];
    for (size_t f = 0; f + 1 < starts.size(); ++f) starts[f + 1] += starts[f];
    std::vector<uint32_t> next(starts.begin(), starts.end() - 1);
    for (uint32_t h = 0; h < count; ++h) items[next[map.left(h)]++] = h;
  }
  std::span<const uint32_t> of(uint32_t face) const {
    return std::span(items).subspan(starts[face], starts[face + 1] - starts[face]);
  }
};

// By face the last layer that covers it, or none.
std::vector<uint32_t> ownersOf(const PlaneMap& map, const FaceEdges& faceEdges, const Edges& edges,
                               std::span<const OverlayLayer> layers) {
  std::vector<uint32_t> owners(map.faceCount(), kNone);
  std::vector<bool> seen(map.faceCount(), false);
  std::vector<std::pair<uint32_t, Cover>> open;
  open.emplace_back(0, Cover{});
  seen[0] = true;
  while (!open.empty()) {
    auto [face, cover] = std::move(open.back());
    open.pop_back();
    const bool inArea =
        !cover.empty() && cover[0].layer == 0 && covers(cover[0].turns, layers[0].fill);
    for (size_t k = cover.size(); inArea && k-- > 0;) {
      if (!covers(cover[k].turns, layers[cover[k].layer].fill)) continue;
      owners[face] = cover[k].layer;
      break;
    }
    for (const uint32_t h : faceEdges.of(face)) {
      const uint32_t other = map.left(h ^ 1);
      if (seen[other]) continue;
      seen[other] = true;
      // An edge that runs up has the layer on its left.
      const int32_t factor = h % 2 == 0 ? -1 : 1;
      open.emplace_back(other, added(cover, edges.along(h / 2), factor));
    }
  }
  return owners;
}

// Which faces are one piece, and what they share with others.
class Pieces {
 public:
  Pieces(const PlaneMap& map, const std::vector<GridPoint>& points, std::vector<uint32_t> owners)
      : map_(map), points_(points), owners_(std::move(owners)), sets_(map.faceCount()) {
    areas_.assign(map.faceCount(), 0);
    for (uint32_t h = 0; h < map.halfEdgeCount(); ++h) {
      const GridPoint a = points[map.from(h)], b = points[map.to(h)];
      areas_[map.left(h)] += 0.5 * (static_cast<double>(a.x) * static_cast<double>(b.y) -
                                    static_cast<double>(b.x) * static_cast<double>(a.y));
    }
    joinAll();
  }

  uint32_t owner(uint32_t face) const { return owners_[face]; }
  /// The first face of its piece; none outside.
  uint32_t pieceOf(uint32_t face) { return owners_[face] == kNone ? kNone : sets_.find(face); }

  /// Gives pieces away that are thinner or smaller than `thin` units; false when there are none.
  bool giveThinAway(double thin) {
    struct Border {
      uint32_t piece, other;
      double length;
    };
    std::vector<Border> borders;
    std::vector<double> area(map_.faceCount(), 0), around(map_.faceCount(), 0);
    for (uint32_t f = 0; f < map_.faceCount(); ++f) {
      if (owners_[f] != kNone) area[sets_.find(f)] += areas_[f];
    }
    for (uint32_t h = 0; h < map_.halfEdgeCount(); ++h) {
      const uint32_t piece = pieceOf(map_.left(h)), other = pieceOf(map_.left(h ^ 1));
      if (piece == kNone || piece == other) continue;
      around[piece] += lengthOf(h);
      if (other != kNone) borders.push_back({piece, other, lengthOf(h)});
    }
    const auto isThin = [&](uint32_t p) {
      return area[p] < thin * thin || 2 * area[p] < thin * around[p];
    };
    std::sort(borders.begin(), borders.end(), [](const Border& a, const Border& b) {
      return a.piece != b.piece ? a.piece < b.piece : a.other < b.other;
    });
    std::vector<uint32_t> heir(map_.faceCount(), kNone);
    for (size_t i = 0; i < borders.size();) {
      const uint32_t piece = borders[i].piece;
      double best = 0;
      while (i < borders.size() && borders[i].piece == piece) {
        work();
        const uint32_t other = borders[i].other;
        double length = 0;
        for (; i < borders.size() && borders[i].piece == piece && borders[i].other == other; ++i) {
          length += borders[i].length;
        }
        // Thin ones do not inherit from each other.
        if (length <= best || isThin(other)) continue;
        best = length;
        heir[piece] = other;
      }
      if (!isThin(piece)) heir[piece] = kNone;
    }
    bool any = false;
    std::vector<uint32_t> after = owners_;
    for (uint32_t f = 0; f < map_.faceCount(); ++f) {
      if (owners_[f] == kNone || heir[sets_.find(f)] == kNone) continue;
      after[f] = owners_[heir[sets_.find(f)]];
      any = true;
    }
    if (!any) return false;
    owners_ = std::move(after);
    sets_ = DisjointSets(map_.faceCount());
    joinAll();
    return true;
  }

 private:
  double lengthOf(uint32_t h) const {
    const GridPoint a = points_[map_.from(h)], b = points_[map_.to(h)];
    const auto dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
    return std::sqrt(dx * dx + dy * dy);
  }
  void joinAll() {
    for (uint32_t h = 0; h < map_.halfEdgeCount(); h += 2) {
      const uint32_t a = map_.left(h), b = map_.left(h ^ 1);
      if (owners_[a] != kNone && owners_[a] == owners_[b]) sets_.join(a, b);
    }
  }

  const PlaneMap& map_;
  const std::vector<GridPoint>& points_;
  std::vector<uint32_t> owners_;
  // Of faces, in square units.
  std::vector<double> areas_;
  DisjointSets sets_;
};

struct Corner {
  uint32_t point;
  // The piece beyond the edge that begins here.
  uint32_t beyond;
};
using Loop = std::vector<Corner>;

// Takes a loop apart where it visits a point twice.
void splitAtRepeats(const Loop& loop, std::vector<uint32_t>& placeOf, std::vector<Loop>& out) {
  Loop stack;
  for (const Corner& c : loop) {
    work();
    if (placeOf[c.point] != kNone) {
      // What runs from there back to this point is a loop of its own.
      const auto first = stack.begin() + placeOf[c.point];
      Loop part(first, stack.end());
      for (const Corner& k : part) placeOf[k.point] = kNone;
      stack.erase(first, stack.end());
      if (part.size() > 2) out.push_back(std::move(part));
    }
    placeOf[c.point] = static_cast<uint32_t>(stack.size());
    stack.push_back(c);
  }
  for (const Corner& k : stack) placeOf[k.point] = kNone;
  if (stack.size() > 2) out.push_back(std::move(stack));
}

class Output {
 public:
  Output(const PlaneMap& map, const std::vector<GridPoint>& points, Pieces& pieces,
         const IntegerGrid& grid)
      : map_(map), points_(points), pieces_(pieces), grid_(grid) {}

  std::vector<OverlayPiece> trace() {
    countBorders();
    std::vector<bool> done(map_.halfEdgeCount(), false);
    std::vector<uint32_t> placeOf(points_.size(), kNone);
    // By first face of a piece its number in the result.
    numbers_.assign(map_.faceCount(), kNone);
    for (uint32_t start = 0; start < map_.halfEdgeCount(); ++start) {
      if (done[start] || !isBorder(start) || piece(start) == kNone) continue;
      Loop loop;
      for (uint32_t h = start; !done[h]; h = nextBorder(h)) {
        work();
        done[h] = true;
        loop.push_back({map_.from(h), piece(h ^ 1)});
      }
      std::vector<Loop> parts;
      splitAtRepeats(loop, placeOf, parts);
      for (Loop& part : parts) add(piece(start), std::move(part));
    }
    for (OverlayPiece& p : out_) {
      for (uint32_t& b : p.beyond) {
        if (b != kNone) b = numbers_[b];
      }
    }
    return std::move(out_);
  }

 private:
  uint32_t piece(uint32_t h) { return pieces_.pieceOf(map_.left(h)); }
  bool isBorder(uint32_t h) { return piece(h) != piece(h ^ 1); }
  uint32_t nextBorder(uint32_t h) {
    h = map_.next(h);
    while (!isBorder(h)) h = map_.next(h ^ 1);
    return h;
  }
  void countBorders() {
    degrees_.assign(points_.size(), 0);
    for (uint32_t h = 0; h < map_.halfEdgeCount(); ++h) {
      if (isBorder(h)) ++degrees_[map_.from(h)];
    }
  }
  // A corner in line where no third piece begins says nothing to either side.
  void dropStraight(Loop& loop) const {
    Loop out;
    for (size_t i = 0; i < loop.size(); ++i) {
      const GridPoint a = points_[loop[(i + loop.size() - 1) % loop.size()].point];
      const GridPoint b = points_[loop[(i + 1) % loop.size()].point];
      const bool straight = degrees_[loop[i].point] == 2 && turn(a, points_[loop[i].point], b) == 0;
      if (!straight) out.push_back(loop[i]);
    }
    loop = std::move(out);
  }
  void add(uint32_t first, Loop loop) {
    dropStraight(loop);
    if (loop.size() < 3) return;
    Ring ring;
    for (const Corner& c : loop) ring.push_back(grid_.fromGrid(points_[c.point]));
    if (numbers_[first] == kNone) {
      numbers_[first] = static_cast<uint32_t>(out_.size());
      out_.emplace_back();
      out_.back().layer = pieces_.owner(first);
    }
    OverlayPiece& p = out_[numbers_[first]];
    std::vector<uint32_t> beyond;
    for (const Corner& c : loop) beyond.push_back(c.beyond);
    if (signedArea(ring) > 0) {
      p.polygon.outer = std::move(ring);
      p.beyond.insert(p.beyond.begin(), beyond.begin(), beyond.end());
    } else {
      p.polygon.holes.push_back(std::move(ring));
      p.beyond.insert(p.beyond.end(), beyond.begin(), beyond.end());
    }
  }

  const PlaneMap& map_;
  const std::vector<GridPoint>& points_;
  Pieces& pieces_;
  const IntegerGrid& grid_;
  std::vector<uint32_t> degrees_, numbers_;
  std::vector<OverlayPiece> out_;
};

}  // namespace

std::vector<OverlayPiece> overlay(std::span<const OverlayLayer> layers,
                                  const OverlayOptions& options) {
  if (layers.empty()) return {};
  const Box2 box = boundsOf(layers[0].rings);
  if (box.empty()) return {};
  const IntegerGrid grid(box, options.grid);
  const Edges edges = edgesOfLayers(layers, grid);
  const PlaneMap map(edges.points, edges.edges);
  Pieces pieces(map, edges.points, ownersOf(map, FaceEdges(map), edges, layers));
  for (int round = 0; round < kThinRounds; ++round) {
    if (!pieces.giveThinAway(options.thin / grid.unit())) break;
  }
  return Output(map, edges.points, pieces, grid).trace();
}

}  // namespace gable
