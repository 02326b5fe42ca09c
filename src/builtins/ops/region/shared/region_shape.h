// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face of a shape as a region: its polygon, and what its tags say of where it comes from.
//
// Provenance lives in tags, so it goes wherever a face and its edges go:
//
//   face   region.depth.D                       so many partitions lie behind it
//          region.cell IX IY NX NY W H PATTERN PART CHOICE KIND
//                                               the cell that it is, or was cut from
//   edge   region.edge.L.S                      made by partition L (0: the initial outline), of
//   the
//                                               logical edge S (n: of none)
//          region.role.R                        path, centre, hole, cut, base, inner or cap
//          region.peel.D.R                      base, inner or cap of the peel that made depth D
//
// Plan coordinates are those of the face's plane, which for faces square to a scope axis are the
// scope's: (x, -z) seen from above, (x, y) seen from the front.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "builtins/ops/shared/patchwork.h"
#include "builtins/selection.h"
#include "geom/region/grid_partition.h"
#include "geom/region/piece.h"
#include "shape/op_call.h"

namespace gable {

struct PeelMark {
  uint32_t depth = 0;
  EdgeRole role = EdgeRole::Base;
  bool operator==(const PeelMark&) const = default;
};

struct EdgeMark {
  static constexpr uint32_t kNoLogical = 0xffffffff;
  uint32_t level = 0;
  uint32_t logical = kNoLogical;
  EdgeRole role = EdgeRole::Kept;
  std::vector<PeelMark> peels;
  /// Tags of other families.
  uint32_t others = 0;
};

/// How a grid of more than two cells is mirrored; see the page of grid.
enum class CellPattern : uint8_t {
  Auto,
  Centre,
  Pair,
  Mirror,
  Extend,
  ExtendL,
  ExtendR,
  Local,
  Radial
};

struct CellMark {
  uint32_t ix = 0, iy = 0, nx = 1, ny = 1;
  double w = 0, h = 0;
  CellPattern pattern = CellPattern::Auto;
  /// Parts of one cell are numbered; of junctions `choice` is the figure, from 1.
  uint32_t part = 0, choice = 0;
  /// Not of a grid: ix counts the cells, and iy how many lie between it and the boundary.
  bool free = false;
  /// The distances from the border are told smaller one first.
  bool symmetric = false;

  /// How many cells lie between this one and the border.
  uint32_t bx() const { return free ? iy : symmetric ? std::min(byX(), byY()) : byX(); }
  uint32_t by() const { return free ? 0 : symmetric ? std::max(byX(), byY()) : byY(); }

  bool mirroredX() const { return mirrored(ix, nx); }
  bool mirroredY() const { return mirrored(iy, ny); }
  /// Quarter turns to the left of a radial pattern.
  uint32_t turns() const;
  /// The side (0 west, 1 north, 2 east, 3 south) that a side of the first cell is here.
  uint32_t side(uint32_t k) const;
  /// An address with 0 at the border side, as the cell sees it; false when the pattern places
  /// nothing here.
  bool address(double& u, double& v) const;

 private:
  uint32_t byX() const { return std::min(ix, nx - 1 - ix); }
  uint32_t byY() const { return std::min(iy, ny - 1 - iy); }
  bool along(bool y, double& u) const;
  bool mirrored(uint32_t i, uint32_t n) const;
};

/// What the logical edges of a piece are: those that its edges inherit; the sides of a grid's cell,
/// where an edge at 45 degrees belongs to the side along x or along y, or has been divided between
/// both; chains of edges of one origin; the rays and the outer chain of a sector; or what its
/// outline alone says.
enum class EdgeIndex : uint8_t { Inherited, Grid, GridByY, GridSplit, Chains, Sector, Outline };

/// Whether a direction lies at 45 degrees to the axes.
inline bool isDiagonal(double x, double y) {
  const double a = x < 0 ? -x : x, b = y < 0 ? -y : y;
  return a > 0 && (a < b ? b - a : a - b) <= 1e-6 * (a < b ? b : a);
}

class RegionView {
 public:
  /// A face of a mesh in scope coordinates, which must outlive this.
  RegionView(const Services& services, const Mesh& mesh, size_t face);

