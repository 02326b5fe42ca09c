// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Support is a union-find over pairs of leaves: a pair that is joined already, by whatever way,
// needs no second look, so that few triangles are compared.
//
// The depth of one convex body in another is the least shift that parts them, along the normal of a
// face of either or across an edge of each (S. Gottschalk and others, OBBTree, 1996). Of other
// bodies it is how far the edges of one lie below the surface of the other.

#include "cases/solid_faults.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/disjoint_sets.h"
#include "base/work.h"
#include "cases/measure.h"

namespace gable::cases {
namespace {

constexpr double kSamePlane = 1e-3;
constexpr double kLeastShared = 1e-3;
constexpr double kLowest = 0.15;
constexpr double kTouch = 0.01;
constexpr double kLeastDepth = 0.01;
/// Deeper is not measured.
constexpr double kFarIn = 0.25;

/// The triangles of two parts where both are.
struct Meeting {
  std::vector<Triangle> first, second;

  bool find(const Parts& parts, uint32_t a, uint32_t b, double gap) {
    work();
    first.clear();
    second.clear();
    parts.trianglesNear(a, Parts::grown(parts[b].box, gap), first);
    if (!first.empty()) parts.trianglesNear(b, Parts::grown(parts[a].box, gap), second);
    work(first.size() + second.size());
    return !second.empty();
  }
};

// Directions that differ, whichever way they point.
void addDirection(std::vector<Vec3>& all, const Vec3& direction) {
  const Vec3 d = normalized(direction);
  if (d == Vec3{}) return;
  const bool known = std::any_of(all.begin(), all.end(),
                                 [&](const Vec3& o) { return std::fabs(dot(o, d)) > 1 - 1e-9; });
  if (!known) all.push_back(d);
}

struct Body {
  Mesh mesh;
  std::vector<Vec3> normals, edges;

  explicit Body(Mesh m) : mesh(std::move(m)) {
    for (size_t face = 0; face < mesh.faceCount(); ++face) {
      addDirection(normals, mesh.normal(face));
      for (const MeshLoop& loop : mesh.loopsOf(face)) {
        const auto corners = mesh.cornersOf(loop);
        for (size_t i = 0; i < corners.size(); ++i) {
          addDirection(edges, mesh.positions[corners[(i + 1) % corners.size()]] -
                                  mesh.positions[corners[i]]);
        }
      }
    }
  }
};

// How far two bodies overlap along a direction.
double overlapAlong(const Vec3& d, const Mesh& a, const Mesh& b) {
  work(a.positions.size() + b.positions.size());
  double lowA = INFINITY, highA = -INFINITY, lowB = INFINITY, highB = -INFINITY;
  for (const Vec3& p : a.positions) {
    lowA = std::min(lowA, dot(p, d));
    highA = std::max(highA, dot(p, d));
  }
  for (const Vec3& p : b.positions) {
    lowB = std::min(lowB, dot(p, d));
    highB = std::max(highB, dot(p, d));
  }
  return std::min(highA - lowB, highB - lowA);
}

double convexDepth(const Body& a, const Body& b) {
  double least = INFINITY;
  const auto look = [&](const Vec3& d) {
    if (least > kLeastDepth) least = std::min(least, overlapAlong(d, a.mesh, b.mesh));
  };
  for (const Vec3& n : a.normals) look(n);
  for (const Vec3& n : b.normals) look(n);
  for (const Vec3& e : a.edges) {
    for (const Vec3& f : b.edges) {
      const Vec3 across = cross(e, f);
      if (length(across) > 1e-6) look(normalized(across));
    }
  }
  return least;
}

// Whether a point lies in a closed part: a ray upwards leaves it once more than it enters it. The
// ray leans, so that it meets no edge.
bool isInside(const Parts& parts, uint32_t part, const Vec3& p, std::vector<Triangle>& near) {
  const Box3& box = parts[part].box;
  if (!box.meets({p, p})) return false;
  const double up = box.max.y - p.y + 1;
  const Vec3 end = p + Vec3{0.00137 * up, up, 0.00271 * up};
  near.clear();
  parts.trianglesNear(part, boundsOf({{p, end, p}}), near);
  const auto crossed = std::count_if(
      near.begin(), near.end(), [&](const Triangle& t) { return pierced(p, end, t).has_value(); });
  return crossed % 2 == 1;
}

// How far a point is from the surface of a part, up to kFarIn.
double depthAt(const Parts& parts, uint32_t part, const Vec3& p, std::vector<Triangle>& near) {
  near.clear();
  parts.trianglesNear(part, Parts::grown({p, p}, kFarIn), near);
  double least = kFarIn;
  for (const Triangle& t : near) least = std::min(least, distance(p, t));
  return least;
}

// How deep the edges of one part lie in another: at their ends, and in the middle between two
// places where they enter or leave it.
double edgeDepth(const Parts& parts, uint32_t edges, uint32_t body) {
  std::vector<Triangle> own, near;
  parts.trianglesNear(edges, parts[body].box, own);
  double deepest = 0;
  std::vector<double> stops;
  for (const Triangle& t : own) {
    for (size_t i = 0; i < 3; ++i) {
      work();
      const Vec3 from = t[i], along = t[(i + 1) % 3] - from;
      near.clear();
      parts.trianglesNear(body, boundsOf({{from, from + along, from}}), near);
      stops = {0, 0, 1, 1};
      for (const Triangle& face : near) {
        if (const auto at = pierced(from, from + along, face)) stops.push_back(*at);
      }
      std::sort(stops.begin(), stops.end());
      for (size_t k = 0; k + 1 < stops.size(); ++k) {
        const Vec3 p = from + along * ((stops[k] + stops[k + 1]) / 2);
        if (!isInside(parts, body, p, near)) continue;
        deepest = std::max(deepest, depthAt(parts, body, p, near));
      }
    }
  }
  return deepest;
}

// Seen by nobody who stands on the ground.
bool isHidden(const Triangle& t, double ground) {
  const Box3 box = boundsOf(t);
  const bool level = box.max.y - box.min.y < kSamePlane && box.max.y < ground + kLowest;
  return level && cross(t[1] - t[0], t[2] - t[0]).y < 0;
}

Box3 sharedBox(const Box3& a, const Box3& b) {
  Box3 box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::max(a.min[axis], b.min[axis]);
    box.max[axis] = std::min(a.max[axis], b.max[axis]);
  }
  return box;
}

}  // namespace

