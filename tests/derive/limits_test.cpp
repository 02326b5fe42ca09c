// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What rules may ask for beyond all measure: it ends in a diagnostic, and in the same one with any
// number of threads.

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/interned.h"
#include "base/temporary_folder.h"
#include "engine/impl.h"
#include "gable/gable.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

Rules rulesOf(const std::string& text) {
  Rules rules = Rules::parse(text, "limits.cga");
  EXPECT_TRUE(rules.ok()) << (rules.diagnostics().empty() ? "" : rules.diagnostics()[0].rendered);
  return rules;
}

Shapes lots(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const std::string x = std::to_string(i * 20), end = std::to_string(i * 20 + 10);
    text += "o lot" + std::to_string(i) + "\nv " + x + " 0 0\nv " + end + " 0 0\nv " + end +
            " 0 -20\nv " + x + " 0 -20\nf -4 -3 -2 -1\n";
  }
  return Shapes::parse(text, "lots.obj");
}

bool tells(const DiagnosticList& messages, const std::string& code) {
  for (const Diagnostic& m : messages) {
    if (m.code == code) return true;
  }
  return false;
}

std::string textOf(const Model& model) {
  std::string out = std::to_string(static_cast<int>(model.end())) + "\n";
  for (const Diagnostic& m : model.diagnostics()) out += m.rendered + "\n";
  return out + model.dump();
}

