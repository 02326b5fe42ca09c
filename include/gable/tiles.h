// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A place as 3D Tiles 1.1: a folder of files that browsers stream (docs/guide/tiles.md).
//
//   gable::City city = gable::City::load("monaco.osm.pbf");
//   gable::Rules rules = gable::Rules::load("city.cga");
//   gable::writeTiles(rules, city.shapes(), "monaco/");
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gable/derive.h"
#include "gable/diagnostic.h"
#include "gable/limits.h"

namespace gable {

struct TileSettings {
  /// Limits on shapes, vertices and steps are those of a batch of shapes; seconds and the wish to
  /// stop are those of all. `trace`, `remember` and `before` have no effect.
  DeriveSettings derive;
  /// How many triangles a tile has that shows everything.
  uint64_t triangles = 65'536;
  /// Of writing.
  FileLimits limits;
};

struct TileResult {
  bool ok = false;
  /// Other than Done: tiles that were finished are there, and no tileset.
  End end = End::Done;
  DiagnosticList diagnostics;
  /// What the rules printed, tile by tile.
  std::vector<std::string> prints;
  /// Files, and levels of them.
  uint64_t tiles = 0, levels = 0;
  uint64_t shapes = 0;
  /// Of the tiles that show everything, and of the coarse ones above them.
  uint64_t triangles = 0, coarseTriangles = 0;
  /// Of all files.
  uint64_t bytes = 0;
  double deriveSeconds = 0, writeSeconds = 0;
};

/// Derives the rules on the shapes a batch at a time, and writes `folder`/tileset.json with tiles
/// in `folder`/tiles. Memory holds the shapes and a batch, never the whole place. Other files in
/// the folder stay; a tileset of another program is left alone, with an error.
TileResult writeTiles(const Rules& rules, const Shapes& shapes, const std::string& folder,
                      const TileSettings& settings = {});

}  // namespace gable
