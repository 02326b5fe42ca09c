// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/door.h"

#include <string>

namespace gable {

namespace {

bool takesNumber(ParamType t) {
  return t != ParamType::Bool && t != ParamType::String && t != ParamType::Selector &&
         t != ParamType::BoolArray && t != ParamType::StringArray;
}

bool takes(ParamType t, ValueType v) {
  if (v == ValueType::Float) return takesNumber(t) && t != ParamType::FloatArray;
  if (v == ValueType::FloatArray) return t == ParamType::FloatArray || t == ParamType::Any;
  return !takesNumber(t) || t == ParamType::Any;
}

// The parameter that an argument is for, by the first way to call that the arguments fit.
const char* nameOf(const OpSpec& spec, std::span<const Value> args, size_t index) {
  for (const Signature& s : spec.signatures) {
    if (s.params.empty() || (args.size() > s.params.size() && !s.variadic)) continue;
    const auto param = [&](size_t i) -> const ParamSpec& {
      return s.params[i < s.params.size() ? i : s.params.size() - 1];
    };
    bool fits = true;
    for (size_t i = 0; i < args.size() && fits; ++i) fits = takes(param(i).type, args[i].type);
    if (fits) return param(index).name;
  }
  return nullptr;
}

Status refused(const std::string& what, const Value& v) {
  const bool finite = v.type != ValueType::Float || std::isfinite(v.number);
  std::string is = v.type == ValueType::FloatArray ? " has a number that is not finite or too large"
                   : finite                        ? " is too large for a model"
                                                   : " is not a finite number";
  return Status::failure("bad-argument", what + is, "look for a division by zero");
}

}  // namespace

Status refusedNumber(const OpSpec& spec, std::span<const Value> args, const ValuePool& pool) {
  if ((spec.effects & kReports) != 0) return {};
  for (size_t i = 0; i < args.size(); ++i) {
    if (holds(args[i], pool)) continue;
    const char* const name = nameOf(spec, args, i);
    return refused(name ? "'" + std::string(name) + "'" : "argument " + std::to_string(i + 1),
                   args[i]);
  }
  return {};
}

Status refusedNumber(const char* name, const Value& v, const ValuePool& pool) {
  return holds(v, pool) ? Status() : refused("'" + std::string(name) + "'", v);
}

}  // namespace gable
