// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Duplicates and collinear vertices fall in one pass with a stack of kept vertices, repeated until
// nothing changes. Welding finds near vertices through a hash of square cells and near edges
// through a grid; the first vertex in order is the one that stays.
#include "geom/region/clean.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/point_cells.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"

namespace gable {
namespace {

bool isSpike(Vec2 a, Vec2 b, Vec2 c) { return dot(b - a, c - b) < 0 && orientation(a, b, c) == 0; }

// Passes over the ring until one changes nothing; `drop(a, b, c)` says that b goes. A vertex at the
// seam may be judged by a neighbour that goes in the same pass; the next one judges it again.
template <class Drop>
void dropUntilStable(Ring& r, const Drop& drop) {
  bool changed = true;
  while (changed && r.size() >= 3) {
    changed = false;
    work(r.size());
    Ring kept;
    kept.reserve(r.size());
    for (size_t i = 0; i < r.size(); ++i) {
      const Vec2 before = kept.empty() ? r.back() : kept.back();
      const Vec2 after = i + 1 < r.size() ? r[i + 1] : (kept.empty() ? r.front() : kept.front());
      if (drop(before, r[i], after)) {
        changed = true;
      } else {
        kept.push_back(r[i]);
      }
    }
    r.swap(kept);
  }
  if (r.size() < 3) r.clear();
}

// Drops vertices near the line through the kept vertex before and the next one, as long as all that
// were dropped between them are near it too: a fine curve keeps its shape.
void dropNearLines(Ring& r, double tolerance) {
  Ring kept, dropped;
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 before = kept.empty() ? r.back() : kept.back();
    const Vec2 after = r[(i + 1) % r.size()];
    dropped.push_back(r[i]);
    work(dropped.size());
    const bool near = std::all_of(dropped.begin(), dropped.end(), [&](Vec2 p) {
      return distanceTo({before, after}, p) <= tolerance;
    });
    if (near) continue;
    kept.push_back(r[i]);
    dropped.clear();
  }
  r.swap(kept);
}

struct Insertion {
  uint32_t edge;
  double along;
  Vec2 point;
};

// Vertices that lie within `tolerance` of the inside of an edge, in the order of edge and place.
std::vector<Insertion> findInsertions(const std::vector<Ring>& rings,
                                      const std::vector<Vec2>& points, double tolerance) {
  const std::vector<Segment> edges = edgesOf(rings);
  SegmentGrid grid(edges);
  std::vector<Insertion> out;
  for (const Vec2 p : points) {
    work();
    Box2 box;
    box.include(p - Vec2{tolerance, tolerance});
    box.include(p + Vec2{tolerance, tolerance});
    grid.query(box, [&](uint32_t e) {
      const Segment& s = edges[e];
      if (s.a == p || s.b == p || s.a == s.b) return;
      const Vec2 d = s.b - s.a;
      const double along = dot(p - s.a, d) / dot(d, d);
      if (along <= 0 || along >= 1 || distanceTo(s, p) > tolerance) return;
      out.push_back({e, along, p});
    });
  }
  std::sort(out.begin(), out.end(), [](const Insertion& a, const Insertion& b) {
    if (a.edge != b.edge) return a.edge < b.edge;
    if (a.along != b.along) return a.along < b.along;
    return a.point.x != b.point.x ? a.point.x < b.point.x : a.point.y < b.point.y;
  });
  return out;
}

void insertAll(std::vector<Ring>& rings, const std::vector<Insertion>& insertions) {
  uint32_t edge = 0;
  size_t next = 0;
  for (Ring& r : rings) {
    Ring longer;
    for (const Vec2 p : r) {
      longer.push_back(p);
      for (; next < insertions.size() && insertions[next].edge == edge; ++next) {
        longer.push_back(insertions[next].point);
      }
      ++edge;
    }
    r.swap(longer);
  }
}

bool lessXy(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// Cuts one ring at its repeated points into rings without repeats, in the order of their closing.
void splitRing(const Ring& r, std::vector<Ring>& out) {
  work(4 * r.size());
  std::vector<uint32_t> order(r.size()), name(r.size());
  for (uint32_t i = 0; i < r.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return r[a] == r[b] ? a < b : lessXy(r[a], r[b]); });
  uint32_t names = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && !(r[order[i]] == r[order[i - 1]])) ++names;
    name[order[i]] = names;
  }
  if (names + 1 == r.size()) {
    out.push_back(r);
    return;
  }
  constexpr uint32_t kAbsent = 0xffffffff;
  std::vector<uint32_t> placeOf(names + 1, kAbsent), stack;
  for (uint32_t i = 0; i < r.size(); ++i) {
    const uint32_t open = placeOf[name[i]];
    if (open != kAbsent) {
      Ring part;
      for (size_t k = open; k < stack.size(); ++k) {
        part.push_back(r[stack[k]]);
        placeOf[name[stack[k]]] = kAbsent;
      }
      stack.resize(open);
      if (part.size() >= 3) out.push_back(std::move(part));
    }
    placeOf[name[i]] = static_cast<uint32_t>(stack.size());
    stack.push_back(i);
  }
  Ring rest;
  for (const uint32_t i : stack) rest.push_back(r[i]);
  if (rest.size() >= 3) out.push_back(std::move(rest));
}

