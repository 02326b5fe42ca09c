// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Derivations that take parts over from the one before: the result is that of a derivation from
// nothing, to the byte, and what has not changed is not derived again.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "gable/gable.h"
#include "json/answers.h"
#include "program/reach.h"
#include "runtime/recall.h"

#include "engine/impl.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// All that a model shows: the draw list with its numbers of leaves, the file with its nodes,
// counts, reports, messages, and the rule and line of leaves here and there.
std::string shown(const Model& model) {
  const fs::path file =
      fs::path(testing::TempDir()) / ("gable-recall-" + std::to_string(getpid()) + ".glb");
  EXPECT_TRUE(model.write(file.string(), {}).ok);
  std::string out = contentOf(file);
  fs::remove(file);
  out += model.drawList();
  std::string stats = statisticsJson(model);
  // What was taken over is no difference.
  if (const size_t at = stats.find("\"recalled\""); at != std::string::npos) {
    stats.erase(at, stats.find('\n', at) - at);
  }
  std::erase_if(stats, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
  out += stats + diagnosticsJson(model.diagnostics());
  const uint64_t leaves = model.leafCount();
  const uint64_t step = leaves / 200 + 1;
  for (uint64_t leaf = 0; leaf < leaves; leaf += step) {
    out += leafJson(model.leaf(leaf).value());
  }
  return out;
}

uint64_t recalled(const Model& model) { return model.impl().result.recalled; }
uint64_t shapesOf(const Model& model) {
  uint64_t all = 0;
  for (const Root& r : model.impl().result.scene.roots) {
    all += model.impl().result.scene.prototypes[r.instance.prototype].shapes;
  }
  return all;
}

// A text that is edited, and what the page of an editor sees of it.
class Edited {
 public:
  explicit Edited(Shapes shapes, LoadSettings options = {}, std::string name = "main.cga")
      : shapes_(std::move(shapes)), options_(std::move(options)), name_(std::move(name)) {}

  DeriveSettings settings;

  /// The model of a text, with what can be taken over.
  Model next(const std::string& text) {
    LoadSettings options = options_;
    options.before = rules_ ? &*rules_ : nullptr;
    Rules rules = Rules::parse(text, name_, options);
    EXPECT_TRUE(rules.ok()) << (rules.diagnostics().empty() ? "" : rules.diagnostics()[0].rendered);
    DeriveSettings s = settings;
    s.remember = true;
    s.before = model_ ? &*model_ : nullptr;
    Model model = derive(rules, shapes_, s);
    rules_ = rules;
    model_ = model;
    return model;
  }
  /// The same from nothing.
  Model fresh(const std::string& text) const {
    return derive(Rules::parse(text, name_, options_), shapes_, settings);
  }
  LoadSettings& options() { return options_; }

 private:
  Shapes shapes_;
  LoadSettings options_;
  std::string name_;
  std::optional<Rules> rules_;
  std::optional<Model> model_;
};

// What several jobs divide among them is not kept as a whole, and how much that is nobody knows.
class OneJob : public Edited {
 public:
  explicit OneJob(Shapes shapes) : Edited(std::move(shapes)) { settings.jobs = 1; }
};

const char kBlocks[] = R"(
attr height = 30
attr other = 3
Lot --> split(x) { ~40 : Left | ~40 : Right }
Left --> extrude(height) comp(f) { side : Facade | top : LeftRoof. }
Right --> extrude(20 + rand(1)) comp(f) { side : Facade | top : RightRoof. }
Facade --> split(y) { ~3 : split(x) { ~rand(1, 2) : Tile }* }*
Tile --> s('1, '0.9, 0.2 * other) primitiveCube()
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Recall, anEditOfOneRuleLeavesTheOthers) {
  OneJob place(Shapes::lot(80, 20));
  const Model first = place.next(kBlocks);
  EXPECT_EQ(recalled(first), 0u);
  const Model again = place.next(kBlocks);
  EXPECT_GT(recalled(again), shapesOf(again) * 9 / 10);
  EXPECT_EQ(shown(again), shown(first));
  const std::string edited = replaced(kBlocks, "20 + rand", "21 + rand");
  const Model second = place.next(edited);
  EXPECT_EQ(shown(second), shown(place.fresh(edited)));
  EXPECT_GT(recalled(second), shapesOf(second) / 2);
  EXPECT_LT(recalled(second), shapesOf(second) * 9 / 10);
}

