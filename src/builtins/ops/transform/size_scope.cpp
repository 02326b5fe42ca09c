// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The geometry follows the scope by itself: primitives fill it, meshes remember the size they were
// made for. So a size of zero flattens and a later one raises the same geometry again, and what was
// flat from the start stays flat.

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyS(OpCall& call) {
  Shape& s = call.shape();
  resizeScope(s, {call.sized(0, s.size.x), call.sized(1, s.size.y), call.sized(2, s.size.z)});
  return {};
}

bool applySLight(LightPart& part, std::span<const Value> args) {
  Vec3 size;
  for (size_t i = 0; i < 3; ++i) {
    size[i] = args[i].unit == Unit::Relative ? args[i].number * part.size[i] : args[i].number;
    if (!(size[i] >= 0)) return false;
  }
  part.size = size + Vec3{};
  return true;
}

constexpr ParamSpec kParams[] = {
    {"xSize", ParamType::Size,
     "New size along the scope's x axis; ' takes a share of the old one."},
    {"ySize", ParamType::Size, "New size along the y axis."},
    {"zSize", ParamType::Size, "New size along the z axis."},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    withLight({"s", "transform", "Sets the size of the scope; the geometry is scaled with it.",
               kSignatures, applyS},
              applySLight),
};

}  // namespace

extern const OpList kOps_size_scope;
const OpList kOps_size_scope = kSpecs;

}  // namespace gable
