// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The models of examples, as things of solid parts: no faces of two materials in one plane,
// nothing that nothing carries, and no thing that stands in another. What is not mended yet stands
// in known_faults.txt. With GABLE_PLACES=TEXT those whose line holds the text are printed: the
// seed, where they are, and how much of it. GABLE_SEEDS=20 looks at so many seeds of each instead
// of one or two.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cases/solid_faults.h"
#include "engine/impl.h"
#include "gable/city.h"
#include "gable/gable.h"
#include "known_faults.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

struct Example {
  std::string name, rules;
  /// Shown on so many seeds, from its own on.
  int seeds = 2;
  double seed = 0, width = 20, depth = 20;
  bool onMap = false;
  /// Of a place: the part of its map.
  std::optional<std::array<double, 4>> box;
  std::vector<std::pair<std::string, std::string>> attributes;
};

void PrintTo(const Example& example, std::ostream* out) { *out << example.name; }

// The examples that are looked at on their own shapes, besides all park grammars.
const std::set<std::string> kLookedAt = {"brownstone", "gbbg",      "grove",        "halftimber",
                                         "harbour",    "haussmann", "hilltown",     "progen3d",
                                         "rowhouse",   "slabs",     "suburb_house", "tower"};

// Those that are looked at on a lot, which has all of their rules to show in less time.
struct OnLot {
  double width, depth;
  int seeds = 2;
  std::vector<std::pair<std::string, std::string>> attributes = {};
};
const std::map<std::string, OnLot> kOnLots = {
    {"artdeco", {44, 44, 1}},
    {"castle", {240, 240, 1, {{"huts.things", "true"}}}},
    {"cathedral", {46, 80}},
    {"gardens", {60, 45}},
    {"machiya", {18, 36}},
    {"monaco", {14, 12}},
    {"palazzi", {24, 22}},
    {"station", {50, 90}},
    {"suburb", {320, 320, 1, {{"traffic", "true"}}}},
    {"temple", {26, 40}},
    {"terrace", {26, 24}},
    {"town", {150, 150, 1, {{"traffic", "true"}}}},
};

// Vinohrady has no rules of its own but those of all places from maps: a few blocks about its round
// square, in degrees, stand for them. Left out where maps cannot be read.
const std::array<double, 4> kSquare = {14.43747, 50.07192, 14.43915, 50.07282};

std::string folder() { return std::string(GABLE_SOURCE_DIR) + "/examples/"; }

// The lot and the seed of generate.args.
void readArguments(Example& example) {
  std::ifstream file(folder() + example.name + "/generate.args");
  std::istringstream text(std::string(std::istreambuf_iterator<char>(file), {}));
  for (std::string word; text >> word;) {
    if (word == "--seed") text >> example.seed;
    char by = 0;
    if (word == "--lot") text >> example.width >> by >> example.depth;
  }
}

void putOn(Example& example, const OnLot& lot) {
  example.width = lot.width;
  example.depth = lot.depth;
  example.seeds = lot.seeds;
  example.attributes = lot.attributes;
}

std::string mapOf(const Example& example) { return folder() + example.name + "/buildings.geojson"; }

std::vector<Example> examples() {
  std::vector<Example> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder())) {
    const fs::path& path = entry.path();
    const std::string extension = path.extension().string(), stem = path.stem().string();
    const std::string parent = path.parent_path().filename().string();
    const bool park = extension == ".park";
    const bool known = extension == ".cga" || extension == ".gbbg" || extension == ".grammar";
    if (!park && (!known || stem != parent)) continue;
    Example example;
    example.name = park ? "park_" + stem : stem;
    example.rules = path.string();
    readArguments(example);
    if (park) example.width = example.depth = 40;
    const auto lot = park ? kOnLots.end() : kOnLots.find(stem);
    if (lot != kOnLots.end()) putOn(example, lot->second);
    if (!park && lot == kOnLots.end() && kLookedAt.count(stem) == 0) continue;
    example.onMap = lot == kOnLots.end() && fs::exists(mapOf(example));
    all.push_back(example);
  }
