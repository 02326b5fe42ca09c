// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Images have cells much smaller than the tolerance. What closes a hole seen from one direction
// counts in the images from the next.
#include "tiles/closing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "base/work.h"
#include "tiles/depth_image.h"
#include "tiles/seen_tints.h"
#include "tiles/sheets.h"

namespace gable {
namespace {

// Cells over the tolerance, and the most along a side of an image.
constexpr double kCellsPerTolerance = 4;
constexpr double kMostCells = 256;
// Images of a feature; those whose directions have a larger cosine show nearly the same, and those
// that look up, with a smaller height, what nobody sees.
constexpr size_t kMostDirections = 8;
constexpr double kSameDirection = 0.94, kLowest = -0.3;
// Normals are counted in so many steps.
constexpr double kNormalSteps = 16;
// A surface that is turned farther away is closed from another direction: a cosine.
constexpr double kFacing = 0.6;
// What is in one rectangle, and what it meets at its sides, differ in depth by less: a share of the
// tolerance.
constexpr double kFlat = 0.25;
// Of the looks in a rectangle; narrower parts than such a share of the tolerance take on any.
constexpr double kAlike = 0.15, kFrame = 0.25;
// A rectangle of fewer cells covers no hole worth two triangles.
constexpr int64_t kFewestCells = 3;

// Parts of a feature.
struct Range {
  size_t begin = 0, end = 0;
};

// A rectangle of cells, up to before its right side and its top.
struct Cells {
  int64_t x = 0, y = 0, right = 0, top = 0;
};

// One feature.
class Closer {
 public:
  Closer(const CoarseModel& fine, Range parts, double tolerance, CoarseModel& coarse,
         std::vector<CoarsePart>& shown)
      : fine_(fine),
        parts_(parts),
        tolerance_(tolerance),
        coarse_(coarse),
        shown_(shown),
        tints_(tolerance) {}

  double run() {
    for (const Vec3& d : directions()) close(d);
    tints_.apply(shown_);
    return missed_;
  }

 private:
  // Those that most of the surfaces of the feature face, up and to the sides.
  std::vector<Vec3> directions() const {
    std::map<std::array<int64_t, 3>, Vec3> sums;
    const auto count = [&](const Vec3& n) {
      const double area = length(n);
      if (!(area > 0) || !std::isfinite(area) || n.y < kLowest * area) return;
      std::array<int64_t, 3> key{};
      for (size_t i = 0; i < 3; ++i) key[i] = std::llround(n[i] / area * kNormalSteps);
      sums[key] += n;
    };
    for (size_t i = parts_.begin; i < parts_.end; ++i) {
      forEachTriangle(fine_, fine_.parts[i], [&](const CoarseTriangle& t) {
        work();
        count(cross(t[1] - t[0], t[2] - t[0]));
      });
    }
    std::vector<Vec3> found;
    for (const auto& [key, sum] : sums) found.push_back(sum);
    std::stable_sort(found.begin(), found.end(),
                     [](const Vec3& a, const Vec3& b) { return length(a) > length(b); });
    std::vector<Vec3> out;
    for (const Vec3& n : found) {
      const Vec3 d = n * (1 / length(n));
      const auto isSame = [&](const Vec3& other) { return dot(d, other) > kSameDirection; };
      if (std::none_of(out.begin(), out.end(), isSame)) out.push_back(d);
      if (out.size() == kMostDirections) break;
    }
    return out;
  }

  // The x of the frame is level, and along a wall where it looks down.
  Frame frameOf(const Vec3& z) {
    Vec3 x{z.z, 0, -z.x};
    if (length(x) > 0.1) {
      x = x * (1 / length(x));
      level_ = x;
    } else {
      x = level_ - z * dot(level_, z);
      x = x * (1 / length(x));
    }
    return Frame::of({}, x, cross(z, x), z);
  }

  void close(const Vec3& direction) {
    frame_ = frameOf(direction);
    Box3 reach;
    for (size_t i = parts_.begin; i < parts_.end; ++i) {
      for (const Vec3& c : cornersOf(fine_.parts[i])) reach.include(frame_.toLocal(c));
    }
    const double longest = std::max(reach.size().x, reach.size().y);
    if (!(longest <= kLongestClosed * tolerance_)) return;
    side_ = std::max(tolerance_ / kCellsPerTolerance, longest / kMostCells);
    DepthImage before(frame_, reach, side_), after(frame_, reach, side_);
    for (size_t i = parts_.begin; i < parts_.end; ++i) before.add(fine_, fine_.parts[i]);
    for (const CoarsePart& p : shown_) after.add(coarse_, p);
    tints_.add(before, after, shown_, side_ * side_);
    findHoles(before, after);
    cover(before, after);
  }

  bool isShown(const DepthImage::Hit& before, const DepthImage::Hit& after) const {
    return before.depth - after.depth <= tolerance_;
  }

  void findHoles(const DepthImage& before, const DepthImage& after) {
    width_ = before.width();
    open_.assign(static_cast<size_t>(width_ * before.height()), false);
    for (int64_t y = 0; y < before.height(); ++y) {
      work(static_cast<size_t>(width_));
      for (int64_t x = 0; x < width_; ++x) {
        const DepthImage::Hit &was = before.at(x, y), &is = after.at(x, y);
        if (!was.part || was.facing < kFacing || isShown(was, is)) continue;
        open_[indexOf(x, y)] = is.part ? is.facing < 0 : isBetween(before, after, x, y);
      }
    }
  }

