// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Selections of edges as peel, distribute, sweep and region.selects take them: the terms that there
// are, and the parts of edges that they mean.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "builtins/ops/region/shared/region_shape.h"
#include "geom/region/along.h"
#include "shape/argument.h"

namespace gable {

struct SelectionInput {
  const RegionView& view;
  /// For random(p).
  uint64_t seed = 0;
  /// From the world to the plane of the region, for world.west and the like; asked only for these.
  std::function<Frame()> world;
  const ValuePool& pool;
};

/// Edges with a width of their own: wide(side(west), 2).
struct OwnWidth {
  std::vector<EdgePart> parts;
  double metres = 0;
};

/// The parts of edges that a selection means, ascending.
std::vector<EdgePart> selectEdges(std::span<const Term> terms, const SelectionInput& input,
                                  std::vector<OwnWidth>* widths = nullptr);

namespace edge_terms {

constexpr const char* kCompass = "west north east south W N E S";

constexpr TermSpec kDirections[] = {
    {"west", "-x of the region."},
    {"north", "Away from the first edge."},
    {"east", "x of the region."},
    {"south", "Towards the first edge."},
    {"W", "west"},
    {"N", "north"},
    {"E", "east"},
    {"S", "south"},
    {"world.west", "-x of the world."},
    {"world.north", "-z of the world."},
    {"world.east", "x of the world."},
    {"world.south", "z of the world."},
    {"world.W", "world.west"},
    {"world.N", "world.north"},
    {"world.E", "world.east"},
    {"world.S", "world.south"},
};

constexpr ParamSpec within(const char* doc) { return {"selection", ParamType::Selection, doc}; }
constexpr ParamSpec direction(const char* doc) {
  ParamSpec p{"direction", ParamType::Selection, doc};
  p.terms = kDirections;
  return p;
}

constexpr ParamSpec kLevel[] = {
    {"level", ParamType::Float,
     "Which ancestor: 0 is the region that this one was cut from, 1 the one before, -1 the initial "
     "one.",
     "-1"}};
constexpr ParamSpec kLast[] = {
    {"last", ParamType::Float, "Of which peel: 0 is the last one, 1 the one before.", "0"}};
constexpr ParamSpec kSide[] = {
    {"side", ParamType::Selector, "West, north, east or south of the region.", nullptr, kCompass}};
constexpr ParamSpec kEdge[] = {
    {"number", ParamType::Float,
     "Logical edges count clockwise from the south-west, from 0; -1 is the last."},
    {"from", ParamType::Float, "Share of its length at which the part begins.", "0"},
    {"to", ParamType::Float, "Share at which it ends.", "1"}};
constexpr ParamSpec kRange[] = {
    {"from", ParamType::Float, "1.25 is a quarter along logical edge 1."},
    {"to", ParamType::Float, "Where it ends, counted alike."}};
constexpr ParamSpec kMetres[] = {{"metres", ParamType::Float, "Length of the edge."}};
constexpr ParamSpec kAngles[] = {{"from", ParamType::Float, "In degrees, from x to the left."},
                                 {"to", ParamType::Float, "In degrees."}};
constexpr ParamSpec kSector[] = {
    {"from", ParamType::Float, "In degrees, from x to the left."},
    {"to", ParamType::Float, "In degrees."},
    {"edges", ParamType::Selector, "Whole edges, or the parts that lie in it.", "parts",
     "parts whole"}};
constexpr ParamSpec kTouches[] = {within("Edges that others touch.")};
constexpr ParamSpec kFacing[] = {direction("A side of the region or the world, or degrees.")};
constexpr ParamSpec kGrow[] = {
    direction("Where it begins; several with || between share the outline."),
    {"most", ParamType::Float, "Degrees by which an edge may turn from the others.", "1e9"}};
constexpr ParamSpec kWide[] = {within("Edges with a width of their own."),
                               ParamSpec{"width", ParamType::Float, "In metres."}.above(0)};
constexpr ParamSpec kIndex[] = {{"number", ParamType::Float, "From 0, through all rings."}};
constexpr ParamSpec kNth[] = {{"step", ParamType::Float, "Every so many edges."},
                              {"first", ParamType::Float, "The first of them.", "0"}};
constexpr ParamSpec kShare[] = {{"share", ParamType::Float, "From 0 to 1."}};

constexpr TermSpec kAll[] = {
    {"all", "Every edge."},
    TermSpec::call("outer", "On the boundary of the initial region, or of an ancestor.", kLevel),
    {"strictOuter", "Edges with both ends on the initial boundary."},
    {"inner", "All that are not outer."},
    {"border", "On the boundary of the region that this one was cut from."},
    {"front", "Edges that look towards z of the region's scope, as in comp and setback."},
    {"back", "Towards -z."},
    {"left", "Towards -x."},
    {"right", "Towards x."},
    {"pathSide", "Along a path."},
    {"centreSide", "Along a junction or a centre."},
    {"holeSide", "Around what was cut out."},
    {"cut", "Made by a cut."},
    TermSpec::call("peeledBase", "The outer side of a strip.", kLast),
    TermSpec::call("peeledInner", "Between strip and rest.", kLast),
    TermSpec::call("peeledSegment", "Between strip and rest, with the ends of strips.", kLast),
    {"corners", "Edges at a corner, where logical edges meet."},
    TermSpec::call("touches", "Edges that share a vertex with others.", kTouches),
    {"longest", "The longest edges."},
    {"shortest", "The shortest edges."},
    TermSpec::call("longer", "Edges longer than that.", kMetres),
    TermSpec::call("shorter", "Edges shorter than that.", kMetres),
    TermSpec::call("side", "A side of the region; mirrored with its cell.", kSide),
    TermSpec::call("edge", "A logical edge, or a part of it.", kEdge),
    TermSpec::call("range", "From a place along the logical edges to another.", kRange),
    TermSpec::call("facing", "Edges that look that way.", kFacing),
    TermSpec::call("angle", "Edges whose direction lies between two angles.", kAngles),
    TermSpec::call("sector", "Edges between two rays from the middle.", kSector),
    TermSpec::call("grow", "What belongs to a side, as the outline turns.", kGrow),
    TermSpec::call("wide", "The same edges, with a width of their own (peel).", kWide),
    TermSpec::call("index", "An edge by its number in the outline.", kIndex),
    TermSpec::call("nth", "Every so manieth edge.", kNth),
    TermSpec::call("random", "Each edge with that probability.", kShare),
};

}  // namespace edge_terms

inline constexpr std::span<const TermSpec> kEdgeTerms = edge_terms::kAll;

}  // namespace gable
