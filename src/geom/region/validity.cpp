// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pairs of edges that a grid finds near each other are classified with exact orientation signs;
// where rings touch without crossing, containment is decided by their vertices and the midpoints of
// edges between two touching vertices.
#include <algorithm>
#include <set>

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

struct Contacts {
  bool broken = false;
  std::set<std::pair<uint32_t, uint32_t>> touching;
};

// Looks at all pairs of near edges. Broken: a crossing anywhere, a touch within a ring, an edge
// without length.
Contacts findContacts(const std::vector<Ring>& rings) {
  const std::vector<Segment> edges = edgesOf(rings);
  std::vector<EdgePlace> places;
  places.reserve(edges.size());
  for (uint32_t r = 0; r < rings.size(); ++r) {
    const auto n = static_cast<uint32_t>(rings[r].size());
    for (uint32_t i = 0; i < n; ++i) places.push_back({r, i, n});
  }
  Contacts out;
  SegmentGrid grid(edges);
  for (uint32_t i = 0; i < edges.size() && !out.broken; ++i) {
    if (edges[i].a == edges[i].b) out.broken = true;
    Box2 box;
    box.include(edges[i].a);
    box.include(edges[i].b);
    grid.query(box, [&](uint32_t j) {
      if (j <= i || out.broken) return;
      const Contact c = contact(edges[i], edges[j]);
      if (c == Contact::None) return;
      if (c == Contact::Cross) {
        out.broken = true;
      } else if (places[i].ring != places[j].ring) {
        out.touching.insert({places[i].ring, places[j].ring});
      } else if (!adjacent(places[i], places[j])) {
        out.broken = true;
      }
    });
  }
  return out;
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

bool boxesMeet(const Box2& a, const Box2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

// Rings of one polygon, the outer one first; `first` is its number among all rings.
bool nestedProperly(const std::vector<Ring>& rings, const std::vector<Box2>& boxes, uint32_t first,
                    uint32_t count, const Contacts& contacts) {
  const auto touch = [&](uint32_t i, uint32_t j) {
    return contacts.touching.count({std::min(i, j), std::max(i, j)}) > 0;
  };
  if (signedArea(rings[first]) <= 0) return false;
  for (uint32_t i = first + 1; i < first + count; ++i) {
    if (signedArea(rings[i]) >= 0) return false;
    if (!liesOn(rings[i], rings[first], Where::Inside, touch(i, first))) return false;
    for (uint32_t j = first + 1; j < i; ++j) {
      if (!boxesMeet(boxes[i], boxes[j])) continue;
      if (!liesOn(rings[i], rings[j], Where::Outside, touch(i, j))) return false;
      if (!liesOn(rings[j], rings[i], Where::Outside, touch(i, j))) return false;
    }
  }
  return true;
}

// Rings that do not cross: the polygons overlap when a part of one ring lies inside the other.
bool apart(const Polygon& p, const Polygon& q) {
  if (!boxesMeet(bounds(p), bounds(q))) return true;
  const auto intrudes = [](const Polygon& in, const Polygon& of) {
    for (size_t i = 0; i < in.outer.size(); ++i) {
      const Vec2 a = in.outer[i], b = in.outer[(i + 1) % in.outer.size()];
      if (locate(of, a) == Where::Inside || locate(of, (a + b) * 0.5) == Where::Inside) return true;
    }
    return false;
  };
  return !intrudes(p, q) && !intrudes(q, p);
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
  uint32_t first = 0;
  for (const Polygon& p : r) {
    const auto count = static_cast<uint32_t>(p.holes.size() + 1);
    if (!nestedProperly(rings, boxes, first, count, contacts)) return false;
    first += count;
  }
  for (size_t i = 0; i < r.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (!apart(r[i], r[j])) return false;
    }
  }
  return true;
}

}  // namespace gable