// What is kept follows from the rules alone, and from no clock.
TEST(Recall, theSameIsKeptEachTime) {
  const auto kept = [](const std::string& rules) {
    OneJob place(Shapes::lot(60, 60));
    const Model model = place.next(rules);
    const Recall& recall = *model.impl().result.recall;
    return std::pair(recall.parts.size(), recall.operations.size());
  };
  const std::string rules = "Lot --> scatterSpaced(2, poisson, 0) { Tree. }\n";
  EXPECT_EQ(kept(rules).second, 1u);
  EXPECT_EQ(kept("Lot --> offset(-2, inside) Flat.\n").second, 0u);
  EXPECT_GT(kept(kBlocks).first, 0u);
  for (const std::string& each : {rules, std::string(kBlocks)}) EXPECT_EQ(kept(each), kept(each));
}

// Whatever ran before it.
TEST(Recall, anOperationIsTakenOverWhereTheRestOfItsRuleHasChanged) {
  const std::string rules = R"(
Lot --> split(x) { ~1 : Beside | ~1 : Wood }
Beside --> s('1, '1, '0.5) Middle
Middle --> s('0.5, '1, '0.5) center(xz) Flat.
Wood --> scatterSpaced(2, poisson, 0) { Tree. }
)";
  OneJob place(Shapes::lot(60, 60));
  const auto operation = [](const Model& model) {
    const Recall& recall = *model.impl().result.recall;
    return recall.operations.size() == 1 ? recall.operations[0] : nullptr;
  };
  const auto first = operation(place.next(rules));
  ASSERT_TRUE(first);
  for (const char* share : {"'0.6", "'0.7", "'0.8"}) {
    const std::string edited =
        replaced(replaced(rules, "'0.5) Middle", std::string(share) + ") Middle"), "Tree.",
                 std::string("t(0, ") + share + ", 0) Tree.");
    const Model model = place.next(edited);
    EXPECT_EQ(operation(model), first) << share;
    EXPECT_EQ(shown(model), shown(place.fresh(edited))) << share;
  }
}

// What an operation is worth stays known while it is taken over.
TEST(Recall, aSmallOperationAmongLargeOnesDoesNotHideThem) {
  const std::string rules = R"(
Lot --> split(x) { ~1 : Wood | ~1 : Wood | ~1 : Wood | 3 : Grove | ~1 : Wood | ~1 : Wood }
Grove --> Wood
Wood --> scatterSpaced(2, poisson, 0) { Tree. }
)";
  OneJob place(Shapes::lot(300, 60));
  const auto kept = [](const Model& model) { return model.impl().result.recall->operations; };
  const auto first = kept(place.next(rules));
  EXPECT_EQ(first.size(), 5u);
  for (const char* height : {"1", "2", "3", "4"}) {
    const std::string edited =
        replaced(rules, "Tree.", std::string("t(0, ") + height + ", 0) Tree.");
    EXPECT_EQ(kept(place.next(edited)), first) << height;
  }
}

// Houses and posts ask for room; what stands on a lot that has room asks for nothing.
const char kRoomy[] = R"(
attr pitch = 30
attr spacing = 6
Lot --> split(x) { ~20 : Block }*
Block -->
  [ split(z) { ~spacing : Post }* ]
  s('0.6, '1, '0.6) center(xz) ifFree("house", 1) { House | otherwise : NIL }
Post --> s(1, 1, 1) center(xz) ifFree("post", 0.5) { Pole | otherwise : NIL }
Pole --> label("house") s(1, 3, 1) primitiveCube() Iron.
House --> extrude(6 + rand(3)) comp(f) { side : Wall | top : Roof }
Wall --> split(y) { ~1 : split(x) { ~rand(0.5, 1) : Bay }* }*
Bay --> s('1, '1, 0.1) primitiveCube() Pane.
Roof --> roofHip(pitch) Tiles.
)";

