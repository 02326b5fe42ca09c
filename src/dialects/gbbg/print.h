// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Grammar to text: the canonical form that `gable format` writes. What is printed reads as the same
// grammar, and printing that gives the same bytes. Comments stay; those within a statement come
// before it.
#pragma once

#include <string>

#include "dialects/gbbg/grammar.h"

namespace gable::gbbg {

std::string print(const Grammar& grammar);

/// `Predecessor -> Operator(Parameters) {Successor}`, on one line.
std::string printRule(const Rule& rule);

}  // namespace gable::gbbg
