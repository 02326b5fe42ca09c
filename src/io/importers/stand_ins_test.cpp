// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/stand_ins.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

TEST(StandIns, collisionShapesAreKnownByTheNamesOfEngines) {
  for (const char* name :
       {"UCX_Wall_00", "UBX_Wall", "Wall-colonly", "Wall_convcolonly", "Wall$colonly",
        "Wall_collision", "Wall-colonly2", "Wall-colonly.001", "Wall_collision.002"}) {
    EXPECT_TRUE(isCollisionName(name)) << name;
  }
  // Godot draws -col, and the others are words.
  for (const char* name :
       {"Wall", "Wall-col", "colonly", "Protocolonly", "ucx_wall", "", "12", "colonly1"}) {
    EXPECT_FALSE(isCollisionName(name)) << name;
  }
}

TEST(StandIns, coarserLevelsStandInForTheFinest) {
  const StandIns s({"Wall_LOD0", "Wall_LOD1", "Roof_LOD1", "_LOD0", "Door_LOD"});
  EXPECT_FALSE(s.isCoarse("Wall_LOD0"));
  EXPECT_TRUE(s.isCoarse("Wall_LOD1"));
  EXPECT_TRUE(s.isCoarse("Wall_LOD12"));
  EXPECT_FALSE(s.isCoarse("Wall"));
  EXPECT_TRUE(s.isCoarse("Wall_LOD1.001"));
  EXPECT_FALSE(s.isCoarse("UCX_Wall_00"));
  // A level alone is all that there is.
  EXPECT_FALSE(s.isCoarse("Roof_LOD1"));
  EXPECT_FALSE(s.isCoarse("_LOD1"));
  EXPECT_FALSE(s.isCoarse("Door_LOD"));
}

}  // namespace
}  // namespace gable
