// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Voronoi cells with paths between; the kernel is geom/region/voronoi.
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/plan_text.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/voronoi.h"

namespace gable {

namespace {

// A piece that its site is not in, of a cell that has another which it is in.
bool isOrphan(const RegionPiece& p, const VoronoiResult& v) {
  const Vec2 site = v.sites[p.ix].centre;
  return !contains(p.polygon, site) &&
         std::any_of(v.pieces.begin(), v.pieces.end(), [&](const RegionPiece& o) {
           return o.kind == PieceKind::Cell && o.ix == p.ix && contains(o.polygon, site);
         });
}

Status applyVoronoi(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  VoronoiOptions o;
  o.pathWidth = call.number(1, 3);
  if (!(o.pathWidth >= 0) || !std::isfinite(o.pathWidth)) {
    return call.fail("bad-argument", "a path cannot be " + shortestText(o.pathWidth) + " wide",
                     "write a width of zero or more");
  }
  if (!readSmoothing(textOf(call, 2, "average(2)"), o.smoothing)) {
    return call.fail("bad-argument", "there is no such smoothing",
                     "write none, average(2), chaikin(2), bezier or round(1)");
  }
  if (const Status status =
          optionsAre(call, 3, "borderpath=half|none orphans=merge|own|path jitter=#");
      !status.ok()) {
    return status;
  }
  const std::string options = textOf(call, 3, "");
  o.borderPath = option(options, "borderpath") != "none";
  const std::string orphans = option(options, "orphans");
  o.orphans = orphans == "own" ? Orphans::Own : orphans == "path" ? Orphans::Path : Orphans::Merge;
  parseNumber(option(options, "jitter"), o.jitter);
  bool junctions = false;
  for (const SelectorItem& item : call.selectors()) {
    junctions = junctions || selectsWord(item, "junction", call.services().pool());
    o.centres = o.centres || selectsWord(item, "centre", call.services().pool());
  }
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Disc> sites;
    const Status status = discsOf(call, 0, view, call.randomAddress(f), sites);
    if (!status.ok()) return status;
    o.seed = call.randomAddress(500 + f);
    VoronoiResult v = voronoiPartition(view.polygon(), sites, o);
    if (v.pieces.empty()) {
      return failOrElse(call, "no-sites", "no site lies in the region",
                        "write smaller radii or other coordinates");
    }
    for (RegionPiece& p : v.pieces) {
      std::vector<EdgeMark> marks =
          view.marksOf(p, p.kind == PieceKind::Cell ? EdgeIndex::Chains : EdgeIndex::Inherited);
      // Without a part of their own in the block junctions are path.
      const std::string_view word = p.kind == PieceKind::Cell                    ? "region"
                                    : p.kind == PieceKind::Remainder             ? "centre"
                                    : p.kind == PieceKind::Junction && junctions ? "junction"
                                                                                 : "path";
      std::optional<CellMark> cell;
      if (p.kind == PieceKind::Cell) {
        const Vec2 size = bounds(p.polygon).size();
        cell = CellMark{p.ix,
                        p.iy,
                        static_cast<uint32_t>(v.sites.size()),
                        1,
                        size.x,
                        size.y,
                        CellPattern::Local,
                        p.part};
        cell->free = true;
        cell->choice = isOrphan(p, v) ? 1 : 0;
      }
      job.keep(f, word, std::move(p), std::move(marks), cell);
    }
  }
  job.emit();
  return {};
}

constexpr ParamSpec kParams[] = {
    {"sites", ParamType::Any,
     "A count, a text \"5 {[5,10]}\" (discs of a drawn radius that are scattered), places \"(3, 4) "
     "(10, 4, 2)\", with a radius or without, or a list of coordinates in the region."},
    {"pathWidth", ParamType::Float, "Of the paths between cells; 0 for none.", "3"},
    {"smooth", ParamType::Any,
     "\"none\", \"average(times, weight)\", \"chaikin(times)\", \"bezier\" or \"round(radius)\".",
     "\"average(2)\""},
    {"options", ParamType::String,
     "borderpath=half|none, orphans=merge|own|path, jitter=0.5 (metres by which borders are bent).",
     "\"\""},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"voronoi", "region", "Divides a region into cells around scattered places.", kSignatures,
     applyVoronoi, BlockKind::Selectors, kRandom, "region path junction centre otherwise", false,
     true},
};

}  // namespace

extern const OpList kOps_voronoi;
const OpList kOps_voronoi = kSpecs;

}  // namespace gable
