// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Roofs over a polygon with holes: closed solids of planar faces on the plane of the polygon.
//
// Coordinates are the polygon's plan coordinates and a height above it; metres and degrees. Every
// result has the slopes (in the order of the edges they rise from), then upright sides, then the
// bottom. Slopes look up (counter-clockwise in plan), the bottom looks down. `ring` and `edge` name
// the polygon's edge a face belongs to: ring 0 is the outer one, edge k runs from point k to k + 1.
// What cannot be done leaves no faces and a status: those of skeleton.h, "roof-pitch" for an angle
// outside (0, 90) or a height that is not positive. Sides without height are left out.
//
// Rings may be turned either way round. Complexity is that of skeleton.h for hip and gable roofs,
// O(n log n) for the others.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/status.h"
#include "geom/region/region.h"
#include "geom/skeleton/skeleton.h"

namespace gable {

enum class RoofRole : uint8_t { Slope, SideOuter, SideInner, Bottom };

/// Eaves are the level borders at the foot of a slope. Inside edges: a valley where its two faces
/// form a hollow, else a hip where it starts at an eave, else a ridge. Everything else is a border.
enum class RoofEdgeRole : uint8_t { Border, Eave, Hip, Valley, Ridge };

struct RoofLoop {
  std::vector<uint32_t> vertices;
  /// Edge i runs from vertex i to vertex i + 1.
  std::vector<RoofEdgeRole> edges;
};

struct RoofFace {
  RoofRole role = RoofRole::Slope;
  uint32_t ring = 0, edge = 0;
  /// The outer loop first, then holes.
  std::vector<RoofLoop> loops;
};

struct Roof {
  Status status;
  std::vector<SkeletonVertex> vertices;
  std::vector<RoofFace> faces;
};

/// How steep a roof is: all slopes at one angle, or such that its top is at a height.
struct RoofPitch {
  enum class By : uint8_t { Angle, Height } by = By::Angle;
  double value = 0;
};

/// A slope at every edge. Eaves reach out by `overhang`, measured down the slopes; the bottom
/// stays. Below zero the slopes keep their planes and end as far above the edges; a slope that is
/// shorter is left out. `even` sets each connected group of ridges to its mean height, and faces
/// may bend.
Roof hipRoof(const Polygon& polygon, RoofPitch pitch, double overhang = 0, bool even = false);

/// The same with an angle per ring and edge, in (0, 90]; at 90 the wall goes up as an upright side.
Roof hipRoof(const Polygon& polygon, std::span<const std::vector<double>> angles,
             double overhang = 0);

struct GableOptions {
  /// Of the eaves, down the slope; below zero as for hip roofs.
  double overhangX = 0;
  /// Of the gable ends, along the ridges; below zero the slopes end before the upright face.
  double overhangY = 0;
  bool even = false;
  /// The outer edge that the ridge shall be parallel to, modulo their number; for convex polygons.
  std::optional<int64_t> ridgeEdge;
};

/// A hip roof whose triangular ends are upright. Of two such ends side by side the shorter edge is
/// taken, and where edges are equally long the ends lie so that the ridge runs along edge 0.
Roof gableRoof(const Polygon& polygon, RoofPitch pitch, const GableOptions& options = {});

/// One slope that rises from the outer edge `edge` (modulo their number). Where the polygon reaches
/// behind that edge the slope is lifted, so that nothing lies below the bottom.
Roof shedRoof(const Polygon& polygon, RoofPitch pitch, int64_t edge = 0);

/// Every edge joined to a point above the mean of all vertices. By angle: of the first edge's face.
Roof pyramidRoof(const Polygon& polygon, RoofPitch pitch);

/// Two slopes that fall from one ridge above the middle of the polygon, parallel to `direction`;
/// they reach the bottom at the polygon's farthest points on either side.
Roof ridgeRoof(const Polygon& polygon, RoofPitch pitch, Vec2 direction);

}  // namespace gable
