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

// Of a shape without a face: the figures in the ground plane of its scope.
void setFigures(Shape& s, const Region& figures) {
  MeshBuilder b;
  for (const Polygon& p : figures) {
    std::vector<uint32_t> corners;
    for (const Vec2 v : p.outer) corners.push_back(b.addPosition(fromPlan(v)));
    b.addPolygon(corners);
  }
  setMesh(s, b.take(), ScopeFit::Refit);
}

// The shape becomes the figures around its middle, as far as they lie in it unless they are free.
// Of a region of several pieces it is the middle of the largest.
Status become(OpCall& call, std::span<const PlanFigure> figures, size_t reach) {
  if (!std::all_of(figures.begin(), figures.end(), isFigure)) {
    return call.fail("bad-argument", "a figure needs lengths above zero", "write 1 or more");
  }
  RegionJob job(call);
  const auto around = [&](Vec2 middle) {
    std::vector<Ring> rings;
    for (const PlanFigure& f : figures) rings.push_back(ringOf(f, middle));
    return rings.size() == 1 ? Region{{rings[0], {}}} : repaired(rings, FillRule::NonZero);
  };
  if (job.empty()) {
    setFigures(call.shape(), around({0, 0}));
    return {};
  }
  if (!job.flat()) return noOneRegion(call);
  const size_t face = job.largest();
  const Polygon& region = job.faces()[face]->polygon();
  const Region together = around(middleOf(region));
  const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
  std::vector<std::vector<RegionPiece>> pieces(job.faces().size());
  if (call.is(reach, "free")) {
    const EdgeSource sources[] = {sourceOf(region)};
    for (const Polygon& p : together) {
      RegionPiece piece = wholePiece(p);
      piece.edges = originsOf(p, sources, made);
      pieces[face].push_back(std::move(piece));
    }
  } else {
    pieces[face] = combineTraced(BooleanOp::Intersection, wholePiece(region), together, made);
  }
  if (pieces[face].empty()) {
    return failOrElse(call, "region-vanished", "nothing of the figure lies in the region",
                      "make it larger, or free");
  }
  job.replace(call.shape(), pieces, true);
  return {};
}
Status become(OpCall& call, const PlanFigure& figure, size_t reach) {
  return become(call, {&figure, 1}, reach);
}

// The plan of a mesh that lies flat in a plane; false for any other.
bool planOf(const Mesh& mesh, const Frame& plane, std::vector<Ring>& rings) {
  constexpr double kFlat = 1e-6;
  for (const Vec3& p : mesh.positions) {
    if (std::fabs(plane.toLocal(p).z) > kFlat) return false;
  }
  bool any = false;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    if (mesh.normal(f) == Vec3{}) continue;
    const PatchPlane face(mesh, f);
    const bool turned = dot(face.frame().z, plane.z) < 0;
    for (Ring& r : ringsOf(face.polygon())) {
      for (Vec2& v : r) {
        const Vec3 at = plane.toLocal(face.frame().point({v.x, v.y, 0}));
        v = {at.x, at.y};
      }
      if (turned) std::reverse(r.begin(), r.end());
      rings.push_back(std::move(r));
    }
    any = true;
  }
  return any;
}

// What came of the block: all that lies flat in the region's plane is one region, the rest stays.
Status unite(OpCall& call, std::span<Gathered> leaves) {
  RegionJob job(call);
  const size_t face = job.largest();
  const Polygon& region = job.faces()[face]->polygon();
  const Frame& plane = job.faces()[face]->plane().frame();
  std::vector<Ring> rings;
  for (Gathered& leaf : leaves) {
    Mesh mesh = meshInLocal(leaf.shape);
    for (Vec3& p : mesh.positions) p = call.shape().scope.toLocal(p);
    leaf.taken = planOf(mesh, plane, rings);
  }
  std::vector<std::vector<RegionPiece>> pieces(job.faces().size());
  const EdgeSource sources[] = {sourceOf(region)};
  for (const Polygon& p : repaired(rings, FillRule::NonZero)) {
    RegionPiece piece = wholePiece(p);
    piece.edges = originsOf(p, sources);
    pieces[face].push_back(std::move(piece));
  }
  if (pieces[face].empty()) {
    return call.fail("no-geometry", "nothing that the block makes lies flat in the region",
                     "extrude what has been joined, not its parts");
  }
  job.replace(call.shape(), pieces, true);
  return {};
}

