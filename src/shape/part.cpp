// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/part.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace gable {

namespace {

// How far a box reaches beyond a plane; negative when it lies wholly behind.
double reach(const Shape& s, const TrimPlane& plane, double grow) {
  const Frame& f = s.scope;
  const Vec3 half{std::fabs(s.size.x) / 2 + grow, std::fabs(s.size.y) / 2 + grow,
                  std::fabs(s.size.z) / 2 + grow};
  return dot(plane.normal, f.point(s.size * 0.5)) - plane.distance +
         std::fabs(dot(plane.normal, f.x)) * half.x + std::fabs(dot(plane.normal, f.y)) * half.y +
         std::fabs(dot(plane.normal, f.z)) * half.z;
}

// Origin and size of a part whose other fields are its parent's.
void placePart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece, Vec3& origin,
               Vec3& size) {
  const auto a = static_cast<size_t>(plan.axis);
  const double sign = parent.size[a] < 0 ? -1 : 1;
  const Vec3& along = plan.axis == Axis::X   ? parent.scope.x
                      : plan.axis == Axis::Y ? parent.scope.y
                                             : parent.scope.z;
  origin = parent.scope.origin + along * (sign * piece.start);
  size[a] = plan.flat ? 0 : sign * piece.size;
}

void dropInnerTags(Geometry& g, Axis axis, bool first, bool last) {
  if (g.kind == GeometryKind::QuadXy && axis == Axis::Z) return;
  if (g.kind == GeometryKind::QuadXz && axis == Axis::Y) return;
  constexpr std::array<std::array<BoxSide, 2>, 3> kEnds{
      {{kSideLeft, kSideRight}, {kSideBottom, kSideTop}, {kSideBack, kSideFront}}};
  const auto& ends = kEnds[static_cast<size_t>(axis)];
  if (!first) g.tags[ends[0]] = 0;
  if (!last) g.tags[ends[1]] = 0;
}

}  // namespace

LightPart lightPart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece) {
  LightPart part{parent, parent.scope.origin, parent.size, parent.geometry.kind};
  placePart(parent, plan, piece, part.origin, part.size);
  return part;
}

void makePart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece, uint32_t index,
              Shape& part) {
  part = parent;
  placePart(parent, plan, piece, part.scope.origin, part.size);
  part.split = {index, plan.total};
  part.path = hashCombine(plan.path, uint64_t{piece.slot} << 32 | index);
  const double end = piece.start + piece.size;
  const double whole = std::fabs(parent.size[static_cast<size_t>(plan.axis)]);
  dropInnerTags(part.geometry, plan.axis, piece.start == 0, end >= whole * (1 - 1e-12));
  if (part.extra) forgetFarTrimPlanes(part);
}

void forgetFarTrimPlanes(Shape& s) {
  if (!s.extra || s.extra->trim.empty()) return;
  const double grow = std::max({std::fabs(s.size.x), std::fabs(s.size.y), std::fabs(s.size.z)}) / 4;
  const auto far = [&](const TrimPlane& p) { return reach(s, p, grow) < 0; };
  const auto& trim = s.extra->trim;
  const auto gone = std::count_if(trim.begin(), trim.end(), far);
  if (gone == 0) return;
  if (gone == static_cast<std::ptrdiff_t>(trim.size()) && s.extra->projections.empty()) {
    s.extra = {};
    return;
  }
  ShapeExtra extra = *s.extra;
  std::erase_if(extra.trim, far);
  s.extra = makeRef<ShapeExtra>(std::move(extra));
}

}  // namespace gable
