// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The raster is asked once for each place of a grid twice as dense as it is, which is coarser where
// a place is large. Where that lies in the
// raster is told by the projections for a wide lattice, and in between by its corners: within 300
// metres of each other these leave the truth by millimetres. Voids are filled by pulling averages
// up a pyramid and pushing them down again.
#include "io/geo/height_field.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/work.h"

namespace gable {
namespace {

// Of a place: 64 MB of heights.
constexpr double kMostPlaces = 8e6;
// Of the lattice: metres, and corners along a side.
constexpr double kLattice = 300, kMostCorners = 400;
// Around the area, in metres.
constexpr double kAround = 60;
constexpr double kFinest = 0.5, kCoarsest = 100;

struct Level {
  uint32_t columns = 0, rows = 0;
  std::vector<double> sums, weights;
};

Level halved(const Level& fine) {
  Level out{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}, {}};
  out.sums.assign(size_t{out.columns} * out.rows, 0);
  out.weights.assign(out.sums.size(), 0);
  for (uint32_t r = 0; r < fine.rows; ++r) {
    work(fine.columns);
    for (uint32_t c = 0; c < fine.columns; ++c) {
      const size_t from = size_t{r} * fine.columns + c;
      const size_t to = size_t{r / 2} * out.columns + c / 2;
      if (!(fine.weights[from] > 0)) continue;
      const double w = std::min(fine.weights[from], 1.0);
      out.sums[to] += w * fine.sums[from] / fine.weights[from];
      out.weights[to] += w;
    }
  }
  return out;
}

// Of a coarser level, all of whose places are known, at a place of the finer one.
double pulled(const Level& coarse, uint32_t c, uint32_t r) {
  const auto at = [&](double x, double y) {
    const auto i = static_cast<uint32_t>(std::clamp(x, 0.0, coarse.columns - 1.0));
    const auto k = static_cast<uint32_t>(std::clamp(y, 0.0, coarse.rows - 1.0));
    return coarse.sums[size_t{k} * coarse.columns + i];
  };
  const double x = 0.5 * c - 0.25, y = 0.5 * r - 0.25;
  const double i = std::floor(x), k = std::floor(y), u = x - i, v = y - k;
  const double low = at(i, k) + u * (at(i + 1, k) - at(i, k));
  const double high = at(i, k + 1) + u * (at(i + 1, k + 1) - at(i, k + 1));
  return low + v * (high - low);
}

}  // namespace

bool fillVoids(std::vector<double>& heights, uint32_t columns) {
  if (heights.empty() || columns == 0) return false;
  Level base{columns, static_cast<uint32_t>(heights.size() / columns), heights, {}};
  bool any = false, all = true;
  for (double& h : base.sums) {
    const bool known = std::isfinite(h);
    base.weights.push_back(known ? 1 : 0);
    if (!known) h = 0;
    any = any || known;
    all = all && known;
  }
  if (all || !any) return any;
  std::vector<Level> levels;
  levels.push_back(std::move(base));
  while (levels.back().sums.size() > 1) levels.push_back(halved(levels.back()));
  for (size_t l = levels.size(); l-- > 0;) {
    Level& level = levels[l];
    for (uint32_t r = 0; r < level.rows; ++r) {
      work(level.columns);
      for (uint32_t c = 0; c < level.columns; ++c) {
        const size_t i = size_t{r} * level.columns + c;
        const double w = std::min(level.weights[i], 1.0);
        const double own = w > 0 ? level.sums[i] / level.weights[i] : 0;
        level.sums[i] = w >= 1 ? own : w * own + (1 - w) * pulled(levels[l + 1], c, r);
      }
    }
  }
  heights = std::move(levels[0].sums);
  return true;
}

HeightField::HeightField(Vec2 origin, double step, uint32_t columns, std::vector<double> heights)
    : origin_(origin), step_(step), columns_(columns), heights_(std::move(heights)) {
  rows_ = columns > 0 ? static_cast<uint32_t>(heights_.size() / columns) : 0;
}

double HeightField::at(Vec2 p) const {
  if (heights_.empty()) return 0;
  const double x = std::clamp((p.x - origin_.x) / step_, 0.0, columns_ - 1.0);
  const double y = std::clamp((p.y - origin_.y) / step_, 0.0, rows_ - 1.0);
  const auto c = std::min(static_cast<uint32_t>(x), columns_ > 1 ? columns_ - 2 : 0);
  const auto r = std::min(static_cast<uint32_t>(y), rows_ > 1 ? rows_ - 2 : 0);
  const uint32_t right = std::min(c + 1, columns_ - 1), up = std::min(r + 1, rows_ - 1);
  const double u = x - c, v = y - r;
  const auto height = [&](uint32_t i, uint32_t k) { return heights_[size_t{k} * columns_ + i]; };
  const double low = height(c, r) + u * (height(right, r) - height(c, r));
  const double high = height(c, up) + u * (height(right, up) - height(c, up));
  return low + v * (high - low);
}

