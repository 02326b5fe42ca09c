// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Coarse models: what a place looks like from far away, made of what the rules made of it.
//
// A model is a list of parts: a leaf, or a box that stands for many small ones. coarsened() makes a
// model with a tolerance of a model with a smaller one:
//   1. Parts narrower than the tolerance that lie on a larger part of their feature go; the larger
//      one takes on their colour by area (windows, cornices, tiles). Large parts of one colour keep
//      one.
//   2. Those that cover a plane together become plates of their mean colour (tiles/plates.h): the
//      strips and panels of a facade.
//   3. Of the others, those beside a large part or a plate go as in 1. Short ones become boxes,
//      where they stand close together, a cell of the tolerance each (the crowns of trees); single
//      ones go. Long ones become sheets (lamps, rails), down to an eighth of the tolerance: viewers
//      change to a finer tile before an error covers sixteen pixels, so thinner ones cover less
//      than two.
//   4. Corners in one cell of half the tolerance become one, and triangles without area go.
//   5. Where that is asked for, holes through which one would look into a house are covered, and
//      parts look like what one sees in their place (tiles/closing.h).
// `error` is what that came to, in metres: how far what was moved or left out is from what is
// shown, or how long it is where nothing near it is shown. It bounds how far points of the full
// model are from the coarse one, other than those of things narrower than an eighth of it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tiles/finish.h"
#include "tiles/tile_content.h"

namespace gable {

struct CoarsePart {
  /// Index into CoarseModel::features; ascending.
  uint32_t feature = 0;
  Finish finish;
  /// Square metres, the weight of its look.
  double area = 0;
  /// The box of the part, in a frame that fits it.
  Frame frame;
  Box3 box;
  /// Ranges of CoarseModel::triangles and vertices; both empty for what is small.
  uint32_t firstVertex = 0, vertexCount = 0;
  uint32_t firstTriangle = 0, triangleCount = 0;
  /// Whether it stays while it is narrower than the tolerance, as the windows beside it do
  /// (tiles/panels.h).
  bool isPanel = false;
};

struct CoarseModel {
  std::vector<TileFeature> features;
  std::vector<CoarsePart> parts;
  std::vector<Vec3> vertices;
  /// Count from the part's first vertex.
  std::vector<std::array<uint32_t, 3>> triangles;
  double error = 0;

  void append(CoarseModel&& other);
};

/// What a material looks like from far away.
using FinishOf = std::function<Finish(const Material&)>;

/// The parts of a tile; those narrower than `tolerance` without their triangles.
CoarseModel partsOf(const TileContent& content, double tolerance, const FinishOf& finishOf);

/// O(n log n) in the parts, times how many large ones a feature has in the worst case. Where `seen`
/// is given, a model of the same features, holes are closed and looks are those that one sees of it
/// (tiles/closing.h): that takes about as long as all else.
CoarseModel coarsened(const CoarseModel& model, double tolerance,
                      const CoarseModel* seen = nullptr);

}  // namespace gable
