// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/stand_ins.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(StandIns, collisionShapesAreKnownByTheNamesOfEngines) {
  for (const char* name : {"UCX_Wall_00", "UBX_Wall", "Wall-colonly", "Wall_convcolonly",
                           "Wall$colonly", "Wall_collision"}) {
    EXPECT_TRUE(isCollisionName(name)) << name;
  }
  // Godot draws -col, and the others are words.
  for (const char* name : {"Wall", "Wall-col", "colonly", "Protocolonly", "ucx_wall", ""}) {
    EXPECT_FALSE(isCollisionName(name)) << name;
  }
}

TEST(StandIns, coarserLevelsStandInForTheFinest) {
  const StandIns s({"Wall_LOD0", "Wall_LOD1", "Roof_LOD1", "_LOD0", "Door_LOD"});
  EXPECT_FALSE(s.contains("Wall_LOD0"));
  EXPECT_TRUE(s.contains("Wall_LOD1"));
  EXPECT_TRUE(s.contains("Wall_LOD12"));
  EXPECT_FALSE(s.contains("Wall"));
  // A level alone is all that there is.
  EXPECT_FALSE(s.contains("Roof_LOD1"));
  EXPECT_FALSE(s.contains("_LOD1"));
  EXPECT_FALSE(s.contains("Door_LOD"));
}

}  // namespace
}  // namespace gable
