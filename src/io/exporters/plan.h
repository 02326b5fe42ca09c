// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Plan: how the prototypes of a scene become meshes and nodes of a format that has both.
//
// A unit is what becomes one mesh: leaves merged into one frame, and children that are shown by
// nodes of their own. Units are
//   - the content of a root, when no other root shows the same prototype;
//   - a prototype that is placed several times, when it is not small;
//   - a large mesh (a tree, a statue) that several leaves place;
//   - the content of many roots: of small ones of one name that stand near each other, when nodes
//     are short; of all roots, when there are too many of them, or nothing is shared.
// Prototypes of equal content are one, whatever made them. Where roots are to be whole, the content
// of each is one unit and there are no others.
// A prototype placed once is merged into the unit around it. A prototype placed several times takes
// its own children in when writing them again costs less than the nodes for each placement; one
// that has little beside such children is merged, so that these are children of what is around it.
//
// Where meshes are to stay small in space, what is merged into a wide unit that is shown once is
// cut into the cells of a grid: units of their own, with nodes below that of the unit.
//
// A bound on nodes decides what is small: a node that shows a prototype of b bytes once more saves
// b bytes, so those that save least are merged first.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace gable {

struct PlannedLeaf {
  /// Index into Scene::leaves.
  uint32_t leaf = 0;
  /// Index into UnitContent::placements: the unit's frame * placement * leaf.frame.
  uint32_t placement = 0;
};

struct PlannedChild {
  static constexpr uint32_t kNone = 0xffffffff;
  uint32_t unit = 0;
  Frame frame;
  Vec3 scale{1, 1, 1};
  /// The leaf that the child stands for, or kNone.
  uint32_t leaf = kNone;
};

struct PlannedRoot {
  /// Stands for all roots.
  static constexpr uint32_t kAll = 0xffffffff;
  uint32_t unit = 0;
  /// Index into Scene::roots, of several the first; or kAll.
  uint32_t root = kAll;
  Frame frame;
};

struct PlanOptions {
  /// Equal parts are shown by nodes; else everything is one unit.
  bool share = true;
  /// So many nodes at most; 0 for any number.
  uint64_t mostNodes = 0;
  /// Units that are wider, in metres, are cut into cells; 0 for none.
  double widest = 0;
  /// The content of each root is one unit, which equal roots share.
  bool whole = false;
};

/// By prototype: the first of equal content, whatever made them. Linear in the scene.
std::vector<uint32_t> firstOfEqual(const Scene& scene);

/// The box of a placed mesh, no smaller than the mesh.
Box3 boundsAt(const Box3& mesh, const Frame& at, const Vec3& scale);

struct UnitContent {
  std::vector<Frame> placements;
  std::vector<PlannedLeaf> leaves;
};

class ScenePlan {
 public:
  static constexpr uint32_t kNone = 0xffffffff;
  struct Unit {
    /// One of the two; neither for a unit of several roots.
    uint32_t prototype = kNone;
    uint32_t leaf = kNone;
    /// True when everything below is merged in.
    bool solid = false;
    std::vector<PlannedChild> children;
    /// Of a unit that was cut, and of its cells: what is left, by number.
    uint32_t content = kNone;
    /// Of several roots: their group.
    uint32_t group = kNone;
  };

  /// Linear in the scene, instances of merged prototypes expanded.
  ScenePlan(const Scene& scene, const PlanOptions& options);

  /// True where the bound on nodes holds only if one node shows all equal children of a unit.
  bool grouped() const { return grouped_; }
  /// True where a unit would have more children than there is room for: it has none.
  bool tooLarge() const { return tooLarge_; }
  /// In the order in which nodes first show them.
  const std::vector<Unit>& units() const { return units_; }
  /// In the order of the scene's roots; one that stands for several of them where they are joined.
  const std::vector<PlannedRoot>& roots() const { return roots_; }
  /// The leaves to merge, in path order. Replaces `out`.
  void collect(uint32_t unit, UnitContent& out) const;
  /// How many leaves and placements that would be.
  double contentSize(uint32_t unit) const;

