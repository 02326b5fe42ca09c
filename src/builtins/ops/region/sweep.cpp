// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines along a boundary, as ribbons of a width or as bare segments.
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"

namespace gable {

namespace {

Status checked(const OpCall& call, double inset) {
  if (std::isfinite(inset) && inset >= 0) return {};
  return call.fail("bad-argument", "an inset is zero or more metres", "write 0 or leave it out");
}

Status applySweep(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const double width = call.number(1), inset = call.number(2, 0);
  if (!(width > 0) || !std::isfinite(width)) {
    return call.fail("bad-argument", "a ribbon needs a width above zero",
                     "to get lines without a width write parametrise");
  }
  const std::string options = textOf(call, 3, "");
  RibbonOptions ribbon;
  if (!option(options, "round").empty()) ribbon = {true, RibbonEnds::Round};
  if (option(options, "joins") == "round") ribbon.roundJoins = true;
  const std::string ends = option(options, "ends");
  if (ends == "round") ribbon.ends = RibbonEnds::Round;
  if (ends == "square") ribbon.ends = RibbonEnds::Square;
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Polyline> lines;
    Status status = checked(call, inset);
    if (status.ok()) status = linesOf(call, 0, inset, job, f, view, lines);
    if (!status.ok()) return status;
    for (const RegionPiece& p : ribbons(view.polygon(), lines, width, ribbon)) {
      if (slot) {
        call.emit(view.shapeOf(call.shape(), p, view.marksOf(p, EdgeIndex::Outline), std::nullopt),
                  *slot, piece);
      }
      ++piece;
    }
  }
  if (piece == 0) giveToOtherwise(call);
  return {};
}

Status applyParametrise(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const double inset = call.number(1, 0);
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  for (size_t f = 0; f < job.faces().size(); ++f) {
    const RegionView& view = *job.faces()[f];
    std::vector<Polyline> lines;
    Status status = checked(call, inset);
    if (status.ok()) status = linesOf(call, 0, inset, job, f, view, lines);
    if (!status.ok()) return status;
    for (const Polyline& line : lines) {
      const size_t n = line.points.size();
      for (size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
        if (slot) {
          call.emit(view.segmentAt(call.shape(), line.points[i], line.points[(i + 1) % n]), *slot,
                    piece);
        }
        ++piece;
      }
    }
  }
  if (piece == 0) giveToOtherwise(call);
  return {};
}

constexpr ParamSpec kLines = {
    "lines", ParamType::Selector,
    "A selection of edges as in peel, or ranges along the logical edges from 0 on: "
    "\"[0.02,1] [0,1] [0,0.15]\", [] for none, _ for a whole edge."};
constexpr ParamSpec kInset = {"inset", ParamType::Float, "How far inside the boundary.", "0"};
constexpr ParamSpec kSweep[] = {
    kLines,
    {"width", ParamType::Float, "Of the ribbon, in metres."},
    kInset,
    {"options", ParamType::String, "joins=mitre|round, ends=butt|square|round; round: both.",
     "\"\""}};
constexpr ParamSpec kParametrise[] = {kLines, kInset};
constexpr Signature kSweepSignatures[] = {{kSweep}};
constexpr Signature kParametriseSignatures[] = {{kParametrise}};

constexpr OpSpec kSpecs[] = {
    {"sweep", "region", "Makes ribbons of a width along the boundary of a region.",
     kSweepSignatures, applySweep, BlockKind::Operations, kRandom | kReadsWorld | kReadsWorldByWord,
     "otherwise", false, true},
    {"parametrise", "region", "Gives out parts of the boundary as straight lines.",
     kParametriseSignatures, applyParametrise, BlockKind::Operations,
     kRandom | kReadsWorld | kReadsWorldByWord, "otherwise", false, true},
};

}  // namespace

extern const OpList kOps_sweep;
const OpList kOps_sweep = kSpecs;

}  // namespace gable
