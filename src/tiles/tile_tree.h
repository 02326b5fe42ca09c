// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The quadtree of a place: squares of the plan, divided until each shows at most so many triangles.
//
// A unit (tiles/tile_division.h) is made on its own: its shapes are derived a batch at a time, by
// square, and tiles are written as soon as nothing can change them. So in memory are the shapes of
// the unit, one batch, and what the squares on the way to it have made: tiles that may still be
// joined with their neighbours, and coarse models. A shape belongs to the square of its middle; one
// that alone has more triangles than a tile may have is divided leaf by leaf. What comes of a unit
// is a part; the tiles above units are made of parts alone.
//
// Promises: the same input gives the same files, with any number of threads. The box of a tile
// holds all that it and those below it show; the error of a tile is at least that of those below.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "io/exporters/write_model.h"
#include "tiles/coarse.h"
#include "tiles/tile_content.h"
#include "tiles/tile_division.h"
#include "tiles/tile_mesh.h"

namespace gable {

struct TileNode {
  /// Of all that is shown here and below.
  Box3 box;
  /// Metres; 0 where everything is shown.
  double error = 0;
  /// The file, from the folder of the tileset: a tile, or a tileset of its own for what is below.
  /// Empty where nothing is left of it.
  std::string uri;
  /// What it takes to show it, in triangles.
  uint64_t cost = 0;
  std::vector<TileNode> children;
  /// Levels from here down, tilesets of their own included, and nodes that stand in this one.
  uint32_t levels = 1;
  uint64_t nodes = 1;
};

/// What has come of a square and what larger ones need of it.
struct TilePart {
  /// Absent where the shapes make nothing.
  std::optional<TileNode> root;
  CoarseModel coarse;
  std::vector<TileFile> files;
  /// Pictures that tiles show, by name; other parts may show them as well.
  std::vector<TileFile> images;
  /// Bytes without those of pictures.
  uint64_t tiles = 0, bytes = 0;
  /// Of the tiles that show everything, and of the others.
  uint64_t triangles = 0, coarseTriangles = 0;
  std::vector<std::string> warnings;
};

struct TileTreeOptions {
  /// Of a tile at most, but where much stands in one place; of a coarse one as far as that can be.
  uint64_t triangles = 65'536;
  /// Shapes that are derived, and divided among squares, at a time.
  size_t batch = 512;
  /// Shapes ask about each other: all of a unit are derived at a time.
  bool together = false;
  /// A tileset with more nodes has its larger parts in files of their own.
  uint64_t mostNodes = 1000;
  unsigned threads = 0;
  TileForm form;
  /// Ends in a slash.
  std::string folder;
  TextureReader readTexture;
  /// For threads of its own; may be null.
  WorkMeter* meter = nullptr;
};

/// What a unit is made of.
class TileSource {
 public:
  virtual ~TileSource() = default;
  /// Its middle, seen from above: x and z.
  virtual Vec2 middle(size_t shape) const = 0;
  virtual TileFeature feature(size_t shape) const = 0;
  /// A scene with a root for each of the shapes, in that order. It is called by one thread.
  virtual Result<std::shared_ptr<const Scene>> derive(const std::vector<size_t>& shapes) = 0;
};

/// Writes the tiles of a unit. Codes: those of the source, and of files.
Result<TilePart> writeTileUnit(TileSource& source, const TileSquare& square, const TileUnit& unit,
                               const TileTreeOptions& options);

/// Gives the part of a unit, by its number; each is asked for once, in their order.
using TileParts = std::function<Result<TilePart>(size_t unit)>;

/// Writes the tiles above units, and gives the part of all. Codes: those of `parts`, and of files.
Result<TilePart> writeTileTop(const TileDivision& division, const TileParts& parts,
                              const TileTreeOptions& options);

/// The tileset as JSON. `transform`: from east, north, up to the Earth, column by column; empty for
/// a place that is nowhere. `folder`: where it lies itself, from that of the whole tileset.
std::string tilesetJson(const TileNode& root, const std::vector<double>& transform,
                        const std::string& folder = {});

}  // namespace gable
