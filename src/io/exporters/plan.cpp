// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sizes are summed from the first prototype to the last (what an instance shows comes before what
// holds it), uses are counted from the last to the first. Sums are doubles, which neither wrap
// round nor stop: a scene may stand for more leaves than can be written.
#include "io/exporters/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/hash.h"
#include "material/library.h"
#include "math/box.h"

namespace gable {
namespace {

// What a node costs: its text, and the draw call of a viewer weighed as text.
constexpr double kNodeBytes = 400;
// Smaller prototypes are merged wherever they stand.
constexpr double kTinyBytes = 2048;
// Leaves with meshes from this size on get nodes of their own when the mesh occurs twice.
constexpr double kAloneBytes = 8192;
// Where nodes are short, roots of one name with less of their own are one node for each cell of a
// grid, in metres.
constexpr double kSmallRoot = 4096, kGroupCell = 512;
// Of one unit; they are a list in memory.
constexpr double kMostChildren = 2e7;
// Nodes that are kept for the cells of wide units, as a share of all.
constexpr double kForCells = 1.0 / 32;
// What a bound on nodes may add to a file.
constexpr double kMostMerged = 1024.0 * 1024 * 1024;

double bytesOf(const Mesh& m) {
  double triangles = 0;
  for (size_t f = 0; f < m.faces.size(); ++f) {
    for (const MeshLoop& l : m.loopsOf(f)) triangles += l.cornerCount;
  }
  return 28.0 * static_cast<double>(m.corners.size()) + 6 * triangles;
}

bool isLarge(double bytes) { return bytes >= kAloneBytes; }

uint64_t aloneKey(const Leaf& l) { return static_cast<uint64_t>(l.mesh) << 32 | l.materials; }

// What an instance shows comes before what holds it, so children are compared by number. Of those
// with one hash and unlike content all but the first stay by themselves.
class EqualPrototypes {
 public:
  explicit EqualPrototypes(const Scene& scene) : scene_(scene) {}

  std::vector<uint32_t> find() {
    std::unordered_map<uint64_t, uint32_t> first;
    for (uint32_t p = 0; p < scene_.prototypes.size(); ++p) {
      const auto [at, fresh] = first.try_emplace(hashOf(p), p);
      same_.push_back(!fresh && isLike(at->second, p) ? at->second : p);
    }
    return std::move(same_);
  }

 private:
  uint32_t shownBy(const Instance& i) const { return same_[i.prototype]; }

  uint64_t hashOf(uint32_t prototype) const {
    const Prototype& p = scene_.prototypes[prototype];
    uint64_t h = hashCombine(p.leafCount, p.instanceCount);
    const auto add = [&](const Vec3& v) {
      for (size_t i = 0; i < 3; ++i) h = hashCombine(h, hashDouble(v[i]));
    };
    const auto addFrame = [&](const Frame& f) {
      add(f.origin);
      if (!f.turned) return;
      add(f.x);
      add(f.y);
    };
    for (uint32_t i = 0; i < p.leafCount; ++i) {
      work();
      const Leaf& l = scene_.leaves[p.firstLeaf + i];
      h = hashCombine(h, uint64_t{l.mesh} << 32 | l.materials);
      addFrame(l.frame);
      add(l.scale);
    }
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      work();
      const Instance& in = scene_.instances[p.firstInstance + i];
      h = hashCombine(h, uint64_t{shownBy(in)} << 32 | in.leavesBefore);
      addFrame(in.frame);
    }
    return h;
  }

  bool isLike(uint32_t a, uint32_t b) const {
    const Prototype &p = scene_.prototypes[a], &q = scene_.prototypes[b];
    if (p.leafCount != q.leafCount || p.instanceCount != q.instanceCount) return false;
    const auto leaf = [](const Leaf& m, const Leaf& n) {
      return m.mesh == n.mesh && m.materials == n.materials && m.scale == n.scale &&
             m.frame == n.frame;
    };
    const auto instance = [&](const Instance& m, const Instance& n) {
      return shownBy(m) == shownBy(n) && m.leavesBefore == n.leavesBefore && m.frame == n.frame;
    };
    const auto leaves = scene_.leaves.begin();
    const auto instances = scene_.instances.begin();
    return std::equal(leaves + p.firstLeaf, leaves + p.firstLeaf + p.leafCount,
                      leaves + q.firstLeaf, leaf) &&
           std::equal(instances + p.firstInstance, instances + p.firstInstance + p.instanceCount,
                      instances + q.firstInstance, instance);
  }