std::vector<SolidFault> coplanarFaces(const Parts& parts, double ground) {
  std::vector<SolidFault> found;
  Meeting meeting;
  parts.forEachPair(kSamePlane, [&](uint32_t a, uint32_t b) {
    if (!meeting.find(parts, a, b, kSamePlane)) return;
    SolidFault fault{a, b, 0, {}};
    forEachNear(meeting.first, meeting.second, kSamePlane,
                [&](const Triangle& s, const Triangle& t) {
                  if (s.material == t.material || isHidden(s, ground)) return false;
                  Vec3 at;
                  const double area = sharedArea(s, t, kSamePlane, at);
                  if (area > 0) fault.at = at;
                  fault.amount += area;
                  return false;
                });
    if (fault.amount > kLeastShared) found.push_back(fault);
  });
  return found;
}

std::vector<SolidFault> floatingParts(const Parts& parts, double ground) {
  DisjointSets groups(parts.size());
  Meeting meeting;
  parts.forEachPair(kTouch, [&](uint32_t a, uint32_t b) {
    if (groups.find(a) == groups.find(b) || !meeting.find(parts, a, b, kTouch)) return;
    const bool touch =
        forEachNear(meeting.first, meeting.second, kTouch,
                    [](const Triangle& s, const Triangle& t) { return withinReach(s, t, kTouch); });
    if (touch) groups.join(a, b);
  });
  // By group: its lowest leaf, and how many leaves it has.
  std::vector<SolidFault> lowest(parts.size());
  for (uint32_t i = 0; i < parts.size(); ++i) {
    SolidFault& group = lowest[groups.find(i)];
    const double low = parts[i].box.min.y - ground;
    if (group.second++ == 0 || low < group.amount) {
      group.first = i;
      group.amount = low;
      group.at = parts[i].box.center();
    }
  }
  std::vector<SolidFault> found;
  for (const SolidFault& group : lowest) {
    if (group.second > 0 && group.amount > kTouch) found.push_back(group);
  }
  return found;
}

std::vector<SolidFault> overlaps(const Parts& parts,
                                 const std::function<bool(uint32_t, uint32_t)>& skip) {
  std::vector<SolidFault> found;
  parts.forEachPair(-kLeastDepth, [&](uint32_t a, uint32_t b) {
    if (!parts.closed(a) || !parts.closed(b) || (skip && skip(a, b))) return;
    const Box3 box = sharedBox(parts[a].box, parts[b].box);
    const bool convex = parts.convex(a) && parts.convex(b);
    const double depth = convex ? convexDepth(Body(parts.mesh(a)), Body(parts.mesh(b)))
                                : std::max(edgeDepth(parts, a, b), edgeDepth(parts, b, a));
    if (depth > kLeastDepth) found.push_back({a, b, depth, box.center()});
  });
  return found;
}

}  // namespace gable::cases
