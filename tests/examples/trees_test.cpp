// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The trees and people that rules share: the branching tree against its definition, worked out here
// once more with matrices, and all kinds by size, cost and look.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "json/answers.h"
#include "math/trig.h"
#include "scene_faults.h"

namespace gable {
namespace {

constexpr const char* kImport = "import trees : \"trees.cga\"\n";

Model derivedFrom(const Rules& rules, const Shapes& shapes, const std::string& start, double seed) {
  DeriveSettings settings;
  settings.startRule = start;
  settings.seed = seed;
  settings.jobs = 1;
  return derive(rules, shapes, settings);
}

Rules grove() { return Rules::load(std::string(GABLE_SOURCE_DIR) + "/examples/grove/grove.cga"); }

Rules withTrees(const std::string& text) {
  return Rules::parse("version \"2025.1\"\n" + std::string(kImport) + text,
                      std::string(GABLE_SOURCE_DIR) + "/examples/grove/test.cga");
}

/// A part of a tree: its box in its own frame, and where that frame is.
struct Part {
  std::string name;
  Frame frame;
  Vec3 size;
  size_t faces = 0;
  /// The box, in the world.
  Box3 box;
  /// The middle of its foot.
  Vec3 foot;
};

std::vector<Part> partsOf(const Model& model) {
  const Scene& scene = model.impl().result.scene;
  std::vector<Part> out;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    const Mesh& m = *scene.meshes[leaf.mesh];
    const Box3 box = transformed(m, leaf.scale, Frame{}).bounds();
    const Vec3 middle = (box.min + box.max) * 0.5;
    out.push_back({scene.names[leaf.name], world, box.max - box.min, m.faceCount(),
                   transformed(m, leaf.scale, world).bounds(),
                   world.point({middle.x, box.min.y, middle.z})});
  });
  return out;
}

bool isWood(const Part& p) { return p.name == "Bark"; }
bool isSpray(const Part& p) { return p.name == "Foliage"; }
bool isIn(const Box3& b, const Vec3& p, double around) {
  for (size_t a = 0; a < 3; ++a) {
    if (p[a] < b.min[a] - around || p[a] > b.max[a] + around) return false;
  }
  return true;
}

// ---- The definition once more ------------------------------------------------------------------

