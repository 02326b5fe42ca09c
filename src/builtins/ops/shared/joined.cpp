// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/joined.h"

#include <algorithm>
#include <optional>

#include "base/work.h"
#include "builtins/auto_tags.h"
#include "geom/solid/boolean.h"
#include "shape/tags.h"

namespace gable {

Joiner::Joiner(Services& services, const Parts& all)
    : services_(services), none_(services.pool().intern("")), like_(all[0]) {
  for (const Shape* s : all) {
    const bool alike =
        s->material == all[0]->material && s->assetMaterials == all[0]->assetMaterials;
    if (!alike) like_ = nullptr;
  }
}

JoinedMesh Joiner::join(const Frame& home, const Parts& parts) {
  JoinedMesh out;
  const Frame toHome = inverse(home);
  for (uint32_t k = 0; k < parts.size(); ++k) {
    Mesh more = transformed(*meshInScope(*parts[k]), {1, 1, 1}, toHome * parts[k]->scope);
    work(static_cast<uint32_t>(more.corners.size()));
    if (!like_) {
      const std::vector<uint16_t> slot = slotsOf(*parts[k]);
      for (MeshFace& f : more.faces) {
        f.materialSlot = slot[f.materialSlot < slot.size() ? f.materialSlot : 0];
      }
    }
    append(out.mesh, more);
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
  // In the order of AttributePool: those in use, then those that the geometry has.
  std::vector<MaterialId> list;
  std::vector<StringId> groups;
  bool grouped = false;
  for (const Slot& slot : slots_) {
    list.push_back(slot.used);
    groups.push_back(slot.group);
    grouped = grouped || slot.group != none_;
  }
  for (const Slot& slot : slots_) list.push_back(slot.own);
  if (!grouped) groups.clear();
  s.assetMaterials = services_.attributes().internMaterials(std::move(list), std::move(groups));
}

// The slots, from 1, to which those of a shape's mesh go, from its own material on.
std::vector<uint16_t> Joiner::slotsOf(const Shape& s) {
  const std::vector<MaterialId> list = services_.attributes().materials(s.assetMaterials);
  const std::vector<StringId>& groups = services_.attributes().groups(s.assetMaterials);
  const size_t n = list.size() / 2;
  std::vector<uint16_t> out{slotOf({s.material, s.material, none_})};
  for (size_t k = 0; k < n; ++k) {
    out.push_back(slotOf({list[k], list[n + k], k < groups.size() ? groups[k] : none_}));
  }
  return out;
}

uint16_t Joiner::slotOf(const Slot& slot) {
  auto at = std::find(slots_.begin(), slots_.end(), slot);
  // Slots have 16 bits; what would have more takes the last one.
  if (at == slots_.end() && slots_.size() < 0xfffe) at = slots_.insert(slots_.end(), slot);
  if (at == slots_.end()) --at;
  work();
  return static_cast<uint16_t>(at - slots_.begin() + 1);
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
