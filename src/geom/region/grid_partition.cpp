// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The lines of the first family cut the region into strips, those of the second cut the strips;
// each path is the strip between two parallel lines. Nothing is subtracted, so no ring touches
// itself, and line.h keeps account of the edges.
#include "geom/region/grid_partition.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/inner_rectangle.h"
#include "geom/region/line.h"
#include "math/trig.h"

namespace gable {

double DrawnRange::drawn(uint64_t address) const {
  if (other) return other(address);
  return low == high ? low : randomIn(address, low, high);
}

double PlanFigure::reach() const {
  switch (shape) {
    case PlanShape::Square: return a * std::sqrt(0.5);
    case PlanShape::Rect: return std::sqrt(a * a + b * b) / 2;
    default: return a;
  }
}

Ring ringOf(const PlanFigure& f, Vec2 m, Vec2 x) {
  const Vec2 y = perpendicular(x);
  switch (f.shape) {
    case PlanShape::None: return {};
    case PlanShape::Rhombus: return {m - y * f.a, m + x * f.a, m + y * f.a, m - x * f.a};
    case PlanShape::Square:
    case PlanShape::Rect: {
      const Vec2 u = x * (f.a / 2), v = y * ((f.shape == PlanShape::Square ? f.a : f.b) / 2);
      return {m - u - v, m + u - v, m + u + v, m - u + v};
    }
    default: break;
  }
  Ring r;
  const uint32_t n = std::max(3u, f.segments);
  for (uint32_t i = 0; i < n; ++i) {
    const double angle = 360.0 * i / n;
    r.push_back(m + x * (f.a * cosDeg(angle)) + y * (f.a * sinDeg(angle)));
  }
  return r;
}

namespace {

struct Line {
  Vec2 at, along;
};

// The cells and paths along one dimension.
struct Bands {
  std::vector<double> sizes;
  // Where each line between cells lies, measured in the middle of the template, and its turn.
  std::vector<double> middle, turn;
  double margin = 0;
};

const std::vector<GridSize>& sizesOf(const GridDim& own, const GridDim& other) {
  const auto sized = [](const GridDim& d) {
    return std::any_of(d.sizes.begin(), d.sizes.end(),
                       [](const GridSize& s) { return s.size.has_value(); });
  };
  return !sized(own) && sized(other) ? other.sizes : own.sizes;
}

class Dimension {
 public:
  Dimension(const GridDim& own, const GridDim& other, double whole, double path, uint64_t seed)
      : own_(own), sizes_(sizesOf(own, other)), whole_(whole), path_(path), seed_(seed) {}

  GridProblem divide(GridFit fit, Bands& out) {
    const double n = own_.drawnCount ? drawnCount() : own_.count > 0 ? own_.count : wantedCount();
    if (!(n <= kMostCells)) return GridProblem::TooManyCells;
    const auto count = static_cast<uint32_t>(std::max(1.0, n));
    const double free = whole_ - path_ * (count - 1);
    if (!(free > 0)) return GridProblem::DoesNotFit;
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
      work();
      out.sizes.push_back(sizeAt(i, free / count));
      sum += out.sizes.back();
    }
    sum = sharedOut(out.sizes, sum, free);
    if (!std::isfinite(sum)) return GridProblem::NotFinite;
    if (!(sum > 0)) return GridProblem::DoesNotFit;
    const bool exact = std::fabs(sum - free) <= 1e-9 * whole_;
    if (fit == GridFit::Fail && !exact) return GridProblem::DoesNotFit;
    if (fit == GridFit::Center && sum < free) {
      out.margin = (free - sum) / 2;
    } else if (!exact) {
      for (double& s : out.sizes) s *= free / sum;
    }
    place(out);
    return GridProblem::None;
  }

