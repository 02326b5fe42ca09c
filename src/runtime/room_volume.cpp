// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Convex pieces overlap when no direction square to an edge separates them (Gottschalk, Lin,
// Manocha 1996). Their distance, where they are apart, is one from a corner to an edge.

#include "runtime/room_volume.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/mesh/face_triangles.h"
#include "geom/region/hull.h"
#include "runtime/solid_tests.h"

namespace gable {

namespace {

// Of a body with more pieces the hull stands for all: what is so round or so rich is close to it,
// and two of them would be compared piece by piece. What lies flat on the ground, as a road does,
// may be far from its hull.
constexpr size_t kMostPieces = 64, kMostFlatPieces = 100000;
// Faces that are steeper show no plan.
constexpr double kSteep = 1e-6;

using Piece = std::span<const Vec2>;

struct Interval {
  double low, high;
};

bool isFlat(Interval i) { return i.high - i.low <= kContactTolerance; }

// Whether they leave each other alone. Two that are flat at the same place tell nothing.
bool areApart(Interval a, Interval b) {
  const double gap = std::max(b.low - a.high, a.low - b.high);
  if (isFlat(a) && isFlat(b) && gap <= kContactTolerance) return false;
  return gap >= -kContactTolerance;
}

Interval along(Vec2 direction, Piece p) {
  Interval out{dot(direction, p[0]), dot(direction, p[0])};
  for (const Vec2 v : p.subspan(1)) {
    const double d = dot(direction, v);
    out = {std::min(out.low, d), std::max(out.high, d)};
  }
  return out;
}

bool areApartAlong(Vec2 direction, Piece a, Piece b) {
  return areApart(along(direction, a), along(direction, b));
}

// In a direction that belongs to `a`: square to its edges, and along them, which tells thin ones
// apart that lie one behind the other.
bool separates(Piece a, Piece b) {
  if (a.size() == 1) {
    return b.size() == 1 && (areApartAlong({1, 0}, a, b) || areApartAlong({0, 1}, a, b));
  }
  for (size_t i = 0; i < a.size(); ++i) {
    const Vec2 edge = normalized(a[(i + 1) % a.size()] - a[i]);
    if (areApartAlong(perpendicular(edge), a, b) || areApartAlong(edge, a, b)) return true;
  }
  return false;
}

// By the boxes around them: neither touch nor are within the distance.
bool areFar(Piece a, Piece b, double distance) {
  const double least = std::max(distance, 0.0);
  for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}}) {
    const Interval i = along(axis, a), k = along(axis, b);
    if (std::max(k.low - i.high, i.low - k.high) > least + kContactTolerance) return true;
  }
  return false;
}

bool overlap(Piece a, Piece b) { return !separates(a, b) && !separates(b, a); }

double distanceToSegment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double squared = dot(d, d);
  const double t = squared > 0 ? std::clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0;
  return length(p - (a + d * t));
}

// Of two that do not overlap.
double distance(Piece a, Piece b) {
  double least = length(a[0] - b[0]);
  const auto toEdges = [&](Piece corners, Piece edges) {
    for (const Vec2 p : corners) {
      for (size_t i = 0; i < edges.size(); ++i) {
        least = std::min(least, distanceToSegment(p, edges[i], edges[(i + 1) % edges.size()]));
      }
    }
  };
  toEdges(a, b);
  toEdges(b, a);
  return least;
}

bool isConvex(Piece p) {
  for (size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i], b = p[(i + 1) % p.size()], c = p[(i + 2) % p.size()];
    if (cross(b - a, c - b) < 0) return false;
  }
  return p.size() >= 3;
}

bool hasArea(const Mesh& m) {
  for (size_t f = 0; f < m.faceCount(); ++f) {
    work();
    if (m.normal(f) != Vec3{}) return true;
  }
  return false;
}

}  // namespace

RoomVolumes::Piece RoomVolumes::piece(uint32_t number) const {
  const uint32_t begin = number > 0 ? pieceEnds_[number - 1] : 0;
  return Piece(points_).subspan(begin, pieceEnds_[number] - begin);
}

void RoomVolumes::addPiece(Piece points) {
  points_.insert(points_.end(), points.begin(), points.end());
  pieceEnds_.push_back(static_cast<uint32_t>(points_.size()));
}

