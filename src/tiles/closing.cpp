// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Images are orthographic, of cells much smaller than the tolerance, which are seen in their
// middles. What closes a hole seen from one direction counts in the images from the next.
#include "tiles/closing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "base/work.h"
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

using Triangle = std::array<Vec3, 3>;

// Parts of a feature.
struct Range {
  size_t begin = 0, end = 0;
};

Triangle triangleOf(const CoarseModel& model, const CoarsePart& p, uint32_t number) {
  const auto& t = model.triangles[p.firstTriangle + number];
  const auto at = [&](size_t k) { return model.vertices[p.firstVertex + t[k]]; };
  return {at(0), at(1), at(2)};
}

// The triangles of a part: those of its box where it has none.
template <class Visit>
void forEachTriangle(const CoarseModel& model, const CoarsePart& p, const Visit& visit) {
  for (uint32_t t = 0; t < p.triangleCount; ++t) visit(triangleOf(model, p, t));
  if (p.triangleCount > 0) return;
  static constexpr std::array<std::array<size_t, 4>, 6> kSides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  const std::array<Vec3, 8> c = cornersOf(p);
  const auto visitSide = [&](size_t side) {
    const auto& s = kSides[side];
    visit(Triangle{c[s[0]], c[s[1]], c[s[2]]});
    visit(Triangle{c[s[0]], c[s[2]], c[s[3]]});
  };
  // Faces look along the z of their scope.
  const Vec3 size = p.box.size();
  const size_t across = thinnestOf(size);
  if (size[across] == 0) return visitSide(2 * across + 1);
  for (size_t side = 0; side < kSides.size(); ++side) visitSide(side);
}

// What is seen in a cell.
struct Hit {
  double depth = -std::numeric_limits<double>::infinity();
  /// How much it faces the viewer: a cosine, negative for a back.
  double facing = 0;
  const CoarsePart* part = nullptr;
};

// What is seen of triangles along the z of a frame, from where it is large.
class DepthImage {
 public:
  DepthImage(const Frame& frame, const Box3& reach, double side)
      : frame_(frame),
        low_{reach.min.x - side, reach.min.y - side},
        side_(side),
        width_(cellsOf(reach.size().x)),
        height_(cellsOf(reach.size().y)),
        hits_(static_cast<size_t>(width_ * height_)) {}

  int64_t width() const { return width_; }
  int64_t height() const { return height_; }
  bool contains(int64_t x, int64_t y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_;
  }
  const Hit& at(int64_t x, int64_t y) const { return hits_[static_cast<size_t>(y * width_ + x)]; }
  /// Where the lower side of a cell is, counted in the frame.
  Vec2 cornerAt(double x, double y) const { return {low_.x + x * side_, low_.y + y * side_}; }

  void add(const CoarseModel& model, const CoarsePart& part) {
    forEachTriangle(model, part, [&](const Triangle& t) { add(t, part); });
  }

 private:
  int64_t cellsOf(double length) const { return static_cast<int64_t>(length / side_) + 3; }

  void add(const Triangle& world, const CoarsePart& part) {
    Triangle t;
    for (size_t i = 0; i < 3; ++i) {
      const Vec3 p = frame_.toLocal(world[i]);
      t[i] = {(p.x - low_.x) / side_ - 0.5, (p.y - low_.y) / side_ - 0.5, p.z};
    }
    const Vec3 n = cross(world[1] - world[0], world[2] - world[0]);
    const double twice =
        (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
    if (!(std::abs(twice) > 1e-9) || !(length(n) > 0)) return;
    const double facing = dot(n, frame_.z) / length(n);
    const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
    const auto first = [](double v) { return std::max(std::ceil(v - kEdge), 0.0); };
    const auto last = [](double v, int64_t most) {
      return std::min(std::floor(v + kEdge), static_cast<double>(most - 1));
    };
    for (double y = first(low); y <= last(high, height_); ++y) {
      work();
      double from = first(left), to = last(right, width_);
      // The depth along the row, and where the row is inside all three sides.
      double base = 0, slope = 0;
      for (size_t k = 0; k < 3; ++k) {
        // The share of a corner: what the side across from it leaves.
        const Vec3 &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
        const double per = -(b.y - a.y) / twice;
        const double share = ((b.x - a.x) * (y - a.y)) / twice - per * a.x;
        if (per > 0) from = std::max(from, std::ceil((-kEdge - share) / per));
        if (per < 0) to = std::min(to, std::floor((-kEdge - share) / per));
        if (per == 0 && share < -kEdge) to = -1;
        base += share * t[k].z;
        slope += per * t[k].z;
      }
      if (!(from <= to)) continue;
      size_t cell =
          static_cast<size_t>(static_cast<int64_t>(y) * width_ + static_cast<int64_t>(from));
      for (double x = from; x <= to; ++x) see(cell++, {base + slope * x, facing, &part});
    }
  }

  // The nearer; of what is equally near the front.
  void see(size_t cell, const Hit& hit) {
    Hit& seen = hits_[cell];
    const bool isEqual = std::abs(hit.depth - seen.depth) <= kEdge;
    if (isEqual ? hit.facing > seen.facing : hit.depth > seen.depth) seen = hit;
  }

  // Neighbours share their edge, in cells and in metres.
  static constexpr double kEdge = 1e-6;

  Frame frame_;
  Vec2 low_;
  double side_;
  int64_t width_, height_;
  std::vector<Hit> hits_;
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
      : fine_(fine), parts_(parts), tolerance_(tolerance), coarse_(coarse), shown_(shown) {}

  double run() {
    for (const Vec3& d : directions()) close(d);
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
      forEachTriangle(fine_, fine_.parts[i], [&](const Triangle& t) {
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
    if (!(longest <= kMostCells * tolerance_)) return;
    side_ = std::max(tolerance_ / kCellsPerTolerance, longest / kMostCells);
    DepthImage before(frame_, reach, side_), after(frame_, reach, side_);
    for (size_t i = parts_.begin; i < parts_.end; ++i) before.add(fine_, fine_.parts[i]);
    for (const CoarsePart& p : shown_) after.add(coarse_, p);
    findHoles(before, after);
    cover(before, after);
  }

  bool isShown(const Hit& before, const Hit& after) const {
    return before.depth - after.depth <= tolerance_;
  }

  void findHoles(const DepthImage& before, const DepthImage& after) {
    width_ = before.width();
    open_.assign(static_cast<size_t>(width_ * before.height()), false);
    for (int64_t y = 0; y < before.height(); ++y) {
      work(static_cast<size_t>(width_));
      for (int64_t x = 0; x < width_; ++x) {
        const Hit &was = before.at(x, y), &is = after.at(x, y);
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
    const Hit& first = before.at(x, y);
    const auto isOf = [&](int64_t u, int64_t v) {
      work();
      if (!before.contains(u, v) || !open_[indexOf(u, v)]) return false;
      const Hit& h = before.at(u, v);
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
        const Hit& h = before.at(u, v);
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
