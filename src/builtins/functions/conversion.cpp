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

struct Converted {
  Value value;
};

Value toFloat(FunctionCall& call, const Converted& args) {
  const Value& v = args.value;
  const ValuePool& pool = call.services().pool();
  return Value::of(v.type == ValueType::String ? numberOf(pool.text(v.id)) : v.number);
}

Value toBool(FunctionCall& call, const Converted& args) {
  const Value& v = args.value;
  const ValuePool& pool = call.services().pool();
  return Value::of(v.type == ValueType::String ? truthOf(pool.text(v.id)) : v.truth());
}

Value toText(FunctionCall& call, const Converted& args) {
  return call.result(call.services().pool().str(args.value));
}

Value toSelector(FunctionCall&, const Converted& args) { return Value::selector(args.value.id); }

// An array of another element type, element by element; empty without argument.
template <ValueType element>
Value toArray(FunctionCall& call, const Converted& args) {
  Array out;
  out.element = element;
  if (!args.value.isArray()) return call.result(std::move(out));
  ValuePool& pool = call.services().pool();
  const Array& from = pool.array(args.value);
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

Value isNull(FunctionCall& call, const Converted& args) {
  const Value& v = args.value;
  const ValuePool& pool = call.services().pool();
  if (v.type == ValueType::Float) return Value::of(std::isnan(v.number));
  if (v.type == ValueType::String) return Value::of(pool.text(v.id) == kNullText);
  const Array& from = pool.array(v);
  Array out;
  out.element = ValueType::Bool;
  out.rows = from.rows;
  out.columns = from.columns;
  for (double number : from.numbers) out.numbers.push_back(std::isnan(number) ? 1 : 0);
  for (StringId s : from.strings) out.numbers.push_back(pool.text(s) == kNullText ? 1 : 0);
  return call.result(std::move(out));
}

template <ParamType type>
constexpr ParamSpec single(const char* doc) {
  return param<&Converted::value, type>("value", doc);
}
template <ParamType type>
constexpr ParamSpec array(const char* doc) {
  return param<&Converted::value, type>("values", doc);
}
constexpr ParamSpec kFloat[] = {single<ParamType::Float>("A number.")};
constexpr ParamSpec kBool[] = {single<ParamType::Bool>("A truth value.")};
constexpr ParamSpec kString[] = {single<ParamType::String>("A text.")};
constexpr ParamSpec kAny[] = {single<ParamType::Any>("Any value or array.")};
constexpr ParamSpec kFloats[] = {array<ParamType::FloatArray>("Numbers.")};
constexpr ParamSpec kBools[] = {array<ParamType::BoolArray>("Truth values.")};
constexpr ParamSpec kStrings[] = {array<ParamType::StringArray>("Texts.")};

template <ValueType result>
constexpr Signature kSingle[] = {{kFloat, result}, {kBool, result}, {kString, result}};
template <ValueType result>
constexpr Signature kArray[] = {
    {{}, result}, {kFloats, result}, {kBools, result}, {kStrings, result}};
constexpr Signature kText[] = {{kAny, ValueType::String}};
constexpr ParamSpec kWord[] = {
    param<&Converted::value, ParamType::String>("selString", "The word.")};
constexpr Signature kSel[] = {{kWord, ValueType::Selector}};
constexpr Signature kNull[] = {{kFloat, ValueType::Bool},
                               {kString, ValueType::Bool},
                               {kFloats, ValueType::BoolArray},
                               {kStrings, ValueType::BoolArray}};

constexpr const char* kFamily = "conversion";
constexpr FunctionSpec kFunctions[] = {
    {"float", kFamily, "A number from a text or a truth value; NaN from a text that is none.",
     kSingle<ValueType::Float>, typed<toFloat>},
    {"bool", kFamily, "False from 0, \"false\", \"f\", \"0\" and their kin, else true.",
     kSingle<ValueType::Bool>, typed<toBool>},
    {"str", kFamily, "A value as text.", kText, typed<toText>},
    {"floatArray", kFamily, "An array of numbers from another array; empty without one.",
     kArray<ValueType::FloatArray>, typed<toArray<ValueType::Float>>, kPure, true},
    {"boolArray", kFamily, "An array of truth values from another array; empty without one.",
     kArray<ValueType::BoolArray>, typed<toArray<ValueType::Bool>>, kPure, true},
    {"stringArray", kFamily, "An array of texts from another array; empty without one.",
     kArray<ValueType::StringArray>, typed<toArray<ValueType::String>>, kPure, true},
    {"sel", kFamily, "A selector word from a text.", kSel, typed<toSelector>},
    {"isNull", kFamily, "Whether a value is missing: NaN, or the text of U+E000.", kNull,
     typed<isNull>},
};

}  // namespace

extern const FunctionList kFunctions_conversion;
const FunctionList kFunctions_conversion = {kFunctions, {}};

}  // namespace gable