  const Scene& scene_;
  std::vector<uint32_t> same_;
};

/// Of a pass through what a prototype holds.
uint64_t workOf(const Prototype& p) { return uint64_t{p.leafCount} + p.instanceCount + 1; }

}  // namespace

std::vector<uint32_t> firstOfEqual(const Scene& scene) { return EqualPrototypes(scene).find(); }

Box3 boundsAt(const Box3& mesh, const Frame& at, const Vec3& scale) {
  if (mesh.empty()) return mesh;
  const Vec3 middle = at.point(scaled((mesh.min + mesh.max) * 0.5, scale));
  const Vec3 half = scaled((mesh.max - mesh.min) * 0.5, scale);
  Vec3 reach;
  for (size_t i = 0; i < 3; ++i) {
    reach[i] =
        std::fabs(at.x[i] * half.x) + std::fabs(at.y[i] * half.y) + std::fabs(at.z[i] * half.z);
  }
  Box3 box;
  box.include(middle - reach);
  box.include(middle + reach);
  return box;
}

ScenePlan::ScenePlan(const Scene& scene, const PlanOptions& options)
    : scene_(scene),
      share_(options.share),
      whole_(options.share && options.whole),
      groupOf_(scene.roots.size(), kNone) {
  findEqual();
  measureMeshes();
  if (share_ && !whole_) findAlone();
  measure();
  const auto shown = std::count_if(scene.roots.begin(), scene.roots.end(),
                                   [&](const Root& r) { return bytes_[shownBy(r.instance)] > 0; });
  const auto most = static_cast<double>(options.mostNodes);
  if (!share_ || (most > 0 && static_cast<double>(shown) > most)) joinRoots();
  plan(kTinyBytes);
  if (share_ && most > 0 && cost_.nodes > most && groups_.empty()) gatherSmallRoots();
  if (share_ && most > 0 && cost_.nodes > most) {
    fit(options.widest > 0 ? most * (1 - kForCells) : most);
  }
  measureContents();
  makeUnits();
  if (share_ && options.widest > 0) cutWideUnits(options.widest, most);
}

void ScenePlan::findEqual() {
  if (share_) {
    same_ = firstOfEqual(scene_);
  } else {
    same_.resize(scene_.prototypes.size());
    std::iota(same_.begin(), same_.end(), 0);
  }
}

void ScenePlan::measureMeshes() {
  for (const MeshRef& m : scene_.meshes) {
    work(m->faces.size() + 1);
    meshBytes_.push_back(bytesOf(*m));
  }
}

// Sorted, one of each key that occurs at least twice.
void ScenePlan::findAlone() {
  if (std::none_of(meshBytes_.begin(), meshBytes_.end(), isLarge)) return;
  for (const Leaf& l : scene_.leaves) {
    work();
    if (isLarge(meshBytes_[l.mesh])) alone_.push_back(aloneKey(l));
  }
  std::sort(alone_.begin(), alone_.end());
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

void ScenePlan::measure() {
  firstLarge_.push_back(0);
  for (const Prototype& p : scene_.prototypes) {
    work(workOf(p));
    double bytes = 0;
    for (uint32_t i = 0; i < p.leafCount; ++i) {
      const Leaf& l = scene_.leaves[p.firstLeaf + i];
      bytes += meshBytes_[l.mesh];
      if (standsAlone(l)) largeLeaves_.push_back(p.firstLeaf + i);
    }
    ownBytes_.push_back(bytes);
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      bytes += bytes_[shownBy(scene_.instances[p.firstInstance + i])];
    }
    bytes_.push_back(bytes);
    firstLarge_.push_back(static_cast<uint32_t>(largeLeaves_.size()));
  }
  placements_.assign(scene_.prototypes.size(), 0);
  for (const Root& r : scene_.roots) ++placements_[shownBy(r.instance)];
  for (size_t p = placements_.size(); p-- > 0;) {
    if (placements_[p] == 0) continue;
    const Prototype& prototype = scene_.prototypes[p];
    work(workOf(prototype));
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      placements_[shownBy(scene_.instances[prototype.firstInstance + i])] += placements_[p];
    }
  }
}

