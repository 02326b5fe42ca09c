// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The materials and groups of several shapes as slots of one: what a shape's own material is
// becomes part of the geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

class MaterialSlots {
 public:
  explicit MaterialSlots(Services& services) : services_(services) {}

  /// Puts the faces of a mesh, which is that of a shape, into the slots of its materials, from 1.
  void put(Mesh& m, const Shape& s);
  /// In the order of AttributePool: those in use, then those that the geometry has.
  uint32_t interned() const;

 private:
  struct Slot {
    MaterialId used = 0, own = 0;
    StringId group = 0;
    bool operator==(const Slot&) const = default;
  };
  std::vector<uint16_t> of(const Shape& s);
  uint16_t slotOf(const Slot& slot);

  Services& services_;
  // The name of faces that are of no group.
  const StringId none_ = services_.pool().intern("");
  std::vector<Slot> slots_;
};

/// Whether no slots are needed.
bool haveOneMaterial(const std::vector<const Shape*>& shapes);

}  // namespace gable
