// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Trim planes: what a component split leaves at the edges of a face, to cut what is put there.
#pragma once

#include "shape/part.h"

namespace gable {

/// Cuts the geometry by the shape's trim planes that are switched on (trim.vertical,
/// trim.horizontal) and closes what was closed. The scope stays. A primitive that no plane meets
/// stays one, and nothing is allocated. True when something was cut off.
bool trimGeometry(Shape& s);

/// False when a box that fills the part's scope is clear of the trim planes.
bool reachesTrimPlane(const LightPart& part);

}  // namespace gable
