// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/plates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "base/work.h"
#include "tiles/depth_image.h"
#include "tiles/sheets.h"

namespace gable {
namespace {

// Longer parts would fill too many cells.
constexpr double kMostCells = 1024;
// A cell is full that is covered so far, and needs no plate where large parts cover so much.
constexpr double kFull = 0.5, kShown = 7.0 / 8;
// Of the colours of a plate, each of three.
constexpr double kAlike = 0.12;
// Cells of a plate along each of its sides: what turns out to be shown was looked through in vain.
constexpr int64_t kLongest = 128;
// A large part is brought before a plate that would hide so much of it.
constexpr double kHidden = 0.25;
// A rectangle has at least such a share of cells that need it.
constexpr double kNeeded = 0.25;
// Large parts farther behind or before are not of the wall, such as the fronts of dormers: a share
// of the tolerance, and metres.
constexpr double kReveal = 0.25, kLeastReveal = 0.25;

// What covers less of its rectangle has an outline, if it is as long as so many cells; these have
// so many samples along a side. No larger ones are sampled.
constexpr double kSolid = 0.9, kSmall = 1.5, kSamples = 4, kMostSampled = 4096;

struct WallSheet : Sheet {
  /// Into the narrow or the large parts.
  size_t number = 0;
  bool isLarge = false;
};

// What a cell needs: nothing, as it is not full; nothing, as large parts show it; a plate.
enum class Kind : uint8_t { Empty, Shown, Needed };

// Covered shares of a cell.
struct Cover {
  double narrow = 0, large = 0;
  /// Of what a plate shows here, and here and in the cells around.
  Tint tint;
  Finish around;
  /// How far what covers it reaches, in the plane.
  Box2 reach;
  Kind kind = Kind::Empty;
  /// Of a rectangle.
  bool isOwned = false;
};

using Cell = std::pair<int64_t, int64_t>;

// The sheets of one plane.
class PlaneGrid {
 public:
  PlaneGrid(const CoarseModel& model, std::span<const WallSheet> sheets, double tolerance)
      : model_(model), sheets_(sheets), tolerance_(tolerance) {}

  void run(Plates& out) {
    main_ = largestNarrow();
    if (!main_) return;
    chooseFrame();
    measure();
    if (!isWide()) return;
    coverCells();
    judgeCells();
    findRectangles();
    emit(out);
  }

 private:
  // The largest narrow one, whose axes the grid has; null where all are large parts.
  const WallSheet* largestNarrow() const {
    const WallSheet* out = nullptr;
    double most = -1;
    for (const WallSheet& s : sheets_) {
      const double area = faceArea(partOf(s).box);
      if (s.isLarge || !(area > most)) continue;
      most = area;
      out = &s;
    }
    return out;
  }

  const CoarsePart& partOf(const WallSheet& s) const { return model_.parts[s.part]; }

  // That of the largest narrow part.
  void chooseFrame() {
    double facing = 0;
    for (const WallSheet& s : sheets_) facing += facingOf(model_, s);
    frame_ = frameOf(model_, *main_, facing);
  }

  Box3 inPlane(const CoarsePart& p) const {
    Box3 box;
    for (const Vec3& c : cornersOf(p)) box.include(frame_.toLocal(c));
    return box;
  }

  // How far narrow parts reach, and the plane that most of them lie in.
  void measure() {
    double weight = 0;
    std::vector<std::pair<double, double>> depths;
    for (const WallSheet& s : sheets_) {
      if (s.isLarge) continue;
      const CoarsePart& p = partOf(s);
      const Box3 box = inPlane(p);
      reach_.include(box.min);
      reach_.include(box.max);
      const double area = weightOf(p.box);
      weight += area;
      depths.emplace_back(box.center().z, area);
    }
    depth_ = medianOf(std::move(depths), weight);
    const Vec3 size = reach_.size();
    for (size_t i = 0; i < 2; ++i) {
      count_[i] = std::clamp(std::round(size[i] / tolerance_), 1.0, 1e15);
      side_[i] = size[i] / count_[i];
    }
  }

  static double medianOf(std::vector<std::pair<double, double>> weighted, double whole) {
    std::sort(weighted.begin(), weighted.end());
    double below = 0;
    for (const auto& [value, weight] : weighted) {
      below += weight;
      if (below >= whole / 2) return value;
    }
    return weighted.back().first;
  }

