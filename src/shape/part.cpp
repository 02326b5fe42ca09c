// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/part.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "shape/part_place.h"

namespace gable {

namespace {

// Places that were computed in different frames differ by less, in metres.
constexpr double kRounding = 1e-6;

// A box around a shape, grown on all sides.
struct GrownBox {
  const Frame& axes;
  Vec3 half, middle;
  double reach;

  GrownBox(const Frame& f, const Vec3& origin, const Vec3& s) : axes(f) {
    const Vec3 size{std::fabs(s.x), std::fabs(s.y), std::fabs(s.z)};
    const double grow = std::max({size.x, size.y, size.z}) / 4;
    half = {size.x / 2 + grow, size.y / 2 + grow, size.z / 2 + grow};
    middle = origin + axes.direction(s * 0.5);
    reach = half.x + half.y + half.z;
  }
  bool liesBehind(const TrimPlane& p) const {
    const double beyond = dot(p.normal, middle) - p.distance;
    if (beyond + reach < 0) return true;
    return beyond + std::fabs(dot(p.normal, axes.x)) * half.x +
               std::fabs(dot(p.normal, axes.y)) * half.y +
               std::fabs(dot(p.normal, axes.z)) * half.z <
           0;
  }
};

// Of the sides, or edges, that the cuts around a part made. `whole`: the length that is divided.
void dropInnerTags(Geometry& g, Axis axis, const SplitPiece& piece, double whole) {
  if (g.kind == GeometryKind::QuadXy && axis == Axis::Z) return;
  if (g.kind == GeometryKind::QuadXz && axis == Axis::Y) return;
  constexpr std::array<std::array<BoxSide, 2>, 3> kEnds{
      {{kSideLeft, kSideRight}, {kSideBottom, kSideTop}, {kSideBack, kSideFront}}};
  const auto& ends = kEnds[static_cast<size_t>(axis)];
  if (piece.start != 0) g.tags[ends[0]] = 0;
  if (piece.start + piece.size < whole * (1 - 1e-12)) g.tags[ends[1]] = 0;
}

}  // namespace

Vec3 originOfPart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece) {
  const double sign = parent.size[static_cast<size_t>(plan.axis)] < 0 ? -1 : 1;
  return parent.scope.origin + directionOf(parent.scope, plan.axis) * (sign * piece.start);
}

bool keepEqualTags(const Shape& parent, const PartPlan& plan, const SplitPiece& a,
                   const SplitPiece& b) {
  const double whole = std::fabs(parent.size[static_cast<size_t>(plan.axis)]);
  Geometry ofA = parent.geometry, ofB = parent.geometry;
  dropInnerTags(ofA, plan.axis, a, whole);
  dropInnerTags(ofB, plan.axis, b, whole);
  return ofA.tags == ofB.tags;
}

void makePart(const Shape& parent, const PartPlan& plan, const SplitPiece& piece, uint32_t index,
              Shape& part) {
  part = parent;
  const auto a = static_cast<size_t>(plan.axis);
  const double whole = std::fabs(parent.size[a]), sign = parent.size[a] < 0 ? -1 : 1;
  part.scope.origin = originOfPart(parent, plan, piece);
  part.size[a] = plan.flat ? 0 : sign * piece.size;
  part.split = {index, plan.total};
  part.path = hashCombine(plan.path, uint64_t{piece.slot} << 32 | index);
  dropInnerTags(part.geometry, plan.axis, piece, whole);
  if (part.extra) forgetFarTrimPlanes(part);
}

void findLightPlanes(const Shape& s, LightPlanes& out) {
  for (const TrimPlane& p : s.extra->trim) {
    LightPlane plane;
    plane.along = s.scope.toLocalDirection(p.normal);
    plane.distance = p.distance - dot(p.normal, s.scope.origin);
    plane.on = p.horizontal ? s.trimHorizontal : s.trimVertical;
    for (size_t i = 0; i < 3; ++i) {
      plane.ahead[i] = std::max(0.0, plane.along[i]);
      plane.spread += std::fabs(plane.along[i]);
    }
    out.push_back(plane);
  }
}

bool isFarFromTrim(const LightPart& part) {
  const Vec3 origin = part.trim->there(part.origin);
  const double grown = std::max({part.size.x, part.size.y, part.size.z}) / 4;
  for (const LightPlane& p : part.trim->planes) {
    const double reach = dot(p.along, origin) + dot(p.ahead, part.size) + grown * p.spread;
    if (reach + kRounding >= p.distance) return false;
  }
  return true;
}

bool isFarFrom(const TrimPlane& plane, const Frame& scope, const Vec3& size) {
  return GrownBox(scope, scope.origin, size).liesBehind(plane);
}

void forgetFarTrimPlanes(Shape& s) {
  if (!s.extra || s.extra->trim.empty()) return;
  const GrownBox box(s.scope, s.scope.origin, s.size);
  const auto far = [&](const TrimPlane& p) { return box.liesBehind(p); };
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
