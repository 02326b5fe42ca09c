// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Arithmetic beyond the operators. Angles are degrees. The elementary functions are those of
// math/trig.h, which give the same bits everywhere.

#include <cmath>

#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

template <double (*f)(double)>
Value map(FunctionCall& call) {
  if (!call.arg(0).isArray()) return Value::of(f(call.number(0)));
  Array a = call.array(0);
  for (double& v : a.numbers) v = f(v);
  return call.result(std::move(a));
}

template <bool (*f)(double)>
Value test(FunctionCall& call) {
  if (!call.arg(0).isArray()) return Value::of(f(call.number(0)));
  Array a = call.array(0);
  a.element = ValueType::Bool;
  for (double& v : a.numbers) v = f(v) ? 1 : 0;
  return call.result(std::move(a));
}

// Adding zero turns a negative zero into a plain one.
double absolute(double v) { return std::fabs(v); }
double ceiling(double v) { return std::ceil(v) + 0.0; }
double floorOf(double v) { return std::floor(v) + 0.0; }
double nearest(double v) { return std::nearbyint(v) + 0.0; }
bool isInfinite(double v) { return std::isinf(v); }
bool isNotANumber(double v) { return std::isnan(v); }

Value squareRoot(FunctionCall& call) {
  const double v = call.number(0);
  if (v < 0) {
    return call.fail("not-a-number", "sqrt has no value for " + numberText(v),
                     "test the sign before", Value::of(std::nan("")));
  }
  return Value::of(std::sqrt(v));
}

Value power(FunctionCall& call) { return Value::of(powOf(call.number(0), call.number(1))); }
Value arcTangent2(FunctionCall& call) {
  return Value::of(atan2Deg(call.number(0), call.number(1)));
}

Value least(FunctionCall& call) {
  const ValuePool& pool = call.services().pool();
  return orderOf(call.arg(1), call.arg(0), pool) < 0 ? call.arg(1) : call.arg(0);
}
Value greatest(FunctionCall& call) {
  const ValuePool& pool = call.services().pool();
  return orderOf(call.arg(1), call.arg(0), pool) > 0 ? call.arg(1) : call.arg(0);
}
Value clamped(FunctionCall& call) {
  const ValuePool& pool = call.services().pool();
  if (orderOf(call.arg(0), call.arg(1), pool) < 0) return call.arg(1);
  return orderOf(call.arg(0), call.arg(2), pool) > 0 ? call.arg(2) : call.arg(0);
}

constexpr ParamSpec kX[] = {{"x", ParamType::Float, "A number."}};
constexpr ParamSpec kXs[] = {
    {"x", ParamType::FloatArray, "Numbers; each gives one of the result."}};
constexpr ValueType kFloat = ValueType::Float;
constexpr Signature kOne[] = {{kX, kFloat}};
constexpr Signature kOneOrMany[] = {{kX, kFloat}, {kXs, ValueType::FloatArray}};
constexpr Signature kTest[] = {{kX, ValueType::Bool}, {kXs, ValueType::BoolArray}};

constexpr ParamSpec kSine[] = {{"angle", ParamType::Float, "An angle in degrees."}};
constexpr Signature kOfAngle[] = {{kSine, kFloat}};

constexpr ParamSpec kPowParams[] = {{"base", ParamType::Float, "The number to raise."},
                                    {"exponent", ParamType::Float, "The power to raise it to."}};
constexpr Signature kPow[] = {{kPowParams, kFloat}};

constexpr ParamSpec kAtan2Params[] = {{"y", ParamType::Float, "The opposite side."},
                                      {"x", ParamType::Float, "The adjacent side."}};
constexpr Signature kAtan2[] = {{kAtan2Params, kFloat}};

constexpr const char* kSame = "Another of the same type.";
constexpr ParamSpec kFloats2[] = {{"a", ParamType::Float, "A number."},
                                  {"b", ParamType::Float, kSame}};
constexpr ParamSpec kStrings2[] = {{"a", ParamType::String, "A text."},
                                   {"b", ParamType::String, kSame}};