  bool isInWall(const WallSheet& s) const {
    if (!s.isLarge) return true;
    const double away = inPlane(partOf(s)).center().z - depth_;
    return std::abs(away) <= kReveal * tolerance_ + kLeastReveal;
  }

  bool isWide() const {
    const Vec3 size = reach_.size();
    return std::isfinite(size.x + size.y) && std::min(size.x, size.y) >= tolerance_;
  }

  // From the front to the back: sheets are in the order in which they lie.
  void coverCells() {
    const bool isLastFirst = dot(frame_.z, main_->normal) > 0;
    for (size_t i = 0; i < sheets_.size(); ++i) {
      const WallSheet& s = sheets_[isLastFirst ? sheets_.size() - 1 - i : i];
      if (isInWall(s)) cover(s);
    }
  }

  // What lies before a sheet hides it where it fills the cell; in others they lie side by side.
  void cover(const WallSheet& s) {
    forEachCell(s, [&](const Cell& at, double share, const Box2& reach) {
      Cover& cell = cells_[at];
      cell.reach.include(reach.min);
      cell.reach.include(reach.max);
      const double seen = std::min(share, std::max(1 - cell.narrow - cell.large, 0.0));
      (s.isLarge ? cell.large : cell.narrow) += share;
      if (!s.isLarge) cell.tint.add(partOf(s).finish, seen);
    });
  }

  // The cells under a sheet, each with the share that it covers.
  template <class Visit>
  void forEachCell(const WallSheet& s, const Visit& visit) const {
    const CoarsePart& p = partOf(s);
    const Box3 box = inPlane(p);
    const Vec3 size = box.size();
    const double whole = size.x * size.y;
    if (!(whole > 0)) return;
    const double filled =
        std::min(1.0, (p.triangleCount > 0 ? shownOf(model_, p) : faceArea(p.box)) / whole);
    std::array<double, 2> from{}, to{};
    for (size_t i = 0; i < 2; ++i) {
      from[i] = std::max((box.min[i] - reach_.min[i]) / side_[i], 0.0);
      to[i] = std::min((box.max[i] - reach_.min[i]) / side_[i], count_[i]);
      if (!(to[i] > from[i]) || to[i] - from[i] > kMostCells) return;
    }
    // A gable has an outline that is seen; what is small or turned covers the same share of its
    // rectangle everywhere.
    const double wide = to[0] - from[0], high = to[1] - from[1];
    if (filled < kSolid && std::max(wide, high) >= kSmall && wide * high <= kMostSampled &&
        p.triangleCount > 0) {
      return forEachSampled(p, box, visit);
    }
    for (double x = std::floor(from[0]); x < to[0]; ++x) {
      for (double y = std::floor(from[1]); y < to[1]; ++y) {
        work();
        const Vec2 first{std::max(from[0], x), std::max(from[1], y)};
        const Vec2 last{std::min(to[0], x + 1), std::min(to[1], y + 1)};
        const Cell cell{static_cast<int64_t>(y), static_cast<int64_t>(x)};
        Box2 reach;
        for (const Vec2& end : {first, last}) {
          reach.include({reach_.min.x + side_[0] * end.x, reach_.min.y + side_[1] * end.y});
        }
        visit(cell, filled * (last.x - first.x) * (last.y - first.y), reach);
      }
    }
  }

