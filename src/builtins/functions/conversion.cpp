// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cmath>

#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The text that stands for a missing value, U+E000.
constexpr std::string_view kNullText = "\xee\x80\x80";

Value toFloat(FunctionCall& call) {
  const Value& v = call.arg(0);
  return Value::of(v.type == ValueType::String ? numberOf(call.text(0)) : v.number);
}

Value toBool(FunctionCall& call) {
  const Value& v = call.arg(0);
  return Value::of(v.type == ValueType::String ? truthOf(call.text(0)) : v.truth());
}

Value toText(FunctionCall& call) {
  ValuePool& pool = call.services().pool();
  return call.result(pool.str(call.arg(0)));
}

Value toSelector(FunctionCall& call) { return Value::selector(call.arg(0).id); }

// An array of another element type, element by element; empty without argument.
template <ValueType element>
Value toArray(FunctionCall& call) {
  Array out;
  if (!call.has(0)) {
    out.element = element;
    return call.result(std::move(out));
  }
  const Array& from = call.array(0);
  ValuePool& pool = call.services().pool();
  out.element = element;
  out.rows = from.rows;
  out.columns = from.columns;
  for (size_t i = 0; i < from.size(); ++i) {
    const bool text = from.element == ValueType::String;
    if constexpr (element == ValueType::String) {
      const Value v{from.element, Unit::Absolute, text ? from.strings[i] : 0,
                    text ? 0 : from.numbers[i]};
      out.strings.push_back(text ? from.strings[i] : pool.intern(pool.str(v)));
    } else if constexpr (element == ValueType::Bool) {
      const bool truth = text ? truthOf(pool.text(from.strings[i])) : from.numbers[i] != 0;
      out.numbers.push_back(truth ? 1 : 0);
    } else {
      out.numbers.push_back(text ? numberOf(pool.text(from.strings[i])) : from.numbers[i]);
    }
  }
  return call.result(std::move(out));
}

Value isNull(FunctionCall& call) {
  const Value& v = call.arg(0);
  const ValuePool& pool = call.services().pool();
  if (v.type == ValueType::Float) return Value::of(std::isnan(v.number));
  if (v.type == ValueType::String) return Value::of(call.text(0) == kNullText);
  const Array& from = call.array(0);
  Array out;
  out.element = ValueType::Bool;
  out.rows = from.rows;
  out.columns = from.columns;
  for (double number : from.numbers) out.numbers.push_back(std::isnan(number) ? 1 : 0);
  for (StringId s : from.strings) out.numbers.push_back(pool.text(s) == kNullText ? 1 : 0);
  return call.result(std::move(out));
}

constexpr ParamSpec kFloat[] = {{"value", ParamType::Float, "A number."}};
constexpr ParamSpec kBool[] = {{"value", ParamType::Bool, "A truth value."}};
constexpr ParamSpec kString[] = {{"value", ParamType::String, "A text."}};
constexpr ParamSpec kAny[] = {{"value", ParamType::Any, "Any value or array."}};
constexpr ParamSpec kFloats[] = {{"values", ParamType::FloatArray, "Numbers."}};
constexpr ParamSpec kBools[] = {{"values", ParamType::BoolArray, "Truth values."}};
constexpr ParamSpec kStrings[] = {{"values", ParamType::StringArray, "Texts."}};

template <ValueType result>
constexpr Signature kSingle[] = {{kFloat, result}, {kBool, result}, {kString, result}};
template <ValueType result>
constexpr Signature kArray[] = {
    {{}, result}, {kFloats, result}, {kBools, result}, {kStrings, result}};
constexpr Signature kText[] = {{kAny, ValueType::String}};
constexpr ParamSpec kWord[] = {{"selString", ParamType::String, "The word."}};
constexpr Signature kSel[] = {{kWord, ValueType::Selector}};
constexpr Signature kNull[] = {{kFloat, ValueType::Bool},
                               {kString, ValueType::Bool},
                               {kFloats, ValueType::BoolArray},
                               {kStrings, ValueType::BoolArray}};

constexpr const char* kFamily = "conversion";
constexpr FunctionSpec kFunctions[] = {
    {"float", kFamily, "A number from a text or a truth value; NaN from a text that is none.",
     kSingle<ValueType::Float>, toFloat},
    {"bool", kFamily, "False from 0, \"false\", \"f\", \"0\" and their kin, else true.",
     kSingle<ValueType::Bool>, toBool},
    {"str", kFamily, "A value as text.", kText, toText},
    {"floatArray", kFamily, "An array of numbers from another array; empty without one.",
     kArray<ValueType::FloatArray>, toArray<ValueType::Float>, kPure, true},
    {"boolArray", kFamily, "An array of truth values from another array; empty without one.",
     kArray<ValueType::BoolArray>, toArray<ValueType::Bool>, kPure, true},
    {"stringArray", kFamily, "An array of texts from another array; empty without one.",
     kArray<ValueType::StringArray>, toArray<ValueType::String>, kPure, true},
    {"sel", kFamily, "A selector word from a text.", kSel, toSelector},
    {"isNull", kFamily, "Whether a value is missing: NaN, or the text of U+E000.", kNull, isNull},
};

}  // namespace

extern const FunctionList kFunctions_conversion;
const FunctionList kFunctions_conversion = {kFunctions, {}};

}  // namespace gable
