// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Planar projections: setupProjection keeps one with the shape, in its local frame, so that it goes
// through splits; projectUV writes coordinates from it.

#include <algorithm>
#include <cmath>
#include <string>

#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/shared/frames.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Vec3 axisOf(const Frame& f, char name) { return name == 'x' ? f.x : name == 'y' ? f.y : f.z; }

size_t indexOf(char name) { return static_cast<size_t>(name - 'x'); }

// The size of a tile: absolute, a share of the scope, or as near to the number as makes whole
// tiles. A scope without extent says nothing.
double tileSize(const Size& v, double extent) {
  if (v.unit == Unit::Absolute || extent == 0) return v.number;
  if (v.unit == Unit::Relative) return v.number * extent;
  const double tiles = std::max(1.0, std::round(std::fabs(extent / v.number)));
  return std::copysign(extent / tiles, v.number);
}

struct Setup {
  double uvSet;
  Word axes{"scope.xy"};
  FloatingSize width, height;
  Size offsetU, offsetV;
  double uwFactor = 0;
};

Status applySetup(OpCall& call, const Setup& args) {
  Shape& s = call.shape();
  const auto set = static_cast<int>(args.uvSet);
  const std::string_view axes = args.axes.text;
  const size_t dot = axes.find('.');
  const char u = dot + 2 < axes.size() ? axes[dot + 1] : 0;
  const char v = dot + 2 < axes.size() ? axes[dot + 2] : 0;
  if (u < 'x' || u > 'z' || v < 'x' || v > 'z' || u == v) {
    return call.fail("unknown-selector",
                     "setupProjection knows no axes '" + std::string(axes) + "'",
                     "use two axes of the scope or the world, such as scope.xy");
  }
  const Frame system = axes.starts_with("world") ? worldFrame(call.services()) : s.scope;
  UvProjection p;
  p.set = set;
  const double wide = std::fabs(s.size[indexOf(u)]), high = std::fabs(s.size[indexOf(v)]);
  p.width = tileSize(args.width, wide);
  p.height = tileSize(args.height, high);
  if (!(std::fabs(p.width) > 0) || !(std::fabs(p.height) > 0) || !std::isfinite(p.width) ||
      !std::isfinite(p.height)) {
    return call.fail("bad-argument", "setupProjection cannot make tiles without a size",
                     "give the texture a width and a height");
  }
  const Vec3 x = axisOf(system, u), y = axisOf(system, v);
  p.frame = Frame::of(system.origin, x, y, cross(x, y));
  p.offsetU = args.offsetU.of(wide) / p.width;
  p.offsetV = args.offsetV.of(high) / p.height;
  p.uwFactor = args.uwFactor;
  ShapeExtra extra = extraOf(s);
  extra.setProjection(p);
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  return {};
}

// Coordinates of a point of the scope; exact zeros and ones come out as such where the projection
// spans the scope.
struct Projector {
  Vec3 u, v;
  double u0, v0;

  Projector(const UvProjection& p, const Frame& scope) {
    const auto row = [&](const Vec3& axis, double size, double offset, Vec3& direction) {
      direction = scope.toLocalDirection(axis) * (1 / size);
      return dot(scope.origin - p.frame.origin, axis) / size + offset;
    };
    u0 = row(p.frame.x + p.frame.z * p.uwFactor, p.width, p.offsetU, u);
    v0 = row(p.frame.y, p.height, p.offsetV, v);
  }
  Vec2 at(const Vec3& p) const { return {dot(u, p) + u0, dot(v, p) + v0}; }
};