void RoomVolumes::addHull(std::vector<Vec2> points) {
  const bool sound =
      std::ranges::all_of(points, [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  if (sound && !points.empty()) addPiece(convexHull(points));
}

// The faces that look up, or those that look down; false when there is none. Each closed body is
// covered by the former.
bool RoomVolumes::addFaces(const Mesh& m, bool up, size_t most) {
  FaceTriangulator triangulator;
  std::vector<std::array<uint32_t, 3>> triangles;
  Ring ring;
  const size_t before = pieceEnds_.size();
  for (size_t f = 0; f < m.faceCount() && pieceEnds_.size() - before <= most; ++f) {
    work();
    const double y = m.normal(f).y;
    if (!(up ? y > kSteep : y < -kSteep)) continue;
    const auto loops = m.loopsOf(f);
    ring.clear();
    for (uint32_t c = 0; c < loops[0].cornerCount; ++c) {
      ring.push_back(planOf(m.positions[m.corners[loops[0].firstCorner + c]]));
    }
    if (!up) std::reverse(ring.begin(), ring.end());
    if (loops.size() == 1 && isConvex(ring)) {
      addPiece(ring);
      continue;
    }
    triangles.clear();
    triangulator.add(m, f, triangles);
    for (const auto& t : triangles) {
      const Vec2 corners[] = {planOf(m.at(t[0])), planOf(m.at(t[up ? 1 : 2])),
                              planOf(m.at(t[up ? 2 : 1]))};
      addPiece(corners);
    }
  }
  return pieceEnds_.size() > before;
}

void RoomVolumes::addMesh(const Mesh& m) {
  const size_t pieces = pieceEnds_.size(), points = points_.size();
  const size_t most = m.bounds().size().y > kContactTolerance ? kMostPieces : kMostFlatPieces;
  if (!addFaces(m, true, most)) addFaces(m, false, most);
  const size_t made = pieceEnds_.size() - pieces;
  if (made > 0 && made <= most) return;
  pieceEnds_.resize(pieces);
  points_.resize(points);
  std::vector<Vec2> plan;
  for (const Vec3& p : m.positions) plan.push_back(planOf(p));
  addHull(std::move(plan));
}

void RoomVolumes::add(const Shape& s, const Frame& world) {
  Volume v;
  v.firstPiece = static_cast<uint32_t>(pieceEnds_.size());
  Mesh mesh;
  if (s.geometry.kind == GeometryKind::Mesh) mesh = transformed(meshInLocal(s), {1, 1, 1}, world);
  if (hasArea(mesh)) {
    v.box = mesh.bounds();
    addMesh(mesh);
  } else {
    const Frame scope = world * s.scope;
    std::vector<Vec2> plan;
    for (unsigned k = 0; k < 8; ++k) {
      const Vec3 p =
          scope.point({k & 1 ? s.size.x : 0, k & 2 ? s.size.y : 0, k & 4 ? s.size.z : 0});
      v.box.include(p);
      plan.push_back(planOf(p));
    }
    addHull(std::move(plan));
  }
  v.endPiece = static_cast<uint32_t>(pieceEnds_.size());
  volumes_.push_back(v);
}

bool RoomVolumes::isSound(uint32_t volume) const {
  const Volume& v = volumes_[volume];
  return v.firstPiece < v.endPiece && isFinite(v.box.min) && isFinite(v.box.max);
}

bool RoomVolumes::collide(Place first, Place second, double clearance, bool byHeight) {
  const Volume& a = first.volumes.volumes_[first.volume];
  const Volume& b = second.volumes.volumes_[second.volume];
  const Interval aHeights{a.box.min.y, a.box.max.y}, bHeights{b.box.min.y, b.box.max.y};
  const double needed = clearance - kContactTolerance;
  const double above =
      byHeight ? std::max({0.0, bHeights.low - aHeights.high, aHeights.low - bHeights.high}) : 0;
  const bool levels = !byHeight || !areApart(aHeights, bHeights);
  if (!levels && above >= needed) return false;
  for (uint32_t i = a.firstPiece; i < a.endPiece; ++i) {
    for (uint32_t j = b.firstPiece; j < b.endPiece; ++j) {
      work();
      const Piece p = first.volumes.piece(i), q = second.volumes.piece(j);
      if (areFar(p, q, needed)) continue;
      work(4);
      const bool over = overlap(p, q);
      if (over && levels) return true;
      if (needed <= 0) continue;
      const double beside = over ? 0 : distance(p, q);
      if (std::sqrt(beside * beside + above * above) < needed) return true;
    }
  }
  return false;
}

}  // namespace gable
