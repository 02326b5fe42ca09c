// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What was written as tiles, as JSON. The form is a promise to scripts: docs/guide/tiles.md.
#pragma once

#include <string>

#include "base/json.h"
#include "gable/tiles.h"
#include "json/answers.h"

namespace gable {

/// Counts of tiles, triangles and bytes, and figures as one object.
std::string tilesJson(const TileResult& result, const RunFigures& figures);

/// The counts as members of an object.
void writeTileCounts(JsonWriter& w, const TileResult& result);

}  // namespace gable
