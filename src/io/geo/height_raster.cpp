// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The cubic is that of Catmull and Rom (1974) along rows, then along columns, held between the four
// values around the place, so that neither a cliff nor a void makes the ground swing beyond it.
#include "io/geo/height_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/files.h"
#include "base/text.h"
#include "base/work.h"
#include "io/geo/transverse_mercator.h"
#include "io/image/tiff_grid.h"

namespace gable {
namespace {

// Of one file: 512 MB of them.
constexpr uint64_t kMostHeights = uint64_t{1} << 27;
// No ground is farther from the level of the sea than this, in metres.
constexpr float kHighest = 20'000;
constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;
constexpr double kUtmScale = 0.9996, kFalseEasting = 5e5, kFalseNorthing = 1e7;

enum GeoKey : uint16_t {
  kModelType = 1024,
  kRasterType = 1025,
  kGeographicType = 2048,
  kProjectedType = 3072,
  kLinearUnits = 3076,
  kVerticalUnits = 4099,
};

// Of the directory: those whose value stands in it.
std::optional<int> keyOf(const TiffGrid& g, GeoKey key) {
  for (size_t i = 4; i + 3 < g.geoKeys.size(); i += 4) {
    if (g.geoKeys[i] == key && g.geoKeys[i + 1] == 0) return g.geoKeys[i + 3];
  }
  return std::nullopt;
}

Error placeless(const std::string& path) {
  return {"heights-place", "'" + path + "' does not say where its heights lie",
          "give it a place: gdal_translate -a_srs EPSG:4326 -a_ullr WEST NORTH EAST SOUTH"};
}

bool allFinite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

// From columns and rows, counted from the corner of the first value, to coordinates.
std::optional<std::array<double, 6>> placementOf(const TiffGrid& g) {
  if (!allFinite(g.transformation) || !allFinite(g.pixelScale) || !allFinite(g.tiepoints)) {
    return std::nullopt;
  }
  const auto& t = g.transformation;
  if (t.size() == 16) return std::array<double, 6>{t[0], t[1], t[3], t[4], t[5], t[7]};
  const auto &s = g.pixelScale, &p = g.tiepoints;
  if (s.size() < 2 || p.size() < 6) return std::nullopt;
  return std::array<double, 6>{s[0], 0, p[3] - s[0] * p[0], 0, -s[1], p[4] + s[1] * p[1]};
}

std::optional<std::array<double, 6>> inverted(const std::array<double, 6>& m) {
  const double d = m[0] * m[4] - m[1] * m[3];
  if (!(std::fabs(d) > 1e-300) || !std::isfinite(1 / d)) return std::nullopt;
  const double a = m[4] / d, b = -m[1] / d, c = -m[3] / d, e = m[0] / d;
  return std::array<double, 6>{a, b, -(a * m[2] + b * m[5]), c, e, -(c * m[2] + e * m[5])};
}

// Columns and rows of a tile of SRTM, by its size; 0: it is none.
uint32_t sideOf(size_t bytes) {
  for (const uint32_t side : {1201u, 3601u}) {
    if (bytes == size_t{2} * side * side) return side;
  }
  return 0;
}

// "N43E007": the corner in the south-west, in degrees.
std::optional<Vec2> cornerOf(const std::string& name) {
  if (name.size() < 7) return std::nullopt;
  const auto digits = [&](size_t from, size_t count) -> std::optional<int> {
    int value = 0;
    for (size_t i = from; i < from + count; ++i) {
      if (name[i] < '0' || name[i] > '9') return std::nullopt;
      value = 10 * value + (name[i] - '0');
    }
    return value;
  };
  const char ns = static_cast<char>(name[0] & ~0x20), ew = static_cast<char>(name[3] & ~0x20);
  const auto north = digits(1, 2), east = digits(4, 3);
  if (!north || !east || (ns != 'N' && ns != 'S') || (ew != 'E' && ew != 'W')) return std::nullopt;
  if (*north > 90 || *east > 180) return std::nullopt;
  return Vec2{ew == 'W' ? -*east : *east * 1.0, ns == 'S' ? -*north : *north * 1.0};
}

double cubic(const double* v, double t) {
  return v[1] +
         0.5 * t *
             (v[2] - v[0] +
              t * (2 * v[0] - 5 * v[1] + 4 * v[2] - v[3] + t * (3 * (v[1] - v[2]) + v[3] - v[0])));
}

}  // namespace

Result<HeightRaster> HeightRaster::ofTiff(std::string_view bytes, const std::string& path) {
  Result<TiffGrid> grid = readTiffGrid(bytes, kMostHeights);
  if (!grid.ok()) {
    return Error{grid.error().code, "'" + path + "': " + grid.error().message, grid.error().hint};
  }
  HeightRaster out;
  const int model = keyOf(*grid, kModelType).value_or(0);
  const int geographic = keyOf(*grid, kGeographicType).value_or(4326);
  const int projected = keyOf(*grid, kProjectedType).value_or(0);
  const int series = projected / 100, zone = projected % 100;
  const bool isUtm = (series == 326 || series == 327 || series == 258) && zone >= 1 && zone <= 60;
  const bool isMetre = keyOf(*grid, kLinearUnits).value_or(9001) == 9001;
  if (model == 2 && (geographic == 4326 || geographic == 4258 || geographic == 4269)) {
    out.system_ = System::Degrees;
  } else if (model == 1 && isUtm && isMetre) {
    out.system_ = System::Utm;
    out.zone_ = zone;
    out.south_ = series == 327;
  } else if (model != 0) {
    const int code = model == 1 ? projected : geographic;
    return Error{"heights-projection",
                 "the heights of '" + path + "' lie in a coordinate system that is not read" +
                     (code > 0 ? " (EPSG:" + std::to_string(code) + ")" : std::string()),
                 "project them to degrees: gdalwarp -t_srs EPSG:4326 heights.tif degrees.tif"};
  }
  auto placement = placementOf(*grid);
  if (!placement) return placeless(path);
  // Heights of areas stand for their middles.
  if (keyOf(*grid, kRasterType).value_or(1) != 2) {
    (*placement)[2] += 0.5 * ((*placement)[0] + (*placement)[1]);
    (*placement)[5] += 0.5 * ((*placement)[3] + (*placement)[4]);
  }
  const auto toCell = inverted(*placement);
  if (!toCell) return placeless(path);
  out.toCell_ = *toCell;
  const int units = keyOf(*grid, kVerticalUnits).value_or(9001);
  const double factor = units == 9002 ? kFoot : units == 9003 ? kSurveyFoot : 1;
  out.width_ = grid->width;
  out.height_ = grid->height;
  out.values_ = std::move(grid->values);
  // A mark that no float holds is of values that were read as voids already.
  const bool marked = grid->noData && std::fabs(*grid->noData) <= std::numeric_limits<float>::max();
  const float missing = marked ? static_cast<float>(*grid->noData) : kVoid;
  for (float& v : out.values_) {
    v = marked && v == missing ? kVoid : static_cast<float>(v * factor);
    if (!(std::fabs(v) <= kHighest)) v = kVoid;
  }
  return out;
}

Result<HeightRaster> HeightRaster::ofHgt(std::string_view bytes, const std::string& path) {
  const uint32_t side = sideOf(bytes.size());
  if (side == 0) {
    return Error{"heights-broken",
                 "'" + path + "' is no tile of SRTM: it has " + std::to_string(bytes.size()) +
                     " bytes, not 2 x 1201 x 1201 or 2 x 3601 x 3601",
                 "unpack it first, or give a GeoTIFF"};
  }
  const size_t slash = path.find_last_of("/\\");
  const auto corner = cornerOf(slash == std::string::npos ? path : path.substr(slash + 1));
  if (!corner) {
    return Error{"heights-name", "the name of '" + path + "' does not say where its heights lie",
                 "name it by its corner in the south-west, such as N43E007.hgt"};
  }
  HeightRaster out;
  out.width_ = out.height_ = side;
  out.system_ = System::Degrees;
  const double scale = side - 1;
  out.toCell_ = {scale, 0, -corner->x * scale, 0, -scale, (corner->y + 1) * scale};
  workMemory(uint64_t{side} * side * sizeof(float));
  out.values_.resize(size_t{side} * side);
  for (size_t i = 0; i < out.values_.size(); ++i) {
    const auto high = static_cast<uint8_t>(bytes[2 * i]);
    const auto low = static_cast<uint8_t>(bytes[2 * i + 1]);
    const auto v = static_cast<int16_t>(static_cast<uint16_t>(high << 8 | low));
    out.values_[i] = v == INT16_MIN ? kVoid : v;
  }
  return out;
}

Result<HeightRaster> HeightRaster::read(std::string_view bytes, const std::string& path) {
  const std::string extension = extensionOf(path);
  const bool isTiff = extension == "tif" || extension == "tiff";
  if (!isTiff && extension != "hgt") {
    return Error{
        "heights-unknown", "'" + path + "' is no file of heights that can be read",
        "use a GeoTIFF (.tif) or a tile of SRTM (.hgt); others become one by gdal_translate "
        "-a_srs EPSG:4326 '" +
            path + "' heights.tif, with the system that their numbers are in"};
  }
  Result<HeightRaster> out = isTiff ? ofTiff(bytes, path) : ofHgt(bytes, path);
  if (!out.ok()) return out;
  const bool any = std::any_of(out->values_.begin(), out->values_.end(),
                               [](float v) { return std::isfinite(v); });
  if (!any) return Error{"heights-empty", "'" + path + "' has no height at all", {}};
  return out;
}

std::optional<Vec2> HeightRaster::cellAt(const GeoPlace& place) const {
  Vec2 at{place.x, place.y};
  if (system_ != System::Own) {
    if (!place.degrees) return std::nullopt;
    at = {place.degrees->longitude, place.degrees->latitude};
  }
  if (system_ == System::Utm) {
    const TransverseMercator zone({6.0 * zone_ - 183, 0});
    at = zone.forward({at.x, at.y}) * kUtmScale + Vec2{kFalseEasting, south_ ? kFalseNorthing : 0};
  }
  const auto& m = toCell_;
  Vec2 cell{m[0] * at.x + m[1] * at.y + m[2], m[3] * at.x + m[4] * at.y + m[5]};
  if (!std::isfinite(cell.x) || !std::isfinite(cell.y)) return std::nullopt;
  return cell;
}

bool HeightRaster::known(double column, double row, float& out) const {
  if (!(column >= 0) || !(row >= 0) || !(column < width_) || !(row < height_)) return false;
  out = values_[static_cast<size_t>(row) * width_ + static_cast<size_t>(column)];
  return std::isfinite(out);
}

std::optional<double> HeightRaster::heightAt(Vec2 cell) const {
  // Half a cell around the outermost heights is theirs.
  if (!(cell.x >= -0.5 && cell.y >= -0.5 && cell.x <= width_ - 0.5 && cell.y <= height_ - 0.5)) {
    return std::nullopt;
  }
  cell = {std::clamp(cell.x, 0.0, width_ - 1.0), std::clamp(cell.y, 0.0, height_ - 1.0)};
  const double c = std::min(std::floor(cell.x), std::max(0.0, width_ - 2.0));
  const double r = std::min(std::floor(cell.y), std::max(0.0, height_ - 2.0));
  const double u = cell.x - c, v = cell.y - r;
  double rows[4];
  bool wide = true;
  double low = std::numeric_limits<double>::infinity(), high = -low, inner[2][2];
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      float h = 0;
      if (!known(std::min(c + k, width_ - 1.0), std::min(r + i, height_ - 1.0), h)) {
        return std::nullopt;
      }
      inner[i][k] = h;
      low = std::min(low, inner[i][k]);
      high = std::max(high, inner[i][k]);
    }
  }
  for (int i = 0; i < 4 && wide; ++i) {
    double line[4];
    for (int k = 0; k < 4 && wide; ++k) {
      float h = 0;
      wide = known(c + k - 1, r + i - 1, h);
      line[k] = h;
    }
    if (wide) rows[i] = cubic(line, u);
  }
  if (wide) return std::clamp(cubic(rows, v), low, high);
  const double top = inner[0][0] + u * (inner[0][1] - inner[0][0]);
  const double bottom = inner[1][0] + u * (inner[1][1] - inner[1][0]);
  return top + v * (bottom - top);
}

}  // namespace gable
