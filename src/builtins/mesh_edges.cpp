// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/mesh_edges.h"

#include <algorithm>
#include <numeric>

#include "geom/mesh/corner_links.h"

namespace gable {

MeshEdges::MeshEdges(const Mesh& m) : mesh_(m) {
  const size_t n = m.corners.size();
  edgeOf_.resize(n);
  linkCorners(m, faceOf_, next_, previous_);
  const auto key = [&](uint32_t c) {
    const uint64_t a = m.corners[c], b = m.corners[next_[c]];
    return a < b ? a << 32 | b : b << 32 | a;
  };
  // Corners of one edge lie together; the first of them in the mesh's order stands for it.
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<uint32_t> first(n), second(n, MeshEdge::kNone), uses(n, 0);
  for (size_t i = 0; i < n;) {
    size_t end = i;
    while (end < n && key(order[end]) == key(order[i])) ++end;
    for (size_t k = i; k < end; ++k) first[order[k]] = order[i];
    uses[order[i]] = static_cast<uint32_t>(end - i);
    if (end - i > 1) second[order[i]] = order[i + 1];
    i = end;
  }
  for (uint32_t c = 0; c < n; ++c) {
    if (first[c] == c) {
      edgeOf_[c] = static_cast<uint32_t>(edges_.size());
      edges_.push_back({c, second[c], uses[c]});
    } else {
      edgeOf_[c] = edgeOf_[first[c]];
    }
  }
  byPosition_.resize(n);
  std::iota(byPosition_.begin(), byPosition_.end(), 0u);
  std::stable_sort(byPosition_.begin(), byPosition_.end(),
                   [&](uint32_t a, uint32_t b) { return m.corners[a] < m.corners[b]; });
  firstAt_.assign(m.positions.size() + 1, 0);
  for (const uint32_t p : m.corners) ++firstAt_[p + 1];
  std::partial_sum(firstAt_.begin(), firstAt_.end(), firstAt_.begin());
}

std::vector<uint32_t> MeshEdges::cornersAt(uint32_t position) const {
  return {byPosition_.begin() + firstAt_[position], byPosition_.begin() + firstAt_[position + 1]};
}

}  // namespace gable