TEST(Recall, whoHasRoomIsFoundOutAnewOnlyWhereAnEditChangesThat) {
  const std::string rules = kRoomy;
  OneJob place(Shapes::lot(60, 30));
  const auto rooms = [](const Model& model) { return model.impl().result.recall->rooms; };
  const std::shared_ptr<RoomPlan> first = rooms(place.next(rules));
  ASSERT_TRUE(first);
  std::shared_ptr<RoomPlan> before = first;
  struct Edit {
    const char *from, *to;
    bool asksAnew;
  };
  for (const Edit& edit : {Edit{"pitch = 30", "pitch = 40", false},
                           {"6 + rand", "7 + rand", false},
                           {"spacing = 6", "spacing = 5", true},
                           {"s(1, 1, 1)", "s(1.5, 1, 1)", true},
                           {"\"house\", 1", "\"house\", 2", true},
                           {"Lot -->", "// A line that moves the others\nLot -->", true}}) {
    const std::string edited = replaced(rules, edit.from, edit.to);
    const Model model = place.next(edited);
    EXPECT_EQ(shown(model), shown(place.fresh(edited))) << edit.to;
    EXPECT_EQ(rooms(model) != before, edit.asksAnew) << edit.to;
    const Model back = place.next(rules);
    EXPECT_EQ(shown(back), shown(place.fresh(rules))) << edit.to;
    EXPECT_EQ(rooms(back) != rooms(model), edit.asksAnew) << edit.to;
    before = rooms(back);
  }
  // Values that are given count where somebody who asks reads them, and so do limits.
  place.settings.attributes = {{"pitch", "20"}};
  EXPECT_EQ(rooms(place.next(rules)), before);
  place.settings.attributes = {{"spacing", "4"}};
  const Model other = place.next(rules);
  EXPECT_EQ(shown(other), shown(place.fresh(rules)));
  EXPECT_NE(rooms(other), before);
  before = rooms(other);
  place.settings.limits.width = 20'000;
  EXPECT_NE(rooms(place.next(rules)), before);
}

// What asks for room is taken over as well, where all have the room that they had.
TEST(Recall, whatAsksForRoomIsTakenOver) {
  const std::string rules =
      replaced(kRoomy, "{ ~20 : Block }*", "{ ~20 : Block | ~20 : Yard }*") +
      "Yard --> split(z) { ~0.5 : split(x) { ~0.5 : Plant }* }*\n"
      "Plant --> s(0.8, 0, 0.8) center(xz) ifFree(\"post\") { Pole | otherwise : Weed. }\n";
  for (const int jobs : {1, 3}) {
    Edited place(Shapes::lot(80, 30));
    place.settings.jobs = jobs;
    place.next(rules);
    for (const char* pitch : {"40", "20"}) {
      const std::string edited = replaced(rules, "pitch = 30", std::string("pitch = ") + pitch);
      const Model model = place.next(edited);
      EXPECT_EQ(shown(model), shown(place.fresh(edited))) << pitch << " " << jobs;
      // What several jobs divide is not kept as a whole.
      if (jobs == 1) EXPECT_GT(recalled(model), shapesOf(model) * 2 / 3) << pitch;
    }
    const std::string posts = replaced(rules, "s(1, 1, 1)", "s(2, 1, 1)");
    EXPECT_EQ(shown(place.next(posts)), shown(place.fresh(posts))) << jobs;
    EXPECT_EQ(shown(place.next(rules)), shown(place.fresh(rules))) << jobs;
  }
}

// Parts beside, around and within each other, one edit after the other: each takes over what the
// one before had taken over already.
TEST(Recall, whatWasTakenOverIsTakenOverAgain) {
  for (const int jobs : {1, 3}) {
    Edited place(Shapes::lot(80, 20));
    place.settings.jobs = jobs;
    place.next(kBlocks);
    for (const char* number : {"21", "22", "23", "20"}) {
      const std::string edited = replaced(kBlocks, "20 + rand", std::string(number) + " + rand");
      const Model model = place.next(edited);
      EXPECT_EQ(shown(model), shown(place.fresh(edited))) << number << " " << jobs;
      EXPECT_GT(recalled(model), 0u);
      const std::string tiles = replaced(edited, "LeftRoof.", "color(\"#ff0000\") LeftRoof.");
      EXPECT_EQ(shown(place.next(tiles)), shown(place.fresh(tiles))) << number << " " << jobs;
    }
  }
}

