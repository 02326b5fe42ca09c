// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sizes are summed from the first prototype to the last (what an instance shows comes before what
// holds it), uses are counted from the last to the first. Sums are doubles, which neither wrap
// round nor stop: a scene may stand for more leaves than can be written.
#include "io/exporters/plan.h"

#include <algorithm>
#include <cmath>

namespace gable {
namespace {

// What a node costs: its text, and the draw call of a viewer weighed as text.
constexpr double kNodeBytes = 400;
// Smaller prototypes are merged wherever they stand.
constexpr double kTinyBytes = 2048;
// Leaves with meshes from this size on get nodes of their own when the mesh occurs twice.
constexpr double kAloneBytes = 8192;

double bytesOf(const Mesh& m) {
  double triangles = 0;
  for (size_t f = 0; f < m.faces.size(); ++f) {
    for (const MeshLoop& l : m.loopsOf(f)) triangles += l.cornerCount;
  }
  return 28.0 * static_cast<double>(m.corners.size()) + 6 * triangles;
}

uint64_t aloneKey(const Leaf& l) { return static_cast<uint64_t>(l.mesh) << 32 | l.materials; }

}  // namespace

ScenePlan::ScenePlan(const Scene& scene, bool share) : scene_(scene), share_(share) {
  measure();
  decide();
  measureContents();
  prototypeUnit_.assign(scene.prototypes.size(), kNone);
  // A unit's children make new units at the end of the list, so the list is its own queue.
  size_t done = 0;
  for (const Root& root : scene.roots) {
    if (!share_) prototypeUnit_[root.instance.prototype] = kNone;
    rootUnits_.push_back(unitOfPrototype(root.instance.prototype));
    for (; done < units_.size(); ++done) {
      if (units_[done].prototype == kNone || units_[done].solid) continue;
      std::vector<PlannedChild> children;
      walk(units_[done].prototype, Frame{}, false, nullptr, &children);
      for (PlannedChild& c : children) {
        c.unit = c.leaf == PlannedChild::kNone ? unitOfPrototype(c.unit) : unitOfLeaf(c.leaf);
      }
      units_[done].children = std::move(children);
    }
  }
}

void ScenePlan::measure() {
  for (const MeshRef& m : scene_.meshes) meshBytes_.push_back(bytesOf(*m));
  const bool anyLarge = std::any_of(meshBytes_.begin(), meshBytes_.end(),
                                    [](double bytes) { return bytes >= kAloneBytes; });
  if (share_ && anyLarge) {
    for (const Leaf& l : scene_.leaves) {
      if (meshBytes_[l.mesh] >= kAloneBytes) alone_.push_back(aloneKey(l));
    }
    std::sort(alone_.begin(), alone_.end());
    // Keep one of each key that occurs at least twice.
    size_t kept = 0;
    for (size_t i = 0; i < alone_.size();) {
      size_t end = i;
      while (end < alone_.size() && alone_[end] == alone_[i]) ++end;
      if (end - i > 1) alone_[kept++] = alone_[i];
      i = end;
    }
    alone_.resize(kept);
    aloneUnit_.assign(kept, kNone);
  }
  for (const Prototype& p : scene_.prototypes) {
    double bytes = 0, nodes = 0;
    for (uint32_t i = 0; i < p.leafCount; ++i) {
      const Leaf& l = scene_.leaves[p.firstLeaf + i];
      bytes += meshBytes_[l.mesh];
      nodes += standsAlone(l) ? 1 : 0;
    }
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      const uint32_t child = scene_.instances[p.firstInstance + i].prototype;
      bytes += bytes_[child];
      nodes += bytes_[child] <= kTinyBytes ? 0 : 1 + nodes_[child];
    }
    bytes_.push_back(bytes);
    nodes_.push_back(nodes);
  }
}

void ScenePlan::decide() {
  const size_t count = scene_.prototypes.size();
  use_.assign(count, Use::None);
  // References from units, and placements in the flattened scene.
  std::vector<double> references(count), placements(count), roots(count);
  for (const Root& r : scene_.roots) {
    ++references[r.instance.prototype];
    ++placements[r.instance.prototype];
    ++roots[r.instance.prototype];
  }
  for (size_t p = count; p-- > 0;) {
    if (references[p] == 0) continue;
    const bool tiny = bytes_[p] <= kTinyBytes && roots[p] < 2;
    if (!share_) {
      use_[p] = Use::Solid;
    } else if (references[p] == 1 || tiny) {
      use_[p] = Use::Merged;
    } else {
      use_[p] = bytes_[p] <= placements[p] * nodes_[p] * kNodeBytes || nodes_[p] == 0 ? Use::Solid
                                                                                      : Use::Open;
    }
    if (use_[p] == Use::Solid) continue;
    const Prototype& prototype = scene_.prototypes[p];
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      const uint32_t child = scene_.instances[prototype.firstInstance + i].prototype;
      if (bytes_[child] == 0) continue;
      references[child] += use_[p] == Use::Merged ? references[p] : 1;
      placements[child] += placements[p];
    }
  }
}

