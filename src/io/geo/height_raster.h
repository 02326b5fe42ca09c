// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Heights of a file: a GeoTIFF (OGC 19-008r4) or a tile of SRTM (.hgt), as a grid in the file's own
// coordinates. Heights are metres.
//
// Read of GeoTIFF: degrees on WGS 84 (EPSG:4326; 4258 and 4269 differ by less than a few metres),
// UTM (326xx, 327xx, 258xx), or no coordinate system, which stands for the map's own metres;
// ModelPixelScale with a tiepoint, or ModelTransformation; areas and points; vertical units of
// metres and feet.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "math/vec.h"
#include "shape/geo_frame.h"

namespace gable {

class HeightRaster {
 public:
  /// By extension: .tif .tiff .hgt; the name of an .hgt says where it lies, such as N43E007.hgt.
  /// Codes: heights-unknown, heights-broken, heights-kind, heights-large, heights-name,
  /// heights-place, heights-projection, heights-empty.
  static Result<HeightRaster> read(std::string_view bytes, const std::string& path);

  /// Columns and rows of a place, counted from the middle of the first value; nothing where it
  /// cannot be told.
  std::optional<Vec2> cellAt(const GeoPlace& place) const;
  /// Nothing outside, and where the file has no height. Bicubic, and never beyond the four heights
  /// around the place; bilinear beside places without a height.
  std::optional<double> heightAt(Vec2 cell) const;
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }

 private:
  enum class System : uint8_t { Degrees, Utm, Own };

  static Result<HeightRaster> ofTiff(std::string_view bytes, const std::string& path);
  static Result<HeightRaster> ofHgt(std::string_view bytes, const std::string& path);
  bool known(double column, double row, float& out) const;

  uint32_t width_ = 0, height_ = 0;
  /// Row by row from the first; not a number where there is no height.
  std::vector<float> values_;
  System system_ = System::Own;
  /// Of UTM: the zone, and whether it counts from the equator southwards.
  int zone_ = 0;
  bool south_ = false;
  /// From coordinates of the system to columns and rows: x' = m[0] x + m[1] y + m[2].
  std::array<double, 6> toCell_{};
};

}  // namespace gable
