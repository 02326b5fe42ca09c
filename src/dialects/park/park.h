// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The park notation: regions of a park divided by grids, cells and rays, as its author wrote it
// down; see docs/reference/notations/park.md for the grammar and what is carried over.
#pragma once

#include "dialects/dialect.h"

namespace gable::park {

/// What can be written in the notation.
std::span<const DialectWord> words();

}  // namespace gable::park

namespace gable {

extern const Dialect kParkDialect;

}  // namespace gable
