// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "base/result.h"
#include "lang/sema/analyse.h"

namespace gable {

/// What to say of a text with mistakes as CGA, many of them if it is called so, when it reads
/// as one of the others: without mistakes, or with far fewer. Code: rules-notation.
std::optional<Error> asOtherNotation(const std::string& path, const Sources& sources, uint32_t file,
                                     lang::FileLoader& loader, const Diagnostics& asCga);

}  // namespace gable
