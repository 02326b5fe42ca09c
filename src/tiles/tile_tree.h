// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The quadtree of a place: squares of the plan, divided until each shows at most so many triangles.
//
// Shapes are derived a batch at a time, by square, and tiles are written as soon as nothing can
// change them. So in memory are the shapes, one batch, and what the squares on the way to it have
// made: tiles that may still be joined with their neighbours, and coarse models. A shape belongs to
// the square of its middle; one that alone has more triangles than a tile may have is divided
// leaf by leaf.
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

namespace gable {

struct TileNode {
  /// Of all that is shown here and below.
  Box3 box;
  /// Metres; 0 where everything is shown.
  double error = 0;
  /// The file, from the folder of the tileset.
  std::string uri;
  uint64_t triangles = 0;
  std::vector<TileNode> children;
};

struct TileTreeOptions {
  /// Of a tile that shows everything.
  uint64_t triangles = 65'536;
  /// Shapes that are derived together, unless `together`.
  size_t batch = 512;
  /// All shapes are derived at once: the rules ask about other shapes.
  bool together = false;
  unsigned jobs = 0;
  /// Ends in a slash.
  std::string folder;
  TextureReader readTexture;
  /// For threads of its own; may be null.
  WorkMeter* meter = nullptr;
};

/// What the tree is made of.
class TileSource {
 public:
  virtual ~TileSource() = default;
  virtual size_t size() const = 0;
  /// Its middle, seen from above: x and z.
  virtual Vec2 middle(size_t shape) const = 0;
  virtual TileFeature feature(size_t shape) const = 0;
  /// A scene with a root for each of the shapes, in that order. It is called by one thread.
  virtual Result<std::shared_ptr<const Scene>> derive(const std::vector<size_t>& shapes) = 0;
};

struct TileTree {
  /// Absent where the shapes make nothing.
  std::optional<TileNode> root;
  uint64_t tiles = 0, bytes = 0;
  /// Of the tiles that show everything, and of the others.
  uint64_t triangles = 0, coarseTriangles = 0;
  std::vector<std::string> warnings;
};

/// Writes the files of all tiles. Codes: those of the source, and of files.
Result<TileTree> writeTileTree(TileSource& source, const TileTreeOptions& options);

/// The tileset as JSON. `transform`: from east, north, up to the Earth, column by column; empty for
/// a place that is nowhere.
std::string tilesetJson(const TileNode& root, const std::vector<double>& transform);

}  // namespace gable
