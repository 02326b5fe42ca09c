// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A scene as text, for golden files and for a look: leaf by leaf in the order of derivation,
// instances expanded, in world coordinates (metres), numbers rounded to 0.0001. Two scenes that
// flatten to the same model have the same dump, however their prototypes are cut. Linear in the
// flattened model.
//
//   Wall at 0 0 0 size 4 10 0 color #ff8000
//     0 0 0  4 0 0  4 10 0  0 10 0 | 1 1 0  1 2 0  2 2 0  2 1 0
//
// A turned leaf also has `turn` with its angles in degrees; colours are left out where they are
// white, and `map` names a colour texture. Each line below is a face, rings after | are its holes.
#pragma once

#include <string>

#include "scene/scene.h"

namespace gable {

std::string dumpText(const Scene& scene);

/// A number as the dump writes it: rounded to 0.0001, without trailing zeros and never -0.
std::string roundedText(double v);

}  // namespace gable
