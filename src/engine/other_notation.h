// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/result.h"
#include "lang/sema/analyse.h"

namespace gable {

struct Dialect;

/// What to say of a text with mistakes as the notation `read`, null for CGA, when it reads as
/// another one with far fewer. A text whose name says its notation is believed for longer: *.cga
/// where its mistakes are few, a grammar unless it is another notation without a mistake. `found`:
/// what was found as `read`. Code: rules-notation.
std::optional<Error> asOtherNotation(const std::string& path, const Dialect* read,
                                     const Sources& sources, uint32_t file,
                                     lang::FileLoader& loader, const Diagnostics& found);

}  // namespace gable
