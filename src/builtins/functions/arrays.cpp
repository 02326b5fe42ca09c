// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Arrays are tables stored row by row; a plain list has one row. Indices are numbers from 0, arrays
// of numbers, or arrays of truth values that say which elements are meant.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// An array of any type.
struct Given {
  Value array;
  const Array& in(const FunctionCall& call) const { return call.services().pool().array(array); }
};

Value size(FunctionCall& call, const Given& args) {
  return Value::of(static_cast<double>(args.in(call).size()));
}
Value nRows(FunctionCall& call, const Given& args) {
  return Value::of(double{1} * args.in(call).rows);
}
Value nColumns(FunctionCall& call, const Given& args) {
  return Value::of(double{1} * args.in(call).columns);
}

Value sum(FunctionCall& call, const Given& args) {
  const Array& a = args.in(call);
  if (a.element != ValueType::String) {
    return Value::of(std::accumulate(a.numbers.begin(), a.numbers.end(), 0.0));
  }
  std::string all;
  for (const StringId s : a.strings) {
    all += call.services().pool().text(s);
    if (all.size() > kMaxTextLength) break;
  }
  return call.result(all);
}

// Copies an element to the end of another array of the same type.
void push(Array& out, const Array& from, size_t at) {
  if (from.element == ValueType::String)
    out.strings.push_back(from.strings[at]);
  else
    out.numbers.push_back(from.numbers[at]);
}

Value transpose(FunctionCall& call, const Given& args) {
  const Array& a = args.in(call);
  Array out;
  out.element = a.element;
  out.rows = a.columns;
  out.columns = a.rows;
  for (uint32_t c = 0; c < a.columns; ++c) {
    for (uint32_t r = 0; r < a.rows; ++r) push(out, a, size_t{r} * a.columns + c);
  }
  return call.result(std::move(out));
}

// Places that an index argument names; negative ones are left out but keep their turn as -1.
std::vector<double> placesOf(const Value& v, const ValuePool& pool) {
  if (!v.isArray()) return {std::trunc(v.number)};
  const Array& a = pool.array(v);
  std::vector<double> places;
  for (size_t i = 0; i < a.numbers.size(); ++i) {
    if (a.element != ValueType::Bool)
      places.push_back(std::trunc(a.numbers[i]));
    else if (a.numbers[i] != 0)
      places.push_back(static_cast<double>(i));
  }
  return places;
}

// Grows a table to at least so many rows and columns, filled with zeros or empty texts.
void grow(Array& a, uint32_t rows, uint32_t columns) {
  rows = std::max(rows, a.rows);
  columns = std::max(columns, a.columns);
  if (rows == a.rows && columns == a.columns) return;
  Array out;
  out.element = a.element;
  out.rows = rows;
  out.columns = columns;
  for (uint32_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      if (r < a.rows && c < a.columns)
        push(out, a, size_t{r} * a.columns + c);
      else if (a.element == ValueType::String)
        out.strings.push_back(0);
      else
        out.numbers.push_back(0);
    }
  }
  a = std::move(out);
}

// The values to set, one or as many as there are places.
struct Source {
  const Value& value;
  const Array* array = nullptr;

  void put(Array& a, size_t at, size_t turn) const {
    if (a.element == ValueType::String)
      a.strings[at] = array ? array->strings[turn] : value.id;
    else
      a.numbers[at] = array ? array->numbers[turn] : value.number;
  }
};

struct SetElems : Given {
  /// Counted row by row in a list; in a table the rows, with the columns beside them.
  Value places;
  std::optional<Value> columns;
  Value values;
};

Value tooLarge(const FunctionCall& call, const SetElems& args) {
  return call.fail("array-too-large", "setElems would make the array too large",
                   "arrays have up to 100000 elements", args.array);
}

Value sizesDiffer(const FunctionCall& call, const SetElems& args) {
  return call.fail("bad-argument", "setElems got more or fewer values than places",
                   "give one value, or one for each place", args.array);
}

