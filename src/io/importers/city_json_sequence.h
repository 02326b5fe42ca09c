// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// City models of a feature a line (https://www.cityjson.org/cityjsonseq).
#pragma once

#include <string>
#include <string_view>

#include "base/json.h"
#include "base/result.h"

namespace gable {

/// Whether a file is one by its name: .city.jsonl.
bool isCityJsonSequence(std::string_view path);

/// The JSON of a file of GeoJSON or CityJSON, which has a type. A sequence becomes one city model,
/// without the pictures and materials of its features, which nothing here reads. Linear in the
/// text. Codes: shapes-broken, json-limit.
Result<JsonValue> parseGeometries(std::string_view text, const std::string& path);

}  // namespace gable
