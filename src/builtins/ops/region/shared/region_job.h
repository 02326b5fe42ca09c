// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the operations on regions share: going over the faces, giving pieces out by kind, arguments.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "builtins/ops/region/shared/region_shape.h"
#include "builtins/ops/region/shared/region_text.h"
#include "geom/region/places.h"

namespace gable {

/// The faces of a shape, ready to be divided.
class RegionJob {
 public:
  explicit RegionJob(OpCall& call);

  bool empty() const { return faces_.empty(); }
  const std::vector<std::unique_ptr<RegionView>>& faces() const { return faces_; }

  /// Keeps a piece for the item of the block with that word.
  void keep(size_t face, std::string_view word, RegionPiece piece, std::vector<EdgeMark> marks,
            std::optional<CellMark> cell);
  /// Gives out what was kept: in the order of the block's items, each piece by itself, or all in
  /// one shape after `=`.
  void emit();
  size_t kept() const { return kept_.size(); }

  /// Whether all faces lie in one plane and look to one side: a region of one or several pieces.
  bool flat() const;
  /// The face of the largest area.
  size_t largest() const;
  /// The shape with other polygons in the place of each face; see RegionView::replace. With none
  /// at all it has no geometry.
  void replace(Shape& shape, std::span<const std::vector<RegionPiece>> byFace,
               bool reindex = false);

  /// Of the world, in the plane of a face.
  std::function<Frame()> worldIn(size_t face) const;

 private:
  struct Kept {
    size_t face;
    std::string word;
    RegionPiece piece;
    std::vector<EdgeMark> marks;
    std::optional<CellMark> cell;
  };
  OpCall& call_;
  MeshRef mesh_;
  std::vector<std::unique_ptr<RegionView>> faces_;
  std::vector<Kept> kept_;
};

/// An argument that is a number or a text: what it says as text.
std::string textOf(const OpCall& call, size_t argument, std::string_view otherwise);

/// A failure that names what is wrong when an argument has other options than `known` (see
/// checkOptions).
Status optionsAre(const OpCall& call, size_t argument, std::string_view known);

/// The failure of a shape whose faces are no region: they do not lie in one plane.
Status noOneRegion(OpCall& call);

/// The failure of a shape without a face to divide.
Status noRegion(OpCall& call);

/// Edges by an argument that is a selection.
Status selected(OpCall& call, size_t argument, std::string_view otherwise, const RegionJob& job,
                size_t face, const RegionView& view, std::vector<EdgePart>& out);

Status selectedBy(OpCall& call, std::string_view selection, const RegionJob& job, size_t face,
                  const RegionView& view, std::vector<EdgePart>& out);

/// Discs by a text "5 {[5-10]}" or a list of coordinates x, y, x, y (from the scope's origin, in
/// the plane).
Status discsOf(OpCall& call, size_t argument, const RegionView& view, uint64_t seed,
               std::vector<Disc>& out);

/// The lines that a text means: ranges along logical edges, or a selection, or several of both with
/// ; between. With an inset they lie on the region contracted by it.
Status linesOf(OpCall& call, size_t argument, double inset, const RegionJob& job, size_t face,
               const RegionView& view, std::vector<Polyline>& out);

}  // namespace gable