 private:
  enum class Use : uint8_t { None, Merged, Open, Solid };
  // Roots that are parts of one unit, which lies about `home`.
  struct Group {
    std::vector<uint32_t> roots;
    Vec3 home;
  };
  struct Cost {
    double nodes = 0, bytes = 0;
  };
  void findEqual();
  /// The prototype that stands for all of equal content.
  uint32_t shownBy(const Instance& i) const { return same_[i.prototype]; }
  void measureMeshes();
  void findAlone();
  void measure();
  void joinRoots();
  void gatherSmallRoots();
  void findHome(Group& group) const;
  // Up to the prototype `last` those up to so many bytes are merged as well.
  struct PartlyMerged {
    double smallest = 0;
    size_t last = 0;
  };
  void plan(double smallest, const PartlyMerged& more = {0, 0});
  bool isTiny(size_t prototype) const;
  bool isSolid(size_t prototype, double placements) const;
  bool isThin(size_t prototype) const;
  void countNodes();
  void decide();
  Cost aloneIn(size_t prototype) const;
  void weigh();
  void merge(double mostNodes);
  void keepMore(double mostNodes);
  void fit(double mostNodes);
  void measureContents();
  double childCount(const Unit& u) const;
  void makeUnits();
  void cutWideUnits(double widest, double mostNodes);
  void cut(uint32_t unit, double widest, size_t mostCells);
  Box3 boundsOf(const PlannedLeaf& leaf, const UnitContent& content);
  std::vector<PlannedChild> childrenOf(const Unit& unit) const;
  void walk(uint32_t prototype, const Frame& frame, bool solid, UnitContent* content,
            std::vector<PlannedChild>* children) const;
  void walkGroup(const Group& group, bool solid, UnitContent* content,
                 std::vector<PlannedChild>* children) const;
  bool standsAlone(const Leaf& leaf) const;
  bool changesLaid(const Leaf& leaf) const;
  uint32_t unitOfPrototype(uint32_t prototype);
  uint32_t unitOfLeaf(uint32_t leaf);

  const Scene& scene_;
  bool share_, whole_;
  std::vector<Group> groups_;
  /// By root: its group, or kNone.
  std::vector<uint32_t> groupOf_;
  /// Prototypes up to so many bytes are merged wherever they stand.
  double smallest_ = 0;
  PartlyMerged more_;
  /// Not merged for their size.
  std::vector<size_t> kept_;
  /// What a node costs.
  double nodeBytes_ = 0;
  bool grouped_ = false;
  bool tooLarge_ = false;
  /// All roots are one group.
  bool joined_ = false;
  /// By prototype: the first of equal content.
  std::vector<uint32_t> same_;
  Cost cost_;
  /// By prototype: within the unit that it is, or is merged into.
  std::vector<Cost> within_;
  // By mesh: bytes once written. By prototype: bytes when expanded and those of its own leaves,
  // nodes below when open.
  std::vector<double> meshBytes_, bytes_, ownBytes_, nodes_;
  /// By prototype: bytes without those of nodes below.
  std::vector<double> openBytes_;
  /// By prototype: how often it stands in the flattened scene.
  std::vector<double> placements_;
  // Leaves that may stand alone, those of a prototype from firstLarge_ on.
  std::vector<uint32_t> largeLeaves_, firstLarge_;
  // By prototype: leaves and placements when all is merged in, and when only what is merged is.
  std::vector<double> solidSize_, openSize_;
  /// By prototype: units below, when only what is merged is.
  std::vector<double> childCount_;
  // Sorted (mesh, materials) of the leaves that stand alone, and their units.
  std::vector<uint64_t> alone_;
  std::vector<uint32_t> aloneUnit_;
  std::vector<Use> use_;
  std::vector<uint32_t> prototypeUnit_;
  std::vector<Unit> units_;
  std::vector<PlannedRoot> roots_;
  std::vector<UnitContent> contents_;
  /// By mesh, once asked for.
  std::vector<std::optional<Box3>> meshBounds_;
};

}  // namespace gable
