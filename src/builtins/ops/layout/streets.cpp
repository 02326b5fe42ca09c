// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/ground.h"
#include "builtins/ops/layout/shared/kerbs.h"
#include "builtins/ops/shared/face_plan.h"
#include "geom/plan/street_growth.h"
#include "geom/region/boolean.h"
#include "geom/region/hull.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Parts smaller than this share of the ground are rounding.
constexpr double kSliver = 1e-9;
// Streets nearer to each other than their share of the width are one.
constexpr double kSnapShare = 0.25;
// Points that lie nearer than this to the line without them are left out of given lines.
constexpr double kSmooth = 0.01;
constexpr double kOnBorder = 1e-3;

Vec2 middleOf(const Polygon& p) {
  const Box2 box = bounds(p);
  return (box.min + box.max) * 0.5;
}

enum class Pattern : uint8_t { Grid, Radial, Field, Given };

}  // namespace

template <>
struct WordsOf<Pattern> {
  static constexpr const char* text = "grid radial field given";
};

namespace {

struct Streets {
  Pattern pattern;
  double spacing, width, irregularity;
  std::optional<double> crossSpacing;
  double angle;
};

std::vector<Street> grown(const Streets& args, const Ground& ground, uint64_t address) {
  const Region area{ground.polygon};
  const double spacing = args.spacing, width = args.width;
  const double irregularity = args.irregularity;
  if (args.pattern == Pattern::Grid) {
    GridStreets o;
    o.spacing = spacing;
    o.crossSpacing = args.crossSpacing.value_or(spacing * 1.5);
    o.angle = args.angle;
    o.irregularity = irregularity;
    o.width = width;
    o.address = address;
    return gridStreets(area, o);
  }
  if (args.pattern == Pattern::Radial) {
    RadialStreets o;
    o.center = middleOf(ground.polygon);
    o.spacing = spacing;
    o.irregularity = irregularity;
    o.width = width;
    o.address = address;
    return radialStreets(area, o);
  }
  const Box2 box = bounds(ground.polygon);
  const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  DirectionField field;
  field.addGrid(middleOf(ground.polygon), args.angle, 0);
  field.addRadial(middleOf(ground.polygon), extent / 4);
  field.setNoise(irregularity * 150, spacing * 2.5, hashCombine(address, 1));
  FieldStreets o;
  o.spacing = spacing;
  o.mainSpacing = args.crossSpacing.value_or(spacing * 3.5);
  o.width = width;
  o.mainWidth = width * 1.6;
  o.shortest = spacing / 2;
  o.address = address;
  return fieldStreets(area, field, o);
}

std::vector<Polyline2> givenLines(OpCall& call) {
  const MeshRef mesh = meshInScope(call.shape());
  return polylinesOf(*mesh, call.services().tags());
}

// The lines of the shape, within the area.
std::vector<Street> given(const std::vector<Polyline2>& lines, const Region& area, double width) {
  std::vector<Street> streets;
  for (const Polyline2& l : lines) {
    Line line = l.line;
    if (l.closed) line.push_back(line.front());
    streets.push_back({simplified(line, kSmooth), l.width > 0 ? l.width : width});
  }
  return streetsWithin(area, streets);
}

// Where given lines have no face beside them: the ground within a distance of their hull.
Status groundAround(const OpCall& call, const std::vector<Polyline2>& lines, double reach,
                    std::vector<Ground>& out) {
  std::vector<Vec2> points;
  for (const Polyline2& l : lines) points.insert(points.end(), l.line.begin(), l.line.end());
  Ground g;
  const Ring hull = convexHull(points);
  Region area;
  if (hull.size() > 2) {
    area = offset({{hull, {}}}, reach);
  } else if (!lines.empty()) {
    OffsetOptions square;
    square.join = OffsetJoin::Square;
    area = thicken(lines[0].line, reach, square);
  }
  if (area.empty()) {
    return call.fail("no-geometry", "streets(given) has no lines",
                     "make them with curve, or read lines from a file");
  }
  g.polygon = area[0];
  g.frame = groundAt(lines[0].height);
  out.push_back(std::move(g));
  return {};
}

Status applyStreets(OpCall& call, const Streets& args) {
  const double spacing = args.spacing, width = args.width;
  if (width >= spacing) {
    return call.fail("bad-argument", "the width of streets is not smaller than their spacing",
                     "such as streets(grid, 80, 12)");
  }
  std::vector<Ground> grounds;
  const bool areGiven = args.pattern == Pattern::Given;
  const std::vector<Polyline2> lines = areGiven ? givenLines(call) : std::vector<Polyline2>{};
  Status sound = groundsOf(call, grounds);
  if (areGiven && !sound) sound = groundAround(call, lines, spacing, grounds);
  if (!sound) return sound;
  uint32_t piece = 0;
  for (size_t g = 0; g < grounds.size(); ++g) {
    const Ground& ground = grounds[g];
    const Region area{ground.polygon};
    const std::vector<Street> streets =
        areGiven ? given(lines, area, width) : grown(args, ground, call.randomAddress(g));
    StreetGraphOptions joined;
    joined.area = &area;
    joined.snap = std::max(width * kSnapShare, 0.5);
    // Given streets all stay.
    joined.shortest = areGiven ? joined.snap : spacing / 2;
    const StreetGraph graph = buildStreetGraph(streets, joined);
    const StreetPlan plan = planStreets(graph, area, width / 3, width * width);
    // Given lines may run through open ground.
    if (!areGiven && plan.blocks.empty()) {
      call.services().warn("no-cells", "'streets': no block is left between the streets",
                           "write a smaller spacing and width, or take a larger ground");
    }
    const auto emit = [&](const Region& parts, std::string_view what, auto&& streetEdges,
                          auto&& uvsOf) {
      const SelectorItem* item = itemFor(call, what);
      for (const Polygon& p : parts) {
        const uint32_t number = piece++;
        if (!item || gable::area(p) < kSliver * gable::area(area)) continue;
        call.emit(groundPart(call, ground, p, kNoFront, streetEdges(p), uvsOf(p)), item->slot,
                  number);
      }
    };
    // The border of the ground is no street; grown streets take the outer one for one.
    const auto all = [&](const Polygon& p) {
      std::vector<bool> out;
      const auto add = [&](const Ring& ring) {
        for (size_t i = 0; i < ring.size(); ++i) {
          const Vec2 middle = (ring[i] + ring[(i + 1) % ring.size()]) * 0.5;
          out.push_back(!areGiven || distanceToBoundary(ground.polygon, middle) > kOnBorder);
        }
      };
      add(p.outer);
      for (const Ring& hole : p.holes) {
        if (areGiven) add(hole);
      }
      return out;
    };
    const auto none = [](const Polygon&) { return std::vector<bool>(); };
    const auto noUvs = [](const Polygon&) { return std::vector<StreetUvs>(); };
    emit(plan.blocks, "block", all, noUvs);
    for (size_t e = 0; e < plan.roadways.size(); ++e) {
      const StreetGraph::Edge& street = graph.edges[e];
      const Polyline2 centre{street.line};
      emit(
          plan.roadways[e], "roadway",
          [&](const Polygon& p) {
            return kerbsAlong(p, {&centre, 1}, street.width);
          },
          [&](const Polygon& p) { return roadwayUvs(p, street.line, street.width); });
    }
    for (const Region& r : plan.junctions) emit(r, "junction", none, junctionUvs);
    emit(plan.islands, "island", none, noUvs);
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Streets::pattern>(
        "pattern",
        "grid: two families of straight streets; radial: rings and spokes around the middle; "
        "field: "
        "main streets and others between them, along a field of directions that turns around the "
        "middle; given: the lines of the shape."),
    param<&Streets::spacing>("spacing",
                             "From street to street, in metres. given: how far the ground reaches "
                             "beyond them, where there "
                             "is no face.")
        .above(0),
    param<&Streets::width>("width", "Of a street, pavements included; main streets are wider.",
                           "12")
        .above(0),
    param<&Streets::irregularity>("irregularity",
                                  "How far streets leave their regular places, 0 to 0.4.", "0.1"),
    param<&Streets::crossSpacing>("crossSpacing",
                                  "grid: between the streets across. field: between main streets.",
                                  "1.5 or 3.5 * spacing"),
    param<&Streets::angle>("angle", "grid and field: turn of the pattern in degrees.", "0"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {
    {"block", "Ground between streets."},
    {"roadway", "A street from one junction to the next."},
    {"junction", "Where streets meet."},
    {"island", "Ground that a roundabout or a square leaves in the middle of streets."}};
constexpr OpSpec kSpecs[] = {
    {"streets", "layout", "Lays streets over a face, and gives out the blocks between them.",
     kSignatures, typed<applyStreets>, BlockKind::Selectors, kRandom, kParts, false, true},
};

}  // namespace

extern const OpList kOps_streets;
const OpList kOps_streets = kSpecs;

}  // namespace gable
