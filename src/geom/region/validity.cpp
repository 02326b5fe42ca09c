// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pairs of edges that a sweep (few edges) or a grid (many) finds near each other are classified
// with exact orientation signs; where rings touch without crossing, containment is decided by their
// vertices and the midpoints of edges between two touching vertices. Where rings keep clear of each
// other, rounded products decide: what is in doubt is not clear.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"

namespace gable {
namespace {

enum class Contact : uint8_t { None, Touch, Cross };

// Cross: the interiors cross or the segments share a stretch. Touch: a single point that is an end
// of one of them.
Contact contact(const Segment& s, const Segment& t) {
  if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) ||
      std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
      std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) ||
      std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y)) {
    return Contact::None;
  }
  const int ta = orientation(s.a, s.b, t.a), tb = orientation(s.a, s.b, t.b);
  if (ta * tb > 0) return Contact::None;
  const int sa = orientation(t.a, t.b, s.a), sb = orientation(t.a, t.b, s.b);
  if (sa * sb > 0) return Contact::None;
  if (ta * tb < 0 && sa * sb < 0) return Contact::Cross;
  if (ta != 0 || tb != 0) return Contact::Touch;
  // Collinear: a shared stretch, or at most a common end.
  const auto along = [&](Vec2 p) {
    return std::fabs(s.b.x - s.a.x) > std::fabs(s.b.y - s.a.y) ? p.x : p.y;
  };
  const double lo = std::max(std::min(along(s.a), along(s.b)), std::min(along(t.a), along(t.b)));
  const double hi = std::min(std::max(along(s.a), along(s.b)), std::max(along(t.a), along(t.b)));
  return lo < hi ? Contact::Cross : (lo == hi ? Contact::Touch : Contact::None);
}

struct EdgePlace {
  uint32_t ring, index, ringSize;
};

// Neighbours in one ring share a vertex; in a triangle every pair does.
bool adjacent(const EdgePlace& e, const EdgePlace& f) {
  if (e.ring != f.ring) return false;
  const uint32_t d = e.index > f.index ? e.index - f.index : f.index - e.index;
  return d == 1 || d + 1 == e.ringSize;
}

std::vector<EdgePlace> placesOf(const std::vector<Ring>& rings) {
  std::vector<EdgePlace> places;
  for (uint32_t r = 0; r < rings.size(); ++r) {
    const auto n = static_cast<uint32_t>(rings[r].size());
    work(n);
    for (uint32_t i = 0; i < n; ++i) places.push_back({r, i, n});
  }
  return places;
}

// Above this many edges a sweep in one direction has too many at a time.
constexpr size_t kSweepEdges = 500;

// Calls visit(i, j), i != j, once for each pair of edges whose boxes are nearer than `margin`, and
// for some others, until one returns false.
template <class Visit>
void forNearPairs(const std::vector<Segment>& edges, double margin, Visit&& visit) {
  if (edges.size() > kSweepEdges) {
    SegmentGrid grid(edges);
    bool more = true;
    for (uint32_t i = 0; i < edges.size() && more; ++i) {
      Box2 box;
      box.include(edges[i].a);
      box.include(edges[i].b);
      box.min = box.min - Vec2{margin, margin};
      box.max = box.max + Vec2{margin, margin};
      grid.query(box, [&](uint32_t j) {
        if (j > i && more) more = visit(i, j);
      });
    }
    return;
  }
  struct Extent {
    double left, right, bottom, top;
    uint32_t edge;
  };
  std::vector<Extent> order;
  order.reserve(edges.size());
  for (uint32_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = edges[i];
    order.push_back({std::min(a.x, b.x), std::max(a.x, b.x) + margin, std::min(a.y, b.y),
                     std::max(a.y, b.y) + margin, i});
  }
  std::sort(order.begin(), order.end(), [](const Extent& a, const Extent& b) {
    return a.left != b.left ? a.left < b.left : a.edge < b.edge;
  });
  for (size_t i = 0; i < order.size(); ++i) {
    const Extent& e = order[i];
    for (size_t k = i + 1; k < order.size() && order[k].left <= e.right; ++k) {
      work();
      if (order[k].bottom > e.top || e.bottom > order[k].top) continue;
      if (!visit(std::min(e.edge, order[k].edge), std::max(e.edge, order[k].edge))) return;
    }
  }
}

