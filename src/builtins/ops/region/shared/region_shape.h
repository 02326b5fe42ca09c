// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face of a shape as a region: its polygon, and where it and its edges come from.
//
// Where it comes from lies beside the tags of its face and its edges (shape/provenance.h), so it
// goes wherever these go.
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
#include "shape/provenance.h"

namespace gable {

/// Of operations on regions: the part for what they could not divide.
inline constexpr PartSpec kOtherwise{"otherwise",
                                     "Gets the region where the operation can do nothing."};
inline constexpr PartSpec kOtherwiseOnly[] = {kOtherwise};

/// What is known of an edge of the outline, with its tags.
struct EdgeMark : EdgeProvenance {
  TagSetId tags = 0;
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
  TagSetId tagsOf(const EdgeMark& m) const;
  TagSetId faceTags(uint32_t depth, const std::optional<CellMark>& cell) const;
  Frame axesAlong(const Shape& parent, Vec2 along) const;
  Mesh meshOf(std::span<const RegionPiece> pieces, std::span<const std::vector<EdgeMark>> marks,
              uint32_t tags);

  const Services& services_;
  const Mesh& mesh_;
  PatchPlane plane_;
  std::vector<EdgeMark> marks_;
  uint32_t depth_ = 0;
  TagSetId faceTags_ = 0;
  uint32_t logicalCount_ = 0;
  std::optional<CellMark> cell_;
};

/// Where the first face of a shape comes from; of one that is no region all is zero.
RegionProvenance provenanceOf(const Services& services, const Shape& shape);

/// Of a block { A | otherwise : B }: the slot of A; none where only otherwise is there.
std::optional<uint32_t> thingSlot(OpCall& call);

/// The faces of a shape that have an area.
std::vector<size_t> regionFaces(const Mesh& mesh);

}  // namespace gable