void ScenePlan::measureContents() {
  for (const Prototype& p : scene_.prototypes) {
    double solid = 1.0 + p.leafCount, open = solid;
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      const uint32_t child = scene_.instances[p.firstInstance + i].prototype;
      if (bytes_[child] == 0) continue;
      solid += solidSize_[child];
      open += use_[child] == Use::Merged ? openSize_[child] : 1;
    }
    solidSize_.push_back(solid);
    openSize_.push_back(open);
  }
}

bool ScenePlan::standsAlone(const Leaf& leaf) const {
  // Most scenes have none: leaves, which fill memory, are not even looked at.
  if (alone_.empty()) return false;
  // A node must not flatten its mesh, and its scale is written with nine digits behind the point.
  constexpr double kThinnest = 1e-5;
  const bool flat = std::fabs(leaf.scale.x) < kThinnest || std::fabs(leaf.scale.y) < kThinnest ||
                    std::fabs(leaf.scale.z) < kThinnest;
  return !flat && meshBytes_[leaf.mesh] >= kAloneBytes &&
         std::binary_search(alone_.begin(), alone_.end(), aloneKey(leaf));
}

uint32_t ScenePlan::unitOfPrototype(uint32_t prototype) {
  // A merged prototype is the content of one root and a unit of its own.
  uint32_t& unit = prototypeUnit_[prototype];
  if (unit == kNone) {
    unit = static_cast<uint32_t>(units_.size());
    units_.push_back({prototype, kNone, use_[prototype] == Use::Solid, {}});
  }
  return unit;
}

uint32_t ScenePlan::unitOfLeaf(uint32_t leaf) {
  const auto at = std::lower_bound(alone_.begin(), alone_.end(), aloneKey(scene_.leaves[leaf]));
  uint32_t& unit = aloneUnit_[static_cast<size_t>(at - alone_.begin())];
  if (unit == kNone) {
    unit = static_cast<uint32_t>(units_.size());
    units_.push_back({kNone, leaf, true, {}});
  }
  return unit;
}

void ScenePlan::walk(uint32_t index, const Frame& frame, bool solid, UnitContent* content,
                     std::vector<PlannedChild>* children) const {
  // By level of the walk.
  std::vector<uint32_t> placement;
  const auto open = [&](const Frame& at, size_t level) {
    placement.resize(level + 1);
    if (!content) return;
    placement[level] = static_cast<uint32_t>(content->placements.size());
    content->placements.push_back(at);
  };
  const auto addLeaf = [&](uint32_t leaf, const Frame& at, size_t level) {
    const Leaf& l = scene_.leaves[leaf];
    if (!solid && standsAlone(l)) {
      if (children) children->push_back({kNone, at * l.frame, l.scale, leaf});
    } else if (content) {
      content->leaves.push_back({leaf, placement[level]});
    }
  };
  const auto enter = [&](const Instance& in, const Frame& at, size_t level) {
    // What shows nothing is passed over, however often it stands here.
    if (bytes_[in.prototype] == 0) return false;
    if (solid || use_[in.prototype] == Use::Merged) {
      open(at, level);
      return true;
    }
    if (children) children->push_back({in.prototype, at, {1, 1, 1}, PlannedChild::kNone});
    return false;
  };
  open(frame, 0);
  gable::walk(scene_, scene_.prototypes[index], frame, addLeaf, enter);
}

double ScenePlan::contentSize(uint32_t unit) const {
  const Unit& u = units_[unit];
  return u.prototype == kNone ? 1 : u.solid ? solidSize_[u.prototype] : openSize_[u.prototype];
}

void ScenePlan::collect(uint32_t unit, UnitContent& out) const {
  out.placements.clear();
  out.leaves.clear();
  const Unit& u = units_[unit];
  if (u.prototype != kNone) {
    walk(u.prototype, Frame{}, u.solid, &out, nullptr);
  } else {
    // The leaf's frame and scale belong to the nodes that show it.
    out.placements.push_back(Frame{});
    out.leaves.push_back({u.leaf, kNone});
  }
}

}  // namespace gable