struct Contacts {
  bool broken = false;
  // Pairs of rings, the lower one first, in order.
  std::vector<std::pair<uint32_t, uint32_t>> touching;

  bool touch(uint32_t i, uint32_t j) const {
    return std::binary_search(touching.begin(), touching.end(),
                              std::pair{std::min(i, j), std::max(i, j)});
  }
};

// Looks at all pairs of near edges. Broken: a crossing anywhere, a touch within a ring, an edge
// without length.
Contacts findContacts(const std::vector<Ring>& rings) {
  const std::vector<Segment> edges = edgesOf(rings);
  const std::vector<EdgePlace> places = placesOf(rings);
  Contacts out;
  out.broken = std::any_of(edges.begin(), edges.end(), [](const Segment& s) { return s.a == s.b; });
  if (out.broken) return out;
  forNearPairs(edges, 0, [&](uint32_t i, uint32_t j) {
    // Neighbours that do not turn back meet in their corner only.
    if (adjacent(places[i], places[j]) &&
        dot(edges[i].b - edges[i].a, edges[j].b - edges[j].a) >= 0) {
      return true;
    }
    const Contact c = contact(edges[i], edges[j]);
    if (c == Contact::None) return true;
    if (c == Contact::Cross) {
      out.broken = true;
    } else if (places[i].ring != places[j].ring) {
      out.touching.emplace_back(std::min(places[i].ring, places[j].ring),
                                std::max(places[i].ring, places[j].ring));
    } else if (!adjacent(places[i], places[j])) {
      out.broken = true;
    }
    return !out.broken;
  });
  std::sort(out.touching.begin(), out.touching.end());
  out.touching.erase(std::unique(out.touching.begin(), out.touching.end()), out.touching.end());
  return out;
}

// Twice the area of a triangle, when the rounded value is larger than `least` without doubt; else
// 0.
double surely(Vec2 u, Vec2 v, double least) {
  const double left = u.x * v.y, right = u.y * v.x, det = left - right;
  const double doubt = 4e-15 * (std::fabs(left) + std::fabs(right)) + 1.0001 * least;
  return std::fabs(det) > doubt ? det : 0;
}

// Both ends of t lie on one side of the line of s, further away than `distance`.
bool keepsBeside(const Segment& s, const Segment& t, double distance) {
  const Vec2 d = s.b - s.a;
  const double least = distance * length(d);
  const double a = surely(d, t.a - s.a, least), b = surely(d, t.b - s.a, least);
  return (a > 0 && b > 0) || (a < 0 && b < 0);
}

bool segmentsClear(const Segment& s, const Segment& t, double distance) {
  if (keepsBeside(s, t, distance) || keepsBeside(t, s, distance)) return true;
  const double most = 1.0001 * distance;
  if (distanceTo(s, t.a) <= most || distanceTo(s, t.b) <= most || distanceTo(t, s.a) <= most ||
      distanceTo(t, s.b) <= most) {
    return false;
  }
  const bool across = (cross(s.b - s.a, t.a - s.a) > 0) != (cross(s.b - s.a, t.b - s.a) > 0);
  return !across || (cross(t.b - t.a, s.a - t.a) > 0) == (cross(t.b - t.a, s.b - t.a) > 0);
}

// Edges that meet in `corner`: the other end of neither is near the other edge.
bool cornerClear(Vec2 before, Vec2 corner, Vec2 after, double distance) {
  const Vec2 u = before - corner, v = after - corner;
  if (dot(u, v) <= 0) return true;
  return surely(u, v, distance * std::max(length(u), length(v))) != 0;
}

