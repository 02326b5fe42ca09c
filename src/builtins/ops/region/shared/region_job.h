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
#include "builtins/ops/region/shared/selection.h"
#include "geom/region/places.h"
#include "geom/region/smooth.h"

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
  /// The same for a division into cells; warns when none is left among the pieces. The remedy ends
  /// the hint "make the region larger, or ".
  void emitCells(const char* remedy);
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

/// The failure of a shape whose faces are no region: they do not lie in one plane.
Status noOneRegion(OpCall& call);

/// The failure of a shape without a face to divide.
Status noRegion(OpCall& call);

/// Edges by an argument that is a selection.
std::vector<EdgePart> selected(const OpCall& call, const Selection& selection, const RegionJob& job,
                               size_t face, std::vector<OwnWidth>* widths = nullptr);

/// What is scattered at most.
constexpr double kMostDiscs = 5000;

/// Discs: so many of a drawn radius, scattered; places with a radius or without; or a list of
/// coordinates x, y, x, y from the scope's origin, in the plane.
Status discsOf(OpCall& call, std::span<const Term> sites, const DrawnNumber& radius,
               const RegionView& view, uint64_t seed, std::vector<Disc>& out);

/// The lines that a selection means: parts of logical edges run clockwise and are one line where
/// they meet, all other edges are runs of the outline. With an inset they lie on the region
/// contracted by it.
Status linesOf(OpCall& call, const Selection& selection, double inset, const RegionJob& job,
               size_t face, std::vector<Polyline>& out);

/// The slot of the block's item with that word; none where there is none.
std::optional<uint32_t> slotOf(const OpCall& call, std::string_view word);

/// A figure as the kernel takes it; None for none. False when its lengths are not above zero.
bool planFigureOf(const DrawnFigure& figure, PlanFigure& out);
Status badFigure(const OpCall& call);

// Terms that several operations share.
namespace site_terms {
constexpr ParamSpec kPoint[] = {
    {"x", ParamType::Float, "Metres east of the south-west corner of the region's box."},
    {"y", ParamType::Float, "Metres north of it."},
    {"radius", ParamType::Float, "Of a disc there.", "0"}};
constexpr TermSpec kSites[] = {TermSpec::call("point", "A place in metres.", kPoint)};

constexpr ParamSpec kAverage[] = {
    {"times", ParamType::Float, "How often, up to 6.", "2"},
    {"weight", ParamType::Float, "What a vertex keeps of itself.", "0.3333333333333333"}};
constexpr ParamSpec kTimes[] = {{"times", ParamType::Float, "How often, up to 6.", "2"}};
constexpr ParamSpec kRadius[] = {{"radius", ParamType::Float, "In metres.", "1"}};
constexpr TermSpec kSmoothing[] = {
    {"none", "Borders stay as they are."},
    TermSpec::call("average", "Vertices move towards their neighbours.", kAverage),
    TermSpec::call("chaikin", "Corners are cut, again and again.", kTimes),
    {"bezier", "Arcs from the middle of each edge to the next."},
    TermSpec::call("round", "Corners get a radius.", kRadius)};
}  // namespace site_terms

/// none, average(2), chaikin(2), bezier, round(1); a number is that many averages.
Smoothing smoothingOf(std::span<const Term> terms);

}  // namespace gable
