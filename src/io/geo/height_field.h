// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The natural ground of a place: heights over its plan. Plan coordinates and heights, metres.
//
// Promises: every place of the plan has a finite height; some metres beyond the area it is that of
// the nearest place of the grid's border. What a file does not know is filled from what is around
// it, smoothly. Equal input gives equal output.
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "io/geo/height_raster.h"
#include "math/box.h"
#include "shape/geo_frame.h"

namespace gable {

class HeightField {
 public:
  /// A square grid whose first height lies at `origin`; row by row to the north, finite.
  HeightField(Vec2 origin, double step, uint32_t columns, std::vector<double> heights);

  /// Of the area and some metres around it. Codes: heights-elsewhere (the file has no height in the
  /// area), heights-place (the map's coordinates cannot be turned into the file's).
  static Result<HeightField> of(const HeightRaster& raster, const GeoFrame& frame,
                                const Box2& area);

  /// Bilinear.
  double at(Vec2 p) const;
  /// Metres from one height to the next.
  double step() const { return step_; }
  /// The share of the area that was filled.
  double filled() const { return filled_; }

 private:
  Vec2 origin_;
  double step_ = 1;
  uint32_t columns_ = 0, rows_ = 0;
  std::vector<double> heights_;
  double filled_ = 0;
};

/// Replaces what is not finite, from coarser and coarser grids; false where nothing is finite.
/// S. J. Gortler et al., "The Lumigraph" (1996), section 3.4. O(n).
bool fillVoids(std::vector<double>& heights, uint32_t columns);

}  // namespace gable