  // Whether something as near is shown to both sides, or above and below, with no sky before it.
  bool isBetween(const DepthImage& before, const DepthImage& after, int64_t x, int64_t y) const {
    const auto ends = [&](int64_t dx, int64_t dy) {
      for (int64_t u = x, v = y; before.contains(u, v) && before.at(u, v).part; u += dx, v += dy) {
        work();
        if (after.at(u, v).part) return isShown(before.at(x, y), after.at(u, v));
      }
      return false;
    };
    return (ends(-1, 0) && ends(1, 0)) || (ends(0, -1) && ends(0, 1));
  }

  size_t indexOf(int64_t x, int64_t y) const { return static_cast<size_t>(y * width_ + x); }

  // As few rectangles as a greedy search finds.
  void cover(const DepthImage& before, const DepthImage& after) {
    for (int64_t y = 0; y < before.height(); ++y) {
      for (int64_t x = 0; x < width_; ++x) {
        if (open_[indexOf(x, y)]) coverFrom(before, after, x, y);
      }
    }
  }

  void coverFrom(const DepthImage& before, const DepthImage& after, int64_t x, int64_t y) {
    const DepthImage::Hit& first = before.at(x, y);
    const auto isOf = [&](int64_t u, int64_t v) {
      work();
      if (!before.contains(u, v) || !open_[indexOf(u, v)]) return false;
      const DepthImage::Hit& h = before.at(u, v);
      return std::abs(h.depth - first.depth) <= kFlat * tolerance_ &&
             (std::min(widthOf(h.part->box), widthOf(first.part->box)) < kFrame * tolerance_ ||
              distanceOf(h.part->finish, first.part->finish) <= kAlike);
    };
    Cells r{x, y, x + 1, y + 1};
    while (isOf(r.right, y)) ++r.right;
    const auto rowIsOf = [&](int64_t v) {
      for (int64_t u = x; u < r.right; ++u) {
        if (!isOf(u, v)) return false;
      }
      return true;
    };
    while (rowIsOf(r.top)) ++r.top;
    addRectangle(before, after, r);
  }

  void addRectangle(const DepthImage& before, const DepthImage& after, const Cells& r) {
    Tint tint;
    // Of what is seen, and of the parts that it belongs to.
    Box3 depths, parts;
    const CoarsePart* last = nullptr;
    for (int64_t v = r.y; v < r.top; ++v) {
      for (int64_t u = r.x; u < r.right; ++u) {
        const DepthImage::Hit& h = before.at(u, v);
        open_[indexOf(u, v)] = false;
        tint.add(h.part->finish, 1);
        depths.include(Vec3{0, 0, h.depth});
        if (h.part == last) continue;
        last = h.part;
        for (const Vec3& c : cornersOf(*last)) parts.include(frame_.toLocal(c));
      }
    }
    if ((r.right - r.x) * (r.top - r.y) < kFewestCells) return;
    missed_ = std::max(missed_, depths.size().z / 2);
    CoarsePart p;
    p.feature = fine_.parts[parts_.begin].feature;
    p.finish = tint.mean({});
    p.frame = frame_;
    const double z = depths.center().z;
    // The hole may reach half a cell farther; nothing sticks out where it does not.
    const auto more = [&](const Cells& beside) { return meets(after, beside, z) ? 0.5 : 0; };
    const auto at = [&](int64_t cell, double by) { return static_cast<double>(cell) + by; };
    const Vec2 low = before.cornerAt(at(r.x, -more({r.x - 1, r.y, r.x, r.top})),
                                     at(r.y, -more({r.x, r.y - 1, r.right, r.y})));
    const Vec2 high = before.cornerAt(at(r.right, more({r.right, r.y, r.right + 1, r.top})),
                                      at(r.top, more({r.x, r.top, r.right, r.top + 1})));
    // Cells reach beyond the sides of what they show.
    p.box.include(Vec3{std::max(low.x, parts.min.x), std::max(low.y, parts.min.y), z});
    p.box.include(Vec3{std::min(high.x, parts.max.x), std::min(high.y, parts.max.y), z});
    p.area = faceArea(p.box);
    addFlat(coarse_, p);
    shown_.push_back(p);
  }

  // Whether something is shown in all of these cells about as deep.
  bool meets(const DepthImage& after, const Cells& cells, double depth) const {
    for (int64_t v = cells.y; v < cells.top; ++v) {
      for (int64_t u = cells.x; u < cells.right; ++u) {
        work();
        if (!after.contains(u, v)) return false;
        if (!(std::abs(after.at(u, v).depth - depth) <= kFlat * tolerance_)) return false;
      }
    }
    return true;
  }

  const CoarseModel& fine_;
  Range parts_;
  double tolerance_;
  CoarseModel& coarse_;
  /// The coarse parts of the feature, with what closes it.
  std::vector<CoarsePart>& shown_;
  SeenTints tints_;
  double missed_ = 0;
  Vec3 level_{1, 0, 0};
  // Of the direction that is looked from.
  Frame frame_;
  double side_ = 0;
  int64_t width_ = 0;
  std::vector<bool> open_;
};

}  // namespace

double closeHoles(const CoarseModel& fine, double tolerance, CoarseModel& coarse) {
  double missed = 0;
  std::vector<CoarsePart> parts, shown;
  size_t at = 0;
  for (size_t begin = 0; begin < fine.parts.size();) {
    const Range feature{begin, endOfFeature(fine.parts, begin)};
    begin = feature.end;
    shown.clear();
    for (;
         at < coarse.parts.size() && coarse.parts[at].feature == fine.parts[feature.begin].feature;
         ++at) {
      shown.push_back(coarse.parts[at]);
    }
    if (!shown.empty()) {
      missed = std::max(missed, Closer(fine, feature, tolerance, coarse, shown).run());
    }
    parts.insert(parts.end(), shown.begin(), shown.end());
  }
  coarse.parts = std::move(parts);
  return missed;
}

}  // namespace gable
