// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Two rectangles of a plane that touch are joined where they nearly fill the one around both. That
// is done until nothing changes: frames and panes become windows, but windows do not become rows.
#include "tiles/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/work.h"
#include "tiles/sheets.h"

namespace gable {
namespace {

// What lies so near along the normal is in one front, as a share of the tolerance and in metres:
// windows in their reveals.
constexpr double kReveal = 0.5, kLeastReveal = 0.25;
// What is so near is in one plane and has no gap, as shares of the tolerance.
constexpr double kFlush = 1.0 / 16;
// A rectangle is filled by what covers so much of it.
constexpr double kFilled = 0.9;
// Looks are those of one thing that differ by less, and of one wall.
constexpr double kAlike = 0.15, kSame = 0.06;
// Narrower ones are frames, which take on any neighbour, as a share of the tolerance.
constexpr double kFrame = 1.0 / 6;
// What panels may be narrower than the tolerance by, and that of fronts which keep them.
constexpr double kNarrowest = 0.25, kSeen = 0.5;
// Steps of the looks among which that of the wall is found.
constexpr double kLookSteps = 16;
// Neighbours that are looked at, and times that all are gone through.
constexpr size_t kMostTries = 256;
constexpr int kMostPasses = 8;

// In the plane of a front.
struct Rectangle {
  Box2 box;
  double near = 0, far = 0;
  double area = 0;
  Tint tint;
  std::vector<size_t> members;

  double width() const { return std::min(box.size().x, box.size().y); }
  double whole() const { return box.size().x * box.size().y; }
  double depth() const { return (near + far) / 2; }
  Finish finish() const { return tint.mean({}); }
};

Box2 around(Box2 a, const Box2& b) {
  a.include(b.min);
  a.include(b.max);
  return a;
}

class PanelMaker {
 public:
  PanelMaker(const CoarseModel& from, double tolerance)
      : from_(from), tolerance_(tolerance), flush_(tolerance * kFlush) {}

  Panelled run() {
    CoarseModel& model = out_.model;
    model.features = from_.features;
    model.vertices = from_.vertices;
    model.triangles = from_.triangles;
    model.error = from_.error;
    const std::vector<CoarsePart>& parts = from_.parts;
    for (size_t begin = 0; begin < parts.size();) {
      const size_t end = endOfFeature(parts, begin);
      addFeature(begin, end);
      begin = end;
    }
    return std::move(out_);
  }

 private:
  void addFeature(size_t begin, size_t end) {
    fate_.assign(end - begin, Fate::Stays);
    first_ = begin;
    panels_.clear();
    std::vector<Sheet> sheets = sheetsOf(begin, end);
    const double reach = std::max(tolerance_ * kReveal, kLeastReveal);
    for (size_t i = 0; i < sheets.size();) {
      size_t last = i + 1;
      while (last < sheets.size() && sheets[last].direction == sheets[i].direction &&
             sheets[last].offset - sheets[last - 1].offset <= reach) {
        ++last;
      }
      if (last - i > 1) addFront(std::span<const Sheet>(sheets).subspan(i, last - i));
      i = last;
    }
    for (size_t i = begin; i < end; ++i) {
      const Fate fate = fate_[i - begin];
      if (fate == Fate::Goes) continue;
      out_.model.parts.push_back(from_.parts[i]);
      out_.model.parts.back().isPanel = fate == Fate::Panel;
    }
    out_.model.parts.insert(out_.model.parts.end(), panels_.begin(), panels_.end());
  }

  // By direction and place along it.
  std::vector<Sheet> sheetsOf(size_t begin, size_t end) const {
    std::vector<Sheet> out;
    for (size_t i = begin; i < end; ++i) {
      const std::optional<Sheet> s = sheetOf(from_, i, tolerance_ / 4);
      if (s && std::isfinite(faceArea(from_.parts[i].box))) out.push_back(*s);
    }
    std::stable_sort(out.begin(), out.end(), liesBefore);
    return out;
  }

  void addFront(std::span<const Sheet> sheets) {
    work(sheets.size());
    const Finish wall = wallOf(sheets);
    const Frame frame = frameOf(sheets);
    std::vector<Rectangle> narrow;
    double seen = 0, whole = 0;
    for (const Sheet& s : sheets) {
      const CoarsePart& p = from_.parts[s.part];
      const double width = widthOf(p.box);
      const bool isWall = distanceOf(p.finish, wall) <= kSame;
      if (width >= tolerance_ && p.triangleCount > 0) {
        if (isWall) continue;
        seen += faceArea(p.box);
        whole += faceArea(p.box);
      } else if (!isWall || width < tolerance_ * kFrame) {
        addRectangle(s.part, frame, narrow);
      }
    }
    join(narrow);
    narrow.erase(std::remove_if(narrow.begin(), narrow.end(),
                                [&](const Rectangle& r) {
                                  return r.width() < tolerance_ * kNarrowest ||
                                         r.area < kFilled * r.whole() ||
                                         distanceOf(r.finish(), wall) <= kSame;
                                }),
                 narrow.end());
    for (const Rectangle& r : narrow) {
      whole += r.area;
      if (r.width() >= tolerance_ * kSeen) seen += r.area;
    }
    if (seen < whole / 2) return;
    for (const Rectangle& r : narrow) addPanel(r, frame);
  }