// Reports lie between what was taken over and what was not.
TEST(Recall, reportsKeepTheirOrder) {
  const std::string rules = replaced(
      replaced(kBlocks, "Facade -->", "Facade --> report(\"facade\", scope.sx) print(scope.sx)"),
      "Tile -->", "Tile --> report(\"tile\", scope.sx)");
  Edited place(Shapes::lot(80, 20));
  place.next(rules);
  for (const char* number : {"21", "22"}) {
    const std::string edited = replaced(rules, "20 + rand", std::string(number) + " + rand");
    const Model model = place.next(edited);
    EXPECT_EQ(shown(model), shown(place.fresh(edited)));
    EXPECT_EQ(model.prints(), place.fresh(edited).prints());
    EXPECT_GT(recalled(model), 0u);
  }
}

TEST(Recall, aRuleThatAllReachChangesAll) {
  OneJob place(Shapes::lot(80, 20));
  place.next(kBlocks);
  const std::string edited = replaced(kBlocks, "'0.9", "'0.8");
  const Model model = place.next(edited);
  EXPECT_EQ(recalled(model), 0u);
  EXPECT_EQ(shown(model), shown(place.fresh(edited)));
}

TEST(Recall, linesThatMoveAreToldAnew) {
  OneJob place(Shapes::lot(80, 20));
  place.next(kBlocks);
  const std::string edited = replaced(kBlocks, "Left -->", "// A line\n\n/* more */\nLeft -->");
  const Model model = place.next(edited);
  EXPECT_GT(recalled(model), shapesOf(model) * 9 / 10);
  EXPECT_EQ(shown(model), shown(place.fresh(edited)));
}

TEST(Recall, rulesThatComeGoAndChangePlaces) {
  OneJob place(Shapes::lot(80, 20));
  place.next(kBlocks);
  std::string edited = replaced(kBlocks, "LeftRoof.", "LeftRoof");
  edited = replaced(edited, "Left -->", "Before --> Facade\nLeft -->") +
           "\nLeftRoof --> color(\"#ff0000\") Tiles.\n";
  const Model model = place.next(edited);
  EXPECT_EQ(shown(model), shown(place.fresh(edited)));
  EXPECT_GT(recalled(model), shapesOf(model) / 3);
}

TEST(Recall, anAttributeChangesWhatReadsIt) {
  OneJob place(Shapes::lot(80, 20));
  place.next(kBlocks);
  place.settings.attributes = {{"height", "33"}};
  const Model model = place.next(kBlocks);
  EXPECT_EQ(shown(model), shown(place.fresh(kBlocks)));
  EXPECT_GT(recalled(model), shapesOf(model) / 4);
  EXPECT_LT(recalled(model), shapesOf(model) / 2);
  place.settings.attributes = {{"height", "33"}, {"other", "2"}};
  const Model other = place.next(kBlocks);
  EXPECT_EQ(recalled(other), 0u);
  EXPECT_EQ(shown(other), shown(place.fresh(kBlocks)));
}

TEST(Recall, anAttributeThatIsNewOrGoesMovesTheOthers) {
  OneJob place(Shapes::lot(80, 20));
  place.next(kBlocks);
  const std::string edited = std::string("attr first = 1\n") + kBlocks;
  EXPECT_EQ(shown(place.next(edited)), shown(place.fresh(edited)));
  EXPECT_EQ(shown(place.next(kBlocks)), shown(place.fresh(kBlocks)));
}

