// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How settings of pictures, the sun's among them, are checked.
#pragma once

#include <string>

#include "base/result.h"
#include "gable/picture.h"

namespace gable {

/// False also for what is no number.
inline bool isWithin(double v, double least, double most) { return v >= least && v <= most; }

inline Error wrongSetting(const std::string& what, const std::string& remedy) {
  return {"picture-settings", what, remedy};
}

}  // namespace gable
