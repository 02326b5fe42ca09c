// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/array_ops.h"

#include <algorithm>
#include <cmath>

namespace gable {

namespace {

bool isText(const Value& v) { return v.type == ValueType::String || v.type == ValueType::Selector; }

double arithmetic(BinaryOperator op, double a, double b) {
  switch (op) {
    case BinaryOperator::Add: return a + b;
    case BinaryOperator::Subtract: return a - b;
    case BinaryOperator::Multiply: return a * b;
    case BinaryOperator::Divide: return a / b;
    default: return std::fmod(a, b);
  }
}

bool compares(BinaryOperator op, int order) {
  switch (op) {
    case BinaryOperator::Equal: return order == 0;
    case BinaryOperator::NotEqual: return order != 0;
    case BinaryOperator::Less: return order < 0;
    case BinaryOperator::LessEqual: return order <= 0;
    case BinaryOperator::Greater: return order > 0;
    default: return order >= 0;
  }
}

// Comparison of numbers keeps the rules of NaN: only != holds.
bool comparesNumbers(BinaryOperator op, double a, double b) {
  switch (op) {
    case BinaryOperator::Equal: return a == b;
    case BinaryOperator::NotEqual: return a != b;
    case BinaryOperator::Less: return a < b;
    case BinaryOperator::LessEqual: return a <= b;
    case BinaryOperator::Greater: return a > b;
    default: return a >= b;
  }
}

int order(double a, double b) { return a < b ? -1 : a > b ? 1 : 0; }

Value element(const Array& a, size_t i, ValuePool&) {
  if (a.element == ValueType::String) return Value::string(a.strings[i]);
  if (a.element == ValueType::Bool) return Value::of(a.numbers[i] != 0);
  return Value::of(a.numbers[i]);
}

void appendElement(Array& to, const Value& v) {
  if (to.element == ValueType::String)
    to.strings.push_back(v.id);
  else
    to.numbers.push_back(v.number);
}

Value defaultOf(ValueType element) {
  if (element == ValueType::String) return Value::string(0);
  return element == ValueType::Bool ? Value::of(false) : Value::of(0.0);
}

constexpr BinaryOperator plain(BinaryOperator each) {
  return static_cast<BinaryOperator>(static_cast<int>(each) -
                                     static_cast<int>(BinaryOperator::EachAdd));
}

ValueOrError applyScalar(BinaryOperator op, const Value& a, const Value& b, ValuePool& pool) {
  if (op == BinaryOperator::EachAnd) return {Value::of(a.truth() && b.truth())};
  if (op == BinaryOperator::EachOr) return {Value::of(a.truth() || b.truth())};
  return applyBinary(plain(op), a, b, pool);
}

ValueOrError applyEach(BinaryOperator op, const Value& a, const Value& b, ValuePool& pool) {
  if (!a.isArray() && !b.isArray()) return applyScalar(op, a, b, pool);
  const Array& shape = pool.array(a.isArray() ? a : b);
  if (a.isArray() && b.isArray()) {
    const Array& other = pool.array(b);
    if (shape.rows != other.rows || shape.columns != other.columns) {
      return {Value{}, "the arrays differ in their numbers of rows or columns"};
    }
  }
  Array out;
  out.rows = shape.rows;
  out.columns = shape.columns;
  for (size_t i = 0; i < shape.size(); ++i) {
    const Value x = a.isArray() ? element(pool.array(a), i, pool) : a;
    const Value y = b.isArray() ? element(pool.array(b), i, pool) : b;
    const ValueOrError r = applyScalar(op, x, y, pool);
    if (r.error) return r;
    if (i == 0) out.element = r.value.type;
    appendElement(out, r.value);
  }
  if (shape.size() == 0) out.element = shape.element;
  return {pool.intern(std::move(out))};
}

// The positions that an index value names: numbers as they are, bools where they are true.
std::vector<double> positions(const Value& index, const ValuePool& pool) {
  if (!index.isArray()) return {index.number};
  const Array& a = pool.array(index);
  if (a.element != ValueType::Bool) return a.numbers;
  std::vector<double> out;
  for (size_t i = 0; i < a.numbers.size(); ++i) {
    if (a.numbers[i] != 0) out.push_back(static_cast<double>(i));
  }
  return out;
}

Value at(const Array& a, double position, size_t count, ValuePool& pool) {
  if (!(position >= 0) || position >= static_cast<double>(count)) return defaultOf(a.element);
  return element(a, static_cast<size_t>(position), pool);
}

Value atRowColumn(const Array& a, double row, double column, ValuePool& pool) {
  if (!(row >= 0) || row >= a.rows || !(column >= 0) || column >= a.columns) {
    return defaultOf(a.element);
  }
  const size_t i = static_cast<size_t>(row) * a.columns + static_cast<size_t>(column);
  return element(a, i, pool);
}

}  // namespace

int orderOfValues(const Value& a, const Value& b, const ValuePool& pool) {
  if (isText(a) && isText(b)) {
    const int c = pool.text(a.id).compare(pool.text(b.id));
    return c < 0 ? -1 : c > 0 ? 1 : 0;
  }
  if (!a.isArray() || !b.isArray()) return order(a.number, b.number);
  if (a.id == b.id && a.type == b.type) return 0;
  const Array& x = pool.array(a);
  const Array& y = pool.array(b);
  for (uint32_t r = 0; r < std::min(x.rows, y.rows); ++r) {
    for (uint32_t c = 0; c < std::min(x.columns, y.columns); ++c) {
      const size_t i = static_cast<size_t>(r) * x.columns + c;
      const size_t j = static_cast<size_t>(r) * y.columns + c;
      const int o = x.element == ValueType::String
                        ? pool.text(x.strings[i]).compare(pool.text(y.strings[j]))
                        : order(x.numbers[i], y.numbers[j]);
      if (o != 0) return o < 0 ? -1 : 1;
    }
    if (x.columns != y.columns) return x.columns < y.columns ? -1 : 1;
  }
  return x.rows == y.rows ? 0 : x.rows < y.rows ? -1 : 1;
}

ValueOrError applyBinary(BinaryOperator op, const Value& a, const Value& b, ValuePool& pool) {
  if (op >= BinaryOperator::EachAdd) return applyEach(op, a, b, pool);
  if (op >= BinaryOperator::Equal) {
    const bool equality = op == BinaryOperator::Equal || op == BinaryOperator::NotEqual;
    if (a.type == ValueType::Float && b.type == ValueType::Float) {
      return {Value::of(comparesNumbers(op, a.number, b.number))};
    }
    const bool comparable = a.type == b.type || (isText(a) && isText(b));
    if (!comparable) {
      if (equality) return {Value::of(op == BinaryOperator::NotEqual)};
      return {Value::of(false), "values of different types have no order"};
    }
    // Arrays that differ only in their form (1x2 and 2x1) are unequal, though neither is less.
    if (equality && a.isArray())
      return {Value::of((pool.array(a) == pool.array(b)) == (op == BinaryOperator::Equal))};
    return {Value::of(compares(op, orderOfValues(a, b, pool)))};
  }
  if (op == BinaryOperator::Add && (isText(a) || isText(b))) {
    // Looked at where it is: a text that is too long is too long to be copied for each call.
    const auto lengthOf = [&](const Value& v) {
      return isText(v) ? pool.text(v.id).size() : pool.str(v).size();
    };
    if (lengthOf(a) + lengthOf(b) > kMaxTextLength) {
      return {a, "the text would be longer than 16 megabytes", "text-too-long"};
    }
    return {pool.string(pool.str(a) + pool.str(b))};
  }
  if (a.type != ValueType::Float || b.type != ValueType::Float) {
    return {Value::of(0.0), "arithmetic takes numbers"};
  }
  return {Value::of(arithmetic(op, a.number, b.number))};
}

ValueOrError negateValue(const Value& v, ValuePool& pool) {
  if (!v.isArray()) {
    return v.type == ValueType::Float ? ValueOrError{Value::of(-v.number)}
                                      : ValueOrError{Value::of(0.0), "'-' takes numbers"};
  }
  Array a = pool.array(v);
  if (a.element != ValueType::Float) return {v, "'-' takes numbers"};
  for (double& x : a.numbers) x = -x;
  return {pool.intern(std::move(a))};
}

ValueOrError indexArray(const Value& array, std::span<const Value> indices, ValuePool& pool) {
  if (!array.isArray()) return {array, "only arrays are indexed"};
  const Array& a = pool.array(array);
  if (indices.size() == 1) {
    const Value& index = indices[0];
    if (!index.isArray()) return {at(a, index.number, a.size(), pool)};
    const std::vector<double> at1 = positions(index, pool);
    const Array& form = pool.array(index);
    Array out;
    out.element = a.element;
    const bool logical = form.element == ValueType::Bool;
    out.rows = logical ? (at1.empty() ? 0 : 1) : form.rows;
    out.columns = logical ? static_cast<uint32_t>(at1.size()) : form.columns;
    for (double p : at1) appendElement(out, at(a, p, a.size(), pool));
    return {pool.intern(std::move(out))};
  }
  if (!indices[0].isArray() && !indices[1].isArray()) {
    return {atRowColumn(a, indices[0].number, indices[1].number, pool)};
  }
  const std::vector<double> rows = positions(indices[0], pool);
  const std::vector<double> columns = positions(indices[1], pool);
  Array out;
  out.element = a.element;
  out.rows = static_cast<uint32_t>(rows.size());
  out.columns = static_cast<uint32_t>(columns.size());
  for (double r : rows) {
    for (double c : columns) appendElement(out, atRowColumn(a, r, c, pool));
  }
  return {pool.intern(std::move(out))};
}

namespace {

constexpr const char* kTooLarge = "the array would have more than 100000 elements";

// One row of items side by side: single values and arrays of equal height.
const char* buildRow(std::span<const Value> items, const ValuePool& pool, Array& out) {
  out.rows = 1;
  for (size_t i = 0; i < items.size(); ++i) {
    const uint32_t rows = items[i].isArray() ? pool.array(items[i]).rows : 1;
    if (i == 0)
      out.rows = rows;
    else if (rows != out.rows)
      return "the parts of a row differ in height";
  }
  for (const Value& v : items) out.columns += v.isArray() ? pool.array(v).columns : 1;
  if (out.size() > kMaxArraySize) return kTooLarge;
  for (uint32_t r = 0; r < out.rows; ++r) {
    for (const Value& v : items) {
      if (!v.isArray()) {
        appendElement(out, v);
        continue;
      }
      const Array& a = pool.array(v);
      for (uint32_t c = 0; c < a.columns; ++c) {
        const size_t i = static_cast<size_t>(r) * a.columns + c;
        if (out.element == ValueType::String)
          out.strings.push_back(a.strings[i]);
        else
          out.numbers.push_back(a.numbers[i]);
      }
    }
  }
  return nullptr;
}

}  // namespace

ValueOrError buildArray(std::span<const Value> items, std::span<const uint32_t> counts,
                        ValuePool& pool) {
  Array out;
  if (!items.empty()) out.element = elementType(items[0].type);
  for (const Value& v : items) {
    if (elementType(v.type) != out.element) return {Value{}, "an array holds values of one type"};
  }
  size_t next = 0;
  for (uint32_t count : counts) {
    Array row;
    row.element = out.element;
    if (const char* error = buildRow(items.subspan(next, count), pool, row)) {
      return {Value{}, error, error == kTooLarge ? "array-too-large" : "wrong-type"};
    }
    next += count;
    if (out.rows > 0 && row.columns != out.columns) {
      return {Value{}, "the rows of an array differ in length"};
    }
    if (out.size() + row.size() > kMaxArraySize) return {Value{}, kTooLarge, "array-too-large"};
    out.columns = row.columns;
    out.rows += row.rows;
    out.numbers.insert(out.numbers.end(), row.numbers.begin(), row.numbers.end());
    out.strings.insert(out.strings.end(), row.strings.begin(), row.strings.end());
  }
  if (out.columns == 0) out.rows = 0;
  return {pool.intern(std::move(out))};
}

ValueOrError buildRange(double start, double step, double end, size_t limit, ValuePool& pool) {
  Array out;
  const bool runs = step > 0 ? start <= end : step < 0 && start >= end;
  if (runs && std::isfinite(start) && std::isfinite(step) && std::isfinite(end)) {
    const double count = std::floor((end - start) / step) + 1;
    if (count > static_cast<double>(limit)) {
      return {Value{}, "the range has too many elements", "array-too-large"};
    };
    out.rows = 1;
    out.columns = static_cast<uint32_t>(count);
    for (uint32_t i = 0; i < out.columns; ++i) out.numbers.push_back(start + i * step);
  }
  return {pool.intern(std::move(out))};
}

}  // namespace gable
