// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Curves as lines of points, and places along them by length. Plan coordinates, metres.
//
// Promises
//  1. A curve goes exactly through its given points (Bezier: through the ends of its pieces), in
//     their order, and its line stays within `tolerance` of it.
//  2. Equal neighbours among the given points count once; points that are not finite are left out.
//  3. Work and size are bounded: at most kMostPieces points between two given ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/vec.h"

namespace gable {

using Line = std::vector<Vec2>;

constexpr uint32_t kMostPieces = 1024;

/// Centripetal Catmull-Rom: no loops and no overshoot between close points. A closed curve does not
/// repeat its first point.
Line catmullRom(std::span<const Vec2> points, bool closed, double tolerance);

/// Cubic pieces one after the other: 3 n + 1 points, of which every third lies on the curve; what
/// is left over at the end is not used.
Line bezier(std::span<const Vec2> controls, double tolerance);

/// From one angle (degrees, counter-clockwise from x) to another; a full turn repeats its first
/// point.
Line arc(Vec2 center, double radius, double fromDegrees, double toDegrees, double tolerance);

/// The line without points that lie within `tolerance` of the line without them; the ends stay.
/// O(n^2) at worst, O(n log n) mostly.
Line simplified(const Line& line, double tolerance);

/// Lengths along a line.
class Path {
 public:
  /// The line without repeated points. A closed one goes on from its last point to its first.
  explicit Path(std::span<const Vec2> line, bool closed = false);

  double length() const { return lengths_.empty() ? 0 : lengths_.back(); }
  bool closed() const { return closed_; }
  const Line& points() const { return points_; }

  struct Place {
    Vec2 point;
    /// A unit vector: that of the segment; where two meet, their mean.
    Vec2 tangent{1, 0};
  };
  /// `s` metres from the beginning: clamped to the line, wrapped around a closed one. O(log n).
  Place at(double s) const;
  /// The length at which the line is nearest to a point; of equals the first. O(n).
  double nearest(Vec2 p) const;

 private:
  Line points_;
  /// At each point, and at the end of a closed line.
  std::vector<double> lengths_;
  bool closed_;
};

/// How things stand along a length.
struct Spacing {
  double step = 1;
  /// Kept free at both ends.
  double startInset = 0, endInset = 0;
  /// The step becomes a little longer or shorter so that both ends are met; else what is left over
  /// is shared between the ends when `centred`, or stays at the end.
  bool stretch = false, centred = true;
};

/// Ascending; empty where nothing fits. At most 100 000.
std::vector<double> stations(double length, const Spacing& spacing);

}  // namespace gable
