// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Strips along the boundary, and contracting; the kernel is geom/region/peel.
#include "geom/region/peel.h"

#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/plan_text.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/cut_holes.h"
#include "geom/region/places.h"

namespace gable {

namespace {

// "{W: 2, N & outer: 4}": selections with distances of their own. Later ones win.
struct OwnDistance {
  std::string selection;
  double metres = 0;
};

bool readDistances(std::string_view text, std::vector<OwnDistance>& out) {
  size_t begin = 0, depth = 0;
  for (size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ',';
    if (c == '(' || c == '[') ++depth;
    if ((c == ')' || c == ']') && depth > 0) --depth;
    if (c != ',' || (depth > 0 && i < text.size())) continue;
    const std::string_view item = text.substr(begin, i - begin);
    begin = i + 1;
    const size_t colon = item.rfind(':');
    if (colon == std::string_view::npos) return false;
    TextReader r(item.substr(colon + 1));
    OwnDistance d{std::string(item.substr(0, colon)), 0};
    if (!r.number(d.metres) || !r.atEnd() || !std::isfinite(d.metres)) return false;
    out.push_back(std::move(d));
  }
  return true;
}

// The edges to move, with their distances.
Status edgesOf(OpCall& call, const RegionJob& job, size_t f, double distance,
               std::vector<PeelEdge>& edges) {
  const RegionView& view = *job.faces()[f];
  const std::string text = textOf(call, 0, "outer");
  TextReader r(text);
  std::vector<EdgePart> parts;
  if (!r.accept('{')) {
    const Status status = selected(call, 0, "outer", job, f, view, parts);
    for (const EdgePart& p : parts) edges.push_back({p.edge, p.from, p.to, distance});
    return status;
  }
  std::vector<OwnDistance> own;
  const size_t close = text.rfind('}');
  const bool read = close != std::string::npos && close >= r.place() &&
                    readDistances(std::string_view(text).substr(r.place(), close - r.place()), own);
  if (!read) {
    return call.fail("bad-selection", "these are no selections with distances",
                     "write \"{side(W): 2, side(N): 4}\"");
  }
  for (const OwnDistance& d : own) {
    std::string problem;
    parts.clear();
    const SelectionInput input{view, call.randomAddress(1000 + f), job.worldIn(f)};
    if (!selectEdges(d.selection, input, parts, problem)) {
      return call.fail("bad-selection", "the selection cannot be read: " + problem,
                       "write words like outer, inner, side(W), longest, with & | - !");
    }
    for (const EdgePart& p : parts) {
      std::erase_if(edges, [&](const PeelEdge& e) { return e.edge == p.edge; });
      edges.push_back({p.edge, p.from, p.to, d.metres});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const PeelEdge& a, const PeelEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.from < b.from;
  });
  return {};
}

Status applyPeel(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (const Status status = optionsAre(call, 2, "orthogonal smooth=*"); !status.ok()) {
    return status;
  }
  const std::string options = textOf(call, 2, "");
  const PeelEnds ends =
      option(options, "orthogonal").empty() ? PeelEnds::Follow : PeelEnds::Orthogonal;
  Smoothing smoothing;
  if (!readSmoothing(option(options, "smooth"), smoothing)) {
    return call.fail("bad-argument", "there is no such smoothing",
                     "write smooth=average(2), chaikin(2) or bezier");
  }
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    // Shares are of the largest distance that there is.
    const Value& v = call.arg(1);
    double distance = v.number;
    if (v.unit == Unit::Relative) distance *= poleOf(view.polygon()).radius;
    const bool own = textOf(call, 0, "outer").find('{') != std::string::npos;
    if ((!own && !(distance > 0)) || !std::isfinite(distance)) {
      return failOrElse(call, "bad-argument", "a strip needs a width above zero",
                        "write metres, or a share of the region's inner radius: '0.5");
    }
    std::vector<PeelEdge> edges;
    const Status status = edgesOf(call, job, f, distance, edges);
    if (!status.ok()) return status;
    if (edges.empty()) {
      return failOrElse(call, "empty-selection", "the selection means no edge of this region",
                        "select others, or write what else shall happen: otherwise : ...");
    }
    PeelResult r = peel(view.polygon(), edges, ends, smoothing);
    for (RegionPiece& p : r.strips) {
      std::vector<EdgeMark> marks = view.marksOf(p, EdgeIndex::Inherited);
      job.keep(f, "strip", std::move(p), std::move(marks), view.cell());
    }
    for (RegionPiece& p : r.rest) {
      std::vector<EdgeMark> marks = view.marksOf(p, EdgeIndex::Inherited);
      job.keep(f, "rest", std::move(p), std::move(marks), view.cell());
    }
  }
  job.emit();
  return {};
}

// Of a face: moved inward by a distance and, towards a centre, drawn together besides.
std::vector<RegionPiece> contracted(const Polygon& p, const Value& size, bool towards) {
  if (size.unit == Unit::Relative) return contractTowards(p, size.number, middleOf(p));
  std::vector<RegionPiece> pieces = contract(p, size.number);
  if (!towards || pieces.empty()) return pieces;
  const double radius = poleOf(p).radius;
  const double share = radius > 0 ? std::min(0.9, size.number / radius) : 0;
  std::vector<RegionPiece> both;
  const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
  Region inner;
  for (const RegionPiece& c : contractTowards(p, share, middleOf(p))) inner.push_back(c.polygon);
  for (const RegionPiece& c : pieces) {
    for (RegionPiece& part : combineTraced(BooleanOp::Intersection, c, inner, made)) {
      both.push_back(std::move(part));
    }
  }
  return both;
}

Status applyContract(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  const Value& v = call.arg(0);
  if (!std::isfinite(v.number) || v.number < 0) {
    return call.fail("bad-argument", "a region is contracted by zero or more",
                     "write metres, or a share: '0.2");
  }
  std::vector<std::vector<RegionPiece>> pieces;
  bool any = false;
  for (const auto& view : job.faces()) {
    pieces.push_back(contracted(view->polygon(), v, call.has(1)));
    any = any || !pieces.back().empty();
  }
  if (!any) {
    return failOrElse(call, "region-vanished", "nothing of the region is left",
                      "contract by less; half of its width is the most");
  }
  job.replace(call.shape(), pieces);
  return {};
}

Status applyCutHoles(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  const bool holes = std::any_of(job.faces().begin(), job.faces().end(),
                                 [](const auto& view) { return !view->polygon().holes.empty(); });
  if (!holes) return {};
  std::vector<std::vector<RegionPiece>> pieces;
  for (const auto& view : job.faces()) pieces.push_back(withoutHoles(view->polygon()));
  job.replace(call.shape(), pieces, true);
  return {};
}

constexpr ParamSpec kPeel[] = {
    {"selection", ParamType::Selector,
     "The edges that are moved: outer, \"outer & !side(W)\"; or selections with distances of their "
     "own, \"{side(W): 2, side(N): 4}\", which then hold in the place of the size."},
    {"size", ParamType::Size,
     "How far, in metres or, with ', as a share of the radius of the largest disc inside."},
    {"options", ParamType::String,
     "orthogonal: strips end square to their edge; smooth=average(2) (or chaikin(2), bezier): the "
     "border "
     "between strip and rest is smoothed.",
     "\"\""},
};
constexpr ParamSpec kContract[] = {
    {"size", ParamType::Size,
     "How far, in metres; with ' every vertex goes this share of its way to the centre."},
    {"towards", ParamType::Selector, "Also draw the region together towards its centre.", nullptr,
     "centre center"},
};
constexpr ParamSpec kContractPlain[] = {kContract[0]};
constexpr Signature kCutHolesSignatures[] = {{}};
constexpr Signature kPeelSignatures[] = {{kPeel}};
constexpr Signature kContractSignatures[] = {{kContractPlain}, {kContract}};

constexpr OpSpec kSpecs[] = {
    {"peel", "region", "Takes strips off the boundary of a region.", kPeelSignatures, applyPeel,
     BlockKind::Selectors, kRandom | kReadsWorld | kReadsWorldByWord, "strip rest otherwise", false,
     true},
    {"contract", "region", "Moves the boundary of a region inward.", kContractSignatures,
     applyContract, BlockKind::Operations, kPure, "otherwise", true, true},
    {"cutHoles", "region", "Cuts a region apart so that no part of it has a hole.",
     kCutHolesSignatures, applyCutHoles, BlockKind::None, kPure, nullptr, false, true},
};

}  // namespace

extern const OpList kOps_peel;
const OpList kOps_peel = kSpecs;

}  // namespace gable
