// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Bodies that are left on the way: the shape goes on as it was. A box that is not deformed stays a
// primitive, and nothing is allocated for it.

#include <utility>

#include "builtins/lists.h"
#include "builtins/ops/shared/numbered_texture.h"
#include "geom/primitive/solids.h"
#include "shape/deformation.h"
#include "shape/op_call.h"

namespace gable {

namespace {

bool isFinitePlace(const Shape& s) { return isFinite(s.scope.origin) && isFinite(s.size); }

struct Wearing {
  std::optional<double> texture;
  double quarters, scale;
};

void wearTexture(OpCall& call, const Wearing& args) {
  if (!args.texture) return;
  wearNumberedTexture(call.shape(), call.services(), *args.texture, args.quarters, args.scale);
}

Status tooLarge(const OpCall& call) {
  return call.fail("not-finite", "the body has no finite place and size",
                   "see what the sizes before it multiply to");
}

// Leaves a mesh in unit coordinates; `sides` tells its near and far side.
Status leaveMesh(OpCall& call, const MeshRef& unit, const DeformedSides& sides) {
  Shape& s = call.shape();
  const Geometry geometry = std::exchange(s.geometry, {});
  const Ref<ShapeExtra> extra = s.extra;
  if (isDeformed(s)) {
    Mesh mesh = deformedMesh(s, *unit, sides);
    if (!mesh.valid()) {
      s.geometry = geometry;
      return tooLarge(call);
    }
    s.geometry = {GeometryKind::Mesh, false, s.size, makeRef<Mesh>(std::move(mesh))};
    s.extra = {};
  } else {
    s.geometry = {GeometryKind::Mesh, false, {1, 1, 1}, unit};
  }
  call.services().leaf();
  s.geometry = geometry;
  s.extra = extra;
  return {};
}

Mesh placedBox(const Vec3& pivot) {
  return transformed(makeBoxMesh({1, 1, 1}, true), {1, 1, 1}, Frame::moved(-pivot));
}

struct BoxArguments : Wearing {
  double pivotX, pivotY, pivotZ;
  Axis far;
};

Status leaveBox(OpCall& call, const Vec3& pivot, Axis far) {
  Shape& s = call.shape();
  if (isDeformed(s)) {
    DeformedSides sides;
    sides.axis = static_cast<int>(far);
    sides.low = -pivot[sides.axis];
    sides.high = 1 - pivot[sides.axis];
    sides.hasTop = pivot == Vec3{0.5, 0.5, 0.5};
    sides.frontAxis = sides.hasTop ? 2 : sides.axis;
    return leaveMesh(call, makeRef<Mesh>(placedBox(pivot)), sides);
  }
  const Vec3 origin = s.scope.origin;
  s.scope.origin = s.scope.point(-scaled(pivot, s.size));
  Geometry geometry = std::exchange(s.geometry, Geometry{});
  s.geometry.kind = GeometryKind::Box;
  s.geometry.uv = true;
  call.services().leaf();
  s.geometry = std::move(geometry);
  s.scope.origin = origin;
  return {};
}

Status applyBox(OpCall& call, const BoxArguments& args) {
  Shape& s = call.shape();
  if (!isFinitePlace(s)) return tooLarge(call);
  const MaterialId material = s.material;
  wearTexture(call, args);
  Status status = leaveBox(call, {args.pivotX, args.pivotY, args.pivotZ}, args.far);
  s.material = material;
  return status;
}

constexpr uint32_t kRoundSides = 40, kRoundDivisions = 20;

Status leaveRound(OpCall& call, const Wearing& args, const MeshRef& unit, double low, double high) {
  Shape& s = call.shape();
  if (!isFinitePlace(s)) return tooLarge(call);
  const MaterialId material = s.material;
  wearTexture(call, args);
  DeformedSides sides;
  sides.low = low;
  sides.high = high;
  Status status = leaveMesh(call, unit, sides);
  s.material = material;
  return status;
}

Status applySphere(OpCall& call, const Wearing& args) {
  static const MeshRef kUnit = makeRef<Mesh>(
      transformed(makeSphere(kRoundSides, kRoundDivisions), {0.5, 0.5, 0.5}, Frame{}));
  return leaveRound(call, args, kUnit, -0.5, 0.5);
}

Status applyCylinder(OpCall& call, const Wearing& args) {
  static const MeshRef kUnit =
      makeRef<Mesh>(transformed(makeCylinder(kRoundSides), {0.5, 1, 0.5}, Frame{}));
  return leaveRound(call, args, kUnit, 0, 1);
}

constexpr ParamSpec kTexture = param<&Wearing::texture>(
    "texture", "Number of an image in the project's textures folder, or of a built-in one.",
    "none");
constexpr ParamSpec kQuarters =
    param<&Wearing::quarters>("quarters", "Quarter turns of the texture on each face.", "0");
constexpr ParamSpec kScale =
    param<&Wearing::scale>("scale", "Half the share of the texture that a face shows.", "0.125");
constexpr ParamSpec kBoxParams[] = {
    param<&BoxArguments::pivotX>("pivotX",
                                 "Where the scope's origin lies in the box: 0 left, 1 right."),
    param<&BoxArguments::pivotY>("pivotY", "0 at the bottom, 1 at the top."),
    param<&BoxArguments::pivotZ>("pivotZ", "0 at the back, 1 at the front."),
    param<&BoxArguments::far>("far", "The axis whose far side tapers."),
    kTexture,
    kQuarters,
    kScale,
};
constexpr ParamSpec kRoundParams[] = {kTexture, kQuarters, kScale};
constexpr Signature kBoxSignatures[] = {{kBoxParams}};
constexpr Signature kRoundSignatures[] = {{kRoundParams}};

constexpr OpSpec kSpecs[] = {
    {"affineBox", "affine", "Leaves a box of the scope's size about its origin and goes on.",
     kBoxSignatures, typed<applyBox>, BlockKind::None, kTakesDeformed, nullptr, false, true},
    {"affineSphere", "affine", "Leaves a ball of the scope's size about its origin and goes on.",
     kRoundSignatures, typed<applySphere>, BlockKind::None, kTakesDeformed, nullptr, false, true},
    {"affineCylinder", "affine",
     "Leaves an upright cylinder of the scope's size on its origin and goes on.", kRoundSignatures,
     typed<applyCylinder>, BlockKind::None, kTakesDeformed, nullptr, false, true},
};

}  // namespace

extern const OpList kOps_affine_bodies;
const OpList kOps_affine_bodies = kSpecs;

}  // namespace gable
