// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What no scene may hold, whatever the rules: coordinates that are not finite, faces without area.
#pragma once

#include <set>
#include <string>

#include "scene/scene.h"

namespace gable {

/// What is unsound in a scene, one line each, ordered; empty when all is well. Leaves of prototypes
/// are looked at once.
std::set<std::string> faults(const Scene& scene);
std::string joined(const std::set<std::string>& lines);

}  // namespace gable
