// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A mirrored axis is a negative size: the scope's origin goes to the other end, and what is fitted
// into the scope from then on (an asset, a primitive) comes out mirrored.

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Flips {
  bool x, y, z;
};

Status applyMirrorScope(OpCall& call, const Flips& args) {
  Shape& s = call.shape();
  const bool flip[3] = {args.x, args.y, args.z};
  if (!flip[0] && !flip[1] && !flip[2]) return {};
  const Vec3 by{flip[0] ? s.size.x : 0, flip[1] ? s.size.y : 0, flip[2] ? s.size.z : 0};
  const GeometryKind kind = s.geometry.kind;
  Mesh mesh;
  if (kind != GeometryKind::None) mesh = transformed(*meshInScope(s), {1, 1, 1}, Frame::moved(-by));
  s.scope.origin = s.scope.point(by);
  for (size_t i = 0; i < 3; ++i) {
    if (flip[i]) s.size[i] = -s.size[i];
  }
  if (kind != GeometryKind::None) setMesh(s, std::move(mesh), ScopeFit::Keep);
  return {};
}

// Each mirrored axis is turned round within the scope; faces keep looking outward.
Status applyMirror(OpCall& call, const Flips& args) {
  Shape& s = call.shape();
  const bool flip[3] = {args.x, args.y, args.z};
  Vec3 scale{1, 1, 1}, by;
  for (size_t i = 0; i < 3; ++i) {
    if (!flip[i]) continue;
    scale[i] = -1;
    by[i] = s.size[i];
  }
  if (s.geometry.kind == GeometryKind::None || by == Vec3{}) return {};
  setMesh(s, transformed(*meshInScope(s), scale, Frame::moved(by)), ScopeFit::Keep);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Flips::x>("xFlip", "Whether the x axis turns round."),
    param<&Flips::y>("yFlip", "Whether the y axis turns round."),
    param<&Flips::z>("zFlip", "Whether the z axis turns round."),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"mirrorScope", "scope", "Turns axes of the scope round and leaves the geometry as it is.",
     kSignatures, typed<applyMirrorScope>},
    {"mirror", "scope", "Mirrors the geometry within the scope, which stays.", kSignatures,
     typed<applyMirror>},
};

}  // namespace

extern const OpList kOps_mirror_scope;
const OpList kOps_mirror_scope = kSpecs;

}  // namespace gable
