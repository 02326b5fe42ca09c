// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gable's public interface: rules and footprints in, places out.
//
//   gable::Rules rules = gable::Rules::load("town.cga");
//   gable::Shapes lots = gable::Shapes::load("lots.geojson");
//   gable::Model town = gable::derive(rules, lots);
//   town.write("town.glb");
//
// Nothing here throws, prints or exits. Everything that went wrong comes back as diagnostics beside
// the result; a result with errors is empty but safe to use. Memory that runs out is a diagnostic
// too, out-of-memory. Lengths are metres, angles degrees, the frame is right-handed with y up (+x
// east, -z north). Texts and paths are UTF-8.
//
// Rules, Shapes and Model never change once they are made, and are cheap to copy: copies share.
// Any thread may use them at any time.
#pragma once

#include "gable/builtins.h"
#include "gable/derive.h"
#include "gable/diagnostic.h"
#include "gable/limits.h"
#include "gable/model.h"
#include "gable/picture.h"
#include "gable/rules.h"
#include "gable/shapes.h"
#include "gable/trace.h"
#include "gable/value.h"

namespace gable {

/// Of the library, such as "0.1.0".
const char* version();

}  // namespace gable
