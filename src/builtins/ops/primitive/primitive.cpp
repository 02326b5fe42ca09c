// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A primitive without sizes fills the scope; with sizes it stands in the middle of the scope's
// ground (its xz plane), and the scope becomes its bounding box. Flat ones lie in the plane of the
// two sizes that the scope has.

#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/shared/insert.h"
#include "builtins/ops/shared/trim.h"
#include "geom/primitive/solids.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The plane of a flat primitive.
enum class FlatPlane { Xz, Xy, Yz };

FlatPlane planeOf(const Vec3& size) {
  if (size.x == 0 && size.y != 0 && size.z != 0) return FlatPlane::Yz;
  if (size.z == 0 && size.x != 0 && size.y != 0) return FlatPlane::Xy;
  return FlatPlane::Xz;
}

// Gives a flat primitive a size of its own in the middle of its plane.
void centerInPlane(Shape& s, FlatPlane plane, double w, double l) {
  w = std::fabs(w);
  l = std::fabs(l);
  const Vec3 size = plane == FlatPlane::Xz   ? Vec3{w, 0, l}
                    : plane == FlatPlane::Xy ? Vec3{w, l, 0}
                                             : Vec3{0, w, l};
  const Vec3 off = (s.size - size) * 0.5;
  s.scope.origin =
      s.scope.point({plane == FlatPlane::Yz ? 0 : off.x, plane == FlatPlane::Xz ? 0 : off.y,
                     plane == FlatPlane::Xy ? 0 : off.z});
  s.size = size;
}

// Turns a mesh of the plane y = 0 into another plane: the picture stays upright and the face looks
// along the third axis.
Mesh inPlane(const Mesh& m, FlatPlane plane) {
  if (plane == FlatPlane::Xy) return transformed(m, {1, 1, 1}, rotationXyz(90, 0, 0));
  if (plane == FlatPlane::Yz) return transformed(m, {1, 1, 1}, rotationXyz(90, 90, 0));
  return m;
}

Status applyCube(OpCall& call) {
  Shape& s = call.shape();
  if (call.argCount() == 3) {
    centerOnGround(s, {call.number(0), call.number(1), call.number(2)});
  } else {
    fillZeroSizes(s, kUnitBox);
  }
  insertBox(s, true);
  return {};
}

bool applyCubeLight(LightPart& part, std::span<const Value> args) {
  const bool solid = part.size.x > 0 && part.size.y > 0 && part.size.z > 0;
  if (!args.empty() || !solid || (part.trim && reachesTrimPlane(part))) return false;
  part.kind = GeometryKind::Box;
  part.uv = true;
  return true;
}

Status applyQuad(OpCall& call) {
  Shape& s = call.shape();
  const FlatPlane plane = planeOf(s.size);
  if (call.argCount() == 2) {
    centerInPlane(s, plane, call.number(0), call.number(1));
  } else {
    const Vec3 flat{plane == FlatPlane::Yz ? 0.0 : 1.0, plane == FlatPlane::Xz ? 0.0 : 1.0,
                    plane == FlatPlane::Xy ? 0.0 : 1.0};
    fillZeroSizes(s, {{0, 0, 0}, flat});
  }
  const bool positive = s.size.x >= 0 && s.size.y >= 0 && s.size.z >= 0;
  if (positive && plane != FlatPlane::Yz) {
    insertPrimitive(s, plane == FlatPlane::Xy ? GeometryKind::QuadXy : GeometryKind::QuadXz, true);
    return {};
  }
  const Mesh mesh = inPlane(makeQuadMesh(1, 1, QuadPlane::Xz, true), plane);
  insertMesh(s, mesh, mesh.bounds());
  return {};
}

// How many sides an argument asks for; fails below `least` and where a mistake is plain.
Status countOf(const OpCall& call, size_t argument, uint32_t otherwise, uint32_t least,
               const char* what, uint32_t& count) {
  count = otherwise;
  if (!call.has(argument)) return {};
  const double v = call.number(argument);
  if (!(v >= least && v <= kMaxSolidFaces)) {
    return call.fail("bad-argument",
                     std::string(call.spec().name) + " cannot have " + numberText(v) + " " + what,
                     "use " + std::to_string(least) + " or more");
  }
  count = static_cast<uint32_t>(v);
  return {};
}

Status applyDisk(OpCall& call) {
  Shape& s = call.shape();
  uint32_t sides = 0;
  if (Status bad = countOf(call, 0, 16, 3, "vertices", sides); !bad) return bad;
  const FlatPlane plane = planeOf(s.size);
  Mesh mesh = inPlane(makeDisk(sides), plane);
  const Box3 box = mesh.bounds();
  if (call.argCount() == 2) {
    const Vec3 size = box.size() * std::fabs(call.number(1));
    centerInPlane(s, plane, plane == FlatPlane::Yz ? size.y : size.x,
                  plane == FlatPlane::Xy ? size.y : size.z);
  } else {
    fillZeroSizes(s, {{0, 0, 0}, box.size() * 0.5});
  }
  insertMesh(s, std::move(mesh), box);
  return {};
}

