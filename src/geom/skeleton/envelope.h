// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Building envelopes: walls over the edges of a polygon, planes that lean inwards from the top of
// each wall, and a level top where all of it is cut off.
//
// Coordinates are the polygon's plan coordinates and a height above it; metres and degrees. The
// result is closed and has, in this order, for each edge its wall and its slope, the tops, and the
// bottom. `ring` and `edge` name the polygon's edge: ring 0 is the outer one, edge k runs from
// point k to k + 1. Where walls are upright over their base (90 degrees) they are one face.
// Vertices lie only where an edge bends.
//
// Rings may be turned either way round. What cannot be done leaves no faces and a status: those of
// skeleton.h, "envelope-sides" for numbers that make no envelope. Complexity is that of skeleton.h
// for each height at which a wall ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/status.h"
#include "geom/region/region.h"

namespace gable {

struct EnvelopeSide {
  /// The height of the wall, at least 0.
  double baseHeight = 0;
  /// Of the plane above it against the ground, over 0 and at most 90.
  double angle = 90;
};

enum class EnvelopeRole : uint8_t { Base, Slope, Top, Bottom };

struct EnvelopeFace {
  EnvelopeRole role = EnvelopeRole::Base;
  uint32_t ring = 0, edge = 0;
  /// The outer loop first, then holes.
  std::vector<std::vector<uint32_t>> loops;
};

struct Envelope {
  Status status;
  /// x and y are those of the plan, z is the height.
  std::vector<Vec3> vertices;
  std::vector<EnvelopeFace> faces;
};

/// `sides` per ring and edge; missing ones have their defaults. `floor` gives the height of each
/// point, none above 0, where the ground is not level; walls reach down to it.
Envelope buildEnvelope(const Polygon& polygon, std::span<const std::vector<EnvelopeSide>> sides,
                       double maxHeight, std::span<const std::vector<double>> floor = {});

}  // namespace gable
