// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "geom/region/places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "geom/region/locator.h"
#include "geom/region/piece.h"
#include "geom/region/segment_grid.h"
#include "math/predicates.h"
#include "math/trig.h"

namespace gable {

Vec2 centroid(const Polygon& p) {
  Vec2 sum;
  double whole = 0;
  if (p.outer.empty()) return sum;
  const Vec2 o = p.outer[0];
  for (const Ring& r : ringsOf(p)) {
    for (size_t i = 0; i < r.size(); ++i) {
      const Vec2 a = r[i] - o, b = r[(i + 1) % r.size()] - o;
      const double c = cross(a, b);
      sum = sum + (a + b) * c;
      whole += c;
    }
  }
  return whole != 0 ? o + sum * (1 / (3 * whole)) : o;
}

bool isConvex(const Polygon& p) {
  const size_t n = p.outer.size();
  if (!p.holes.empty() || n < 3) return false;
  for (size_t i = 0; i < n; ++i) {
    if (orientation(p.outer[i], p.outer[(i + 1) % n], p.outer[(i + 2) % n]) < 0) return false;
  }
  return true;
}

namespace {

struct Square {
  Vec2 middle;
  double half, distance, most;
  /// Of equal ones the lowest counts, then the leftmost: no library's queue decides.
  bool operator<(const Square& o) const {
    if (most != o.most) return most < o.most;
    return middle.y != o.middle.y ? middle.y > o.middle.y : middle.x > o.middle.x;
  }
};

}  // namespace

Disc poleOf(const Polygon& p) {
  const Box2 box = bounds(p);
  if (box.empty()) return {};
  const Vec2 size = box.size();
  const double side = std::min(size.x, size.y);
  const auto squareAt = [&](Vec2 m, double half) {
    const double d = signedDistance(p, m);
    return Square{m, half, d, d + half * std::sqrt(2.0)};
  };
  Square best = squareAt(centroid(p), 0);
  // Middles of ears: one of them lies inside whatever the shape.
  std::priority_queue<Square> open;
  if (!(side > 0)) return {box.min, 0};
  const double step = std::max(side, std::max(size.x, size.y) / 32);
  for (double x = box.min.x; x < box.max.x; x += step) {
    for (double y = box.min.y; y < box.max.y; y += step) {
      work(4);
      open.push(squareAt({x + step / 2, y + step / 2}, step / 2));
    }
  }
  constexpr int kMostSquares = 20000;
  for (int i = 0; i < kMostSquares && !open.empty(); ++i) {
    const Square s = open.top();
    open.pop();
    if (s.distance > best.distance) best = s;
    if (s.most - best.distance <= std::max(0.01 * std::fabs(best.distance), 1e-9 * side)) break;
    const double h = s.half / 2;
    for (const Vec2 d : {Vec2{-h, -h}, Vec2{h, -h}, Vec2{-h, h}, Vec2{h, h}}) {
      open.push(squareAt(s.middle + d, h));
    }
  }
  return {best.middle, std::max(0.0, best.distance)};
}

Vec2 middleOf(const Polygon& p) { return isConvex(p) ? centroid(p) : poleOf(p).centre; }

std::vector<Disc> scatterDiscs(const Polygon& p, const ScatterOptions& o) {
  struct Drawn {
    double radius;
    uint32_t index;
  };
  std::vector<Drawn> wanted;
  for (uint32_t i = 0; i < o.count; ++i) {
    work();
    wanted.push_back({randomIn(hashCombine(hashCombine(o.seed, 1), i), o.least, o.most), i});
  }
  std::stable_sort(wanted.begin(), wanted.end(),
                   [](const Drawn& a, const Drawn& b) { return a.radius > b.radius; });
  const Box2 box = bounds(p);
  std::vector<std::pair<uint32_t, Disc>> placed;
  const uint32_t tries = 60;
  uint64_t dart = 0;
  for (const Drawn& w : wanted) {
    bool found = false;
    constexpr int kShrinks = 8;
    for (int shrink = 0; shrink <= kShrinks && !found; ++shrink) {
      const double r = w.radius + (o.least - w.radius) * shrink / kShrinks;
      for (uint32_t t = 0; t < tries && !found; ++t) {
        work(1 + placed.size());
        const uint64_t at = hashCombine(hashCombine(o.seed, 2), dart++);
        const Vec2 c{randomIn(hashCombine(at, 0), box.min.x, box.max.x),
                     randomIn(hashCombine(at, 1), box.min.y, box.max.y)};
        const bool free = std::none_of(placed.begin(), placed.end(), [&](const auto& other) {
          return length(other.second.centre - c) <= other.second.radius + r + o.gap;
        });
        if (!free || !(signedDistance(p, c) > r + o.edge)) continue;
        placed.push_back({w.index, {c, r}});
        found = true;
      }
      if (w.radius <= o.least) break;
    }
    // The largest disc of all may fit where no dart fell.
    if (!found && placed.empty()) {
      const Disc pole = poleOf(p);
      if (pole.radius > o.least + o.edge) {
        placed.push_back(
            {w.index, {pole.centre, std::min(w.radius, pole.radius * 0.999 - o.edge)}});
      }
    }
  }
  std::sort(placed.begin(), placed.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Disc> out;
  for (const auto& [index, disc] : placed) out.push_back(disc);
  return out;
}

namespace {

// Directions near enough to tell that a dart is out of the question, without sine and cosine.
class RoughDirections {
 public:
  RoughDirections() {
    for (int i = 0; i <= kParts; ++i) {
      const double a = 360.0 * i / kParts;
      at_[static_cast<size_t>(i)] = {cosDeg(a), sinDeg(a)};
    }
  }
  /// The direction `turns` of a whole turn on from +x, within a millionth.
  Vec2 at(double turns) const {
    const auto i = static_cast<size_t>(turns * kParts);
    const double d = 2 * kPi / kParts * (turns * kParts - static_cast<double>(i));
    const double q = d * d, c = 1 - q * (1.0 / 2 - q / 24), s = d * (1 - q * (1.0 / 6 - q / 120));
    const Vec2 u = at_[i];
    return {u.x * c - u.y * s, u.x * s + u.y * c};
  }

 private:
  // The sixth power of a part's angle, by 720, is what the rough cosine is off by at most.
  static constexpr int kParts = 32;
  std::array<Vec2, kParts + 1> at_;
};

// Points that keep a distance from each other, on a grid whose cells hold one of them, or a few
// where they would be too many. Two rows of cells around it are always empty.
class SparsePoints {
 public:
  SparsePoints(const Box2& box, double distance) : box_(box), distance_(distance) {
    const double cell =
        std::max(distance / std::sqrt(2.0), std::max(box.size().x, box.size().y) / 4000);
    inverse_ = 1 / cell;
    nx_ = static_cast<int>(box.size().x * inverse_) + 1;
    ny_ = static_cast<int>(box.size().y * inverse_) + 1;
    stride_ = static_cast<size_t>(nx_) + 4;
    const size_t count = stride_ * (static_cast<size_t>(ny_) + 4);
    workMemory(count * (sizeof(Vec2) + sizeof(uint32_t)));
    constexpr size_t kFirst = 256;
    points_.reserve(kFirst);
    next_.reserve(kFirst);
    latest_.assign(count, {kFar, kFar});
    first_.assign(count, kNone);
  }
  /// No point is nearer than the distance, and `c` lies in the box.
  bool isFree(Vec2 c) const {
    if (c.x < box_.min.x || c.y < box_.min.y || c.x > box_.max.x || c.y > box_.max.y) return false;
    const size_t corner = cornerOf(c);
    for (size_t row = 0; row < 5; ++row) {
      for (size_t i = 0; i < 5; ++i) {
        for (uint32_t q = first_[corner + row * stride_ + i]; q != kNone; q = next_[q]) {
          work();
          if (length(points_[q] - c) < distance_) return false;
        }
      }
    }
    return true;
  }
  /// False only where isFree is, for all places within `slack` of `c`.
  bool mayBeFree(Vec2 c, double slack) const {
    if (c.x < box_.min.x - slack || c.y < box_.min.y - slack || c.x > box_.max.x + slack ||
        c.y > box_.max.y + slack) {
      return false;
    }
    const double least = (distance_ - slack) * (distance_ - slack);
    const Vec2* low = latest_.data() + cornerOf(c);
    const Vec2* const row[5] = {low, low + stride_, low + 2 * stride_, low + 3 * stride_,
                                low + 4 * stride_};
    const auto to = [&](Vec2 p) { return dot(p - c, p - c); };
    const auto middle = [&](const Vec2* r) {
      return std::min(std::min(to(r[1]), to(r[2])), to(r[3]));
    };
    const auto side = [&](size_t i) {
      return std::min(std::min(to(row[1][i]), to(row[2][i])), to(row[3][i]));
    };
    // What is in the way is near, mostly; the cells at the corners are too far away.
    if (std::min(std::min(middle(row[1]), middle(row[2])), middle(row[3])) < least) return false;
    return !(std::min(std::min(middle(row[0]), middle(row[4])), std::min(side(0), side(4))) <
             least);
  }
  void add(Vec2 c) {
    const size_t cell = cornerOf(c) + 2 * stride_ + 2;
    latest_[cell] = c;
    next_.push_back(first_[cell]);
    first_[cell] = static_cast<uint32_t>(points_.size());
    points_.push_back(c);
  }
  const std::vector<Vec2>& points() const { return points_; }

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  static constexpr double kFar = 1e150;
  // Of the five by five cells around a place.
  size_t cornerOf(Vec2 c) const {
    const auto place = [&](double v, int n) {
      return static_cast<size_t>(std::min(static_cast<int>(v * inverse_), n - 1));
    };
    return place(c.y - box_.min.y, ny_) * stride_ + place(c.x - box_.min.x, nx_);
  }
  Box2 box_;
  double distance_, inverse_ = 1;
  int nx_ = 1, ny_ = 1;
  size_t stride_ = 0;
  std::vector<Vec2> points_, latest_;
  std::vector<uint32_t> first_, next_;
};

}  // namespace

std::vector<Vec2> scatterPoisson(const Polygon& p, double distance, double edge, size_t most,
                                 uint64_t seed) {
  const Box2 box = bounds(p);
  if (!(distance > 0) || box.empty() || !std::isfinite(distance)) return {};
  if (!std::isfinite(length(box.size()))) return {};
  SparsePoints points(box, distance);
  const Locator locator(p);
  const auto isFree = [&](Vec2 c) {
    if (!points.isFree(c)) return false;
    return edge > 0 ? signedDistance(p, c) >= edge : locator.at(c) != Where::Outside;
  };
  std::vector<uint32_t> active;
  const auto add = [&](Vec2 c) {
    active.push_back(static_cast<uint32_t>(points.points().size()));
    points.add(c);
  };
  // Draws are taken many at a time: they do not wait for what is made of them.
  std::array<double, 64> drawn;
  uint64_t draw = 0;
  const auto unit = [&] {
    const size_t i = draw % drawn.size();
    if (i == 0) {
      for (size_t k = 0; k < drawn.size(); ++k) {
        drawn[k] = randomUnit(hashCombine(seed, draw + k));
      }
    }
    ++draw;
    return drawn[i];
  };
  const RoughDirections rough;
  const double slack = 1e-5 * distance;
  constexpr int kStarts = 30, kAround = 20;
  for (int start = 0; start < kStarts && points.points().size() < most; ++start) {
    const double u = unit(), v = unit();
    const Vec2 c = box.min + Vec2{u * box.size().x, v * box.size().y};
    if (isFree(c)) add(c);
    while (!active.empty() && points.points().size() < most) {
      work(kAround);
      const auto pick = static_cast<size_t>(unit() * static_cast<double>(active.size()));
      const Vec2 from = points.points()[active[pick]];
      bool found = false;
      for (int t = 0; t < kAround && !found; ++t) {
        const double turns = unit(), reach = distance * (1 + unit());
        const Vec2 near = from + rough.at(turns) * reach;
        if (!points.mayBeFree(near, slack) || locator.surelyOutside(near, slack)) continue;
        const double angle = 360 * turns;
        const Vec2 at = from + Vec2{cosDeg(angle), sinDeg(angle)} * reach;
        if (!isFree(at)) continue;
        add(at);
        found = true;
      }
      if (!found) {
        active[pick] = active.back();
        active.pop_back();
      }
    }
  }
  return points.points();
}

}  // namespace gable
