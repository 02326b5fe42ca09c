// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/ground.h"
#include "geom/plan/street_growth.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Parts smaller than this share of the ground are rounding.
constexpr double kSliver = 1e-9;
// Streets nearer to each other than their share of the width are one.
constexpr double kSnapShare = 0.25;
// A kerb lies half of the width from the centre line, and farther than the ends of its stretch.
constexpr double kKerbShare = 0.4;
// The cosine of the angle between a kerb and the centre line, at least.
constexpr double kParallel = 0.8;

Vec2 middleOf(const Polygon& p) {
  const Box2 box = bounds(p);
  return (box.min + box.max) * 0.5;
}

std::vector<Street> grown(const OpCall& call, const Ground& ground, uint64_t address) {
  const Region area{ground.polygon};
  const double spacing = call.number(1), width = call.number(2, 12);
  const double irregularity = call.number(3, 0.1);
  if (call.is(0, "grid")) {
    GridStreets o;
    o.spacing = spacing;
    o.crossSpacing = call.number(4, spacing * 1.5);
    o.angle = call.number(5, 0);
    o.irregularity = irregularity;
    o.width = width;
    o.address = address;
    return gridStreets(area, o);
  }
  if (call.is(0, "radial")) {
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
  field.addGrid(middleOf(ground.polygon), call.number(5, 0), 0);
  field.addRadial(middleOf(ground.polygon), extent / 4);
  field.setNoise(irregularity * 150, spacing * 2.5, hashCombine(address, 1));
  FieldStreets o;
  o.spacing = spacing;
  o.mainSpacing = call.number(4, spacing * 3.5);
  o.width = width;
  o.mainWidth = width * 1.6;
  o.shortest = spacing / 2;
  o.address = address;
  return fieldStreets(area, field, o);
}

// Which edges of a roadway are its kerbs: as far from the centre line as half of the width, and
// along it. By edge of the outer ring, then of the holes.
std::vector<bool> kerbs(const Polygon& roadway, const StreetGraph::Edge& street) {
  const Path centre(street.line);
  std::vector<bool> out;
  const auto add = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      const Path::Place place = centre.at(centre.nearest((a + b) * 0.5));
      const double away = length((a + b) * 0.5 - place.point);
      const bool parallel = std::fabs(dot(normalized(b - a), place.tangent)) > kParallel;
      out.push_back(parallel && away > street.width * kKerbShare);
    }
  };
  add(roadway.outer);
  for (const Ring& hole : roadway.holes) add(hole);
  return out;
}

const SelectorItem* itemFor(const OpCall& call, std::string_view what) {
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.size() != 1 || item.terms[0].kind != SelectorTerm::Kind::Word) continue;
    const std::string_view word = call.services().pool().text(item.terms[0].word);
    if (word == what || word == "all") return &item;
  }
  return nullptr;
}

Status applyStreets(OpCall& call) {
  const double spacing = call.number(1), width = call.number(2, 12);
  if (!(spacing > 0) || !(width > 0) || width >= spacing) {
    return call.fail("bad-argument",
                     "streets need a spacing and a width larger than 0, the width the smaller one",
                     "such as streets(grid, 80, 12)");
  }
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  uint32_t piece = 0;
  for (size_t g = 0; g < grounds.size(); ++g) {
    const Ground& ground = grounds[g];
    const std::vector<Street> streets = grown(call, ground, call.randomAddress(g));
    const Region area{ground.polygon};
    StreetGraphOptions joined;
    joined.area = &area;
    joined.snap = std::max(width * kSnapShare, 0.5);
    joined.shortest = spacing / 2;
    const StreetGraph graph = buildStreetGraph(streets, joined);
    const StreetPlan plan = planStreets(graph, area, width / 3, width * width);
    const auto emit = [&](const Region& parts, std::string_view what, auto&& streetEdges) {
      const SelectorItem* item = itemFor(call, what);
      for (const Polygon& p : parts) {
        const uint32_t number = piece++;
        if (!item || gable::area(p) < kSliver * gable::area(area)) continue;
        call.emit(groundPart(call, ground, p, kNoFront, streetEdges(p)), item->slot, number);
      }
    };
    const auto all = [](const Polygon& p) { return std::vector<bool>(p.outer.size(), true); };
    const auto none = [](const Polygon&) { return std::vector<bool>(); };
    emit(plan.blocks, "block", all);
    for (size_t e = 0; e < plan.roadways.size(); ++e) {
      emit(plan.roadways[e], "roadway", [&](const Polygon& p) { return kerbs(p, graph.edges[e]); });
    }
    for (const Region& r : plan.junctions) emit(r, "junction", none);
    emit(plan.islands, "island", none);
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    {"pattern", ParamType::Selector,
     "grid: two families of straight streets; radial: rings and spokes around the middle; field: "
     "main streets and others between them, along a field of directions that turns around the "
     "middle.",
     nullptr, "grid radial field"},
    {"spacing", ParamType::Float, "From street to street, in metres."},
    {"width", ParamType::Float, "Of a street, pavements included; main streets are wider.", "12"},
    {"irregularity", ParamType::Float, "How far streets leave their regular places, 0 to 0.4.",
     "0.1"},
    {"crossSpacing", ParamType::Float,
     "grid: between the streets across. field: between main streets.", "1.5 or 3.5 * spacing"},
    {"angle", ParamType::Float, "grid and field: turn of the pattern in degrees.", "0"},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"streets", "layout", "Lays streets over a face, and gives out the blocks between them.",
     kSignatures, applyStreets, BlockKind::Selectors, kRandom, "block roadway junction island",
     false, true},
};

}  // namespace

extern const OpList kOps_streets;
const OpList kOps_streets = kSpecs;

}  // namespace gable
