// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Strips along the boundary, and contracting; the kernel is geom/region/peel.
#include "geom/region/peel.h"

#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/places.h"

namespace gable {

namespace {

Status applyPeel(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const PeelEnds ends =
      option(textOf(call, 2, ""), "orthogonal").empty() ? PeelEnds::Follow : PeelEnds::Orthogonal;
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    // Shares are of the largest distance that there is.
    const Value& v = call.arg(1);
    double distance = v.number;
    if (v.unit == Unit::Relative) distance *= poleOf(view.polygon()).radius;
    if (!(distance > 0) || !std::isfinite(distance)) {
      return failOrElse(call, "bad-argument", "a strip needs a width above zero",
                        "write metres, or a share of the region's inner radius: '0.5");
    }
    std::vector<EdgePart> parts;
    const Status status = selected(call, 0, "outer", job, f, view, parts);
    if (!status.ok()) return status;
    if (parts.empty()) {
      return failOrElse(call, "empty-selection", "the selection means no edge of this region",
                        "select others, or write what else shall happen: otherwise : ...");
    }
    std::vector<PeelEdge> edges;
    for (const EdgePart& p : parts) edges.push_back({p.edge, p.from, p.to, distance});
    PeelResult r = peel(view.polygon(), edges, ends);
    for (RegionPiece& p : r.strips) {
      std::vector<EdgeMark> marks = view.marksOf(p, false, false);
      job.keep(f, "strip", std::move(p), std::move(marks), view.cell());
    }
    for (RegionPiece& p : r.rest) {
      std::vector<EdgeMark> marks = view.marksOf(p, false, false);
      job.keep(f, "rest", std::move(p), std::move(marks), view.cell());
    }
  }
  job.emit();
  return {};
}

Status applyContract(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const Value& v = call.arg(0);
  const bool towards = call.has(1) || v.unit == Unit::Relative;
  Shape shape = call.shape();
  if (job.faces().size() != 1) {
    return call.fail("no-geometry", "only a shape of one face can be contracted",
                     "take it apart first: comp(f) { all : contract(1) }");
  }
  RegionView& view = *job.faces()[0];
  if (!std::isfinite(v.number) || v.number < 0) {
    return call.fail("bad-argument", "a region is contracted by zero or more",
                     "write metres, or a share: '0.2");
  }
  std::vector<RegionPiece> pieces;
  if (v.unit == Unit::Relative) {
    pieces = contractTowards(view.polygon(), v.number, middleOf(view.polygon()));
  } else {
    pieces = contract(view.polygon(), v.number);
    if (towards && !pieces.empty()) {
      const double radius = poleOf(view.polygon()).radius;
      const double share = radius > 0 ? std::min(0.9, v.number / radius) : 0;
      std::vector<RegionPiece> both;
      const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
      Region inner;
      for (const RegionPiece& p :
           contractTowards(view.polygon(), share, middleOf(view.polygon()))) {
        inner.push_back(p.polygon);
      }
      for (const RegionPiece& p : pieces) {
        for (RegionPiece& c : combineTraced(BooleanOp::Intersection, p, inner, made)) {
          both.push_back(std::move(c));
        }
      }
      pieces = std::move(both);
    }
  }
  if (pieces.empty()) {
    return call.fail("region-vanished", "nothing of the region is left",
                     "contract by less; half of its width is the most");
  }
  view.replace(shape, pieces);
  call.shape() = std::move(shape);
  return {};
}

constexpr ParamSpec kPeel[] = {
    {"selection", ParamType::Selector, "The edges that are moved: outer, \"outer & !side(W)\"."},
    {"size", ParamType::Size,
     "How far, in metres or, with ', as a share of the radius of the largest disc inside."},
    {"options", ParamType::String, "orthogonal: strips end square to their edge.", "\"\""},
};
constexpr ParamSpec kContract[] = {
    {"size", ParamType::Size,
     "How far, in metres; with ' every vertex goes this share of its way to the centre."},
    {"towards", ParamType::Selector, "Also draw the region together towards its centre.", nullptr,
     "centre center"},
};
constexpr ParamSpec kContractPlain[] = {kContract[0]};
constexpr Signature kPeelSignatures[] = {{kPeel}};
constexpr Signature kContractSignatures[] = {{kContractPlain}, {kContract}};

constexpr OpSpec kSpecs[] = {
    {"peel", "region", "Takes strips off the boundary of a region.", kPeelSignatures, applyPeel,
     BlockKind::Selectors, kRandom | kReadsWorld | kReadsWorldByWord, "strip rest otherwise", false,
     true},
    {"contract", "region", "Moves the boundary of a region inward.", kContractSignatures,
     applyContract, BlockKind::None, kPure, nullptr, false, true},
};

}  // namespace

extern const OpList kOps_peel;
const OpList kOps_peel = kSpecs;

}  // namespace gable