void ScenePlan::joinRoots() {
  joined_ = true;
  groups_.assign(1, {});
  groupOf_.assign(scene_.roots.size(), 0);
  for (uint32_t r = 0; r < scene_.roots.size(); ++r) groups_[0].roots.push_back(r);
  findHome(groups_[0]);
}

// A kerb, a path, the paint of a crossing: there are thousands, and a node for each saves nothing,
// while it takes the place of one that shows a tree once more.
void ScenePlan::gatherSmallRoots() {
  const auto cellOf = [](double v) { return std::floor(std::clamp(v, -1e12, 1e12) / kGroupCell); };
  std::map<std::tuple<std::string, double, double>, std::vector<uint32_t>> found;
  for (uint32_t r = 0; r < scene_.roots.size(); ++r) {
    work();
    const Root& root = scene_.roots[r];
    const uint32_t p = shownBy(root.instance);
    if (bytes_[p] == 0 || use_[p] != Use::Merged || within_[p].bytes > kSmallRoot) continue;
    const Vec3& o = root.instance.frame.origin;
    const std::string name =
        root.name < scene_.names.size() ? scene_.names[root.name] : std::string();
    found[{name, cellOf(o.x), cellOf(o.z)}].push_back(r);
  }
  for (auto& [key, roots] : found) {
    if (roots.size() < 2) continue;
    for (const uint32_t r : roots) groupOf_[r] = static_cast<uint32_t>(groups_.size());
    groups_.push_back({std::move(roots), {}});
    findHome(groups_.back());
  }
  plan(kTinyBytes);
}

// The middle of where roots lie, in whole metres: a node's text gives it exactly.
void ScenePlan::findHome(Group& group) const {
  constexpr double kFarthest = 1e9;
  Box3 places;
  for (const uint32_t r : group.roots) {
    const Vec3& o = scene_.roots[r].instance.frame.origin;
    if (std::fabs(o.x) < kFarthest && std::fabs(o.y) < kFarthest && std::fabs(o.z) < kFarthest) {
      places.include(o);
    }
  }
  if (places.empty()) return;
  for (size_t i = 0; i < 3; ++i) {
    group.home[i] = std::floor((places.min[i] + places.max[i]) / 2);
  }
}

void ScenePlan::plan(double smallest, const PartlyMerged& more) {
  smallest_ = smallest;
  more_ = more;
  // The more has to be merged, the more a node is worth.
  nodeBytes_ = kNodeBytes * smallest / kTinyBytes;
  countNodes();
  decide();
  weigh();
}

// True where writing all below a prototype again costs less than the nodes for each placement.
bool ScenePlan::isSolid(size_t prototype, double placements) const {
  const double nodes = nodes_[prototype];
  return nodes == 0 || bytes_[prototype] <= placements * nodes * nodeBytes_;
}

bool ScenePlan::isTiny(size_t prototype) const {
  if (std::find(kept_.begin(), kept_.end(), prototype) != kept_.end()) return false;
  const double bytes = bytes_[prototype];
  return bytes <= smallest_ || (bytes <= more_.smallest && prototype <= more_.last);
}

// True where all but the nodes below a prototype is small: a node of its own would save little.
bool ScenePlan::isThin(size_t prototype) const { return openBytes_[prototype] <= smallest_; }

