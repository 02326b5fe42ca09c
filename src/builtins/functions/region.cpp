// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a region knows of the partition that it came from.

#include <algorithm>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_shape.h"
#include "shape/op_call.h"

namespace gable {

namespace {

CellMark cellOf(const FunctionCall& call) {
  return regionFactsOf(call.services(), call.shape()).cell.value_or(CellMark{});
}

Value counted(uint32_t v) { return Value::of(static_cast<double>(v)); }

Value ix(FunctionCall& call) { return counted(cellOf(call).ix); }
Value iy(FunctionCall& call) { return counted(cellOf(call).iy); }
Value nx(FunctionCall& call) { return counted(cellOf(call).nx); }
Value ny(FunctionCall& call) { return counted(cellOf(call).ny); }
Value bx(FunctionCall& call) {
  const CellMark c = cellOf(call);
  return counted(std::min(c.ix, c.nx - 1 - c.ix));
}
Value by(FunctionCall& call) {
  const CellMark c = cellOf(call);
  return counted(std::min(c.iy, c.ny - 1 - c.iy));
}
Value mirroredX(FunctionCall& call) { return Value::of(cellOf(call).mirroredX()); }
Value mirroredY(FunctionCall& call) { return Value::of(cellOf(call).mirroredY()); }
Value cellWidth(FunctionCall& call) { return Value::of(cellOf(call).w); }
Value cellHeight(FunctionCall& call) { return Value::of(cellOf(call).h); }
Value depth(FunctionCall& call) {
  return counted(regionFactsOf(call.services(), call.shape()).depth);
}

Value onBorder(FunctionCall& call) {
  const MeshRef mesh = meshInScope(call.shape());
  for (const size_t f : regionFaces(*mesh)) {
    const RegionView view(call.services(), *mesh, f);
    for (const EdgeMark& m : view.marks()) {
      if (m.level == 0) return Value::of(true);
    }
  }
  return Value::of(false);
}

constexpr ValueType kFloat = ValueType::Float;
constexpr ValueType kBool = ValueType::Bool;

constexpr AttributeSpec kAttributes[] = {
    {"region.ix", kFloat, "Column of the grid's cell that the region is or was cut from.", ix},
    {"region.iy", kFloat, "Row of the cell, from the south.", iy},
    {"region.nx", kFloat, "How many columns the grid has; 1 outside of grids.", nx},
    {"region.ny", kFloat, "How many rows the grid has.", ny},
    {"region.bx", kFloat, "Columns between the cell and the nearer end of its row.", bx},
    {"region.by", kFloat, "Rows between the cell and the nearer end of its column.", by},
    {"region.mx", kBool, "Whether the cell is mirrored in x; see grid.", mirroredX},
    {"region.my", kBool, "Whether the cell is mirrored in y.", mirroredY},
    {"region.w", kFloat, "Width that the cell was laid out with, before it was cut to the region.",
     cellWidth},
    {"region.h", kFloat, "Height that the cell was laid out with.", cellHeight},
    {"region.depth", kFloat, "How many partitions lie behind the region.", depth},
    {"region.border", kBool, "Whether a part of the region's outline is that of the initial one.",
     onBorder},
};

}  // namespace

extern const FunctionList kFunctions_region;
const FunctionList kFunctions_region = {{}, kAttributes};

}  // namespace gable
