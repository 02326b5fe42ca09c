// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Voronoi cells with paths between; the kernel is geom/region/voronoi.
#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_attributes.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/voronoi.h"

namespace gable {

template <>
struct WordsOf<Orphans> {
  static constexpr const char* text = "merge own path";
};

namespace {

struct Voronoi {
  Selection sites;
  double path = 3;
  Selection smooth;
  Drawn radius;
  bool borderPath = true;
  Orphans orphans = Orphans::Merge;
  double jitter = 0;
};

// A piece that its site is not in, of a cell that has another which it is in.
bool isOrphan(const RegionPiece& p, const VoronoiResult& v) {
  const Vec2 site = v.sites[p.ix].centre;
  return !contains(p.polygon, site) &&
         std::any_of(v.pieces.begin(), v.pieces.end(), [&](const RegionPiece& o) {
           return o.kind == PieceKind::Cell && o.ix == p.ix && contains(o.polygon, site);
         });
}

// The figures that stand at junctions are cut out of everything else; what they leave of their
// junction is path.
Status placeFigures(OpCall& call, uint32_t slot, const RegionView& view, uint64_t seed,
                    std::vector<RegionPiece>& pieces) {
  struct Placed {
    Region ring;
    uint32_t choice;
  };
  std::vector<Placed> figures;
  for (RegionPiece& p : pieces) {
    if (p.kind != PieceKind::Junction) continue;
    const uint64_t address = hashCombine(seed, figures.size());
    const DrawnFigure drawn = drawFigure(call, slot, address, call.shape());
    PlanFigure figure;
    if (!planFigureOf(drawn, figure)) return badFigure(call);
    p.choice = drawn.ordinal;
    if (figure.shape == PlanShape::None) continue;
    p.kind = PieceKind::Path;
    figures.push_back({{{ringOf(figure, middleOf(p.polygon)), {}}}, drawn.ordinal});
  }
  const EdgeOrigin hole{kNoEdge, EdgeRole::Centre, EdgeOrigin::kNoSide};
  const EdgeOrigin made{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
  Region taken;
  std::vector<RegionPiece> centres;
  for (const Placed& f : figures) {
    RegionPiece whole = wholePiece(view.polygon());
    whole.kind = PieceKind::Junction;
    whole.choice = f.choice;
    for (RegionPiece& p : combineTraced(BooleanOp::Intersection, whole, f.ring, made)) {
      // Where figures meet, the first has the place.
      std::vector<RegionPiece> own{std::move(p)};
      if (!taken.empty()) own = combineTraced(BooleanOp::Difference, own[0], taken, made);
      centres.insert(centres.end(), own.begin(), own.end());
    }
    taken.push_back(f.ring[0]);
  }
  if (taken.empty()) return {};
  const Region together = taken.size() > 1 ? repaired(ringsOf(taken), FillRule::NonZero) : taken;
  std::vector<RegionPiece> out;
  for (const RegionPiece& p : pieces) {
    for (RegionPiece& left : combineTraced(BooleanOp::Difference, p, together, hole)) {
      out.push_back(std::move(left));
    }
  }
  out.insert(out.end(), centres.begin(), centres.end());
  pieces = std::move(out);
  return {};
}

// How many sites a number asks for; places are as many as they are.
size_t sitesWanted(std::span<const Term> terms) {
  const bool counted = terms.size() == 1 && terms[0].kind == ArgumentTerm::Kind::Value &&
                       terms[0].values[0].type == ValueType::Float;
  return counted ? static_cast<size_t>(std::max(0.0, terms[0].number(0))) : 0;
}

Status applyVoronoi(OpCall& call, const Voronoi& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  VoronoiOptions o;
  o.pathWidth = args.path;
  const Services& services = call.services();
  o.smoothing = smoothingOf(termsOf(args.smooth, services, call.randomAddress(901)));
  o.borderPath = args.borderPath;
  o.orphans = args.orphans;
  o.jitter = args.jitter;
  const std::vector<Term> terms = termsOf(args.sites, services, call.randomAddress(900));
  const DrawnNumber radius = numberOf(args.radius, services, call.randomAddress(902));
  const size_t wanted = sitesWanted(terms);
  const std::optional<uint32_t> figures = slotOf(call, "junction");
  bool junctions = false;
  for (const SelectorItem& item : call.selectors()) {
    junctions = junctions || selectsWord(item, "junction", call.services().pool());
    o.centres = o.centres || selectsWord(item, "centre", call.services().pool());
  }
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Disc> sites;
    const Status status = discsOf(call, terms, radius, view, call.randomAddress(f), sites);
    if (!status.ok()) return status;
    o.seed = call.randomAddress(500 + f);
    VoronoiResult v = voronoiPartition(view.polygon(), sites, o);
    if (sites.size() < wanted) {
      call.services().note("scatter-full",
                           "'voronoi': " + std::to_string(sites.size()) + " of " +
                               std::to_string(wanted) + " sites found a place",
                           "write fewer sites, or a smaller radius");
    }
    if (v.pieces.empty()) {
      return call.orElse(call.fail("no-sites", "no site lies in the region",
                                   "write smaller radii or other coordinates"));
    }
    if (figures && call.figureCode(*figures) != 0) {
      const Status placed =
          placeFigures(call, *figures, view, call.randomAddress(700 + f), v.pieces);
      if (!placed.ok()) return placed;
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
      } else if (p.kind == PieceKind::Junction && p.choice > 0) {
        cell = CellMark{};
        cell->choice = p.choice;
      }
      job.keep(f, word, std::move(p), std::move(marks), cell);
    }
  }
  job.emitCells("write fewer sites, a narrower path, or smaller figures");
  return {};
}

constexpr ParamSpec kParams[] = {
    selection<&Voronoi::sites>(
        "sites",
        "How many, scattered; places, point(3, 4) || point(10, 4, 2), with a radius or without; or "
        "a list of coordinates from the scope's origin.",
        site_terms::kSites)
        .between(0, kMostDiscs),
    param<&Voronoi::path>("path", "Width of the paths between cells; 0 for none.", "3").atLeast(0),
    selection<&Voronoi::smooth>("smooth",
                                "How the outlines of cells are smoothed: none, average(2), "
                                "chaikin(2), bezier, round(1), or "
                                "how many averages.",
                                site_terms::kSmoothing, "2", true),
    param<&Voronoi::radius>(
        "radius",
        "Scattered sites are middles of discs of this radius, which keep apart: rand(4, 9).", "0")
        .atLeast(0),
    param<&Voronoi::borderPath>("borderPath", "Half a path along the region's boundary as well.",
                                "true"),
    param<&Voronoi::orphans>("orphans",
                             "Parts of a cell that its site is not in go to a neighbour, are cells "
                             "of their own, or path.",
                             "merge"),
    param<&Voronoi::jitter>("jitter", "Metres by which borders are bent.", "0").atLeast(0),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {
    {"region", "A cell around a site."},
    {"path", "Between two cells, and between cells and the boundary."},
    {"junction", "Where three cells meet, else path; may begin with a figure."},
    {"centre", "The disc of a site with a radius."},
    kOtherwise};
constexpr OpSpec kSpecs[] = {
    withFigures(
        {"voronoi", "region", "Divides a region into cells around scattered places.", kSignatures,
         typed<applyVoronoi>, BlockKind::Selectors, kReadsRegion | kRandom, kParts, false, true},
        "junction", kRegionChoice),
};

}  // namespace

extern const OpList kOps_voronoi;
const OpList kOps_voronoi = kSpecs;

}  // namespace gable
