// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/region/ray_strips.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/work.h"
#include "geom/region/clean.h"
#include "math/predicates.h"

namespace gable {
namespace {

// Regions up to so wide, in metres, have the grid of booleans throughout.
constexpr double kFineScale = 1e5;

// What lies to the left of a line, of an outline. It may run back along the line.
Ring leftOf(const Ring& r, Vec2 at, Vec2 along) {
  Ring out;
  out.reserve(r.size() + 2);
  work(r.size());
  double last = r.empty() ? 0 : cross(along, r.back() - at);
  for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
    const double here = cross(along, r[i] - at);
    if ((last < 0 && here > 0) || (last > 0 && here < 0)) {
      out.push_back(r[j] + (r[i] - r[j]) * (last / (last - here)));
    }
    if (here >= 0) out.push_back(r[i]);
    last = here;
  }
  return out;
}

// An outline cut to a convex ring, and a margin around it. It may run back over itself there, but
// counts as before within the ring.
Ring cutTo(const Ring& r, const Ring& convex, double margin) {
  Ring out;
  const Ring* from = &r;
  // Every other side first: the long ones leave the least.
  const size_t n = convex.size();
  for (size_t k = 0; k < n && !from->empty(); ++k) {
    const size_t i = 2 * k < n ? 2 * k : 2 * (k - (n + 1) / 2) + 1;
    const Vec2 a = convex[i], b = convex[(i + 1) % n];
    const Vec2 along = normalized(b - a);
    if (along == Vec2{}) continue;
    out = leftOf(*from, a - perpendicular(along) * margin, along);
    from = &out;
  }
  return from == &out ? std::move(out) : r;
}

// The outlines of `free` near a convex ring.
Region nearby(const Polygon& free, const Ring& convex, double margin) {
  Region out{{cutTo(free.outer, convex, margin), {}}};
  for (const Ring& h : free.holes) {
    Ring r = cutTo(h, convex, margin);
    if (r.size() >= 3) out[0].holes.push_back(std::move(r));
  }
  return out;
}

// Where the way from one place to another enters a convex hole, which turns right: the edge and
// the place. The way ends within.
bool entrance(const Ring& hole, Vec2 from, Vec2 to, size_t& edge, Vec2& at) {
  for (size_t i = 0; i < hole.size(); ++i) {
    const Vec2 a = hole[i], d = hole[(i + 1) % hole.size()] - a;
    const double outside = cross(d, from - a), inside = cross(d, to - a);
    if (!(outside > 0 && inside < 0)) continue;
    const Vec2 q = from + (to - from) * (outside / (outside - inside));
    const double t = dot(q - a, d) / dot(d, d);
    if (t < 0 || t > 1) continue;
    edge = i;
    at = q;
    return true;
  }
  return false;
}

// Takes a convex hole away from a ring that begins and ends in it: false where that is not so.
bool takeStart(Ring& ring, const Ring& hole) {
  const size_t n = ring.size();
  std::vector<char> in(n);
  size_t changes = 0, first = n;
  for (size_t i = 0; i < n; ++i) {
    work(hole.size());
    in[i] = 1;
    for (size_t k = 0; k < hole.size() && in[i] != 0; ++k) {
      in[i] = cross(hole[(k + 1) % hole.size()] - hole[k], ring[i] - hole[k]) < 0;
    }
  }
  for (size_t i = 0; i < n; ++i) {
    changes += in[i] != in[(i + 1) % n] ? 1 : 0;
    if (in[i] != 0 && in[(i + 1) % n] == 0) first = (i + 1) % n;
  }
  if (changes != 2 || first == n) return false;
  Ring out;
  size_t i = first;
  for (; in[i % n] == 0; ++i) out.push_back(ring[i % n]);
  size_t enter = 0, leave = 0;
  Vec2 entered, left;
  if (!entrance(hole, out.back(), ring[i % n], enter, entered) ||
      !entrance(hole, out.front(), ring[(first + n - 1) % n], leave, left)) {
    return false;
  }
  out.push_back(entered);
  for (size_t k = enter, guard = 0; k != leave; k = (k + 1) % hole.size()) {
    if (++guard > hole.size()) return false;
    out.push_back(hole[(k + 1) % hole.size()]);
  }
  out.push_back(left);
  ring = std::move(out);
  return true;
}

double onGrid(double v) { return std::round(v / kRegionGrid) * kRegionGrid; }

}  // namespace

