// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/boolean.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status nothingToProject(const OpCall& call) {
  return call.fail("no-geometry", "the shape has no geometry that could have a footprint",
                   "insert a primitive or an asset first");
}

// The outlines of all faces seen from above, united. A face seen from below is turned, so that
// every one of them counts as covered ground.
Region groundOf(const Mesh& m, const Frame& above) {
  std::vector<Ring> rings;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    Polygon p = facePolygon(m, f, above);
    if (!(std::fabs(area(p)) > 0)) continue;
    orient(p);
    rings.push_back(std::move(p.outer));
    for (Ring& hole : p.holes) rings.push_back(std::move(hole));
  }
  return repaired(rings, FillRule::Positive);
}

Status applyFootprint(OpCall& call) {
  Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::Box && s.size.x > 0 && s.size.z > 0) {
    s.size.y = 0;
    s.geometry = primitive(GeometryKind::QuadXz);
    return {};
  }
  const Frame above = axisFrame(1, 1);
  const Region ground = groundOf(*meshInScope(s), above);
  if (ground.empty()) return nothingToProject(call);
  setPartMesh(s, Shape(s), meshOf(ground, above), true);
  return {};
}

constexpr Signature kNone[] = {{}};

constexpr OpSpec kSpecs[] = {
    heavy({"footprint", "edit", "Replaces the geometry by its outline on the ground of the scope.",
           kNone, applyFootprint}),
};

}  // namespace

extern const OpList kOps_footprint;
const OpList kOps_footprint = kSpecs;

}  // namespace gable
