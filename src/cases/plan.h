// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Leaves seen from above: what lies outside the lot, and which of them stand in each other. Plan
// coordinates in metres: x east, y north.
#pragma once

#include <string>
#include <vector>

#include "cases/measure.h"
#include "geom/region/region.h"

namespace gable::cases {

/// The plan of a mesh: the union of its faces, of which those on edge have none. O(n log n) for
/// each face on the ones before.
Region planOf(const Mesh& mesh);

/// How far a mesh reaches beyond a region, seen from above; 0 where it lies inside. Measured at
/// corners and where edges leave the region. O(edges of the mesh x edges of the region).
double reachBeyond(const Mesh& mesh, const Region& region);

/// The area that the plans of two leaves share where their heights do, in square metres.
double sharedPlan(const PlacedLeaf& a, const PlacedLeaf& b);

}  // namespace gable::cases