 private:
  double drawnCount() const {
    const double low = std::ceil(own_.drawnCount->low), high = std::floor(own_.drawnCount->high);
    const double n =
        low + std::floor(randomUnit(hashCombine(seed_, 0x636f756e74)) * (high - low + 1));
    return std::clamp(n, low, std::max(low, high));
  }
  // Shares get what the other sizes leave; the new sum.
  double sharedOut(std::vector<double>& sizes, double sum, double free) const {
    double shares = 0;
    const auto isShare = [&](size_t i) {
      return !sizes_.empty() && sizes_[i % sizes_.size()].share;
    };
    for (size_t i = 0; i < sizes.size(); ++i) shares += isShare(i) ? sizes[i] : 0;
    if (!(shares > 0)) return sum;
    const double rest = std::max(0.0, free - (sum - shares));
    for (size_t i = 0; i < sizes.size(); ++i) {
      if (isShare(i)) sizes[i] *= rest / shares;
    }
    return sum - shares + rest;
  }
  bool sized() const {
    return std::any_of(sizes_.begin(), sizes_.end(),
                       [](const GridSize& s) { return s.size.has_value(); });
  }
  double sizeAt(uint32_t i, double otherwise) const {
    if (sizes_.empty()) return otherwise;
    const GridSize& s = sizes_[i % sizes_.size()];
    if (!s.size) return sized() ? meanSize() : otherwise;
    return std::max(0.0, s.size->drawn(hashCombine(seed_, i)));
  }
  double meanSize() const {
    double sum = 0, n = 0;
    work(sizes_.size());
    for (const GridSize& s : sizes_) {
      if (!s.size) continue;
      sum += s.size->mean();
      n += 1;
    }
    return sum / n;
  }
  // The count that stretches the sizes least, near to what their mean says; sizes that are drawn
  // are drawn until the length is full.
  double wantedCount() const {
    if (!sized()) return 2;
    const double mean = meanSize();
    if (!(mean + path_ > 0)) return 2;
    const double guess = (whole_ + path_) / (mean + path_);
    if (!(guess <= kMostCells)) return guess;
    double best = 1, least = 1e300;
    for (double k = std::max(1.0, std::round(guess) - 1); k <= std::round(guess) + 1; ++k) {
      double sum = 0;
      work(static_cast<size_t>(k));
      for (uint32_t i = 0; i < k; ++i) sum += sizeAt(i, mean);
      const double free = whole_ - path_ * (k - 1);
      if (!(free > 0) || !(sum > 0)) continue;
      const double stretch = std::fabs(logOf(free / sum));
      if (stretch < least - 1e-12) {
        least = stretch;
        best = k;
      }
    }
    return best;
  }
  void place(Bands& out) const {
    double at = out.margin;
    for (size_t i = 0; i + 1 < out.sizes.size(); ++i) {
      at += out.sizes[i];
      out.middle.push_back(at + path_ / 2);
      at += path_;
      const std::vector<GridSize>& own = own_.sizes;
      const DrawnRange turn = own.empty() ? DrawnRange{} : own[i % own.size()].angle;
      out.turn.push_back(turn.drawn(hashCombine(hashCombine(seed_, 0x616e676c), i)));
    }
  }