struct Matrix {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 operator*(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  Matrix operator*(const Matrix& m) const { return {(*this) * m.x, (*this) * m.y, (*this) * m.z}; }
};

// The rotation that takes y to a unit vector on the shortest way: I + [v] + [v]^2 / (1 + c) with
// v = y x d and c = y . d (Rodrigues).
Matrix fromYTo(const Vec3& d) {
  const Vec3 v = cross({0, 1, 0}, d);
  const auto column = [&](const Vec3& e) {
    const Vec3 once = cross(v, e);
    return e + once + cross(v, once) * (1 / (1 + d.y));
  };
  return {column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
}

double u(double n) {
  const double x = sinDeg(n * 78.233) * 43758.5453;
  return x - std::floor(x);
}

struct Definition {
  double least, most;
  struct Branch {
    Vec3 foot, direction;
    double length;
    int level;
  };
  std::vector<Branch> branches;
  std::vector<Vec3> leaves;
  std::vector<int> forks;
  std::vector<double> rises;

  void grow(const Matrix& turn, const Vec3& at, double length, int level, double n) {
    if (level < 1) {
      leaves.push_back(at);
      return;
    }
    branches.push_back({at, turn * Vec3{0, 1, 0}, length, level});
    const int many = static_cast<int>(least + std::floor((most - least + 0.999) * u(n)));
    forks.push_back(many);
    for (int i = 0; i < many; ++i) {
      const double k = n * 7.31 + i * 1.93;
      const Vec3 d = normalized(Vec3{u(k) - 0.5, 0.2 + 0.4 * u(k + 1), u(k + 2) - 0.5});
      rises.push_back(d.y);
      grow(turn * fromYTo(d), at + turn * Vec3{0, length, 0}, 0.6 * length, level - 1, k);
    }
  }
};

class BranchingTree : public testing::Test {
 protected:
  void SetUp() override {
    model_ = derivedFrom(grove(), Shapes::lot(10, 10), "OneTree", 0);
    ASSERT_FALSE(hasErrors(model_->diagnostics())) << render(model_->diagnostics());
    for (const Part& p : partsOf(*model_)) {
      if (isWood(p)) wood_.push_back(p);
      if (isSpray(p)) sprays_.push_back(p);
    }
    ASSERT_FALSE(wood_.empty());
    wanted_.grow({}, wood_[0].foot, 2, 3, 4);
  }

  std::optional<Model> model_;
  std::vector<Part> wood_, sprays_;
  Definition wanted_{3, 6, {}, {}, {}, {}};
};

TEST_F(BranchingTree, C1_forksThreeToSixTimesAndShrinksBySixTenths) {
  ASSERT_EQ(wood_.size(), wanted_.branches.size());
  ASSERT_EQ(sprays_.size(), wanted_.leaves.size());
  for (const int many : wanted_.forks) {
    EXPECT_GE(many, 3);
    EXPECT_LE(many, 6);
  }
  EXPECT_GT(std::set<int>(wanted_.forks.begin(), wanted_.forks.end()).size(), 2u);
  // The least y before normalising is 0.2, with at most 0.5 each way beside it.
  for (const double rise : wanted_.rises) EXPECT_GE(rise, 0.2 / std::sqrt(0.04 + 0.5));
  for (size_t i = 0; i < wood_.size(); ++i) {
    const int level = wanted_.branches[i].level;
    EXPECT_NEAR(wood_[i].size.y, 2 * std::pow(0.6, 3 - level), 1e-9);
  }
  const std::string stats = statisticsJson(*model_);
  EXPECT_NE(stats.find("\"forks\""), std::string::npos);
}

TEST_F(BranchingTree, C1_depthAndChildCountAreParameters) {
  for (const int depth : {1, 2, 4}) {
    const Rules rules =
        withTrees("Lot --> s(0, 0, 0) trees.Branch(2, " + std::to_string(depth) + ", 2, 2, 9)");
    const Model model = derivedFrom(rules, Shapes::lot(10, 10), "Lot", 0);
    ASSERT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
    const std::vector<Part> parts = partsOf(model);
    EXPECT_EQ(std::count_if(parts.begin(), parts.end(), isWood), (1 << depth) - 1);
    EXPECT_EQ(std::count_if(parts.begin(), parts.end(), isSpray), 1 << depth);
  }
}

TEST_F(BranchingTree, C2_leavesStandWhereTheMatricesSay) {
  ASSERT_EQ(sprays_.size(), wanted_.leaves.size());
  // Leaves stand on a twig that goes on where the last branch ends.
  for (size_t i = 0; i < sprays_.size(); ++i) {
    EXPECT_TRUE(isIn(sprays_[i].box, wanted_.leaves[i], 0.1)) << "leaf " << i;
  }
  for (size_t i = 0; i < wood_.size(); ++i) {
    EXPECT_LT(length(wood_[i].foot - wanted_.branches[i].foot), 1e-9) << "branch " << i;
    EXPECT_LT(length(wood_[i].frame.y - wanted_.branches[i].direction), 1e-9) << "branch " << i;
  }
}

TEST(BranchingTrees, C3_nineOnAGridAndADeepOne) {
  const std::vector<Part> nine = partsOf(derivedFrom(grove(), Shapes::lot(30, 30), "NineTrees", 1));
  std::set<std::pair<long, long>> places;
  for (const Part& p : nine) {
    if (isWood(p) && p.size.y > 2.1) {
      places.insert({std::lround(p.foot.x), std::lround(p.foot.z)});
      EXPECT_NEAR(p.foot.y, 0, 1e-9);
    }
  }
  EXPECT_EQ(places, (std::set<std::pair<long, long>>{{5, -25},
                                                     {5, -15},
                                                     {5, -5},
                                                     {15, -25},
                                                     {15, -15},
                                                     {15, -5},
                                                     {25, -25},
                                                     {25, -15},
                                                     {25, -5}}));
  std::set<long> lengths;
  for (const Part& p : partsOf(derivedFrom(grove(), Shapes::lot(30, 30), "DeepTree", 1))) {
    if (isWood(p)) lengths.insert(std::lround(p.size.y * 1e6));
  }
  EXPECT_EQ(lengths.size(), 6u);
}

// ---- All kinds ---------------------------------------------------------------------------------

struct Look {
  double height = 0, width = 0, crownFrom = 1e9, crownWidth = 0;
  size_t triangles = 0;
};

Look lookOf(const std::string& kind, double height, int number) {
  const Rules rules = withTrees("Lot --> s(0, 0, 0) trees.Tree(\"" + kind + "\", " +
                                std::to_string(height) + ", " + std::to_string(number) + ")");
  const Model model = derivedFrom(rules, Shapes::lot(10, 10), "Lot", 0);
  EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
  const Scene& scene = model.impl().result.scene;
  EXPECT_EQ(joined(faults(scene)), "");
  Look look;
  look.triangles = count(scene).triangles;
  const Box3 all = count(scene).bounds;
  look.height = all.max.y;
  look.width = std::max(all.max.x - all.min.x, all.max.z - all.min.z);
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    if (scene.names[leaf.name] != "Foliage") return;
    const Box3 box = transformed(*scene.meshes[leaf.mesh], leaf.scale, world).bounds();
    look.crownFrom = std::min(look.crownFrom, box.min.y);
  });
  return look;
}

