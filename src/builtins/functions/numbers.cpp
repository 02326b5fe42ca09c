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

// A number, or an array of them in its place.
struct Numbers {
  double one = 0;
  Floats many;
};

template <double (*f)(double)>
Value map(FunctionCall& call, const Numbers& args) {
  if (!args.many.array) return Value::of(f(args.one));
  Array a = *args.many.array;
  for (double& v : a.numbers) v = f(v);
  return call.result(std::move(a));
}

template <bool (*f)(double)>
Value test(FunctionCall& call, const Numbers& args) {
  if (!args.many.array) return Value::of(f(args.one));
  Array a = *args.many.array;
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

Value squareRoot(FunctionCall& call, const Numbers& args) {
  const double v = args.one;
  if (v < 0) {
    return call.fail("not-a-number", "sqrt has no value for " + numberText(v),
                     "test the sign before", Value::of(std::nan("")));
  }
  return Value::of(std::sqrt(v));
}

struct Pair {
  double a, b;
};

template <double (*f)(double, double)>
Value map2(FunctionCall&, const Pair& args) {
  return Value::of(f(args.a, args.b));
}

// Values of one type.
struct Compared {
  Value a, b;
};

Value least(FunctionCall& call, const Compared& args) {
  return orderOf(args.b, args.a, call.services().pool()) < 0 ? args.b : args.a;
}
Value greatest(FunctionCall& call, const Compared& args) {
  return orderOf(args.b, args.a, call.services().pool()) > 0 ? args.b : args.a;
}

struct Clamped {
  Value x, min, max;
};

Value clamped(FunctionCall& call, const Clamped& args) {
  const ValuePool& pool = call.services().pool();
  if (orderOf(args.x, args.min, pool) < 0) return args.min;
  return orderOf(args.x, args.max, pool) > 0 ? args.max : args.x;
}

constexpr ParamSpec kX[] = {param<&Numbers::one>("x", "A number.")};
constexpr ParamSpec kXs[] = {param<&Numbers::many>("x", "Numbers; each gives one of the result.")};
constexpr ParamSpec kAngle[] = {param<&Numbers::one>("angle", "An angle in degrees.")};
constexpr ValueType kFloat = ValueType::Float;
constexpr Signature kOne[] = {{kX, kFloat}};
constexpr Signature kOfAngle[] = {{kAngle, kFloat}};
constexpr Signature kOneOrMany[] = {{kX, kFloat}, {kXs, ValueType::FloatArray}};
constexpr Signature kTest[] = {{kX, ValueType::Bool}, {kXs, ValueType::BoolArray}};

constexpr ParamSpec kPowParams[] = {param<&Pair::a>("base", "The number to raise."),
                                    param<&Pair::b>("exponent", "The power to raise it to.")};
constexpr Signature kPow[] = {{kPowParams, kFloat}};
constexpr ParamSpec kAtan2Params[] = {param<&Pair::a>("y", "The opposite side."),
                                      param<&Pair::b>("x", "The adjacent side.")};
constexpr Signature kAtan2[] = {{kAtan2Params, kFloat}};

constexpr const char* docOf(ParamType type) {
  switch (type) {
    case ParamType::Float: return "A number.";
    case ParamType::String: return "A text.";
    case ParamType::FloatArray: return "Numbers.";
    default: return "Texts.";
  }
}

template <ParamType type>
constexpr ParamSpec kComparedOf[] = {param<&Compared::a, type>("a", docOf(type)),
                                     param<&Compared::b, type>("b", "Another of the same type.")};
constexpr Signature kTwo[] = {{kComparedOf<ParamType::Float>, kFloat},
                              {kComparedOf<ParamType::String>, ValueType::String},
                              {kComparedOf<ParamType::FloatArray>, ValueType::FloatArray},
                              {kComparedOf<ParamType::StringArray>, ValueType::StringArray}};

template <ParamType type>
constexpr ParamSpec kClampedOf[] = {param<&Clamped::x, type>("x", docOf(type)),
                                    param<&Clamped::min, type>("min", "The least result."),
                                    param<&Clamped::max, type>("max", "The greatest result.")};
constexpr Signature kThree[] = {{kClampedOf<ParamType::Float>, kFloat},
                                {kClampedOf<ParamType::String>, ValueType::String},
                                {kClampedOf<ParamType::FloatArray>, ValueType::FloatArray},
                                {kClampedOf<ParamType::StringArray>, ValueType::StringArray}};

constexpr const char* kFamily = "numbers";
constexpr FunctionSpec kFunctions[] = {
    {"abs", kFamily, "The number without its sign.", kOneOrMany, typed<map<absolute>>},
    {"ceil", kFamily, "The next integer upwards.", kOneOrMany, typed<map<ceiling>>},
    {"floor", kFamily, "The next integer downwards.", kOneOrMany, typed<map<floorOf>>},
    {"rint", kFamily, "The nearest integer; halves go to the even one.", kOneOrMany,
     typed<map<nearest>>},
    {"sqrt", kFamily, "The square root; NaN, with a warning, of a negative number.", kOne,
     typed<squareRoot>},
    {"pow", kFamily, "A number raised to a power.", kPow, typed<map2<powOf>>},
    {"exp", kFamily, "Euler's number raised to a power.", kOne, typed<map<expOf>>},
    {"ln", kFamily, "The natural logarithm; NaN of a negative number.", kOne, typed<map<logOf>>},
    {"log10", kFamily, "The logarithm to base ten.", kOne, typed<map<log10Of>>},
    {"sin", kFamily, "The sine of an angle in degrees.", kOfAngle, typed<map<sinDeg>>},
    {"cos", kFamily, "The cosine of an angle in degrees.", kOfAngle, typed<map<cosDeg>>},
    {"tan", kFamily, "The tangent of an angle in degrees.", kOfAngle, typed<map<tanDeg>>},
    {"asin", kFamily, "The angle in degrees, -90 to 90, with this sine.", kOne,
     typed<map<asinDeg>>},
    {"acos", kFamily, "The angle in degrees, 0 to 180, with this cosine.", kOne,
     typed<map<acosDeg>>},
    {"atan", kFamily, "The angle in degrees, -90 to 90, with this tangent.", kOne,
     typed<map<atanDeg>>},
    {"atan2", kFamily, "The angle in degrees, -180 to 180, of the direction (x, y).", kAtan2,
     typed<map2<atan2Deg>>},
    {"isinf", kFamily, "Whether a number is infinite.", kTest, typed<test<isInfinite>>},
    {"isnan", kFamily, "Whether a value is not a number.", kTest, typed<test<isNotANumber>>},
    {"min", kFamily, "The lesser of two values.", kTwo, typed<least>},
    {"max", kFamily, "The greater of two values.", kTwo, typed<greatest>},
    {"clamp", kFamily, "The value itself within two bounds, else the nearer bound.", kThree,
     typed<clamped>},
};

}  // namespace

extern const FunctionList kFunctions_numbers;
const FunctionList kFunctions_numbers = {kFunctions, {}};

}  // namespace gable