  const GridDim& own_;
  const std::vector<GridSize>& sizes_;
  double whole_, path_;
  uint64_t seed_;
};

Vec2 lerp(Vec2 a, Vec2 b, double t) { return a + (b - a) * t; }

Vec2 turned(Vec2 d, double degrees) {
  const double c = cosDeg(degrees), s = sinDeg(degrees);
  return {d.x * c - d.y * s, d.x * s + d.y * c};
}

// Where two lines meet in a box.
bool meetIn(const Line& a, const Line& b, const Box2& box) {
  const double det = cross(a.along, b.along);
  if (std::fabs(det) < 1e-12) return false;
  const Vec2 p = a.at + a.along * (cross(b.at - a.at, b.along) / det);
  return box.contains(p);
}

// The lines of one family, ascending; `near` and `far` are the sides of the template on which they
// stand, from the first to the last. Each line keeps the first side to its left.
std::vector<Line> linesOf(const Bands& bands, double whole, Vec2 near0, Vec2 near1, Vec2 far0,
                          Vec2 far1) {
  std::vector<Line> out;
  for (size_t i = 0; i < bands.middle.size(); ++i) {
    const double t = bands.middle[i] / whole;
    const Vec2 a = lerp(near0, near1, t), b = lerp(far0, far1, t);
    out.push_back({lerp(a, b, 0.5), turned(normalized(b - a), bands.turn[i])});
  }
  return out;
}

Line movedLeft(const Line& l, double by) { return {l.at + perpendicular(l.along) * by, l.along}; }

// Halves the turns of lines that meet in the box, or leave the template by its first or last side
// there, until none do.
bool untangle(Bands& bands, double path, const Box2& box, const std::vector<Line>& straight,
              const Line& first, const Line& last) {
  const auto lineAt = [&](size_t i) {
    return Line{straight[i].at, turned(straight[i].along, bands.turn[i])};
  };
  constexpr int kHalvings = 8;
  for (int round = 0; round <= kHalvings; ++round) {
    work(4 * bands.turn.size());
    std::vector<bool> bad(bands.turn.size(), false);
    if (!bad.empty()) {
      bad.front() = bands.turn.front() != 0 && meetIn(first, movedLeft(lineAt(0), path / 2), box);
      const Line end = movedLeft(lineAt(bad.size() - 1), -path / 2);
      bad.back() = bad.back() || (bands.turn.back() != 0 && meetIn(end, last, box));
    }
    for (size_t i = 0; i + 1 < bands.turn.size(); ++i) {
      const Line a = lineAt(i), b = lineAt(i + 1);
      if (meetIn(movedLeft(a, -path / 2), movedLeft(b, path / 2), box) || meetIn(a, b, box)) {
        bad[i] = bad[i + 1] = true;
      }
    }
    if (std::none_of(bad.begin(), bad.end(), [](bool b) { return b; })) return true;
    for (size_t i = 0; i < bad.size(); ++i) {
      if (bad[i]) bands.turn[i] = round == kHalvings ? 0 : bands.turn[i] / 2;
    }
  }
  return std::none_of(bands.turn.begin(), bands.turn.end(), [](double t) { return t != 0; });
}

// A family ready to cut: its lines, and for each strip whether it is a path and which cell.
struct Family {
  std::vector<Line> cuts;
  struct Strip {
    bool path = false;
    uint32_t index = 0;
  };
  std::vector<Strip> strips;
  // Centre lines of the paths.
  std::vector<Line> paths;
};

Family familyOf(const Bands& bands, double path, std::vector<Line> lines, double whole, Vec2 near0,
                Vec2 near1, Vec2 far0, Vec2 far1) {
  Family f;
  const auto border = [&](double at) {
    const Vec2 a = lerp(near0, near1, at / whole), b = lerp(far0, far1, at / whole);
    return Line{a, normalized(b - a)};
  };
  if (bands.margin > 0) {
    f.cuts.push_back(border(bands.margin));
    f.strips.push_back({true, 0});
  }
  for (uint32_t i = 0; i < bands.sizes.size(); ++i) {
    f.strips.push_back({false, i});
    if (i + 1 == bands.sizes.size()) break;
    if (path > 0) {
      f.cuts.push_back(movedLeft(lines[i], path / 2));
      f.cuts.push_back(movedLeft(lines[i], -path / 2));
      f.strips.push_back({true, i});
      f.paths.push_back(lines[i]);
    } else {
      f.cuts.push_back(lines[i]);
    }
  }
  if (bands.margin > 0) {
    f.cuts.push_back(border(whole - bands.margin));
    f.strips.push_back({true, static_cast<uint32_t>(bands.sizes.size() - 1)});
  }
  return f;
}

struct StripPart {
  RegionPiece piece;
  size_t strip;
};

// Cuts a piece by all lines of a family. Made edges are the `after` side of what lies before the
// line, and the `before` side of what lies beyond.
void cutByFamily(const RegionPiece& whole, const Family& f, uint8_t after, uint8_t before,
                 std::vector<StripPart>& out) {
  std::vector<RegionPiece> rest{whole};
  for (size_t k = 0; k < f.cuts.size(); ++k) {
    std::vector<RegionPiece> beyond;
    for (const RegionPiece& p : rest) {
      work(4);
      for (StripPiece& s : splitByLine(p.polygon, f.cuts[k].at, f.cuts[k].along)) {
        RegionPiece part = p;
        const bool first = s.strip == 0;
        part.edges.clear();
        for (const uint32_t e : s.edgeOrigin) {
          if (e < StripPiece::kOnLine) {
            part.edges.push_back(p.edges[e]);
          } else {
            part.edges.push_back({kNoEdge, EdgeRole::Cut, first ? after : before});
          }
        }
        part.polygon = std::move(s.polygon);
        if (first) {
          out.push_back({std::move(part), k});
        } else {
          beyond.push_back(std::move(part));
        }
      }
    }
    rest = std::move(beyond);
  }
  for (RegionPiece& p : rest) out.push_back({std::move(p), f.cuts.size()});
}

bool nearRight(const Quad& q) {
  for (size_t i = 0; i < 4; ++i) {
    const Vec2 in = q[i] - q[(i + 3) % 4], out = q[(i + 1) % 4] - q[i];
    const double turn = atan2Deg(cross(in, out), dot(in, out));
    if (!(turn >= 70 && turn <= 110)) return false;
  }
  return true;
}

Quad quadOf(const OrientedRect& r) {
  return {r.at(0, 0), r.at(r.width, 0), r.at(r.width, r.height), r.at(0, r.height)};
}

struct Base {
  Quad quad;
  bool inner = false;
};

Base innerBase(const Polygon& p, Vec2 x) {
  const OrientedRect along = largestInnerRect(p, x);
  return {quadOf(along), true};
}

Base baseOf(const Polygon& p, GridTemplate wanted) {
  const OrientedRect box = orientedFrame(p.outer);
  if (wanted == GridTemplate::Axes) {
    const Box2 b = bounds(p);
    return {{b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}}};
  }
  if (wanted == GridTemplate::Oriented) return {quadOf(box)};
  if (wanted == GridTemplate::Inner) return innerBase(p, box.x);
  // What fills its box is as good as its corners.
  const double filled = box.area() > 0 ? area(p) / box.area() : 0;
  const bool isBox = filled > 1 - 1e-9;
  const BestQuad best = isBox ? BestQuad{} : bestQuad(p.outer);
  if (best.found()) {
    const Quad q{p.outer[best.corner[0]], p.outer[best.corner[1]], p.outer[best.corner[2]],
                 p.outer[best.corner[3]]};
    const bool good = best.score >= kRoughlyQuad && nearRight(q);
    if (wanted == GridTemplate::Corners || good) return {q};
  }
  if (filled >= 0.6 || wanted == GridTemplate::Corners) return {quadOf(box)};
  return innerBase(p, box.x);
}