// Nodes below each prototype, and bytes without those, when what is small or thin is merged, and
// what will be solid is.
void ScenePlan::countNodes() {
  nodes_.clear();
  openBytes_.clear();
  for (size_t p = 0; p < scene_.prototypes.size(); ++p) {
    const Cost alone = aloneIn(p);
    double nodes = alone.nodes, bytes = ownBytes_[p] - alone.bytes;
    const Prototype& prototype = scene_.prototypes[p];
    work(workOf(prototype));
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      const uint32_t child = shownBy(scene_.instances[prototype.firstInstance + i]);
      if (isTiny(child)) {
        bytes += bytes_[child];
      } else if (isSolid(child, placements_[child])) {
        nodes += 1;
      } else {
        nodes += nodes_[child] + (isThin(child) ? 0 : 1);
        bytes += isThin(child) ? openBytes_[child] : 0;
      }
    }
    nodes_.push_back(nodes);
    openBytes_.push_back(bytes);
  }
}

void ScenePlan::decide() {
  const size_t count = scene_.prototypes.size();
  use_.assign(count, Use::None);
  // References from units, and placements in the flattened scene.
  std::vector<double> references(count), placements(count), roots(count);
  for (uint32_t r = 0; r < scene_.roots.size(); ++r) {
    const uint32_t p = shownBy(scene_.roots[r].instance);
    ++references[p];
    ++placements[p];
    if (groupOf_[r] == kNone) ++roots[p];
  }
  for (size_t p = count; p-- > 0;) {
    if (references[p] == 0) continue;
    work(workOf(scene_.prototypes[p]));
    const bool tiny = isTiny(p) && roots[p] < 2;
    if (!share_ || whole_) {
      use_[p] = Use::Solid;
    } else if (references[p] == 1 || tiny) {
      use_[p] = Use::Merged;
    } else {
      // What lies below a group is a group of its own.
      const bool merged = grouped_ || (isThin(p) && roots[p] < 2);
      use_[p] = isSolid(p, placements[p]) ? Use::Solid : merged ? Use::Merged : Use::Open;
    }
    if (use_[p] == Use::Solid) continue;
    const Prototype& prototype = scene_.prototypes[p];
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      const uint32_t child = shownBy(scene_.instances[prototype.firstInstance + i]);
      if (bytes_[child] == 0) continue;
      references[child] += use_[p] == Use::Merged ? references[p] : 1;
      placements[child] += placements[p];
    }
  }
}

// What the leaves of a prototype that stand alone take and save.
ScenePlan::Cost ScenePlan::aloneIn(size_t prototype) const {
  Cost c;
  for (uint32_t i = firstLarge_[prototype]; i < firstLarge_[prototype + 1]; ++i) {
    const double bytes = meshBytes_[scene_.leaves[largeLeaves_[i]].mesh];
    if (bytes < smallest_) continue;
    ++c.nodes;
    c.bytes += bytes;
  }
  return c;
}

// What the file would take: nodes, and bytes of geometry but for meshes that stand alone.
void ScenePlan::weigh() {
  within_.assign(scene_.prototypes.size(), {});
  cost_ = {static_cast<double>(groups_.size()), 0};
  const auto add = [&](Cost& to, uint32_t child) {
    if (bytes_[child] == 0) return;
    const Cost& inner = within_[child];
    if (use_[child] == Use::Merged) {
      to.nodes += inner.nodes;
      to.bytes += inner.bytes;
    } else {
      to.nodes += 1 + (use_[child] == Use::Solid ? 0 : inner.nodes);
    }
  };
  for (size_t p = 0; p < within_.size(); ++p) {
    if (use_[p] == Use::None) continue;
    const Prototype& prototype = scene_.prototypes[p];
    work(workOf(prototype));
    const Cost alone = aloneIn(p);
    within_[p] = {alone.nodes, ownBytes_[p] - alone.bytes};
    for (uint32_t i = 0; i < prototype.instanceCount && use_[p] != Use::Solid; ++i) {
      add(within_[p], shownBy(scene_.instances[prototype.firstInstance + i]));
    }
    if (use_[p] == Use::Solid) within_[p] = {0, bytes_[p]};
    if (use_[p] != Use::Merged) cost_.bytes += within_[p].bytes;
  }
  if (grouped_) {
    cost_.nodes = 1 + static_cast<double>(std::count(use_.begin(), use_.end(), Use::Solid)) +
                  static_cast<double>(std::count_if(alone_.begin(), alone_.end(), [&](uint64_t k) {
                    return meshBytes_[k >> 32] >= smallest_;
                  }));
    return;
  }
  for (uint32_t r = 0; r < scene_.roots.size(); ++r) {
    const uint32_t p = shownBy(scene_.roots[r].instance);
    // A root that is merged elsewhere is a unit of its own all the same.
    if (groupOf_[r] == kNone && bytes_[p] > 0 && use_[p] == Use::Merged) ++cost_.nodes;
    add(cost_, p);
  }
}

