// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The place of a shape as one affine map that operations multiply from the right, as turtles and
// matrix stacks have it: each works in the coordinates that those before it left. While the map is
// a frame times a size it is the scope; a turn of unequal sizes or a taper makes it a deformation.

#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/deformation.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Numbers {
  double x, y, z;
  Vec3 vec() const { return {x, y, z}; }
};

// Edits both maps of a deformed shape.
template <class Edit>
void editMaps(Shape& s, Edit edit) {
  ShapeExtra extra = extraOf(s);
  extra.deformed = true;
  extra.deformation.near = edit(extra.deformation.near);
  extra.deformation.far = edit(extra.deformation.far);
  s.extra = makeRef<ShapeExtra>(std::move(extra));
}

Status applyReset(OpCall& call) {
  Shape& s = call.shape();
  s.geometry = {};
  s.assetMaterials = 0;
  s.extra = {};
  s.scope = objectFrame(call.services());
  s.size = {1, 1, 1};
  s.pivot = s.scope;
  return {};
}

Status applyScale(OpCall& call, const Numbers& args) {
  Shape& s = call.shape();
  const Vec3 by = args.vec();
  if (isDeformed(s))
    editMaps(s, [&](const Affine& a) { return afterScale(a, by); });
  else
    s.size = scaled(s.size, by);
  return {};
}

Status applyMove(OpCall& call, const Numbers& args) {
  Shape& s = call.shape();
  const Vec3 by = args.vec();
  if (isDeformed(s))
    editMaps(s, [&](const Affine& a) { return afterMove(a, by); });
  else
    s.scope.origin = s.scope.point(scaled(s.size, by));
  return {};
}

// The axis has a name or a number.
struct Turn {
  double angle;
  Axis axis;
  std::optional<double> number;
};

size_t axisOf(const Turn& args) {
  if (!args.number) return static_cast<size_t>(args.axis);
  const double axis = std::trunc(*args.number);
  return axis == 0 ? 0 : axis == 1 ? 1 : 2;
}

// The scope turned about its own axes.
void turnOwnAxes(Shape& s, const Frame& turn) {
  const Vec3 origin = s.scope.origin;
  s.scope = composedAxes(s.scope, turn);
  s.scope.origin = origin;
}

Frame turnAbout(size_t axis, double degrees) {
  return rotationXyz(axis == 0 ? degrees : 0, axis == 1 ? degrees : 0, axis == 2 ? degrees : 0);
}

// A turn commutes with sizes where the two that it mixes are equal; with one of them mirrored it
// runs the other way round. Quarter turns exchange them. False where the sizes would shear.
bool turnScope(Shape& s, size_t axis, double degrees) {
  double& a = s.size[(axis + 1) % 3];
  double& b = s.size[(axis + 2) % 3];
  if (a == -b) {
    turnOwnAxes(s, turnAbout(axis, a == b ? degrees : -degrees));
    return true;
  }
  const double quarters = std::fmod(degrees, 360) / 90;
  const bool square = quarters == std::trunc(quarters);
  if (a != b && !square) return false;
  turnOwnAxes(s, turnAbout(axis, degrees));
  if (square && std::fmod(std::fabs(quarters), 2) == 1) std::swap(a, b);
  return true;
}

Status applyTurn(OpCall& call, const Turn& args) {
  Shape& s = call.shape();
  const double degrees = args.angle;
  if (!std::isfinite(degrees)) {
    return call.fail("bad-argument", "affineTurn got no number", "give an angle in degrees");
  }
  const size_t axis = axisOf(args);
  if (!isDeformed(s) && turnScope(s, axis, degrees)) return {};
  const Frame turn = turnAbout(axis, degrees);
  editMaps(s, [&](const Affine& a) { return afterTurn(a, turn.x, turn.y, turn.z); });
  return {};
}

Status applyTaper(OpCall& call, const Numbers& args) {
  Shape& s = call.shape();
  ShapeExtra extra = extraOf(s);
  extra.deformed = true;
  extra.deformation.far = afterScale(extra.deformation.far, args.vec());
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  return {};
}

template <Vec3 Deformation::*side>
Status applySide(OpCall& call, const Numbers& args) {
  Shape& s = call.shape();
  ShapeExtra extra = extraOf(s);
  extra.deformed = true;
  extra.deformation.*side = args.vec();
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  return {};
}

constexpr ParamSpec kFactors[] = {
    param<&Numbers::x>("x", "Factor along x."),
    param<&Numbers::y>("y", "Factor along y."),
    param<&Numbers::z>("z", "Factor along z."),
};
constexpr ParamSpec kSteps[] = {
    param<&Numbers::x>("x", "Share of the scope's width."),
    param<&Numbers::y>("y", "Share of its height."),
    param<&Numbers::z>("z", "Share of its depth."),
};
constexpr ParamSpec kAngle = param<&Turn::angle>("angle", "In degrees, right-handed.");
constexpr ParamSpec kTurnWord[] = {kAngle, param<&Turn::axis>("axis", "The axis to turn about.")};
constexpr ParamSpec kTurnNumber[] = {
    kAngle, param<&Turn::number>("axis", "The axis as a number: 0 is x, 1 is y, all else z.")};
constexpr Signature kResetSignatures[] = {{}};
constexpr Signature kFactorSignatures[] = {{kFactors}};
constexpr Signature kStepSignatures[] = {{kSteps}};
constexpr Signature kTurnSignatures[] = {{kTurnWord}, {kTurnNumber}};

constexpr OpSpec kSpecs[] = {
    {"affineReset", "affine",
     "Takes the geometry away and makes the scope a cube of one metre at the object's origin.",
     kResetSignatures, applyReset, BlockKind::None,
     kTakesDeformed | kReadsWorld | kReadsInitialShape, kNoParts, false, true},
    {"affineScale", "affine", "Multiplies the sizes of the scope about its origin.",
     kFactorSignatures, typed<applyScale>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
    {"affineMove", "affine", "Moves the scope along its own axes by shares of its size.",
     kStepSignatures, typed<applyMove>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
    {"affineTurn", "affine", "Turns about an axis of the scope, then unequal sizes shear.",
     kTurnSignatures, typed<applyTurn>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
    {"affineTaper", "affine", "Scales the far side of the bodies that follow.", kFactorSignatures,
     typed<applyTaper>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
    {"affineFront", "affine", "Sets the factors for the corners at the front of boxes that follow.",
     kFactorSignatures, typed<applySide<&Deformation::front>>, BlockKind::None, kTakesDeformed,
     kNoParts, false, true},
    {"affineTop", "affine", "Sets the factors for the corners at the top of boxes that follow.",
     kFactorSignatures, typed<applySide<&Deformation::top>>, BlockKind::None, kTakesDeformed,
     kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_affine;
const OpList kOps_affine = kSpecs;

}  // namespace gable
