// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A point of an outline can go when it and both its neighbours lie beyond the same side of the box:
// the shorter way passes the box on the same side. Boxes are halved across their longer side, where
// no corner is near. The parts have the same points on their common border, so
// edges there run opposite each other and vanish when faces are followed; where rounding makes a
// difference, a step of one unit stays.
#include "geom/region/tiles.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/faces.h"

namespace gable {
namespace {

// Boxes with more edges are halved; fewer are as fast at once.
constexpr size_t kFew = 96;
// A cut that leaves so many times the edges on both sides together gains nothing. Where edges run
// to one point some such cuts must be made; up to so many edges are taken as they are then.
constexpr double kNoGain = 1.6;
constexpr size_t kBearable = 600;
constexpr int kMostIdle = 8;
// Outlines that lie on each other gain nothing wherever they are cut. All such cuts together add so
// many times the edges at most.
constexpr size_t kIdleShare = 8;
// Borders are moved so many times until they keep so many units from all corners.
constexpr int kTries = 64;
constexpr double kClearance = 4;
// Parts have their points one unit apart or more, and stay as they are.
constexpr double kSame = 0.75;
// Twice the rounding of a point.
constexpr double kOnLine = 1.5;

// The sides of the box that a point lies beyond.
unsigned beyond(Vec2 p, const Box2& box) {
  return (p.x < box.min.x ? 1u : 0u) | (p.x > box.max.x ? 2u : 0u) | (p.y < box.min.y ? 4u : 0u) |
         (p.y > box.max.y ? 8u : 0u);
}

// Whether an outline comes into the box, or near it.
bool reaches(const Ring& r, const Box2& box) {
  for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
    const Vec2 a = r[j], d = r[i] - a;
    if ((beyond(a, box) & beyond(r[i], box)) != 0) continue;
    const double least = kClearance * (std::fabs(d.x) + std::fabs(d.y));
    int left = 0, right = 0;
    for (const Vec2 corner :
         {box.min, Vec2{box.max.x, box.min.y}, box.max, Vec2{box.min.x, box.max.y}}) {
      const double side = cross(d, corner - a);
      left += side > least ? 1 : 0;
      right += side < -least ? 1 : 0;
    }
    if (left < 4 && right < 4) return true;
  }
  return false;
}

// An outline that does not come into the box goes round all of it as often, and so does this.
Ring asRound(const Ring& r, const Box2& box) {
  const Vec2 at = box.center();
  int turns = 0;
  for (size_t i = 0, j = r.size() - 1; i < r.size(); j = i++) {
    if ((r[j].y <= at.y) == (r[i].y <= at.y)) continue;
    const bool up = r[j].y <= at.y;
    if ((cross(r[i] - r[j], at - r[j]) > 0) == up) turns += up ? 1 : -1;
  }
  const Vec2 low = box.min - Vec2{kClearance, kClearance};
  const Vec2 high = box.max + Vec2{kClearance, kClearance};
  Ring out;
  for (int k = 0; k < std::abs(turns); ++k) {
    for (const Vec2 v : {low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}}) out.push_back(v);
  }
  if (turns < 0) std::reverse(out.begin(), out.end());
  return out;
}

size_t countOf(const std::vector<Ring>& rings) {
  size_t n = 0;
  for (const Ring& r : rings) n += r.size();
  return n;
}

class Tiles {
 public:
  Tiles(const WithinBox& within, size_t edges) : within_(within), spare_(kIdleShare * edges) {}

  // `idle`: so many cuts before this box gained nothing.
  void divide(Operands o, const Box2& box, int idle) {
    work(64);
    shortenOutside(o.a, box);
    shortenOutside(o.b, box);
    const size_t count = countOf(o.a) + countOf(o.b);
    Halves best;
    if (count > kFew && idle < kMostIdle) {
      for (const bool alongX : {true, false}) {
        Halves halves;
        if (!halve(o, box, alongX, halves)) continue;
        if (best.count == 0 || halves.count < best.count) best = std::move(halves);
      }
    }
    const bool gains = static_cast<double>(best.count) < kNoGain * static_cast<double>(count);
    const size_t more = best.count > count ? best.count - count : 0;
    if (best.count == 0 || (!gains && (count <= kBearable || more > spare_))) {
      for (Ring& r : within_(o, box)) rings_.push_back(std::move(r));
      return;
    }
    if (!gains) spare_ -= more;
    (best.alongX ? atX_ : atY_).push_back(best.alongX ? best.low.max.x : best.low.max.y);
    o = {};
    divide(std::move(best.inLow), best.low, gains ? 0 : idle + 1);
    divide(std::move(best.inHigh), best.high, gains ? 0 : idle + 1);
  }

