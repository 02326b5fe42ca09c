// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where a place lies on the Earth, as 3D Tiles want it: from metres east, north and up to metres in
// the frame that turns with the Earth (EPSG:4978, WGS 84).
#pragma once

#include <vector>

#include "shape/geo_frame.h"

namespace gable {

/// Sixteen numbers, column by column; empty where degrees are not known. The ground lies on the
/// ellipsoid. East is where the frame has it, which may be turned against the parallel by the
/// convergence of a map projection.
std::vector<double> placementOf(const GeoFrame* frame);

}  // namespace gable