namespace {

// Where places of a box lie in a raster.
class CellLattice {
 public:
  template <class CellOf>
  CellLattice(Vec2 from, Vec2 size, CellOf&& cellOf) : from_(from) {
    step_ = std::max(kLattice, std::max(size.x, size.y) / kMostCorners);
    columns_ = static_cast<uint32_t>(size.x / step_) + 2;
    rows_ = static_cast<uint32_t>(size.y / step_) + 2;
    for (uint32_t r = 0; r < rows_; ++r) {
      for (uint32_t c = 0; c < columns_; ++c) {
        work(1024);
        corners_.push_back(cellOf(from + Vec2{c * step_, r * step_}));
      }
    }
  }
  // Nothing where a corner has no place.
  std::optional<Vec2> at(Vec2 p) const {
    const double x = (p.x - from_.x) / step_, y = (p.y - from_.y) / step_;
    const auto c = std::min(static_cast<uint32_t>(std::max(x, 0.0)), columns_ - 2);
    const auto r = std::min(static_cast<uint32_t>(std::max(y, 0.0)), rows_ - 2);
    const auto *low = &corners_[size_t{r} * columns_ + c], *high = low + columns_;
    if (!low[0] || !low[1] || !high[0] || !high[1]) return std::nullopt;
    const double u = x - c, v = y - r;
    const Vec2 a = *low[0] + (*low[1] - *low[0]) * u, b = *high[0] + (*high[1] - *high[0]) * u;
    return a + (b - a) * v;
  }

 private:
  Vec2 from_;
  double step_ = 1;
  uint32_t columns_ = 0, rows_ = 0;
  std::vector<std::optional<Vec2>> corners_;
};

}  // namespace

Result<HeightField> HeightField::of(const HeightRaster& raster, const GeoFrame& frame,
                                    const Box2& area) {
  const Vec2 size = area.size();
  const auto cellOf = [&](Vec2 p) { return raster.cellAt(frame.at(p)); };
  const Vec2 middle = area.center();
  const auto here = cellOf(middle), east = cellOf(middle + Vec2{10, 0});
  const auto north = cellOf(middle + Vec2{0, 10});
  if (!here || !east || !north) {
    return Error{"heights-place",
                 "the map's coordinates say nothing of where on the Earth it lies, so that the "
                 "heights have no place on it",
                 "give both files degrees, or both the same metres without a coordinate system"};
  }
  // Metres of a cell.
  const double density = std::max(length(*east - *here), length(*north - *here)) / 10;
  const double wide = size.x + 2 * kAround, high = size.y + 2 * kAround;
  double step = std::clamp(density > 0 ? 0.5 / density : kCoarsest, kFinest, kCoarsest);
  step = std::max(step, std::sqrt(wide * high / kMostPlaces));
  step = std::max(step, std::max(wide, high) / 1e6);
  const auto columns = static_cast<uint32_t>(std::ceil(wide / step)) + 2;
  const auto rows = static_cast<uint32_t>(std::ceil(high / step)) + 2;
  const Vec2 origin = area.min - Vec2{kAround, kAround};
  workMemory(uint64_t{columns} * rows * sizeof(double) * 4);
  std::vector<double> heights(size_t{columns} * rows);
  const CellLattice lattice(origin, {columns * step, rows * step}, cellOf);
  size_t inside = 0, missing = 0;
  for (uint32_t r = 0; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      work(16);
      const Vec2 p = origin + Vec2{c * step, r * step};
      const auto cell = lattice.at(p);
      const auto h = cell ? raster.heightAt(*cell) : std::nullopt;
      heights[size_t{r} * columns + c] = h.value_or(std::nan(""));
      if (!area.contains(p)) continue;
      ++inside;
      if (!h) ++missing;
    }
  }
  if (inside > 0 && missing == inside) {
    return Error{"heights-elsewhere", "the file of heights has none where the place lies",
                 "take the tile or the part that covers the map"};
  }
  if (!fillVoids(heights, columns)) {
    return Error{"heights-elsewhere", "the file of heights has none where the place lies",
                 "take the tile or the part that covers the map"};
  }
  HeightField out(origin, step, columns, std::move(heights));
  out.filled_ = inside > 0 ? static_cast<double>(missing) / static_cast<double>(inside) : 0;
  return out;
}

}  // namespace gable
