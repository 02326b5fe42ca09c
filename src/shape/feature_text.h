// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How messages call a feature of a file of shapes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gable {

/// "feature 3 (id way/9) 'Town hall'": `number` counts from 1 in the file; what it has no id or
/// name for is left away.
inline std::string featureText(uint64_t number, std::string_view id, std::string_view name) {
  std::string out = "feature " + std::to_string(number);
  if (!id.empty()) out += " (id " + std::string(id) + ")";
  if (!name.empty() && name != id && name != out) out += " '" + std::string(name) + "'";
  return out;
}

}  // namespace gable
