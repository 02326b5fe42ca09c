// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable tiles, and what gable city has of it.
#pragma once

#include <string>

#include "common.h"
#include "gable/tiles.h"

struct TileArguments {
  uint64_t triangles = 65'536;
  /// Put the page that shows the tiles beside them.
  bool viewer = false;
};

struct TilesArguments {
  DeriveArguments derive;
  TileArguments tiles;
  std::string output;
  std::string stats;
};
int runTiles(const TilesArguments& arguments);

/// The folder that an output names: "monaco/", "monaco/tileset.json", a folder that is there; empty
/// when it names none.
std::string tileFolder(const std::string& output);

/// Writes tiles, prints what there is to say, and gives an exit status.
int writeTileFolder(const gable::Rules& rules, const gable::Shapes& shapes,
                    const std::string& folder, const gable::DeriveSettings& settings,
                    const TileArguments& arguments, const LimitArguments& limits,
                    gable::TileResult& result);
