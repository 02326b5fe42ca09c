// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Initial shapes as what tiles are made of: derived a batch at a time, told as features.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/impl.h"
#include "gable/tiles.h"
#include "tiles/tile_tree.h"

namespace gable {

/// What batches have told, which is told once.
using Told = std::set<std::tuple<std::string, std::string, std::string>>;

/// The middle of a shape, seen from above: x and z.
Vec2 middleOf(const ShapeFootprint& f);

class ShapeSource final : public TileSource {
 public:
  /// The result takes diagnostics, prints and times. All must outlive the source.
  ShapeSource(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings, Told& told,
              TileResult& result);

  Vec2 middle(size_t shape) const override;
  TileFeature feature(size_t shape) const override;
  Result<std::shared_ptr<const Scene>> derive(const std::vector<size_t>& batch) override;

  /// Called with the shapes that are done, of those of this source.
  void showProgress(std::function<void(size_t)> progress) { progress_ = std::move(progress); }

 private:
  void seedsOf(const std::vector<size_t>& batch, DeriveSettings& settings) const;
  void take(const Model& model);

  const Rules& rules_;
  const Shapes& shapes_;
  DeriveSettings settings_;
  Told& told_;
  TileResult& result_;
  double begin_;
  size_t done_ = 0;
  std::function<void(size_t)> progress_;
};

TileForm formOf(const TileSettings& settings);

/// Of a tile.
uint64_t mostTriangles(const TileSettings& settings);

/// How a unit is written: as the settings say, with the pictures of the rules.
TileTreeOptions tileOptions(const Rules& rules, const TileSettings& settings,
                            const std::string& folder);

/// Shapes of a unit. Rules that ask about other shapes need all at once: 0.
size_t unitShapes(const Rules& rules);

/// The warning where all shapes are one unit.
void warnTogether(DiagnosticList& diagnostics);

/// The error for tiles that cannot be: compressed where the build cannot, or of another form.
std::optional<Error> formMistake(const TileSettings& settings);

void fail(TileResult& result, const Error& e);

/// Counts of the whole, and what there is to say of it.
void takeCounts(const TilePart& all, TileResult& result);

}  // namespace gable
