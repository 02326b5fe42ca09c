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
#include "program/tag_effects.h"
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

// Without sizes all three are missing.
struct Cube {
  std::optional<double> width, height, depth;
};

Status applyCube(OpCall& call, const Cube& args) {
  Shape& s = call.shape();
  if (args.width) {
    centerOnGround(s, {*args.width, *args.height, *args.depth});
  } else {
    fillZeroSizes(s, kUnitBox);
  }
  insertBox(s, true);
  return {};
}

bool applyCubeLight(LightPart& part, const Cube& args) {
  const bool solid = part.size.x > 0 && part.size.y > 0 && part.size.z > 0;
  if (args.width || !solid || (part.trim && reachesTrimPlane(part))) return false;
  part.kind = GeometryKind::Box;
  part.uv = true;
  return true;
}

struct Quad {
  std::optional<double> width, length;
};

Status applyQuad(OpCall& call, const Quad& args) {
  Shape& s = call.shape();
  const FlatPlane plane = planeOf(s.size);
  if (args.width) {
    centerInPlane(s, plane, *args.width, *args.length);
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

struct Disk {
  double sides;
  std::optional<double> radius;
};

Status applyDisk(OpCall& call, const Disk& args) {
  Shape& s = call.shape();
  const auto sides = static_cast<uint32_t>(args.sides);
  const FlatPlane plane = planeOf(s.size);
  Mesh mesh = inPlane(makeDisk(sides), plane);
  const Box3 box = mesh.bounds();
  if (args.radius) {
    const Vec3 size = box.size() * std::fabs(*args.radius);
    centerInPlane(s, plane, plane == FlatPlane::Yz ? size.y : size.x,
                  plane == FlatPlane::Xy ? size.y : size.z);
  } else {
    fillZeroSizes(s, {{0, 0, 0}, box.size() * 0.5});
  }
  insertMesh(s, std::move(mesh), box);
  return {};
}

// Puts a round body into the scope: `unit` has radius 1 and fills the scope when none is given.
void insertRound(Shape& s, Mesh unit, const std::optional<double>& radius, double height) {
  const Box3 box = unit.bounds();
  const Vec3 size = box.size();
  if (radius)
    centerOnGround(s, {size.x * *radius, size.y * height, size.z * *radius});
  else
    fillZeroSizes(s, kUnitBox);
  insertMesh(s, std::move(unit), box);
}

struct Sphere {
  double sides = 16, divisions = 16;
  std::optional<double> radius;
};

Status applySphere(OpCall& call, const Sphere& args) {
  const auto sides = static_cast<uint32_t>(args.sides);
  const auto divisions = static_cast<uint32_t>(args.divisions);
  if (uint64_t{sides} * divisions > kMaxSolidFaces) {
    return call.fail("bad-argument", "primitiveSphere would have too many faces",
                     "use fewer sides and divisions");
  }
  insertRound(call.shape(), makeSphere(sides, divisions), args.radius,
              std::fabs(args.radius.value_or(0)));
  return {};
}

struct Round {
  double sides;
  std::optional<double> radius;
  double height = 0;
};

Status applyCylinder(OpCall& call, const Round& args) {
  const auto sides = static_cast<uint32_t>(args.sides);
  insertRound(call.shape(), makeCylinder(sides), args.radius, args.height);
  return {};
}

Status applyCone(OpCall& call, const Round& args) {
  const auto sides = static_cast<uint32_t>(args.sides);
  insertRound(call.shape(), makeCone(sides), args.radius, args.height);
  return {};
}

constexpr ParamSpec kCubeParams[] = {
    param<&Cube::width>("width", "Size along x, in metres."),
    param<&Cube::height>("height", "Size along y; a negative one stands below the ground."),
    param<&Cube::depth>("depth", "Size along z."),
};
constexpr Signature kCubeSignatures[] = {{}, {kCubeParams}};

constexpr ParamSpec kQuadParams[] = {
    param<&Quad::width>("width", "Size along the first axis of the plane, in metres."),
    param<&Quad::length>("length", "Size along its second axis."),
};
constexpr Signature kQuadSignatures[] = {{}, {kQuadParams}};

constexpr const char* kSidesDoc = "Faces around the axis.";
constexpr const char* kRadiusDoc = "Radius in metres.";

constexpr ParamSpec kDiskParams[] = {
    param<&Disk::sides>("nVertices", "Points on the rim.", "16").between(3, kMaxSolidFaces),
    param<&Disk::radius>("radius", kRadiusDoc),
};
constexpr Signature kDiskSignatures[] = {{std::span(kDiskParams).first(1)}, {kDiskParams}};

constexpr ParamSpec kSphereParams[] = {
    param<&Sphere::sides>("sides", kSidesDoc).between(3, kMaxSolidFaces),
    param<&Sphere::divisions>("divisions", "Rings of faces from pole to pole.")
        .between(2, kMaxSolidFaces),
    param<&Sphere::radius>("radius", kRadiusDoc),
};
constexpr Signature kSphereSignatures[] = {
    {}, {std::span(kSphereParams).first(2)}, {kSphereParams}};

constexpr ParamSpec kRoundParams[] = {
    param<&Round::sides>("sides", kSidesDoc, "16").between(3, kMaxSolidFaces)};
constexpr ParamSpec kRoundSizedParams[] = {
    param<&Round::sides>("sides", kSidesDoc).between(3, kMaxSolidFaces),
    param<&Round::radius>("radius", kRadiusDoc),
    param<&Round::height>("height", "Height in metres; a negative one stands below the ground."),
};
constexpr Signature kRoundSignatures[] = {{kRoundParams}, {kRoundSizedParams}};

constexpr OpSpec kSpecs[] = {
    {"primitiveQuad", "primitive", "Replaces the geometry by a rectangle.", kQuadSignatures,
     typed<applyQuad>, BlockKind::None, kUsesTrim | kIgnoresTags},
    {"primitiveDisk", "primitive", "Replaces the geometry by a disk.", kDiskSignatures,
     typed<applyDisk>, BlockKind::None, kUsesTrim | kIgnoresTags},
    withLight({"primitiveCube", "primitive", "Replaces the geometry by a box.", kCubeSignatures,
               typed<applyCube>, BlockKind::None, kUsesTrim | kIgnoresTags},
              typedLight<applyCubeLight>),
    {"primitiveSphere", "primitive", "Replaces the geometry by a sphere.", kSphereSignatures,
     typed<applySphere>, BlockKind::None, kUsesTrim | kIgnoresTags},
    {"primitiveCylinder", "primitive", "Replaces the geometry by an upright cylinder.",
     kRoundSignatures, typed<applyCylinder>, BlockKind::None, kUsesTrim | kIgnoresTags},
    {"primitiveCone", "primitive", "Replaces the geometry by an upright cone.", kRoundSignatures,
     typed<applyCone>, BlockKind::None, kUsesTrim | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_primitive;
const OpList kOps_primitive = kSpecs;

}  // namespace gable
