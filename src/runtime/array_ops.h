// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The operators of expressions on values of any type: arithmetic, comparison, element-wise forms,
// indexing, array building. Each gives its result, or an error text for a diagnostic.
#pragma once

#include <span>
#include <string>

#include "program/program.h"
#include "program/value.h"

namespace gable {

struct ValueOrError {
  Value value;
  /// Null when all is well; a sentence otherwise.
  const char* error = nullptr;
  /// The code of that diagnostic.
  const char* code = "wrong-type";
};

ValueOrError applyBinary(BinaryOperator op, const Value& a, const Value& b, ValuePool& pool);
ValueOrError negateValue(const Value& v, ValuePool& pool);
/// a[i] and a[i, j]; indices are numbers, bool or float arrays. Out of range gives a default.
ValueOrError indexArray(const Value& array, std::span<const Value> indices, ValuePool& pool);
/// Items row by row, `counts` of them in each; items may be arrays themselves.
ValueOrError buildArray(std::span<const Value> items, std::span<const uint32_t> counts,
                        ValuePool& pool);
/// [start : step : end]; no element when the step leads away. At most `limit` elements.
ValueOrError buildRange(double start, double step, double end, size_t limit, ValuePool& pool);
/// < 0, 0, > 0; by rows, then by columns, then by rows' number.
int orderOfValues(const Value& a, const Value& b, const ValuePool& pool);

}  // namespace gable
