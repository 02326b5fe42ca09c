// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Without a width the region falls into sectors: the boundary from one hit to the next, and the
// centre. With one, each path is a strip within the halves of the angles to its neighbours, cut to
// the little of the region's outline that is near it, and the regions are what is left.
#include "geom/region/rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "geom/region/line.h"
#include "geom/region/places.h"
#include "geom/region/point_cells.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"

namespace gable {
namespace {

// Several centres are never joined by paths of no width.
constexpr double kLeastWidth = 0.02;
// Regions up to so wide, in metres, have the grid of booleans throughout.
constexpr double kFineScale = 1e5;
// Sectors are no thinner, in metres, and no smaller, in square metres.
constexpr double kThinSector = 0.02;

struct Ray {
  Vec2 from, to;
  // On the outer ring: the edge and the place on it.
  uint32_t edge = kNoEdge;
  double at = 0;
};

// Whether two segments have a point in common; on one line they must overlap.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const int p = orientation(a, b, c), q = orientation(a, b, d);
  if (p * q > 0 || orientation(c, d, a) * orientation(c, d, b) > 0) return false;
  if (p != 0 || q != 0) return true;
  const auto apart = [](double from, double to, double other, double end) {
    return std::max(from, to) < std::min(other, end) || std::max(other, end) < std::min(from, to);
  };
  return !apart(a.x, b.x, c.x, d.x) && !apart(a.y, b.y, c.y, d.y);
}

class Rays {
 public:
  Rays(const Polygon& p, const RayOptions& o) : p_(p), o_(o), edges_(edgesOf(p)) {
    scale_ = length(bounds(p).size());
    uint32_t first = 0;
    for (const Ring& r : ringsOf(p)) {
      const auto n = static_cast<uint32_t>(r.size());
      for (uint32_t i = 0; i < n; ++i) {
        before_.push_back(first + (i + n - 1) % n);
        after_.push_back(first + (i + 1) % n);
      }
      first += n;
    }
    sides_.resize(edges_.size());
    corners_.resize(edges_.size());
    std::iota(corners_.begin(), corners_.end(), 0u);
    std::sort(corners_.begin(), corners_.end(), [&](uint32_t i, uint32_t k) {
      return edges_[i].a == edges_[k].a ? i < k : lessXy(edges_[i].a, edges_[k].a);
    });
  }

  RayResult run(std::span<const Vec2> centres, std::span<const RayTarget> targets) {
    RayResult out;
    for (const Vec2 c : centres) {
      work();
      if (locate(p_, c) == Where::Inside) {
        centres_.push_back(c);
      } else {
        out.moved = true;
      }
    }
    if (centres_.empty()) centres_.push_back(poleOf(p_).centre);
    for (const RayTarget& t : targets) castTo(t);
    dropDuplicates();
    link();
    out.rays = static_cast<uint32_t>(rays_.size());
    out.links = static_cast<uint32_t>(links_.size());
    if (rays_.size() + 2 * links_.size() < 2) {
      out.pieces.push_back(wholePiece(p_));
      return out;
    }
    if (o_.pathWidth > 0 || centres_.size() > 1) {
      withPaths(out.pieces);
    } else {
      sectors(out.pieces);
    }
    return out;
  }

 private:
  // The first boundary point along a ray, beyond its start; edges at `except` do not count.
  bool firstHit(Vec2 from, Vec2 d, Vec2 except, bool hasExcept, Ray& hit, double& reach) const {
    bool found = false;
    reach = 1e300;
    work(edges_.size());
    // Most edges lie on one side of the ray; which those are is found without branches.
    for (size_t i = 0; i < edges_.size(); ++i) sides_[i] = cross(d, edges_[i].a - from);
    for (uint32_t i = 0; i < edges_.size(); ++i) {
      const Vec2 a = edges_[i].a, b = edges_[i].b;
      if (sides_[i] * sides_[after_[i]] > 0) continue;
      if (hasExcept && (a == except || b == except)) continue;
      const double det = cross(d, b - a);
      if (det == 0) continue;
      const double t = cross(a - from, b - a) / det;
      const double u = cross(a - from, d) / det;
      if (!(t > 0) || u < 0 || u > 1 || t >= reach) continue;
      reach = t;
      hit = {from, a + (b - a) * u, i, u};
      found = true;
    }
    return found;
  }