// Puts a round body into the scope: `unit` has radius 1; sizes are written when `sized`.
void insertRound(Shape& s, Mesh unit, bool sized, double radius, double height) {
  const Box3 box = unit.bounds();
  const Vec3 size = box.size();
  if (sized)
    centerOnGround(s, {size.x * radius, size.y * height, size.z * radius});
  else
    fillZeroSizes(s, kUnitBox);
  insertMesh(s, std::move(unit), box);
}

Status applySphere(OpCall& call) {
  uint32_t sides = 0, divisions = 0;
  if (Status bad = countOf(call, 0, 16, 3, "sides", sides); !bad) return bad;
  if (Status bad = countOf(call, 1, 16, 2, "divisions", divisions); !bad) return bad;
  if (uint64_t{sides} * divisions > kMaxSolidFaces) {
    return call.fail("bad-argument", "primitiveSphere would have too many faces",
                     "use fewer sides and divisions");
  }
  const double radius = call.number(2, 0);
  insertRound(call.shape(), makeSphere(sides, divisions), call.has(2), radius, std::fabs(radius));
  return {};
}

Status applyCylinder(OpCall& call) {
  uint32_t sides = 0;
  if (Status bad = countOf(call, 0, 16, 3, "sides", sides); !bad) return bad;
  insertRound(call.shape(), makeCylinder(sides), call.argCount() == 3, call.number(1, 0),
              call.number(2, 0));
  return {};
}

Status applyCone(OpCall& call) {
  uint32_t sides = 0;
  if (Status bad = countOf(call, 0, 16, 3, "sides", sides); !bad) return bad;
  insertRound(call.shape(), makeCone(sides), call.argCount() == 3, call.number(1, 0),
              call.number(2, 0));
  return {};
}

constexpr ParamSpec kCubeParams[] = {
    {"width", ParamType::Float, "Size along x, in metres."},
    {"height", ParamType::Float, "Size along y; a negative one stands below the ground."},
    {"depth", ParamType::Float, "Size along z."},
};
constexpr Signature kCubeSignatures[] = {{}, {kCubeParams}};

constexpr ParamSpec kQuadParams[] = {
    {"width", ParamType::Float, "Size along the first axis of the plane, in metres."},
    {"length", ParamType::Float, "Size along its second axis."},
};
constexpr Signature kQuadSignatures[] = {{}, {kQuadParams}};

constexpr ParamSpec kSides = {"sides", ParamType::Float, "Faces around the axis, 3 or more.", "16"};
constexpr ParamSpec kRadius = {"radius", ParamType::Float, "Radius in metres."};
constexpr ParamSpec kHeight = {"height", ParamType::Float,
                               "Height in metres; a negative one stands below the ground."};

constexpr ParamSpec kDiskParams[] = {
    {"nVertices", ParamType::Float, "Points on the rim, 3 or more.", "16"}};
constexpr ParamSpec kDiskRadiusParams[] = {kDiskParams[0], kRadius};
constexpr Signature kDiskSignatures[] = {{kDiskParams}, {kDiskRadiusParams}};

constexpr ParamSpec kDivisions = {"divisions", ParamType::Float,
                                  "Rings of faces from pole to pole, 2 or more."};
constexpr ParamSpec kSphereSides = {"sides", ParamType::Float, "Faces around the axis, 3 or more."};
constexpr ParamSpec kSphereParams[] = {kSphereSides, kDivisions};
constexpr ParamSpec kSphereRadiusParams[] = {kSphereSides, kDivisions, kRadius};
constexpr Signature kSphereSignatures[] = {{}, {kSphereParams}, {kSphereRadiusParams}};

constexpr ParamSpec kRoundParams[] = {kSides};
constexpr ParamSpec kRoundSizedParams[] = {
    {"sides", ParamType::Float, "Faces around the axis, 3 or more."}, kRadius, kHeight};
constexpr Signature kRoundSignatures[] = {{kRoundParams}, {kRoundSizedParams}};

constexpr OpSpec kSpecs[] = {
    {"primitiveQuad", "primitive", "Replaces the geometry by a rectangle.", kQuadSignatures,
     applyQuad, BlockKind::None, kUsesTrim},
    {"primitiveDisk", "primitive", "Replaces the geometry by a disk.", kDiskSignatures, applyDisk,
     BlockKind::None, kUsesTrim},
    withLight({"primitiveCube", "primitive", "Replaces the geometry by a box.", kCubeSignatures,
               applyCube, BlockKind::None, kUsesTrim},
              applyCubeLight),
    {"primitiveSphere", "primitive", "Replaces the geometry by a sphere.", kSphereSignatures,
     applySphere, BlockKind::None, kUsesTrim},
    {"primitiveCylinder", "primitive", "Replaces the geometry by an upright cylinder.",
     kRoundSignatures, applyCylinder, BlockKind::None, kUsesTrim},
    {"primitiveCone", "primitive", "Replaces the geometry by an upright cone.", kRoundSignatures,
     applyCone, BlockKind::None, kUsesTrim},
};

}  // namespace

extern const OpList kOps_primitive;
const OpList kOps_primitive = kSpecs;

}  // namespace gable
