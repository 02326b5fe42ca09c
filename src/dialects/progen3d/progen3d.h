// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// ProGen3d grammars (.grammar, .pg3d) as a dialect; see
// docs/reference/notations/progen3d.md.
#pragma once

#include "dialects/dialect.h"

namespace gable::progen3d {

/// What can be written in the notation.
std::span<const DialectWord> words();

}  // namespace gable::progen3d

namespace gable {

extern const Dialect kProgen3d;

}  // namespace gable