  const Polygon& polygon() const { return plane_.polygon(); }
  const PatchPlane& plane() const { return plane_; }
  const std::vector<EdgeMark>& marks() const { return marks_; }
  uint32_t depth() const { return depth_; }
  const std::optional<CellMark>& cell() const { return cell_; }
  uint32_t logicalCount() const { return logicalCount_; }
  /// By edge of the outer ring.
  std::vector<uint32_t> logicals() const;

  /// The marks of a piece of this region, one partition deeper.
  std::vector<EdgeMark> marksOf(const RegionPiece& piece, EdgeIndex index) const;

  /// A shape that is the pieces: their marks as tags, the scope along the first piece's axis.
  Shape shapeOf(const Shape& parent, std::span<const RegionPiece> pieces,
                std::span<const std::vector<EdgeMark>> marks, const std::optional<CellMark>& cell);
  Shape shapeOf(const Shape& parent, const RegionPiece& piece, const std::vector<EdgeMark>& marks,
                const std::optional<CellMark>& cell) {
    return shapeOf(parent, {&piece, 1}, {&marks, 1}, cell);
  }
  /// The same region as it was, with other polygons: it does not go deeper. With `reindex` the
  /// logical edges are found anew.
  void replace(Shape& shape, std::span<const RegionPiece> pieces, bool reindex = false);
  /// The mesh that `replace` gives the shape.
  Mesh replaced(std::span<const RegionPiece> pieces, bool reindex = false);

  /// The parent as a cell with that mark would be, for conditions that are asked beforehand.
  Shape markedAs(const Shape& parent, const CellMark& cell) const;
  /// A point with x along a direction of the plane and the normal up (or forward).
  Shape pointAt(const Shape& parent, Vec2 at, Vec2 along) const;
  /// A mesh in coordinates of the plane, with the scope along a direction of it.
  Shape solidOf(const Shape& parent, Mesh mesh, Vec2 along) const;
  /// Lines of a width of nothing, straight part by straight part, as one shape.
  Shape lineOf(const Shape& parent, std::span<const Vec2> points, bool closed) const;
  /// A line of a width of nothing: one straight part.
  Shape segmentAt(const Shape& parent, Vec2 a, Vec2 b) const;

 private:
  uint32_t tagsOf(const EdgeMark& m) const;
  uint32_t faceTags(uint32_t depth, const std::optional<CellMark>& cell) const;
  Frame axesAlong(const Shape& parent, Vec2 along) const;
  Mesh meshOf(std::span<const RegionPiece> pieces, std::span<const std::vector<EdgeMark>> marks,
              uint32_t tags);

  const Services& services_;
  const Mesh& mesh_;
  PatchPlane plane_;
  std::vector<EdgeMark> marks_;
  uint32_t depth_ = 0;
  uint32_t otherFaceTags_ = 0;
  uint32_t logicalCount_ = 0;
  std::optional<CellMark> cell_;
};

/// What the face tags of a shape say, for attributes of rules.
struct RegionFacts {
  uint32_t depth = 0;
  std::optional<CellMark> cell;
};
RegionFacts regionFactsOf(const Services& services, const Shape& shape);

/// The pattern of that name; Auto for others.
CellPattern patternNamed(std::string_view name);

/// An operation that could not be done: the block's `otherwise` gets the shape, or the call fails.
Status failOrElse(OpCall& call, const char* code, const std::string& message,
                  const std::string& hint);

/// Of a block { A | otherwise : B }: the slot of A; none where only otherwise is there.
std::optional<uint32_t> thingSlot(OpCall& call);

/// For operations after which the shape goes on: where nothing could be done, `otherwise` gets the
/// shape, which then ends here. False without such a part.
bool giveToOtherwise(OpCall& call);

/// The faces of a shape that have an area.
std::vector<size_t> regionFaces(const Mesh& mesh);

}  // namespace gable