  // The same by samples of its triangles.
  template <class Visit>
  void forEachSampled(const CoarsePart& p, Box3 box, const Visit& visit) const {
    for (size_t i = 0; i < 2; ++i) {
      box.min[i] = std::max(box.min[i], reach_.min[i]);
      box.max[i] = std::min(box.max[i], reach_.max[i]);
    }
    const double side = std::min(side_[0], side_[1]) / kSamples;
    DepthImage image(frame_, box, side);
    image.add(model_, p);
    std::map<Cell, std::pair<double, Box2>> shares;
    const double each = side * side / (side_[0] * side_[1]);
    for (int64_t y = 0; y < image.height(); ++y) {
      work(static_cast<size_t>(image.width()));
      for (int64_t x = 0; x < image.width(); ++x) {
        if (!image.at(x, y).part) continue;
        const Vec2 middle =
            image.cornerAt(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
        const Cell cell{cellAt(1, middle.y), cellAt(0, middle.x)};
        auto& [share, reach] = shares[cell];
        share += each;
        reach.include(middle);
      }
    }
    for (const auto& [cell, found] : shares) {
      visit(cell, std::min(found.first, 1.0), found.second);
    }
  }

  static Kind kindOf(const Cover& c) {
    if (c.narrow + c.large < kFull) return Kind::Empty;
    return c.large >= kShown || !(c.narrow > 0) ? Kind::Shown : Kind::Needed;
  }

  // Once a cell: rectangles ask for it many times.
  void judgeCells() {
    for (auto& [at, c] : cells_) {
      work();
      c.kind = kindOf(c);
      if (c.kind == Kind::Needed) c.around = finishAround(at);
    }
  }

  struct Rectangle {
    int64_t x = 0, y = 0, width = 0, height = 0;
  };

  // First also across what large parts show, where enough of it needs a plate; then what is left.
  void findRectangles() {
    for (const auto& [at, c] : cells_) {
      work();
      if (c.kind != Kind::Needed || c.isOwned) continue;
      const Rectangle whole = grown(at, Kind::Shown);
      claim(shareOf(whole) >= kNeeded ? whole : grown(at, Kind::Needed));
    }
  }

  // The mean of the narrow parts in a cell and around it: windows and the wall between them are one
  // colour, the house beside may have another.
  Finish finishAround(const Cell& at) const {
    Tint sum;
    for (int64_t y = -1; y <= 1; ++y) {
      for (int64_t x = -1; x <= 1; ++x) add(sum, {at.first + y, at.second + x});
    }
    return sum.mean({});
  }

  void add(Tint& sum, const Cell& at) const {
    const auto found = cells_.find(at);
    if (found != cells_.end()) sum.add(found->second.tint);
  }

  // As far to the sides as cells are at least of a kind and of a colour, then as far up and down.
  Rectangle grown(const Cell& from, Kind least) const {
    const Finish finish = cells_.at(from).around;
    const auto isFree = [&](int64_t y, int64_t x) {
      work();
      const auto found = cells_.find({y, x});
      if (found == cells_.end()) return false;
      const Cover& c = found->second;
      if (c.kind < least || c.isOwned) return false;
      return c.kind == Kind::Shown || distanceOf(c.around, finish) <= kAlike;
    };
    Rectangle r{from.second, from.first, 1, 1};
    while (r.width < kLongest && isFree(r.y, r.x + r.width)) ++r.width;
    for (; r.width < kLongest && isFree(r.y, r.x - 1); ++r.width) --r.x;
    const auto rowIsFree = [&](int64_t y) {
      for (int64_t x = r.x; x < r.x + r.width; ++x) {
        if (!isFree(y, x)) return false;
      }
      return true;
    };
    while (r.height < kLongest && rowIsFree(r.y + r.height)) ++r.height;
    for (; r.height < kLongest && rowIsFree(r.y - 1); ++r.height) --r.y;
    return r;
  }

  double shareOf(const Rectangle& r) const {
    double needed = 0;
    for (int64_t y = r.y; y < r.y + r.height; ++y) {
      for (int64_t x = r.x; x < r.x + r.width; ++x) {
        work();
        if (cells_.at({y, x}).kind == Kind::Needed) ++needed;
      }
    }
    return needed / (static_cast<double>(r.width) * static_cast<double>(r.height));
  }

  void claim(const Rectangle& r) {
    for (int64_t y = r.y; y < r.y + r.height; ++y) {
      for (int64_t x = r.x; x < r.x + r.width; ++x) cells_.at({y, x}).isOwned = true;
    }
    rectangles_.push_back(r);
  }

  bool isOwned(const Cell& at) const {
    const auto found = cells_.find(at);
    return found != cells_.end() && found->second.isOwned;
  }

  bool isOnPlate(const Box3& box) const {
    const Vec3 middle = box.center();
    return isOwned({cellAt(1, middle.y), cellAt(0, middle.x)});
  }

  // The row or the column of a place.
  int64_t cellAt(size_t axis, double place) const {
    return static_cast<int64_t>(
        std::clamp(std::floor((place - reach_.min[axis]) / side_[axis]), -1.0, count_[axis]));
  }

  void emit(Plates& out) {
    double offset = 0;
    for (const WallSheet& s : sheets_) {
      if (s.isLarge) continue;
      const Box3 box = inPlane(partOf(s));
      if (!isOnPlate(box)) continue;
      out.taken[s.number] = true;
      offset = std::max({offset, std::abs(box.min.z - depth_), std::abs(box.max.z - depth_)});
    }
    bringForward(hiddenParts(), out);
    for (const Rectangle& r : rectangles_) out.plates.push_back({plateOf(r), offset});
  }

  // The large parts of which plates would hide much: windows in their reveals. Of others a plate
  // takes on the colour of what it hides.
  std::vector<const WallSheet*> hiddenParts() {
    std::vector<const WallSheet*> out;
    for (const WallSheet& s : sheets_) {
      if (!s.isLarge || !isInWall(s)) continue;
      double whole = 0, hidden = 0;
      std::vector<std::pair<Cell, double>> cells;
      forEachCell(s, [&](const Cell& at, double share, const Box2&) {
        whole += share;
        if (!isOwned(at)) return;
        hidden += share;
        cells.emplace_back(at, share);
      });
      if (hidden > 0 && hidden >= kHidden * whole) {
        out.push_back(&s);
        continue;
      }
      for (const auto& [at, share] : cells) cells_[at].tint.add(partOf(s).finish, share);
    }
    return out;
  }

  // To just before the plates, in the order in which they lie.
  void bringForward(const std::vector<const WallSheet*>& parts, Plates& out) const {
    const double gap = tolerance_ / 64, most = depth_ + 2 * gap;
    std::vector<double> depths;
    for (const WallSheet* s : parts) depths.push_back(inPlane(partOf(*s)).min.z);
    double low = most, high = -std::numeric_limits<double>::infinity();
    for (const double z : depths) {
      low = std::min(low, z);
      if (z < most) high = std::max(high, z);
    }
    for (size_t i = 0; i < parts.size(); ++i) {
      if (depths[i] >= most) continue;
      const double place = high > low ? (depths[i] - low) / (high - low) : 0;
      const double forward = depth_ + gap * (1 + place) - depths[i];
      if (forward > 0) out.moves[parts[i]->number] = frame_.z * forward;
    }
  }

  // Where a rectangle ends along an axis, below or above: where most of what covers its last cells
  // does, if most of them have nothing beside them.
  double endOf(const Rectangle& r, size_t axis, int64_t to) const {
    const int64_t last =
        axis == 0 ? (to < 0 ? r.x : r.x + r.width - 1) : (to < 0 ? r.y : r.y + r.height - 1);
    const int64_t from = axis == 0 ? r.y : r.x, count = axis == 0 ? r.height : r.width;
    const double edge = reach_.min[axis] + side_[axis] * static_cast<double>(last + (to > 0));
    std::vector<double> ends;
    int64_t free = 0;
    for (int64_t i = from; i < from + count; ++i) {
      work();
      const Cell at = axis == 0 ? Cell{i, last} : Cell{last, i};
      const Cell beside = axis == 0 ? Cell{i, last + to} : Cell{last + to, i};
      const Box2& reach = cells_.at(at).reach;
      ends.push_back(to < 0 ? reach.min[axis] : reach.max[axis]);
      const auto found = cells_.find(beside);
      if (found == cells_.end() || found->second.kind == Kind::Empty) ++free;
    }
    if (2 * free <= count) return edge;
    const auto middle = ends.begin() + static_cast<ptrdiff_t>(ends.size() / 2);
    std::nth_element(ends.begin(), middle, ends.end());
    return *middle;
  }

  CoarsePart plateOf(const Rectangle& r) const {
    CoarsePart p;
    p.feature = partOf(*main_).feature;
    Tint sum;
    for (int64_t y = r.y; y < r.y + r.height; ++y) {
      for (int64_t x = r.x; x < r.x + r.width; ++x) add(sum, {y, x});
    }
    p.finish = sum.mean(partOf(*main_).finish);
    p.frame = frame_;
    p.box.include(Vec3{endOf(r, 0, -1), endOf(r, 1, -1), depth_});
    p.box.include(Vec3{endOf(r, 0, 1), endOf(r, 1, 1), depth_});
    p.area = p.box.size().x * p.box.size().y;
    return p;
  }

  const CoarseModel& model_;
  std::span<const WallSheet> sheets_;
  double tolerance_;
  const WallSheet* main_ = nullptr;
  Frame frame_;
  Box3 reach_;
  double depth_ = 0;
  std::array<double, 2> count_{}, side_{};
  /// By row and column.
  std::map<Cell, Cover> cells_;
  std::vector<Rectangle> rectangles_;
};

class SheetFinder {
 public:
  SheetFinder(const CoarseModel& model, double tolerance) : model_(model), tolerance_(tolerance) {}

