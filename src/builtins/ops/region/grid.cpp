// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A grid of cells with paths and junctions between; the kernel is geom/region/grid_partition.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_attributes.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/quad_map.h"

namespace gable {

enum class Dominance : uint8_t { X, Y, Split };

template <>
struct WordsOf<GridFit> {
  static constexpr const char* text = "stretch center fail";
};
template <>
struct WordsOf<GridTemplate> {
  static constexpr const char* text = "auto corners obb aabb inner";
};
template <>
struct WordsOf<CellPattern> {
  static constexpr const char* text = "auto centre pair mirror extend extendL extendR local radial";
};
template <>
struct WordsOf<Dominance> {
  static constexpr const char* text = "x y split";
};

namespace {

struct GridArguments {
  std::optional<DrawnList> columns, rows;
  double path = 3;
  std::optional<DrawnList> widths, heights, columnAngles, rowAngles;
  GridFit fit = GridFit::Stretch;
  GridTemplate base = GridTemplate::Auto;
  CellPattern pattern = CellPattern::Auto;
  Dominance dominance = Dominance::X;
  bool symmetric = false, lines = false;
  double sliver = 0;
  std::optional<double> minArea;
  double least = 0;
};

DrawnRange rangeOf(const DrawnNumber& n) {
  DrawnRange r{n.low(), n.high()};
  if (n.code()) r.other = [n](uint64_t address) { return n.at(address); };
  return r;
}

std::vector<DrawnNumber> numbersOf(const OpCall& call, const std::optional<DrawnList>& list,
                                   uint64_t which, bool* isList = nullptr) {
  if (!list) return {};
  constexpr uint64_t kArguments = 900;
  return gable::numbersOf(list->value, call.services(), call.randomAddress(kArguments + which),
                          isList);
}

// Sizes and angles are used in turn, each in its own.
void addSizes(std::vector<DrawnNumber> sizes, const std::vector<DrawnNumber>& angles,
              GridDim& out) {
  constexpr size_t kMost = 10000;
  const size_t n = std::max<size_t>(1, sizes.size()), m = std::max<size_t>(1, angles.size());
  if (sizes.empty() && angles.empty()) return;
  const size_t all = std::min(kMost, n * m / std::gcd(n, m));
  for (size_t i = 0; i < all; ++i) {
    GridSize s;
    if (!sizes.empty()) {
      s.size = rangeOf(sizes[i % n]);
      s.share = sizes[i % n].unit() == Unit::Floating;
    }
    if (!angles.empty()) s.angle = rangeOf(angles[i % m]);
    out.sizes.push_back(std::move(s));
  }
}

// A count, or a list of sizes of which each is a cell.
Status dimensionOf(const OpCall& call, const std::optional<DrawnList>& count,
                   const std::optional<DrawnList>& sizes, const std::optional<DrawnList>& angles,
                   uint64_t which, bool lines, GridDim& out) {
  bool isList = false;
  const std::vector<DrawnNumber> counts = numbersOf(call, count, which, &isList);
  std::vector<DrawnNumber> own = numbersOf(call, sizes, which + 1);
  if (isList) {
    own = counts;
    out.count = static_cast<uint32_t>(own.size());
  } else if (!counts.empty()) {
    const DrawnNumber& n = counts[0];
    const double low = n.low(), high = n.high();
    const bool drawn = !n.isConstant();
    if (!(low >= (drawn ? 1 : 0) && high >= low && high <= kMostCells)) {
      return call.fail("bad-argument", "a grid cannot have that many cells along one side",
                       "write 1 to 100000, or rand(2, 4)");
    }
    if (drawn) {
      out.drawnCount = DrawnRange{low, high};
    } else {
      out.count = static_cast<uint32_t>(std::max(1.0, low));
      // The other way to count: lines instead of cells. No line is one cell.
      if (lines && low >= 1) ++out.count;
    }
  }
  const bool shares = std::any_of(own.begin(), own.end(),
                                  [](const DrawnNumber& n) { return n.unit() == Unit::Floating; });
  if (shares && out.count == 0 && !out.drawnCount) out.count = static_cast<uint32_t>(own.size());
  addSizes(std::move(own), numbersOf(call, angles, which + 2), out);
  return {};
}

// Figures at crossings: conditions ask for the crossing's place, shares are drawn for each.
auto junctionsOf(OpCall& call, const RegionView& view, uint32_t slot, bool& bad) {
  return [&call, &view, slot, &bad](uint32_t ix, uint32_t iy, uint32_t nx, uint32_t ny,
                                    uint64_t address) {
    const CellMark mark{ix, iy, std::max(1u, nx), std::max(1u, ny)};
    const DrawnFigure figure = drawFigure(call, slot, address, view.markedAs(call.shape(), mark));
    JunctionPick pick;
    if (!planFigureOf(figure, pick.figure)) {
      bad = true;
      pick.figure = {};
    }
    pick.choice = figure.ordinal > 0 ? figure.ordinal : figure.spec ? 1 : 0;
    return pick;
  };
}

Status optionsOf(const OpCall& call, const GridArguments& args, GridOptions& o) {
  Status status =
      dimensionOf(call, args.columns, args.widths, args.columnAngles, 0, args.lines, o.x);
  if (status.ok()) {
    status = dimensionOf(call, args.rows, args.heights, args.rowAngles, 10, args.lines, o.y);
  }
  o.pathWidth = args.path;
  o.fit = args.fit;
  o.base = args.base;
  o.sliver = args.sliver;
  o.minArea = args.minArea.value_or(o.minArea);
  o.minAreaHolds = args.minArea.has_value();
  return status;
}

Status problemOf(OpCall& call, GridProblem problem) {
  switch (problem) {
    case GridProblem::TooManyCells:
      return call.orElse(call.fail("grid-too-many", "the grid would have more than 100000 cells",
                                   "write larger sizes or smaller counts"));
    case GridProblem::DoesNotFit:
      return call.orElse(call.fail("grid-does-not-fit", "the cells do not fit into the region",
                                   "write smaller sizes, or fit = stretch"));
    default:
      return call.orElse(
          call.fail("no-geometry", "the region has no area to divide", "divide a larger region"));
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

Status applyGrid(OpCall& call, const GridArguments& args) {
  GridOptions options;
  Status status = optionsOf(call, args, options);
  if (!status.ok()) return status;
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const EdgeIndex sides = args.dominance == Dominance::Y       ? EdgeIndex::GridByY
                          : args.dominance == Dominance::Split ? EdgeIndex::GridSplit
                                                               : EdgeIndex::Grid;
  const std::optional<uint32_t> junction = slotOf(call, "junction");
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    options.seed = call.randomAddress(f);
    if (area(view.polygon()) < args.least) {
      return call.orElse(call.fail("no-geometry", "the region is too small to be divided",
                                   "divide a larger region, or lower 'least'"));
    }
    bool bad = false;
    if (junction && call.figureCode(*junction) != 0) {
      options.junctionAt = junctionsOf(call, view, *junction, bad);
    }
    GridResult g = gridPartition(view.polygon(), options);
    if (bad) return badFigure(call);
    if (g.problem != GridProblem::None) return problemOf(call, g.problem);
    if (g.junctionClamped) {
      call.services().warn("junction-clamped",
                           "'grid': the junctions were made smaller to keep apart",
                           "make them smaller, or the cells larger");
    }
    for (RegionPiece& p : g.pieces) {
      if (args.dominance == Dominance::Split && p.kind == PieceKind::Cell) divideDiagonals(p);
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
                        args.pattern,
                        p.part,
                        p.choice};
        cell->symmetric = args.symmetric;
      }
      const std::string_view word = wordOf(p.kind);
      job.keep(f, word, std::move(p), std::move(marks), cell);
    }
  }
  job.emitCells("write fewer cells, a narrower path, or a smaller minArea");
  return {};
}

constexpr double kMostMapped = 100;

struct QuadMap {
  double columns = 0, rows = 0;
};

Status applyQuadMap(OpCall& call, const QuadMap& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const double nx = args.columns, ny = args.rows;
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
  job.emitCells("write fewer columns and rows");
  return {};
}

constexpr ParamSpec kMapParams[] = {
    param<&QuadMap::columns>("columns", "From west to east.").between(1, kMostMapped),
    param<&QuadMap::rows>("rows", "From south to north.").between(1, kMostMapped)};
constexpr Signature kMapSignatures[] = {{kMapParams}};

constexpr const char* kFill = "as many as the sizes fill, else 2";
constexpr const char* kEqual = "equal cells";
constexpr const char* kStraight = "straight";
constexpr ParamSpec kParams[] = {
    param<&GridArguments::columns>(
        "columns", "How many from west to east, or a list with the width of each: [3, ~1, 3].",
        kFill)
        .between(0, kMostCells),
    param<&GridArguments::rows>("rows", "The same from south to north.", kFill)
        .between(0, kMostCells),
    param<&GridArguments::path>("path", "Width of the paths between cells; 0 for none.", "3")
        .atLeast(0),
    param<&GridArguments::widths>(
        "widths",
        "Widths of columns, used in turn: numbers, draws such as rand(2, 4), shares of the rest "
        "such as ~1.",
        kEqual),
    param<&GridArguments::heights>("heights", "Heights of rows, in the same way.", kEqual),
    param<&GridArguments::columnAngles>(
        "columnAngles", "Degrees by which the lines between columns are turned, used in turn.",
        kStraight),
    param<&GridArguments::rowAngles>("rowAngles", "The same between rows.", kStraight),
    param<&GridArguments::fit>(
        "fit",
        "What becomes of a length that the sizes do not fill: cells are scaled, margins "
        "become path, or the grid is not made.",
        "stretch"),
    param<&GridArguments::base>(
        "template",
        "Where the lines are laid: between the region's corners, in its smallest box, "
        "in the box along the axes, in its largest rectangle.",
        "auto"),
    param<&GridArguments::pattern>("pattern", "How cells are mirrored.", "auto"),
    param<&GridArguments::dominance>(
        "dominance", "Which side an edge at 45 degrees belongs to; split: half to each.", "x"),
    param<&GridArguments::symmetric>(
        "symmetric",
        "region.bx is never above region.by: cells on both sides of a diagonal are "
        "alike.",
        "false"),
    param<&GridArguments::lines>("lines", "Counts are of paths.", "false"),
    param<&GridArguments::sliver>("sliver", "What is thinner goes to a neighbour, in metres.",
                                  "0.02"),
    param<&GridArguments::minArea>("minArea",
                                   "What is smaller goes to a neighbour, in square metres.",
                                   "0.25, or a fiftieth of the mean cell"),
    param<&GridArguments::least>("least", "A region with a smaller area is not divided.", "0"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kGridParts[] = {{"region", "A cell."},
                                   {"path", "A path between two cells, from crossing to crossing."},
                                   {"junction", "Where paths cross; may begin with a figure."},
                                   {"remainder", "Of the region, what no cell and no path covers."},
                                   kOtherwise};
constexpr PartSpec kMapParts[] = {
    {"region", "A cell."}, {"remainder", "Of the region, what no cell covers."}, kOtherwise};
constexpr OpSpec kSpecs[] = {
    withFigures({"grid", "region", "Divides a region into rows and columns with paths between.",
                 kSignatures, typed<applyGrid>, BlockKind::Selectors, kReadsRegion | kRandom,
                 kGridParts, false, true},
                "junction", kRegionChoice),
    {"quadMap", "region", "Divides a region into rows and columns that follow its four sides.",
     kMapSignatures, typed<applyQuadMap>, BlockKind::Selectors, kReadsRegion, kMapParts, false,
     true},
};

}  // namespace

extern const OpList kOps_grid;
const OpList kOps_grid = kSpecs;

}  // namespace gable