  // Of most of a front.
  Finish wallOf(std::span<const Sheet> sheets) const {
    std::map<std::array<int64_t, 3>, Tint> looks;
    for (const Sheet& s : sheets) {
      const CoarsePart& p = from_.parts[s.part];
      std::array<int64_t, 3> key{};
      for (size_t i = 0; i < 3; ++i) {
        key[i] = std::llround(std::sqrt(std::max(p.finish.color[i], 0.0)) * kLookSteps);
      }
      looks[key].add(p.finish, faceArea(p.box));
    }
    const auto most = std::max_element(
        looks.begin(), looks.end(),
        [](const auto& a, const auto& b) { return a.second.weight < b.second.weight; });
    return most->second.mean({});
  }

  // Of the largest part.
  Frame frameOf(std::span<const Sheet> sheets) const {
    const Sheet* main = &sheets[0];
    double facing = 0;
    for (const Sheet& s : sheets) {
      if (faceArea(from_.parts[s.part].box) > faceArea(from_.parts[main->part].box)) main = &s;
      facing += facingOf(from_, s);
    }
    return gable::frameOf(from_, *main, facing);
  }

  // Where a part fills a rectangle along the axes.
  void addRectangle(size_t part, const Frame& frame, std::vector<Rectangle>& out) const {
    const CoarsePart& p = from_.parts[part];
    Box3 box;
    for (const Vec3& c : cornersOf(p)) box.include(frame.toLocal(c));
    Rectangle r;
    r.box.include(Vec2{box.min.x, box.min.y});
    r.box.include(Vec2{box.max.x, box.max.y});
    r.near = box.min.z;
    r.far = box.max.z;
    r.area = p.triangleCount > 0 ? shownOf(from_, p) : faceArea(p.box);
    if (p.triangleCount > 2 || r.area < kFilled * r.whole()) return;
    r.tint.add(p.finish, r.area);
    r.members.push_back(part);
    out.push_back(std::move(r));
  }

  void join(std::vector<Rectangle>& rectangles) const {
    bool changed = true;
    for (int pass = 0; changed && pass < kMostPasses; ++pass) {
      changed = false;
      std::stable_sort(
          rectangles.begin(), rectangles.end(), [](const Rectangle& a, const Rectangle& b) {
            return std::tie(a.box.min.x, a.box.min.y) < std::tie(b.box.min.x, b.box.min.y);
          });
      for (size_t i = 0; i < rectangles.size(); ++i) {
        if (!rectangles[i].members.empty()) changed = takeIn(rectangles, i) || changed;
      }
      rectangles.erase(std::remove_if(rectangles.begin(), rectangles.end(),
                                      [](const Rectangle& r) { return r.members.empty(); }),
                       rectangles.end());
    }
  }

  // Joins one with those to its right; what is taken has no members any more.
  bool takeIn(std::vector<Rectangle>& rectangles, size_t at) const {
    Rectangle& r = rectangles[at];
    bool changed = false;
    size_t tries = 0;
    for (size_t i = at + 1; i < rectangles.size() && tries < kMostTries; ++i) {
      Rectangle& other = rectangles[i];
      if (other.box.min.x > r.box.max.x + flush_) break;
      if (other.members.empty()) continue;
      ++tries;
      work();
      if (!canJoin(r, other)) continue;
      r.box = around(r.box, other.box);
      r.near = std::min(r.near, other.near);
      r.far = std::max(r.far, other.far);
      r.area += other.area;
      r.tint.add(other.tint);
      r.members.insert(r.members.end(), other.members.begin(), other.members.end());
      other.members.clear();
      changed = true;
    }
    return changed;
  }

  bool canJoin(const Rectangle& a, const Rectangle& b) const {
    const auto gap = [](double lowA, double highA, double lowB, double highB) {
      return std::max(lowA, lowB) - std::min(highA, highB);
    };
    if (gap(a.box.min.y, a.box.max.y, b.box.min.y, b.box.max.y) > flush_ ||
        gap(a.near, a.far, b.near, b.far) > flush_) {
      return false;
    }
    const Vec2 size = around(a.box, b.box).size();
    if (a.area + b.area < kFilled * size.x * size.y) return false;
    return std::min(a.width(), b.width()) < tolerance_ * kFrame ||
           distanceOf(a.finish(), b.finish()) <= kAlike;
  }

  void addPanel(const Rectangle& r, const Frame& frame) {
    if (r.members.size() == 1 && from_.parts[r.members[0]].triangleCount > 0) {
      fate_[r.members[0] - first_] = Fate::Panel;
      return;
    }
    for (const size_t i : r.members) fate_[i - first_] = Fate::Goes;
    CoarsePart p;
    p.feature = from_.parts[r.members[0]].feature;
    p.finish = r.finish();
    p.area = r.whole();
    p.isPanel = true;
    p.frame = frame;
    p.box.include(Vec3{r.box.min.x, r.box.min.y, r.depth()});
    p.box.include(Vec3{r.box.max.x, r.box.max.y, r.depth()});
    out_.offset = std::max(out_.offset, (r.far - r.near) / 2);
    addFlat(out_.model, p);
    panels_.push_back(p);
  }

  // Of a part of the feature: it stays as it is, is a panel, or goes into one.
  enum class Fate : uint8_t { Stays, Panel, Goes };

  const CoarseModel& from_;
  double tolerance_, flush_;
  Panelled out_;
  size_t first_ = 0;
  std::vector<Fate> fate_;
  std::vector<CoarsePart> panels_;
};

}  // namespace

Panelled withPanels(const CoarseModel& model, double tolerance) {
  return PanelMaker(model, tolerance).run();
}

}  // namespace gable
