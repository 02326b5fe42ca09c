// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyT(OpCall& call) {
  Shape& s = call.shape();
  const Vec3 by{call.sized(0, s.size.x), call.sized(1, s.size.y), call.sized(2, s.size.z)};
  s.scope.origin = s.scope.point(by);
  return {};
}

constexpr ParamSpec kTParams[] = {
    {"tx", ParamType::Size, "Move along the scope's x axis, in metres or as a share of the size."},
    {"ty", ParamType::Size, "Move along the scope's y axis."},
    {"tz", ParamType::Size, "Move along the scope's z axis."},
};
constexpr Signature kTSignatures[] = {{kTParams}};

constexpr OpSpec kSpecs[] = {
    {"t", "transform", "Moves the scope along its own axes.", kTSignatures, applyT},
};

}  // namespace

extern const OpList kOps_translate_scope;
const OpList kOps_translate_scope = kSpecs;

}  // namespace gable
