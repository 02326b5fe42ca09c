// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Move {
  Size x, y, z;
  Vec3 in(const Vec3& size) const { return {x.of(size.x), y.of(size.y), z.of(size.z)}; }
};

Status applyT(OpCall& call, const Move& args) {
  Shape& s = call.shape();
  s.scope.origin = s.scope.point(args.in(s.size));
  return {};
}

bool applyTLight(LightPart& part, const Move& args) {
  part.origin += part.parent->direction(args.in(part.size));
  return true;
}

struct Translate {
  Placing mode;
  CoordSystem system;
  double x, y, z;
};

Status applyTranslate(OpCall& call, const Translate& args) {
  Shape& s = call.shape();
  const Frame system = frameOf(args.system, s, call.services());
  const Vec3 v{args.x, args.y, args.z};
  if (args.mode == Placing::Abs)
    s.scope.origin = system.point(v);
  else
    s.scope.origin += system.direction(v);
  return {};
}

constexpr ParamSpec kTParams[] = {
    param<&Move::x>("tx", "Move along the scope's x axis, in metres or as a share of the size."),
    param<&Move::y>("ty", "Move along the scope's y axis."),
    param<&Move::z>("tz", "Move along the scope's z axis."),
};
constexpr Signature kTSignatures[] = {{kTParams}};

constexpr ParamSpec kTranslateParams[] = {
    param<&Translate::mode>("mode",
                            "rel adds the vector to the position of the scope; abs puts the origin "
                            "of the scope there."),
    param<&Translate::system>("coordSystem",
                              "The coordinate system that the vector is written in."),
    param<&Translate::x>("x", "Along the x axis of that system, in metres."),
    param<&Translate::y>("y", "Along its y axis."),
    param<&Translate::z>("z", "Along its z axis."),
};
constexpr Signature kTranslateSignatures[] = {{kTranslateParams}};

constexpr OpSpec kSpecs[] = {
    withLight({"t", "transform", "Moves the scope along its own axes.", kTSignatures, typed<applyT>,
               BlockKind::None, kIgnoresTags},
              typedLight<applyTLight>),
    {"translate", "transform",
     "Moves the scope by a vector, or to a place, in a coordinate system of choice.",
     kTranslateSignatures, typed<applyTranslate>, BlockKind::None,
     kReadsWorld | kReadsWorldByWord | kReadsPivot | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_translate_scope;
const OpList kOps_translate_scope = kSpecs;

}  // namespace gable
