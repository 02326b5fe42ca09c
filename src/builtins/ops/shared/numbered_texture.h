// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Textures by number: the images below a `textures` folder of the project in the order of their
// paths, counted from 0; in a project without any, the built-in ones.
#pragma once

#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

/// Gives the shape's material the texture of that number (truncated), turned by quarters of a turn,
/// each face of a body showing `2 * scale` of it. A number without an image leaves the material
/// plain. Costs a look-up where the same was asked before.
void wearNumberedTexture(Shape& s, Services& services, double number, double quarters,
                         double scale);

}  // namespace gable
