// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyT(OpCall& call) {
  Shape& s = call.shape();
  const Vec3 by{call.sized(0, s.size.x), call.sized(1, s.size.y), call.sized(2, s.size.z)};
  s.scope.origin = s.scope.point(by);
  return {};
}

bool applyTLight(LightPart& part, std::span<const Value> args) {
  Vec3 by;
  for (size_t i = 0; i < 3; ++i) {
    by[i] = args[i].unit == Unit::Relative ? args[i].number * part.size[i] : args[i].number;
  }
  part.origin += part.parent->direction(by);
  return true;
}

Status applyTranslate(OpCall& call) {
  Shape& s = call.shape();
  bool known = false;
  const Frame system = systemNamed(call.text(1), s, call.services(), known);
  if (!known) {
    return call.fail("unknown-selector",
                     "translate knows no coordinate system '" + std::string(call.text(1)) + "'",
                     "use scope, pivot, object or world");
  }
  const Vec3 v{call.number(2), call.number(3), call.number(4)};
  if (call.is(0, "abs"))
    s.scope.origin = system.point(v);
  else
    s.scope.origin += system.direction(v);
  return {};
}

constexpr ParamSpec kTParams[] = {
    {"tx", ParamType::Size, "Move along the scope's x axis, in metres or as a share of the size."},
    {"ty", ParamType::Size, "Move along the scope's y axis."},
    {"tz", ParamType::Size, "Move along the scope's z axis."},
};
constexpr Signature kTSignatures[] = {{kTParams}};

constexpr ParamSpec kTranslateParams[] = {
    {"mode", ParamType::Selector,
     "rel adds the vector to the position of the scope; abs puts the origin of the scope there.",
     nullptr, "abs rel"},
    {"coordSystem", ParamType::Selector, "The coordinate system that the vector is written in.",
     nullptr, "scope pivot object world"},
    {"x", ParamType::Float, "Along the x axis of that system, in metres."},
    {"y", ParamType::Float, "Along its y axis."},
    {"z", ParamType::Float, "Along its z axis."},
};
constexpr Signature kTranslateSignatures[] = {{kTranslateParams}};

constexpr OpSpec kSpecs[] = {
    withLight({"t", "transform", "Moves the scope along its own axes.", kTSignatures, applyT},
              applyTLight),
    {"translate", "transform",
     "Moves the scope by a vector, or to a place, in a coordinate system of choice.",
     kTranslateSignatures, applyTranslate, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kReadsPivot},
};

}  // namespace

extern const OpList kOps_translate_scope;
const OpList kOps_translate_scope = kSpecs;

}  // namespace gable
