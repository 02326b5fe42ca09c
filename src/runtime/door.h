// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the machine looks at before an operation gets its arguments: numbers that no model can hold
// are refused here, so that no operation has to.
#pragma once

#include <cmath>
#include <span>

#include "base/status.h"
#include "program/spec.h"
#include "program/value.h"

namespace gable {

/// Larger than any place or size of a model: files hold numbers up to 3.4e38, and sizes multiply.
constexpr double kMostNumber = 1e30;

inline bool holds(const Value& v, const ValuePool& pool) {
  if (v.type == ValueType::Float) return std::fabs(v.number) <= kMostNumber;
  if (v.type != ValueType::FloatArray) return true;
  for (const double x : pool.array(v).numbers) {
    if (!(std::fabs(x) <= kMostNumber)) return false;
  }
  return true;
}

inline bool allHold(std::span<const Value> args, const ValuePool& pool) {
  for (const Value& v : args) {
    if (!holds(v, pool)) return false;
  }
  return true;
}

/// A failure that names the parameter, for the first of the arguments that is not finite or beyond
/// kMostNumber. Operations that report take any number.
/// `form` is the signature that was chosen, or null.
Status refusedNumber(const OpSpec& spec, const Signature* form, std::span<const Value> args,
                     const ValuePool& pool);

/// The same for what is set.
Status refusedNumber(const char* name, const Value& v, const ValuePool& pool);

}  // namespace gable
