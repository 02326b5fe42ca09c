// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/door.h"

#include <string>

namespace gable {

namespace {

// The parameter that an argument is for, by the form that was chosen or the first that fits.
const char* nameOf(const OpSpec& spec, const Signature* form, std::span<const Value> args,
                   size_t index) {
  const auto accepts = [&](const Signature& s) {
    if (!s.acceptsCount(args.size())) return false;
    for (size_t i = 0; i < args.size(); ++i) {
      if (!fits(args[i].type, s.paramAt(i)->type)) return false;
    }
    return true;
  };
  for (const Signature& s : spec.signatures) {
    if (!form && accepts(s)) form = &s;
  }
  const ParamSpec* const param = form ? form->paramAt(index) : nullptr;
  return param ? param->name : nullptr;
}

Status refused(const std::string& what, const Value& v) {
  const bool finite = v.type != ValueType::Float || std::isfinite(v.number);
  std::string is = v.type == ValueType::FloatArray ? " has a number that is not finite or too large"
                   : finite                        ? " is too large for a model"
                                                   : " is not a finite number";
  return Status::failure("bad-argument", what + is, "look for a division by zero");
}

}  // namespace

Status refusedNumber(const OpSpec& spec, const Signature* form, std::span<const Value> args,
                     const ValuePool& pool) {
  if ((spec.effects & kReports) != 0) return {};
  for (size_t i = 0; i < args.size(); ++i) {
    if (holds(args[i], pool)) continue;
    const char* const name = nameOf(spec, form, args, i);
    return refused(name ? "'" + std::string(name) + "'" : "argument " + std::to_string(i + 1),
                   args[i]);
  }
  return {};
}

Status refusedNumber(const char* name, const Value& v, const ValuePool& pool) {
  return holds(v, pool) ? Status() : refused("'" + std::string(name) + "'", v);
}

}  // namespace gable
