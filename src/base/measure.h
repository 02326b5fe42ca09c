// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers and lengths as people and maps write them
// (https://wiki.openstreetmap.org/wiki/Map_features/Units). They are taken whole or not at all:
// "6 floors", "2-3" and "4;5" are none.
#pragma once

#include <optional>
#include <string_view>

namespace gable {

/// A number without a unit: "3", "-1", "5.5" and, with a comma, "5,5".
std::optional<double> writtenNumber(std::string_view text);

/// A length in metres: a number alone, or with m, cm, km, mi, ft, in or their whole names; feet and
/// inches as 12'6" or 12 ft 6 in.
std::optional<double> writtenMetres(std::string_view text);

}  // namespace gable
