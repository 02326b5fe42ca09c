// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Audit: whether an operation or a function looks at more of its shape than its specification
// declares. What it asks its services for is seen as it asks; fields of the shape are not. So
// builds with checks run a call now and then a second time, on a shape that differs in all that is
// not declared, and stop when the result differs. Sharing would then take unlike shapes for alike.
#pragma once

#include <cstddef>

#include "shape/op_call.h"

namespace gable {

/// What an operation did, as far as the audit compares it.
struct OpOutcome {
  const Status& status;
  const Shape& shape;
  bool dropped = false;
  std::span<const BlockChild> children;
  std::span<const SplitPiece> pieces;
};

/// Runs the operation again on `before`, changed in what is not declared, and stops the program
/// unless the outcome is the same. Warnings and leaves of the second run are lost. `evaluations`
/// are those of the first run.
void auditFields(const OpSpec& spec, const Shape& before, std::span<const Value> args,
                 Services& services, const CallPlace& place, const BlockInput* block,
                 const OpOutcome& outcome, Evaluations& evaluations);

/// The shape with other values in all fields that the effects do not allow to be looked at.
Shape changedFields(const Shape& s, uint32_t effects);

/// The same for a function or a getter: `again` is the call on a changed shape, `first` what the
/// first run gave.
void auditFunction(const char* name, Value (*function)(FunctionCall&), FunctionCall& again,
                   const Value& first, Evaluations& evaluations);

}  // namespace gable