TEST(Trees, haveTheHeightThatIsAskedForAndTheirKindsProportions) {
  struct Wanted {
    const char* kind;
    double height, narrowest, widest, clear;
  };
  // Width and clear stem as shares of the height.
  for (const Wanted& w : {Wanted{"lime", 11, 0.5, 0.95, 0.1},
                          {"street", 6, 0.3, 0.95, 0.4},
                          {"street", 10, 0.3, 0.95, 0.24},
                          {"oak", 13, 0.7, 1.5, 0.15},
                          {"plane", 15, 0.5, 1.2, 0.12},
                          {"birch", 12, 0.3, 0.7, 0.08},
                          {"poplar", 16, 0.1, 0.3, 0.01},
                          {"chestnut", 13, 0.5, 1.1, 0.06},
                          {"cherry", 7, 0.7, 1.6, 0.15},
                          {"willow", 11, 0.6, 1.3, 0.005},
                          {"olive", 6, 0.6, 1.6, 0.03},
                          {"pine", 13, 0.4, 1.1, 0.3},
                          {"spruce", 15, 0.3, 0.75, 0.001},
                          {"cypress", 12, 0.08, 0.25, 0.01},
                          {"palm", 10, 0.5, 1.2, 0.4},
                          {"branching", 10, 0.5, 1.5, 0.3}}) {
    for (int number = 0; number < 4; ++number) {
      SCOPED_TRACE(std::string(w.kind) + " " + std::to_string(number));
      const Look look = lookOf(w.kind, w.height, number);
      EXPECT_NEAR(look.height, w.height, 0.25 * w.height);
      EXPECT_GT(look.width, w.narrowest * look.height);
      EXPECT_LT(look.width, w.widest * look.height);
      EXPECT_GT(look.crownFrom, w.clear * look.height);
      // Twigs and leaves of their own take more than clumps did, which had 12000 at most.
      EXPECT_LT(look.triangles, 18000u);
    }
  }
}

TEST(Trees, ofOneNumberAndHeightAreOnePrototype) {
  const Rules rules = withTrees(
      "Lot --> split(x) { 10 : split(z) { 10 : s(0, 0, 0) Any(split.index) }* }*\n"
      "Any(i) --> case i % 2 == 0: trees.Pine else: trees.Birch");
  const auto stored = [&](double side) {
    const Model model = derivedFrom(rules, Shapes::lot(side, side), "Lot", 3);
    EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
    const Scene& scene = model.impl().result.scene;
    return std::make_pair(scene.leaves.size(), static_cast<size_t>(count(scene).leaves));
  };
  const auto some = stored(100), many = stored(400);
  EXPECT_GT(many.second, 14 * some.second);
  EXPECT_LT(many.first, 3 * some.first);
  EXPECT_LT(many.first * 15, many.second);
}

TEST(Trees, haveLessLeavesWhenTold) {
  const Rules rules = Rules::load(std::string(GABLE_SOURCE_DIR) + "/examples/rules/trees.cga");
  ASSERT_TRUE(rules.ok()) << render(rules.diagnostics());
  const auto triangles = [&](const char* leafage) {
    DeriveSettings settings;
    settings.startRule = "Lime";
    settings.jobs = 1;
    settings.attributes = {{"leafage", leafage}};
    const Model model = derive(rules, Shapes::lot(10, 10), settings);
    EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
    return count(model.impl().result.scene).triangles;
  };
  EXPECT_LT(triangles("0.4"), 0.75 * static_cast<double>(triangles("1")));
}

struct Cost {
  size_t triangles = 0, leaves = 0;
};

Cost costOf(const std::string& kind, const std::string& name, const std::string& value) {
  const Rules rules = Rules::load(std::string(GABLE_SOURCE_DIR) + "/examples/rules/trees.cga");
  DeriveSettings settings;
  settings.startRule = kind;
  settings.jobs = 1;
  settings.attributes = {{name, value}};
  const Model model = derive(rules, Shapes::lot(10, 10), settings);
  EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
  const Scene& scene = model.impl().result.scene;
  Cost cost;
  cost.triangles = count(scene).triangles;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame&) {
    if (scene.names[leaf.name] == "Foliage") cost.leaves += scene.meshes[leaf.mesh]->faceCount();
  });
  return cost;
}