// Shapes of an import have all of its attributes, so one that changes is another set for all of
// them.
TEST(Recall, attributesThatAreNotReadChangeNoPart) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("gable-recall-import-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string house = R"(
attr pitch = 30
attr storey = 3
attr mark = 1
House --> [ extrude(9) comp(f) { side : Wall | top : NIL } ] [ split(x) { ~1 : Marked }* ] Roof
Wall --> split(y) { ~storey : Floor }*
Floor --> split(x) { ~1 : Bay }*
Bay --> [ s('1, '1, 0.1) primitiveCube() Frame. ] Pane.
// What is set here stays as it is.
Marked -->
  case split.index == 1: set(mark, 7) Sign.
  else: Sign.
Roof --> roofHip(pitch) Tiles.
)";
  const std::string main = R"(
import h : "house.cga" ()
Lot --> split(x) { ~8 : h(storey = 3).House | ~9 : h(storey = 2).House }*
)";
  std::ofstream(folder / "house.cga") << house;
  LoadSettings options;
  options.project = folder.string();
  Edited place(Shapes::lot(60, 12), options, (folder / "main.cga").string());
  place.settings.jobs = 1;
  place.next(main);
  for (const char* number : {"35", "40", "30", "35"}) {
    place.options().overlay = {
        {"house.cga", replaced(house, "pitch = 30", std::string("pitch = ") + number)}};
    const Model model = place.next(main);
    EXPECT_EQ(shown(model), shown(place.fresh(main)));
    EXPECT_GT(recalled(model), shapesOf(model) / 10);
    EXPECT_NE(shown(model).find(std::string("\"h.pitch\":") + number), std::string::npos);
  }
  // One that is read by its value, and one that is set to what it was, or becomes.
  for (const auto& [from, to] : {std::pair("storey = 3", "storey = 4"),
                                 {"mark = 1", "mark = 7"},
                                 {"mark = 1", "mark = 8"}}) {
    place.options().overlay = {{"house.cga", replaced(house, from, to)}};
    const Model model = place.next(main);
    EXPECT_EQ(shown(model), shown(place.fresh(main)));
  }
  fs::remove_all(folder);
}

// Trees are kept from text to text; what was told of one is told again.
TEST(Recall, filesThatAreReadAgainMeanWhatTheySay) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("gable-recall-files-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "house.cga") << "House --> Leaf.\n";
  std::ofstream(folder / "roof.cga") << "Roof --> Tiles.\n";
  LoadSettings options;
  options.project = folder.string();
  const std::string path = (folder / "main.cga").string();
  const auto read = [&](const std::string& main, const Rules* before) {
    LoadSettings own = options;
    own.before = before;
    return Rules::parse(main, path, own);
  };
  const auto seen = [](const Rules& rules) {
    std::string out = rules.disassembly();
    for (const Diagnostic& d : rules.diagnostics()) out += d.rendered;
    return out;
  };
  const std::string house = "import h : \"house.cga\"\n", roof = "import r : \"roof.cga\"\n";
  const std::string lot = "Lot --> h.House r.Roof\n";
  Rules before = read(house + roof + lot, nullptr);
  for (const auto& [text, main] :
       {std::pair("House --> extrude(2) Leaf.\n", house + roof + lot),
        {"House --> extrude(2) Leaf.\n", roof + house + lot},
        {"House --> extrude(2 Leaf.\n", roof + house + lot},
        {"House --> extrude(2 Leaf.\n", "// A remark.\n" + roof + house + lot},
        {"House --> extrude(3) Leaf.\n", "// A remark.\n" + roof + house + lot}}) {
    options.overlay = {{"house.cga", text}};
    const Rules next = read(main, &before), fresh = read(main, nullptr);
    EXPECT_EQ(seen(next), seen(fresh)) << text << main;
    EXPECT_EQ(next.ok(), std::string(text).find(')') != std::string::npos) << text;
    before = next;
  }
  fs::remove_all(folder);
}

TEST(Recall, anotherSeedIsAnotherPlace) {
  OneJob place(Shapes::lot(80, 20));
  place.next(kBlocks);
  place.settings.seed = 7;
  EXPECT_EQ(shown(place.next(kBlocks)), shown(place.fresh(kBlocks)));
}

TEST(Recall, threadsTakeOverWhatOthersMade) {
  std::string lots = R"({"type":"FeatureCollection","features":[)";
  for (int i = 0; i < 12; ++i) {
    const std::string x = std::to_string(i * 30), end = std::to_string(i * 30 + 15 + i);
    lots += std::string(i ? "," : "") + R"({"type":"Feature","properties":{"name":"lot)" +
            std::to_string(i) + R"("},"geometry":{"type":"Polygon","coordinates":[[[)" + x +
            ",0],[" + end + ",0],[" + end + ",20],[" + x + ",20],[" + x + ",0]]]}}";
  }
  lots += "]}";
  Edited place(Shapes::parse(lots, "lots.geojson"));
  place.settings.jobs = 2;
  place.next(kBlocks);
  const std::string edited = replaced(kBlocks, "attr height = 30", "attr height = 31");
  const Model model = place.next(edited);
  EXPECT_EQ(shown(model), shown(place.fresh(edited)));
  EXPECT_GT(recalled(model), 0u);
}

const char kColumns[] = R"(
attr other = 3
Lot --> split(x) { 0.7 : split(z) { 0.7 : Column(rand(1, 2)) }* }*
Column(h) --> extrude(h) comp(f) { top : Top | side : Side. }
Top --> extrude(other)
)";

