// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a region knows of the partition that it came from.

#include <algorithm>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_attributes.h"
#include "builtins/ops/region/shared/selection.h"
#include "shape/argument.h"

namespace gable {

namespace {

CellMark cellOf(const FunctionCall& call) {
  return provenanceOf(call.services(), call.shape()).cell.value_or(CellMark{});
}

Value counted(uint32_t v) { return Value::of(static_cast<double>(v)); }

// Columns and rows are those of a grid; other cells have a number alone.
CellMark gridCellOf(const FunctionCall& call) {
  const CellMark cell = cellOf(call);
  return cell.free ? CellMark{} : cell;
}

Value ix(FunctionCall& call) { return counted(gridCellOf(call).ix); }
Value iy(FunctionCall& call) { return counted(gridCellOf(call).iy); }
Value nx(FunctionCall& call) { return counted(gridCellOf(call).nx); }
Value ny(FunctionCall& call) { return counted(gridCellOf(call).ny); }
Value index(FunctionCall& call) {
  const CellMark c = cellOf(call);
  return counted(c.free ? c.ix : c.iy * c.nx + c.ix);
}
Value cells(FunctionCall& call) {
  const CellMark c = cellOf(call);
  return counted(c.free ? c.nx : c.nx * c.ny);
}
Value bx(FunctionCall& call) { return counted(cellOf(call).bx()); }
Value by(FunctionCall& call) { return counted(cellOf(call).by()); }
Value part(FunctionCall& call) { return counted(cellOf(call).part); }
Value orphan(FunctionCall& call) {
  const CellMark c = cellOf(call);
  return Value::of(c.free && c.choice == 1);
}
Value mirroredX(FunctionCall& call) { return Value::of(cellOf(call).mirroredX()); }
Value mirroredY(FunctionCall& call) { return Value::of(cellOf(call).mirroredY()); }
Value cellWidth(FunctionCall& call) { return Value::of(cellOf(call).w); }
Value cellHeight(FunctionCall& call) { return Value::of(cellOf(call).h); }
Value depth(FunctionCall& call) {
  return counted(provenanceOf(call.services(), call.shape()).depth);
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

struct Selects {
  Selection selection;
};

// Whether a selection means any part of the outline.
Value selects(FunctionCall& call, const Selects& args) {
  const std::vector<Term> terms = termsOf(args.selection, call.services(), call.randomAddress(900));
  const MeshRef mesh = meshInScope(call.shape());
  const Frame& scope = call.shape().scope;
  for (const size_t f : regionFaces(*mesh)) {
    const RegionView view(call.services(), *mesh, f);
    const auto world = [&] {
      const auto local = [&](const Vec3& d) {
        return view.plane().frame().toLocalDirection(
            scope.toLocalDirection(call.services().world().toLocalDirection(d)));
      };
      return Frame::of({}, local({1, 0, 0}), local({0, 1, 0}), local({0, 0, 1}));
    };
    const SelectionInput input{view, call.randomAddress(1000 + f), world, call.services().pool()};
    const std::vector<EdgePart> parts = selectEdges(terms, input);
    if (!parts.empty()) return Value::of(true);
  }
  return Value::of(false);
}

constexpr ParamSpec kSelection[] = {
    selection<&Selects::selection>("selection", "Edges of the outline, as in peel.", kEdgeTerms)};
constexpr Signature kSelects[] = {{kSelection, ValueType::Bool}};
constexpr FunctionSpec kFunctions[] = {
    {"region.selects", "region", "Whether a selection means any edge of the region.", kSelects,
     typed<selects>, kReadsRegion | kRandom | kReadsWorld | kReadsWorldByWord, false, true},
};

constexpr ValueType kFloat = ValueType::Float;
constexpr ValueType kBool = ValueType::Bool;

constexpr AttributeSpec ofRegion(const char* name, ValueType type, const char* doc,
                                 Value (*get)(FunctionCall&)) {
  return {name, type, doc, get, nullptr, kReadsRegion};
}

constexpr AttributeSpec kAttributes[] = {
    ofRegion(
        "region.index", kFloat,
        "Number of the cell that the region is or was cut from, from 0: of a grid row by row, of "
        "voronoi and castRays in the order of the sites or rays.",
        index),
    ofRegion("region.cells", kFloat, "How many cells the operation made; 1 outside of cells.",
             cells),
    ofRegion(
        "region.ix", kFloat,
        "Column of the grid cell that the region is or was cut from, from the west; 0 outside of "
        "grids.",
        ix),
    ofRegion("region.iy", kFloat, "Row of the grid cell, from the south; 0 outside of grids.", iy),
    ofRegion("region.nx", kFloat, "How many columns the grid has; 1 outside of grids.", nx),
    ofRegion("region.ny", kFloat, "How many rows the grid has; 1 outside of grids.", ny),
    ofRegion("region.bx", kFloat,
             "Columns between the cell and the nearer end of its row; of a Voronoi cell, the cells "
             "between "
             "it and the boundary.",
             bx),
    ofRegion("region.by", kFloat, "Rows between the cell and the nearer end of its column.", by),
    ofRegion("region.piece", kFloat,
             "Which part of its cell the region is, when the cell fell apart.", part),
    kRegionChoice,
    ofRegion("region.orphan", kBool,
             "Whether the region is a part of a Voronoi cell that its site is not in, kept by "
             "orphans=own.",
             orphan),
    ofRegion("region.mx", kBool, "Whether the cell is mirrored in x; see grid.", mirroredX),
    ofRegion("region.my", kBool, "Whether the cell is mirrored in y.", mirroredY),
    ofRegion("region.w", kFloat,
             "Width that the cell was laid out with, before it was cut to the region.", cellWidth),
    ofRegion("region.h", kFloat, "Height that the cell was laid out with.", cellHeight),
    ofRegion("region.depth", kFloat, "How many partitions lie behind the region.", depth),
    ofRegion("region.border", kBool,
             "Whether a part of the region's outline is that of the initial one.", onBorder),
};

}  // namespace

extern const FunctionList kFunctions_region;
const FunctionList kFunctions_region = {kFunctions, kAttributes};

}  // namespace gable