// Merges more until the nodes are few enough: what saves least comes first. Each step takes one in
// fifty more bytes; the first that is enough is searched by halves. Thousands of windows may have
// nearly one size, so of those in the last step only so many are merged as has to be.
void ScenePlan::merge(double mostNodes) {
  kept_.clear();
  const double largest = std::max(*std::max_element(bytes_.begin(), bytes_.end()),
                                  *std::max_element(meshBytes_.begin(), meshBytes_.end()));
  std::vector<double> steps{kTinyBytes};
  while (steps.back() < largest) steps.push_back(steps.back() * 1.02);
  // Of what is as large as the largest, leaves still stand alone.
  steps.push_back(steps.back() * 1.02);
  size_t low = 0, high = steps.size() - 1;
  while (low + 1 < high) {
    const size_t middle = (low + high) / 2;
    plan(steps[middle]);
    (cost_.nodes <= mostNodes ? high : low) = middle;
  }
  std::vector<size_t> last;
  for (size_t p = 0; p < bytes_.size(); ++p) {
    if (bytes_[p] > steps[low] && bytes_[p] <= steps[high]) last.push_back(p);
  }
  size_t few = 0, enough = last.size();
  while (few < enough) {
    const size_t middle = (few + enough) / 2;
    plan(steps[low], {steps[high], last[middle]});
    if (cost_.nodes <= mostNodes)
      enough = middle;
    else
      few = middle + 1;
  }
  if (enough < last.size()) plan(steps[low], {steps[high], last[enough]});
  if (enough == last.size() || cost_.nodes > mostNodes) plan(steps[high]);
  if (!grouped_) keepMore(mostNodes);
}

// One that stands thousands of times frees too many nodes: others that save most are kept then.
void ScenePlan::keepMore(double mostNodes) {
  constexpr size_t kFewLeft = 16, kTries = 12;
  const double room = mostNodes - cost_.nodes;
  if (room < mostNodes / kFewLeft) return;
  std::vector<std::pair<double, size_t>> tried;
  for (size_t p = 0; p < bytes_.size(); ++p) {
    if (use_[p] != Use::Merged || !isTiny(p) || bytes_[p] <= kTinyBytes) continue;
    if (placements_[p] <= room) tried.emplace_back((1 - placements_[p]) * bytes_[p], p);
  }
  std::sort(tried.begin(), tried.end());
  tried.resize(std::min(kTries, tried.size()));
  double least = cost_.bytes;
  for (const auto& [unsaved, p] : tried) {
    kept_.push_back(p);
    plan(smallest_, more_);
    const bool saves = cost_.nodes <= mostNodes && cost_.bytes < least;
    least = saves ? cost_.bytes : least;
    if (!saves) kept_.pop_back();
  }
  plan(smallest_, more_);
}

// Where merging would make the file much larger, equal children are to be one node: then all of
// them are children of one unit, which has as many nodes below it as there are other units.
void ScenePlan::fit(double mostNodes) {
  const Cost before = cost_;
  merge(mostNodes);
  if (cost_.bytes <= before.bytes + kMostMerged) return;
  grouped_ = true;
  joinRoots();
  plan(kTinyBytes);
  if (cost_.nodes > mostNodes) merge(mostNodes);
}

