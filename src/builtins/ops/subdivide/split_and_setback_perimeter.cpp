// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The geometry is that of shared/perimeter.h. A depth is worked out for each section; its code lies
// where other blocks keep the figure of a slot.
#include <algorithm>
#include <cmath>
#include <optional>

#include "builtins/lists.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/ops/subdivide/shared/perimeter.h"
#include "builtins/ops/subdivide/shared/slabs.h"
#include "builtins/ops/subdivide/shared/split_sizes.h"
#include "program/program.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct SplitAndSetback {
  Size splitOffset;
  double firstEdgeIndex = 0;
  std::optional<Bools> selectedEdgesMask;
};

double depthOf(OpCall& call, const SplitPieces& sections, uint32_t i) {
  const uint32_t code = call.figureCode(sections[i].slot);
  if (code == 0) return 0;
  const ValueCode& depth = call.services().program()->figures[code - 1].values[0];
  if (depth.isConstant()) return depth.constant.number;
  const Shape as = numbered(call.shape(), i, sections.size());
  const uint64_t address = call.randomAddress(i);
  return call.services().evaluate(depth.entry, address, &as).number;
}

void emitPart(OpCall& call, Mesh mesh, Shape child, uint32_t slot, uint32_t piece) {
  if (mesh.empty()) return;
  setPartMesh(child, call.shape(), std::move(mesh), true);
  forgetFarTrimPlanes(child);
  call.emit(std::move(child), slot, piece);
}

// The slot of the second block is the one that has no size.
std::optional<uint32_t> remainderSlot(const OpCall& call) {
  if (call.slotCount() == 0) return std::nullopt;
  const uint32_t last = call.slotCount() - 1;
  for (const SplitItem& item : call.splitBlock().items) {
    if (!item.group && item.slot == last) return std::nullopt;
  }
  return last;
}

Status applySplitAndSetback(OpCall& call, const SplitAndSetback& args) {
  const MeshRef mesh = meshInScope(call.shape());
  if (mesh->empty()) {
    return call.fail("no-geometry", "the shape has no face whose edges could be set back",
                     "insert a primitive or an asset first");
  }
  const auto* mask = args.selectedEdgesMask ? &args.selectedEdgesMask->array->numbers : nullptr;
  Perimeter perimeter(*mesh, args.firstEdgeIndex, mask, call.services());
  const double whole = perimeter.length();
  if (!(whole > 1e-9)) {
    return call.fail("split-flat", "the selected edges have no length",
                     "select some with 'selectedEdgesMask'");
  }
  SplitPieces sections;
  Status status = dividePattern(call.splitBlock(), whole, sections);
  if (!status.ok()) return status;
  std::vector<double> depth;
  for (uint32_t i = 0; i < sections.size(); ++i) {
    depth.push_back(depthOf(call, sections, i));
    if (std::isfinite(depth.back())) continue;
    return call.fail("setback-distance", "the depth of a section is not a finite number",
                     "check the expression for a division by zero");
  }
  status = perimeter.setBack(sections, args.splitOffset.of(whole), depth);
  if (!status.ok()) return status;
  for (uint32_t i = 0; i < sections.size(); ++i) {
    emitPart(call, perimeter.section(i), numbered(call.shape(), i, sections.size()),
             sections[i].slot, i);
  }
  if (const std::optional<uint32_t> rest = remainderSlot(call)) {
    emitPart(call, perimeter.remainder(), call.shape(), *rest,
             static_cast<uint32_t>(sections.size()));
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&SplitAndSetback::splitOffset>(
        "splitOffset", "Where along the edges the pattern starts, in metres; with ' as a share."),
};
constexpr ParamSpec kMaskParams[] = {
    kParams[0],
    param<&SplitAndSetback::firstEdgeIndex>(
        "firstEdgeIndex", "The edge at which the pattern starts, from 0; wraps around."),
    param<&SplitAndSetback::selectedEdgesMask>(
        "selectedEdgesMask", "For each face edge, in order, whether it takes part."),
};
constexpr Signature kSignatures[] = {{kParams}, {kMaskParams}};
constexpr PartSpec kParts[] = {{"remainder", "What the sections leave of the faces."}};

constexpr OpSpec kSpecs[] = {
    heavy({"splitAndSetbackPerimeter", "subdivide",
           "Divides the outline of faces into sections and sets each back by a depth of its own.",
           kSignatures, typed<applySplitAndSetback>, BlockKind::Split, kRandom | kForgetsOrigins,
           kParts}),
};

}  // namespace

extern const OpList kOps_split_and_setback_perimeter;
const OpList kOps_split_and_setback_perimeter = kSpecs;

}  // namespace gable