  // Whether the corner where an edge starts is seen from a place through the region's outside. For
  // corners that the outlines visit once.
  bool fromOutside(uint32_t edge, Vec2 place) const {
    const Vec2 a = edges_[before_[edge]].a, v = edges_[edge].a, b = edges_[edge].b;
    const bool right = orientation(v, b, place) < 0, behind = orientation(a, v, place) < 0;
    return orientation(a, v, b) >= 0 ? right || behind : right && behind;
  }

  static bool lessXy(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

  // The first edge that starts at a place, and how many do.
  std::pair<uint32_t, uint32_t> cornerAt(Vec2 place) const {
    const auto first = std::lower_bound(corners_.begin(), corners_.end(), place,
                                        [&](uint32_t i, Vec2 v) { return lessXy(edges_[i].a, v); });
    auto last = first;
    while (last != corners_.end() && edges_[*last].a == place) ++last;
    work(static_cast<size_t>(last - first));
    return {first == last ? kNoEdge : *first, static_cast<uint32_t>(last - first)};
  }

  // A ray from a centre to a target; false when it is hidden from there.
  bool rayTo(Vec2 c, const RayTarget& t, Ray& ray) const {
    double reach = 0;
    if (t.kind == RayTarget::Kind::Direction) {
      return length(t.value) > 0 && firstHit(c, t.value, {}, false, ray, reach);
    }
    const Vec2 d = t.value - c;
    if (!(length(d) > 0)) return false;
    // A vertex of the region is met exactly; nothing else may lie before it.
    const auto [corner, visits] = cornerAt(t.value);
    if (visits > 0) {
      Ray first;
      const bool blocked = firstHit(c, d, t.value, true, first, reach) && reach < 1 - 1e-9;
      // The ray must come from within: a corner may be seen through its own outside.
      const bool outside =
          !blocked &&
          (visits == 1 ? fromOutside(corner, c) : locate(p_, t.value - d * 1e-6) == Where::Outside);
      if (blocked || outside) {
        if (!o_.stopHidden || !blocked) return false;
        ray = first;
        return true;
      }
      ray = {c, t.value, corner, 0};
      return true;
    }
    if (!firstHit(c, d, {}, false, ray, reach)) return false;
    return reach >= 1 - 1e-9 || o_.stopHidden;
  }

  void castTo(const RayTarget& t) {
    bool found = false;
    Ray best;
    for (const Vec2 c : centres_) {
      work(edges_.size());
      Ray r;
      if (!rayTo(c, t, r)) continue;
      if (found && length(r.to - r.from) >= length(best.to - best.from)) continue;
      best = r;
      found = true;
    }
    if (found) rays_.push_back(best);
  }

  void dropDuplicates() {
    std::vector<Ray> kept;
    PointCells ends(std::max(o_.pathWidth, 1e-9 * scale_), rays_.size());
    for (const Ray& r : rays_) {
      work();
      if (ends.snap(r.to) == kept.size()) kept.push_back(r);
    }
    rays_ = std::move(kept);
  }

  bool sees(Vec2 a, Vec2 b) const {
    return std::none_of(edges_.begin(), edges_.end(),
                        [&](const Segment& e) { return meet(a, b, e.a, e.b); });
  }

  bool crossesAny(Vec2 a, Vec2 b) const {
    work(links_.size());
    const auto meets = [&](const Ray& r) {
      if (r.from == a || r.from == b || r.to == a || r.to == b) return false;
      return meet(a, b, r.from, r.to);
    };
    return std::any_of(links_.begin(), links_.end(), meets);
  }

  void addLink(size_t i, size_t k) {
    const bool mayCross = o_.links == CentreLinks::Opposite;
    if (!sees(centres_[i], centres_[k])) return;
    if (!mayCross && crossesAny(centres_[i], centres_[k])) return;
    links_.push_back({centres_[i], centres_[k]});
  }

  void link() {
    const size_t n = centres_.size();
    if (n < 2 || o_.links == CentreLinks::None) return;
    if (o_.links == CentreLinks::Pairs) {
      for (size_t i = 0; i + 1 < n; i += 2) addLink(i, i + 1);
    } else if (o_.links == CentreLinks::Loop || o_.links == CentreLinks::Opposite) {
      linkAround();
    } else {
      linkTree();
    }
    // Rays give way to links.
    std::erase_if(rays_, [&](const Ray& r) { return crossesAny(r.from, r.to); });
    std::vector<Ray> kept;
    for (const Ray& r : rays_) {
      work(kept.size());
      const bool crosses = std::any_of(kept.begin(), kept.end(), [&](const Ray& k) {
        return !(k.from == r.from) && meet(k.from, k.to, r.from, r.to);
      });
      if (!crosses) kept.push_back(r);
    }
    rays_ = std::move(kept);
  }

  // By angle around the middle of all centres, which gives a round that does not cross itself.
  void linkAround() {
    Vec2 middle;
    for (const Vec2 c : centres_)
      middle = middle + c * (1.0 / static_cast<double>(centres_.size()));
    std::vector<size_t> order(centres_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      const Vec2 u = centres_[a] - middle, v = centres_[b] - middle;
      const bool upU = u.y > 0 || (u.y == 0 && u.x > 0), upV = v.y > 0 || (v.y == 0 && v.x > 0);
      if (upU != upV) return upU;
      const double c = cross(u, v);
      return c != 0 ? c > 0 : a < b;
    });
    if (o_.links == CentreLinks::Opposite) {
      // Of an odd number the last stays without a partner.
      const size_t half = order.size() / 2;
      for (size_t i = 0; i < half; ++i) addLink(order[i], order[i + half]);
      return;
    }
    for (size_t i = 0; i < order.size(); ++i) {
      if (order.size() == 2 && i == 1) break;
      addLink(order[i], order[(i + 1) % order.size()]);
    }
  }

