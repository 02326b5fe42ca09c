// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/solid/facets.h"

#include <algorithm>
#include <utility>

#include "geom/mesh/face_triangles.h"
#include "math/predicates.h"

namespace gable::solid {

bool Facet::hasVertex(uint32_t v) const {
  return std::any_of(loops.begin(), loops.end(), [&](const std::vector<uint32_t>& loop) {
    return std::find(loop.begin(), loop.end(), v) != loop.end();
  });
}

bool Facet::hasEdge(uint32_t u, uint32_t v) const {
  bool found = false;
  forEdges(*this, [&](uint32_t a, uint32_t b) {
    found = found || (a == u && b == v) || (a == v && b == u);
  });
  return found;
}

Nearest nearestOn(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  const double t = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return {length(p - (a + d * t)), t};
}

bool passes(Vec2 a, Vec2 b, Vec2 p) {
  return (a.y > p.y) != (b.y > p.y) && (orientation(a, b, p) > 0) == (b.y > a.y);
}

bool covers(const Facet& f, const VertexPool& pool, const Vec3& p) {
  const Vec2 q = f.project(p);
  bool inside = false, near = false;
  size_t edges = 0;
  forEdges(f, [&](uint32_t u, uint32_t v) {
    ++edges;
    if (near) return;
    near = nearestOn(pool[u], pool[v], p).distance <= pool.tolerance();
    if (passes(f.project(pool[u]), f.project(pool[v]), q)) inside = !inside;
  });
  work(edges);
  return near || inside;
}

namespace {

using Loops = std::vector<std::vector<uint32_t>>;

class FacetMaker {
 public:
  FacetMaker(const Mesh& m, Facets& out) : mesh_(m), out_(out) {}

  void add(uint32_t face, uint32_t operand) {
    Loops loops;
    for (const MeshLoop& loop : mesh_.loopsOf(face)) {
      std::vector<uint32_t> vertices;
      for (const uint32_t p : mesh_.cornersOf(loop)) vertices.push_back(out_.vertexOf[p]);
      work(vertices.size());
      addLoop(std::move(vertices), loops);
    }
    if (loops.empty() || put(face, operand, loops, out_.pool.tolerance() / 2)) return;
    std::vector<std::array<uint32_t, 3>> triangles;
    triangulator_.add(mesh_, face, triangles);
    if (triangles.empty()) out_.slivers.insert(out_.slivers.end(), loops.begin(), loops.end());
    for (const auto& t : triangles) {
      Loops one;
      addLoop({vertexAt(t[0]), vertexAt(t[1]), vertexAt(t[2])}, one);
      if (!one.empty()) put(face, operand, one, 1e300);
    }
  }

 private:
  uint32_t vertexAt(uint32_t corner) const { return out_.vertexOf[mesh_.corners[corner]]; }

  static void addLoop(std::vector<uint32_t> vertices, Loops& loops) {
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    while (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
    if (vertices.size() > 2) loops.push_back(std::move(vertices));
  }

  // False when a vertex is further from the plane than `flatness`.
  bool put(uint32_t face, uint32_t operand, const Loops& loops, double flatness) {
    const VertexPool& pool = out_.pool;
    Facet f;
    f.face = face;
    f.operand = operand;
    f.loops = loops;
    for (const auto& loop : loops) {
      for (const uint32_t v : loop) f.box.include(pool[v]);
    }
    const std::vector<uint32_t>& outer = loops[0];
    Vec3 sum, area;
    for (const uint32_t v : outer) sum += pool[v] - pool[outer[0]];
    f.origin = pool[outer[0]] + sum * (1 / static_cast<double>(outer.size()));
    for (size_t i = 0; i < outer.size(); ++i) {
      area += cross(pool[outer[i]] - f.origin, pool[outer[(i + 1) % outer.size()]] - f.origin);
    }
    f.normal = normalized(area);
    f.project = projectionFor(f.normal);
    // Twice the area by the length: the width.
    if (length(area) <= pool.tolerance() * length(f.box.size())) {
      if (outer.size() > 3) return false;
      out_.slivers.push_back(outer);
      return true;
    }
    for (const auto& loop : loops) {
      for (const uint32_t v : loop) {
        if (std::fabs(f.height(pool[v])) > flatness) return false;
      }
    }
    out_.list.push_back(std::move(f));
    return true;
  }

  const Mesh& mesh_;
  Facets& out_;
  FaceTriangulator triangulator_;
};

}  // namespace

Facets facetsOf(const Mesh& m, std::span<const uint32_t> operandOf, double tolerance) {
  Facets out{VertexPool(tolerance, m.positions.size()), {}, {}, {}};
  out.vertexOf.reserve(m.positions.size());
  for (const Vec3& p : m.positions) out.vertexOf.push_back(out.pool.snap(p));
  FacetMaker maker(m, out);
  for (uint32_t f = 0; f < m.faces.size(); ++f) {
    if (m.faces[f].loopCount > 0) maker.add(f, operandOf[f]);
  }
  return out;
}

}  // namespace gable::solid
