// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Facets: the faces of a mesh as plane polygons over shared vertices, the input of an arrangement.
// A face that is not plane becomes a facet for each of its triangles. A face without width becomes
// a Sliver: nothing of it is seen, but the edges on its two sides are one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/mesh/mesh.h"
#include "geom/mesh/projection.h"
#include "geom/solid/vertex_pool.h"
#include "math/box.h"

namespace gable::solid {

using Edge = std::array<uint32_t, 2>;

/// The same for both directions.
inline uint64_t edgeKey(uint32_t u, uint32_t v) {
  return u < v ? uint64_t{u} << 32 | v : uint64_t{v} << 32 | u;
}
inline uint64_t edgeKey(const Edge& e) { return edgeKey(e[0], e[1]); }

struct Facet {
  uint32_t face = 0;
  uint32_t operand = 0;
  /// Of length 1.
  Vec3 normal, origin;
  Projection project;
  Box3 box;
  std::vector<std::vector<uint32_t>> loops;
  // Where other facets meet it inside: edges, and points that are not vertices of its own.
  std::vector<Edge> inner;
  std::vector<uint32_t> points;

  double height(const Vec3& p) const { return dot(normal, p - origin); }
  bool hasVertex(uint32_t v) const;
  bool hasEdge(uint32_t u, uint32_t v) const;
};

/// Calls visit(u, v) for each edge of the facet's loops.
template <class Visit>
void forEdges(const Facet& f, const Visit& visit) {
  for (const auto& loop : f.loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      visit(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
    }
  }
}

struct Facets {
  VertexPool pool;
  /// For each position of the mesh its vertex.
  std::vector<uint32_t> vertexOf;
  std::vector<Facet> list;
  /// The loops of faces without width.
  std::vector<std::vector<uint32_t>> slivers;
};

/// `operandOf`: for each face the operand that it belongs to. Points within the tolerance are one.
Facets facetsOf(const Mesh& m, std::span<const uint32_t> operandOf, double tolerance);

/// Distance of a point from the closed segment a b, and how far along it the nearest point is, in
/// 0..1.
struct Nearest {
  double distance = 0, along = 0;
};
Nearest nearestOn(const Vec3& a, const Vec3& b, const Vec3& p);

/// Whether the ray from p to +x passes the edge from a to b: of a closed ring an odd number of
/// edges where p is inside. Signs are exact; a vertex on the ray counts once.
bool passes(Vec2 a, Vec2 b, Vec2 p);

/// A point of the facet's plane lies in the facet or within the pool's tolerance of its boundary.
bool covers(const Facet& f, const VertexPool& pool, const Vec3& p);

}  // namespace gable::solid