// Calls of shared rules, so that prototypes nest as deep as the rules do.
TEST(Limits, deepRecursionEndsOnlyByDepth) {
  const Rules rules = rulesOf(R"(
Lot --> extrude(4) R
R --> [ s('0.5, '0.5, '0.5) X. ] report("n", 1) t(1, 0, 0) R
)");
  constexpr uint32_t kDepth = 30'000;
  DeriveSettings settings;
  settings.limits.depth = kDepth;
  const Model model = derive(rules, Shapes::lot(4, 4), settings);
  EXPECT_TRUE(tells(model.diagnostics(), "recursion-too-deep"));
  const Scene& scene = model.impl().result.scene;
  EXPECT_EQ(scene.prototypes.size(), kDepth + 1);
  EXPECT_EQ(model.leafCount(), kDepth);
  EXPECT_EQ(scene.reports.size(), kDepth);
  for (const char* kind : {"glb", "obj", "ply", "stl"}) {
    const fs::path file =
        fs::path(testing::TempDir()) / ("deep-" + std::to_string(getpid()) + "." + kind);
    EXPECT_TRUE(model.write(file.string(), {}).ok) << kind;
    EXPECT_GT(fs::file_size(file), 1'000'000u) << kind;
    fs::remove(file);
  }
  EXPECT_GT(model.drawList().size(), 1'000'000u);
  EXPECT_EQ(model.statistics().leaves, 30000u);
  PictureSettings small;
  small.width = small.height = 8;
  small.samples = 1;
  const fs::path picture =
      fs::path(testing::TempDir()) / ("deep-" + std::to_string(getpid()) + ".png");
  EXPECT_TRUE(model.picture(picture.string(), small).ok);
  fs::remove(picture);
}

// A thousand texts of 16 megabytes would take half a minute to write.
TEST(Limits, textsThatAreTooLongAreNotWrittenFirst) {
  const Rules rules = rulesOf("Lot --> A(\"x\")\nA(s) --> A(s + s)\n");
  const std::clock_t begin = std::clock();
  const Model model = derive(rules, Shapes::lot(4, 4), DeriveSettings{});
  EXPECT_TRUE(tells(model.diagnostics(), "text-too-long"));
  EXPECT_TRUE(tells(model.diagnostics(), "recursion-too-deep"));
  EXPECT_LT(std::clock() - begin, 5 * CLOCKS_PER_SEC);
}

TEST(Limits, deepPrototypesAreRecalled) {
  const std::string text = R"(
Lot --> split(x) { ~1 : R(0) | ~1 : Other }
Other --> primitiveCube() color("#ff0000")
R(n) --> case n == 20000 : Y. else : [ primitiveCube() X. ] R(n + 1)
)";
  DeriveSettings settings;
  settings.limits.depth = 30'000;
  settings.remember = true;
  const Rules rules = rulesOf(text);
  const Model first = derive(rules, Shapes::lot(4, 4), settings);
  EXPECT_EQ(first.end(), End::Done);
  LoadSettings options;
  options.before = &rules;
  std::string edited = text;
  edited.replace(edited.find("ff0000"), 6, "00ff00");
  settings.before = &first;
  const Model second =
      derive(Rules::parse(edited, "limits.cga", options), Shapes::lot(4, 4), settings);
  EXPECT_GT(second.impl().result.recalled, 20'000u);
  EXPECT_EQ(second.leafCount(), first.leafCount());
}

// The third shape is the first to tell of the second part: with any number of threads.
const char kTelling[] = R"(
attr index = 0
Lot --> extrude(rand(1, 3)) comp(f) { side : Facade | top : offset(-20, inside) Roof }
Facade --> split(x) { ~1 : split(y) { ~rand(0.5, 1) : Tile }* }*
Tile --> case p(0.1) : i("none-" + floor(rand(20))) X. else : set(index, rand(0, 1)) projectUV(3) Y.
Roof --> print([1, 2] + "x") taper(-2) roofHip(100 + index) Z.
)";

// Each call of B stands for two of A, so an undivided walk would take 2^50 steps.
TEST(Limits, sharedRulesThatMakeNothingCostNothing) {
  const Rules rules = rulesOf(R"(
Lot --> [ s(1, 1, 1) X. ] A(50)
A(n) --> case n == 0 : NIL else : split(x) { '1 : B(n) }
B(n) --> [ A(n - 1) ] [ t(0, 1, 0) A(n - 1) ] NIL
)");
  const Model model = derive(rules, lots(1), {});
  EXPECT_EQ(model.end(), End::Done);
  WriteSettings settings;
  settings.limits.seconds = 5;
  const fs::path file = fs::temp_directory_path() / ("empty." + std::to_string(getpid()) + ".obj");
  EXPECT_TRUE(model.write(file.string(), settings).ok);
  fs::remove(file);
}

TEST(Limits, messagesAreThoseOfOneThread) {
  const Rules rules = rulesOf(kTelling);
  const Shapes shapes = lots(40);
  DeriveSettings settings;
  settings.jobs = 1;
  const std::string one = textOf(derive(rules, shapes, settings));
  EXPECT_NE(one.find("warning"), std::string::npos);
  for (const int jobs : {2, 3, 4}) {
    for (int again = 0; again < 3; ++again) {
      settings.jobs = jobs;
      EXPECT_EQ(textOf(derive(rules, shapes, settings)), one) << jobs;
    }
  }
}

TEST(Limits, onCountsEndAtTheSamePlaceWithAnyNumberOfThreads) {
  const Rules rules = rulesOf(kTelling);
  const Shapes shapes = lots(40);
  const auto with = [&](auto set) {
    DeriveSettings settings;
    set(settings.limits);
    settings.jobs = 1;
    const Model one = derive(rules, shapes, settings);
    EXPECT_EQ(one.end(), End::LimitReached);
    for (const int jobs : {2, 4}) {
      settings.jobs = jobs;
      EXPECT_EQ(textOf(derive(rules, shapes, settings)), textOf(one));
    }
  };
  with([](Limits& b) { b.shapes = 2000; });
  with([](Limits& b) { b.steps = 4000; });
  with([](Limits& b) { b.depth = 1; });
  with([](Limits& b) { b.width = 3; });
}

// Several workers that reach a limit begin anew as one, which then finds models and images that
// have been read, and bodies that have been made.
TEST(Limits, onCountsDoNotDependOnWhatIsReadOnce) {
  const fs::path folder = fs::temp_directory_path() / ("once." + std::to_string(getpid()));
  fs::create_directories(folder / "textures");
  fs::copy_file(fs::path(GABLE_SOURCE_DIR) / "tools" / "programs" / "house.obj", folder / "m.obj",
                fs::copy_options::overwrite_existing);
  for (int i = 0; i < 100; ++i) {
    std::ofstream(folder / "textures" / (std::to_string(i) + ".png")) << "no picture";
  }
  // What is read at the head moves the places where limits are looked at.
  for (const char* head : {"[ i(\"m.obj\") X. ]", "affineBox(1, 1, 1, y, 4)", "affineSphere()",
                           "affineCylinder()", "print(imageInfo(\"textures/1.png\", sx))"}) {
    std::ofstream(folder / "r.cga")
        << "Lot --> " << head << " repeat(9999) { parametrise(border) { X. } Z. } X.\n";
    const Rules rules = Rules::load((folder / "r.cga").string());
    ASSERT_TRUE(rules.ok()) << rules.diagnostics()[0].rendered;
    for (const uint64_t most : {300, 500, 700}) {
      DeriveSettings settings;
      settings.limits.shapes = most;
      settings.jobs = 1;
      const Model one = derive(rules, lots(2), settings);
      EXPECT_EQ(one.end(), End::LimitReached);
      settings.jobs = 2;
      EXPECT_TRUE(textOf(derive(rules, lots(2), settings)) == textOf(one)) << head << most;
    }
  }
  fs::remove_all(folder);
}

TEST(Limits, noMoreMessagesAreKeptThanAnybodyReads) {
  const Rules rules = rulesOf("Lot --> split(x) { 0.001 : i(\"no-\" + split.index) X. }*\n");
  DeriveSettings settings;
  settings.jobs = 1;
  const Model model = derive(rules, lots(3), settings);
  EXPECT_EQ(model.diagnostics().size(), 1000u);
  settings.jobs = 2;
  EXPECT_EQ(textOf(derive(rules, lots(3), settings)), textOf(model));
}

// Tables of their true size would take minutes to fill.
TEST(Limits, tablesThatAreFullEndADerivation) {
  for (const char* text : {
           "attr a = 0\nLot --> split(x) { 0.01 : set(a, split.index) X. }*",
           "Lot --> split(x) { 0.01 : color(split.index / 1000, 0, 0) X. }*",
           "Lot --> split(x) { 0.01 : print(\"t\" + split.index) X. }*",
           "Lot --> split(x) { 0.01 : print(size([0, split.index])) X. }*",
       }) {
    const TableCapacityScope small(40);
    const Rules rules = rulesOf(text);
    DeriveSettings settings;
    settings.jobs = 2;
    const Model model = derive(rules, lots(4), settings);
    EXPECT_EQ(model.end(), End::LimitReached) << text;
    EXPECT_TRUE(tells(model.diagnostics(), "too-many-values")) << text;
  }
}

TEST(Limits, tablesThatOtherDerivationsFilledAreChanged) {
  const TableCapacityScope small(700);
  const Rules rules =
      rulesOf("attr a = 0\nattr b = 0\nLot --> split(x) { 0.02 : set(a, split.index + b) X. }*");
  for (int i = 0; i < 6; ++i) {
    DeriveSettings settings;
    settings.attributes = {{"b", std::to_string(i * 1000)}};
    const Model model = derive(rules, lots(1), settings);
    EXPECT_EQ(model.end(), End::Done) << i;
    EXPECT_EQ(model.leafCount(), 500u);
  }
}

TEST(Limits, attributesOfLeavesTakeABoundedPartOfTheMemory) {
  const Rules rules = rulesOf(R"(
attr a = [0:1:2]
Lot --> split(x) { 0.01 : set(a, [split.index:1:split.index+20000]) X. }*
)");
  DeriveSettings settings;
  settings.limits.bytes = 100 << 20;
  const Model model = derive(rules, Shapes::lot(1000, 10), settings);
  EXPECT_EQ(model.end(), End::LimitReached);
  uint64_t values = 0;
  for (const AttributeValue& a : model.impl().result.scene.attributeValues) {
    values += a.values.size();
  }
  EXPECT_GT(values, 0u);
  EXPECT_LT(values * sizeof(PlainValue), uint64_t{30} << 20);
}

// The wish to stop comes when the last shape is done: what is left is to put the scene together.
TEST(Limits, cancellingReachesTheMerge) {
  const Rules rules = rulesOf("Lot --> split(x) { ~0.01 : Tile. }*\n");
  for (const int jobs : {1, 2}) {
    std::atomic<bool> cancel{false};
    DeriveSettings settings;
    settings.jobs = jobs;
    settings.cancel = &cancel;
    EXPECT_GT(derive(rules, lots(8), settings).leafCount(), 7'000u);
    settings.progress = [&](size_t done, size_t total) { cancel = done == total; };
    const Model model = derive(rules, lots(8), settings);
    EXPECT_EQ(model.end(), End::Cancelled) << jobs;
    EXPECT_EQ(model.leafCount(), 0u) << jobs;
  }
}

TEST(Limits, whatIsCancelledIsNeitherPutTogetherNorWritten) {
  const Rules rules = rulesOf("Lot --> split(x) { 1 : Tile. }*\n");
  std::atomic<bool> cancel{false};
  DeriveSettings settings;
  settings.cancel = &cancel;
  settings.progress = [&](size_t, size_t) { cancel = true; };
  const Model model = derive(rules, lots(2), settings);
  EXPECT_EQ(model.end(), End::Cancelled);
  EXPECT_EQ(model.leafCount(), 0u);
  const TemporaryFolder folder;
  WriteSettings write;
  write.limits.cancel = &cancel;
  for (const char* name : {"/a.glb", "/a.obj", "/a.ply"}) {
    const std::string path = folder.path() + name;
    const WriteResult written = model.write(path, write);
    EXPECT_FALSE(written.ok) << name;
    EXPECT_TRUE(tells(written.diagnostics, "was-cancelled")) << name;
    EXPECT_FALSE(fs::exists(path)) << name;
  }
}

TEST(Limits, codeThatHasNoRoomInInstructionsIsRefused) {
  const auto repeated = [](const std::string& piece, int times, const char* between) {
    std::string out;
    for (int i = 0; i < times; ++i) out += (i ? between : "") + piece;
    return out;
  };
  const auto refused = [](const std::string& text) {
    const Rules rules = Rules::parse(text, "large.cga");
    return !rules.ok() && tells(rules.diagnostics(), "code-too-large");
  };
  const auto parameters = [&](int count) {
    std::string names, values;
    for (int i = 0; i < count; ++i) {
      names += (i ? ", a" : "a") + std::to_string(i);
      values += (i ? ", " : "") + std::to_string(i) + " + scope.sx";
    }
    return "Lot --> R(" + values + ")\nR(" + names + ") --> print(a0) print(a" +
           std::to_string(count - 1) + ")";
  };
  EXPECT_FALSE(refused(parameters(255)));
  EXPECT_TRUE(refused(parameters(256)));
  EXPECT_TRUE(refused("Lot --> " + repeated("0.001% : X.", 65536, " ") + " else : Y."));
  EXPECT_TRUE(refused("Lot --> " + repeated("[ split(x) { 1 : X. } ]", 65536, " ")));
  EXPECT_TRUE(refused("Lot --> print(size([" + repeated("rand()", 140'000, ",") + "]))"));
  EXPECT_TRUE(refused("Lot --> split(x) { " + repeated("rand() : X.", 140'000, "|") + " }"));
  // As many one after the other, or to choose from, need room for one.
  EXPECT_FALSE(refused("Lot --> " + repeated("t(rand(), 0, 0)", 70'000, " ")));
  EXPECT_FALSE(refused("Lot --> " + repeated("case p(0.5) : X.", 50'000, " ") + " else : Y."));
}

}  // namespace
}  // namespace gable
