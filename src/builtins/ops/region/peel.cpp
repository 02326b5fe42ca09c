// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Strips along the boundary, and contracting; the kernel is geom/region/peel.
#include "geom/region/peel.h"

#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/cut_holes.h"
#include "geom/region/places.h"

namespace gable {

enum class Towards : uint8_t { Boundary, Centre, Center };

template <>
struct WordsOf<Towards> {
  static constexpr const char* text = "boundary centre center";
};

namespace {

struct Peel {
  Selection selection;
  std::optional<Size> width;
  bool orthogonal = false;
  Selection smooth;
};

// The edges to move, with their distances: the one for all, or their own where they have one.
std::vector<PeelEdge> edgesOf(const OpCall& call, const Peel& args, const RegionJob& job, size_t f,
                              double distance) {
  std::vector<OwnWidth> widths;
  std::vector<PeelEdge> edges;
  for (const EdgePart& p : selected(call, args.selection, job, f, &widths)) {
    edges.push_back({p.edge, p.from, p.to, distance});
  }
  for (const OwnWidth& own : widths) {
    for (const EdgePart& p : own.parts) {
      std::erase_if(edges, [&](const PeelEdge& e) { return e.edge == p.edge; });
      edges.push_back({p.edge, p.from, p.to, own.metres});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const PeelEdge& a, const PeelEdge& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.from < b.from;
  });
  return edges;
}

Status applyPeel(OpCall& call, const Peel& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const PeelEnds ends = args.orthogonal ? PeelEnds::Orthogonal : PeelEnds::Follow;
  const Smoothing smoothing =
      smoothingOf(termsOf(args.smooth, call.services(), call.randomAddress(901)));
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    // Shares are of the largest distance that there is.
    double distance = args.width ? args.width->number : 0;
    if (args.width && args.width->unit == Unit::Relative) {
      distance *= poleOf(view.polygon()).radius;
    }
    const std::vector<PeelEdge> edges = edgesOf(call, args, job, f, distance);
    if (edges.empty()) {
      return call.orElse(
          call.fail("empty-selection", "the selection means no edge of this region",
                    "select others, or write what else shall happen: otherwise : ..."));
    }
    const bool wide = std::all_of(edges.begin(), edges.end(), [](const PeelEdge& e) {
      return e.distance > 0 && std::isfinite(e.distance);
    });
    if (!wide) {
      return call.orElse(call.fail("bad-argument", "a strip needs a width above zero",
                                   "write metres, or a share of the region's inner radius: '0.5"));
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

struct Contract {
  Size size;
  Towards towards = Towards::Boundary;
};

// Of a face: moved inward by a distance and, towards a centre, drawn together besides.
std::vector<RegionPiece> contracted(const Polygon& p, const Size& size, bool towards) {
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

Status applyContract(OpCall& call, const Contract& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  std::vector<std::vector<RegionPiece>> pieces;
  bool any = false;
  for (const auto& view : job.faces()) {
    pieces.push_back(contracted(view->polygon(), args.size, args.towards != Towards::Boundary));
    any = any || !pieces.back().empty();
  }
  if (!any) {
    return call.orElse(call.fail("region-vanished", "nothing of the region is left",
                                 "contract by less; half of its width is the most"));
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
    selection<&Peel::selection>(
        "selection",
        "The edges that are moved: outer && !side(west). Those under wide() "
        "have a width of their own.",
        kEdgeTerms),
    param<&Peel::width>("width",
                        "How far, in metres or, with ', as a share of the radius of the largest "
                        "disc inside.",
                        "what wide() says")
        .above(0)
        .unless("wide"),
    param<&Peel::orthogonal>("orthogonal", "Strips end square to their edge.", "false"),
    selection<&Peel::smooth>("smooth",
                             "How the border between strip and rest is smoothed: none, average(2), "
                             "chaikin(2), bezier, round(1), or how many averages.",
                             site_terms::kSmoothing, "none", true),
};
constexpr ParamSpec kContract[] = {
    param<&Contract::size>(
        "size", "How far, in metres; with ' every vertex goes this share of its way to the centre.")
        .atLeast(0),
    param<&Contract::towards>(
        "towards", "boundary: only inward; centre: drawn together towards the centre besides.",
        "boundary"),
};
constexpr Signature kCutHolesSignatures[] = {{}};
constexpr Signature kPeelSignatures[] = {{kPeel}};
constexpr Signature kContractSignatures[] = {{kContract}};

constexpr PartSpec kPeelParts[] = {{"strip", "A strip along an edge, or along several that meet."},
                                   {"rest", "What the strips leave of the region."},
                                   kOtherwise};
constexpr OpSpec kSpecs[] = {
    {"peel", "region", "Takes strips off the boundary of a region.", kPeelSignatures,
     typed<applyPeel>, BlockKind::Selectors,
     kReadsRegion | kRandom | kReadsWorld | kReadsWorldByWord, kPeelParts, false, true},
    {"contract", "region", "Moves the boundary of a region inward.", kContractSignatures,
     typed<applyContract>, BlockKind::Operations, kReadsRegion, kOtherwiseOnly, true, true},
    {"cutHoles", "region", "Cuts a region apart so that no part of it has a hole.",
     kCutHolesSignatures, applyCutHoles, BlockKind::None, kReadsRegion, kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_peel;
const OpList kOps_peel = kSpecs;

}  // namespace gable