// Whether a hole lies in an outer ring that it may touch but not cross.
bool holeInside(const Ring& hole, const Ring& outer) {
  for (const Vec2 p : hole) {
    const Where at = locate(outer, p);
    if (at != Where::Boundary) return at == Where::Inside;
  }
  for (size_t i = 0; i < hole.size(); ++i) {
    const Where at = locate(outer, (hole[i] + hole[(i + 1) % hole.size()]) * 0.5);
    if (at != Where::Boundary) return at == Where::Inside;
  }
  return true;
}

}  // namespace

void dropDuplicates(Ring& r, double tolerance) {
  const auto same = [&](Vec2 a, Vec2 b) { return a == b || length(a - b) <= tolerance; };
  size_t before = 0;
  do {
    before = r.size();
    // The first vertex of a run of duplicates stays, over the seam too.
    r.erase(std::unique(r.begin(), r.end(), same), r.end());
    while (r.size() > 1 && same(r.front(), r.back())) r.pop_back();
    dropUntilStable(r, isSpike);
  } while (r.size() != before);
}

void dropCollinear(Ring& r, double tolerance) {
  if (tolerance > 0) {
    dropDuplicates(r, tolerance);
    dropNearLines(r, tolerance);
  }
  dropUntilStable(r, [&](Vec2 a, Vec2 b, Vec2 c) { return a == b || orientation(a, b, c) == 0; });
}

void clean(Region& r, double tolerance) {
  Region out;
  for (Polygon& p : r) {
    dropCollinear(p.outer, tolerance);
    if (p.outer.empty()) continue;
    std::vector<Ring> holes;
    for (Ring& h : p.holes) {
      dropCollinear(h, tolerance);
      if (!h.empty()) holes.push_back(std::move(h));
    }
    p.holes = std::move(holes);
    out.push_back(std::move(p));
  }
  r = std::move(out);
}

bool weld(std::vector<Ring>& rings, double tolerance) {
  bool changed = false;
  size_t count = 0;
  for (const Ring& r : rings) count += r.size();
  PointCells cells(tolerance, count);
  for (Ring& r : rings) {
    for (Vec2& p : r) {
      const Vec2 kept = cells.points()[cells.snap(p)];
      changed = changed || !(kept == p);
      p = kept;
    }
  }
  const std::vector<Insertion> insertions = findInsertions(rings, cells.points(), tolerance);
  if (!insertions.empty()) {
    insertAll(rings, insertions);
    changed = true;
  }
  for (Ring& r : rings) {
    const size_t before = r.size();
    dropDuplicates(r, 0);
    changed = changed || r.size() != before;
  }
  std::erase_if(rings, [](const Ring& r) { return r.empty(); });
  return changed;
}

void splitAtRepeats(std::vector<Ring>& rings) {
  std::vector<Ring> out;
  for (const Ring& r : rings) splitRing(r, out);
  rings = std::move(out);
}