// Models that nobody holds any more leave their memory to those that come.
TEST(Recall, memoryOfModelsThatAreGoneChangesNothing) {
  for (const int jobs : {1, 3}) {
    Edited place(Shapes::lot(100, 100));
    place.settings.jobs = jobs;
    const std::string small = replaced(kColumns, "0.7 : Column", "70 : Column");
    for (const char* const other : {"4", "5"}) {
      place.next(replaced(kColumns, "other = 3", std::string("other = ") + other));
    }
    const Model last = place.next(kColumns);
    EXPECT_EQ(shown(last), shown(place.fresh(kColumns))) << jobs << " jobs";
    EXPECT_GT(last.impl().result.scene.prototypes.size(), 1u << 14);
    SpareMemory& memory = last.impl().rules->tables->spare;
    SpareBlocks spare = memory.take();
    EXPECT_GT(spare.prototypes.capacity(), 1u << 14);
    EXPECT_EQ(spare.workers.size(), static_cast<size_t>(jobs));
    memory.keep(std::move(spare));
    EXPECT_EQ(shown(place.next(small)), shown(place.fresh(small)));
    EXPECT_EQ(memory.take().prototypes.capacity(), 0u);
  }
}

TEST(Recall, warningsStay) {
  const std::string text =
      replaced(kBlocks, "top : RightRoof.", "top : i(\"none\" + \".obj\") Roof.");
  OneJob place(Shapes::lot(80, 20));
  const Model first = place.next(text);
  EXPECT_FALSE(first.diagnostics().empty());
  EXPECT_EQ(shown(place.next(text)), shown(first));
}

TEST(Recall, whatAnAttributePrintsIsPrintedByWhoAsksFirst) {
  const std::string text = replaced(kBlocks, "other = 3", "other = print(3)");
  OneJob place(Shapes::lot(80, 20));
  place.next(text);
  const std::string edited = replaced(text, "Left | ~40", "NIL | ~40");
  EXPECT_EQ(shown(place.next(edited)), shown(place.fresh(edited)));
}

TEST(Recall, reportsAndPrintsStayInOrder) {
  const std::string text =
      replaced(kBlocks, "Tile -->", "Tile --> report(\"tiles\", geometry.area) print(split.index)");
  OneJob place(Shapes::lot(80, 20));
  place.next(text);
  const std::string edited = replaced(text, "extrude(height)", "extrude(height + 3)");
  const Model model = place.next(edited);
  EXPECT_GT(recalled(model), 0u);
  EXPECT_EQ(shown(model), shown(place.fresh(edited)));
}

TEST(Recall, localValuesAndTheShapeBelowCount) {
  const std::string text = R"(
attr deep = 1
Lot --> split(x) { ~20 : local(deep = 2) { Block } | ~20 : Block | ~20 : set(deep, 3) Block }
Block --> extrude(20) comp(f) { side : Wall | all : NIL }
Wall --> split(y) { ~2 : split(x) { ~rand(1, 2) : [ s('0.5, '0.5, deep) center(xyz) Tile ] Tile }* }*
Tile --> primitiveCube()
)";
  OneJob place(Shapes::lot(60, 20));
  place.next(text);
  for (const auto& [from, to] : {std::pair("deep = 2", "deep = 2.5"), {"deep, 3", "deep, 4"}}) {
    const std::string edited = replaced(text, from, to);
    const Model model = place.next(edited);
    EXPECT_GT(recalled(model), 0u);
    EXPECT_EQ(shown(model), shown(place.fresh(edited)));
  }
}

