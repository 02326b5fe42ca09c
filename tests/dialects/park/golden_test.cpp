// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The parks of the author's documents, E1 to E9, to the byte: what a change of the notation, of the
// analysis or of the runtime must not change. Where a change of geometry is meant, the new numbers
// stand in the message.

#include <gtest/gtest.h>

#include <string>

#include "base/hash.h"
#include "park_testing.h"

namespace gable {
namespace {

struct Golden {
  const char* name;
  std::string text;
  Shapes shapes;
  uint64_t hash;
};

TEST(ParkGolden, DocumentsMakeTheSameBytes) {
  const Shapes lot = Shapes::lot(20, 20);
  const Golden all[] = {
      {"E1", park_testing::documented("square"), lot, 0x4000fb4db98cde17},
      {"E2", park_testing::documented("circular"), Shapes::lot(40, 31), 0xc7eac836a44bc229},
      {"E3", park_testing::documented("freeform"), Shapes::lot(60, 50), 0xc4e3f722e52e314},
      {"E4", "R -> Parametrise([0.1, 0.9] [] [0.1, 0.9], Square(10))", lot, 0x9197739fef30d0e5},
      {"E5", park_testing::documented("recursive"), Shapes::lot(14, 14), 0xaf5e8522efdaf245},
      {"E6", park_testing::documented("irregular"), Shapes::lot(40, 40), 0xcd66125f9d2c4fa0},
      {"E7", park_testing::documented("cells"), Shapes::lot(51, 27), 0xab6015393313d656},
      {"E8", "Region -> grid(2, 1) { CellRegion }", lot, 0x8c4528cf0db690f0},
      {"E9", "Park -> grid(2, 1) { SubPark1 }\nSubPark1 -> grid(3,2) { ParkRegion1 }", lot,
       0x1e873adf8f06447e}};
  for (const Golden& g : all) {
    const Rules rules = Rules::parse(g.text, "document.park");
    ASSERT_TRUE(rules.ok()) << g.name << render(rules.diagnostics());
    for (const int jobs : {1, 2}) {
      DeriveSettings settings;
      settings.jobs = jobs;
      const std::string made = derive(rules, g.shapes, settings).dump();
      EXPECT_GT(made.size(), 100u) << g.name;
      EXPECT_EQ(hashBytes(made), g.hash) << g.name << ", " << jobs << " threads";
    }
  }
}

}  // namespace
}  // namespace gable
