// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One initial shape that several workers derive: the result is that of one worker, to the byte.

#include <gtest/gtest.h>

#include <string>

#include "base/text.h"
#include "engine/impl.h"
#include "gable/gable.h"

namespace gable {
namespace {

Rules rulesOf(const std::string& text, const LoadSettings& options = {}) {
  Rules rules = Rules::parse(text, "divided.cga", options);
  EXPECT_TRUE(rules.ok()) << (rules.diagnostics().empty() ? "" : rules.diagnostics()[0].rendered);
  return rules;
}

// All that is to be the same: leaves with their nodes and numbers, counts, messages, reports.
std::string shown(const Model& model) {
  const Scene& scene = model.impl().result.scene;
  std::string out = std::to_string(static_cast<int>(model.end()));
  for (const size_t n : {scene.prototypes.size(), scene.leaves.size(), scene.instances.size(),
                         scene.meshes.size(), scene.materialLists.size()}) {
    out += " " + std::to_string(n);
  }
  out += " shapes " + std::to_string(scene.prototypes.back().shapes) + "\n";
  for (const std::string& p : scene.prints) out += p + "\n";
  for (const Report& r : scene.reports) out += r.key + numberText(r.value.number) + "\n";
  for (const Diagnostic& m : model.diagnostics()) out += m.rendered;
  return out + model.drawList() + model.dump();
}

const char kTown[] = R"(
attr height = 4
attr told = height + size([1, 2])
style(n) = case n % 2 == 0 : "even" else : "odd"
Lot --> split(x) { ~10 : Street(split.index) }*
Street(n) -->
  local(height = 3 + n % 4) {
    split(z) { ~8 : House(n, style(n)) | 1 : Path. }*
  }
House(n, kind) -->
  case p(0.1) : Garden(n)
  else :
    report("house", n) extrude(height + rand(2)) repeat(2) { do(Shrink(0.98)) }
    comp(f) { side : Facade(kind) | top : Roof }
Shrink(f) --> s('f, '1, 'f) center(xz)
Facade(kind) --> split(y) { ~rand(2, 3) : split(x) { ~1 : Tile | ~0.3 : set(height, 9) Post }* }*
Tile --> [ s('1, '1, 0.1) primitiveCube() Frame ] case p(0.02) : print("tile " + told) Glass. else : Glass.
Frame --> split(x) { 0.05 : A. | ~1 : NIL | 0.05 : A. }
Post --> s('1, '1, 0.2) primitiveCube() color(rand(1), 0, 0) P.
Roof --> roofHip(case p(0.05) : 95 else : 30) comp(f) { all : Tiles. }
Garden(n) --> scatter(surface, 20, uniform) { s(0.2, 1, 0.2) primitiveCube() Bush }
Bush --> split(y) { ~1 : Leaf. }*
)";

// A machine that is busy with other things may leave a worker no time to ask for a portion.
Model dividedOf(const Rules& rules, const Shapes& shapes, DeriveSettings settings) {
  for (int again = 0;; ++again) {
    Model model = derive(rules, shapes, settings);
    if (model.impl().result.portions > 0 || again == 20) {
      EXPECT_GT(model.impl().result.portions, 0u);
      return model;
    }
  }
}

TEST(Divided, givesWhatOneWorkerGives) {
  const Rules rules = rulesOf(kTown);
  const Shapes lot = Shapes::lot(60, 60);
  for (const bool sharing : {true, false}) {
    DeriveSettings settings;
    settings.sharing = sharing;
    settings.jobs = 1;
    const Model one = derive(rules, lot, settings);
    EXPECT_EQ(one.impl().result.portions, 0u);
    const std::string expected = shown(one);
    EXPECT_NE(expected.find("tile"), std::string::npos);
    EXPECT_NE(expected.find("warning"), std::string::npos);
    for (const int jobs : {2, 3, 5}) {
      settings.jobs = jobs;
      EXPECT_TRUE(shown(dividedOf(rules, lot, settings)) == expected) << sharing << jobs;
    }
  }
}

// A page is sent the chunks that it does not hold. Their ends and order must be those of the page's
// next model, whoever was first to make a set of tags.
TEST(Divided, whatIsDrawnIsCutIntoTheSameChunks) {
  const char* const text = R"(
@StartRule
Lot --> split(x) { ~2 : split(z) { ~2 : Hut }* }*
Hut --> tag("hut" + floor(rand(40))) extrude(rand(1, 3)) roofHip(rand(20, 40))
        tag("edge" + floor(rand(40)), edges) comp(f) { side : Wall. | top : Roof. }
Other --> tag("edge7", edges) tag("hut39") X.
)";
  const Shapes lot = Shapes::lot(140, 140);
  DeriveSettings settings;
  settings.jobs = 1;
  const std::string expected =
      joined(derive(rulesOf(text), lot, settings).drawUpdate(nullptr).bytes);
  EXPECT_EQ(expected.substr(0, 4), "GBU2");
  for (const int jobs : {2, 3, 8}) {
    settings.jobs = jobs;
    const Rules rules = rulesOf(text);
    EXPECT_TRUE(joined(dividedOf(rules, lot, settings).drawUpdate(nullptr).bytes) == expected)
        << jobs;
  }
  // The tables of the rules know other tags first.
  const Rules rules = rulesOf(text);
  settings.startRule = "Other";
  derive(rules, Shapes::lot(1, 1), settings);
  settings.startRule.reset();
  EXPECT_TRUE(joined(derive(rules, lot, settings).drawUpdate(nullptr).bytes) == expected);
}

TEST(Divided, partsAreTakenOverByTheNextDerivation) {
  const Shapes lot = Shapes::lot(60, 60);
  DeriveSettings settings;
  settings.jobs = 3;
  settings.remember = true;
  const Rules rules = rulesOf(kTown);
  const Model first = dividedOf(rules, lot, settings);
  std::string text = kTown;
  text.replace(text.find("0.05 : A."), 4, "0.06");
  LoadSettings options;
  options.before = &rules;
  settings.before = &first;
  const Rules edited = rulesOf(text, options);
  const Model second = derive(edited, lot, settings);
  settings.before = nullptr;
  settings.remember = false;
  settings.jobs = 1;
  EXPECT_TRUE(shown(second) == shown(derive(edited, lot, settings)));
  // And once more, from what was taken over.
  options.before = &edited;
  const Rules same = rulesOf(text, options);
  DeriveSettings again;
  again.jobs = 2;
  again.before = &second;
  const Model third = derive(same, lot, again);
  EXPECT_GT(third.impl().result.recalled, 500u);
  EXPECT_TRUE(shown(third) == shown(second));
}

TEST(Divided, aLimitWithinAPortionEndsTheWhole) {
  const Rules rules = rulesOf(R"(
Lot --> split(x) { ~0.5 : split(z) { ~1 : Cell(split.index) }* }*
Cell(n) --> case p(0.0005) : Endless else : split(x) { ~0.1 : s('1, rand(1), '1) X. }*
Endless --> t(1, 0, 0) Endless
)");
  const Shapes lot = Shapes::lot(60, 60);
  DeriveSettings settings;
  settings.jobs = 1;
  const Model one = derive(rules, lot, settings);
  EXPECT_EQ(one.end(), End::LimitReached);
  for (const int jobs : {2, 4}) {
    settings.jobs = jobs;
    EXPECT_TRUE(shown(derive(rules, lot, settings)) == shown(one)) << jobs;
  }
}

TEST(Divided, anAttributeThatPrintsDoesItOnce) {
  const Rules rules = rulesOf(R"(
attr late = print("once")
Lot --> split(x) { ~0.5 : split(z) { ~1 : Cell }* }*
Cell --> case p(0.01) : report("late", str(late)) X. else : split(x) { ~0.1 : s('1, rand(1), '1) X. }*
)");
  const Shapes lot = Shapes::lot(60, 60);
  for (const int jobs : {1, 2, 4}) {
    DeriveSettings settings;
    settings.jobs = jobs;
    EXPECT_EQ(derive(rules, lot, settings).prints().size(), 1u) << jobs;
  }
}

}  // namespace
}  // namespace gable
