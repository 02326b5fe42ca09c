// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A turn by angles of a coordinate system C is C * R * C^-1 in the frame around it, where R turns
// about x, then y, then z.

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "builtins/ops/shared/quarter_turn.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Frame turnIn(const Frame& system, const Frame& turn) {
  if (!system.turned) return turn;
  return composedAxes(composedAxes(system, turn), inverse(system));
}

enum class Around : uint8_t { ScopeOrigin, ScopeCenter };

}  // namespace

template <>
struct WordsOf<Around> {
  static constexpr const char* text = "scopeOrigin scopeCenter";
};

namespace {

struct Turn {
  Around center = Around::ScopeOrigin;
  double x, y, z;
};

Status applyR(OpCall& call, const Turn& args) {
  Shape& s = call.shape();
  const Frame turn = turnIn(s.pivot, rotationXyz(args.x, args.y, args.z));
  if (args.center == Around::ScopeCenter) {
    const Vec3 center = s.scope.point(s.size * 0.5);
    turnAxes(s.scope, turn);
    s.scope.origin = center - s.scope.direction(s.size * 0.5);
  } else {
    turnAxes(s.scope, turn);
  }
  return {};
}

struct Rotate {
  Placing mode;
  CoordSystem system;
  double x, y, z;
};

Status applyRotate(OpCall& call, const Rotate& args) {
  Shape& s = call.shape();
  const Frame system = frameOf(args.system, s, call.services());
  const Frame turn = rotationXyz(args.x, args.y, args.z);
  if (args.mode == Placing::Abs) {
    const Vec3 origin = s.scope.origin;
    s.scope = composedAxes(system, turn);
    s.scope.origin = origin;
  } else {
    turnAxes(s.scope, turnIn(system, turn));
  }
  return {};
}

struct RotateScope {
  CoordSystem system = CoordSystem::Pivot;
  double x, y, z;
};

Status applyRotateScope(OpCall& call, const RotateScope& args) {
  Shape& s = call.shape();
  const Frame system = frameOf(args.system, s, call.services());
  const Vec3 angles{args.x, args.y, args.z};
  QuarterTurn quarter;
  if (args.system == CoordSystem::Scope && quarterTurnOf(angles, quarter)) {
    turnScope(s, quarter);
    return {};
  }
  Frame axes = s.scope;
  turnAxes(axes, turnIn(system, rotationXyz(angles.x, angles.y, angles.z)));
  realignScope(s, axes);
  return {};
}

constexpr ParamSpec kCenterAndAngles[] = {
    param<&Turn::center>("center", "The point that stays: the scope's origin or its centre."),
    param<&Turn::x>("xAngle", "Turn about the pivot's x axis, in degrees; done first."),
    param<&Turn::y>("yAngle", "Turn about the pivot's y axis; done second."),
    param<&Turn::z>("zAngle", "Turn about the pivot's z axis; done last."),
};
constexpr std::span kAngles = std::span(kCenterAndAngles).subspan(1);
constexpr Signature kRSignatures[] = {{kAngles}, {kCenterAndAngles}};

constexpr ParamSpec kRotateParams[] = {
    param<&Rotate::mode>(
        "mode",
        "rel turns the scope on by the angles; abs gives it the orientation that the angles name."),
    param<&Rotate::system>("coordSystem", "The coordinate system that the angles are written in."),
    param<&Rotate::x>("xAngle", "About the x axis of that system, in degrees; done first."),
    param<&Rotate::y>("yAngle", "About its y axis; done second."),
    param<&Rotate::z>("zAngle", "About its z axis; done last."),
};
constexpr Signature kRotateSignatures[] = {{kRotateParams}};
constexpr ParamSpec kSystemAndAngles[] = {
    param<&RotateScope::system>(
        "coordSystem",
        "The coordinate system that the angles are written in; the pivot's without it."),
    param<&RotateScope::x>("xAngle", "About the x axis of that system, in degrees; done first."),
    param<&RotateScope::y>("yAngle", "About its y axis; done second."),
    param<&RotateScope::z>("zAngle", "About its z axis; done last."),
};
constexpr Signature kRotateScopeSignatures[] = {{std::span(kSystemAndAngles).subspan(1)},
                                                {kSystemAndAngles}};

constexpr OpSpec kSpecs[] = {
    {"r", "transform",
     "Turns the scope and its geometry about the axes of the pivot, around the scope's origin or "
     "centre.",
     kRSignatures, typed<applyR>, BlockKind::None, kReadsPivotAxes | kIgnoresTags},
    {"rotate", "transform",
     "Turns the scope around its origin, by angles in a coordinate system of choice.",
     kRotateSignatures, typed<applyRotate>, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kReadsPivotAxes | kIgnoresTags},
    {"rotateScope", "transform",
     "Turns the scope alone about the axes of the pivot and fits it around the geometry again.",
     kRotateScopeSignatures, typed<applyRotateScope>, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kReadsPivotAxes},
};

}  // namespace

extern const OpList kOps_rotate_scope;
const OpList kOps_rotate_scope = kSpecs;

}  // namespace gable
