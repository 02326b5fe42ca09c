// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests only: the hostile polygon corpus as shapes take it, and questions that tests put to
// meshes.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "geom/mesh/mesh.h"
#include "geom/region/corpus.h"

namespace gable {

struct TestPolygon {
  /// As polygonShape takes them: all counter-clockwise, the first the outer one.
  std::vector<std::vector<Vec2>> rings;
  size_t number = 0;
};

/// Every `stride`-th polygon of the corpus with up to six seeded holes; empty where the corpus
/// is not.
inline std::vector<TestPolygon> hostilePolygons(size_t stride, bool holes) {
  std::vector<TestPolygon> out;
  size_t number = 0;
  for (const corpus::Case& c : corpus::loadCorpus(stride)) {
    const Polygon p = holes ? corpus::withHoles(c.ring, number + 1) : Polygon{c.ring, {}};
    TestPolygon t;
    t.number = number * stride;
    t.rings.push_back(p.outer);
    for (Ring hole : p.holes) {
      if (signedArea(hole) < 0) std::reverse(hole.begin(), hole.end());
      t.rings.push_back(std::move(hole));
    }
    out.push_back(std::move(t));
    ++number;
  }
  return out;
}

/// Every edge is met once in each direction.
inline bool isClosed(const Mesh& m) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const MeshLoop& loop : m.loops) {
    const auto ring = m.cornersOf(loop);
    for (size_t i = 0; i < ring.size(); ++i) ++edges[{ring[i], ring[(i + 1) % ring.size()]}];
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    const auto twin = edges.find({e.first.second, e.first.first});
    return e.second == 1 && twin != edges.end() && twin->second == 1;
  });
}

}  // namespace gable
