// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <optional>

#include "gable/model.h"
#include "gable/picture.h"

namespace gable {

/// Where the sun stands over a model; nothing where the place is on no map and `time` tells none,
/// or where there is no such place or time.
std::optional<PictureSettings::Sun> sunOver(const Model& model, const SunTime& time);

}  // namespace gable