// Leaves that an operation joins are taken back; what comes of it may be taken over.
TEST(Recall, whatRulesMakeLaterIsJoinedAnew) {
  const std::string text = R"(
Lot --> split(x) { ~20 : Paths(3) | ~20 : Paths(4) | ~20 : Block }
Paths(r) --> joined { Rows Disc(r) Block } extrude(0.3) Paved.
Rows --> split(z) { ~1 : split(x) { ~rand(1, 2) : Stone | 1 : NIL }* | 1 : NIL }*
Stone --> Stones
Stones --> split(x) { 0.1 : NIL | ~1 : Flat. }
Disc(r) --> circle(r, 24) Flat.
Block --> s('0.5, 6, '0.5) primitiveCube() split(y) { ~0.4 : split(x) { ~rand(0.3, 0.6) : Tile }* }*
Tile --> primitiveCube()
)";
  OneJob place(Shapes::lot(60, 20));
  place.next(text);
  for (const auto& [from, to] :
       {std::pair("Paths(4)", "Paths(5)"), {"0.3", "0.4"}, {"circle(r, 24)", "circle(r, 20)"}}) {
    const std::string edited = replaced(text, from, to);
    const Model model = place.next(edited);
    EXPECT_EQ(shown(model), shown(place.fresh(edited)));
    EXPECT_GT(recalled(model), 0u);
    place.next(text);
  }
}

TEST(Recall, questionsAboutOtherShapesAreAskedAnew) {
  const std::string text = R"(
Lot --> split(x) { ~10 : Left | ~10 : Right }
Left --> extrude(12) Wall
Right --> t(-2, 0, 0) extrude(10) Wall
Wall --> comp(f) { side : split(y) { ~1 : split(x) { ~rand(1, 2) : Tile }* }* }
Tile --> case inside(all) : NIL else : Tile.
)";
  Edited place(Shapes::lot(20, 20));
  place.next(text);
  const std::string edited = replaced(text, "extrude(12)", "extrude(8)");
  EXPECT_EQ(shown(place.next(edited)), shown(place.fresh(edited)));
}

TEST(Recall, aLimitLeavesNothingToTakeOver) {
  Edited place(Shapes::lot(80, 20));
  place.settings.limits.shapes = 300;
  const Model cut = place.next(kBlocks);
  EXPECT_EQ(cut.end(), End::LimitReached);
  place.settings.limits.shapes = 10'000'000;
  const Model whole = place.next(kBlocks);
  EXPECT_EQ(recalled(whole), 0u);
  EXPECT_EQ(shown(whole), shown(place.fresh(kBlocks)));
}

TEST(Recall, aBudgetCountsWhatIsTakenOver) {
  Edited place(Shapes::lot(80, 20));
  place.next(kBlocks);
  place.settings.limits.shapes = 300;
  EXPECT_EQ(place.next(kBlocks).end(), End::LimitReached);
}

// ---- The examples, with numbers in their texts changed -----------------------------------------

struct Example {
  const char* file;
  double width, depth;
  /// The file that is edited, and how many of its numbers.
  const char* edited;
  size_t edits;
};

void PrintTo(const Example& e, std::ostream* out) { *out << e.file << ", " << e.edited; }

class RecallOfExamples : public testing::TestWithParam<Example> {};

// Places behind the whole numbers of a text that stand between other signs.
std::vector<size_t> numbersIn(const std::string& text) {
  std::vector<size_t> out;
  for (size_t i = 1; i + 1 < text.size(); ++i) {
    const auto digit = [&](size_t k) { return std::isdigit(static_cast<unsigned char>(text[k])); };
    if (!digit(i) || digit(i + 1) || text[i + 1] == '.') continue;
    size_t begin = i;
    while (begin > 0 && digit(begin - 1)) --begin;
    const char before = begin > 0 ? text[begin - 1] : ' ';
    if (before == ' ' || before == '(' || before == '~' || before == '.') out.push_back(i + 1);
  }
  return out;
}

