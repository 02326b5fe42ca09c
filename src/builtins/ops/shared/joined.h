// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Several shapes as one: their geometry in one mesh, and what becomes of their materials and
// attributes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "builtins/ops/shared/material_slots.h"
#include "geom/mesh/mesh.h"
#include "shape/op_call.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

using Parts = std::vector<const Shape*>;

/// The geometry of some shapes, in the scope of another.
struct JoinedMesh {
  Mesh mesh;
  /// For each face the number of the shape that it comes from.
  std::vector<uint32_t> partOf;
};

/// Joins shapes of a set, whose materials and groups it knows. Where these differ, each goes into
/// the geometry: it becomes a slot of the joined shape's mesh.
class Joiner {
 public:
  /// `all`: the set.
  Joiner(Services& services, const Parts& all);
  /// The geometry of one of them, `toHome` of its local frame; null: in its own scope.
  Mesh meshOf(const Shape& s, const Frame* toHome);
  /// In the coordinates of `home`.
  JoinedMesh join(const Frame& home, const Parts& parts);
  /// Gives the shape the materials of the joined meshes.
  void giveMaterials(Shape& s);

 private:
  /// Null where materials differ.
  const Shape* like_ = nullptr;
  MaterialSlots slots_;
};

/// Glues shapes with origins together (geom/solid/recompose.h): the gathered leaves, all of which
/// it takes, and `whole`, of which they are parts. Null: the leaves are all, and edges and vertices
/// among them stay. The axes of the scope stay, and it is fitted.
void recompose(Shape& s, const Shape* whole, std::span<Gathered> leaves, Services& services);

/// Whether a gathered leaf stands for a shape that is deleted.
bool isDeleted(const Shape& s);

/// The attributes that all agree on; those of the shape where they do not.
void giveAttributes(Shape& s, const Parts& parts);

/// The shape becomes another one, with the place of its own in the derivation.
void take(Shape& s, const Shape& other);

/// Where a boolean of their geometry gives nothing.
Status tooConfused();

/// The boolean union of the parts. A face that lay on others has the tags of all.
Status unify(JoinedMesh& joined, Services& services);

}  // namespace gable
