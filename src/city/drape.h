// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lays what rules have made of a flat place on its terrain: faces are cut where the ground bends
// and raised with it, so that what lies on the ground touches it everywhere but for 3 mm; what
// stands, taller than it is wide, is raised whole: prototypes such as trees, lamps and parked cars,
// else leaves. World coordinates: y up, the plan's y is -z.
//
// Promises: areas in plan of what lies stay; points of it that coincide before do so after; a thing
// that is moved whole is moved by a rigid motion; equal input gives equal output.
#pragma once

#include <functional>
#include <string>

#include "city/terrain_surface.h"
#include "scene/scene.h"

namespace gable {

/// `lies` says by the name of an initial shape whether it lies on the ground; the others stay where
/// they are. O(n log n) for n pieces that the ground's bends cut the faces into.
Scene draped(const Scene& scene, const TerrainSurface& ground,
             const std::function<bool(const std::string&)>& lies);

}  // namespace gable
