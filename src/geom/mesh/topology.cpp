// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edges come from sorting all half-edges by their two positions, components from union-find over
// positions.
#include "geom/mesh/topology.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "base/work.h"
#include "geom/mesh/corner_links.h"
#include "math/trig.h"

namespace gable {

Topology::Topology(const Mesh& m) : mesh_(m) {
  linkCorners();
  findEdges();
  findTwins();
  findComponents();
}

void Topology::linkCorners() {
  static_assert(kNone == kNoCornerLink);
  gable::linkCorners(mesh_, faceOf_, next_, previous_);
}

void Topology::findEdges() {
  struct Key {
    uint32_t low, high, corner;
  };
  std::vector<Key> keys;
  keys.reserve(mesh_.corners.size());
  for (uint32_t c = 0; c < mesh_.corners.size(); ++c) {
    if (next_[c] == kNone) continue;
    const uint32_t a = mesh_.corners[c], b = mesh_.corners[next_[c]];
    keys.push_back({std::min(a, b), std::max(a, b), c});
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.corner < b.corner;
  });
  // Edges are numbered by their first corner, so that they follow the order of faces.
  std::vector<std::pair<uint32_t, uint32_t>> groups;
  for (uint32_t i = 0, end = 0; i < keys.size(); i = end) {
    while (end < keys.size() && keys[end].low == keys[i].low && keys[end].high == keys[i].high)
      ++end;
    groups.push_back({i, end});
  }
  std::sort(groups.begin(), groups.end(), [&](const auto& a, const auto& b) {
    return keys[a.first].corner < keys[b.first].corner;
  });
  edgeOf_.assign(mesh_.corners.size(), kNone);
  for (const auto& [begin, end] : groups) {
    work();
    for (uint32_t k = begin; k < end; ++k) {
      edgeOf_[keys[k].corner] = static_cast<uint32_t>(edgeStarts_.size() - 1);
      uses_.push_back(keys[k].corner);
    }
    edgeStarts_.push_back(static_cast<uint32_t>(uses_.size()));
  }
}

void Topology::findTwins() {
  twin_.assign(mesh_.corners.size(), kNone);
  closed_ = !mesh_.faces.empty();
  for (uint32_t e = 0; e < edgeCount(); ++e) {
    const auto uses = usesOf(e);
    if (uses.size() != 2) {
      closed_ = false;
      continue;
    }
    if (mesh_.corners[uses[0]] == mesh_.corners[uses[1]]) continue;
    twin_[uses[0]] = uses[1];
    twin_[uses[1]] = uses[0];
  }
}

void Topology::findComponents() {
  DisjointSets sets(mesh_.positions.size());
  const auto firstOf = [&](uint32_t f) { return mesh_.corners[mesh_.loopsOf(f)[0].firstCorner]; };
  for (uint32_t c = 0; c < mesh_.corners.size(); ++c) {
    if (faceOf_[c] != kNone) sets.join(mesh_.corners[c], firstOf(faceOf_[c]));
  }
  std::vector<uint32_t> number(mesh_.positions.size(), kNone);
  for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    uint32_t& n = number[sets.find(firstOf(f))];
    if (n == kNone) {
      n = static_cast<uint32_t>(componentClosed_.size());
      componentClosed_.push_back(true);
    }
    component_.push_back(n);
  }
  for (uint32_t e = 0; e < edgeCount(); ++e) {
    work();
    int balance = 0;
    const auto uses = usesOf(e);
    for (const uint32_t c : uses) {
      const uint32_t a = mesh_.corners[c], b = mesh_.corners[next_[c]];
      balance += a < b ? 1 : (a > b ? -1 : 2);
    }
    if (balance != 0) componentClosed_[component_[faceOf_[uses[0]]]] = false;
  }
}

double Topology::dihedralAngle(uint32_t edge) const {
  const uint32_t c = usesOf(edge)[0];
  if (twin_[c] == kNone) return 0;
  const Vec3 n = mesh_.normal(faceOf_[c]), o = mesh_.normal(faceOf_[twin_[c]]);
  const double angle = atan2Deg(length(cross(n, o)), dot(n, o));
  // Along the half-edge the first face is on the left: the turn to the other normal is to the right
  // of it at a convex edge.
  const Vec3 along = mesh_.at(next_[c]) - mesh_.at(c);
  return dot(cross(n, o), along) >= 0 ? angle : -angle;
}

}  // namespace gable
