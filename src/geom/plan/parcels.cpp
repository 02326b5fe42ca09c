// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// By boxes: Y. Parish, P. Mueller, "Procedural Modeling of Cities", SIGGRAPH 2001, with the box of
// least area. By the skeleton: C. Vanegas, T. Kelly, B. Weber, J. Halatsch, D. Aliaga, P. Mueller,
// "Procedural Generation of Parcels in Urban Modeling", Eurographics 2012: the share of each street
// is its face of the straight skeleton; the wedge at a corner goes to the longer street, so that
// borders stand square to the streets.
#include "geom/plan/parcels.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "geom/region/line.h"
#include "geom/skeleton/skeleton.h"

namespace gable {

namespace {

constexpr double kCornerCos = 0.866;  // of 30 degrees
/// How far a traced border may lie from the block's own edge.
constexpr double kTrace = 1e-4;

size_t edgeCount(const Polygon& p) {
  size_t n = p.outer.size();
  for (const Ring& hole : p.holes) n += hole.size();
  return n;
}

std::vector<Ring> ringsOfPolygon(const Polygon& p) { return ringsOf(Region{p}); }

std::vector<uint32_t> streetsOf(const Polygon& block, const std::vector<bool>& street) {
  std::vector<uint32_t> out(edgeCount(block), Parcel::kNoStreet);
  for (uint32_t i = 0; i < out.size(); ++i) {
    const bool on = street.empty() ? i < block.outer.size() : i < street.size() && street[i];
    if (on) out[i] = i;
  }
  return out;
}

double width(const Polygon& p) {
  const OrientedRect rect = smallestRect(p.outer);
  return std::min(rect.width, rect.height);
}

double frontageOf(const Polygon& p, const std::vector<uint32_t>& street) {
  double sum = 0;
  size_t e = 0;
  for (const Ring& r : ringsOfPolygon(p)) {
    for (size_t i = 0; i < r.size(); ++i, ++e) {
      if (street[e] != Parcel::kNoStreet) sum += length(r[(i + 1) % r.size()] - r[i]);
    }
  }
  return sum;
}

// A run of street edges that turns left by more than the corner's angle from its first edge to
// one of the others: rounded corners count as well.
bool hasStreetCorner(const Polygon& p, const std::vector<uint32_t>& street) {
  const Ring& r = p.outer;
  const size_t n = r.size();
  const auto direction = [&](size_t i) { return normalized(r[(i + 1) % n] - r[i % n]); };
  for (size_t i = 0; i < n; ++i) {
    if (street[i] == Parcel::kNoStreet) continue;
    for (size_t k = i + 1; k < i + n && street[k % n] != Parcel::kNoStreet; ++k) {
      work(4);
      const Vec2 in = direction(i), out = direction(k);
      if (cross(in, out) > 0 && dot(in, out) < kCornerCos) return true;
    }
  }
  return false;
}

Parcel finished(Polygon polygon, std::vector<uint32_t> street) {
  Parcel p;
  p.frontage = frontageOf(polygon, street);
  p.corner = hasStreetCorner(polygon, street);
  p.polygon = std::move(polygon);
  p.street = std::move(street);
  return p;
}

struct Part {
  Polygon polygon;
  std::vector<uint32_t> street;
  uint64_t address;
};

bool isFit(const Part& p, const ParcelOptions& o) {
  return area(p.polygon) >= o.minArea && frontageOf(p.polygon, p.street) >= o.minFrontage &&
         width(p.polygon) >= o.minWidth;
}

// The parts on both sides of a line; empty when one of them is not fit.
std::vector<Part> divided(const Part& part, Vec2 at, Vec2 direction, const ParcelOptions& o) {
  std::vector<Part> out;
  for (StripPiece& piece : splitByLine(part.polygon, at, direction)) {
    Part p;
    for (uint32_t origin : piece.edgeOrigin) {
      p.street.push_back(origin < part.street.size() ? part.street[origin] : Parcel::kNoStreet);
    }
    p.polygon = std::move(piece.polygon);
    p.address = hashCombine(part.address, out.size() + 1);
    if (!isFit(p, o)) return {};
    out.push_back(std::move(p));
  }
  if (out.size() < 2) out.clear();
  return out;
}

// Across the longer side of the box first; then along it, which gives every part a street only
// where both sides have one.
std::vector<Part> divisionOf(const Part& part, const ParcelOptions& o) {
  const OrientedRect rect = smallestRect(part.polygon.outer);
  const double off =
      std::clamp(o.irregularity, 0.0, 0.4) * randomIn(hashCombine(part.address, 0), -1, 1);
  const bool wide = rect.width >= rect.height;
  for (const bool across : {true, false}) {
    const bool alongWidth = across == wide;
    for (const double share : {0.5 + off, 0.5, 0.4, 0.6}) {
      const Vec2 at = alongWidth ? rect.at(rect.width * share, 0) : rect.at(0, rect.height * share);
      std::vector<Part> parts = divided(part, at, alongWidth ? rect.y() : rect.x, o);
      if (!parts.empty()) return parts;
    }
  }
  return {};
}

}  // namespace

std::vector<Parcel> parcelsByBox(const Polygon& block, const std::vector<bool>& street,
                                 const ParcelOptions& options) {
  std::vector<Parcel> out;
  std::vector<Part> open{{block, streetsOf(block, street), options.address}};
  while (!open.empty()) {
    work(16);
    Part part = std::move(open.back());
    open.pop_back();
    std::vector<Part> parts;
    if (area(part.polygon) > 1.5 * options.targetArea) parts = divisionOf(part, options);
    if (parts.empty()) {
      out.push_back(finished(std::move(part.polygon), std::move(part.street)));
      continue;
    }
    // The first part comes out first.
    for (auto it = parts.rbegin(); it != parts.rend(); ++it) open.push_back(std::move(*it));
  }
  return out;
}

namespace {

// The share of one street edge.
struct Share {
  Vec2 from, to;
  Region region;
  double length() const { return gable::length(to - from); }
};

Polygon faceInPlan(const Skeleton& s, const SkeletonFace& face) {
  Polygon p;
  for (uint32_t v : face.loop) p.outer.push_back(s.vertices[v].xy);
  for (const auto& hole : face.holes) {
    p.holes.emplace_back();
    for (uint32_t v : hole) p.holes.back().push_back(s.vertices[v].xy);
  }
  return p;
}

// Gives the wedge of the shorter street at a convex corner to the longer one: what of its share
// lies between the corner and the foot of the skeleton's first node.
void straightenCorner(Share& before, Share& after, Vec2 node) {
  const Vec2 in = normalized(before.to - before.from), out = normalized(after.to - after.from);
  if (!(cross(in, out) > 0) || dot(in, out) > kCornerCos) return;
  Share& longer = before.length() >= after.length() ? before : after;
  Share& shorter = &longer == &before ? after : before;
  const Vec2 along = &shorter == &after ? out : in;
  Region wedge, rest;
  for (const Polygon& p : shorter.region) {
    for (StripPiece& piece : splitByLine(p, node, perpendicular(along))) {
      // Left of the upright is behind: towards the corner for the street that begins there.
      const bool behind = piece.strip == 0;
      (behind == (&shorter == &after) ? wedge : rest).push_back(std::move(piece.polygon));
    }
  }
  longer.region = unite(longer.region, wedge);
  shorter.region = std::move(rest);
}

std::vector<Share> sharesOf(const Polygon& block, const std::vector<uint32_t>& street,
                            const Skeleton& s) {
  std::vector<Share> shares(street.size());
  for (uint32_t e = 0; e < street.size(); ++e) {
    const SkeletonFace& face = s.faces[e];
    if (street[e] == Parcel::kNoStreet || face.loop.size() < 3) continue;
    shares[e] = {s.vertices[face.loop[0]].xy, s.vertices[face.loop[1]].xy,
                 repaired(ringsOfPolygon(faceInPlan(s, face)), FillRule::NonZero)};
  }
  uint32_t first = 0;
  for (const Ring& ring : ringsOfPolygon(block)) {
    const auto n = static_cast<uint32_t>(ring.size());
    for (uint32_t i = 0; i < n; ++i) {
      Share& before = shares[first + i];
      Share& after = shares[first + (i + 1) % n];
      if (before.region.empty() || after.region.empty()) continue;
      straightenCorner(before, after, s.vertices[s.faces[first + i].loop[2]].xy);
    }
    first += n;
  }
  return shares;
}

struct SharpBlock {
  Polygon polygon;
  std::vector<uint32_t> street;
  bool changed = false;
};

// Where two long edges with short ones between them would meet; false when they would not, near by
// and outside.
bool cornerOf(const Ring& r, size_t before, size_t after, Vec2& corner) {
  constexpr double kNear = 15;
  const size_t n = r.size();
  const Vec2 a = r[before], u = r[(before + 1) % n] - a, c = r[after], v = r[(after + 1) % n] - c;
  const double turn = cross(u, v);
  if (turn <= 0.1 * length(u) * length(v)) return false;
  const double t = cross(c - a, v) / turn;
  corner = a + u * t;
  for (size_t i = (before + 1) % n; i != after; i = (i + 1) % n) {
    work();
    if (cross(u, r[i] - a) < 0 || cross(v, r[i] - c) < 0) return false;
  }
  return t > 1 && length(corner - r[(before + 1) % n]) < kNear && length(corner - c) < kNear;
}

// The block with the corners that its kerbs round off: it contains the block.
SharpBlock sharpened(const Polygon& block, const std::vector<uint32_t>& street) {
  constexpr double kShort = 4;
  const Ring& r = block.outer;
  const size_t n = r.size();
  std::vector<size_t> longs;
  for (size_t i = 0; i < n; ++i) {
    if (length(r[(i + 1) % n] - r[i]) >= kShort) longs.push_back(i);
  }
  SharpBlock out{{{}, block.holes}, {}, false};
  for (size_t k = 0; k < longs.size(); ++k) {
    const size_t before = longs[k], after = longs[(k + 1) % longs.size()];
    const size_t between = (after + n - before) % n;
    Vec2 corner;
    if (between > 1 && cornerOf(r, before, after, corner)) {
      out.polygon.outer.push_back(corner);
      out.street.push_back(street[after]);
      out.changed = true;
      continue;
    }
    for (size_t m = 1; m <= between; ++m) {
      out.polygon.outer.push_back(r[(before + m) % n]);
      out.street.push_back(street[(before + m) % n]);
    }
  }
  out.street.insert(out.street.end(), street.begin() + static_cast<std::ptrdiff_t>(n),
                    street.end());
  const bool sound = out.changed && isValid(out.polygon) &&
                     area(subtract({block}, {out.polygon})) < 1e-9 * area(block);
  return sound ? out : SharpBlock{block, street, false};
}

// Lots of about the target's area, square to the street.
void cutLots(const Share& share, const ParcelOptions& o, std::vector<Polygon>& lots) {
  const double along = share.length();
  if (!(along > 0)) return;
  const Vec2 direction = normalized(share.to - share.from);
  const double depth = area(share.region) / along;
  const double lot = std::max(o.targetArea / std::max(depth, 1e-3), o.minWidth);
  const double count = std::max(1.0, std::nearbyint(along / lot));
  std::vector<double> cuts;
  for (double i = 1; i < std::min(count, 10000.0); ++i) {
    const double jitter = std::clamp(o.irregularity, 0.0, 0.4) / 2 *
                          randomIn(hashCombine(o.address, cuts.size() + 1), -1, 1);
    cuts.push_back(dot(direction, share.from) + along * ((i + jitter) / count));
  }
  for (const Polygon& p : share.region) {
    for (StripPiece& piece : splitIntoStrips(p, direction, cuts)) {
      lots.push_back(std::move(piece.polygon));
    }
  }
}

std::vector<uint32_t> tracedStreets(const Polygon& lot, const Polygon& block,
                                    const std::vector<uint32_t>& street) {
  std::vector<uint32_t> out = traceEdges(ringsOfPolygon(lot), ringsOfPolygon(block), kTrace);
  for (uint32_t& e : out) e = e == kNoEdge ? Parcel::kNoStreet : street[e];
  return out;
}

// The lot whose union with lots[i] has the longest common border and is one polygon; that union is
// left in `joined`.
size_t bestNeighbour(const std::vector<Parcel>& lots, size_t i, Polygon& joined) {
  double best = 0;
  size_t found = lots.size();
  Box2 near = bounds(lots[i].polygon);
  near.min = near.min - Vec2{0.01, 0.01};
  near.max = near.max + Vec2{0.01, 0.01};
  const auto around = [](const Polygon& p) {
    double sum = 0;
    for (const Ring& r : ringsOf(Region{p})) sum += perimeter(r);
    return sum;
  };
  for (size_t k = 0; k < lots.size(); ++k) {
    work();
    const Box2 box = bounds(lots[k].polygon);
    if (k == i || !box.meets(near)) continue;
    Region both = unite({lots[i].polygon}, {lots[k].polygon});
    if (both.size() != 1) continue;
    const double border = around(lots[i].polygon) + around(lots[k].polygon) - around(both[0]);
    if (border > best + 1e-6) {
      best = border;
      found = k;
      joined = std::move(both[0]);
    }
  }
  return found;
}

// The same where rounding has left a crack around the lot: it is grown over the crack, as far as
// the block reaches and nobody else's lot is in the way.
size_t neighbourAcrossCrack(const std::vector<Parcel>& lots, size_t i, const Polygon& block,
                            Polygon& joined) {
  constexpr double kCrack = 1e-3;
  const Region grown = intersect(offset({lots[i].polygon}, kCrack), {block});
  double best = 0;
  size_t found = lots.size();
  for (size_t k = 0; k < lots.size(); ++k) {
    const double common = k == i ? 0 : area(intersect(grown, {lots[k].polygon}));
    if (common <= best) continue;
    Region mine = grown;
    work(lots.size());
    for (size_t m = 0; m < lots.size(); ++m) {
      if (m != i && m != k) mine = subtract(mine, {lots[m].polygon});
    }
    Region both = unite(mine, {lots[k].polygon});
    if (both.size() != 1) continue;
    best = common;
    found = k;
    joined = std::move(both[0]);
  }
  return found;
}

}  // namespace

std::vector<Parcel> parcelsBySkeleton(const Polygon& block, const std::vector<bool>& street,
                                      const ParcelOptions& options) {
  const std::vector<uint32_t> streets = streetsOf(block, street);
  const SharpBlock sharp = sharpened(block, streets);
  std::vector<std::vector<double>> weights;
  size_t e = 0;
  for (const Ring& r : ringsOfPolygon(sharp.polygon)) {
    weights.emplace_back();
    for (size_t i = 0; i < r.size(); ++i, ++e) {
      weights.back().push_back(sharp.street[e] == Parcel::kNoStreet ? 0 : 1);
    }
  }
  const Skeleton skeleton = buildSkeleton(sharp.polygon, weights);
  if (!skeleton.status.ok()) return parcelsByBox(block, street, options);
  std::vector<Polygon> lots;
  std::vector<Share> shares = sharesOf(sharp.polygon, sharp.street, skeleton);
  for (uint32_t s = 0; s < shares.size(); ++s) {
    ParcelOptions own = options;
    own.address = hashCombine(options.address, s);
    cutLots(shares[s], own, lots);
  }
  std::vector<Parcel> out;
  for (const Polygon& lot : lots) {
    for (Polygon& within : sharp.changed ? intersect({lot}, {block}) : Region{lot}) {
      std::vector<uint32_t> traced = tracedStreets(within, block, streets);
      out.push_back(finished(std::move(within), std::move(traced)));
    }
  }
  // The smallest of the unfit joins a neighbour, until all are fit or alone.
  std::vector<bool> alone(out.size(), false);
  for (;;) {
    size_t worst = out.size();
    for (size_t i = 0; i < out.size(); ++i) {
      work(16);
      const bool fit = isFit({out[i].polygon, out[i].street, 0}, options);
      if (fit || alone[i]) continue;
      if (worst == out.size() || area(out[i].polygon) < area(out[worst].polygon)) worst = i;
    }
    if (worst == out.size()) break;
    Polygon joined;
    size_t with = bestNeighbour(out, worst, joined);
    if (with == out.size()) with = neighbourAcrossCrack(out, worst, block, joined);
    if (with == out.size()) {
      alone[worst] = true;
      continue;
    }
    std::vector<uint32_t> traced = tracedStreets(joined, block, streets);
    out[with] = finished(std::move(joined), std::move(traced));
    alone[with] = false;
    out.erase(out.begin() + static_cast<std::ptrdiff_t>(worst));
    alone.erase(alone.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  return out;
}

}  // namespace gable