  // The shortest tree of what sees each other; then, as far as wanted, further short links.
  void linkTree() {
    struct Link {
      size_t a, b;
      double length;
    };
    std::vector<Link> all;
    for (size_t a = 0; a < centres_.size(); ++a) {
      work();
      for (size_t b = a + 1; b < centres_.size(); ++b) {
        work(edges_.size());
        if (sees(centres_[a], centres_[b]))
          all.push_back({a, b, length(centres_[b] - centres_[a])});
      }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Link& a, const Link& b) { return a.length < b.length; });
    std::vector<size_t> group(centres_.size());
    std::iota(group.begin(), group.end(), size_t{0});
    std::vector<Link> others;
    for (const Link& l : all) {
      work(group.size());
      const size_t from = group[l.a], to = group[l.b];
      if (from == to) {
        others.push_back(l);
        continue;
      }
      std::replace(group.begin(), group.end(), from, to);
      addLink(l.a, l.b);
    }
    if (o_.links != CentreLinks::Thin) return;
    std::erase_if(others, [&](const Link& l) { return crossesAny(centres_[l.a], centres_[l.b]); });
    const auto take = static_cast<size_t>(
        std::round(std::clamp(o_.thin, 0.0, 1.0) * static_cast<double>(others.size())));
    for (size_t i = 0; i < take; ++i) addLink(others[i].a, others[i].b);
  }

