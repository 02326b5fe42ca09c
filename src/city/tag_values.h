// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What in a map seems to be meant otherwise than it is written: values that are no numbers where
// numbers belong (base/measure.h), and names of tags that are nearly those that a place is made
// from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/importers/map_features.h"

namespace gable {

/// Whether the values of a tag must be numbers.
bool isNumberTag(std::string_view key);

/// The value of a tag as rules are to see it: of a number tag the plain number, in metres where it
/// is a length; nothing where it is none, or none that can be meant. Any other value as it is.
std::optional<std::string> plainTag(std::string_view key, std::string_view value);

struct MapDoubt {
  std::string key;
  /// The name that is likely meant; empty where the values are in doubt.
  std::string meant;
  uint64_t count = 0;
  /// The first of the features, each with its value.
  std::vector<std::pair<std::string, std::string>> first;
};

/// Names in doubt first, both by key. O(tags log keys).
std::vector<MapDoubt> doubtsOf(const std::vector<MapFeature>& features);

}  // namespace gable
