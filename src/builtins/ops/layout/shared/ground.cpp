// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/layout/shared/ground.h"

#include <utility>

#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/clean.h"

namespace gable {

namespace {

constexpr const char* kStreetTag = "street";

std::vector<bool> streetEdges(const Mesh& m, size_t face, const TagTable& tags) {
  std::vector<bool> out;
  if (m.edgeTags.empty()) return out;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      out.push_back(tags.has(m.edgeTags[loop.firstCorner + i], kStreetTag));
    }
  }
  return out;
}

}  // namespace

const SelectorItem* itemFor(const OpCall& call, std::string_view what, bool orAll) {
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.size() != 1 || item.terms[0].kind != SelectorTerm::Kind::Word) continue;
    const std::string_view word = call.services().pool().text(item.terms[0].word);
    if (word == what || (orAll && word == "all")) return &item;
  }
  return nullptr;
}

Status groundsOf(OpCall& call, std::vector<Ground>& out) {
  const MeshRef mesh = meshInScope(call.shape());
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{}) continue;
    Ground g;
    g.frame = planFrame(*mesh, f);
    g.polygon = facePolygon(*mesh, f, g.frame);
    g.street = streetEdges(*mesh, f, call.services().tags());
    g.tags = mesh->faces[f].tags;
    g.materialSlot = mesh->faces[f].materialSlot;
    if (isValid(g.polygon)) out.push_back(std::move(g));
  }
  if (!out.empty()) return {};
  return call.fail("no-geometry",
                   "'" + std::string(call.spec().name) + "' has no sound face to lay out",
                   "start from a footprint, or mend it with cleanupGeometry");
}

Shape groundPart(OpCall& call, const Ground& ground, const Polygon& part, uint32_t front,
                 const std::vector<bool>& street, const std::vector<StreetUvs>& uvs) {
  Shape child = call.shape();
  MeshBuilder b;
  b.beginFace(ground.materialSlot, ground.tags);
  const TagSetId tag = street.empty() ? 0 : call.services().tags().of(kStreetTag);
  size_t edge = 0;
  const auto addLoop = [&](const Ring& ring) {
    b.beginLoop();
    for (const Vec2 p : ring) {
      const bool on = edge < street.size() && street[edge];
      const uint32_t corner =
          b.addCorner(b.addPosition(fromPlanFrame(ground.frame, p)), on ? tag : 0);
      for (size_t set = 0; edge < uvs.size() && set < uvs[edge].size(); ++set) {
        b.setUv(corner, static_cast<int>(set), uvs[edge][set]);
      }
      ++edge;
    }
  };
  addLoop(part.outer);
  for (const Ring& hole : part.holes) addLoop(hole);
  setPartMesh(child, call.shape(), b.take(), true);
  forgetFarTrimPlanes(child);
  if (front == kNoFront) return child;
  const size_t n = part.outer.size();
  const Vec2 along = normalized(part.outer[(front + 1) % n] - part.outer[front % n]);
  const Frame& scope = call.shape().scope;
  const Vec3 x = scope.direction(ground.frame.direction({along.x, along.y, 0}));
  const Vec3 y = scope.direction(ground.frame.z);
  alignScope(child, Frame::of({}, x, y, cross(x, y)));
  child.pivot = child.scope;
  return child;
}

}  // namespace gable