  // Rays by their centre and direction, and for each the next one of its centre counter-clockwise.
  std::vector<size_t> nextRays() const {
    std::vector<size_t> order(rays_.size()), next(rays_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    const auto upper = [](Vec2 d) { return d.y > 0 || (d.y == 0 && d.x > 0); };
    std::sort(order.begin(), order.end(), [&](size_t i, size_t k) {
      const Ray &a = rays_[i], &b = rays_[k];
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
      while (last < order.size() && rays_[order[last]].from == rays_[order[first]].from) ++last;
      for (size_t k = first; k < last; ++k) {
        work();
        next[order[k]] = order[k + 1 < last ? k + 1 : first];
      }
      first = last;
    }
    return next;
  }

  // What lies to the left of a line, of an outline. It may run back along the line.
  static Ring leftOf(const Ring& r, Vec2 at, Vec2 along) {
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

  // The strip along a path, within the halves of the angles to the rays beside it.
  Ring strip(const Ray& r, double width, const Ray* next, const Ray* previous) const {
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

  // An outline cut to a convex ring, and a margin around it. It may run back over itself there, but
  // counts as before within the ring.
  static Ring cutTo(const Ring& r, const Ring& convex, double margin) {
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
  static Region nearby(const Polygon& free, const Ring& convex, double margin) {
    Region out{{cutTo(free.outer, convex, margin), {}}};
    for (const Ring& h : free.holes) {
      Ring r = cutTo(h, convex, margin);
      if (r.size() >= 3) out[0].holes.push_back(std::move(r));
    }
    return out;
  }

  // Where the way from one place to another enters a convex hole, which turns right: the edge and
  // the place. The way ends within.
  static bool entrance(const Ring& hole, Vec2 from, Vec2 to, size_t& edge, Vec2& at) {
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
  static bool takeStart(Ring& ring, const Ring& hole) {
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

  // The section without a boolean: where it is one piece, and nothing is near anything else.
  bool plainSection(const Ring& strip, const Polygon& free, Polygon& out) const {
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
  size_t rankOf(Vec2 v, const Ring& strip, const Ring& centre) const {
    work(strip.size() + centre.size());
    // Corners of the strip are found again where two of its sides cut the outline.
    for (size_t i = 0; i < strip.size(); ++i) {
      const Vec2 off = strip[i] - v;
      if (std::fabs(off.x) < kRegionGrid && std::fabs(off.y) < kRegionGrid) return i;
    }
    const uint32_t corner = cornerAt(v).first;
    if (corner != kNoEdge) return strip.size() + corner;
    const auto ofCentre =
        static_cast<size_t>(std::find(centre.begin(), centre.end(), v) - centre.begin());
    return ofCentre < centre.size() ? strip.size() + edges_.size() + ofCentre : kNoEdge;
  }

  static double onGrid(double v) { return std::round(v / kRegionGrid) * kRegionGrid; }

  // The part of a strip in the region that its ray runs through.
  Region section(const Ray& r, const Ring& strip, const Region& free) const {
    Region parts;
    Polygon plain;
    // With one centre that keeps clear of all else, free is the region with a hole more at most.
    const bool simple = centres_.size() == 1 && free.size() == 1 &&
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

  // What the figures around the centres take of the region.
  Region allCentres() const {
    Region centres;
    if (o_.centre.shape == PlanShape::None || !(o_.centre.reach() > 0)) return centres;
    for (const Vec2 c : centres_) {
      const Polygon figure{ringOf(o_.centre, c), {}};
      if (signedDistance(p_, c) > o_.centre.reach() * 1.001) {
        centres.push_back(figure);
        continue;
      }
      for (Polygon& p : intersect({figure}, {p_})) {
        if (contains(p, c)) centres.push_back(std::move(p));
      }
    }
    return centres.size() > 1 ? repaired(ringsOf(centres), FillRule::NonZero) : centres;
  }

  // The region without the centres; they are holes where they keep clear of all else.
  Region besideCentres(const Region& centres) const {
    if (centres.empty()) return {p_};
    if (centres.size() == 1 && centres[0].holes.empty() && centres_.size() == 1 &&
        signedDistance(p_, centres_[0]) > o_.centre.reach() * 1.001) {
      Polygon out = p_;
      out.holes.push_back(centres[0].outer);
      std::reverse(out.holes.back().begin(), out.holes.back().end());
      return {out};
    }
    return subtract({p_}, centres);
  }

  struct Section {
    Vec2 centre, to;
    bool link = false;
    Polygon polygon;
    Box2 box;
  };

  // Links first, then rays; what two would share stays with the first. Rays of one centre share
  // nothing.
  std::vector<Section> allSections(double width, const Region& free) const {
    std::vector<Section> out;
    const auto add = [&](const Ray& r, const Ring& strip, bool link) {
      const size_t before = out.size();
      for (Polygon& p : section(r, strip, free)) {
        const Box2 box = bounds(p);
        Region taken;
        work(before);
        for (size_t k = 0; k < before; ++k) {
          const Section& s = out[k];
          const bool meets = s.box.min.x <= box.max.x && box.min.x <= s.box.max.x &&
                             s.box.min.y <= box.max.y && box.min.y <= s.box.max.y;
          const bool beside = !link && !s.link && s.centre == r.from;
          if (meets && !beside) taken.push_back(s.polygon);
        }
        Region rest{std::move(p)};
        if (!taken.empty()) rest = subtract(rest, taken);
        for (Polygon& q : rest) {
          const Box2 own = bounds(q);
          out.push_back({r.from, r.to, link, std::move(q), own});
        }
      }
    };
    for (const Ray& r : links_) add(r, strip(r, width, nullptr, nullptr), true);
    const std::vector<size_t> next = nextRays();
    std::vector<size_t> previous(next.size());
    for (size_t i = 0; i < next.size(); ++i) previous[next[i]] = i;
    for (size_t i = 0; i < rays_.size(); ++i) {
      add(rays_[i], strip(rays_[i], width, &rays_[next[i]], &rays_[previous[i]]), false);
    }
    return out;
  }

  void withPaths(std::vector<RegionPiece>& out) const {
    const double width = std::max(o_.pathWidth, kLeastWidth);
    const Region centres = allCentres();
    const EdgeOrigin side{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
    Region taken = centres;
    EdgeSource beside;
    for (const Ring& r : ringsOf(centres)) {
      beside.rings.push_back(r);
      beside.origins.resize(beside.origins.size() + r.size(),
                            {kNoEdge, EdgeRole::Centre, EdgeOrigin::kNoSide});
    }
    std::vector<RegionPiece> paths;
    Region sections;
    for (Section& s : allSections(width, besideCentres(centres))) {
      RegionPiece piece;
      piece.kind = PieceKind::Path;
      piece.ix = static_cast<uint32_t>(paths.size());
      piece.axis = normalized(s.to - s.centre);
      piece.width = length(s.to - s.centre);
      piece.height = width;
      paths.push_back(std::move(piece));
      for (Ring& r : ringsOf(s.polygon)) {
        beside.origins.resize(beside.origins.size() + r.size(), side);
        beside.rings.push_back(std::move(r));
      }
      taken.push_back(s.polygon);
      sections.push_back(std::move(s.polygon));
    }
    const EdgeSource sources[] = {sourceOf(p_)};
    std::vector<std::vector<EdgeOrigin>> edges = originsOf(sections, sources, side);
    for (size_t i = 0; i < paths.size(); ++i) {
      paths[i].polygon = std::move(sections[i]);
      paths[i].edges = std::move(edges[i]);
    }
    uint32_t index = 0;
    for (RegionPiece& piece : leftBeside(wholePiece(p_), taken, beside)) {
      piece.ix = index++;
      piece.part = 0;
      out.push_back(std::move(piece));
    }
    out.insert(out.end(), paths.begin(), paths.end());
    // A sector too thin to be one belongs to the path beside it.
    mergeSlivers(out, std::min(kThinSector, o_.pathWidth / 50),
                 std::min(kThinSector, area(p_) / 1e4));
    addCentres(centres, out);
  }

  void addCentres(const Region& centres, std::vector<RegionPiece>& out) const {
    uint32_t index = 0;
    for (const Polygon& c : centres) {
      RegionPiece piece;
      piece.kind = PieceKind::Junction;
      piece.ix = index++;
      const EdgeSource sources[] = {sourceOf(p_)};
      piece.edges = originsOf(c, sources);
      piece.polygon = c;
      out.push_back(std::move(piece));
    }
  }

  void sectors(std::vector<RegionPiece>& out) {
    // A ray that ends at a hole divides nothing.
    const size_t outer = p_.outer.size();
    std::erase_if(rays_, [&](const Ray& r) { return r.edge >= outer; });
    std::stable_sort(rays_.begin(), rays_.end(), [](const Ray& a, const Ray& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.at < b.at;
    });
    if (rays_.size() < 2) {
      out.push_back(wholePiece(p_));
      return;
    }
    const Vec2 c = centres_[0];
    std::vector<bool> given(p_.holes.size(), false);
    for (size_t i = 0; i < rays_.size(); ++i) {
      const Ray& a = rays_[i];
      const Ray& b = rays_[(i + 1) % rays_.size()];
      RegionPiece piece = sector(c, a, b);
      piece.ix = static_cast<uint32_t>(i);
      addHoles(piece, given);
      out.push_back(std::move(piece));
    }
    if (o_.centre.shape == PlanShape::None || !(o_.centre.reach() > 0)) return;
    Region centre;
    for (Polygon& p : intersect({{ringOf(o_.centre, c), {}}}, {p_})) {
      if (contains(p, c)) centre.push_back(std::move(p));
    }
    std::vector<RegionPiece> cut;
    for (const RegionPiece& s : out) {
      for (RegionPiece& p : combineTraced(BooleanOp::Difference, s, centre,
                                          {kNoEdge, EdgeRole::Centre, EdgeOrigin::kNoSide})) {
        cut.push_back(std::move(p));
      }
    }
    out = std::move(cut);
    addCentres(centre, out);
  }

  // The centre, a's hit, the boundary, b's hit.
  RegionPiece sector(Vec2 c, const Ray& a, const Ray& b) const {
    RegionPiece piece;
    const auto add = [&](Vec2 at, EdgeOrigin origin) {
      if (!piece.polygon.outer.empty() && piece.polygon.outer.back() == at) {
        piece.edges.back() = origin;
        return;
      }
      piece.polygon.outer.push_back(at);
      piece.edges.push_back(origin);
    };
    const EdgeOrigin cut{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
    const auto kept = [](uint32_t e) { return EdgeOrigin{e, EdgeRole::Kept, EdgeOrigin::kNoSide}; };
    const auto n = static_cast<uint32_t>(p_.outer.size());
    add(c, cut);
    add(a.to, kept(a.edge));
    const bool sameEdge = a.edge == b.edge && b.at > a.at;
    for (uint32_t e = a.edge, k = 0; !sameEdge && k < n; ++k) {
      e = (e + 1) % n;
      add(p_.outer[e], kept(e));
      if (e == b.edge) break;
    }
    add(b.to, cut);
    return piece;
  }

  void addHoles(RegionPiece& piece, std::vector<bool>& given) const {
    const Ring outer = piece.polygon.outer;
    auto first = static_cast<uint32_t>(p_.outer.size());
    for (size_t h = 0; h < p_.holes.size(); ++h) {
      const auto n = static_cast<uint32_t>(p_.holes[h].size());
      const bool in = !given[h] && std::any_of(p_.holes[h].begin(), p_.holes[h].end(), [&](Vec2 v) {
        return locate(outer, v) == Where::Inside;
      });
      if (in) {
        given[h] = true;
        piece.polygon.holes.push_back(p_.holes[h]);
        for (uint32_t i = 0; i < n; ++i) {
          piece.edges.push_back({first + i, EdgeRole::Kept, EdgeOrigin::kNoSide});
        }
      }
      first += n;
    }
  }

  const Polygon& p_;
  const RayOptions& o_;
  std::vector<Segment> edges_;
  // By edge: the one before it in its ring, and the one after it.
  std::vector<uint32_t> before_, after_;
  // By edge: on which side of the ray in question it starts.
  mutable std::vector<double> sides_;
  // Edges by the place where they start.
  std::vector<uint32_t> corners_;
  double scale_ = 0;
  std::vector<Vec2> centres_;
  std::vector<Ray> rays_, links_;
};

}  // namespace

RayResult castRays(const Polygon& p, std::span<const Vec2> centres,
                   std::span<const RayTarget> targets, const RayOptions& options) {
  return Rays(p, options).run(centres, targets);
}

}  // namespace gable
