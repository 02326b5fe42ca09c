// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines as geometry, and ribbons along them. A ribbon is the ground within half of its width, with
// butt ends; its edges that run along the line are kerbs, as those of a roadway of `streets`.
#include "geom/curve/curve.h"
#include "base/work.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/kerbs.h"
#include "builtins/ops/layout/shared/polylines.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/region/boolean.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr size_t kMostGivenPoints = 100000;

// The rows of the array from `row` on that belong to one line: those with the same third number.
std::vector<Vec2> nextLine(const Array& a, size_t& row) {
  const auto at = [&](size_t r, size_t c) { return a.numbers[r * a.columns + c]; };
  std::vector<Vec2> out;
  const size_t first = row;
  for (; row < a.rows; ++row) {
    work();
    if (a.columns > 2 && !(at(row, 2) == at(first, 2))) break;
    out.push_back({at(row, 0), -at(row, 1)});
  }
  if (row == first) ++row;
  return out;
}

enum class Kind : uint8_t { Polyline, CatmullRom, Bezier, Arc };
enum class End : uint8_t { Open, Closed };
enum class What : uint8_t { Instead, Beside };

}  // namespace

template <>
struct WordsOf<Kind> {
  static constexpr const char* text = "polyline catmullRom bezier arc";
};
template <>
struct WordsOf<End> {
  static constexpr const char* text = "open closed";
};
template <>
struct WordsOf<What> {
  static constexpr const char* text = "instead beside";
};