// Of an open unit, leaves that stand alone left out.
double ScenePlan::childCount(const Unit& u) const {
  if (u.group == kNone) return childCount_[u.prototype];
  double count = 0;
  for (const uint32_t r : groups_[u.group].roots) {
    const uint32_t p = shownBy(scene_.roots[r].instance);
    count += use_[p] == Use::Merged ? childCount_[p] : 1;
  }
  return count;
}

void ScenePlan::makeUnits() {
  prototypeUnit_.assign(scene_.prototypes.size(), kNone);
  // A unit's children make new units at the end of the list, so the list is its own queue.
  size_t done = 0;
  const auto addRoot = [&](uint32_t unit, uint32_t root, const Frame& frame) {
    roots_.push_back({unit, root, frame});
    for (; done < units_.size(); ++done) {
      if (units_[done].leaf != kNone || units_[done].solid) continue;
      tooLarge_ = tooLarge_ || childCount(units_[done]) > kMostChildren;
      if (tooLarge_) continue;
      std::vector<PlannedChild> children = childrenOf(units_[done]), again;
      // What is shown for the first time comes first: programs that make a mesh where a node shows
      // it are sooner done while they have few nodes.
      size_t firsts = 0;
      for (PlannedChild& c : children) {
        const size_t known = units_.size();
        c.unit = c.leaf == PlannedChild::kNone ? unitOfPrototype(c.unit) : unitOfLeaf(c.leaf);
        if (units_.size() > known)
          children[firsts++] = c;
        else
          again.push_back(c);
      }
      std::copy(again.begin(), again.end(), children.begin() + static_cast<std::ptrdiff_t>(firsts));
      units_[done].children = std::move(children);
    }
  };
  const auto addGroup = [&](uint32_t group, uint32_t root) {
    const auto unit = static_cast<uint32_t>(units_.size());
    units_.push_back({kNone, kNone, !share_, {}, kNone, group});
    addRoot(unit, root, Frame::moved(groups_[group].home));
  };
  if (joined_) {
    addGroup(0, PlannedRoot::kAll);
    return;
  }
  for (uint32_t r = 0; r < scene_.roots.size(); ++r) {
    const Instance& root = scene_.roots[r].instance;
    const uint32_t group = groupOf_[r];
    if (group == kNone) {
      addRoot(unitOfPrototype(shownBy(root)), r, root.frame);
    } else if (groups_[group].roots.front() == r) {
      addGroup(group, r);
    }
  }
}

Box3 ScenePlan::boundsOf(const PlannedLeaf& p, const UnitContent& content) {
  const Leaf& leaf = scene_.leaves[p.leaf];
  std::optional<Box3>& known = meshBounds_[leaf.mesh];
  if (!known) known = scene_.meshes[leaf.mesh]->bounds();
  return boundsAt(*known, content.placements[p.placement] * leaf.frame, leaf.scale);
}

void ScenePlan::cutWideUnits(double widest, double mostNodes) {
  std::vector<uint32_t> shown(units_.size());
  for (const PlannedRoot& r : roots_) ++shown[r.unit];
  for (const Unit& u : units_) {
    for (const PlannedChild& c : u.children) ++shown[c.unit];
  }
  meshBounds_.resize(scene_.meshes.size());
  const size_t before = units_.size();
  for (const PlannedRoot& r : roots_) {
    constexpr double kMostLeaves = 1e7;
    if (shown[r.unit] > 1 || contentSize(r.unit) > kMostLeaves) continue;
    const double room = mostNodes - cost_.nodes - static_cast<double>(units_.size() - before);
    cut(r.unit, widest,
        mostNodes == 0 ? units_.size() + (size_t{1} << 20)
        : room > 0     ? static_cast<size_t>(room)
                       : 0);
  }
}

