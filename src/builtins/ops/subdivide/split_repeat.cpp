// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The number of pieces comes from the preferred size (@PreferredSize) of the rule in the block; the
// pieces then share the length equally, so that all of them are one shape.

#include <cmath>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/subdivide/shared/cells.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr double kFlat = 1e-9;

void emitCells(OpCall& call, Cells& cells, size_t rows, size_t columns) {
  const auto total = static_cast<uint32_t>(rows * columns);
  for (uint32_t k = 0; k < total; ++k) {
    work();
    Shape child;
    if (!cells.take(k / columns, k % columns, child)) continue;
    child.split = {k, total};
    call.emit(std::move(child), 0, k);
  }
}

struct SplitEvenly {
  Axis axis;
  Word rounding;
};

Status applyRepeat(OpCall& call, const SplitEvenly& args) {
  const Axis axis = args.axis;
  const Shape& s = call.shape();
  const double whole = std::fabs(component(s.size, axis));
  if (!(whole > kFlat)) return flatAlong(call, axis);
  SplitPieces pieces;
  const Status status =
      equalPieces(whole, component(call.preferredSize(0), axis), args.rounding.text, pieces);
  if (!status.ok()) return status;
  const SplitPieces none;
  Cells cells(s, axis, pieces, axis, none);
  emitCells(call, cells, pieces.size(), 1);
  return {};
}

Status applyGrid(OpCall& call, const SplitEvenly& args) {
  const Axis axis = args.axis;
  const Shape& s = call.shape();
  AxisPair pair;
  if (!axesAround(s, axis, pair)) return flatAlong(call, axis);
  // The outer loop runs along x, or along z where x stays whole.
  if (pair.whole == Axis::X) std::swap(pair.u, pair.v);
  const Vec3 preferred = call.preferredSize(0);
  SplitPieces rows, columns;
  for (const auto& [a, out] : {std::pair{pair.u, &rows}, std::pair{pair.v, &columns}}) {
    const double whole = std::fabs(component(s.size, a));
    const Status status = equalPieces(whole, component(preferred, a), args.rounding.text, *out);
    if (!status.ok()) return status;
  }
  if (uint64_t{rows.size()} * columns.size() > kMaxSplitPieces) {
    return call.fail("split-too-many",
                     "this would make more than " + std::to_string(kMaxSplitPieces) + " shapes",
                     "make the preferred size larger");
  }
  Cells cells(s, pair.u, rows, pair.v, columns);
  emitCells(call, cells, rows.size(), columns.size());
  return {};
}

constexpr ParamSpec kRounding = param<&SplitEvenly::rounding>(
    "rounding",
    "How the number of pieces comes of length / preferred size: to the nearest number, halves up "
    "or "
    "to the even one; to the number whose pieces are nearest in size; up; or down.",
    "halfUp", "halfUp even closest ceil floor");
constexpr ParamSpec kRepeatParams[] = {
    param<&SplitEvenly::axis>("axis", "The scope axis along which to divide."),
    kRounding,
};
constexpr ParamSpec kGridParams[] = {
    param<&SplitEvenly::axis>("axis",
                              "The scope axis that is not divided. A flat shape is divided in its "
                              "plane, whatever the axis."),
    kRounding,
};
constexpr Signature kRepeatSignatures[] = {{kRepeatParams}};
constexpr Signature kGridSignatures[] = {{kGridParams}};

constexpr OpSpec kSpecs[] = {
    {"splitGrid", "subdivide",
     "Divides the shape along two axes into equal parts that fit the preferred size of what they "
     "become.",
     kGridSignatures, typed<applyGrid>, BlockKind::Operations, kPure, kNoParts, false, true},
    {"splitRepeat", "subdivide",
     "Divides the shape along an axis into equal parts that fit the preferred size of what they "
     "become.",
     kRepeatSignatures, typed<applyRepeat>, BlockKind::Operations, kPure, kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_split_repeat;
const OpList kOps_split_repeat = kSpecs;

}  // namespace gable