Value setLinear(FunctionCall& call, const SetElems& args, Array a, const Source& source) {
  const std::vector<double> places = placesOf(args.places, call.services().pool());
  if (source.array && source.array->size() != places.size()) return sizesDiffer(call, args);
  double last = -1;
  for (const double p : places) last = std::max(last, p);
  if (last >= static_cast<double>(kMaxArraySize)) return tooLarge(call, args);
  if (last >= static_cast<double>(a.size())) {
    // A list grows at its end, a table by rows.
    const auto need = static_cast<uint32_t>(last) + 1;
    if (a.rows <= 1)
      grow(a, 1, need);
    else
      grow(a, (need + a.columns - 1) / a.columns, a.columns);
    if (a.size() > kMaxArraySize) return tooLarge(call, args);
  }
  for (size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= 0) source.put(a, static_cast<size_t>(places[i]), i);
  }
  return call.result(std::move(a));
}

Value setTable(FunctionCall& call, const SetElems& args, Array a, const Source& source) {
  const ValuePool& pool = call.services().pool();
  const std::vector<double> rows = placesOf(args.places, pool);
  const std::vector<double> columns = placesOf(*args.columns, pool);
  if (source.array &&
      (source.array->rows != rows.size() || source.array->columns != columns.size())) {
    return sizesDiffer(call, args);
  }
  const auto needed = [](const std::vector<double>& places, uint32_t had) {
    double last = -1;
    for (const double p : places) last = std::max(last, p);
    return std::max(last + 1, double{1} * had);
  };
  const double height = needed(rows, a.rows), width = needed(columns, a.columns);
  if (!(height * width <= static_cast<double>(kMaxArraySize))) return tooLarge(call, args);
  grow(a, static_cast<uint32_t>(height), static_cast<uint32_t>(width));
  for (size_t r = 0; r < rows.size(); ++r) {
    for (size_t c = 0; c < columns.size(); ++c) {
      if (rows[r] < 0 || columns[c] < 0) continue;
      const size_t at = static_cast<size_t>(rows[r]) * a.columns + static_cast<size_t>(columns[c]);
      source.put(a, at, r * columns.size() + c);
    }
  }
  return call.result(std::move(a));
}

Value setElems(FunctionCall& call, const SetElems& args) {
  const ValuePool& pool = call.services().pool();
  const Value& values = args.values;
  const Source source{values, values.isArray() ? &pool.array(values) : nullptr};
  const ValueType element = values.isArray() ? elementType(values.type) : values.type;
  const Array& a = pool.array(args.array);
  if (element != a.element) {
    return call.fail("type-mismatch", "setElems got values of another type than the array's",
                     "convert them before", args.array);
  }
  return args.columns ? setTable(call, args, a, source) : setLinear(call, args, a, source);
}

// Order of elements; NaN comes last, so that there is an order at all.
bool before(const Array& a, size_t i, size_t j, const ValuePool& pool) {
  if (a.element == ValueType::String) return pool.text(a.strings[i]) < pool.text(a.strings[j]);
  const double x = a.numbers[i], y = a.numbers[j];
  if (std::isnan(x) || std::isnan(y)) return !std::isnan(x) && std::isnan(y);
  return x < y;
}

Value sortIndices(FunctionCall& call, const Given& args) {
  const Array& a = args.in(call);
  const ValuePool& pool = call.services().pool();
  Array out;
  out.rows = a.rows;
  out.columns = a.columns;
  for (uint32_t r = 0; r < a.rows; ++r) {
    std::vector<size_t> order(a.columns);
    std::iota(order.begin(), order.end(), size_t{r} * a.columns);
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t i, size_t j) { return before(a, i, j, pool); });
    for (const size_t i : order) out.numbers.push_back(static_cast<double>(i));
  }
  return call.result(std::move(out));
}

Value sortRowIndices(FunctionCall& call, const Given& args) {
  const Array& a = args.in(call);
  const ValuePool& pool = call.services().pool();
  std::vector<size_t> order(a.rows);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t r, size_t s) {
    for (size_t c = 0; c < a.columns; ++c) {
      const size_t i = r * a.columns + c, j = s * a.columns + c;
      if (before(a, i, j, pool)) return true;
      if (before(a, j, i, pool)) return false;
    }
    return false;
  });
  Array out;
  out.rows = order.empty() ? 0 : 1;
  out.columns = a.rows;
  for (const size_t r : order) out.numbers.push_back(static_cast<double>(r));
  return call.result(std::move(out));
}

