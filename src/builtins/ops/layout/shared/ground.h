// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face as ground that is laid out, and the shapes that are made of its parts.
#pragma once

#include <cstdint>
#include <vector>

#include "builtins/ops/layout/shared/street_uv.h"
#include "geom/region/region.h"
#include "shape/op_call.h"

namespace gable {

/// One face of the shape in its own plane: x along the scope's x axis where the face lies in the
/// scope's ground plane, the face's normal towards the eye.
struct Ground {
  Polygon polygon;
  /// For each edge (outer ring, then holes): it has the tag "street". All false where none has.
  std::vector<bool> street;
  /// The face's plane in scope coordinates.
  Frame frame;
  uint32_t tags = 0;
  uint16_t materialSlot = 0;
};

/// The first item of the block that takes a part by its word: one that names the word or, with
/// `orAll`, `all`. Null where none does.
const SelectorItem* itemFor(const OpCall& call, std::string_view what, bool orAll = true);

/// The faces that have an area, with valid polygons. Fails with no-geometry where there are none.
Status groundsOf(OpCall& call, std::vector<Ground>& out);

/// A part of the ground as a child: a face of its own. Its scope lies along the edge `front` of the
/// outer ring, y along the face's normal, as that of an initial shape; with kNoFront along the
/// parent's axes. `street` (by edge, may be empty) gives edges the tag "street", `uvs` (by corner,
/// may be empty) texture coordinates.
constexpr uint32_t kNoFront = 0xffffffff;
Shape groundPart(OpCall& call, const Ground& ground, const Polygon& part, uint32_t front,
                 const std::vector<bool>& street, const std::vector<StreetUvs>& uvs = {});

}  // namespace gable
