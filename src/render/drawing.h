// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Drawings of a scene in lines: ink on paper and blueprints. There is no light to gather, so they
// are ready in the time of a few samples a pixel.
#pragma once

#include "render/stage.h"

namespace gable::rt {

/// Fills the image, ready for the tone curve; false when progress ended it. `look`: Ink or
/// Blueprint.
bool drawLines(const Stage& stage, const Scene& scene, const Camera& camera,
               const RenderOptions& options, LinearImage& image);

}  // namespace gable::rt
