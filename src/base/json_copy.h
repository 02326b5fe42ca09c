// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include "base/json.h"

namespace gable {

/// Writes a value that was read.
void copy(JsonWriter& to, const JsonValue& value);

}  // namespace gable
