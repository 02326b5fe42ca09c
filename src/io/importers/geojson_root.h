// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What all readers of GeoJSON ask of a file: a position, and whether its numbers are degrees.
#pragma once

#include <cmath>
#include <string>

#include "base/json.h"
#include "math/vec.h"

namespace gable {

/// Two finite numbers or more; false where it is none.
inline bool positionOf(const JsonValue& v, Vec2& out) {
  if (v.size() < 2 || !v.at(0).isNumber() || !v.at(1).isNumber()) return false;
  out = {v.at(0).number(0), v.at(1).number(0)};
  return std::isfinite(out.x) && std::isfinite(out.y);
}

/// Whether a `crs` member names longitude and latitude; true when there is none.
inline bool namesDegrees(const JsonValue& root) {
  const std::string& name = root["crs"]["properties"]["name"].text();
  return name.empty() || name.ends_with("CRS84") || name.ends_with(":4326") ||
         name.ends_with(":4258") || name.ends_with(":4269");
}

}  // namespace gable
