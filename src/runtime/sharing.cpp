// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/sharing.h"

#include <algorithm>
#include <cmath>

#include "program/tag_effects.h"
#include "runtime/key_hash.h"
#include "shape/part_place.h"

namespace gable {

namespace {

// What is alike but for rounding becomes exactly so: else no two calls would be alike. Coordinates
// go to a grid of a thousand-millionth of a metre, directions to a finer one.
double onGrid(double v, double grid) {
  return std::fabs(v) < 0x1.0p20 ? std::nearbyint(v / grid) * grid : v;
}
Vec3 onGrid(const Vec3& v, double grid) {
  return {onGrid(v.x, grid), onGrid(v.y, grid), onGrid(v.z, grid)};
}
constexpr double kPlaceGrid = 0x1.0p-30, kDirectionGrid = 0x1.0p-40;

Frame withoutNoise(Frame f) {
  f.origin = onGrid(f.origin, kPlaceGrid);
  const auto straight = [](const Vec3& v, size_t axis) {
    return std::fabs(v[axis] - 1) < 1e-12 && std::fabs(v[(axis + 1) % 3]) < 1e-12 &&
           std::fabs(v[(axis + 2) % 3]) < 1e-12;
  };
  return straight(f.x, 0) && straight(f.y, 1) && straight(f.z, 2) ? Frame::moved(f.origin) : f;
}

double localDistance(const TrimPlane& plane, const Frame& outer) {
  return onGrid(plane.distance - dot(plane.normal, outer.origin), kPlaceGrid);
}

// Exactly, by components of 0: a place that moves along one direction keeps its distance, to the
// bit, from planes of the other.
bool isSquare(const Vec3& a, const Vec3& b) {
  return (a.x == 0 || b.x == 0) && (a.y == 0 || b.y == 0) && (a.z == 0 || b.z == 0);
}

ShapeExtra localExtra(const ShapeExtra& extra, const Frame& outer) {
  ShapeExtra out = extra;
  for (TrimPlane& t : out.trim) {
    t.distance = localDistance(t, outer);
    t.normal = onGrid(outer.toLocalDirection(t.normal), kDirectionGrid);
  }
  const Frame inward = inverse(outer);
  for (UvProjection& p : out.projections) p.frame = withoutNoise(inward * p.frame);
  return out;
}

}  // namespace

ShareKey sharedKey(const SharedCall& call) {
  const Shape& s = call.shape;
  KeyHash h;
  h.add(call.code);
  h.add(uint64_t{s.trimVertical} << 1 | uint64_t{s.trimHorizontal});
  h.add(s.size);
  h.add(uint64_t{s.material} << 32 | s.assetMaterials);
  for (const Value& v : call.arguments) h.add(v.hash());
  Geometry geometry = s.geometry;
  // A primitive fills the scope whatever the scope was when it was made.
  if (geometry.kind != GeometryKind::Mesh) geometry.refSize = {};
  h.add(contentHash(geometry));
  for (const Value& v : call.attributes) h.add(v.hash());
  if (call.effects & kReadsSplit) h.add(uint64_t{s.split.index} << 32 | s.split.total);
  if (call.effects & kReadsComp) {
    h.add(uint64_t{s.comp.index} << 32 | s.comp.total);
    h.add(uint64_t{s.compSelector});
  }
  if (call.effects & (kReadsPivot | kReadsPivotAxes)) h.add(s.pivot);
  if (call.effects & kRandom) h.add(s.path);
  if (s.extra) h.add(*s.extra);
  return withAttributes(h.key(), s.attributes);
}

ShareKey rootKey(const ShareKey& call, const Frame& scope, StringId name) {
  constexpr uint64_t kOfRoots = 0x7a3d5c1e90b24f68ULL;
  KeyHash h;
  h.add(kOfRoots);
  h.add(call.a);
  h.add(call.b);
  h.add(scope);
  h.add(uint64_t{name});
  return h.key();
}

bool isSharedWhenSeeded(uint32_t effects) {
  constexpr uint32_t kElsewhere =
      kReadsWorld | kReadsContext | kReadsPath | kLabels | kReadsInitialShape | kAsksForRoom;
  return (effects & kRandom) != 0 && (effects & kElsewhere) == 0;
}

bool areAlike(const Shape& parent, uint32_t effects, const PartPlan& plan, const SplitPiece& a,
              const SplitPiece& b) {
  if (a.size != b.size) return false;
  if (seesTags(effects) && !keepEqualTags(parent, plan, a, b)) return false;
  if (!parent.extra) return true;
  if (parent.extra->deformed || !parent.extra->projections.empty()) return false;
  const auto axis = static_cast<size_t>(plan.axis);
  Frame ofA = parent.scope, ofB = parent.scope;
  ofA.origin = originOfPart(parent, plan, a);
  ofB.origin = originOfPart(parent, plan, b);
  Vec3 size = parent.size;
  size[axis] = plan.flat ? 0 : std::copysign(a.size, size[axis]);
  const Vec3& along = directionOf(parent.scope, plan.axis);
  return std::ranges::all_of(parent.extra->trim, [&](const TrimPlane& t) {
    if (isSquare(t.normal, along)) return true;
    const bool far = isFarFrom(t, ofA, size);
    return far == isFarFrom(t, ofB, size) &&
           (far || localDistance(t, ofA) == localDistance(t, ofB));
  });
}

void putIntoOwnFrame(Shape& shape, uint32_t effects, const Frame& outer) {
  if (effects & (kReadsPivot | kReadsPivotAxes)) {
    shape.pivot = withoutNoise(inverse(outer) * shape.pivot);
    if ((effects & kReadsPivot) == 0) shape.pivot.origin = {};
  } else {
    shape.pivot = Frame{};
  }
  // A mesh keeps its tags: a copy of it would cost more than it saves.
  if (!seesTags(effects)) shape.geometry.tags.fill(0);
  if (shape.extra) {
    // A deformation is told in the scope's own terms, so it comes along as it is.
    const bool seen = shape.extra->deformed || (effects & (kUsesTrim | kReadsUvProjection)) != 0;
    shape.extra = seen ? makeRef<ShapeExtra>(localExtra(*shape.extra, outer)) : Ref<ShapeExtra>();
  }
  shape.scope = Frame{};
}

}  // namespace gable
