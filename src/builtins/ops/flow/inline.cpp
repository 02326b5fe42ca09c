// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Waits for all that comes of a rule, a subdivision or a block, and puts it into the present shape.
#include <algorithm>
#include <utility>

#include "base/work.h"
#include "builtins/lists.h"
#include "geom/mesh/mesh.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Merge : uint8_t { Append };

}  // namespace

template <>
struct WordsOf<Merge> {
  static constexpr const char* text = "append";
};

namespace {

struct Inline {
  Merge geometryMergeStrategy = Merge::Append;
};

Status beginInline(OpCall& call, const Inline&) {
  uint32_t piece = 0;
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.empty()) call.emit(call.shape(), item.slot, piece++);
  }
  call.gather();
  return {};
}

/// The materials and groups of several shapes as slots of one. What a shape's own material is
/// becomes part of the geometry.
class Slots {
 public:
  explicit Slots(Services& services) : services_(services) {}

  /// The slots, from 1, to which those of a shape's mesh go, from its own material on.
  std::vector<uint16_t> of(const Shape& s) {
    const std::vector<MaterialId> list = services_.attributes().materials(s.assetMaterials);
    const std::vector<StringId>& groups = services_.attributes().groups(s.assetMaterials);
    const size_t n = list.size() / 2;
    std::vector<uint16_t> out{slotOf({s.material, s.material, none_})};
    for (size_t k = 0; k < n; ++k) {
      out.push_back(slotOf({list[k], list[n + k], k < groups.size() ? groups[k] : none_}));
    }
    return out;
  }
  /// In the order of AttributePool: those in use, then those that the geometry has.
  uint32_t interned() {
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

 private:
  struct Slot {
    MaterialId used = 0, own = 0;
    StringId group = 0;
    bool operator==(const Slot&) const = default;
  };
  uint16_t slotOf(const Slot& slot) {
    auto at = std::find(slots_.begin(), slots_.end(), slot);
    // Slots have 16 bits; what would have more takes the last one.
    if (at == slots_.end() && slots_.size() < 0xfffe) at = slots_.insert(slots_.end(), slot);
    if (at == slots_.end()) --at;
    work();
    return static_cast<uint16_t>(at - slots_.begin() + 1);
  }

  Services& services_;
  // The name of faces that are of no group.
  const StringId none_ = services_.pool().intern("");
  std::vector<Slot> slots_;
};

bool haveOneMaterial(const std::vector<const Shape*>& shapes) {
  return std::all_of(shapes.begin(), shapes.end(), [&](const Shape* s) {
    return s->material == shapes[0]->material && s->assetMaterials == shapes[0]->assetMaterials;
  });
}

void joinShapes(Shape& s, const std::vector<const Shape*>& parts, Services& services) {
  const bool oneMaterial = haveOneMaterial(parts);
  Slots slots(services);
  Mesh mesh;
  const Frame home = inverse(s.scope);
  for (const Shape* part : parts) {
    Mesh more = transformed(*meshInScope(*part), {1, 1, 1}, home * part->scope);
    work(static_cast<uint32_t>(more.corners.size()));
    if (!oneMaterial) {
      const std::vector<uint16_t> slot = slots.of(*part);
      for (MeshFace& f : more.faces) {
        f.materialSlot = slot[f.materialSlot < slot.size() ? f.materialSlot : 0];
      }
    }
    append(mesh, more);
  }
  if (oneMaterial) s.material = parts[0]->material;
  s.assetMaterials = oneMaterial ? parts[0]->assetMaterials : slots.interned();
  const bool oneOpinion = std::all_of(parts.begin(), parts.end(), [&](const Shape* p) {
    return p->attributes == parts[0]->attributes;
  });
  if (oneOpinion) s.attributes = parts[0]->attributes;
  s.geometry = {};
  setMesh(s, std::move(mesh), ScopeFit::Refit);
}

Status finishInline(OpCall& call, std::span<Gathered> leaves) {
  std::vector<const Shape*> parts;
  for (Gathered& leaf : leaves) {
    leaf.taken = true;
    if (leaf.shape.geometry.kind != GeometryKind::None) parts.push_back(&leaf.shape);
  }
  Shape& s = call.shape();
  if (parts.empty()) {
    s.geometry = {};
  } else if (parts.size() == 1) {
    // Taken as it is; its place in the derivation is that of the present shape.
    const uint64_t path = s.path;
    const uint32_t locals = s.locals;
    s = *parts[0];
    s.path = path;
    s.locals = locals;
  } else {
    joinShapes(s, parts, call.services());
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Inline::geometryMergeStrategy>("geometryMergeStrategy",
                                          "append: all faces as they are, side by side.", "append"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"inline",
     "flow",
     "Puts all that a rule, a subdivision or a block makes into one shape, and goes on with it.",
     kSignatures,
     typed<beginInline>,
     BlockKind::Operations,
     kReadsTags,
     kNoParts,
     false,
     false,
     {},
     1,
     finishInline},
};

}  // namespace

extern const OpList kOps_inline;
const OpList kOps_inline = kSpecs;

}  // namespace gable