  bool together(const IsInput& isInput, Region& out) {
    std::sort(atX_.begin(), atX_.end());
    std::sort(atY_.begin(), atY_.end());
    if (rings_.empty()) {
      out.clear();
      return true;
    }
    std::vector<Face> faces;
    if (!facesOf(edgesOf(rings_), {}, kSame, faces)) return false;
    Region whole, smooth;
    for (Face& f : faces) whole.push_back(std::move(f.polygon));
    for (const Polygon& p : whole) {
      Polygon q{withoutSeams(p.outer, isInput), {}};
      for (const Ring& h : p.holes) q.holes.push_back(withoutSeams(h, isInput));
      smooth.push_back(std::move(q));
    }
    out = isValid(smooth) ? std::move(smooth) : std::move(whole);
    return true;
  }

 private:
  struct Halves {
    bool alongX = false;
    Box2 low, high;
    Operands inLow, inHigh;
    // Edges of both.
    size_t count = 0;
  };

  // False when the box is too small to be halved, or too narrow to be worth it.
  bool halve(const Operands& o, const Box2& box, bool alongX, Halves& out) const {
    const double wide = box.size().x, high = box.size().y;
    if (alongX ? 8 * wide < high : 8 * high < wide) return false;
    const double from = alongX ? box.min.x : box.min.y, to = alongX ? box.max.x : box.max.y;
    std::vector<double> at;
    for (const std::vector<Ring>* rings : {&o.a, &o.b}) {
      for (const Ring& r : *rings) {
        for (const Vec2 p : r) {
          const double v = alongX ? p.x : p.y;
          if (v > from && v < to) at.push_back(v);
        }
      }
    }
    std::sort(at.begin(), at.end());
    const auto isFree = [&](double v) {
      const auto next = std::lower_bound(at.begin(), at.end(), v - kClearance);
      return v > from + kClearance && v < to - kClearance &&
             (next == at.end() || *next > v + kClearance);
    };
    const double middle = std::floor((from + to) / 2);
    double border = middle;
    for (int i = 1; i < kTries && !isFree(border); ++i) {
      border = middle + (i % 2 == 0 ? 1 : -1) * 2 * kClearance * i;
    }
    if (!isFree(border)) return false;
    out.alongX = alongX;
    out.low = out.high = box;
    (alongX ? out.low.max.x : out.low.max.y) = border;
    (alongX ? out.high.min.x : out.high.min.y) = border;
    out.inLow = out.inHigh = o;
    shortenOutside(out.inLow.a, out.low);
    shortenOutside(out.inLow.b, out.low);
    shortenOutside(out.inHigh.a, out.high);
    shortenOutside(out.inHigh.b, out.high);
    out.count = countOf(out.inLow.a) + countOf(out.inLow.b) + countOf(out.inHigh.a) +
                countOf(out.inHigh.b) + 1;
    return true;
  }

  bool onBorder(Vec2 p) const {
    return std::binary_search(atX_.begin(), atX_.end(), p.x) ||
           std::binary_search(atY_.begin(), atY_.end(), p.y);
  }

  Ring withoutSeams(const Ring& r, const IsInput& isInput) const {
    const size_t n = r.size();
    std::vector<char> seam(n, 0);
    size_t first = n;
    for (size_t i = 0; i < n; ++i) {
      seam[i] = onBorder(r[i]) && !isInput(r[i]);
      if (!seam[i] && first == n) first = i;
    }
    if (first == n) return r;
    Ring out;
    for (size_t k = 0; k < n;) {
      const size_t i = (first + k) % n;
      out.push_back(r[i]);
      // The seams up to the next point that stays, if all of them lie on the line to it.
      size_t run = 1;
      while (seam[(i + run) % n]) ++run;
      const Segment line{r[i], r[(i + run) % n]};
      bool straight = run < n;
      for (size_t j = 1; straight && j < run; ++j) {
        straight = distanceTo(line, r[(i + j) % n]) <= kOnLine;
      }
      for (size_t j = 1; !straight && j < run; ++j) out.push_back(r[(i + j) % n]);
      k += run;
    }
    return out.size() >= 3 ? out : r;
  }

  const WithinBox& within_;
  // Edges that idle cuts may still add.
  size_t spare_;
  std::vector<Ring> rings_;
  std::vector<double> atX_, atY_;
};

}  // namespace

void shortenOutside(std::vector<Ring>& rings, const Box2& box) {
  for (Ring& r : rings) {
    const size_t n = r.size();
    work(2 * n);
    Ring out;
    for (size_t i = 0; i < n; ++i) {
      const Vec2 before = out.empty() ? r[n - 1] : out.back();
      const Vec2 after = i + 1 < n ? r[i + 1] : out.empty() ? r[i] : out.front();
      if ((beyond(before, box) & beyond(r[i], box) & beyond(after, box)) != 0) continue;
      out.push_back(r[i]);
    }
    r.swap(out);
    if (r.size() >= 3 && !reaches(r, box)) r = asRound(r, box);
  }
  std::erase_if(rings, [](const Ring& r) { return r.size() < 3; });
}

bool resultInTiles(Operands operands, const Box2& box, const WithinBox& within,
                   const IsInput& isInput, Region& out) {
  Tiles tiles(within, countOf(operands.a) + countOf(operands.b));
  tiles.divide(std::move(operands), box, 0);
  return tiles.together(isInput, out);
}

}  // namespace gable