// What stands at a crossing.
struct Junction {
  Ring ring;
  uint32_t ix = 0, iy = 0, choice = 0;
};

// The shapes of crossings, as large as they may be.
std::vector<Junction> junctionRings(const Family& fx, const Family& fy, const GridOptions& o,
                                    bool& clamped) {
  struct Crossing {
    Vec2 at, x;
    uint32_t ix, iy;
  };
  std::vector<Crossing> at;
  for (uint32_t iy = 0; iy < fy.paths.size(); ++iy) {
    for (uint32_t ix = 0; ix < fx.paths.size(); ++ix) {
      const Line &a = fy.paths[iy], &b = fx.paths[ix];
      const double det = cross(a.along, b.along);
      if (std::fabs(det) < 1e-9) continue;
      at.push_back({a.at + a.along * (cross(b.at - a.at, b.along) / det), -a.along, ix, iy});
    }
  }
  const auto nx = static_cast<uint32_t>(fx.paths.size());
  const auto ny = static_cast<uint32_t>(fy.paths.size());
  std::vector<Junction> out;
  for (size_t i = 0; i < at.size(); ++i) {
    const uint64_t address =
        hashCombine(hashCombine(hashCombine(o.seed, 0x6a756e63), at[i].ix), at[i].iy);
    const JunctionPick pick = o.junctionAt(at[i].ix, at[i].iy, nx, ny, address);
    if (pick.figure.shape == PlanShape::None) {
      out.push_back({{}, at[i].ix, at[i].iy, pick.choice});
      continue;
    }
    double nearest = 1e300;
    for (size_t k = 0; k < at.size(); ++k) {
      if (k != i) nearest = std::min(nearest, length(at[k].at - at[i].at));
    }
    PlanFigure f = pick.figure;
    const double reach = f.reach();
    if (reach > 0.49 * nearest) {
      f.a *= 0.49 * nearest / reach;
      f.b *= 0.49 * nearest / reach;
      clamped = true;
    }
    out.push_back({ringOf(f, at[i].at, at[i].x), at[i].ix, at[i].iy, pick.choice});
  }
  return out;
}

