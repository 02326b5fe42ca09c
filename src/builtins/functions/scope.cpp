// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

template <size_t axis>
Value sizeOf(FunctionCall& call) {
  return Value::of(call.shape().size[axis]);
}

template <size_t axis>
Status setSize(OpCall& call, const Value& v) {
  call.shape().size[axis] = v.number;
  return {};
}

constexpr AttributeSpec kAttributes[] = {
    {"scope.sx", ValueType::Float, "Size of the scope along x.", sizeOf<0>, setSize<0>},
    {"scope.sy", ValueType::Float, "Size of the scope along y.", sizeOf<1>, setSize<1>},
    {"scope.sz", ValueType::Float, "Size of the scope along z.", sizeOf<2>, setSize<2>},
};

}  // namespace

extern const FunctionList kFunctions_scope;
const FunctionList kFunctions_scope = {{}, kAttributes};

}  // namespace gable
