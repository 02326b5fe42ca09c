// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a tile shows, before it is written: leaves of scenes where they stand, each with the thing
// that it is part of. Metres, y up, the frame of the whole place.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "geom/mesh/face_triangles.h"
#include "scene/scene.h"

namespace gable {

/// What a viewer picks: all that one initial shape became. Part of it may lie in another tile.
struct TileFeature {
  std::string id;
  /// The name of the initial shape: in cities the rule that it began with.
  std::string shape;
  /// What the map calls it, and what it is: the value of its first tag of those that say so.
  std::string name, type;
  /// NaN where nobody knows.
  double levels = std::numeric_limits<double>::quiet_NaN();
  /// All attributes of the shape as a JSON object.
  std::string attributes;
  /// From its lowest to its highest point.
  double height = 0;
  /// The middle of the shape seen from above, x and z; the one by which it belongs to a tile.
  Vec2 middle;
};

/// A part that its scene shows several times, where it stands once: the leaves that name it, which
/// are all that the prototype has.
struct TilePlacement {
  /// Index into TileContent::scenes, and of a prototype of that scene.
  uint32_t scene = 0, prototype = 0;
  /// Index into TileContent::features.
  uint32_t feature = 0;
  Frame world;
};

struct TileLeaf {
  static constexpr uint32_t kNone = 0xffffffff;
  /// Index into TileContent::scenes, and of a leaf of that scene.
  uint32_t scene = 0, leaf = 0;
  /// Index into TileContent::features; ascending from leaf to leaf.
  uint32_t feature = 0;
  /// An upper bound.
  uint32_t triangles = 0;
  /// Index into TileContent::placements, or kNone.
  uint32_t placement = kNone;
  /// Of the leaf's mesh, its own frame included.
  Frame world;
};

struct TileContent {
  std::vector<std::shared_ptr<const Scene>> scenes;
  std::vector<TileFeature> features;
  std::vector<TileLeaf> leaves;
  std::vector<TilePlacement> placements;
  /// What the leaves cost, in triangles, an upper bound: the bytes of a part that is placed several
  /// times are there once, so that each further time counts as an eighth.
  uint64_t triangles = 0;

  /// Takes over what another one shows.
  void append(TileContent&& other);
  /// Sums up `triangles`.
  void measure();
};

/// What it costs to show so many triangles so many times.
uint64_t costOf(uint64_t triangles, uint64_t times);

/// Placements of one prototype, by number.
struct TileGroup {
  uint32_t scene = 0, prototype = 0;
  std::vector<uint32_t> placements;
};
/// Parts to be held once and placed several times, as that saves more than another draw call costs.
std::vector<TileGroup> groupsOf(const TileContent& content);

/// The box of a leaf's mesh in the frame of the leaf, and the second largest side of it: what is
/// narrower than that has no width that can be seen.
Box3 localBox(const Scene& scene, const Leaf& leaf);
double widthOf(const Box3& box);

}  // namespace gable