constexpr ParamSpec kFloatArrays2[] = {{"a", ParamType::FloatArray, "Numbers."},
                                       {"b", ParamType::FloatArray, kSame}};
constexpr ParamSpec kStringArrays2[] = {{"a", ParamType::StringArray, "Texts."},
                                        {"b", ParamType::StringArray, kSame}};
constexpr Signature kTwo[] = {{kFloats2, kFloat},
                              {kStrings2, ValueType::String},
                              {kFloatArrays2, ValueType::FloatArray},
                              {kStringArrays2, ValueType::StringArray}};

constexpr const char* kLow = "The least result.";
constexpr const char* kHigh = "The greatest result.";
constexpr ParamSpec kFloats3[] = {{"x", ParamType::Float, "A number."},
                                  {"min", ParamType::Float, kLow},
                                  {"max", ParamType::Float, kHigh}};
constexpr ParamSpec kStrings3[] = {{"x", ParamType::String, "A text."},
                                   {"min", ParamType::String, kLow},
                                   {"max", ParamType::String, kHigh}};
constexpr ParamSpec kFloatArrays3[] = {{"x", ParamType::FloatArray, "Numbers."},
                                       {"min", ParamType::FloatArray, kLow},
                                       {"max", ParamType::FloatArray, kHigh}};
constexpr ParamSpec kStringArrays3[] = {{"x", ParamType::StringArray, "Texts."},
                                        {"min", ParamType::StringArray, kLow},
                                        {"max", ParamType::StringArray, kHigh}};
constexpr Signature kThree[] = {{kFloats3, kFloat},
                                {kStrings3, ValueType::String},
                                {kFloatArrays3, ValueType::FloatArray},
                                {kStringArrays3, ValueType::StringArray}};

constexpr const char* kFamily = "numbers";
constexpr FunctionSpec kFunctions[] = {
    {"abs", kFamily, "The number without its sign.", kOneOrMany, map<absolute>},
    {"ceil", kFamily, "The next integer upwards.", kOneOrMany, map<ceiling>},
    {"floor", kFamily, "The next integer downwards.", kOneOrMany, map<floorOf>},
    {"rint", kFamily, "The nearest integer; halves go to the even one.", kOneOrMany, map<nearest>},
    {"sqrt", kFamily, "The square root; NaN, with a warning, of a negative number.", kOne,
     squareRoot},
    {"pow", kFamily, "A number raised to a power.", kPow, power},
    {"exp", kFamily, "Euler's number raised to a power.", kOne, map<expOf>},
    {"ln", kFamily, "The natural logarithm; NaN of a negative number.", kOne, map<logOf>},
    {"log10", kFamily, "The logarithm to base ten.", kOne, map<log10Of>},
    {"sin", kFamily, "The sine of an angle in degrees.", kOfAngle, map<sinDeg>},
    {"cos", kFamily, "The cosine of an angle in degrees.", kOfAngle, map<cosDeg>},
    {"tan", kFamily, "The tangent of an angle in degrees.", kOfAngle, map<tanDeg>},
    {"asin", kFamily, "The angle in degrees, -90 to 90, with this sine.", kOne, map<asinDeg>},
    {"acos", kFamily, "The angle in degrees, 0 to 180, with this cosine.", kOne, map<acosDeg>},
    {"atan", kFamily, "The angle in degrees, -90 to 90, with this tangent.", kOne, map<atanDeg>},
    {"atan2", kFamily, "The angle in degrees, -180 to 180, of the direction (x, y).", kAtan2,
     arcTangent2},
    {"isinf", kFamily, "Whether a number is infinite.", kTest, test<isInfinite>},
    {"isnan", kFamily, "Whether a value is not a number.", kTest, test<isNotANumber>},
    {"min", kFamily, "The lesser of two values.", kTwo, least},
    {"max", kFamily, "The greater of two values.", kTwo, greatest},
    {"clamp", kFamily, "The value itself within two bounds, else the nearer bound.", kThree,
     clamped},
};

}  // namespace

extern const FunctionList kFunctions_numbers;
const FunctionList kFunctions_numbers = {kFunctions, {}};

}  // namespace gable
