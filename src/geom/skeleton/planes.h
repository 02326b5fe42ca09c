// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The planes under a straight skeleton. Each polygon edge sweeps a plane through (x, y, time): the
// edge's line moves along its inner normal with the edge's speed. Where three planes meet,
// something happens to the wavefront; this file answers every question about such points exactly.
//
// Coordinates are integers on a grid 2^-51 of the shape's extent; the speed of a plane is an
// integer with 150 bits, a hair (2^-92) off the true one, differently for each plane, so that four
// different planes never meet in one point. Signs come from doubles with an error bound and, where
// those cannot tell, from integers; no answer is ever a guess.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geom/skeleton/wide_int.h"
#include "math/vec.h"

namespace gable::skeleton {

struct GridPoint {
  int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

/// a x + b y + c - s t is zero on the plane and positive where it has not swept yet.
struct Plane {
  int64_t a = 0, b = 0;
  Int128 c = 0;
  WideInt s;
  /// The same, scaled to a unit normal and to the largest speed, for the filters.
  double na = 0, nb = 0, nc = 0, ns = 0;
};

/// num / den, den > 0; in grid units at the largest speed times 2^-kTimeBits.
struct ExactTime {
  WideInt num, den;
};

/// A point in time: a double with its error, and the three planes that meet then.
struct EventTime {
  double value = 0, error = 0;
  uint32_t planes[3] = {0, 0, 0};
};

using PlaneId = uint32_t;

class Planes {
 public:
  /// The plane through an edge; `weight` is the speed relative to the largest, in [0, 1]. Zero is
  /// taken as 2^-63, which moves nothing by as much as a grid step.
  PlaneId add(GridPoint from, GridPoint to, double weight);
  /// A horizontal plane at a time given in grid units; of use for cutting the roof off.
  PlaneId addLevel(double time);
  size_t size() const { return planes_.size(); }
  const Plane& operator[](PlaneId p) const { return planes_[p]; }

  /// The sign of the turn from the direction of edge p to that of q: 1 left, 0 parallel, -1 right.
  int turn(PlaneId p, PlaneId q) const;
  bool sameDirection(PlaneId p, PlaneId q) const;
  /// Positive where the speed of p (along its normal) exceeds that of q.
  int compareSpeed(PlaneId p, PlaneId q) const;

  /// When the three lines meet in a point; nothing where they never or always do.
  std::optional<EventTime> meeting(PlaneId p, PlaneId q, PlaneId r) const;
  /// The sign of det(a b s): of use to tell approach from retreat.
  int speedSign(PlaneId p, PlaneId q, PlaneId r) const;
  ExactTime exact(const EventTime& t) const;
  int compareTimes(const EventTime& a, const EventTime& b) const;

  /// The sign of plane l at the meeting point of p, q and r: 1 where l has not swept yet.
  /// Zero too where the three have no single meeting point.
  int side(PlaneId p, PlaneId q, PlaneId r, PlaneId l) const;

  /// The meeting point in grid units, correctly rounded within a few units in the last place.
  struct Point {
    double x = 0, y = 0, time = 0;
  };
  Point point(PlaneId p, PlaneId q, PlaneId r) const;

  static constexpr int kTimeBits = 103;

 private:
  Int128 minor(PlaneId p, PlaneId q) const {
    return static_cast<Int128>(planes_[p].a) * planes_[q].b -
           static_cast<Int128>(planes_[q].a) * planes_[p].b;
  }
  double minorOf(PlaneId p, PlaneId q) const {
    return planes_[p].na * planes_[q].nb - planes_[q].na * planes_[p].nb;
  }
  /// s_p c_q - s_q c_p.
  WideInt lift(PlaneId p, PlaneId q) const {
    return planes_[p].s * WideInt(planes_[q].c) - planes_[q].s * WideInt(planes_[p].c);
  }
  WideInt detOffsets(PlaneId p, PlaneId q, PlaneId r) const;
  WideInt detSpeeds(PlaneId p, PlaneId q, PlaneId r) const;
  WideInt detFour(PlaneId p, PlaneId q, PlaneId r, PlaneId l) const;

  std::vector<Plane> planes_;
};

}  // namespace gable::skeleton
