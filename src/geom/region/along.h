// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Things along a boundary: runs of edges as lines, places at a spacing, parts by parameter,
// ribbons. Plan coordinates, metres.
//
// Promises: places of equal edges are equal; a line and the same line backwards give mirrored
// places; ribbons lie in the region. O(n) but for the booleans of ribbons.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/piece.h"

namespace gable {

struct Polyline {
  std::vector<Vec2> points;
  bool closed = false;
  double length() const;
};

/// A place on a line, with the direction of the line there.
struct Station {
  Vec2 at, along;
};

/// A part of an edge of a polygon (numbered through the rings), by shares of its length.
struct EdgePart {
  uint32_t edge = 0;
  double from = 0, to = 1;
};

/// Runs of edge parts that follow each other, counter-clockwise; a new run begins where `group` (by
/// edge; may be empty) changes. Parts must ascend by edge and place.
std::vector<Polyline> runsOf(const Polygon& p, std::span<const EdgePart> parts,
                             std::span<const uint32_t> group);

/// Places that share a length evenly: `count` intervals, at the inner joints and, where wanted, at
/// the ends. Of a closed line the end is the start.
std::vector<Station> evenly(const Polyline& line, uint32_t count, bool start, bool end);
/// Places exactly `spacing` apart, the rest of the length shared by both ends; one in the middle of
/// a shorter line.
std::vector<Station> spaced(const Polyline& line, double spacing);
/// At a share of the length.
Station stationAt(const Polyline& line, double share);
/// From share a to share b; backwards when a > b.
Polyline partOf(const Polyline& line, double a, double b);

struct LogicalRange {
  uint32_t logical = 0;
  double from = 0, to = 1;
};

/// The lines that ranges of logical edges make: each from share to share along its logical edge,
/// clockwise (or counter-clockwise, for mirrored regions); ranges that meet at a corner are one
/// line. `logical` is by edge of the outer ring. Ranges of logical edges that are not there are
/// left out.
std::vector<Polyline> parametrise(const Ring& outer, std::span<const uint32_t> logical,
                                  std::span<const LogicalRange> ranges, bool clockwise);

/// A line moved to its left, with mitered corners; folds are not resolved.
Polyline movedLeft(const Polyline& line, double by);
/// The same, with folds resolved where the line is closed and simple: what is left of it may be
/// several lines, or none. `by` is not negative.
std::vector<Polyline> insetLines(const Polyline& line, double by);

enum class RibbonEnds : uint8_t { Butt, Square, Round };

struct RibbonOptions {
  /// Else corners are mitered.
  bool roundJoins = false;
  RibbonEnds ends = RibbonEnds::Butt;
};

/// The band of a width around lines, cut to the region.
std::vector<RegionPiece> ribbons(const Polygon& p, std::span<const Polyline> lines, double width,
                                 const RibbonOptions& options = {});

}  // namespace gable
