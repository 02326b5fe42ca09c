// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A grid of cells with paths and junctions between; the kernel is geom/region/grid_partition.
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/plan_text.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/quad_map.h"

namespace gable {

namespace {

constexpr double kPathWidth = 3;

// A count, a list of sizes, or a text.
Status dimensionOf(const OpCall& call, size_t argument, GridDim& out) {
  if (!call.has(argument)) return {};
  const Value& v = call.arg(argument);
  if (v.type == ValueType::FloatArray) {
    for (const double s : call.services().pool().array(v).numbers) {
      out.sizes.push_back({DrawnRange{s, s}, {}});
    }
    out.count = static_cast<uint32_t>(out.sizes.size());
    return {};
  }
  std::string problem;
  if (readDimension(textOf(call, argument, ""), out, problem)) return {};
  return call.fail("bad-argument", problem, "write a count, a list of sizes or \"3 {2, 6, 2}\"");
}

// Of 0 cells there is one, but no line.
bool countsNone(const OpCall& call, size_t argument) {
  const std::string text = textOf(call, argument, "");
  TextReader r(text);
  double n = 1;
  return r.number(n) && n < 1;
}

constexpr std::string_view kOptions =
    "fit=stretch|center|centre|fail template=auto|corners|obb|aabb|inner "
    "pattern=auto|centre|center|pair|mirror|extend|extendl|extendr|local|radial "
    "dominance=x|y|split "
    "symxy lines sliver=# minarea=#";

Status optionsOf(const OpCall& call, GridOptions& o) {
  Status status = dimensionOf(call, 0, o.x);
  if (status.ok()) status = dimensionOf(call, 1, o.y);
  if (!status.ok()) return status;
  o.pathWidth = call.number(2, kPathWidth);
  if (!(o.pathWidth >= 0) || !std::isfinite(o.pathWidth)) {
    return call.fail("bad-argument", "a path cannot be " + shortestText(o.pathWidth) + " wide",
                     "write a width of zero or more");
  }
  const std::string figure = textOf(call, 3, "");
  std::string problem;
  if (!figure.empty() && figure != "none" && !readJunctions(figure, o.junctions, problem)) {
    return call.fail("bad-argument", problem,
                     "write romb(r), circle(r), square(a), rect(a, b) or polygon(n, r), or several "
                     "of them with | between");
  }
  status = optionsAre(call, 4, kOptions);
  if (!status.ok()) return status;
  const std::string options = textOf(call, 4, "");
  const std::string fit = option(options, "fit"), base = option(options, "template");
  o.fit = fit == "fail"                        ? GridFit::Fail
          : fit == "center" || fit == "centre" ? GridFit::Center
                                               : GridFit::Stretch;
  o.base = base == "corners" ? GridTemplate::Corners
           : base == "obb"   ? GridTemplate::Oriented
           : base == "aabb"  ? GridTemplate::Axes
           : base == "inner" ? GridTemplate::Inner
                             : GridTemplate::Auto;
  parseNumber(option(options, "sliver"), o.sliver);
  parseNumber(option(options, "minarea"), o.minArea);
  // The other way to count: lines instead of cells.
  if (!option(options, "lines").empty()) {
    if (o.x.count > 0 && !countsNone(call, 0)) ++o.x.count;
    if (o.y.count > 0 && !countsNone(call, 1)) ++o.y.count;
  }
  return {};
}

Status problemOf(OpCall& call, GridProblem problem) {
  switch (problem) {
    case GridProblem::TooManyCells:
      return failOrElse(call, "grid-too-many", "the grid would have more than 100000 cells",
                        "write larger sizes or smaller counts");
    case GridProblem::DoesNotFit:
      return failOrElse(call, "grid-does-not-fit", "the cells do not fit into the region",
                        "write smaller sizes, or fit=stretch");
    default:
      return failOrElse(call, "no-geometry", "the region has no area to divide",
                        "divide a larger region");
  }
}

std::string_view wordOf(PieceKind kind) {
  switch (kind) {
    case PieceKind::Cell: return "region";
    case PieceKind::Path: return "path";
    case PieceKind::Junction: return "junction";
    case PieceKind::Remainder: break;
  }
  return "remainder";
}

// Edges at 45 degrees to the cell are divided in their middle: each half goes to the side beside
// it.
void divideDiagonals(RegionPiece& p) {
  const Ring& r = p.polygon.outer;
  const Vec2 x = normalized(p.axis);
  Ring ring;
  std::vector<EdgeOrigin> edges;
  for (size_t i = 0; i < r.size(); ++i) {
    const Vec2 a = r[i], b = r[(i + 1) % r.size()], n = -perpendicular(b - a);
    const double u = dot(n, x), v = dot(n, perpendicular(x));
    ring.push_back(a);
    edges.push_back(p.edges[i]);
    if (!isDiagonal(u, v)) continue;
    const uint8_t across = u < 0 ? 0 : 2, along = v > 0 ? 1 : 3;
    // Counter-clockwise east comes before north, north before west, and so on.
    const bool acrossFirst = (u > 0) == (v > 0);
    edges.back().side = acrossFirst ? across : along;
    ring.push_back((a + b) * 0.5);
    edges.push_back(p.edges[i]);
    edges.back().side = acrossFirst ? along : across;
  }
  edges.insert(edges.end(), p.edges.begin() + static_cast<std::ptrdiff_t>(r.size()), p.edges.end());
  p.polygon.outer = std::move(ring);
  p.edges = std::move(edges);
}

Status applyGrid(OpCall& call) {
  GridOptions options;
  Status status = optionsOf(call, options);
  if (!status.ok()) return status;
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const std::string text = textOf(call, 4, ""), dominance = option(text, "dominance");
  const EdgeIndex sides = dominance == "y"       ? EdgeIndex::GridByY
                          : dominance == "split" ? EdgeIndex::GridSplit
                                                 : EdgeIndex::Grid;
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    options.seed = call.randomAddress(f);
    GridResult g = gridPartition(view.polygon(), options);
    if (g.problem != GridProblem::None) return problemOf(call, g.problem);
    if (g.junctionClamped) {
      call.services().warn("junction-clamped",
                           "'grid': the junctions were made smaller to keep apart",
                           "make them smaller, or the cells larger");
    }
    for (RegionPiece& p : g.pieces) {
      if (dominance == "split" && p.kind == PieceKind::Cell) divideDiagonals(p);
      std::vector<EdgeMark> marks =
          view.marksOf(p, p.kind == PieceKind::Remainder ? EdgeIndex::Inherited : sides);
      std::optional<CellMark> cell;
      if (p.kind == PieceKind::Cell || p.kind == PieceKind::Junction) {
        const bool crossing = p.kind == PieceKind::Junction;
        cell = CellMark{p.ix,
                        p.iy,
                        std::max(1u, g.nx - (crossing ? 1 : 0)),
                        std::max(1u, g.ny - (crossing ? 1 : 0)),
                        p.width,
                        p.height,
                        patternNamed(option(text, "pattern")),
                        p.part,
                        p.choice};
        cell->symmetric = !option(text, "symxy").empty();
      }
      const std::string_view word = wordOf(p.kind);
      job.keep(f, word, std::move(p), std::move(marks), cell);
    }
  }
  job.emit();
  return {};
}

Status applyQuadMap(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const double nx = call.number(0), ny = call.number(1);
  constexpr double kMost = 100;
  if (!(nx >= 1 && nx <= kMost && ny >= 1 && ny <= kMost)) {
    return failOrElse(call, "bad-argument", "a map has 1 to 100 columns and rows",
                      "write quadMap(4, 3)");
  }
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    QuadMapResult q = quadMap(view.polygon(), static_cast<uint32_t>(nx), static_cast<uint32_t>(ny));
    for (RegionPiece& p : q.pieces) {
      const bool rest = p.kind == PieceKind::Remainder;
      std::vector<EdgeMark> marks = view.marksOf(p, rest ? EdgeIndex::Inherited : EdgeIndex::Grid);
      std::optional<CellMark> cell;
      if (!rest) {
        cell = CellMark{p.ix,    p.iy,     static_cast<uint32_t>(nx), static_cast<uint32_t>(ny),
                        p.width, p.height, CellPattern::Auto,         p.part};
      }
      job.keep(f, rest ? "remainder" : "region", std::move(p), std::move(marks), cell);
    }
  }
  job.emit();
  return {};
}