// No vertex is nearer than `distance` to an edge that it does not end, and no edges cross.
bool allClear(const std::vector<Ring>& rings, double distance) {
  for (const Ring& r : rings) {
    const size_t n = r.size();
    if (n < 3) return false;
    work(n);
    for (size_t i = 0, j = n - 1; i < n; j = i++) {
      const double l = length(r[i] - r[j]);
      if (!(l > 1.0001 * distance) || !std::isfinite(l)) return false;
      if (!cornerClear(r[j], r[i], r[i + 1 == n ? 0 : i + 1], distance)) return false;
    }
  }
  const std::vector<Segment> edges = edgesOf(rings);
  const std::vector<EdgePlace> places = placesOf(rings);
  bool clear = true;
  forNearPairs(edges, distance, [&](uint32_t i, uint32_t j) {
    if (!adjacent(places[i], places[j])) clear = segmentsClear(edges[i], edges[j], distance);
    return clear;
  });
  return clear;
}

// Calls visit(i, j), i > j, for the pairs of polygons whose boxes meet, until one returns false.
template <class Visit>
bool forMeetingPairs(const std::vector<Box2>& boxes, Visit&& visit) {
  std::vector<uint32_t> order(boxes.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return boxes[a].min.x != boxes[b].min.x ? boxes[a].min.x < boxes[b].min.x : a < b;
  });
  for (size_t i = 0; i < order.size(); ++i) {
    for (size_t k = i + 1; k < order.size(); ++k) {
      work();
      if (boxes[order[k]].min.x > boxes[order[i]].max.x) break;
      if (!boxes[order[i]].meets(boxes[order[k]])) continue;
      if (!visit(std::max(order[i], order[k]), std::min(order[i], order[k]))) return false;
    }
  }
  return true;
}

// Holes of one polygon do not lie in each other, and polygons not in each other; no rings touch.
bool apartWithoutContact(const Region& r) {
  std::vector<Box2> boxes;
  for (const Polygon& p : r) {
    boxes.push_back(bounds(p));
    if (p.holes.size() < 2) continue;
    std::vector<Box2> holes;
    for (const Ring& h : p.holes) holes.push_back(bounds(h));
    const bool apart = forMeetingPairs(holes, [&](uint32_t i, uint32_t j) {
      return locate(p.holes[i], p.holes[j][0]) == Where::Outside &&
             locate(p.holes[j], p.holes[i][0]) == Where::Outside;
    });
    if (!apart) return false;
  }
  return forMeetingPairs(boxes, [&](uint32_t i, uint32_t j) {
    return locate(r[i], r[j].outer[0]) == Where::Outside &&
           locate(r[j], r[i].outer[0]) == Where::Outside;
  });
}

// Where a ring lies that does not cross `other`: all of it on one side. Only touching rings need
// more than one look.
Where sideOf(const Ring& ring, const Ring& other, bool touching) {
  const size_t looks = touching ? ring.size() : 1;
  for (size_t i = 0; i < looks; ++i) {
    const Where at = locate(other, ring[i]);
    if (at != Where::Boundary) return at;
  }
  for (size_t i = 0; i < ring.size(); ++i) {
    const Where at = locate(other, (ring[i] + ring[(i + 1) % ring.size()]) * 0.5);
    if (at != Where::Boundary) return at;
  }
  return Where::Boundary;
}

// True when every part of a touching ring is on side `wanted` or on the boundary.
bool liesOn(const Ring& ring, const Ring& other, Where wanted, bool touching) {
  if (sideOf(ring, other, touching) != wanted) return false;
  if (!touching) return true;
  const auto fits = [&](Vec2 p) {
    const Where at = locate(other, p);
    return at == wanted || at == Where::Boundary;
  };
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if (!fits(a)) return false;
    const bool chord = locate(other, a) == Where::Boundary && locate(other, b) == Where::Boundary;
    if (chord && !fits((a + b) * 0.5)) return false;
  }
  return true;
}

