// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the answers of a RoomPlan depend on, so that the next derivation need not find out anew who
// asks for room where an edit changes nothing of that.
#pragma once

#include <optional>
#include <vector>

#include "program/reach.h"
#include "runtime/derive.h"
#include "runtime/key_numbers.h"

namespace gable {

/// Of the pass before that collects claims: its rules, the attributes that they read, the initial
/// shapes, the limits on counts. None where it cannot be told. Only derivations in the same
/// environment can be compared. `reaches`: of the program.
std::optional<ShareKey> roomKey(const Program& program, const Reaches& reaches,
                                const std::vector<InitialShape>& shapes,
                                const DeriveOptions& options);

}  // namespace gable
