// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Shapes that ask for room: the same ones get it for any number of workers, with sharing and
// without, and where a derivation takes over parts of the one before.

#include <gtest/gtest.h>

#include <string>

#include "engine/impl.h"
#include "gable/gable.h"

namespace gable {
namespace {

// Houses, trees beside them, and birds in trees; some try another place.
const char kPlace[] = R"(
attr roof = 30
Lot --> [ label("road") split(x) { ~1 : NIL | 4 : Road | ~1 : NIL } ]
  [ scatter(surface, 60, uniform) { House(2) } ] [ scatter(surface, 300, uniform) { Tree } ]
  split(z) { 3 : split(x) { 3 : Lamp }* }*
Road --> label("ground") Asphalt.
House(n) --> rotateScope(0, rand(0, 90), 0) s(rand(5, 12), 4, rand(5, 9)) center(xz) primitiveCube()
  ifFree("ground", 1) { Built | otherwise : Again(n) }
Again(n) --> case n > 0 : t(rand(-9, 9), 0, rand(-9, 9)) House(n - 1) else : NIL
Built --> report("house", scope.sx) [ Walls ] t(0, '1, 0) roofShed(roof) Roof.
Walls --> comp(f) { side : split(y) { ~2 : Row }* | all : NIL }
Row --> split(x) { ~1 : Tile. | 0.1 : Joint. }*
Tree --> s(2, 3, 2) center(xz) primitiveCube()
  ifFree("ground", 0.3, 1) { report("tree", 1) [ Crown. ] t(0, '1, 0) scatter(scope, 3, uniform) { Bird } }
Bird --> s(0.3, 0.3, 0.3) center(xyz) primitiveCube() ifFree("air", 0.1, space = volume) { variants(2) Feathers }
Feathers --> color(rand(1), 0, 0) Wing.
Lamp --> s(0, 0, 0) ifFree("ground", 0.5, 2) { report("lamp", 1) s(0.2, 4, 0.2) center(xz) primitiveCube() Iron. }
)";

Rules rulesOf(const std::string& text, const LoadSettings& options = {}) {
  Rules rules = Rules::parse(text, "room.cga", options);
  EXPECT_TRUE(rules.ok()) << (rules.diagnostics().empty() ? "" : rules.diagnostics()[0].rendered);
  return rules;
}

Shapes lots(int count) {
  std::vector<Shapes> all;
  for (int i = 0; i < count; ++i) all.push_back(Shapes::lot(60, 60));
  return Shapes::joined(all);
}

// All that is to be the same.
std::string shown(const Model& model) {
  std::string out;
  const Statistics s = model.statistics();
  for (const Statistics::Room& r : s.rooms) {
    out +=
        r.group + " " + std::to_string(r.kept) + " of " + std::to_string(r.kept + r.dropped) + "\n";
  }
  for (const Report& r : model.impl().result.scene.reports)
    out += r.key + numberText(r.value.number) + "\n";
  for (const Diagnostic& m : model.diagnostics()) out += m.rendered;
  return out + model.dump();
}

TEST(Room, isTheSameForAnyNumberOfWorkers) {
  const Rules rules = rulesOf(kPlace);
  for (const int count : {1, 5}) {
    const Shapes shapes = lots(count);
    DeriveSettings settings;
    settings.jobs = 1;
    const Model one = derive(rules, shapes, settings);
    EXPECT_EQ(one.end(), End::Done);
    const std::string expected = shown(one);
    EXPECT_NE(expected.find("no-room"), std::string::npos);
    for (const bool sharing : {true, false}) {
      settings.sharing = sharing;
      for (const int jobs : {1, 2, 5}) {
        settings.jobs = jobs;
        EXPECT_TRUE(shown(derive(rules, shapes, settings)) == expected) << count << sharing << jobs;
      }
    }
  }
}

// Lots that lie on each other share their ground: the first has it.
TEST(Room, isOneForAllInitialShapes) {
  const Rules rules = rulesOf("Lot --> ifFree(\"lot\") { A. | otherwise : B. }");
  for (const int jobs : {1, 3}) {
    DeriveSettings settings;
    settings.jobs = jobs;
    const Model model = derive(rules, lots(4), settings);
    const Statistics s = model.statistics();
    ASSERT_EQ(s.rooms.size(), 1u);
    EXPECT_EQ(s.rooms[0].group, "lot");
    EXPECT_EQ(s.rooms[0].kept, 1u);
    EXPECT_EQ(s.rooms[0].dropped, 3u);
  }
}

TEST(Room, isTheSameWherePartsAreTakenOver) {
  const Shapes lot = lots(1);
  const Rules rules = rulesOf(kPlace);
  DeriveSettings settings;
  settings.jobs = 2;
  settings.remember = true;
  const Model first = derive(rules, lot, settings);
  // Of the houses, which changes who has room; and of what stands in them, which does not.
  const std::pair<const char*, const char*> edits[] = {{"rand(5, 12)", "rand(4, 12)"},
                                                       {"~1 : Tile.", "~2 : Tile."}};
  for (const auto& [from, to] : edits) {
    std::string text = kPlace;
    text.replace(text.find(from), std::string(from).size(), to);
    LoadSettings options;
    options.before = &rules;
    const Rules edited = rulesOf(text, options);
    DeriveSettings again = settings;
    again.before = &first;
    const Model second = derive(edited, lot, again);
    again.before = nullptr;
    again.remember = false;
    again.jobs = 1;
    EXPECT_TRUE(shown(second) == shown(derive(edited, lot, again))) << from;
  }
}

TEST(Room, aQuarterOfAMillionMayAsk) {
  const Rules rules = rulesOf(
      "Lot --> split(x) { 1 : split(z) { 1 : s('1, 0, '1) ifFree(\"cell\") { NIL | otherwise : A. "
      "} }* "
      "}*");
  DeriveSettings settings;
  const Model model = derive(rules, Shapes::lot(500, 500), settings);
  EXPECT_EQ(model.end(), End::Done);
  const Statistics s = model.statistics();
  ASSERT_EQ(s.rooms.size(), 1u);
  EXPECT_EQ(s.rooms[0].kept, 250000u);
  EXPECT_EQ(s.rooms[0].dropped, 0u);
}

// Thin strips about one point: their boxes all meet, and few of them do.
TEST(Room, aHostileFanEndsAtTheLimitOnSteps) {
  const Rules rules = rulesOf(
      "Lot --> split(x) { 0.001 : Strip(split.index) }*\n"
      "Strip(i) --> rotateScope(0, 0.04 * i, 0) t(5000, 0, 0) s(900000, 0, 0.0001)"
      " ifFree(\"strip\") { A. }");
  DeriveSettings settings;
  settings.limits.steps = 500'000;
  for (const int jobs : {1, 2}) {
    settings.jobs = jobs;
    const Model model = derive(rules, Shapes::lot(5, 1), settings);
    EXPECT_EQ(model.end(), End::LimitReached);
    ASSERT_EQ(model.diagnostics().size(), 1u);
    EXPECT_EQ(model.diagnostics()[0].code, "too-many-steps") << model.diagnostics()[0].rendered;
  }
}

}  // namespace
}  // namespace gable