#ifdef GABLE_HAS_MAPS
  Example place;
  place.name = "vinohrady";
  place.rules = folder() + "rules/city.cga";
  place.box = kSquare;
  place.attributes = {{"figures", "true"}};
  all.push_back(place);
#endif
  std::sort(all.begin(), all.end(),
            [](const Example& a, const Example& b) { return a.name < b.name; });
  return all;
}

Shapes shapesOf(const Example& example) {
  if (example.box) {
    CitySettings settings;
    settings.box = example.box;
    return City::load(folder() + "vinohrady/vinohrady.osm", settings).shapes();
  }
  if (example.onMap) return Shapes::load(mapOf(example));
  return Shapes::lot(example.width, example.depth);
}

// Parts of one thing, such as the limbs of a figure or the stones of a wall, may be joined by
// standing in each other: rules of one file make one kind of thing. Twigs and leaves may reach into
// anything.
bool mayOverlap(const cases::Parts& parts, uint32_t a, uint32_t b) {
  const auto fileOf = [&](uint32_t i) -> const std::string& {
    return parts.scene().sources[parts[i].leaf->source].file;
  };
  const auto grows = [&](uint32_t i) {
    return parts.name(i) == "Foliage" || parts.name(i) == "Petals";
  };
  return fileOf(a) == fileOf(b) || grows(a) || grows(b);
}

void show(const std::string& what, const cases::SolidFault& fault, double seed) {
  static const char* const wanted = std::getenv("GABLE_PLACES");
  if (!wanted || what.find(wanted) == std::string::npos) return;
  std::cout << "seed " << seed << ": " << what << ": " << fault.amount << " at " << fault.at.x
            << ' ' << fault.at.y << ' ' << fault.at.z << '\n';
}

FaultCounts faultsOf(const Scene& scene, double seed) {
  const cases::Parts parts(scene);
  FaultCounts counts;
  const auto label = [&](uint32_t i) { return parts.rule(i) + ":" + parts.name(i); };
  const auto addPair = [&](const char* kind, const cases::SolidFault& fault) {
    std::string a = label(fault.first), b = label(fault.second);
    if (b < a) std::swap(a, b);
    const std::string what = std::string(kind) + " " + a + " " + b;
    ++counts[what];
    show(what, fault, seed);
  };
  for (const cases::SolidFault& f : cases::coplanarFaces(parts, 0)) addPair("coplanar", f);
  const auto skip = [&](uint32_t a, uint32_t b) { return mayOverlap(parts, a, b); };
  for (const cases::SolidFault& f : cases::overlaps(parts, skip)) addPair("overlapping", f);
  for (const cases::SolidFault& f : cases::floatingParts(parts, 0)) {
    const std::string what = "floating " + label(f.first);
    ++counts[what];
    show(what, f, seed);
  }
  return counts;
}

class Solids : public testing::TestWithParam<Example> {};

TEST_P(Solids, standFreeOfFaults) {
  const Example& example = GetParam();
  const Rules rules = Rules::load(example.rules);
  ASSERT_TRUE(rules.ok()) << render(rules.diagnostics());
  FaultCounts most;
  const char* given = std::getenv("GABLE_SEEDS");
  const int seeds = given ? std::atoi(given) : example.seeds;
  for (int i = 0; i < seeds; ++i) {
    DeriveSettings settings;
    settings.seed = example.seed + i;
    settings.jobs = 2;
    settings.attributes = example.attributes;
    const Model model = derive(rules, shapesOf(example), settings);
    ASSERT_FALSE(hasErrors(model.diagnostics())) << render(model.diagnostics());
    EXPECT_GT(count(model.impl().result.scene).leaves, 3u);
    for (const auto& [what, count] : faultsOf(model.impl().result.scene, settings.seed)) {
      most[what] = std::max(most[what], count);
    }
  }
  KnownFaults known(std::string(GABLE_SOURCE_DIR) + "/tests/examples/known_faults.txt");
  EXPECT_EQ(known.complaints(), "");
  if (std::getenv("GABLE_UPDATE")) known.lower(example.name, most);
  EXPECT_EQ(known.compare(example.name, most), "");
}

INSTANTIATE_TEST_SUITE_P(All, Solids, testing::ValuesIn(examples()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace gable
