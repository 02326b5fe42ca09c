// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Discs scattered in a region.
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"

namespace gable {

namespace {

constexpr size_t kMostPoints = 100000;

struct ScatterCircles {
  double count = 0;
  Drawn radius;
  double gap = 0, edge = 0;
  bool cut = false;
};

std::vector<Disc> discsIn(OpCall& call, const ScatterCircles& args, const DrawnNumber& radius,
                          const Polygon& p, uint64_t seed) {
  const double least = std::min(radius.low(), radius.high());
  const double most = std::max(radius.low(), radius.high());
  std::vector<Disc> discs;
  if (args.count == 0) {
    for (const Vec2 at :
         scatterPoisson(p, 2 * most + args.gap, most + args.edge, kMostPoints, seed)) {
      discs.push_back({at, most});
    }
    return discs;
  }
  ScatterOptions o;
  o.count = static_cast<uint32_t>(args.count);
  o.least = least;
  o.most = most;
  o.gap = args.gap;
  o.edge = args.edge;
  o.seed = seed;
  discs = scatterDiscs(p, o);
  if (!discs.empty() && discs.size() < o.count) {
    call.services().note("scatter-full",
                         "'scatterCircles': " + std::to_string(discs.size()) + " of " +
                             std::to_string(o.count) + " discs found a place",
                         "scatter fewer or smaller ones");
  }
  return discs;
}

Status applyScatterCircles(OpCall& call, const ScatterCircles& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const DrawnNumber radius = numberOf(args.radius, call.services(), call.randomAddress(902));
  if (!(radius.low() > 0) || !(radius.high() > 0) || !std::isfinite(radius.high())) {
    return call.fail("bad-argument", "discs need a radius above zero",
                     "write metres, or draw them: scatterCircles(5, rand(2, 4))");
  }
  if (args.cut && !job.flat()) return noOneRegion(call);
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  std::vector<std::vector<RegionPiece>> left;
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    Region taken;
    for (const Disc& d : discsIn(call, args, radius, view.polygon(), call.randomAddress(f))) {
      RegionPiece p;
      p.polygon.outer = ringOf({PlanShape::Circle, d.radius, 0, 24}, d.centre);
      p.edges.assign(24, {kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide});
      taken.push_back(p.polygon);
      if (slot) {
        call.emit(view.shapeOf(call.shape(), p, view.marksOf(p, EdgeIndex::Outline), std::nullopt),
                  *slot, piece);
      }
      ++piece;
    }
    if (!args.cut) continue;
    const EdgeOrigin made{kNoEdge, EdgeRole::Hole, EdgeOrigin::kNoSide};
    left.push_back(combineTraced(BooleanOp::Difference, wholePiece(view.polygon()), taken, made));
  }
  if (piece == 0) {
    if (!slotOf(call, "otherwise")) {
      call.services().warn("scatter-full", "'scatterCircles': no disc found a place",
                           "write smaller ones, or what else shall happen: otherwise : ...");
    }
    call.giveToOtherwise();
  } else if (args.cut) {
    job.replace(call.shape(), left);
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&ScatterCircles::count>("count", "How many; 0 for as many as fit.")
        .between(0, kMostDiscs),
    param<&ScatterCircles::radius>("radius", "In metres, or drawn for each: rand(2, 4).", "1")
        .above(0),
    param<&ScatterCircles::gap>("gap", "Metres between discs.", "0").atLeast(0),
    param<&ScatterCircles::edge>("edge", "Metres to the boundary.", "0").atLeast(0),
    param<&ScatterCircles::cut>("cut", "The discs are cut out of the region.", "false"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"scatterCircles", "region", "Scatters discs that touch neither each other nor the boundary.",
     kSignatures, typed<applyScatterCircles>, BlockKind::Operations, kReadsRegion | kRandom,
     kOtherwiseOnly, false, true},
};

}  // namespace

extern const OpList kOps_scatter_circles;
const OpList kOps_scatter_circles = kSpecs;

}  // namespace gable