  void add(size_t part, size_t number, bool isLarge) {
    const std::optional<Sheet> s = sheetOf(model_, part, tolerance_);
    if (s) sheets_.push_back({*s, number, isLarge});
  }

  // Sheets of equal directions around the offsets where most of the narrow ones lie, within the
  // tolerance to both sides.
  template <class Run>
  void forEachPlane(const Run& run) {
    std::stable_sort(sheets_.begin(), sheets_.end(), liesBefore);
    for (size_t i = 0; i < sheets_.size();) {
      size_t end = i + 1;
      while (end < sheets_.size() && sheets_[end].direction == sheets_[i].direction) ++end;
      divide(std::span<const WallSheet>(sheets_).subspan(i, end - i), run);
      i = end;
    }
  }

 private:
  // Sheets of one direction, by offset.
  template <class Run>
  void divide(std::span<const WallSheet> sheets, const Run& run) const {
    const std::vector<double> mass = massesOf(sheets);
    std::vector<size_t> order(sheets.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return mass[a] > mass[b]; });
    std::vector<bool> isTaken(sheets.size(), false);
    for (const size_t middle : order) {
      if (isTaken[middle]) continue;
      const auto isNear = [&](size_t i) {
        return !isTaken[i] && std::abs(sheets[i].offset - sheets[middle].offset) <= tolerance_;
      };
      size_t begin = middle, end = middle + 1;
      while (begin > 0 && isNear(begin - 1)) --begin;
      while (end < sheets.size() && isNear(end)) ++end;
      std::fill(isTaken.begin() + static_cast<ptrdiff_t>(begin),
                isTaken.begin() + static_cast<ptrdiff_t>(end), true);
      if (end - begin > 1) run(sheets.subspan(begin, end - begin));
    }
  }

