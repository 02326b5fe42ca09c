// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The country that a place lies in, to choose how houses look there: what most addresses of the
// map say, else a coarse table of boxes. Near borders the table may name the neighbour.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/importers/map_features.h"

namespace gable {

/// Two capitals by ISO 3166-1, such as "MC"; empty where nothing is known.
std::string countryOf(const MapFeatures& map);

/// Whether two capitals are a country's code in ISO 3166-1. "UK" is none: it is "GB".
bool isCountryCode(std::string_view code);

/// By the table alone; degrees.
std::string countryAt(double longitude, double latitude);

}  // namespace gable
