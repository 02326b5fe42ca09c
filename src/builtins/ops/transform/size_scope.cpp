// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The geometry follows the scope by itself: primitives fill it, meshes remember the size they were
// made for. So a size of zero flattens and a later one raises the same geometry again, and what was
// flat from the start stays flat.

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Sizes {
  Size x, y, z;
  Vec3 of(const Vec3& old) const { return {x.of(old.x), y.of(old.y), z.of(old.z)}; }
};

Status applyS(OpCall& call, const Sizes& args) {
  Shape& s = call.shape();
  resizeScope(s, args.of(s.size));
  return {};
}

bool applySLight(LightPart& part, const Sizes& args) {
  const Vec3 size = args.of(part.size);
  if (!(size.x >= 0 && size.y >= 0 && size.z >= 0)) return false;
  part.size = size + Vec3{};
  return true;
}

constexpr ParamSpec kParams[] = {
    param<&Sizes::x>("xSize", "New size along the scope's x axis; ' takes a share of the old one."),
    param<&Sizes::y>("ySize", "New size along the y axis."),
    param<&Sizes::z>("zSize", "New size along the z axis."),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    withLight({"s", "transform", "Sets the size of the scope; the geometry is scaled with it.",
               kSignatures, typed<applyS>, BlockKind::None, kIgnoresTags},
              typedLight<applySLight>),
};

}  // namespace

extern const OpList kOps_size_scope;
const OpList kOps_size_scope = kSpecs;

}  // namespace gable
