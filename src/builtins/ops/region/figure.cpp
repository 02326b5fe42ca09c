// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A region replaced by a figure in its middle, as far as it lies in the region. A shape without a
// face becomes the figure itself, in the ground plane of its scope.
#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"

namespace gable {

namespace {

bool isFigure(const PlanFigure& f) { return f.a > 0 && f.b > 0 && std::isfinite(f.a + f.b); }

// The shape becomes the figures around its middle, as far as they lie in it.
Status become(OpCall& call, std::span<const PlanFigure> figures) {
  if (!std::all_of(figures.begin(), figures.end(), isFigure)) {
    return call.fail("bad-argument", "a figure needs lengths above zero", "write 1 or more");
  }
  RegionJob job(call);
  Shape& s = call.shape();
  const auto around = [&](Vec2 middle) {
    std::vector<Ring> rings;
    for (const PlanFigure& f : figures) rings.push_back(ringOf(f, middle));
    return rings.size() == 1 ? Region{{rings[0], {}}} : repaired(rings, FillRule::NonZero);
  };
  if (job.empty()) {
    MeshBuilder b;
    for (const Polygon& p : around({0, 0})) {
      std::vector<uint32_t> corners;
      for (const Vec2 v : p.outer) corners.push_back(b.addPosition(fromPlan(v)));
      b.addPolygon(corners);
    }
    setMesh(s, b.take(), ScopeFit::Refit);
    return {};
  }
  if (job.faces().size() != 1) {
    return call.fail("no-geometry", "the shape is not one face",
                     "take it apart first: comp(f) { all : ... }");
  }
  RegionView& view = *job.faces()[0];
  const Region together = around(middleOf(view.polygon()));
  const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
  const std::vector<RegionPiece> pieces =
      combineTraced(BooleanOp::Intersection, wholePiece(view.polygon()), together, made);
  if (pieces.empty()) {
    return call.fail("region-vanished", "nothing of the figure lies in the region",
                     "make it larger");
  }
  view.replace(s, pieces, true);
  return {};
}
Status become(OpCall& call, const PlanFigure& figure) { return become(call, {&figure, 1}); }

// "romb(3) rect(8, 2)": one after the other.
Status applyJoined(OpCall& call) {
  const std::string text = textOf(call, 0, "");
  std::vector<PlanFigure> figures;
  for (size_t begin = text.find_first_not_of(" ,|"); begin != std::string::npos;
       begin = text.find_first_not_of(" ,|", begin)) {
    const size_t close = text.find(')', begin);
    const size_t end = close == std::string::npos ? text.size() : close + 1;
    PlanFigure f;
    std::string problem;
    if (!readFigure(std::string_view(text).substr(begin, end - begin), f, problem)) {
      return call.fail("bad-argument", problem, "write joined(\"romb(3) rect(8, 2)\")");
    }
    figures.push_back(f);
    begin = end;
  }
  if (figures.empty()) {
    return call.fail("bad-argument", "there are no figures to join",
                     "write joined(\"romb(3) rect(8, 2)\")");
  }
  return become(call, figures);
}

Status applyCircle(OpCall& call) {
  const double n = std::clamp(call.number(1, 24), 3.0, 1000.0);
  return become(call, {PlanShape::Circle, call.number(0), 1, static_cast<uint32_t>(n)});
}
Status applyRomb(OpCall& call) { return become(call, {PlanShape::Romb, call.number(0), 1, 4}); }
Status applySquare(OpCall& call) { return become(call, {PlanShape::Square, call.number(0), 1, 4}); }
Status applyRect(OpCall& call) {
  return become(call, {PlanShape::Rect, call.number(0), call.number(1), 4});
}
Status applyPolygon(OpCall& call) {
  const double n = std::clamp(call.number(0), 3.0, 1000.0);
  return become(call, {PlanShape::Polygon, call.number(1), 1, static_cast<uint32_t>(n)});
}

constexpr ParamSpec kRadius = {"radius", ParamType::Float, "From the middle to a corner."};
constexpr ParamSpec kCircle[] = {
    {"radius", ParamType::Float, "In metres."},
    {"segments", ParamType::Float, "How many sides stand for the circle.", "24"}};
constexpr ParamSpec kRomb[] = {kRadius};
constexpr ParamSpec kSquare[] = {{"side", ParamType::Float, "In metres."}};
constexpr ParamSpec kRect[] = {{"width", ParamType::Float, "Along x."},
                               {"height", ParamType::Float, "Across."}};
constexpr ParamSpec kPolygon[] = {{"sides", ParamType::Float, "Three or more."}, kRadius};
constexpr Signature kCircleSignatures[] = {{kCircle}};
constexpr ParamSpec kJoined[] = {
    {"figures", ParamType::String, "One after the other: \"romb(3) rect(8, 2)\"."}};
constexpr Signature kJoinedSignatures[] = {{kJoined}};
constexpr Signature kRombSignatures[] = {{kRomb}};
constexpr Signature kSquareSignatures[] = {{kSquare}};
constexpr Signature kRectSignatures[] = {{kRect}};
constexpr Signature kPolygonSignatures[] = {{kPolygon}};

constexpr OpSpec kSpecs[] = {
    {"circle", "region", "Replaces a region by a circle in its middle.", kCircleSignatures,
     applyCircle, BlockKind::None, kPure, nullptr, false, true},
    {"joined", "region", "Replaces a region by several figures in its middle, united.",
     kJoinedSignatures, applyJoined, BlockKind::None, kPure, nullptr, false, true},
    {"rect", "region", "Replaces a region by a rectangle in its middle.", kRectSignatures,
     applyRect, BlockKind::None, kPure, nullptr, false, true},
    {"regularPolygon", "region", "Replaces a region by a polygon of equal sides in its middle.",
     kPolygonSignatures, applyPolygon, BlockKind::None, kPure, nullptr, false, true},
    {"romb", "region", "Replaces a region by a square on its corner in its middle.",
     kRombSignatures, applyRomb, BlockKind::None, kPure, nullptr, false, true},
    {"square", "region", "Replaces a region by a square in its middle.", kSquareSignatures,
     applySquare, BlockKind::None, kPure, nullptr, false, true},
};

}  // namespace

extern const OpList kOps_figure;
const OpList kOps_figure = kSpecs;

}  // namespace gable
