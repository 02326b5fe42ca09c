// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The six rules, every cell of their tables, against the left-handed original mirrored.

#include "gbbg_run.h"

namespace gable {
namespace {

using gbbg_world::Box;
using gbbg_world::Facing;
using gbbg_world::ScopeChange;
using gbbg_world::Vec;
using gbbg_world::operator+;

constexpr const char* kAxes[] = {"X", "Y", "Z"};

// A footprint at a turned and moved root: the object frame of a derivation.
Shapes rootedShapes(const Box& root) {
  const Shapes lot = Shapes::lot(20, 20);
  auto impl = std::make_shared<Shapes::Impl>(lot.impl());
  Box point = root;
  point.size = {0, 0, 0};
  impl->footprints[0].origin = mirrored(point).scope;
  return Shapes(std::move(impl));
}

const Vec kAt{3, 1, 5}, kRotate{20, 35, 10}, kSize{6, 4, 9};
const std::string kAxiom = "axiom START at (3, 1, 5) rotate (20, 35, 10) size (6, 4, 9)\n";

Box rootBox() { return {"", {10, 2, -7}, gbbg_world::euler({15, -40, 25}), {}}; }
Box startBox() {
  const Box root = rootBox();
  return {"START", root.root + root.rotation(kAt), root.rotation * gbbg_world::euler(kRotate),
          kSize};
}

// World and Set count from the rounded mean of the start shapes' places.
Box derivationRoot() {
  Box root = rootBox();
  root.root = root.root + root.rotation(kAt);
  return root;
}

std::string changeText(const char* name, const ScopeChange& c, bool scale) {
  if (!c.on) return {};
  std::string out = std::string(", ") + name + "(";
  for (const double v : c.value) out += std::to_string(v) + ", ";
  out += c.set ? "Set" : "Add";
  if (scale) out += c.relative ? ", Relative" : ", Absolute";
  if (!scale) out += c.world ? ", World" : ", Local";
  return out + ")";
}

TEST(GbbgTable, G4ScopeRulesOnARotatedRootAllCells) {
  const ScopeChange off;
  const std::vector<ScopeChange> translations = {off,
                                                 {true, {1, 2, 3}, false, false, false},
                                                 {true, {1, 2, 3}, false, true, false},
                                                 {true, {1, 2, 3}, true, false, false},
                                                 {true, {1, 2, 3}, true, true, false}};
  const std::vector<ScopeChange> rotations = {off,
                                              {true, {30, 50, -20}, false, false, false},
                                              {true, {30, 50, -20}, false, true, false},
                                              {true, {30, 50, -20}, true, false, false},
                                              {true, {0, 90, 0}, false, false, false}};
  const std::vector<ScopeChange> scales = {off,
                                           {true, {2, -1, 3}, false, false, false},
                                           {true, {2, 0.5, 3}, false, false, true},
                                           {true, {2, 7, 3}, true, false, false},
                                           {true, {-1, 7, -1}, true, false, true}};
  const Shapes shapes = rootedShapes(rootBox());
  for (const ScopeChange& t : translations) {
    for (const ScopeChange& r : rotations) {
      for (const ScopeChange& s : scales) {
        std::string changes =
            changeText("T", t, false) + changeText("R", r, false) + changeText("S", s, true);
        if (!changes.empty()) changes.erase(0, 2);
        const Derivation run =
            derived(kAxiom + "terminal Q\nSTART -> Scope(" + changes + ") {Q}", {}, shapes);
        Box expected = scopeRule(startBox(), t, r, s, derivationRoot());
        expected.symbol = "Q";
        EXPECT_TRUE(sameBoxes(run.leaves(), {expected})) << changes;
      }
    }
  }
}

TEST(GbbgTable, G4WhatIsOffHasNoEffect) {
  const Derivation run =
      derived(kAxiom +
              "terminal Q\nSTART -> Scope(T(1, 2, 3, Set, Off), R(1, 2, 3, Off), "
              "S(0, 0, 9, Set, Off)) {Q}");
  Box expected = {"Q", kAt, gbbg_world::euler(kRotate), kSize};
  EXPECT_TRUE(sameBoxes(run.leaves(), {expected}));
}

TEST(GbbgTable, G6SplitsFromTheRootAndToTheRoot) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool toRoot : {false, true}) {
      const Derivation run =
          derived(kAxiom + "terminal A, B, C\nSTART -> Split(" + kAxes[axis] + ", {1.5, 0.75}, " +
                      (toRoot ? "ToRoot" : "FromRoot") + ") {A | B | C}",
                  {}, rootedShapes(rootBox()));
      const std::vector<Box> expected =
          splitRule(startBox(), axis, {1.5, 0.75}, toRoot, {"A", "B", "C"});
      EXPECT_TRUE(sameBoxes(run.leaves(), expected)) << kAxes[axis] << toRoot;
      // The first successor comes first, wherever it lies.
      EXPECT_EQ(run.leaves()[0].name, "A");
    }
  }
}