// Leaves that are a small share of a cell go to the cell in which their middle lies, if that saves
// more than its meshes take: narrow meshes save four bytes a vertex.
void ScenePlan::cut(uint32_t unit, double widest, size_t mostCells) {
  constexpr double kLargeLeaf = 0.13, kPrimitiveBytes = 700, kBytesSaved = 1.0 / 8;
  struct CellOf {
    double bytes = 0;
    std::set<uint32_t> materials;
    uint32_t content = kNone, placement = kNone;
  };
  UnitContent all;
  collect(unit, all);
  std::vector<Box3> boxes;
  Box3 reach;
  for (const PlannedLeaf& p : all.leaves) {
    work();
    boxes.push_back(boundsOf(p, all));
    reach.include(boxes.back());
  }
  const auto fits = [](const Box3& b, double most) {
    const Vec3 s = b.size();
    return !b.empty() && s.x <= most && s.y <= most && s.z <= most;
  };
  constexpr double kFarthest = 1e6;
  if (fits(reach, widest) || !fits(reach, kFarthest)) return;
  const double side = widest * (1 - 1.1 * kLargeLeaf);
  const auto cellOf = [&](const Box3& b) {
    std::array<int64_t, 3> at{};
    for (size_t i = 0; i < 3; ++i) {
      at[i] = static_cast<int64_t>(std::floor((b.min[i] + b.max[i]) / 2 / side));
    }
    return at;
  };
  std::map<std::array<int64_t, 3>, CellOf> cells;
  for (size_t i = 0; i < boxes.size(); ++i) {
    work();
    if (!fits(boxes[i], kLargeLeaf * widest)) continue;
    const Leaf& leaf = scene_.leaves[all.leaves[i].leaf];
    CellOf& c = cells[cellOf(boxes[i])];
    c.bytes += meshBytes_[leaf.mesh] * kBytesSaved;
    c.materials.insert(leaf.materials);
  }
  const auto pays = [](const auto& c) {
    return c.second.bytes > kPrimitiveBytes * static_cast<double>(c.second.materials.size());
  };
  const auto count = static_cast<size_t>(std::count_if(cells.begin(), cells.end(), pays));
  if (count == 0 || count > mostCells) return;
  for (auto& c : cells) {
    if (!pays(c)) continue;
    c.second.content = static_cast<uint32_t>(contents_.size());
    contents_.emplace_back();
    units_[unit].children.push_back({static_cast<uint32_t>(units_.size()), {}, {1, 1, 1}, kNone});
    Unit cell;
    cell.prototype = units_[unit].prototype;
    cell.content = c.second.content;
    units_.push_back(cell);
  }
  const auto rest = static_cast<uint32_t>(contents_.size());
  units_[unit].content = rest;
  contents_.emplace_back();
  // A placement serves neighbouring leaves.
  std::vector<std::pair<uint32_t, uint32_t>> last(contents_.size(), {kNone, kNone});
  for (size_t i = 0; i < boxes.size(); ++i) {
    const PlannedLeaf& p = all.leaves[i];
    uint32_t to = rest;
    if (fits(boxes[i], kLargeLeaf * widest)) {
      const uint32_t content = cells[cellOf(boxes[i])].content;
      if (content != kNone) to = content;
    }
    UnitContent& content = contents_[to];
    if (last[to].first != p.placement) {
      last[to] = {p.placement, static_cast<uint32_t>(content.placements.size())};
      content.placements.push_back(all.placements[p.placement]);
    }
    content.leaves.push_back({p.leaf, last[to].second});
  }
}

std::vector<PlannedChild> ScenePlan::childrenOf(const Unit& unit) const {
  std::vector<PlannedChild> children;
  if (unit.group != kNone)
    walkGroup(groups_[unit.group], unit.solid, nullptr, &children);
  else
    walk(unit.prototype, Frame{}, false, nullptr, &children);
  return children;
}

void ScenePlan::measureContents() {
  for (const Prototype& p : scene_.prototypes) {
    work(workOf(p));
    double solid = 1.0 + p.leafCount, open = solid, children = 0;
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      const uint32_t child = shownBy(scene_.instances[p.firstInstance + i]);
      if (bytes_[child] == 0) continue;
      solid += solidSize_[child];
      open += use_[child] == Use::Merged ? openSize_[child] : 1;
      children += use_[child] == Use::Merged ? childCount_[child] : 1;
    }
    childCount_.push_back(children);
    solidSize_.push_back(solid);
    openSize_.push_back(open);
  }
}

