// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A TIFF file as a grid of numbers, such as heights: one band of whole numbers or floating point,
// in strips or tiles, with any compression that libtiff has; and the tags of GeoTIFF, unread (OGC
// 19-008r4).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace gable {

struct TiffGrid {
  uint32_t width = 0, height = 0;
  /// Row by row as the file has them.
  std::vector<float> values;
  /// ModelPixelScale, ModelTiepoint, ModelTransformation; each may be empty.
  std::vector<double> pixelScale, tiepoints, transformation;
  /// GeoKeyDirectory, GeoDoubleParams.
  std::vector<uint16_t> geoKeys;
  std::vector<double> geoDoubles;
  /// What GDAL writes for places without a value.
  std::optional<double> noData;
};

/// Codes: heights-broken, heights-kind, heights-large (more than `most` values).
Result<TiffGrid> readTiffGrid(std::string_view bytes, uint64_t most);

}  // namespace gable
