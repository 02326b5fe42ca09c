// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Volumes of one cross-section along lines in a region: hedges, kerbs, walls. Plan coordinates and,
// as third coordinate, the height above the plane; metres.
//
// Promises:
//   1. The volume is closed and stands on the plane; its plan is the ribbon of the line, cut to the
//      region.
//   2. Where the ribbon lies in the region and does not fold it is one shell with mitered corners;
//      elsewhere several shells that stand side by side.
//      Beyond two million parts times edges these have a plain cross-section.
//   3. x = 0 of the cross-section is the side that is nearer to the region's boundary.
// O(points of line and cross-section), and the booleans where something is cut.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "geom/mesh/mesh.h"
#include "geom/region/along.h"

namespace gable {

/// From the one side (x = 0) to the other (x = 1) in shares of the width, y in shares of the
/// height. x never falls, no y is below zero.
using Profile = std::vector<Vec2>;

/// box, batter (narrower above), gable, round, dome (round only at its top) or kerb (bevelled on
/// one side).
std::optional<Profile> profileNamed(std::string_view name);

/// Whether points can be a cross-section: two or more, x from 0 to 1 and never falling, y not
/// negative and somewhere above zero.
bool isProfile(const Profile& p);

/// Empty where nothing of the ribbon lies in the region.
Mesh sweptProfile(const Polygon& region, const Polyline& line, double width, double height,
                  const Profile& profile, RibbonEnds ends);

}  // namespace gable
