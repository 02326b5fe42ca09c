// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parameters of one type whose field is a Value, because another signature has another type for it.
#pragma once

#include "program/arguments.h"

namespace gable {

namespace arguments_detail {

// A field for any value does not know what the parameter takes.
template <auto Member, ParamType kType>
static bool storeTyped(void* arguments, const Value& v, const ValuePool& pool) {
  if (kType != ParamType::Any && v.type != valueType(kType)) return false;
  return store<Member>(arguments, v, pool);
}

}  // namespace arguments_detail

template <auto Member, ParamType kType>
constexpr ParamSpec param(const char* name, const char* doc) {
  ParamSpec p = param<Member>(name, doc);
  p.type = kType;
  p.store = &arguments_detail::storeTyped<Member, kType>;
  return p;
}

}  // namespace gable
