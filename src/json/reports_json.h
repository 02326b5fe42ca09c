// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <vector>

#include "base/json.h"
#include "json/answers.h"

namespace gable {

/// What rules reported, as the member "reports" of an object: by key `n`, and of numbers `sum`,
/// `avg`, `min` and `max`, of texts how often each was reported.
void writeReports(JsonWriter& json, const std::vector<ReportSummary>& reports);

}  // namespace gable
