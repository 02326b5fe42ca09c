// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Shoelace sums relative to the first point; even-odd point location by crossing counts with exact
// orientation signs, so that points on an edge are never missed.
#include "geom/region/region.h"

#include <algorithm>

#include "base/work.h"
#include "geom/region/crossing.h"

namespace gable {

Where locate(const Ring& r, Vec2 p) {
  work(r.size());
  bool inside = false;
  for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
    const Crossing crossing = crossingOf(r[j], r[i], p);
    if (crossing == Crossing::Touches) return Where::Boundary;
    if (crossing == Crossing::Crosses) inside = !inside;
  }
  return inside ? Where::Inside : Where::Outside;
}

Where locate(const Polygon& p, Vec2 point) {
  Where where = locate(p.outer, point);
  for (const Ring& h : p.holes) {
    if (where == Where::Boundary) return where;
    const Where inHole = locate(h, point);
    if (inHole == Where::Boundary) return inHole;
    if (inHole == Where::Inside) {
      where = where == Where::Inside ? Where::Outside : Where::Inside;
    }
  }
  return where;
}

double signedArea(const Ring& r) {
  if (r.size() < 3) return 0;
  work(r.size());
  double twice = 0;
  for (size_t i = 1; i + 1 < r.size(); ++i) twice += cross(r[i] - r[0], r[i + 1] - r[0]);
  return twice / 2;
}

double area(const Polygon& p) {
  double a = std::fabs(signedArea(p.outer));
  for (const Ring& h : p.holes) a -= std::fabs(signedArea(h));
  return a;
}

double area(const Region& r) {
  double a = 0;
  for (const Polygon& p : r) a += area(p);
  return a;
}

Box2 bounds(const Ring& r) {
  work(r.size());
  Box2 b;
  for (const Vec2 p : r) b.include(p);
  return b;
}

Box2 bounds(const Polygon& p) { return bounds(p.outer); }

double perimeter(const Ring& r) {
  work(r.size());
  double l = 0;
  for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) l += length(r[i] - r[j]);
  return l;
}

bool contains(const Polygon& p, Vec2 point) { return locate(p, point) != Where::Outside; }

void orient(Polygon& p) {
  if (signedArea(p.outer) < 0) std::reverse(p.outer.begin(), p.outer.end());
  for (Ring& h : p.holes) {
    if (signedArea(h) > 0) std::reverse(h.begin(), h.end());
  }
}

}  // namespace gable