// joined { A B }: waits for what comes of the block.
Status joinLater(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  uint32_t piece = 0;
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.empty()) call.emit(call.shape(), item.slot, piece++);
  }
  if (piece == 0) {
    return call.fail("bad-argument", "there is nothing to join",
                     "write joined { A B }, or joined(\"romb(3) rect(8, 2)\")");
  }
  call.gather();
  return {};
}

// "romb(3) rect(8, 2)": one after the other.
Status applyJoined(OpCall& call) {
  if (call.argCount() == 0) return joinLater(call);
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
  return become(call, figures, 1);
}

Status applyCircle(OpCall& call) {
  const double n = std::clamp(call.number(1, 24), 3.0, 1000.0);
  return become(call, {PlanShape::Circle, call.number(0), 1, static_cast<uint32_t>(n)}, 2);
}
Status applyRomb(OpCall& call) { return become(call, {PlanShape::Romb, call.number(0), 1, 4}, 1); }
Status applySquare(OpCall& call) {
  return become(call, {PlanShape::Square, call.number(0), 1, 4}, 1);
}
Status applyRect(OpCall& call) {
  return become(call, {PlanShape::Rect, call.number(0), call.number(1), 4}, 2);
}
Status applyPolygon(OpCall& call) {
  const double n = std::clamp(call.number(0), 3.0, 1000.0);
  return become(call, {PlanShape::Polygon, call.number(1), 1, static_cast<uint32_t>(n)}, 2);
}

constexpr ParamSpec kReach = {
    "reach", ParamType::Selector,
    "inside: only as far as the figure lies in the region; free: all of it.", "inside",
    "inside free"};
constexpr ParamSpec kRadius = {"radius", ParamType::Float, "From the middle to a corner."};
constexpr ParamSpec kCircle[] = {
    {"radius", ParamType::Float, "In metres."},
    {"segments", ParamType::Float, "How many sides stand for the circle.", "24"},
    kReach};
constexpr ParamSpec kRomb[] = {kRadius, kReach};
constexpr ParamSpec kSquare[] = {{"side", ParamType::Float, "In metres."}, kReach};
constexpr ParamSpec kRect[] = {
    {"width", ParamType::Float, "Along x."}, {"height", ParamType::Float, "Across."}, kReach};
constexpr ParamSpec kPolygon[] = {{"sides", ParamType::Float, "Three or more."}, kRadius, kReach};
constexpr Signature kCircleSignatures[] = {{kCircle}};
constexpr ParamSpec kJoined[] = {
    {"figures", ParamType::String, "One after the other: \"romb(3) rect(8, 2)\"."}, kReach};
constexpr Signature kJoinedSignatures[] = {{}, {kJoined}};
constexpr Signature kRombSignatures[] = {{kRomb}};
constexpr Signature kSquareSignatures[] = {{kSquare}};
constexpr Signature kRectSignatures[] = {{kRect}};
constexpr Signature kPolygonSignatures[] = {{kPolygon}};

constexpr OpSpec kSpecs[] = {
    {"circle", "region", "Replaces a region by a circle in its middle.", kCircleSignatures,
     applyCircle, BlockKind::Operations, kPure, "otherwise", true, true},
    {"joined",
     "region",
     "Replaces a region by several figures in its middle, united, or by all that a block makes of "
     "it.",
     kJoinedSignatures,
     applyJoined,
     BlockKind::Operations,
     kPure,
     "otherwise",
     true,
     true,
     {},
     1,
     unite},
    {"rect", "region", "Replaces a region by a rectangle in its middle.", kRectSignatures,
     applyRect, BlockKind::Operations, kPure, "otherwise", true, true},
    {"regularPolygon", "region", "Replaces a region by a polygon of equal sides in its middle.",
     kPolygonSignatures, applyPolygon, BlockKind::Operations, kPure, "otherwise", true, true},
    {"romb", "region", "Replaces a region by a square on its corner in its middle.",
     kRombSignatures, applyRomb, BlockKind::Operations, kPure, "otherwise", true, true},
    {"square", "region", "Replaces a region by a square in its middle.", kSquareSignatures,
     applySquare, BlockKind::Operations, kPure, "otherwise", true, true},
};

}  // namespace

extern const OpList kOps_figure;
const OpList kOps_figure = kSpecs;

}  // namespace gable
