// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Footprints within footprints. Maps draw a building in a court, or the tower of a church, as a
// polygon inside of another, and neighbours that overlap; derived as they are, the two would stand
// in each other.

#include <algorithm>
#include <cmath>

#include "base/allowance.h"
#include "base/work.h"
#include "engine/footprint.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"

namespace gable {

namespace {

/// Shapes whose heights differ by more than this do not lie in one plane.
constexpr double kSamePlane = 0.01;
/// Neighbours share less than this of the smaller one by the rounding of coordinates.
constexpr double kOverlapShare = 0.005;
/// A shape of which others leave less than this share stands within them, drawn in by so many
/// metres that no wall of it lies in one of theirs.
constexpr double kRestShare = 0.02;
constexpr double kDrawnIn = 0.5;

struct Plan {
  bool flat = false;
  double height = 0;
  Region region;
  Box2 box;
  double size = 0;
};

Plan planOf(const ShapeFootprint& f) {
  Plan p;
  const Mesh world = transformed(f.mesh, {1, 1, 1}, f.origin);
  const Box3 box = world.bounds();
  if (box.empty() || box.size().y > kSamePlane) return p;
  p.flat = true;
  p.height = box.min.y;
  for (size_t face = 0; face < world.faceCount(); ++face) {
    Polygon polygon = facePolygon(world, face, groundFrame(p.height));
    orient(polygon);
    p.region.push_back(std::move(polygon));
  }
  for (const Polygon& polygon : p.region) {
    p.box.include(bounds(polygon).min);
    p.box.include(bounds(polygon).max);
  }
  p.size = area(p.region);
  return p;
}

}  // namespace

namespace {

// Takes what lies within a footprint out of its plan; false when there is nothing, or nothing is
// left of it.
bool cutOut(std::vector<Plan>& plans, size_t outer) {
  Plan& o = plans[outer];
  bool cut = false;
  const Region whole = o.region;
  for (size_t inner = 0; inner < plans.size(); ++inner) {
    work();
    const Plan& i = plans[inner];
    if (inner == outer || !i.flat || i.size <= 0 || i.size >= o.size) continue;
    if (std::fabs(i.height - o.height) > kSamePlane || !i.box.meets(o.box)) continue;
    if (area(intersect(whole, i.region)) < kOverlapShare * i.size) continue;
    o.region = subtract(o.region, i.region);
    cut = true;
  }
  if (!cut) return false;
  if (area(o.region) < kRestShare * o.size) o.region = offset(whole, -kDrawnIn);
  return !o.region.empty();
}

}  // namespace

void cutNested(std::vector<ShapeFootprint>& footprints) {
  std::vector<Plan> plans;
  for (const ShapeFootprint& f : footprints) plans.push_back(planOf(f));
  for (size_t outer = 0; outer < plans.size(); ++outer) {
    if (!plans[outer].flat) continue;
    // What cannot be cut stays whole.
    bool cut = false;
    const Status status = guarded([&] {
      cut = cutOut(plans, outer);
      return Status();
    });
    unwindIfStopped(status);
    if (!status.ok() || !cut) continue;
    const Frame toObject = inverse(footprints[outer].origin);
    footprints[outer].mesh = transformed(
        meshOf(plans[outer].region, groundFrame(plans[outer].height)), {1, 1, 1}, toObject);
  }
}

}  // namespace gable
