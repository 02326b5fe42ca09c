// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// After Q. Zhou, E. Grinspun, D. Zorin and A. Jacobson, Mesh Arrangements for Solid Geometry, 2016:
// all faces are divided where they meet others, and of the pieces those stay that have the result
// on one side only, which winding numbers tell. Unlike there, places are rounded: faces that lie on
// each other in a model do so but for the last digits, and must count as one. What keeps this sound
// is that every decision is about shared vertices and edges and is made once: an edge is divided
// for all faces around it, so closed operands are divided into closed ones, and the result is
// checked. Where the tolerance falls among the sizes of the input, another one is tried.
//
//   part          file        what it does
//   facets        facets      faces to plane polygons over shared vertices
//   contacts      contacts    where pairs of facets meet; the pairs come from box_tree
//   edges         splits      divides edges at each other, for all facets at once
//   pieces        cells       the cells of each facet
//   sides         surface,    what hangs together; what is closed; on which side of what it lies
//                 winding, selection
//   faces         outlines,   pieces of a face become polygons, attributes are interpolated
//                 assembly
#include "geom/solid/boolean.h"

#include <algorithm>
#include <utility>

#include "base/work.h"
#include "geom/solid/assembly.h"
#include "geom/solid/contacts.h"

namespace gable {
namespace {

std::optional<SolidResult> tryBoolean(const Mesh& m, std::span<const uint32_t> operandOf,
                                      SolidOp op, double tolerance) {
  solid::Facets facets = solid::facetsOf(m, operandOf, tolerance);
  solid::findContacts(facets);
  solid::Splits splits(facets.pool);
  if (!solid::divideEdges(facets, splits)) return std::nullopt;
  std::vector<solid::Piece> pieces;
  solid::FacetEdges edges;
  for (uint32_t f = 0; f < facets.list.size(); ++f) {
    if (!solid::edgesOf(facets.list[f], splits, edges)) return std::nullopt;
    solid::addPieces(facets, f, edges, pieces);
  }
  const solid::Selection selection = solid::select(facets, splits, pieces, op);
  std::vector<solid::Outline> outlines;
  if (!solid::outlinesOf(facets, pieces, selection, outlines)) return std::nullopt;
  return solid::assemble(m, facets, splits, selection.cuts, std::move(outlines));
}

// Of the extent, and well above the rounding of the coordinates.
double toleranceFor(const Mesh& m) {
  constexpr double kOfExtent = 1e-9, kOfPlace = 1e-14;
  const Box3 box = m.bounds();
  double far = 0;
  for (const Vec3& p : {box.min, box.max}) {
    far = std::max({far, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return std::max(kOfExtent * length(box.size()), kOfPlace * far);
}

}  // namespace

std::optional<SolidResult> solidBoolean(const Mesh& m, std::span<const uint32_t> operandOf,
                                        SolidOp op) {
  if (m.empty()) return SolidResult{};
  const double tolerance = toleranceFor(m);
  constexpr double kLeast = 1e-100, kMost = 1e100;
  if (!(tolerance > kLeast && tolerance < kMost)) return std::nullopt;
  for (const double share : {1.0, 8.0, 0.125, 64.0}) {
    if (auto result = tryBoolean(m, operandOf, op, tolerance * share)) return result;
  }
  return std::nullopt;
}

}  // namespace gable
