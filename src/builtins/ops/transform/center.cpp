// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Center {
  Word axes;
};

Status applyCenter(OpCall& call, const Center& args) {
  Shape& s = call.shape();
  const Frame& around = call.previousScope();
  const Vec3 off = call.previousSize() * 0.5 - around.toLocal(s.scope.point(s.size * 0.5));
  Vec3 by;
  for (const char c : args.axes.text) {
    if (c == 'x') by.x = off.x;
    if (c == 'y') by.y = off.y;
    if (c == 'z') by.z = off.z;
  }
  s.scope.origin += around.direction(by);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Center::axes>("axes", "The axes to centre along; on the others the scope stays.",
                         nullptr, "x y z xy xz yz xyz"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"center", "transform",
     "Moves the scope to the middle of the scope below on the shape stack, the one that the rule "
     "or bracket began with.",
     kSignatures, typed<applyCenter>, BlockKind::None, kReadsPrevious | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_center;
const OpList kOps_center = kSpecs;

}  // namespace gable
