// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Value random(FunctionCall& call) {
  const double low = call.argCount() == 2 ? call.number(0) : 0;
  const double high = call.argCount() == 0 ? 1 : call.number(call.argCount() - 1);
  return Value::of(randomIn(call.randomAddress(0), low, high));
}

Value probability(FunctionCall& call) {
  return Value::of(randomUnit(call.randomAddress(0)) < call.number(0));
}

constexpr ParamSpec kMax = {"max", ParamType::Float, "The greatest value."};
constexpr ParamSpec kMaxParams[] = {kMax};
constexpr ParamSpec kMinMaxParams[] = {{"min", ParamType::Float, "The least value."}, kMax};
constexpr Signature kRand[] = {
    {{}, ValueType::Float}, {kMaxParams, ValueType::Float}, {kMinMaxParams, ValueType::Float}};

constexpr ParamSpec kPParams[] = {
    {"probability", ParamType::Float, "How often the result is true, 0 to 1."}};
constexpr Signature kP[] = {{kPParams, ValueType::Bool}};

constexpr FunctionSpec kFunctions[] = {
    {"rand", "random", "A random number, from 0 to 1 unless bounds are given.", kRand, random,
     kRandom, true},
    {"p", "random", "True with a probability.", kP, probability, kRandom},
};

}  // namespace

extern const FunctionList kFunctions_random;
const FunctionList kFunctions_random = {kFunctions, {}};

}  // namespace gable
