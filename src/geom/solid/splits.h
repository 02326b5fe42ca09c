// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Splits: edges divided by vertices that lie on them, once for all facets that use them. So facets
// around an edge keep the same vertices on it, and what was closed stays closed.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geom/solid/facets.h"

namespace gable::solid {

class Splits {
 public:
  explicit Splits(const VertexPool& pool) : pool_(pool) {}

  /// From now on the edge u v runs through w. False where it does already, or ends there.
  bool add(uint32_t u, uint32_t v, uint32_t w);
  /// Appends the parts of the edge from u to v. False when they have no end: the vertices are too
  /// close together for the tolerance.
  bool expand(uint32_t u, uint32_t v, std::vector<Edge>& out, int depth = 0) const;
  bool divides(uint32_t u, uint32_t v) const { return inside_.count(edgeKey(u, v)) > 0; }
  bool empty() const { return inside_.empty(); }

 private:
  const VertexPool& pool_;
  // Only looked up. By edge from its lower vertex on, in their order along it.
  std::unordered_map<uint64_t, std::vector<uint32_t>> inside_;
};

/// Divides the edges of facets until in each of them edges meet at their ends only. False where
/// that comes to no end.
bool divideEdges(Facets& facets, Splits& splits);

/// The facet has more within it than its own outline, or its outline touches itself.
bool isDivided(const Facet& f);

/// The edges of the outline and those within, in parts.
struct FacetEdges {
  std::vector<Edge> outline, inner;
};
bool edgesOf(const Facet& f, const Splits& splits, FacetEdges& out);

}  // namespace gable::solid