uint32_t plainChoice(const std::vector<Junction>& junctions, uint32_t ix, uint32_t iy) {
  for (const Junction& j : junctions) {
    if (j.ring.empty() && j.ix == ix && j.iy == iy) return j.choice;
  }
  return 0;
}

// Cuts the shapes out of all pieces, and adds what of them lies in the region. Those without a ring
// are plain crossings.
void placeJunctions(const Polygon& whole, const std::vector<Junction>& junctions, size_t crossings,
                    std::vector<RegionPiece>& pieces) {
  std::vector<Ring> rings;
  for (const Junction& j : junctions) {
    if (!j.ring.empty()) rings.push_back(j.ring);
  }
  const bool everywhere = rings.size() == crossings;
  std::vector<RegionPiece> out;
  for (RegionPiece& p : pieces) {
    Region holes;
    const Box2 box = bounds(p.polygon);
    for (const Ring& r : rings) {
      if (box.overlaps(bounds(r))) holes.push_back({r, {}});
    }
    // What a figure leaves of its crossing is path.
    if (p.kind == PieceKind::Junction && (everywhere || !holes.empty())) p.kind = PieceKind::Path;
    if (p.kind == PieceKind::Junction) p.choice = plainChoice(junctions, p.ix, p.iy);
    if (holes.empty()) {
      out.push_back(std::move(p));
      continue;
    }
    const EdgeOrigin made{kNoEdge, EdgeRole::Centre, EdgeOrigin::kNoSide};
    for (RegionPiece& cut : combineTraced(BooleanOp::Difference, p, holes, made)) {
      out.push_back(std::move(cut));
    }
  }
  for (const Junction& j : junctions) {
    const Ring& r = j.ring;
    if (r.empty()) continue;
    RegionPiece p = wholePiece(whole);
    p.kind = PieceKind::Junction;
    p.ix = j.ix;
    p.iy = j.iy;
    p.choice = j.choice;
    const EdgeOrigin made{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
    for (RegionPiece& cut : combineTraced(BooleanOp::Intersection, p, {{r, {}}}, made)) {
      const Box2 b = bounds(r);
      cut.width = b.size().x;
      cut.height = b.size().y;
      out.push_back(std::move(cut));
    }
  }
  pieces = std::move(out);
}

class Grid {
 public:
  Grid(const Polygon& p, const GridOptions& o) : p_(p), o_(o) {}

  GridResult run() {
    GridResult result;
    if (!(area(p_) > 0)) return {GridProblem::NoArea, {}};
    Base base = baseOf(p_, o_.base);
    GridProblem problem = lay(base.quad);
    if (problem == GridProblem::None && !straight_) {
      // Bent templates may have lines that meet outside of them.
      base = {quadOf(orientedFrame(p_.outer))};
      problem = lay(base.quad);
    }
    result.base = base.quad;
    result.problem = problem;
    if (problem != GridProblem::None) return result;
    result.nx = static_cast<uint32_t>(x_.sizes.size());
    result.ny = static_cast<uint32_t>(y_.sizes.size());
    if (static_cast<double>(result.nx) * result.ny > kMostCells) {
      result.problem = GridProblem::TooManyCells;
      return result;
    }
    partition(base, result);
    return result;
  }

 private:
  GridProblem lay(const Quad& q) {
    const double wx = (length(q[1] - q[0]) + length(q[2] - q[3])) / 2;
    const double wy = (length(q[3] - q[0]) + length(q[2] - q[1])) / 2;
    if (!(wx > 0 && wy > 0) || !std::isfinite(wx + wy)) return GridProblem::NoArea;
    path_ = std::clamp(o_.pathWidth, 0.0, std::min(wx, wy) / 4);
    if (!std::isfinite(o_.pathWidth)) return GridProblem::NotFinite;
    x_ = {};
    y_ = {};
    GridProblem bad = Dimension(o_.x, o_.y, wx, path_, hashCombine(o_.seed, 1)).divide(o_.fit, x_);
    if (bad != GridProblem::None) return bad;
    bad = Dimension(o_.y, o_.x, wy, path_, hashCombine(o_.seed, 2)).divide(o_.fit, y_);
    if (bad != GridProblem::None) return bad;
    straight_ = true;
    fx_ = family(x_, wx, q[0], q[1], q[3], q[2]);
    // Along y the lines run from east to west, so that south lies to their left.
    fy_ = family(y_, wy, q[1], q[2], q[0], q[3]);
    return GridProblem::None;
  }

  Family family(Bands& bands, double whole, Vec2 near0, Vec2 near1, Vec2 far0, Vec2 far1) {
    Bands plain = bands;
    for (double& t : plain.turn) t = 0;
    const std::vector<Line> straight = linesOf(plain, whole, near0, near1, far0, far1);
    const bool parallel = length((near1 - near0) - (far1 - far0)) <= 1e-9 * whole;
    const bool turns =
        std::any_of(bands.turn.begin(), bands.turn.end(), [](double t) { return t != 0; });
    const Line first{near0, normalized(far0 - near0)}, last{near1, normalized(far1 - near1)};
    if ((turns || !parallel) && !untangle(bands, path_, bounds(p_), straight, first, last)) {
      straight_ = false;
    }
    return familyOf(bands, path_, linesOf(bands, whole, near0, near1, far0, far1), whole, near0,
                    near1, far0, far1);
  }

  void partition(const Base& base, GridResult& result) {
    std::vector<RegionPiece> inside{withSides(base)};
    std::vector<RegionPiece> remainder;
    if (base.inner) {
      const Region rect{{{base.quad.begin(), base.quad.end()}, {}}};
      const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
      remainder = combineTraced(BooleanOp::Difference, inside[0], rect, made);
      inside = combineTraced(BooleanOp::Intersection, inside[0], rect, made);
      for (RegionPiece& r : remainder) r.kind = PieceKind::Remainder;
    }
    std::vector<RegionPiece> pieces;
    for (const RegionPiece& p : inside) cut(p, base, pieces);
    if (!inside.empty() && o_.junctionAt && !fx_.paths.empty() && !fy_.paths.empty()) {
      const std::vector<Junction> junctions = junctionRings(fx_, fy_, o_, result.junctionClamped);
      placeJunctions(inside[0].polygon, junctions, fx_.paths.size() * fy_.paths.size(), pieces);
    }
    pieces.insert(pieces.end(), remainder.begin(), remainder.end());
    const double mean = area(p_) / (static_cast<double>(result.nx) * result.ny);
    mergeSlivers(pieces, std::min(o_.sliver, std::sqrt(mean) / 50),
                 o_.minAreaHolds ? o_.minArea : std::min(o_.minArea, mean / 50));
    std::stable_sort(pieces.begin(), pieces.end(), [](const RegionPiece& a, const RegionPiece& b) {
      return a.kind != b.kind ? a.kind < b.kind : a.iy != b.iy ? a.iy < b.iy : a.ix < b.ix;
    });
    number(pieces);
    result.pieces = std::move(pieces);
  }

  // Input edges know the side of the template that they look to.
  RegionPiece withSides(const Base& base) const {
    RegionPiece whole = wholePiece(p_);
    const Vec2 x = normalized(base.quad[1] - base.quad[0]), y = perpendicular(x);
    size_t i = 0;
    for (const Ring& r : ringsOf(p_)) {
      for (size_t k = 0; k < r.size(); ++k, ++i) {
        const Vec2 out = -perpendicular(r[(k + 1) % r.size()] - r[k]);
        const double u = dot(out, x), v = dot(out, y);
        const bool across = std::fabs(u) >= std::fabs(v) * (1 - 1e-9);
        whole.edges[i].side = static_cast<uint8_t>(across ? (u < 0 ? 0 : 2) : (v > 0 ? 1 : 3));
      }
    }
    return whole;
  }

  void cut(const RegionPiece& whole, const Base& base, std::vector<RegionPiece>& out) const {
    const Vec2 x = normalized(base.quad[1] - base.quad[0]);
    std::vector<StripPart> columns;
    cutByFamily(whole, fx_, 2, 0, columns);
    for (const StripPart& c : columns) {
      std::vector<StripPart> rows;
      cutByFamily(c.piece, fy_, 1, 3, rows);
      for (StripPart& r : rows) {
        const Family::Strip& sx = fx_.strips[c.strip];
        const Family::Strip& sy = fy_.strips[r.strip];
        RegionPiece& p = r.piece;
        p.kind = sx.path && sy.path   ? PieceKind::Junction
                 : sx.path || sy.path ? PieceKind::Path
                                      : PieceKind::Cell;
        p.ix = sx.index;
        p.iy = sy.index;
        p.width = sx.path ? path_ : x_.sizes[sx.index];
        p.height = sy.path ? path_ : y_.sizes[sy.index];
        p.axis = x;
        if (sx.path && !sy.path) {
          p.axis = fx_.paths.empty()
                       ? x
                       : fx_.paths[std::min<size_t>(sx.index, fx_.paths.size() - 1)].along;
          std::swap(p.width, p.height);
        }
        label(p, sx.path, sy.path);
        out.push_back(std::move(p));
      }
    }
  }

  // Between a cell and a path lies the path's side.
  void label(RegionPiece& p, bool pathX, bool pathY) const {
    for (EdgeOrigin& e : p.edges) {
      if (e.source != kNoEdge || e.role != EdgeRole::Cut || e.side > 3) continue;
      const bool acrossX = e.side == 0 || e.side == 2;
      const bool otherIsPath = path_ > 0 && (acrossX ? !pathX : !pathY);
      const bool isPath = acrossX ? pathX : pathY;
      const bool junction = pathX && pathY;
      if (junction || (acrossX ? pathY : pathX)) continue;
      if (otherIsPath || isPath) e.role = EdgeRole::Path;
    }
  }

  static void number(std::vector<RegionPiece>& pieces) {
    for (size_t i = 0; i < pieces.size(); ++i) {
      const RegionPiece* before = i > 0 ? &pieces[i - 1] : nullptr;
      const bool same = before && before->kind == pieces[i].kind && before->ix == pieces[i].ix &&
                        before->iy == pieces[i].iy && pieces[i].kind == PieceKind::Cell;
      pieces[i].part = same ? before->part + 1 : 0;
    }
  }

  const Polygon& p_;
  const GridOptions& o_;
  double path_ = 0;
  bool straight_ = true;
  Bands x_, y_;
  Family fx_, fy_;
};

}  // namespace

GridResult gridPartition(const Polygon& p, const GridOptions& options) {
  return Grid(p, options).run();
}

}  // namespace gable