// A node that scales its mesh scales what counts in metres too; a little of that is not seen.
bool ScenePlan::changesLaid(const Leaf& leaf) const {
  constexpr double kMost = 1.5;
  const auto kept = [](double s) { return std::fabs(s) < kMost && std::fabs(s) * kMost > 1; };
  if (kept(leaf.scale.x) && kept(leaf.scale.y) && kept(leaf.scale.z)) return false;
  if (leaf.materials >= scene_.materialLists.size()) return false;
  const std::vector<uint32_t>& list = scene_.materialLists[leaf.materials];
  return std::any_of(list.begin(), list.end(), [&](uint32_t m) {
    return m < scene_.materials.size() && isLaid(scene_.materials[m]);
  });
}

bool ScenePlan::standsAlone(const Leaf& leaf) const {
  // Most scenes have none: leaves, which fill memory, are not even looked at.
  if (alone_.empty()) return false;
  // A node must not flatten its mesh, and its scale is written with nine digits behind the point.
  constexpr double kThinnest = 1e-5;
  const bool flat = std::fabs(leaf.scale.x) < kThinnest || std::fabs(leaf.scale.y) < kThinnest ||
                    std::fabs(leaf.scale.z) < kThinnest;
  return !flat && !changesLaid(leaf) && meshBytes_[leaf.mesh] >= std::max(kAloneBytes, smallest_) &&
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
    const uint32_t shown = shownBy(in);
    if (bytes_[shown] == 0) return false;
    if (solid || use_[shown] == Use::Merged) {
      open(at, level);
      return true;
    }
    if (children) children->push_back({shown, at, {1, 1, 1}, PlannedChild::kNone});
    return false;
  };
  open(frame, 0);
  gable::walk(scene_, scene_.prototypes[index], frame, addLeaf, enter);
}

void ScenePlan::walkGroup(const Group& group, bool solid, UnitContent* content,
                          std::vector<PlannedChild>* children) const {
  const Frame inward = Frame::moved(-group.home);
  for (const uint32_t r : group.roots) {
    const Instance& root = scene_.roots[r].instance;
    const uint32_t p = shownBy(root);
    if (bytes_[p] == 0) continue;
    const Frame at = inward * root.frame;
    if (solid || use_[p] == Use::Merged)
      walk(p, at, solid, content, children);
    else if (children)
      children->push_back({p, at, {1, 1, 1}, PlannedChild::kNone});
  }
}

double ScenePlan::contentSize(uint32_t unit) const {
  const Unit& u = units_[unit];
  if (u.content != kNone) {
    const UnitContent& c = contents_[u.content];
    return static_cast<double>(c.leaves.size() + c.placements.size());
  }
  if (u.group != kNone) {
    double size = 0;
    for (const uint32_t r : groups_[u.group].roots) {
      const uint32_t p = shownBy(scene_.roots[r].instance);
      size += u.solid ? solidSize_[p] : use_[p] == Use::Merged ? openSize_[p] : 1;
    }
    return size;
  }
  return u.prototype == kNone ? 1 : u.solid ? solidSize_[u.prototype] : openSize_[u.prototype];
}

void ScenePlan::collect(uint32_t unit, UnitContent& out) const {
  out.placements.clear();
  out.leaves.clear();
  const Unit& u = units_[unit];
  if (u.content != kNone) {
    out = contents_[u.content];
  } else if (u.group != kNone) {
    walkGroup(groups_[u.group], u.solid, &out, nullptr);
  } else if (u.prototype != kNone) {
    walk(u.prototype, Frame{}, u.solid, &out, nullptr);
  } else {
    // The leaf's frame and scale belong to the nodes that show it.
    out.placements.push_back(Frame{});
    out.leaves.push_back({u.leaf, kNone});
  }
}

}  // namespace gable