TEST_P(RecallOfExamples, isWhatADerivationFromNothingGives) {
  const Example& e = GetParam();
  const fs::path examples = fs::path(GABLE_SOURCE_DIR) / "examples";
  const std::string main = contentOf(examples / e.file);
  const std::string text = contentOf(examples / e.edited);
  const bool own = std::string(e.file) == e.edited;
  LoadSettings options;
  options.project = examples.string();
  Edited place(Shapes::lot(e.width, e.depth), options, (examples / e.file).string());
  place.settings.seed = 3;
  const auto edit = [&](const std::string& edited) {
    place.options().overlay = {{e.edited, edited}};
    return own ? edited : main;
  };
  place.next(edit(text));
  const std::vector<size_t> numbers = numbersIn(text);
  ASSERT_GT(numbers.size(), e.edits);
  uint64_t taken = 0;
  for (size_t k = 0; k < e.edits; ++k) {
    std::string edited = text;
    const size_t at = numbers[numbers.size() * (2 * k + 1) / (2 * e.edits)];
    edited.insert(at, text[at - 1] == '0' ? "1" : "0");
    LoadSettings check = options;
    check.overlay = {{e.edited, edited}};
    if (!Rules::parse(own ? edited : main, (examples / e.file).string(), check).ok()) continue;
    const std::string now = edit(edited);
    const Model model = place.next(now);
    const Model fresh = place.fresh(now);
    taken += recalled(model);
    EXPECT_TRUE(shown(model) == shown(fresh)) << "the number before byte " << at;
  }
  EXPECT_GT(taken, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Examples, RecallOfExamples,
    testing::Values(Example{"town/town.cga", 240, 240, "town/town.cga", 3},
                    Example{"town/town.cga", 240, 240, "monaco/monaco.cga", 3},
                    Example{"town/town.cga", 240, 240, "rules/trees.cga", 3},
                    Example{"town/town.cga", 240, 240, "suburb_house/suburb_house.cga", 2},
                    Example{"haussmann/haussmann.cga", 22, 18, "haussmann/haussmann.cga", 5},
                    Example{"gardens/gardens.cga", 80, 60, "gardens/gardens.cga", 5},
                    Example{"suburb/suburb.cga", 200, 120, "suburb/suburb.cga", 4},
                    Example{"castle/castle.cga", 160, 160, "castle/castle.cga", 3}),
    [](const testing::TestParamInfo<Example>& i) {
      std::string name;
      for (const char* c = i.param.edited; *c && *c != '.'; ++c) name += *c == '/' ? '_' : *c;
      return name + std::to_string(i.index);
    });

// ---- Reach -------------------------------------------------------------------------------------

uint64_t reachOfRule(const Rules& rules, const std::string& name) {
  const Program& p = rules.impl().program;
  return Reaches(p).all()[static_cast<size_t>(p.findRule(name))].code;
}

TEST(Reach, followsCallsFunctionsAndAttributes) {
  const std::string text = R"(
attr a = inner + 1
attr inner = 2
attr apart = 5
twice(x) = 2 * x
Lot --> A B C D
A --> extrude(twice(2)) Round
B --> extrude(a) Leaf.
C --> extrude(apart) Leaf.
D --> case scope.sy > 3 : Leaf. else : E
E --> s('1, '2, '1) D
Round --> Leaf.
)";
  const Rules before = Rules::parse(text, "a.cga");
  const auto changed = [&](const char* from, const char* to) {
    LoadSettings options;
    options.before = &before;
    const Rules after = Rules::parse(replaced(text, from, to), "a.cga", options);
    EXPECT_TRUE(after.ok());
    std::string out;
    for (const char* rule : {"Lot", "A", "B", "C", "D", "E", "Round"}) {
      if (reachOfRule(before, rule) != reachOfRule(after, rule)) out += std::string(rule) + " ";
    }
    return out;
  };
  EXPECT_EQ(changed("attr apart = 5", "attr apart =  5"), "");
  EXPECT_EQ(changed("2 * x", "3 * x"), "Lot A ");
  EXPECT_EQ(changed("inner = 2", "inner = 3"), "Lot B ");
  EXPECT_EQ(changed("apart = 5", "apart = 6"), "Lot C ");
  EXPECT_EQ(changed("'2, '1) D", "'3, '1) D"), "Lot D E ");
  EXPECT_EQ(changed("Round --> Leaf.", "Round --> Other."), "Lot A Round ");
  EXPECT_EQ(changed("Round\n", "set(apart, 2) Round\n"), "Lot A ");
}

}  // namespace
}  // namespace gable
