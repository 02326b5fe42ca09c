// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Discs scattered in a region.
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"

namespace gable {

namespace {

constexpr double kMostDiscs = 5000;
constexpr size_t kMostPoints = 100000;

Status applyScatterCircles(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  DrawnRange radius;
  const std::string written = textOf(call, 1, "1");
  TextReader r(written);
  const double n = call.number(0);
  if (!r.range(radius) || !r.atEnd() || !(radius.low > 0) || !(radius.high > 0) ||
      !(n >= 0 && n <= kMostDiscs)) {
    return call.fail("bad-argument", "there can be 0 to 5000 discs of radii above zero",
                     "write a count and a radius: scatterCircles(5, \"[2,4]\")");
  }
  if (const Status status = optionsAre(call, 2, "gap=# edge=#"); !status.ok()) return status;
  const std::string options = textOf(call, 2, "");
  const auto metres = [&](std::string_view name) {
    double v = 0;
    parseNumber(option(options, name), v);
    return v;
  };
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Disc> discs;
    if (n == 0) {
      const double r0 = std::max(radius.low, radius.high);
      for (const Vec2 at :
           scatterPoisson(view.polygon(), 2 * r0 + metres("gap"), r0 + metres("edge"), kMostPoints,
                          call.randomAddress(f))) {
        discs.push_back({at, r0});
      }
    } else {
      ScatterOptions o;
      o.count = static_cast<uint32_t>(n);
      o.least = std::min(radius.low, radius.high);
      o.most = std::max(radius.low, radius.high);
      o.gap = metres("gap");
      o.edge = metres("edge");
      o.seed = call.randomAddress(f);
      discs = scatterDiscs(view.polygon(), o);
      if (discs.size() < o.count) {
        call.services().warn("scatter-full", "'scatterCircles': fewer discs fit than were wanted",
                             "scatter fewer or smaller ones");
      }
    }
    for (const Disc& d : discs) {
      RegionPiece p;
      p.polygon.outer = ringOf({PlanShape::Circle, d.radius, 0, 24}, d.centre);
      p.edges.assign(24, {kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
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

constexpr ParamSpec kParams[] = {
    {"count", ParamType::Float, "How many; 0 for as many as fit."},
    {"radius", ParamType::Any, "In metres, or a range that is drawn from: \"[2,4]\"."},
    {"options", ParamType::String, "gap=1: metres between discs; edge=2: metres to the boundary.",
     "\"\""},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"scatterCircles", "region", "Scatters discs that touch neither each other nor the boundary.",
     kSignatures, applyScatterCircles, BlockKind::Operations, kRandom, "otherwise", false, true},
};

}  // namespace

extern const OpList kOps_scatter_circles;
const OpList kOps_scatter_circles = kSpecs;

}  // namespace gable