// True when a rectangle gets just the coordinates that it carries as a primitive.
bool givesPlainUv(const Shape& s, int set, const Projector& projector) {
  const GeometryKind kind = s.geometry.kind;
  if (set != 0 || (kind != GeometryKind::QuadXy && kind != GeometryKind::QuadXz)) return false;
  const double x = s.size.x, y = s.size.y, z = s.size.z;
  const bool xy = kind == GeometryKind::QuadXy;
  const Vec3 corners[4] = {xy ? Vec3{0, 0, 0} : Vec3{0, 0, z}, xy ? Vec3{x, 0, 0} : Vec3{x, 0, z},
                           xy ? Vec3{x, y, 0} : Vec3{x, 0, 0}, xy ? Vec3{0, y, 0} : Vec3{0, 0, 0}};
  const Vec2 plain[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (size_t i = 0; i < 4; ++i) {
    const Vec2 off = projector.at(corners[i]) - plain[i];
    if (std::fabs(off.x) > 1e-9 || std::fabs(off.y) > 1e-9) return false;
  }
  return true;
}

struct Project {
  double uvSet;
};

Status applyProject(OpCall& call, const Project& args) {
  Shape& s = call.shape();
  const auto set = static_cast<int>(args.uvSet);
  const size_t layer = static_cast<size_t>(set);
  const UvProjection* found = s.extra ? s.extra->projection(set) : nullptr;
  if (!found) {
    return call.fail("no-projection",
                     "projectUV(" + std::to_string(set) + ") has no projection to write",
                     "call setupProjection for this uv set before");
  }
  if (s.geometry.kind == GeometryKind::None) return {};
  const UvProjection projection = *found;
  const Projector projector(projection, s.scope);
  if (givesPlainUv(s, set, projector)) {
    s.geometry.uv = true;
    s.geometry.instanced = false;
    return {};
  }
  const bool isMesh = s.geometry.kind == GeometryKind::Mesh;
  const MeshRef placed = meshInScope(s);
  Mesh mesh = isMesh ? *s.geometry.mesh : *placed;
  std::vector<Vec2>& uvs = mesh.uvs[layer];
  uvs.resize(mesh.corners.size());
  // A mirrored mesh has its corners in another order when placed; its positions have not.
  for (size_t c = 0; c < mesh.corners.size(); ++c) {
    uvs[c] = projector.at(placed->positions[mesh.corners[c]]);
  }
  s.geometry = {GeometryKind::Mesh, false, isMesh ? s.geometry.refSize : s.size,
                makeRef<Mesh>(std::move(mesh))};
  return {};
}

constexpr const char* kSetDoc = "The uv set, 0 to 9, which is the texture layer that uses it.";
constexpr ParamSpec kSet = param<&Setup::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1);
constexpr ParamSpec kAxes = param<&Setup::axes>(
    "axes", "Where u and v run: two axes of the scope from its origin, or of the world from its.",
    nullptr,
    "scope.xy scope.xz scope.yx scope.yz scope.zx scope.zy world.xy world.xz world.yx world.yz "
    "world.zx world.zy");
constexpr ParamSpec kWidth = param<&Setup::width>(
    "textureWidth",
    "Width of a tile in metres; with ' as a share of the scope, with ~ about that wide so that "
    "whole tiles fit; negative ones mirror.");
constexpr ParamSpec kHeight = param<&Setup::height>("textureHeight", "Height of a tile, likewise.");
constexpr ParamSpec kOffsetU = param<&Setup::offsetU>(
    "widthOffset", "Shift along u, in metres; with ' as a share of the scope.");
constexpr ParamSpec kOffsetV = param<&Setup::offsetV>("heightOffset", "Shift along v, likewise.");
constexpr ParamSpec kFactor = param<&Setup::uwFactor>(
    "uwFactor", "How much depth counts as u, to bend textures around corners.");
constexpr ParamSpec kPlainParams[] = {kSet, kAxes, kWidth, kHeight};
// The old form has the factor in the fifth place.
constexpr ParamSpec kOldFactorParams[] = {kSet, kAxes, kWidth, kHeight, kFactor};
constexpr ParamSpec kOffsetParams[] = {kSet, kAxes, kWidth, kHeight, kOffsetU, kOffsetV};
constexpr ParamSpec kFactorParams[] = {kSet, kAxes, kWidth, kHeight, kOffsetU, kOffsetV, kFactor};
constexpr Signature kSetupSignatures[] = {
    {kPlainParams}, {kOldFactorParams}, {kOffsetParams}, {kFactorParams}};
// setupUV had no choice of axes at first.
constexpr ParamSpec kNoAxesParams[] = {kSet, kWidth, kHeight};
constexpr ParamSpec kNoAxesFactorParams[] = {kSet, kWidth, kHeight, kFactor};
constexpr Signature kOldSetupSignatures[] = {{kPlainParams},  {kOldFactorParams},
                                             {kOffsetParams}, {kFactorParams},
                                             {kNoAxesParams}, {kNoAxesFactorParams}};

constexpr ParamSpec kProjectParams[] = {
    param<&Project::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1)};
constexpr Signature kProjectSignatures[] = {{kProjectParams}};

constexpr OpSpec kSpecs[] = {
    {"setupProjection", "uv",
     "Prepares a planar projection of a texture, which this shape and its parts keep.",
     kSetupSignatures, typed<applySetup>, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kIgnoresTags},
    {"setupUV", "uv", "Old name of setupProjection.", kOldSetupSignatures, typed<applySetup>,
     BlockKind::None, kReadsWorld | kReadsWorldByWord | kIgnoresTags, kNoParts, false, true},
    {"bakeUV", "uv", "Old name of projectUV.", kProjectSignatures, typed<applyProject>,
     BlockKind::None, kReadsUvProjection | kIgnoresTags, kNoParts, false, true},
    {"projectUV", "uv", "Writes texture coordinates from the prepared projection.",
     kProjectSignatures, typed<applyProject>, BlockKind::None, kReadsUvProjection | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_projection;
const OpList kOps_projection = kSpecs;

}  // namespace gable
