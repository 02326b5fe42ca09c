// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What was made of a map, as JSON. The form is a promise to scripts: docs/guide/city.md.
#pragma once

#include <string>
#include <vector>

#include "gable/city.h"
#include "gable/tiles.h"
#include "json/answers.h"

namespace gable {

/// Areas by surface, counts of shapes, what was left out, and figures as one object.
/// Those of tiles, too, where there are, and what the rules of a model reported.
std::string cityJson(const CityStatistics& statistics, const RunFigures& figures = {},
                     const TileResult* tiles = nullptr,
                     const std::vector<ReportSummary>* reports = nullptr);

}  // namespace gable
