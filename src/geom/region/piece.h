// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// RegionPiece: what a partition of a region gives out, with the origin of each of its edges. Plan
// coordinates, metres.
//
// Promises of every function here:
//   1. Each edge of a piece is a part of one source edge and says which; edges that no source has
//      say `Cut` and kNoEdge.
//   2. Edges of the input come before made ones where both lie on one line.
// O(n log n) besides the boolean.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/region.h"

namespace gable {

/// Why an edge is there.
enum class EdgeRole : uint8_t {
  /// It is a part of an input edge.
  Kept,
  /// It lies beside a path.
  Path,
  /// It lies beside a junction, a centre or a disc at the middle.
  Centre,
  /// It bounds what was cut out for a placed thing.
  Hole,
  /// It divides neighbours without a path.
  Cut,
  /// Of a strip: a part of the edge that it was peeled from.
  Base,
  /// Between a strip and the rest.
  Inner,
  /// The end of a strip.
  Cap,
};

struct EdgeOrigin {
  /// The input edge, counted through the outer ring and the holes: that which it is a part of
  /// (Kept, Base), or was moved from (Inner, offsets); else kNoEdge.
  uint32_t source = kNoEdge;
  EdgeRole role = EdgeRole::Kept;
  /// The side of the piece's own frame that it is: 0 west, 1 north, 2 east, 3 south; kNoSide where
  /// the partition does not say.
  uint8_t side = kNoSide;
  static constexpr uint8_t kNoSide = 0xff;
  friend bool operator==(const EdgeOrigin&, const EdgeOrigin&) = default;
};

enum class PieceKind : uint8_t { Cell, Path, Junction, Remainder };

struct RegionPiece {
  Polygon polygon;
  /// By edge, through the outer ring and the holes.
  std::vector<EdgeOrigin> edges;
  PieceKind kind = PieceKind::Cell;
  /// Of grids: the cell; of others `ix` counts the regions, the sections or the junctions.
  uint32_t ix = 0, iy = 0;
  /// Parts of one cell are numbered.
  uint32_t part = 0;
  /// Of junctions: which of several figures it is, from 1; 0 is a plain crossing.
  uint32_t choice = 0;
  /// The size that it was laid out with, before clipping.
  double width = 0, height = 0;
  /// Along the piece's x axis: along a path, along the template's x for cells.
  Vec2 axis{1, 0};
};

/// A polygon and what is known of its edges: what pieces are traced to.
struct EdgeSource {
  std::vector<Ring> rings;
  std::vector<EdgeOrigin> origins;
};

/// The rings of a polygon: outer, holes.
std::vector<Ring> ringsOf(const Polygon& p);
size_t edgeCount(const Polygon& p);
/// The input itself: edge i comes from edge i.
EdgeSource sourceOf(const Polygon& p);
EdgeSource sourceOf(const Polygon& p, std::vector<EdgeOrigin> origins);
inline EdgeSource sourceOf(const RegionPiece& p) { return sourceOf(p.polygon, p.edges); }
/// All edges of a ring with one origin.
EdgeSource sourceOf(const Ring& r, EdgeOrigin origin);

/// Origins of the edges of `p` from the first source that has them. Edges beyond all sources take
/// `otherwise`.
std::vector<EdgeOrigin> originsOf(const Polygon& p, std::span<const EdgeSource> sources,
                                  EdgeOrigin otherwise = {kNoEdge, EdgeRole::Cut,
                                                          EdgeOrigin::kNoSide});

/// The same for all polygons of a region at once.
std::vector<std::vector<EdgeOrigin>> originsOf(const Region& r, std::span<const EdgeSource> sources,
                                               EdgeOrigin otherwise);

/// `a` op `b`, with origins from a's edges, then from b's, which all take `made`. Other fields are
/// those of `a`; the parts are numbered.
std::vector<RegionPiece> combineTraced(BooleanOp op, const RegionPiece& a, const Region& b,
                                       EdgeOrigin made);

/// What is left of `whole` beside `parts`, which lie in it apart from each other. Edges along a
/// part take what `beside` says of its edge; its rings are those of the parts, in their order.
/// Other fields are those of `whole`; the parts are numbered.
std::vector<RegionPiece> leftBeside(const RegionPiece& whole, const Region& parts,
                                    const EdgeSource& beside);

/// The piece as the whole of a polygon.
RegionPiece wholePiece(const Polygon& p);

/// Twice the area by the perimeter: the width of what is long and thin.
double thickness(const Polygon& p);
double perimeter(const Polygon& p);

/// Unites a piece with the one of `pieces` that shares the longest border with it, paths first: the
/// number of that one, or of pieces when none does.
size_t absorbSliver(std::vector<RegionPiece>& pieces, const RegionPiece& sliver);

/// Unites pieces thinner than `sliver` or smaller than `minArea` with the neighbour that shares the
/// longest border, paths first; those without a neighbour stay. Slivers of paths stay with paths
/// where they can.
void mergeSlivers(std::vector<RegionPiece>& pieces, double sliver, double minArea);

}  // namespace gable