TEST(GbbgTable, G8RepeatsAlongEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Derivation run =
        derived(kAxiom + "terminal A [2.4, 1.6, 2]\nSTART -> Repeat(" + kAxes[axis] + ") {A}", {},
                rootedShapes(rootBox()));
    EXPECT_TRUE(sameBoxes(run.leaves(), repeatRule(startBox(), axis, {2.4, 1.6, 2}, "A")))
        << kAxes[axis];
  }
}

TEST(GbbgTable, G9GridsOnEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Derivation run =
        derived(kAxiom + "terminal A [2.4, 1.6, 2]\nSTART -> Grid(" + kAxes[axis] + ") {A}", {},
                rootedShapes(rootBox()));
    EXPECT_TRUE(sameBoxes(run.leaves(), gridRule(startBox(), axis, {2.4, 1.6, 2}, "A")))
        << kAxes[axis];
  }
}

TEST(GbbgTable, G10G11MarginsOfEveryKind) {
  constexpr const char* kFacing[] = {"Default", "FacingOut", "FacingIn"};
  for (int axis = 0; axis < 3; ++axis) {
    for (int facing = 0; facing < 3; ++facing) {
      for (const bool relative : {false, true}) {
        for (const bool center : {false, true}) {
          const double m = relative ? 0.2 : 1.25;
          const std::string rule = std::string("START -> Margin(") + kAxes[axis] +
                                   (relative ? ", Relative, 0.2, " : ", Absolute, 1.25, ") +
                                   kFacing[facing] +
                                   (center ? ", Center) {C | E | X}" : ", NoCenter) {C | E}");
          const Derivation run =
              derived(kAxiom + "terminal C, E, X\n" + rule, {}, rootedShapes(rootBox()));
          EXPECT_TRUE(sameBoxes(run.leaves(), marginRule(startBox(), axis, relative, m,
                                                         static_cast<Facing>(facing), center)))
              << rule;
        }
      }
    }
  }
}

TEST(GbbgTable, G12ComponentsOnEveryAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const Derivation run =
        derived(kAxiom + "terminal Side 2D, Top 2D, Bottom 2D\nSTART -> Component(" + kAxes[axis] +
                    ", AllFaces) {Side | Top | Bottom}",
                {}, rootedShapes(rootBox()));
    EXPECT_TRUE(sameBoxes(run.leaves(), componentRule(startBox(), axis))) << kAxes[axis];
  }
}

TEST(GbbgTable, G12EveryModeGivesItsFaces) {
  const std::pair<const char*, std::vector<std::string>> modes[] = {
      {"AllFaces) {Side | Top | Bottom}", {"Side", "Side", "Side", "Side", "Top", "Bottom"}},
      {"Sides) {Side}", {"Side", "Side", "Side", "Side"}},
      {"Top) {Top}", {"Top"}},
      {"Bottom) {Bottom}", {"Bottom"}},
      {"SidesPlusTop) {Side | Top}", {"Side", "Side", "Side", "Side", "Top"}},
      {"SidesPlusBottom) {Side | Bottom}", {"Side", "Side", "Side", "Side", "Bottom"}},
      {"TopPlusBottom) {Top | Bottom}", {"Top", "Bottom"}}};
  for (const auto& [mode, names] : modes) {
    const Derivation run =
        derived(kAxiom + "terminal Side, Top, Bottom\nSTART -> Component(Y, " + mode);
    std::vector<std::string> got;
    for (const TracedShape& s : run.leaves()) got.push_back(s.name);
    EXPECT_EQ(got, names) << mode;
  }
}

TEST(GbbgTable, G12FacesAreSeenUprightFromOutside) {
  const Derivation run = derived(kAxiom + "terminal S\nSTART -> Component(Y, Sides) {S}");
  const Vec3 middle = [&] {
    Vec3 sum;
    for (const TracedShape& s : run.leaves()) sum += s.scope.point(s.size * 0.5) * 0.25;
    return sum;
  }();
  double area = 0;
  for (const TracedShape& s : run.leaves()) {
    area += s.size.x * s.size.y;
    EXPECT_GT(dot(s.scope.z, s.scope.point(s.size * 0.5) - middle), 0) << "the normal looks out";
    EXPECT_NEAR(length(cross(s.scope.x, s.scope.y) - s.scope.z), 0, 1e-9) << "x right, y up";
  }
  EXPECT_NEAR(area, 2 * (6 + 9) * 4, 1e-9);
}

}  // namespace
}  // namespace gable
