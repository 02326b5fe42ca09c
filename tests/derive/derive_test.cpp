// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Derivations as wholes: that sharing, threads and the short ways of the machine change nothing but
// the time, and that limits end what would never end.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gable/gable.h"
#include "json/answers.h"

namespace gable {
namespace {

struct Text {
  const char* name;
  const char* rules;
};

// Rules whose parts become leaves in a few plain steps, and some that only look so.
const Text kTexts[] = {
    {"facade", R"(
Lot --> extrude(12) comp(f) { side : Facade | top : Roof. }
Facade --> split(y) { ~3 : Floor }*
Floor --> split(x) { ~2 : Bay }*
Bay --> split(x) { 0.15 : Frame | ~1 : Middle | 0.15 : Frame }
Middle --> split(y) { 0.15 : Frame | ~1 : Glass | 0.15 : NIL }
Frame --> s('1, '1, 0.2) primitiveCube()
Glass --> t(0, 0, -0.1) s('1, '1, 0.05) primitiveCube()
)"},
    {"trimmed at the corners", R"(
Lot --> extrude(6) comp(f) { side : Facade }
Facade --> split(x) { 0.5 : Post | ~1 : Wall. | 0.5 : Post }
Post --> t(-0.4, 0, 0) s('2, '1, 0.6) primitiveCube()
)"},
    {"untrimmed", R"(
Lot --> extrude(6) comp(f) { side : Facade }
Facade --> set(trim.vertical, false) split(x) { 0.5 : Post | ~1 : Wall. | 0.5 : Post }
Post --> t(-0.4, 0, 0) s('2, '1, 0.6) primitiveCube()
)"},
    {"chains, names, drops", R"(
Lot --> extrude(5) split(x) { 1 : A | 1 : B | 1 : C. | 1 : NIL | 1 : D | 1 : s('1, 1, '1) }
A --> s('1, 2, '1) AA
AA --> AAA
AAA --> primitiveCube()
B --> Named.
D --> NIL
)"},
    {"flat and mirrored", R"(
Lot --> [ split(y) { ~1 : Ground. } ] [ split(z) { 1 : Strip | ~1 : Rest. } ]
        [ s('-1, 2, '1) split(x) { 1 : Left | ~1 : Cube } ] t(0, 3, 0) s('1, 0, '1) split(x) { ~1 : Cube }
Strip --> s('1, 0, 0.5)
Left --> s('1, '1, '1)
Cube --> primitiveCube()
)"},
    {"coloured, with attributes and numbers", R"(
attr depth = 0.3
Lot --> color("#ff8800") set(depth, 0.7) extrude(4) split(z) { ~1 : Slice(split.index) }*
Slice(n) --> split(x) { 1 : Piece | ~1 : Other(n) }
Piece --> s('1, '1, depth)
Other(n) --> case n % 2 == 0 : s('1, n + 1, '1) else : split(y) { 1 : Low. | ~2 : NIL }
)"},
    {"equal parts, and some that only look so", R"(
Lot --> extrude(9) split(y) { ~3 : Floor }*
Floor --> split(x) { { 1 : Bay | 1 : Bay | ~1 : Numbered | ~1 : Numbered }* | 1 : Bay | 1 : Wall. | 1 : Bay }
Bay --> split(z) { ~2 : Box | ~2 : Box | ~2 : Tagged }*
Box --> [ s('1, 1, '1) A ] B
Numbered --> s('1, 1 + split.index, '1) split(z) { ~1 : C. }*
Tagged --> comp(f) { isTagged("extrude.top") : Top. | isTagged("extrude.side") : Side. | all : Rest. }
)"},
    {"repeated with changing sizes", R"(
Lot --> extrude(rand(3, 9)) split(y) { 2 : Floor | { ~(scope.sy / 5) : Floor }* | 0.5 : Floor }
Floor --> split(x) { ~rand(0.5, 2) : Box | 1 : Box }*
Box --> primitiveCube()
)"},
};

std::string dumpOf(const Rules& rules, const DeriveSettings& settings) {
  const Model model = derive(rules, Shapes::lot(9.5, 7), settings);
  EXPECT_TRUE(model.ok());
  return model.dump();
}

class Derivation : public testing::TestWithParam<Text> {};

TEST_P(Derivation, isTheSameStepByStep) {
  const Rules rules = Rules::parse(GetParam().rules, "text.cga");
  ASSERT_TRUE(rules.ok());
  DeriveSettings settings;
  settings.jobs = 1;
  settings.sharing = false;
  const Model quick = derive(rules, Shapes::lot(9.5, 7), settings);
  settings.trace = true;
  const Model steps = derive(rules, Shapes::lot(9.5, 7), settings);
  EXPECT_FALSE(quick.dump().empty());
  EXPECT_EQ(quick.dump(), steps.dump());
  EXPECT_EQ(statisticsJson(quick), statisticsJson(steps));
}

TEST_P(Derivation, isTheSameWithSharing) {
  const Rules rules = Rules::parse(GetParam().rules, "text.cga");
  ASSERT_TRUE(rules.ok());
  DeriveSettings settings;
  settings.jobs = 1;
  const std::string shared = dumpOf(rules, settings);
  settings.sharing = false;
  EXPECT_EQ(dumpOf(rules, settings), shared);
}

TEST_P(Derivation, isTheSameOnTwoThreads) {
  const Rules rules = Rules::parse(GetParam().rules, "text.cga");
  ASSERT_TRUE(rules.ok());
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::vector<uint32_t>> faces;
  for (uint32_t i = 0; i < 40; ++i) {
    const double x = 20.0 * i, w = 6 + i % 7, d = 5 + i % 5;
    for (const auto& p : {std::pair{0.0, 0.0}, {w, 0.0}, {w, -d}, {0.0, -d}}) {
      vertices.push_back({x + p.first, 0, p.second});
    }
    faces.push_back({4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3});
  }
  const Shapes shapes = Shapes::mesh(vertices, faces);
  DeriveSettings settings;
  settings.jobs = 1;
  const std::string one = derive(rules, shapes, settings).dump();
  settings.jobs = 2;
  EXPECT_EQ(derive(rules, shapes, settings).dump(), one);
}

INSTANTIATE_TEST_SUITE_P(All, Derivation, testing::ValuesIn(kTexts), [](const auto& each) {
  std::string name = each.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

// Of a tower of floors of bays. The parts of a box differ in the tags of their sides.
uint64_t prototypesWithBays(const std::string& bay) {
  const Rules rules = Rules::parse(
      "Lot --> extrude(15) split(y) { ~3 : Floor }*\n"
      "Floor --> split(x) { ~2 : Bay }*\nBay --> " +
          bay,
      "text.cga");
  EXPECT_TRUE(rules.ok());
  DeriveSettings settings;
  settings.jobs = 1;
  return derive(rules, Shapes::lot(10, 7), settings).statistics().prototypes;
}

TEST(Sharing, seesTagsOnlyWhereARuleReadsThem) {
  EXPECT_EQ(prototypesWithBays("split(z) { ~1 : Box. }*"), 3u);
  // At the lower, the upper and no end of two directions.
  EXPECT_EQ(prototypesWithBays("split(z) { ~1 : comp(f) { isTagged(\"extrude.top\") : Top. } }*"),
            13u);
  EXPECT_EQ(prototypesWithBays("split(z) { ~1 : case isTagged(\"extrude.top\") : Top. else: B. }*"),
            13u);
  EXPECT_EQ(prototypesWithBays("split(z) { ~1 : cleanupGeometry(all, 0.1) Box. }*"), 13u);
}

// What a function takes out of a list may be any value. It is a number where only numbers go.
TEST(Sharing, aNumberOfUnknownTypeIsNoWordForTheWorld) {
  const std::string list =
      "\nconst angles = [4, 8]\nangle(n) = angles[n]\n"
      "const words = [\"scope\", \"world\"]\nword(n) = words[n]\n";
  EXPECT_EQ(prototypesWithBays("rotate(rel, scope, angle(1), 0, 0) Box." + list), 2u);
  EXPECT_EQ(prototypesWithBays(
                "rotate(rel, scope, yAngle = angle(1), xAngle = 0, zAngle = 0) Box." + list),
            2u);
  // Where a word goes it may be one, and bays that look at the world are no prototype.
  EXPECT_EQ(prototypesWithBays("rotate(rel, word(0), 4, 0, 0) Box." + list), 1u);
}

// Equal lots, and one of another size.
Shapes row() {
  const Shapes lot = Shapes::lot(10, 7);
  return Shapes::joined({lot, lot, Shapes::lot(12, 7), lot});
}

Model rowOf(const std::string& rules, unsigned jobs, bool sharing = true) {
  const Rules parsed = Rules::parse(rules, "row.cga");
  EXPECT_TRUE(parsed.ok());
  DeriveSettings settings;
  settings.jobs = jobs;
  settings.sharing = sharing;
  return derive(parsed, row(), settings);
}

TEST(Sharing, equalInitialShapesAreOne) {
  const std::string house =
      "attr h = 6\nLot --> print(geometry.area) extrude(h) split(x) { ~2 : Bay }*\n"
      "Bay --> split(y) { ~3 : Box. }*\n";
  const Model one = rowOf(house, 1);
  // Two lots, and the bays, which are as wide in both.
  EXPECT_EQ(one.statistics().prototypes, 3u);
  EXPECT_EQ(one.leafCount(), 2u * (3 * 5 + 6));
  EXPECT_EQ(one.prints().size(), 4u);
  for (const unsigned jobs : {1u, 2u, 3u}) {
    const Model other = rowOf(house, jobs);
    EXPECT_EQ(other.drawList(), one.drawList());
    EXPECT_EQ(other.dump(), one.dump());
    EXPECT_EQ(other.statistics().shapes, one.statistics().shapes);
    EXPECT_EQ(other.prints(), one.prints());
  }
  const Model flat = rowOf(house, 1, false);
  EXPECT_EQ(flat.dump(), one.dump());
  EXPECT_EQ(flat.statistics().shapes, one.statistics().shapes);
}

TEST(Sharing, initialShapesThatRulesTellApartAreNotOne) {
  const std::string bays = "split(x) { ~2 : Bay }*\nBay --> split(y) { ~3 : Box. }*\n";
  EXPECT_EQ(rowOf("Lot --> extrude(6 + initialShape.origin.px) " + bays, 1).statistics().prototypes,
            5u);
  EXPECT_GT(rowOf("Lot --> extrude(rand(6, 9)) " + bays, 1).statistics().prototypes, 7u);
}

std::string codes(const Model& model) {
  std::string out;
  for (const Diagnostic& m : model.diagnostics()) out += m.code + ' ';
  return out;
}

std::string jsonOf(const RuleValue& value) {
  std::string out;
  JsonWriter json(out);
  writeValue(json, value);
  return out;
}

Model limited(const char* text, const Limits& limits) {
  const Rules rules = Rules::parse(text, "text.cga");
  EXPECT_TRUE(rules.ok());
  DeriveSettings settings;
  settings.jobs = 1;
  settings.limits = limits;
  return derive(rules, Shapes::lot(10, 10), settings);
}

TEST(Limits, endRecursionAndKeepWhatWasMade) {
  const Model model = limited("Lot --> [ Kept. ] Lot", {});
  EXPECT_EQ(model.end(), End::LimitReached);
  EXPECT_EQ(codes(model), "recursion-too-deep ");
  EXPECT_NE(model.dump().find("Kept"), std::string::npos);
}

TEST(Limits, countPartsThatAreNeverMadeAsShapes) {
  Limits limits;
  limits.shapes = 5000;
  const Model model = limited("Lot --> split(x) { ~0.001 : Slice. }*", limits);
  EXPECT_EQ(model.end(), End::LimitReached);
  EXPECT_EQ(codes(model), "too-many-shapes ");
}

TEST(Limits, boundTheChildrenOfOneShape) {
  Limits limits;
  limits.width = 100;
  const Model model = limited("Lot --> split(x) { ~0.01 : Slice. }*", limits);
  EXPECT_EQ(model.end(), End::LimitReached);
  EXPECT_EQ(codes(model), "too-many-children ");
}

TEST(Steps, tellWhatTheyDrewAndSaw) {
  const Rules rules = Rules::parse(
      "attr h = 4\nLot --> extrude(h) Box(2)\nBox(n) --> 40% : A else: t(0, rand(1, 2), n) B\n"
      "B --> extrude(h + h) C.",
      "text.cga");
  ASSERT_TRUE(rules.ok());
  DeriveSettings settings;
  settings.trace = settings.traceShapes = true;
  settings.jobs = 2;
  size_t chosenFirst = 0;
  for (int seed = 0; seed < 20; ++seed) {
    settings.seed = seed;
    const DerivationTrace tree = derive(rules, Shapes::lot(4, 3), settings).trace();
    const auto& notes = tree.notes;
    ASSERT_GE(notes.size(), 3u);
    EXPECT_EQ(notes[0].kind, DerivationTrace::Note::Kind::Attribute);
    EXPECT_EQ(notes[0].name + " " + jsonOf(notes[0].value), "h 4");
    EXPECT_EQ(tree.names[tree.nodes[notes[0].node].name], "Lot");
    EXPECT_EQ(notes[1].kind, DerivationTrace::Note::Kind::Parameter);
    EXPECT_EQ(notes[1].name + " " + jsonOf(notes[1].value), "n 2");
    EXPECT_EQ(tree.names[tree.nodes[notes[1].node].name], "Box");
    ASSERT_EQ(notes[2].kind, DerivationTrace::Note::Kind::Choice);
    EXPECT_EQ(notes[2].place->line, 3u);
    const bool first = notes[2].choice->chosen == 0;
    EXPECT_EQ(first, notes[2].choice->draw < 0.4);
    EXPECT_DOUBLE_EQ(notes[2].choice->chance, first ? 0.4 : 0.6);
    chosenFirst += first ? 1 : 0;
    if (first) continue;
    ASSERT_EQ(notes.size(), 5u);
    EXPECT_EQ(notes[3].kind, DerivationTrace::Note::Kind::Draw);
    EXPECT_EQ(notes[3].name, "rand(1, 2)");
    EXPECT_GE(std::get<double>(notes[3].value.items[0]), 1);
    // Read twice, told once.
    EXPECT_EQ(notes[4].name, "h");
    EXPECT_EQ(tree.names[tree.nodes[notes[4].node].name], "B");
  }
  EXPECT_GT(chosenFirst, 2u);
  EXPECT_LT(chosenFirst, 16u);
}

}  // namespace
}  // namespace gable
