// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The examples that help and man pages show. A test runs each of them.

#include "describe.h"

namespace {

struct Example {
  const char* command;
  const char* line;
};

constexpr Example kExamples[] = {
    {"generate", "gable generate house.cga --lot 24x18 -o house.glb"},
    {"generate", "gable generate house.cga --shapes lots.geojson --set height=12 -o town.glb"},
    {"generate", "gable generate house.cga --reports - -o house.obj"},
    {"generate", "gable generate house.cga --count 3 -o variant.glb"},
    {"city", "gable city map.geojson -o place.glb"},
    {"city", "gable city map.geojson --plan ground.geojson --stats -"},
    {"tiles", "gable tiles house.cga --shapes lots.geojson -o tiles"},
    {"tiles plan", "gable tiles plan house.cga --shapes lots.geojson -o land"},
    {"tiles job", "gable tiles job land 0"},
    {"tiles merge", "gable tiles merge land --mend"},
    {"tiles submit", "gable tiles submit land --parallel --dry-run"},
    {"tiles join", "gable tiles join country/east country/west -o country"},
    {"tiles viewer", "gable tiles viewer tiles"},
    {"check", "gable check house.cga"},
    {"check", "gable check --json rules/*.cga"},
    {"info", "gable info house.cga"},
    {"new", "gable new my-house"},
    {"pack", "gable pack house.cga -o house.rpk"},
    {"format", "gable format house.cga"},
    {"format", "gable format --check rules/*.cga"},
    {"convert", "gable convert house.gbbg -o converted.cga"},
    {"render", "gable render house.cga --lot 24x18 -o house.png"},
    {"render", "gable render house.glb --view front --size 640x360 --samples 16 -o front.png"},
    {"render", "gable render house.glb --style ink --size 640x360 -o drawn.png"},
    {"render",
     "gable render house.glb --sun-at 48.86,2.35,2024-06-21,19:30 --size 320x180 --samples 8 -o "
     "evening.png"},
    {"dataset", "gable dataset house.cga --lot 24x18 --count 2 --size 128x128 -o houses"},
    {"watch", "gable watch house.cga --lot 24x18 -o house.png"},
    {"watch", "gable watch house.cga --shapes lots.geojson -o town.glb"},
    {"trace", "gable trace house.cga --rule Roof -o roofs.json"},
    {"asset prepare", "gable asset prepare door.glb --size 1,2.1,0.2 -o prepared.glb"},
    {"asset material", "gable asset material"},
    {"asset material", "gable asset material brick.flemish -o bricks"},
    {"ops", "gable ops split"},
    {"ops", "gable ops --json"},
    {"lsp", "gable lsp"},
    {"diff", "gable diff before.glb after.glb -o changed.png"},
    {"test", "gable test"},
    {"test", "gable test tests --format junit -o results.xml"},
    {"studio", "gable studio my-folder"},
    {"completion", "gable completion bash > gable.bash"},
    {"man", "gable man generate"},
    {"man", "gable man -o pages"},
};

}  // namespace

std::vector<std::string> examplesOf(const std::string& command) {
  std::vector<std::string> out;
  for (const Example& example : kExamples) {
    if (command == example.command) out.emplace_back(example.line);
  }
  return out;
}
