// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Every rule set of examples/ on footprints from 6 m to 60 m, convex or not, with and without a
// hole: it derives without an error, and what it makes is sound.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "gable/gable.h"
#include "scene_faults.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

std::string sourceDir() { return GABLE_SOURCE_DIR; }

/// The rule files examples/NAME/NAME.cga, by name.
std::vector<std::string> exampleNames() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(sourceDir() + "/examples")) {
    const std::string name = entry.path().filename().string();
    if (fs::exists(entry.path() / (name + ".cga"))) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string rulesOf(const std::string& name) {
  return sourceDir() + "/examples/" + name + "/" + name + ".cga";
}

struct Footprint {
  const char* name;
  Shapes shapes;
};

std::vector<Footprint> footprints() {
  const Shapes::Ring bend = {{0, 0}, {24, 0}, {24, 10}, {10, 10}, {10, 26}, {0, 26}};
  const Shapes::Ring wedge = {{0, 0}, {18, 3}, {4, 15}};
  const Shapes::Ring court = {{0, 0}, {30, 0}, {32, 26}, {-2, 28}};
  const Shapes::Ring hole = {{10, 9}, {20, 9}, {20, 18}, {10, 18}};
  const Shapes::Ring round = {{10, 0},  {17, 3}, {20, 10}, {17, 17},
                              {10, 20}, {3, 17}, {0, 10},  {3, 3}};
  return {{"6 x 6", Shapes::lot(6, 6)},      {"6 x 18", Shapes::lot(6, 18)},
          {"20 x 14", Shapes::lot(20, 14)},  {"60 x 60", Shapes::lot(60, 60)},
          {"a bend", Shapes::polygon(bend)}, {"a wedge", Shapes::polygon(wedge)},
          {"round", Shapes::polygon(round)}, {"a court", Shapes::polygon(court, {hole})}};
}

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, standsOnAnyFootprint) {
  const Rules rules = Rules::load(rulesOf(GetParam()));
  ASSERT_TRUE(rules.ok()) << render(rules.diagnostics());
  for (const Footprint& footprint : footprints()) {
    DeriveSettings settings;
    settings.jobs = 1;
    const Model model = derive(rules, footprint.shapes, settings);
    EXPECT_FALSE(hasErrors(model.diagnostics())) << footprint.name << render(model.diagnostics());
    const Scene& scene = model.impl().result.scene;
    EXPECT_GT(count(scene).leaves, 5u) << footprint.name;
    EXPECT_EQ(joined(faults(scene)), "") << footprint.name;
    settings.sharing = false;
    EXPECT_TRUE(derive(rules, footprint.shapes, settings).dump() == model.dump())
        << footprint.name << " differs without sharing";
  }
}

TEST_P(Example, changesWithTheSeedAndOnlyWithIt) {
  const Rules rules = Rules::load(rulesOf(GetParam()));
  ASSERT_TRUE(rules.ok());
  std::set<std::string> looks;
  for (double seed : {1.0, 2.0, 3.0, 1.0}) {
    DeriveSettings settings;
    settings.jobs = 1;
    settings.seed = seed;
    looks.insert(derive(rules, Shapes::lot(18, 14), settings).dump());
  }
  EXPECT_GT(looks.size(), 1u);
  EXPECT_LE(looks.size(), 3u);
}

INSTANTIATE_TEST_SUITE_P(All, Example, testing::ValuesIn(exampleNames()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace gable
