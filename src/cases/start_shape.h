// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The `shape` section of a case.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cases/case_file.h"
#include "gable/limits.h"
#include "gable/shapes.h"

namespace gable::cases {

/// The initial shape of a case. Files are looked for in `folder`, where the `file` sections lie.
/// Absent where the text is not understood.
std::optional<Shapes> startShape(const Case& c, const std::string& folder,
                                 const FileLimits& limits);

}  // namespace gable::cases