namespace {

struct Curve {
  Kind kind;
  Floats points;
  End end;
  double tolerance;
  What what;
};

Line arcOf(const Array& a, size_t row, double tolerance) {
  const double* n = a.numbers.data() + row * a.columns;
  return arc({n[0], -n[1]}, n[2], n[3], n[4], tolerance);
}

std::vector<Polyline2> curvesOf(const Curve& args) {
  const Array& a = *args.points.array;
  const bool closed = args.end == End::Closed;
  const double tolerance = args.tolerance;
  std::vector<Polyline2> out;
  const auto add = [&](Line line, bool ring) {
    if (line.size() > 2 && line.front() == line.back()) {
      line.pop_back();
      ring = true;
    }
    line.erase(std::unique(line.begin(), line.end()), line.end());
    if (line.size() > 1) {
      const bool round = ring && line.size() > 2;
      out.push_back({std::move(line), round, 0, 0});
    }
  };
  const auto isLost = [](Vec2 p) { return !std::isfinite(p.x) || !std::isfinite(p.y); };
  for (size_t row = 0; row < a.rows;) {
    if (args.kind == Kind::Arc) {
      add(arcOf(a, row++, tolerance), false);
      continue;
    }
    std::vector<Vec2> points = nextLine(a, row);
    std::erase_if(points, isLost);
    if (args.kind == Kind::CatmullRom) {
      add(catmullRom(points, closed, tolerance), closed);
    } else if (args.kind == Kind::Bezier) {
      add(bezier(points, tolerance), closed);
    } else {
      add(points, closed);
    }
  }
  return out;
}

Status applyCurve(OpCall& call, const Curve& args) {
  const Array& points = *args.points.array;
  const uint32_t columns = args.kind == Kind::Arc ? 5 : 2;
  if (points.numbers.size() != points.size() || points.rows == 0 || points.columns < columns) {
    return call.fail("bad-argument",
                     columns == 5 ? "an arc is a row of five: x, z, radius, from, to"
                                  : "the points of a curve are rows of two: x, z",
                     columns == 5 ? "such as curve(arc, [10, 10, 8, 0, 90])"
                                  : "such as curve(catmullRom, [0, 0; 10, 5; 20, 0])");
  }
  if (points.rows > kMostGivenPoints) {
    return call.fail("bad-argument", "a curve takes 100000 points at most", "give fewer of them");
  }
  const auto curves = curvesOf(args);
  if (curves.empty()) {
    return call.fail("bad-argument", "the points make no line", "give at least two points");
  }
  const MeshRef before = meshInScope(call.shape());
  MeshBuilder b;
  std::vector<uint32_t> map(before->positions.size(), MeshBuilder::kNoPosition);
  const bool beside = args.what == What::Beside;
  for (size_t f = 0; beside && f < before->faceCount(); ++f) b.copyFace(*before, f, map);
  const double height = beside && !before->positions.empty() ? before->positions[0].y : 0;
  for (const Polyline2& c : curves) addPolyline(b, c.line, c.closed, height, 0);
  setMesh(call.shape(), b.take(), ScopeFit::Refit);
  return {};
}

// The ground along a line.
Region bandOf(const Polyline2& line, double half) {
  if (!line.closed) return thicken(line.line, half);
  OffsetOptions round;
  round.join = OffsetJoin::Round;
  const Region filled = repaired({line.line}, FillRule::NonZero);
  return subtract(offset(filled, half, round), offset(filled, -half, round));
}

struct Ribbon {
  double width;
};

Status applyRibbon(OpCall& call, const Ribbon& args) {
  const double width = args.width;
  const MeshRef mesh = meshInScope(call.shape());
  const auto lines = polylinesOf(*mesh, call.services().tags());
  if (lines.empty()) {
    return call.fail("no-geometry", "the shape has no line to make a ribbon along",
                     "make one with curve, or read lines from a file");
  }
  Region bands;
  for (const Polyline2& line : lines) bands = unite(bands, bandOf(line, width / 2));
  if (bands.empty()) {
    return call.fail("no-geometry", "the lines are too short for a ribbon", {});
  }
  const Frame ground = groundAt(lines[0].height);
  const TagSetId street = call.services().tags().of("street");
  MeshBuilder b;
  for (const Polygon& p : bands) {
    b.beginFace();
    const std::vector<bool> kerbs = kerbsAlong(p, lines, width);
    size_t edge = 0;
    const auto addRing = [&](const Ring& ring) {
      b.beginLoop();
      for (const Vec2 q : ring) {
        b.addCorner(b.addPosition(fromPlanFrame(ground, q)), kerbs[edge] ? street : 0);
        ++edge;
      }
    };
    addRing(p.outer);
    for (const Ring& hole : p.holes) addRing(hole);
  }
  setMesh(call.shape(), b.take(), ScopeFit::Refit);
  forgetFarTrimPlanes(call.shape());
  return {};
}

constexpr ParamSpec kCurveParams[] = {
    param<&Curve::kind>(
        "kind",
        "polyline: straight from point to point; catmullRom: smoothly through all points; bezier: "
        "cubic pieces, every third point is met; arc: of a circle."),
    param<&Curve::points>(
        "points",
        "A row for each point: x, z in the scope, and perhaps the number of its line. For arcs a "
        "row "
        "for each: x, z, radius, and two angles from x towards the back, in degrees."),
    param<&Curve::end>("end", "closed: back to the first point.", "open"),
    param<&Curve::tolerance>("tolerance", "How far straight pieces may leave the curve.", "0.001")
        .above(0),
    param<&Curve::what>(
        "what",
        "instead: of the geometry that was there; beside: that stays, as the area of streets.",
        "instead"),
};
constexpr Signature kCurve[] = {{kCurveParams}};
constexpr ParamSpec kRibbonParams[] = {
    param<&Ribbon::width>("width", "From side to side, in metres.").above(0)};
constexpr Signature kRibbon[] = {{kRibbonParams}};

constexpr OpSpec kSpecs[] = {
    {"curve", "layout", "Makes the geometry a line through given points.", kCurve,
     typed<applyCurve>, BlockKind::None, kPure, kNoParts, false, true},
    heavy({"ribbon", "layout", "Gives lines a width.", kRibbon, typed<applyRibbon>, BlockKind::None,
           kPure, kNoParts, false, true}),
};

}  // namespace

extern const OpList kOps_curve;
const OpList kOps_curve = kSpecs;

}  // namespace gable
