// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Surface: how the pieces of an arrangement hang together. Pieces that lie on each other form a
// sheet; sheets that meet at an edge of theirs with no third one form a patch, on which nothing
// changes sides; the facets of an operand that hang together form a shell.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/solid/cells.h"

namespace gable::solid {

struct Sheet {
  /// Pieces in ascending order, the first gives the direction.
  std::vector<uint32_t> pieces;
  uint32_t patch = 0;
};

struct Shell {
  uint32_t operand = 0;
  Box3 box;
  std::vector<uint32_t> facets;
  bool closed = true;
  /// Its border runs into another operand.
  bool torn = false;
};

/// A sheet at an edge.
struct Side {
  uint64_t edge = 0;
  uint32_t sheet = 0;
  /// The edge runs from its lower vertex on, with the sheet's first piece on its left.
  bool up = false;
};

class Surface {
 public:
  Surface(const Facets& facets, const Splits& splits, const std::vector<Piece>& pieces);

  const std::vector<Sheet>& sheets() const { return sheets_; }
  const std::vector<Shell>& shells() const { return shells_; }
  uint32_t patchCount() const { return patchCount_; }
  /// By edge.
  const std::vector<Side>& sides() const { return sides_; }
  uint32_t shellOf(uint32_t piece) const { return shellOf_[pieces_[piece].facet]; }
  const Facet& facetOf(uint32_t piece) const { return facets_.list[pieces_[piece].facet]; }
  /// All lies in one plane.
  bool isPlane() const { return plane_; }
  /// How often a piece of a sheet covers it, seen from the direction of the sheet.
  int turnsOf(const Sheet& sheet, uint32_t piece) const;
  /// The edges at which several operands meet, as edgeKey, in ascending order.
  std::vector<uint64_t> cuts() const;

 private:
  void findSheets();
  void findShells();
  void findSides();
  void findPatches();
  void closeShells();
  void findPlaces(const Splits& splits);
  void tear(const std::vector<std::pair<uint32_t, uint64_t>>& border);
  bool alike(const Sheet& a, const Sheet& b) const;
  bool findPlane() const;

  const Facets& facets_;
  const std::vector<Piece>& pieces_;
  std::vector<Sheet> sheets_;
  std::vector<Shell> shells_;
  std::vector<uint32_t> shellOf_;
  std::vector<Side> sides_;
  // Which operands have a facet at a vertex, and along an edge; also where that divides nothing.
  std::vector<std::pair<uint64_t, uint32_t>> atVertex_, atEdge_;
  uint32_t patchCount_ = 0;
  bool plane_ = false;
};

/// How often a shell runs around a point, as the sum of the solid angles of its facets. Facets in
/// whose plane the point lies count nothing, so on the shell it is the mean of both sides.
double windingNumber(const Shell& shell, const Facets& facets, const Vec3& p);

/// A point well within a piece, in the plane of its facet.
Vec3 pointWithin(const Piece& piece, const Facets& facets);

}  // namespace gable::solid
