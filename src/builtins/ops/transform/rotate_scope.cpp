// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A turn by angles of a coordinate system C is C * R * C^-1 in the frame around it, where R turns
// about x, then y, then z.

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "builtins/ops/shared/quarter_turn.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Frame turnIn(const Frame& system, const Frame& turn) {
  if (!system.turned) return turn;
  return composedAxes(composedAxes(system, turn), inverse(system));
}

Status applyR(OpCall& call) {
  Shape& s = call.shape();
  const size_t first = call.argCount() == 4 ? 1 : 0;
  const Frame turn = turnIn(
      s.pivot, rotationXyz(call.number(first), call.number(first + 1), call.number(first + 2)));
  if (first == 1 && call.is(0, "scopeCenter")) {
    const Vec3 center = s.scope.point(s.size * 0.5);
    turnAxes(s.scope, turn);
    s.scope.origin = center - s.scope.direction(s.size * 0.5);
  } else {
    turnAxes(s.scope, turn);
  }
  return {};
}

Status applyRotate(OpCall& call) {
  Shape& s = call.shape();
  bool known = false;
  const Frame system = systemNamed(call.text(1), s, call.services(), known);
  if (!known) {
    return call.fail("unknown-selector",
                     "rotate knows no coordinate system '" + std::string(call.text(1)) + "'",
                     "use scope, pivot, object or world");
  }
  const Frame turn = rotationXyz(call.number(2), call.number(3), call.number(4));
  if (call.is(0, "abs")) {
    const Vec3 origin = s.scope.origin;
    s.scope = composedAxes(system, turn);
    s.scope.origin = origin;
  } else {
    turnAxes(s.scope, turnIn(system, turn));
  }
  return {};
}

Status applyRotateScope(OpCall& call) {
  Shape& s = call.shape();
  const size_t first = call.argCount() == 4 ? 1 : 0;
  bool known = true;
  const Frame system = first == 1 ? systemNamed(call.text(0), s, call.services(), known) : s.pivot;
  if (!known) {
    return call.fail("unknown-selector",
                     "rotateScope knows no coordinate system '" + std::string(call.text(0)) + "'",
                     "use scope, pivot, object or world");
  }
  const Vec3 angles{call.number(first), call.number(first + 1), call.number(first + 2)};
  QuarterTurn quarter;
  if (first == 1 && call.is(0, "scope") && quarterTurnOf(angles, quarter)) {
    turnScope(s, quarter);
    return {};
  }
  Frame axes = s.scope;
  turnAxes(axes, turnIn(system, rotationXyz(angles.x, angles.y, angles.z)));
  realignScope(s, axes);
  return {};
}

constexpr ParamSpec kAngles[] = {
    {"xAngle", ParamType::Float, "Turn about the pivot's x axis, in degrees; done first."},
    {"yAngle", ParamType::Float, "Turn about the pivot's y axis; done second."},
    {"zAngle", ParamType::Float, "Turn about the pivot's z axis; done last."},
};
constexpr ParamSpec kCenterAndAngles[] = {
    {"center", ParamType::Selector, "The point that stays: the scope's origin or its centre.",
     nullptr, "scopeOrigin scopeCenter"},
    kAngles[0],
    kAngles[1],
    kAngles[2],
};
constexpr Signature kRSignatures[] = {{kAngles}, {kCenterAndAngles}};

constexpr ParamSpec kRotateParams[] = {
    {"mode", ParamType::Selector,
     "rel turns the scope on by the angles; abs gives it the orientation that the angles name.",
     nullptr, "abs rel"},
    {"coordSystem", ParamType::Selector, "The coordinate system that the angles are written in.",
     nullptr, "scope pivot object world"},
    {"xAngle", ParamType::Float, "About the x axis of that system, in degrees; done first."},
    {"yAngle", ParamType::Float, "About its y axis; done second."},
    {"zAngle", ParamType::Float, "About its z axis; done last."},
};
constexpr Signature kRotateSignatures[] = {{kRotateParams}};
constexpr ParamSpec kSystemAndAngles[] = {
    {"coordSystem", ParamType::Selector,
     "The coordinate system that the angles are written in; the pivot's without it.", nullptr,
     "scope pivot object world"},
    kRotateParams[2],
    kRotateParams[3],
    kRotateParams[4],
};
constexpr Signature kRotateScopeSignatures[] = {{kAngles}, {kSystemAndAngles}};

constexpr OpSpec kSpecs[] = {
    {"r", "transform",
     "Turns the scope and its geometry about the axes of the pivot, around the scope's origin or "
     "centre.",
     kRSignatures, applyR, BlockKind::None, kReadsPivotAxes},
    {"rotate", "transform",
     "Turns the scope around its origin, by angles in a coordinate system of choice.",
     kRotateSignatures, applyRotate, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kReadsPivotAxes},
    {"rotateScope", "transform",
     "Turns the scope alone about the axes of the pivot and fits it around the geometry again.",
     kRotateScopeSignatures, applyRotateScope, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kReadsPivotAxes},
};

}  // namespace

extern const OpList kOps_rotate_scope;
const OpList kOps_rotate_scope = kSpecs;

}  // namespace gable