constexpr ParamSpec kFloats =
    param<&Given::array, ParamType::FloatArray>("array", "An array of numbers.");
constexpr ParamSpec kBools =
    param<&Given::array, ParamType::BoolArray>("array", "An array of truth values.");
constexpr ParamSpec kStrings =
    param<&Given::array, ParamType::StringArray>("array", "An array of texts.");
constexpr ParamSpec kFloatsParams[] = {kFloats};
constexpr ParamSpec kBoolsParams[] = {kBools};
constexpr ParamSpec kStringsParams[] = {kStrings};

constexpr Signature kNumber[] = {{kFloatsParams, ValueType::Float},
                                 {kBoolsParams, ValueType::Float},
                                 {kStringsParams, ValueType::Float}};
constexpr Signature kSum[] = {{kFloatsParams, ValueType::Float},
                              {kBoolsParams, ValueType::Float},
                              {kStringsParams, ValueType::String}};
constexpr Signature kSame[] = {{kFloatsParams, ValueType::FloatArray},
                               {kBoolsParams, ValueType::BoolArray},
                               {kStringsParams, ValueType::StringArray}};
constexpr Signature kOrder[] = {{kFloatsParams, ValueType::FloatArray},
                                {kStringsParams, ValueType::FloatArray}};

constexpr ParamSpec kIndices = param<&SetElems::places>(
    "indices", "Places counted row by row from 0: a number, numbers, or truth values.");
constexpr ParamSpec kRows = param<&SetElems::places>("rowIndices", "Rows, likewise.");
constexpr ParamSpec kColumns = param<&SetElems::columns>("colIndices", "Columns, likewise.");
constexpr ParamSpec kValues =
    param<&SetElems::values>("values", "One value for all places, or an array with one for each.");
constexpr ParamSpec kSetFloats[] = {kFloats, kIndices, kValues};
constexpr ParamSpec kSetBools[] = {kBools, kIndices, kValues};
constexpr ParamSpec kSetStrings[] = {kStrings, kIndices, kValues};
constexpr ParamSpec kSetFloatTable[] = {kFloats, kRows, kColumns, kValues};
constexpr ParamSpec kSetBoolTable[] = {kBools, kRows, kColumns, kValues};
constexpr ParamSpec kSetStringTable[] = {kStrings, kRows, kColumns, kValues};
constexpr Signature kSet[] = {
    {kSetFloats, ValueType::FloatArray},   {kSetBools, ValueType::BoolArray},
    {kSetStrings, ValueType::StringArray}, {kSetFloatTable, ValueType::FloatArray},
    {kSetBoolTable, ValueType::BoolArray}, {kSetStringTable, ValueType::StringArray},
};

constexpr const char* kFamily = "arrays";
constexpr FunctionSpec kFunctions[] = {
    {"size", kFamily, "The number of elements of an array.", kNumber, typed<size>},
    {"nRows", kFamily, "The number of rows of an array.", kNumber, typed<nRows>},
    {"nColumns", kFamily, "The number of columns of an array.", kNumber, typed<nColumns>},
    {"sum", kFamily, "The sum of numbers, the count of true values, or all texts in one.", kSum,
     typed<sum>},
    {"transpose", kFamily, "The array with rows and columns exchanged.", kSame, typed<transpose>},
    {"setElems", kFamily,
     "The array with some elements set anew; places beyond its end make it larger.", kSet,
     typed<setElems>},
    {"sortIndices", kFamily, "The places of the elements of each row in ascending order.", kOrder,
     typed<sortIndices>},
    {"sortRowIndices", kFamily, "The numbers of the rows in ascending order.", kOrder,
     typed<sortRowIndices>},
};

}  // namespace

extern const FunctionList kFunctions_arrays;
const FunctionList kFunctions_arrays = {kFunctions, {}};

}  // namespace gable