constexpr ParamSpec kMapParams[] = {{"columns", ParamType::Float, "From west to east."},
                                    {"rows", ParamType::Float, "From south to north."}};
constexpr Signature kMapSignatures[] = {{kMapParams}};

constexpr ParamSpec kParams[] = {
    {"columns", ParamType::Any,
     "A count, a list of sizes in metres, or a text like \"3 {2, [4,6] a[-5,5]}\": a count, and "
     "sizes in turn, with ranges that are drawn and angles in degrees."},
    {"rows", ParamType::Any, "The same from south to north."},
    {"pathWidth", ParamType::Float, "Of the paths between cells; 0 for none.", "3"},
    {"junction", ParamType::Any,
     "What stands at crossings: \"none\", or \"romb(r)\", \"circle(r)\", \"square(a)\", "
     "\"rect(a, b)\", \"polygon(n, r)\". Several with | between are drawn from, with shares "
     "(\"30%: romb(3) | circle(2)\") or by place (\"case ix == 0: romb(3) | circle(2)\"); "
     "region.choice says which it is.",
     "\"none\""},
    {"options", ParamType::String,
     "fit=stretch|center|fail, template=auto|corners|obb|aabb|inner, "
     "pattern=auto|centre|pair|mirror|extend|local|radial, dominance=x|y|split (which side an edge "
     "at 45 degrees belongs to; split: half to each), symxy (region.bx is never above region.by, "
     "so "
     "that cells on both sides of a diagonal are alike), lines (counts are of paths), sliver=0.02 "
     "and minarea=0.25: what is thinner or smaller goes to a neighbour.",
     "\"\""},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"grid", "region", "Divides a region into rows and columns with paths between.", kSignatures,
     applyGrid, BlockKind::Selectors, kRandom, "region path junction remainder otherwise", false,
     true},
    {"quadMap", "region", "Divides a region into rows and columns that follow its four sides.",
     kMapSignatures, applyQuadMap, BlockKind::Selectors, kPure, "region remainder otherwise", false,
     true},
};

}  // namespace

extern const OpList kOps_grid;
const OpList kOps_grid = kSpecs;

}  // namespace gable
