// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the result of each rule depends on, with all that it calls, and which rules are shared.
#pragma once

#include <vector>

#include "lang/compile/unit_compiler.h"

namespace gable::lang {

/// Fills `reads` and `shared` of the program's rules. A rule is shared when it makes several shapes
/// and its result depends on nothing but what a sharing key holds: no chance, no place in the
/// world, no other shapes. O(calls x depth of the call graph).
void closeDependence(Program& program, const std::vector<Uses>& rules,
                     const std::vector<Uses>& functions, const std::vector<Uses>& initialisers);

}  // namespace gable::lang
