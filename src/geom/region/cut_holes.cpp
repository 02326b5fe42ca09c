// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A line through a hole's middle may miss a hole that is bent around it; the next try then goes
// through one of its vertices, which no hole escapes.
#include "geom/region/cut_holes.h"

#include "base/work.h"
#include "geom/region/line.h"
#include "geom/region/places.h"

namespace gable {
namespace {

// The middle of the longest edge.
Vec2 middleOfLongest(const Ring& r) {
  size_t best = 0;
  double most = -1;
  for (size_t i = 0; i < r.size(); ++i) {
    const double l = length(r[(i + 1) % r.size()] - r[i]);
    if (l > most) {
      most = l;
      best = i;
    }
  }
  return (r[best] + r[(best + 1) % r.size()]) * 0.5;
}

Vec2 middleOfHole(const Ring& hole, bool byVertices) {
  if (!byVertices) return centroid({{hole.rbegin(), hole.rend()}, {}});
  return (hole[0] + hole[hole.size() / 2]) * 0.5;
}

std::vector<RegionPiece> cutAt(const RegionPiece& whole, Vec2 at, Vec2 along) {
  std::vector<RegionPiece> out;
  for (StripPiece& s : splitByLine(whole.polygon, at, along)) {
    RegionPiece part = whole;
    part.edges.clear();
    for (const uint32_t e : s.edgeOrigin) {
      part.edges.push_back(e < StripPiece::kOnLine
                               ? whole.edges[e]
                               : EdgeOrigin{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
    }
    part.polygon = std::move(s.polygon);
    out.push_back(std::move(part));
  }
  return out;
}

}  // namespace

std::vector<RegionPiece> withoutHoles(const Polygon& p) {
  std::vector<RegionPiece> open{wholePiece(p)}, done;
  // A cut takes one hole at least from its piece.
  while (!open.empty()) {
    work(8);
    RegionPiece piece = std::move(open.back());
    open.pop_back();
    if (piece.polygon.holes.empty()) {
      piece.part = piece.ix = static_cast<uint32_t>(done.size());
      done.push_back(std::move(piece));
      continue;
    }
    const Ring hole = piece.polygon.holes[0];
    const size_t before = piece.polygon.holes.size();
    bool cut = false;
    for (int tries = 0; tries < 3 && !cut; ++tries) {
      const Vec2 at = tries < 2 ? middleOfHole(hole, tries == 1) : hole[0];
      Vec2 along = middleOfLongest(piece.polygon.outer) - at;
      if (tries == 2) along = perpendicular(hole[1] - hole[0]);
      if (!(length(along) > 0)) continue;
      std::vector<RegionPiece> parts = cutAt(piece, at, along);
      size_t left = 0;
      for (const RegionPiece& q : parts) left += q.polygon.holes.size();
      cut = left < before;
      if (cut) open.insert(open.end(), parts.rbegin(), parts.rend());
    }
    if (!cut) {
      // What no cut takes apart is degenerate; it stays as it is.
      piece.part = piece.ix = static_cast<uint32_t>(done.size());
      done.push_back(std::move(piece));
    }
  }
  return done;
}

}  // namespace gable
