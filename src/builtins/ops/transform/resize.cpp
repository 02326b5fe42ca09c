// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A box and a rectangle become each other here, so sizes of zero are no accident: what is left of a
// box is one of its faces, with the axes that comp would give it.

#include <algorithm>

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "builtins/ops/shared/quarter_turn.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Mode : uint8_t { Add, Set, Multiply };
enum class Anchor : uint8_t { Origin, Center, Front };

}  // namespace

template <>
struct WordsOf<Mode> {
  static constexpr const char* text = "add set multiply";
};
template <>
struct WordsOf<Anchor> {
  static constexpr const char* text = "origin center front";
};

namespace {

struct Resize {
  Mode mode;
  Size x, y, z;
  Anchor anchor;
};

double newLength(Mode mode, const Size& given, double old) {
  const double v = mode == Mode::Multiply ? given.number * old
                   : mode == Mode::Add    ? given.of(old) + old
                                          : given.of(old);
  return std::max(0.0, v);
}

// The place in a scope of this size that stays where it is.
Vec3 anchorIn(const Vec3& size, Anchor anchor) {
  if (anchor == Anchor::Center) return size * 0.5;
  return anchor == Anchor::Front ? Vec3{0, 0, size.z} : Vec3{};
}

bool isPrimitive(const Geometry& g) {
  return g.kind == GeometryKind::Box || g.kind == GeometryKind::QuadXy ||
         g.kind == GeometryKind::QuadXz;
}

// A rectangle in the scope, whose size is zero along one axis: that axis becomes z.
void flatten(Shape& s) {
  s.geometry = {};
  if (s.size.x == 0) turnScope(s, quarterTurn(1, 1));
  if (s.size.y == 0) turnScope(s, quarterTurn(0, -1));
  s.geometry = primitive(GeometryKind::QuadXy);
}

Status applyResize(OpCall& call, const Resize& args) {
  Shape& s = call.shape();
  const Vec3 size{newLength(args.mode, args.x, s.size.x), newLength(args.mode, args.y, s.size.y),
                  newLength(args.mode, args.z, s.size.z)};
  if (!isFinite(size)) {
    return call.fail("bad-argument", "a size is not a finite number",
                     "check the expression for a division by zero");
  }
  const bool primitive = isPrimitive(s.geometry);
  const int zeros = (size.x == 0) + (size.y == 0) + (size.z == 0);
  if (primitive && zeros > 1) {
    return call.fail("resize-flat", "a shape needs a size along two axes at least",
                     "let two of the three sizes be more than zero");
  }
  s.scope.origin = s.scope.point(anchorIn(s.size, args.anchor) - anchorIn(size, args.anchor));
  if (!primitive) {
    resizeScope(s, size);
    return {};
  }
  const bool flatBefore = s.size.x == 0 || s.size.y == 0 || s.size.z == 0;
  const bool lies = s.geometry.kind == GeometryKind::QuadXz && size.y == 0;
  s.size = size;
  if (zeros == 0 && s.geometry.kind != GeometryKind::Box)
    s.geometry = gable::primitive(GeometryKind::Box);
  if (zeros == 1 && !lies &&
      !(flatBefore && s.geometry.kind == GeometryKind::QuadXy && size.z == 0)) {
    flatten(s);
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Resize::mode>("mode", "add to the sizes, set them, or multiply them."),
    param<&Resize::x>("x",
                      "For the scope's x axis, in metres or, with ', a share of the size; a factor "
                      "with multiply."),
    param<&Resize::y>("y", "For the y axis."),
    param<&Resize::z>("z", "For the z axis."),
    param<&Resize::anchor>("anchor",
                           "What stays in place: the scope's origin, its centre, or the lower left "
                           "corner of its front.",
                           "origin"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"resize", "transform",
     "Adds to the size of the scope, sets or multiplies it; boxes become rectangles and rectangles "
     "boxes.",
     kSignatures, typed<applyResize>, BlockKind::None, kPure, kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_resize;
const OpList kOps_resize = kSpecs;

}  // namespace gable
