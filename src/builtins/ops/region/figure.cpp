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

enum class FigureReach : uint8_t { Inside, Free };

template <>
struct WordsOf<FigureReach> {
  static constexpr const char* text = "inside free";
};

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
Status become(OpCall& call, const PlanFigure& figure, FigureReach reach) {
  if (!isFigure(figure)) return badFigure(call);
  RegionJob job(call);
  const auto around = [&](Vec2 middle) { return Region{{ringOf(figure, middle), {}}}; };
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
  if (reach == FigureReach::Free) {
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
    return call.orElse(call.fail("region-vanished", "nothing of the figure lies in the region",
                                 "make it larger, or free"));
  }
  job.replace(call.shape(), pieces, true);
  return {};
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
                     "write joined { rhombus(3) A. | rect(8, 2) B. }");
  }
  call.gather();
  return {};
}

struct Figure {
  double size = 0, height = 0, sides = 24;
  FigureReach reach = FigureReach::Inside;
};

constexpr double kLeastSides = 3, kMostSides = 1000;

uint32_t sidesOf(double n) { return static_cast<uint32_t>(n); }

Status applyCircle(OpCall& call, const Figure& f) {
  return become(call, {PlanShape::Circle, f.size, 1, sidesOf(f.sides)}, f.reach);
}
Status applyRhombus(OpCall& call, const Figure& f) {
  return become(call, {PlanShape::Rhombus, f.size, 1, 4}, f.reach);
}
Status applySquare(OpCall& call, const Figure& f) {
  return become(call, {PlanShape::Square, f.size, 1, 4}, f.reach);
}
Status applyRect(OpCall& call, const Figure& f) {
  return become(call, {PlanShape::Rect, f.size, f.height, 4}, f.reach);
}
Status applyPolygon(OpCall& call, const Figure& f) {
  return become(call, {PlanShape::Polygon, f.size, 1, sidesOf(f.sides)}, f.reach);
}

constexpr ParamSpec kReach = param<&Figure::reach>(
    "reach", "inside: only as far as the figure lies in the region; free: all of it.", "inside");
constexpr ParamSpec kRadius =
    param<&Figure::size>("radius", "From the middle to a corner.").above(0);
constexpr ParamSpec kCircle[] = {
    param<&Figure::size>("radius", "In metres.").above(0),
    param<&Figure::sides>("segments", "How many sides stand for the circle.", "24")
        .between(kLeastSides, kMostSides),
    kReach};
constexpr ParamSpec kRhombus[] = {kRadius, kReach};
constexpr ParamSpec kSquare[] = {param<&Figure::size>("side", "In metres.").above(0), kReach};
constexpr ParamSpec kRect[] = {param<&Figure::size>("width", "Along x.").above(0),
                               param<&Figure::height>("height", "Across.").above(0), kReach};
constexpr ParamSpec kPolygon[] = {
    param<&Figure::sides>("sides", "How many sides.").between(kLeastSides, kMostSides), kRadius,
    kReach};
constexpr Signature kCircleSignatures[] = {{kCircle}};
constexpr Signature kJoinedSignatures[] = {{}};
constexpr Signature kRhombusSignatures[] = {{kRhombus}};
constexpr Signature kSquareSignatures[] = {{kSquare}};
constexpr Signature kRectSignatures[] = {{kRect}};
constexpr Signature kPolygonSignatures[] = {{kPolygon}};

constexpr OpSpec kSpecs[] = {
    asFigure({"circle", "region", "Replaces a region by a circle in its middle.", kCircleSignatures,
              typed<applyCircle>, BlockKind::Operations, kReadsRegion, kOtherwiseOnly, true, true}),
    {"joined",
     "region",
     "Replaces a region by all that a block makes of it, united.",
     kJoinedSignatures,
     joinLater,
     BlockKind::Operations,
     kReadsRegion,
     kOtherwiseOnly,
     true,
     true,
     {},
     1,
     unite},
    asFigure({"rect", "region", "Replaces a region by a rectangle in its middle.", kRectSignatures,
              typed<applyRect>, BlockKind::Operations, kReadsRegion, kOtherwiseOnly, true, true}),
    asFigure({"regularPolygon", "region",
              "Replaces a region by a polygon of equal sides in its middle.", kPolygonSignatures,
              typed<applyPolygon>, BlockKind::Operations, kReadsRegion, kOtherwiseOnly, true,
              true}),
    asFigure({"rhombus", "region", "Replaces a region by a square on its corner in its middle.",
              kRhombusSignatures, typed<applyRhombus>, BlockKind::Operations, kReadsRegion,
              kOtherwiseOnly, true, true}),
    asFigure({"square", "region", "Replaces a region by a square in its middle.", kSquareSignatures,
              typed<applySquare>, BlockKind::Operations, kReadsRegion, kOtherwiseOnly, true, true}),
};

}  // namespace

extern const OpList kOps_figure;
const OpList kOps_figure = kSpecs;

}  // namespace gable
