// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Plan: how the prototypes of a scene become meshes and nodes of a format that has both.
//
// A unit is what becomes one mesh: leaves merged into one frame, and children that are shown by
// nodes of their own. Units are
//   - the content of a root, when no other root shows the same prototype;
//   - a prototype that is placed several times, when it is not tiny;
//   - a large mesh (a tree, a statue) that several leaves place.
// A prototype placed once is merged into the unit around it. A prototype placed several times takes
// its own children in when writing them again costs less than the nodes for each placement.
#pragma once

#include <cstdint>
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

struct UnitContent {
  std::vector<Frame> placements;
  std::vector<PlannedLeaf> leaves;
};

class ScenePlan {
 public:
  static constexpr uint32_t kNone = 0xffffffff;
  struct Unit {
    /// One of the two.
    uint32_t prototype = kNone;
    uint32_t leaf = kNone;
    /// True when everything below is merged in.
    bool solid = false;
    std::vector<PlannedChild> children;
  };

  /// Linear in the scene, instances of merged prototypes expanded. Without `share`, each root is
  /// one solid unit.
  ScenePlan(const Scene& scene, bool share);

  /// In the order in which nodes first show them.
  const std::vector<Unit>& units() const { return units_; }
  /// By root.
  const std::vector<uint32_t>& rootUnits() const { return rootUnits_; }
  /// The leaves to merge, in path order. Replaces `out`.
  void collect(uint32_t unit, UnitContent& out) const;
  /// How many leaves and placements that would be.
  double contentSize(uint32_t unit) const;

 private:
  enum class Use : uint8_t { None, Merged, Open, Solid };
  void measure();
  void decide();
  void measureContents();
  void walk(uint32_t prototype, const Frame& frame, bool solid, UnitContent* content,
            std::vector<PlannedChild>* children) const;
  bool standsAlone(const Leaf& leaf) const;
  uint32_t unitOfPrototype(uint32_t prototype);
  uint32_t unitOfLeaf(uint32_t leaf);

  const Scene& scene_;
  bool share_;
  // By mesh: bytes once written. By prototype: bytes when expanded, nodes below when open.
  std::vector<double> meshBytes_, bytes_, nodes_;
  // By prototype: leaves and placements when all is merged in, and when only what is merged is.
  std::vector<double> solidSize_, openSize_;
  // Sorted (mesh, materials) of the leaves that stand alone, and their units.
  std::vector<uint64_t> alone_;
  std::vector<uint32_t> aloneUnit_;
  std::vector<Use> use_;
  std::vector<uint32_t> prototypeUnit_;
  std::vector<Unit> units_;
  std::vector<uint32_t> rootUnits_;
};

}  // namespace gable
