// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From a park grammar to the neutral tree: every operation becomes one of Gable's own on regions.
#pragma once

#include "dialects/park/grammar.h"
#include "lang/tree.h"

namespace gable::park {

/// `source` is the text of the grammar, for the places of what is wrong.
lang::Tree lower(const Grammar& grammar, uint32_t file, std::string_view source,
                 Diagnostics& diagnostics);

}  // namespace gable::park