// Rings of one polygon, the outer one first; `first` is its number among all rings.
bool nestedProperly(const std::vector<Ring>& rings, const std::vector<Box2>& boxes, uint32_t first,
                    uint32_t count, const Contacts& contacts) {
  if (signedArea(rings[first]) <= 0) return false;
  for (uint32_t i = first + 1; i < first + count; ++i) {
    if (signedArea(rings[i]) >= 0) return false;
    if (!liesOn(rings[i], rings[first], Where::Inside, contacts.touch(i, first))) return false;
    for (uint32_t j = first + 1; j < i; ++j) {
      work();
      if (!boxes[i].meets(boxes[j])) continue;
      if (!liesOn(rings[i], rings[j], Where::Outside, contacts.touch(i, j))) return false;
      if (!liesOn(rings[j], rings[i], Where::Outside, contacts.touch(i, j))) return false;
    }
  }
  return true;
}

// A part of the outline of `in` lies inside `of`; rings do not cross. Only what touches needs more
// than one look.
bool intrudes(const Polygon& in, const Polygon& of, const Box2& box, bool touching) {
  const auto inside = [&](Vec2 p) {
    return p.x > box.min.x && p.y > box.min.y && p.x < box.max.x && p.y < box.max.y &&
           locate(of, p) == Where::Inside;
  };
  if (!touching) return inside(in.outer[0]);
  for (size_t i = 0; i < in.outer.size(); ++i) {
    const Vec2 a = in.outer[i], b = in.outer[(i + 1) % in.outer.size()];
    if (inside(a) || inside((a + b) * 0.5)) return true;
  }
  return false;
}

// The polygons do not overlap; `first` is the number of a polygon's outer ring.
bool allApart(const Region& r, const std::vector<Box2>& boxes, const std::vector<uint32_t>& first,
              const Contacts& contacts) {
  const auto touch = [&](uint32_t i, uint32_t j) {
    for (uint32_t a = 0; a <= r[i].holes.size(); ++a) {
      work(1 + r[j].holes.size());
      for (uint32_t b = 0; b <= r[j].holes.size(); ++b) {
        if (contacts.touch(first[i] + a, first[j] + b)) return true;
      }
    }
    return false;
  };
  return forMeetingPairs(boxes, [&](uint32_t i, uint32_t j) {
    const bool touching = touch(i, j);
    return !intrudes(r[i], r[j], boxes[j], touching) && !intrudes(r[j], r[i], boxes[i], touching);
  });
}

}  // namespace

bool isSimple(const Ring& r) { return r.size() >= 3 && !findContacts({r}).broken; }

bool isValid(const Polygon& p) { return isValid(Region{p}); }

bool isValid(const Region& r) {
  const std::vector<Ring> rings = ringsOf(r);
  for (const Ring& ring : rings) {
    if (ring.size() < 3) return false;
    for (const Vec2 p : ring) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
    }
  }
  const Contacts contacts = findContacts(rings);
  if (contacts.broken) return false;
  std::vector<Box2> boxes;
  for (const Ring& ring : rings) boxes.push_back(bounds(ring));
  std::vector<uint32_t> firsts;
  std::vector<Box2> outerBoxes;
  uint32_t first = 0;
  for (const Polygon& p : r) {
    const auto count = static_cast<uint32_t>(p.holes.size() + 1);
    if (!nestedProperly(rings, boxes, first, count, contacts)) return false;
    firsts.push_back(first);
    outerBoxes.push_back(boxes[first]);
    first += count;
  }
  return allApart(r, outerBoxes, firsts, contacts);
}

bool nestClear(const std::vector<Ring>& rings, double distance, Region& out) {
  if (!allClear(rings, distance)) return false;
  Region region = nest(rings);
  size_t nested = 0;
  for (const Polygon& p : region) nested += 1 + p.holes.size();
  if (nested != rings.size() || !apartWithoutContact(region)) return false;
  out = std::move(region);
  return true;
}

}  // namespace gable
