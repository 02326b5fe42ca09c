// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/material_slots.h"

#include <algorithm>

#include "base/work.h"

namespace gable {

void MaterialSlots::put(Mesh& m, const Shape& s) {
  const std::vector<uint16_t> slot = of(s);
  for (MeshFace& f : m.faces) {
    f.materialSlot = slot[f.materialSlot < slot.size() ? f.materialSlot : 0];
  }
}

// By slot of the shape's mesh, its own material first.
std::vector<uint16_t> MaterialSlots::of(const Shape& s) {
  const std::vector<MaterialId> list = services_.attributes().materials(s.assetMaterials);
  const std::vector<StringId>& groups = services_.attributes().groups(s.assetMaterials);
  const size_t n = list.size() / 2;
  std::vector<uint16_t> out{slotOf({s.material, s.material, none_})};
  for (size_t k = 0; k < n; ++k) {
    out.push_back(slotOf({list[k], list[n + k], k < groups.size() ? groups[k] : none_}));
  }
  return out;
}

uint16_t MaterialSlots::slotOf(const Slot& slot) {
  auto at = std::find(slots_.begin(), slots_.end(), slot);
  // Slots have 16 bits; what would have more takes the last one.
  if (at == slots_.end() && slots_.size() < 0xfffe) at = slots_.insert(slots_.end(), slot);
  if (at == slots_.end()) --at;
  work();
  return static_cast<uint16_t>(at - slots_.begin() + 1);
}

uint32_t MaterialSlots::interned() const {
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
  return services_.attributes().internMaterials(std::move(list), std::move(groups));
}

bool haveOneMaterial(const std::vector<const Shape*>& shapes) {
  return std::all_of(shapes.begin(), shapes.end(), [&](const Shape* s) {
    return s->material == shapes[0]->material && s->assetMaterials == shapes[0]->assetMaterials;
  });
}

}  // namespace gable
