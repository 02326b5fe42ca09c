// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Settings under which any grammar ends soon, on one thread.
#pragma once

#include <cstdint>

#include "gable/gable.h"

inline gable::DeriveSettings smallSettings(uint64_t shapes, uint64_t vertices) {
  gable::DeriveSettings settings;
  settings.jobs = 1;
  settings.limits.depth = 64;
  settings.limits.width = 1000;
  settings.limits.shapes = shapes;
  settings.limits.vertices = vertices;
  return settings;
}
