// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Bodies that are left on the way: the shape goes on as it was. A box that is not deformed stays a
// primitive, and nothing is allocated for it.

#include <utility>

#include "base/allowance.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/numbered_texture.h"
#include "geom/mesh/topology.h"
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

// A box whose corners on the far side of x, then of y, then of z are scaled and moved.
struct SidedBoxArguments {
  double pivotX, pivotY, pivotZ;
  Floats scaleX, moveX, scaleY, moveY, scaleZ, moveZ;
};

Status applySidedBox(OpCall& call, const SidedBoxArguments& args) {
  if (!isFinitePlace(call.shape())) return tooLarge(call);
  const Floats* lists[] = {&args.scaleX, &args.moveX,  &args.scaleY,
                           &args.moveY,  &args.scaleZ, &args.moveZ};
  Vec3 sides[6];
  for (size_t k = 0; k < 6; ++k) {
    const std::vector<double>& n = lists[k]->array->numbers;
    if (n.size() != 3) {
      return call.fail("bad-argument", "affineSidedBox takes three numbers for each side",
                       "write [1, 1, 1] for factors that change nothing, [0, 0, 0] for moves");
    }
    sides[k] = {n[0], n[1], n[2]};
  }
  const Vec3 pivot{args.pivotX, args.pivotY, args.pivotZ};
  Mesh box = placedBox(pivot);
  for (Vec3& p : box.positions) {
    const Vec3 corner = p;
    for (size_t axis = 0; axis < 3; ++axis) {
      if (corner[axis] <= 0.5 - pivot[axis]) continue;
      p = scaled(p, sides[2 * axis]) + sides[2 * axis + 1];
    }
  }
  Mesh flat = flatFaces(box);
  if (!flat.valid()) return tooLarge(call);
  if (volume(flat) < 0) {
    for (size_t f = 0; f < flat.faceCount(); ++f) reverseFace(flat, f);
  }
  DeformedSides sidesOfTaper;
  sidesOfTaper.low = -pivot.y;
  sidesOfTaper.high = 1 - pivot.y;
  return leaveMesh(call, makeRef<Mesh>(std::move(flat)), sidesOfTaper);
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
  static const MeshRef kUnit = [] {
    const UncountedWork uncounted;
    return makeRef<Mesh>(
        transformed(makeSphere(kRoundSides, kRoundDivisions), {0.5, 0.5, 0.5}, Frame{}));
  }();
  return leaveRound(call, args, kUnit, -0.5, 0.5);
}

Status applyCylinder(OpCall& call, const Wearing& args) {
  static const MeshRef kUnit = [] {
    const UncountedWork uncounted;
    return makeRef<Mesh>(transformed(makeCylinder(kRoundSides), {0.5, 1, 0.5}, Frame{}));
  }();
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
constexpr ParamSpec kSidedParams[] = {
    param<&SidedBoxArguments::pivotX>("pivotX", "As in affineBox."),
    param<&SidedBoxArguments::pivotY>("pivotY", "As in affineBox."),
    param<&SidedBoxArguments::pivotZ>("pivotZ", "As in affineBox."),
    param<&SidedBoxArguments::scaleX>("scaleX", "Factors of the corners on the far side of x."),
    param<&SidedBoxArguments::moveX>("moveX", "Their moves, in shares of the size."),
    param<&SidedBoxArguments::scaleY>("scaleY", "The same for the far side of y."),
    param<&SidedBoxArguments::moveY>("moveY", "Their moves."),
    param<&SidedBoxArguments::scaleZ>("scaleZ", "The same for the far side of z."),
    param<&SidedBoxArguments::moveZ>("moveZ", "Their moves."),
};
constexpr ParamSpec kRoundParams[] = {kTexture, kQuarters, kScale};
constexpr Signature kBoxSignatures[] = {{kBoxParams}};
constexpr Signature kSidedSignatures[] = {{kSidedParams}};
constexpr Signature kRoundSignatures[] = {{kRoundParams}};

constexpr OpSpec kSpecs[] = {
    {"affineBox", "affine", "Leaves a box of the scope's size about its origin and goes on.",
     kBoxSignatures, typed<applyBox>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
    {"affineSidedBox", "affine",
     "Leaves a box whose corners on the far sides of its axes are scaled and moved, and goes on.",
     kSidedSignatures, typed<applySidedBox>, BlockKind::None, kTakesDeformed, kNoParts, false,
     true},
    {"affineSphere", "affine", "Leaves a ball of the scope's size about its origin and goes on.",
     kRoundSignatures, typed<applySphere>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
    {"affineCylinder", "affine",
     "Leaves an upright cylinder of the scope's size on its origin and goes on.", kRoundSignatures,
     typed<applyCylinder>, BlockKind::None, kTakesDeformed, kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_affine_bodies;
const OpList kOps_affine_bodies = kSpecs;

}  // namespace gable
