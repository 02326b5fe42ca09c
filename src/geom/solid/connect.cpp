// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/connect.h"

#include <algorithm>
#include <utility>

#include "base/work.h"
#include "geom/solid/assembly.h"
#include "geom/solid/box_tree.h"

namespace gable {
namespace {

class Connector {
 public:
  Connector(const Mesh& m, double tolerance)
      : mesh_(m),
        facets_{solid::VertexPool(tolerance, m.positions.size()), {}, {}, {}},
        splits_(facets_.pool) {}

  Mesh run() {
    for (const Vec3& p : mesh_.positions) facets_.vertexOf.push_back(facets_.pool.snap(p));
    divide();
    std::vector<solid::Outline> outlines;
    for (uint32_t f = 0; f < mesh_.faceCount(); ++f) addOutline(f, outlines);
    return solid::assemble(mesh_, facets_, splits_, {}, std::move(outlines)).mesh;
  }

 private:
  uint32_t vertexAt(const MeshLoop& loop, uint32_t i) const {
    return facets_.vertexOf[mesh_.corners[loop.firstCorner + i % loop.cornerCount]];
  }

  // Edges through the vertices that lie on them.
  void divide() {
    std::vector<Box3> places(facets_.pool.size());
    for (uint32_t v = 0; v < places.size(); ++v) places[v].include(facets_.pool[v]);
    const solid::BoxTree tree(places);
    const double slack = facets_.pool.tolerance();
    for (const MeshLoop& loop : mesh_.loops) {
      for (uint32_t i = 0; loop.cornerCount > 1 && i < loop.cornerCount; ++i) {
        const uint32_t u = vertexAt(loop, i), v = vertexAt(loop, i + 1);
        if (u == v || splits_.divides(u, v)) continue;
        Box3 box = places[u];
        box.include(places[v]);
        box = {box.min - Vec3{slack, slack, slack}, box.max + Vec3{slack, slack, slack}};
        tree.query(box, [&](uint32_t w) {
          const solid::Nearest n =
              solid::nearestOn(facets_.pool[u], facets_.pool[v], facets_.pool[w]);
          if (n.along > 0 && n.along < 1 && n.distance <= slack / 2) splits_.add(u, v, w);
        });
      }
    }
  }

  void addOutline(uint32_t face, std::vector<solid::Outline>& outlines) const {
    solid::Outline out;
    out.face = face;
    for (const MeshLoop& loop : mesh_.loopsOf(face)) {
      std::vector<solid::Edge> edges;
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const uint32_t u = vertexAt(loop, i), v = vertexAt(loop, i + 1);
        const size_t before = edges.size();
        if (u == v && loop.cornerCount > 1) continue;
        if (u != v && loop.cornerCount > 2 && splits_.expand(u, v, edges)) continue;
        edges.resize(before);
        edges.push_back({u, v});
      }
      std::vector<uint32_t> vertices;
      for (const solid::Edge& e : edges) vertices.push_back(e[0]);
      const bool whole = vertices.size() >= std::min(loop.cornerCount, 3u);
      if (whole) out.loops.push_back(std::move(vertices));
      // A face without its outer loop is none.
      if (!whole && out.loops.empty()) return;
    }
    work(out.loops.size());
    if (!out.loops.empty()) outlines.push_back(std::move(out));
  }

  const Mesh& mesh_;
  solid::Facets facets_;
  solid::Splits splits_;
};

}  // namespace

Mesh connected(const Mesh& m) {
  constexpr double kOfExtent = 1e-9;
  const double extent = length(m.bounds().size());
  if (!(extent > 1e-90 && extent < 1e90)) return m;
  return Connector(m, kOfExtent * extent).run();
}

}  // namespace gable
