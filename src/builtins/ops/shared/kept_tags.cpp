// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/kept_tags.h"

#include <algorithm>
#include <vector>

#include "base/work.h"
#include "builtins/auto_tags.h"
#include "geom/solid/box_tree.h"
#include "geom/solid/facets.h"

namespace gable {

namespace {

// The boolean unites points within 1e-9 of the extent.
constexpr double kOfExtent = 1e-8;

bool anyTags(const std::vector<uint32_t>& sets) {
  return std::any_of(sets.begin(), sets.end(), [](uint32_t set) { return set != 0; });
}

// Calls visit(corner, the one behind it) for each edge.
template <class Visit>
void forEdges(const Mesh& m, const Visit& visit) {
  for (const MeshLoop& loop : m.loops) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      work();
      visit(loop.firstCorner + i, loop.firstCorner + (i + 1) % loop.cornerCount);
    }
  }
}

class Keeper {
 public:
  Keeper(Mesh& result, const Mesh& input, const Services& services)
      : result_(result), input_(input), tags_(services, ""), near_(kOfExtent * extentOf(input)) {}

  void keepEdges() {
    if (!anyTags(input_.edgeTags)) return;
    std::vector<Tagged> edges;
    forEdges(input_, [&](uint32_t a, uint32_t b) {
      const uint32_t set = input_.edgeTagsAt(a);
      if (set != 0) edges.push_back({input_.at(a), input_.at(b), set});
    });
    const solid::BoxTree tree(boxesOf(edges));
    result_.edgeTags.resize(result_.corners.size());
    forEdges(result_, [&](uint32_t a, uint32_t b) {
      const Vec3 from = result_.at(a), to = result_.at(b);
      Box3 middle;
      middle.include((from + to) * 0.5);
      uint32_t& set = result_.edgeTags[a];
      tree.query(middle, [&](uint32_t e) {
        if (isOn(edges[e], from) && isOn(edges[e], to)) set = tags_.merged(set, edges[e].tags);
      });
    });
  }

  void keepVertices() {
    if (!anyTags(input_.vertexTags)) return;
    std::vector<Tagged> points;
    for (uint32_t p = 0; p < input_.positions.size(); ++p) {
      const uint32_t set = input_.vertexTagsAt(p);
      if (set != 0) points.push_back({input_.positions[p], input_.positions[p], set});
    }
    const solid::BoxTree tree(boxesOf(points));
    result_.vertexTags.resize(result_.positions.size());
    for (uint32_t p = 0; p < result_.positions.size(); ++p) {
      work();
      Box3 at;
      at.include(result_.positions[p]);
      uint32_t& set = result_.vertexTags[p];
      tree.query(at, [&](uint32_t k) { set = tags_.merged(set, points[k].tags); });
    }
  }

 private:
  struct Tagged {
    Vec3 a, b;
    uint32_t tags;
  };

  static double extentOf(const Mesh& m) {
    const Box3 box = m.bounds();
    return m.positions.empty() ? 0 : length(box.max) + length(box.min);
  }
  std::vector<Box3> boxesOf(const std::vector<Tagged>& edges) const {
    const Vec3 slack{near_, near_, near_};
    std::vector<Box3> boxes(edges.size());
    for (size_t k = 0; k < edges.size(); ++k) {
      boxes[k].include(edges[k].a);
      boxes[k].include(edges[k].b);
      boxes[k] = {boxes[k].min - slack, boxes[k].max + slack};
    }
    return boxes;
  }
  bool isOn(const Tagged& edge, const Vec3& p) const {
    return solid::nearestOn(edge.a, edge.b, p).distance <= near_;
  }

  Mesh& result_;
  const Mesh& input_;
  AutoTags tags_;
  double near_;
};

}  // namespace

void keepTags(Mesh& result, const Mesh& input, const Services& services) {
  Keeper keeper(result, input, services);
  keeper.keepEdges();
  keeper.keepVertices();
}

}  // namespace gable
