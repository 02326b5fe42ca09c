// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Streets as a plane graph: where they cross, the ground they take, the blocks between them. Plan
// coordinates, metres.
//
// Promises
//  1. Edges meet in nodes only: crossings become nodes, ends near a street are joined to it, what
//     lies within `snap` of each other becomes one node.
//  2. Roadways (a ribbon for each edge) and junctions (a polygon for each node where three edges or
//     more meet) do not overlap each other; nor do blocks.
//  3. Streets and blocks make up the area: their areas add up to it.
//  4. Equal input gives equal output.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/curve/curve.h"
#include "geom/region/region.h"

namespace gable {

struct Street {
  Line line;
  /// From kerb to kerb, with pavements if they are the street's.
  double width = 8;
};

struct StreetGraph {
  struct Node {
    Vec2 point;
    /// Edges that begin or end here (a loop twice), counter-clockwise by direction.
    std::vector<uint32_t> edges;
  };
  /// A stretch of a street between two nodes.
  struct Edge {
    uint32_t from = 0, to = 0;
    uint32_t street = 0;
    double width = 8;
    /// From node to node.
    Line line;
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;
};

struct StreetGraphOptions {
  /// What lies nearer than this is one place.
  double snap = 1;
  /// Dead ends shorter than this go; longer ones stay.
  double shortest = 10;
  /// May be null. Dead ends that leave the area, or end at its border, stay.
  const Region* area = nullptr;
};

StreetGraph buildStreetGraph(const std::vector<Street>& streets,
                             const StreetGraphOptions& options = {});

struct StreetPlan {
  /// By edge of the graph; empty where junctions leave nothing of it.
  std::vector<Region> roadways;
  /// By node; empty where fewer than three edges meet.
  std::vector<Region> junctions;
  /// What the streets leave of the area, without what is smaller than the least block.
  Region blocks;
  /// Such small leavings: traffic islands.
  Region islands;
};

/// `cornerRadius` rounds the kerbs at junctions. O(n log n) for streets that do not crowd.
StreetPlan planStreets(const StreetGraph& graph, const Region& area, double cornerRadius = 4,
                       double leastBlock = 100);

}  // namespace gable
