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

Vec3 newSize(const OpCall& call, const Vec3& old) {
  Vec3 size;
  for (size_t i = 0; i < 3; ++i) {
    double v = call.sized(1 + i, old[i]);
    if (call.is(0, "add")) v += old[i];
    if (call.is(0, "multiply")) v = call.number(1 + i) * old[i];
    size[i] = std::max(0.0, v);
  }
  return size;
}

// The place in a scope of this size that stays where it is.
Vec3 anchorIn(const Vec3& size, std::string_view anchor) {
  if (anchor == "center") return size * 0.5;
  return anchor == "front" ? Vec3{0, 0, size.z} : Vec3{};
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

Status applyResize(OpCall& call) {
  Shape& s = call.shape();
  const Vec3 size = newSize(call, s.size);
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
  const std::string_view anchor = call.text(4, "origin");
  s.scope.origin = s.scope.point(anchorIn(s.size, anchor) - anchorIn(size, anchor));
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
    {"mode", ParamType::Selector, "add to the sizes, set them, or multiply them.", nullptr,
     "add set multiply"},
    {"x", ParamType::Size,
     "For the scope's x axis, in metres or, with ', a share of the size; a factor with multiply."},
    {"y", ParamType::Size, "For the y axis."},
    {"z", ParamType::Size, "For the z axis."},
    {"anchor", ParamType::Selector,
     "What stays in place: the scope's origin, its centre, or the lower left corner of its front.",
     "origin", "origin center front"},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"resize", "transform",
     "Adds to the size of the scope, sets or multiplies it; boxes become rectangles and rectangles "
     "boxes.",
     kSignatures, applyResize, BlockKind::None, kPure, nullptr, false, true},
};

}  // namespace

extern const OpList kOps_resize;
const OpList kOps_resize = kSpecs;

}  // namespace gable
