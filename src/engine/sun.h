// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include "base/result.h"
#include "gable/picture.h"
#include "scene/scene.h"

namespace gable {

/// Where the sun stands at a time, over the place that it names or else over `origin`. Code:
/// picture-settings.
Result<PictureSettings::Sun> sunAt(const SunTime& time, const GeoOrigin& origin);

}  // namespace gable
