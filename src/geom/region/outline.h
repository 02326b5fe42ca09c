// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Outlines made from outlines: bands around them, and edges that wander as natural ones do. Plan
// coordinates, metres.
#pragma once

#include <cstdint>

#include "geom/region/boolean.h"

namespace gable {

/// What lies between the outline moved outward by `from` and by `to` (inward where negative), in
/// either order: rings around the region, empty where they vanish. Holes are closed by distances
/// larger than they are.
Region bandAround(const Region& r, double from, double to, OffsetJoin join);

/// The outline moved to and fro, by at most `amount`, changing over a distance of about
/// `wavelength`; points are added where edges are longer than a sixth of it. What then crosses
/// itself is mended. Equal input and address give equal output.
Region roughened(const Polygon& p, double amount, double wavelength, uint64_t address);

/// A convex ring drawn wider until no edge is shorter than `shortest`: the shortest goes first, and
/// its neighbours are drawn on until they meet. Edges stay where that would be further away than
/// `shortest`, and of the last three. O(n^2).
Ring withoutShortEdges(Ring convex, double shortest);

/// As many points as `roughened` would make, before mending: check it before the call.
double roughenedSize(const Polygon& p, double wavelength);

}  // namespace gable