  // By sheet: the square metres of narrow ones in its plane, and a little before and behind it.
  std::vector<double> massesOf(std::span<const WallSheet> sheets) const {
    std::vector<double> before(sheets.size() + 1, 0);
    for (size_t i = 0; i < sheets.size(); ++i) {
      const double area = weightOf(model_.parts[sheets[i].part].box);
      before[i + 1] = before[i] + (sheets[i].isLarge ? 0 : area);
    }
    std::vector<double> out(sheets.size());
    size_t begin = 0, end = 0;
    for (size_t i = 0; i < sheets.size(); ++i) {
      const double reach = tolerance_ / 16;
      while (sheets[begin].offset < sheets[i].offset - reach) ++begin;
      while (end < sheets.size() && sheets[end].offset <= sheets[i].offset + reach) ++end;
      out[i] = before[end] - before[begin];
    }
    return out;
  }

  const CoarseModel& model_;
  double tolerance_;
  std::vector<WallSheet> sheets_;
};

}  // namespace

Plates platesOf(const CoarseModel& model, std::span<const size_t> narrow,
                std::span<const size_t> large, double tolerance) {
  Plates out;
  out.taken.assign(narrow.size(), false);
  out.moves.assign(large.size(), {});
  SheetFinder finder(model, tolerance);
  for (size_t i = 0; i < narrow.size(); ++i) finder.add(narrow[i], i, false);
  for (size_t i = 0; i < large.size(); ++i) finder.add(large[i], i, true);
  finder.forEachPlane([&](std::span<const WallSheet> sheets) {
    work(sheets.size());
    PlaneGrid(model, sheets, tolerance).run(out);
  });
  return out;
}

}  // namespace gable