constexpr const char* kKinds[] = {"Lime",   "Street",   "Oak",     "Plane",  "Birch",
                                  "Poplar", "Chestnut", "Cherry",  "Willow", "Olive",
                                  "Pine",   "Spruce",   "Cypress", "Palm"};

TEST(Trees, haveFiveLevelsOfDetailFromCardsToAllLeaves) {
  for (const char* kind : kKinds) {
    SCOPED_TRACE(kind);
    size_t before = 0;
    for (const char* level : {"0", "1", "2", "3", "4"}) {
      const Cost cost = costOf(kind, "treeDetail", level);
      EXPECT_GT(cost.triangles, before) << level;
      EXPECT_GT(cost.leaves, 0u) << level;
      if (before == 0) {
        EXPECT_LT(cost.triangles, 2500u);
      }
      before = cost.triangles;
    }
  }
}

TEST(Trees, areBareInWinterButForEvergreens) {
  const std::set<std::string> evergreens{"Olive", "Pine", "Spruce", "Cypress", "Palm"};
  for (const std::string kind : kKinds) {
    SCOPED_TRACE(kind);
    EXPECT_EQ(costOf(kind, "season", "winter").leaves > 0, evergreens.count(kind) == 1);
    for (const char* season : {"spring", "summer", "autumn"}) {
      EXPECT_GT(costOf(kind, "season", season).leaves, 0u) << season;
    }
  }
}

TEST(People, areTwelveLooksThatStandOnTheGround) {
  std::set<std::string> looks;
  for (int number = 0; number < 12; ++number) {
    SCOPED_TRACE(number);
    for (const bool sits : {false, true}) {
      const Rules rules = Rules::parse(
          "version \"2025.1\"\nimport people : \"people.cga\"\nLot --> s(0, 0, 0) people." +
              std::string(sits ? "Sitting(" : "Person(") + std::to_string(number) + ")",
          std::string(GABLE_SOURCE_DIR) + "/examples/grove/test.cga");
      const Model model = derivedFrom(rules, Shapes::lot(4, 4), "Lot", 0);
      ASSERT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
      EXPECT_EQ(joined(faults(model.impl().result.scene)), "");
      const SceneCounts counted = count(model.impl().result.scene);
      const Vec3 size = counted.bounds.max - counted.bounds.min;
      EXPECT_LT(counted.triangles, 950u);
      EXPECT_LT(size.x, 1.2);
      if (sits) continue;
      EXPECT_GT(size.y, 1.1);
      EXPECT_LT(size.y, 2.3);
      EXPECT_NEAR(counted.bounds.min.y, 0, 0.12);
      looks.insert(std::to_string(size.x) + " " + std::to_string(size.y));
    }
  }
  EXPECT_EQ(looks.size(), 12u);
}

// Whatever stands in streets is a variant: many of them hold no more leaves than a few do.
TEST(Shared, aCrowdHoldsNoMoreThanItsLooks) {
  const auto stored = [](const std::string& file, const std::string& what, int count) {
    const Rules rules = Rules::parse("version \"2025.1\"\nimport it : \"" + file +
                                         ".cga\"\nLot --> scatter(surface, " +
                                         std::to_string(count) + ", uniform) { it." + what + " }",
                                     std::string(GABLE_SOURCE_DIR) + "/examples/grove/test.cga");
    const Model model = derivedFrom(rules, Shapes::lot(200, 200), "Lot", 1);
    EXPECT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
    return model.impl().result.scene.leaves.size();
  };
  for (const auto& [file, what] : {std::pair{"people", "Walker"},
                                   {"people", "Sitter"},
                                   {"people", "Rester"},
                                   {"cars", "Car"},
                                   {"vehicles", "Bus"},
                                   {"vehicles", "Boat"},
                                   {"street", "Cafe"},
                                   {"street", "Stop"},
                                   {"plants", "Shrub(1)"},
                                   {"trees", "Street(7)"}}) {
    const size_t some = stored(file, what, 300), many = stored(file, what, 900);
    EXPECT_GT(some, 0u) << what;
    EXPECT_LT(static_cast<double>(many), 1.2 * static_cast<double>(some)) << file << '.' << what;
  }
}

}  // namespace
}  // namespace gable
