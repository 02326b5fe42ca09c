// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/joined.h"

#include <algorithm>
#include <optional>

#include "base/work.h"
#include "builtins/auto_tags.h"
#include "builtins/mesh_edges.h"
#include "builtins/ops/shared/kept_tags.h"
#include "geom/mesh/origins.h"
#include "geom/solid/boolean.h"
#include "geom/solid/recompose.h"
#include "shape/tags.h"

namespace gable {

Joiner::Joiner(Services& services, const Parts& all)
    : like_(!all.empty() && haveOneMaterial(all) ? all[0] : nullptr), slots_(services) {}

Mesh Joiner::meshOf(const Shape& s, const Frame* toHome) {
  Mesh out = *meshInScope(s);
  if (toHome) out = transformed(out, {1, 1, 1}, *toHome * s.scope);
  work(static_cast<uint32_t>(out.corners.size()));
  if (!like_) slots_.put(out, s);
  return out;
}

JoinedMesh Joiner::join(const Frame& home, const Parts& parts) {
  JoinedMesh out;
  const Frame toHome = inverse(home);
  for (uint32_t k = 0; k < parts.size(); ++k) {
    append(out.mesh, meshOf(*parts[k], &toHome));
    out.partOf.resize(out.mesh.faceCount(), k);
  }
  return out;
}

void Joiner::giveMaterials(Shape& s) {
  if (like_) {
    s.material = like_->material;
    s.assetMaterials = like_->assetMaterials;
    return;
  }
  s.assetMaterials = slots_.interned();
}

bool isDeleted(const Shape& s) {
  return s.geometry.kind == GeometryKind::Mesh && isDeleted(*s.geometry.mesh);
}

namespace {

// An edge between parts has the tags that it has in any of them.
void shareEdgeTags(Mesh& m, const Services& services) {
  if (m.edgeTags.empty()) return;
  const AutoTags tags(services, "");
  const MeshEdges edges(m);
  std::vector<TagSetId> all(edges.edges().size(), 0);
  for (uint32_t c = 0; c < m.corners.size(); ++c) {
    work();
    TagSetId& set = all[edges.edgeOf(c)];
    set = set == 0 ? m.edgeTags[c] : tags.merged(set, m.edgeTags[c]);
  }
  for (uint32_t c = 0; c < m.corners.size(); ++c) m.edgeTags[c] = all[edges.edgeOf(c)];
}

}  // namespace

void recompose(Shape& s, const Shape* whole, std::span<Gathered> leaves, Services& services) {
  const auto isThere = [](const Shape& p) { return p.geometry.kind != GeometryKind::None; };
  Parts seen;
  if (whole && isThere(*whole)) seen.push_back(whole);
  for (Gathered& leaf : leaves) {
    leaf.taken = true;
    if (isThere(leaf.shape) && !isDeleted(leaf.shape)) seen.push_back(&leaf.shape);
  }
  Joiner joiner(services, seen);
  const Frame toHome = inverse(s.scope);
  const Mesh rest = whole && isThere(*whole) ? joiner.meshOf(*whole, nullptr) : Mesh();
  std::vector<Mesh> parts;
  for (const Gathered& leaf : leaves) {
    if (!isThere(leaf.shape)) continue;
    parts.push_back(isDeleted(leaf.shape) ? transformed(*meshInScope(leaf.shape), {1, 1, 1},
                                                        toHome * leaf.shape.scope)
                                          : joiner.meshOf(leaf.shape, &toHome));
  }
  Mesh glued = recomposed(rest, parts, whole ? LooseParts::Move : LooseParts::Stay);
  shareEdgeTags(glued, services);
  if (!seen.empty()) joiner.giveMaterials(s);
  if (!whole) giveAttributes(s, seen);
  s.geometry = {};
  if (!glued.empty()) setMesh(s, std::move(glued), ScopeFit::Refit);
}

void giveAttributes(Shape& s, const Parts& parts) {
  const bool agree = std::all_of(parts.begin(), parts.end(), [&](const Shape* p) {
    return p->attributes == parts[0]->attributes;
  });
  if (agree && !parts.empty()) s.attributes = parts[0]->attributes;
}

void take(Shape& s, const Shape& other) {
  const uint64_t path = s.path;
  const uint32_t locals = s.locals;
  s = other;
  s.path = path;
  s.locals = locals;
}

Status unify(JoinedMesh& joined, Services& services) {
  std::optional<SolidResult> r = solidBoolean(joined.mesh, joined.partOf, SolidOp::Unify);
  if (!r) return tooConfused();
  const AutoTags tags(services, "bool");
  std::vector<uint32_t> partOf;
  for (size_t f = 0; f < r->mesh.faceCount(); ++f) {
    partOf.push_back(joined.partOf[r->faceSource[f]]);
    uint32_t& set = r->mesh.faces[f].tags;
    for (const uint32_t o : r->faceOthers[f]) set = tags.merged(set, joined.mesh.faces[o].tags);
  }
  keepTags(r->mesh, joined.mesh, services);
  joined = {std::move(r->mesh), std::move(partOf)};
  return {};
}

Status tooConfused() {
  return Status::failure("boolean-failed",
                         "the faces are too close to each other or too far from plane to tell "
                         "inside from outside",
                         "clean the operands first, with cleanupGeometry(all, 0)");
}

}  // namespace gable