RayStrips::RayStrips(const Polygon& p, const RayCaster& cast)
    : p_(p), cast_(cast), scale_(length(bounds(p).size())) {}

// Rays by their centre and direction, and for each the next one of its centre counter-clockwise.
std::vector<size_t> RayStrips::nextRays() const {
  std::vector<size_t> order(cast_.rays().size()), next(cast_.rays().size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto upper = [](Vec2 d) { return d.y > 0 || (d.y == 0 && d.x > 0); };
  std::sort(order.begin(), order.end(), [&](size_t i, size_t k) {
    const Ray &a = cast_.rays()[i], &b = cast_.rays()[k];
    if (!(a.from == b.from)) {
      return a.from.x != b.from.x ? a.from.x < b.from.x : a.from.y < b.from.y;
    }
    const Vec2 u = a.to - a.from, v = b.to - b.from;
    if (upper(u) != upper(v)) return upper(u);
    const int turn = orientation(a.from, a.to, b.to);
    return turn != 0 ? turn > 0 : i < k;
  });
  for (size_t first = 0; first < order.size();) {
    size_t last = first + 1;
    while (last < order.size() && cast_.rays()[order[last]].from == cast_.rays()[order[first]].from)
      ++last;
    for (size_t k = first; k < last; ++k) {
      work();
      next[order[k]] = order[k + 1 < last ? k + 1 : first];
    }
    first = last;
  }
  return next;
}

// The strip along a path, within the halves of the angles to the rays beside it.
Ring RayStrips::strip(const Ray& r, double width, const Ray* next, const Ray* previous) const {
  const Vec2 d = normalized(r.to - r.from), n = perpendicular(d) * (width / 2);
  const Vec2 end = next ? r.to + d * width : r.to;
  Ring ring{r.from - n, end - n, end + n, r.from + n};
  const auto halve = [&](const Ray& other, bool after) {
    const Vec2 e = normalized(other.to - other.from);
    const double turn = cross(d, e);
    // Beyond a half turn nothing is shared.
    if (after ? !(turn > 0) : !(turn < 0)) return;
    ring = leftOf(ring, r.from, after ? -(d + e) : d + e);
  };
  if (next) halve(*next, true);
  if (previous) halve(*previous, false);
  return ring;
}

// The section without a boolean: where it is one piece, and nothing is near anything else.
bool RayStrips::plainSection(const Ring& strip, const Polygon& free, Polygon& out) const {
  Ring ring = cutTo(free.outer, strip, 0);
  if (ring.size() < 3) return false;
  // The last hole is the centre's; what else reaches into the strip is left to booleans.
  // A centre over a hole leaves fewer of them.
  const size_t others = std::min(free.holes.size(), p_.holes.size());
  for (size_t h = 0; h < others; ++h) {
    if (cutTo(free.holes[h], strip, scale_ * 1e-3).size() >= 3) return false;
  }
  if (free.holes.size() > p_.holes.size() && !takeStart(ring, free.holes.back())) return false;
  // New points go on the grid of booleans, and the ring begins where theirs does: at the first
  // of the input's points, else at the lowest.
  const Ring none;
  const Ring& centre = free.holes.size() > p_.holes.size() ? free.holes.back() : none;
  size_t start = 0, order = kNoEdge;
  for (size_t i = 0; i < ring.size(); ++i) {
    const size_t rank = rankOf(ring[i], strip, centre);
    if (rank < strip.size()) ring[i] = strip[rank];
    if (rank == kNoEdge) ring[i] = {onGrid(ring[i].x), onGrid(ring[i].y)};
    if (rank < order || (rank == kNoEdge && order == kNoEdge && lessXy(ring[i], ring[start]))) {
      start = i;
      order = rank;
    }
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(start), ring.end());
  gable::dropDuplicates(ring, 0);
  Region clear;
  if (ring.size() < 3 || !nestClear({ring}, 2 * kRegionGrid, clear)) return false;
  out = std::move(clear[0]);
  return true;
}

// The place of a point among those that a section is made of; kNoEdge where it is a new one.
size_t RayStrips::rankOf(Vec2 v, const Ring& strip, const Ring& centre) const {
  work(strip.size() + centre.size());
  // Corners of the strip are found again where two of its sides cut the outline.
  for (size_t i = 0; i < strip.size(); ++i) {
    const Vec2 off = strip[i] - v;
    if (std::fabs(off.x) < kRegionGrid && std::fabs(off.y) < kRegionGrid) return i;
  }
  const uint32_t corner = cast_.cornerAt(v).first;
  if (corner != kNoEdge) return strip.size() + corner;
  const auto ofCentre =
      static_cast<size_t>(std::find(centre.begin(), centre.end(), v) - centre.begin());
  return ofCentre < centre.size() ? strip.size() + cast_.edgeCount() + ofCentre : kNoEdge;
}

// The part of a strip in the region that its ray runs through.
Region RayStrips::section(const Ray& r, const Ring& strip, const Region& free) const {
  Region parts;
  Polygon plain;
  // With one centre that keeps clear of all else, free is the region with a hole more at most.
  const bool simple = cast_.centres().size() == 1 && free.size() == 1 &&
                      free[0].holes.size() <= p_.holes.size() + 1 && scale_ < kFineScale;
  if (simple && plainSection(strip, free[0], plain)) {
    parts.push_back(std::move(plain));
  } else {
    for (const Polygon& f : free) {
      const Region near = nearby(f, strip, scale_ * 1e-3);
      if (near[0].outer.size() < 3) continue;
      for (Polygon& p : intersect({{strip, {}}}, near)) parts.push_back(std::move(p));
    }
  }
  for (const double t : {0.999, 0.75, 0.5, 0.25}) {
    const Vec2 on = r.from + (r.to - r.from) * t;
    for (Polygon& p : parts) {
      if (contains(p, on)) return {std::move(p)};
    }
  }
  return {};
}

// Links first, then rays; what two would share stays with the first. Rays of one centre share
// nothing.
std::vector<RayStrips::Section> RayStrips::sections(double width, const Region& free) const {
  std::vector<Section> out;
  const auto add = [&](const Ray& r, const Ring& strip, bool link) {
    const size_t before = out.size();
    for (Polygon& p : section(r, strip, free)) {
      const Box2 box = bounds(p);
      Region taken;
      work(before);
      for (size_t k = 0; k < before; ++k) {
        const Section& s = out[k];
        const bool beside = !link && !s.link && s.centre == r.from;
        if (s.box.meets(box) && !beside) taken.push_back(s.polygon);
      }
      Region rest{std::move(p)};
      if (!taken.empty()) rest = subtract(rest, taken);
      for (Polygon& q : rest) {
        const Box2 own = bounds(q);
        out.push_back({r.from, r.to, link, std::move(q), own});
      }
    }
  };
  for (const Ray& r : cast_.links()) add(r, strip(r, width, nullptr, nullptr), true);
  const std::vector<size_t> next = nextRays();
  std::vector<size_t> previous(next.size());
  for (size_t i = 0; i < next.size(); ++i) previous[next[i]] = i;
  for (size_t i = 0; i < cast_.rays().size(); ++i) {
    add(cast_.rays()[i],
        strip(cast_.rays()[i], width, &cast_.rays()[next[i]], &cast_.rays()[previous[i]]), false);
  }
  return out;
}

}  // namespace gable
