// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Voronoi cells with paths between; the kernel is geom/region/voronoi.
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/voronoi.h"

namespace gable {

namespace {

bool readSmoothing(const std::string& text, Smoothing& s) {
  TextReader r(text);
  const std::string name = r.word();
  double a = 0, b = 0;
  const bool hasA = r.accept('(') && r.number(a);
  const bool hasB = hasA && r.accept(',') && r.number(b);
  if (hasA && !r.accept(')')) return false;
  if (name.empty() || name == "none") {
    s.kind = Smoothing::Kind::None;
  } else if (name == "average" || name == "chaikin") {
    s.kind = name == "average" ? Smoothing::Kind::Average : Smoothing::Kind::Chaikin;
    if (hasA) s.times = static_cast<uint32_t>(std::clamp(a, 0.0, 6.0));
    if (hasB) s.weight = std::clamp(b, 0.0, 1.0);
  } else if (name == "round") {
    s.kind = Smoothing::Kind::Round;
    s.radius = hasA ? std::max(0.0, a) : 1;
  } else {
    return false;
  }
  return std::isfinite(s.radius);
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
                     "write none, average(2), chaikin(2) or round(1)");
  }
  const std::string options = textOf(call, 3, "");
  o.borderPath = option(options, "borderpath") != "none";
  const std::string orphans = option(options, "orphans");
  o.orphans = orphans == "own" ? Orphans::Own : orphans == "path" ? Orphans::Path : Orphans::Merge;
  for (const SelectorItem& item : call.selectors()) {
    o.centres = o.centres || selectsWord(item, "centre", call.services().pool());
  }
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Disc> sites;
    const Status status = discsOf(call, 0, view, call.randomAddress(f), sites);
    if (!status.ok()) return status;
    VoronoiResult v = voronoiPartition(view.polygon(), sites, o);
    if (v.pieces.empty()) {
      return failOrElse(call, "no-sites", "no site lies in the region",
                        "write smaller radii or other coordinates");
    }
    for (RegionPiece& p : v.pieces) {
      std::vector<EdgeMark> marks = view.marksOf(p, false, p.kind == PieceKind::Cell);
      const std::string_view word = p.kind == PieceKind::Cell   ? "region"
                                    : p.kind == PieceKind::Path ? "path"
                                                                : "centre";
      job.keep(f, word, std::move(p), std::move(marks), std::nullopt);
    }
  }
  job.emit();
  return {};
}

constexpr ParamSpec kParams[] = {
    {"sites", ParamType::Any,
     "A count, a text \"5 {[5,10]}\" (discs of a drawn radius that are scattered), or a list of "
     "coordinates in the region."},
    {"pathWidth", ParamType::Float, "Of the paths between cells; 0 for none.", "3"},
    {"smooth", ParamType::Any,
     "\"none\", \"average(times, weight)\", \"chaikin(times)\" or \"round(radius)\".",
     "\"average(2)\""},
    {"options", ParamType::String, "borderpath=half|none, orphans=merge|own|path.", "\"\""},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"voronoi", "region", "Divides a region into cells around scattered places.", kSignatures,
     applyVoronoi, BlockKind::Selectors, kRandom, "region path centre otherwise", false, true},
};

}  // namespace

extern const OpList kOps_voronoi;
const OpList kOps_voronoi = kSpecs;

}  // namespace gable