Region nest(std::vector<Ring> rings) {
  Region out;
  std::vector<double> areas;
  std::vector<Box2> boxes;
  for (Ring& r : rings) {
    const double a = signedArea(r);
    if (a <= 0) continue;
    areas.push_back(a);
    boxes.push_back(bounds(r));
    out.push_back({std::move(r), {}});
    r.clear();
  }
  for (Ring& r : rings) {
    if (r.size() < 3 || signedArea(r) >= 0) continue;
    const Box2 box = bounds(r);
    size_t best = out.size();
    work(out.size());
    for (size_t i = 0; i < out.size(); ++i) {
      const bool fits = boxes[i].min.x <= box.min.x && boxes[i].min.y <= box.min.y &&
                        boxes[i].max.x >= box.max.x && boxes[i].max.y >= box.max.y;
      if (!fits || (best < out.size() && areas[i] >= areas[best])) continue;
      if (holeInside(r, out[i].outer)) best = i;
    }
    if (best < out.size()) out[best].holes.push_back(std::move(r));
  }
  return out;
}

std::vector<uint32_t> traceEdges(const std::vector<Ring>& result, const std::vector<Ring>& sources,
                                 double tolerance, double shift) {
  std::vector<Segment> edges = edgesOf(sources);
  for (Segment& s : edges) {
    const Vec2 by = normalized(perpendicular(s.b - s.a)) * shift;
    s = {s.a + by, s.b + by};
  }
  return traceSegments(edgesOf(result), edges, tolerance);
}

std::vector<uint32_t> traceSegments(std::span<const Segment> result,
                                    std::span<const Segment> sources, double tolerance) {
  std::vector<uint32_t> out;
  out.reserve(result.size());
  work(result.size() + sources.size());
  // So few are looked at faster one by one.
  constexpr size_t kFew = 12;
  // Of many sources most are far from a small result.
  Box2 reach;
  for (const Segment& e : result) {
    reach.include(e.a);
    reach.include(e.b);
  }
  std::vector<uint32_t> near;
  std::vector<Segment> nearSources;
  for (uint32_t i = 0; i < sources.size(); ++i) {
    const Segment& s = sources[i];
    if (std::max(s.a.x, s.b.x) < reach.min.x - tolerance ||
        std::min(s.a.x, s.b.x) > reach.max.x + tolerance ||
        std::max(s.a.y, s.b.y) < reach.min.y - tolerance ||
        std::min(s.a.y, s.b.y) > reach.max.y + tolerance) {
      continue;
    }
    near.push_back(i);
    nearSources.push_back(s);
  }
  const bool few = near.size() <= kFew || result.size() <= 2;
  SegmentGrid grid(few ? std::span<const Segment>() : nearSources);
  for (const Segment& e : result) {
    const Vec2 middle = (e.a + e.b) * 0.5;
    Box2 box;
    box.include(middle - Vec2{tolerance, tolerance});
    box.include(middle + Vec2{tolerance, tolerance});
    uint32_t best = kNoEdge;
    double bestCost = 0;
    const auto look = [&](uint32_t k) {
      const uint32_t i = near[k];
      const Segment& s = nearSources[k];
      if (std::max(s.a.x, s.b.x) < box.min.x || std::min(s.a.x, s.b.x) > box.max.x ||
          std::max(s.a.y, s.b.y) < box.min.y || std::min(s.a.y, s.b.y) > box.max.y) {
        return;
      }
      const Vec2 d = normalized(s.b - s.a);
      // Both ends lie on the source line; a miter may reach beyond the source's own ends.
      const double off = std::max(std::fabs(cross(d, e.a - s.a)), std::fabs(cross(d, e.b - s.a)));
      const double beside = distanceTo(s, middle);
      if (off > tolerance || beside > tolerance) return;
      const double cost = off + beside + (dot(d, e.b - e.a) < 0 ? 4 * tolerance : 0);
      if (best == kNoEdge || cost < bestCost || (cost == bestCost && i < best)) {
        best = i;
        bestCost = cost;
      }
    };
    if (few) {
      work(near.size());
      for (uint32_t k = 0; k < near.size(); ++k) look(k);
    } else {
      grid.query(box, look);
    }
    out.push_back(best);
  }
  return out;
}

std::vector<Ring> ringsOf(const Region& r) {
  std::vector<Ring> out;
  for (const Polygon& p : r) {
    work(p.outer.size() + p.holes.size());
    out.push_back(p.outer);
    out.insert(out.end(), p.holes.begin(), p.holes.end());
  }
  return out;
}

}  // namespace gable
