// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Bounds {
  double min = 0, max = 1;
};

Value random(FunctionCall& call, const Bounds& args) {
  return Value::of(randomIn(call.randomAddress(0), args.min, args.max));
}

struct Probability {
  double probability;
};

Value probability(FunctionCall& call, const Probability& args) {
  return Value::of(randomUnit(call.randomAddress(0)) < args.probability);
}

constexpr ParamSpec kMax = param<&Bounds::max>("max", "The greatest value.");
constexpr ParamSpec kMaxParams[] = {kMax};
constexpr ParamSpec kMinMaxParams[] = {param<&Bounds::min>("min", "The least value."), kMax};
constexpr Signature kRand[] = {
    {{}, ValueType::Float}, {kMaxParams, ValueType::Float}, {kMinMaxParams, ValueType::Float}};

constexpr ParamSpec kPParams[] = {
    param<&Probability::probability>("probability", "How often the result is true, 0 to 1.")};
constexpr Signature kP[] = {{kPParams, ValueType::Bool}};

constexpr FunctionSpec kFunctions[] = {
    {"rand", "random", "A random number, from 0 to 1 unless bounds are given.", kRand,
     typed<random>, kRandom, true},
    {"p", "random", "True with a probability.", kP, typed<probability>, kRandom},
};

}  // namespace

extern const FunctionList kFunctions_random;
const FunctionList kFunctions_random = {kFunctions, {}};

}  // namespace gable
