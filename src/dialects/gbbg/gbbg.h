// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The GBBG notation (.gbbg) as one of Gable's dialects; docs/reference/notations/gbbg.md has its
// EBNF.
#pragma once

#include "dialects/dialect.h"

namespace gable::gbbg {

/// What can be written in the notation.
std::span<const DialectWord> words();

}  // namespace gable::gbbg

namespace gable {

extern const Dialect kGbbgDialect;

}  // namespace gable
