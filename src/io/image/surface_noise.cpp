// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/image/surface_noise.h"

#include <array>

namespace gable::surface {

namespace {

/// What was found last, by a number that tells most of what is asked in turns apart: texels side by
/// side lie in the same cells of each lattice. A thread of its own each.
template <class Kept>
class Recent {
 public:
  Kept& at(uint64_t number) { return kept_[number % kCount]; }

 private:
  static constexpr size_t kCount = 64;
  std::array<Kept, kCount> kept_{};
};

/// The chances at the four corners of a lattice's cell.
struct LatticeCell {
  uint64_t seed = 0;
  int cellsU = 0, cellsV = 0, x = 0, y = 0;
  std::array<double, 4> corners{};

  bool is(uint64_t s, int u, int v, int ix, int iy) const {
    return seed == s && cellsU == u && cellsV == v && x == ix && y == iy;
  }
};

const LatticeCell& latticeCell(int x, int y, int cellsU, int cellsV, uint64_t seed) {
  static thread_local Recent<LatticeCell> recent;
  LatticeCell& cell = recent.at(seed + 7 * static_cast<uint64_t>(cellsU));
  if (cell.is(seed, cellsU, cellsV, x, y)) return cell;
  const uint64_t left = hashCombine(seed, static_cast<uint64_t>(wrapped(x, cellsU)));
  const uint64_t right = hashCombine(seed, static_cast<uint64_t>(wrapped(x + 1, cellsU)));
  const uint64_t low = static_cast<uint64_t>(wrapped(y, cellsV));
  const uint64_t high = static_cast<uint64_t>(wrapped(y + 1, cellsV));
  cell = {seed,
          cellsU,
          cellsV,
          x,
          y,
          {chanceOf(left, low), chanceOf(right, low), chanceOf(left, high), chanceOf(right, high)}};
  return cell;
}

}  // namespace

double noise(double u, double v, int cellsU, int cellsV, uint64_t seed) {
  const double x = u * cellsU, y = v * cellsV;
  const int ix = floorOf(x), iy = floorOf(y);
  const double tx = smooth(x - ix), ty = smooth(y - iy);
  const std::array<double, 4>& c = latticeCell(ix, iy, cellsU, cellsV, seed).corners;
  return (c[0] * (1 - tx) + c[1] * tx) * (1 - ty) + (c[2] * (1 - tx) + c[3] * tx) * ty;
}

double clouds(double u, double v, int cellsU, int cellsV, int octaves, uint64_t seed) {
  double sum = 0, weight = 0, part = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += part * noise(u, v, cellsU, cellsV, seed + static_cast<uint64_t>(i));
    weight += part;
    part *= 0.55;
    cellsU *= 2;
    cellsV *= 2;
  }
  return sum / weight;
}

namespace {

constexpr size_t kSide = 5, kSites = kSide * kSide;
int across(size_t k) { return static_cast<int>(k % kSide) - 2; }
int down(size_t k) { return static_cast<int>(k / kSide) - 2; }

/// The points of the cells about one of them, as shares of a cell off the middle of theirs.
class Jitters {
 public:
  struct Jitter {
    uint64_t i = 0, j = 0;
    double aside = 0, up = 0;
  };

  static Jitters& about(int x, int y, const Cells& cells) {
    static thread_local Recent<Jitters> recent;
    Jitters& found = recent.at(cells.seed);
    if (found.x_ != x || found.y_ != y || !(found.cells_ == cells)) {
      found.x_ = x;
      found.y_ = y;
      found.cells_ = cells;
      found.isFound_ = {};
    }
    return found;
  }

  const Jitter& of(size_t k) {
    Jitter& jitter = jitters_[k];
    if (isFound_[k]) return jitter;
    isFound_[k] = true;
    jitter.i = static_cast<uint64_t>(wrapped(x_ + across(k), cells_.columns));
    jitter.j = static_cast<uint64_t>(wrapped(y_ + down(k), cells_.rows));
    jitter.aside = cells_.jitter * (chance(jitter.i, jitter.j, cells_.seed) - 0.5);
    jitter.up = cells_.jitter * (chance(jitter.i, jitter.j, cells_.seed + 1) - 0.5);
    return jitter;
  }

 private:
  Cells cells_;
  int x_ = 0, y_ = 0;
  std::array<Jitter, kSites> jitters_;
  std::array<bool, kSites> isFound_{};
};

/// The points of the cells about a place, 5 x 5 of them: two cells away is as far as a border can
/// come from. Those of the rim are found only where they may count.
class Sites {
 public:
  /// Without values of their own: many are never found.
  struct Site {
    double x, y;
    uint64_t i, j;
  };

  Sites(double u, double v, const Cells& c)
      : cells_(c),
        x_(u * c.columns),
        y_(v * c.rows),
        ix_(floorOf(x_)),
        iy_(floorOf(y_)),
        wide_(c.width / c.columns),
        high_(c.height / c.rows),
        jitters_(Jitters::about(ix_, iy_, c)) {
    for (size_t k = 0; k < kSites; ++k) {
      if (!isOnRim(k)) compare(k);
    }
    for (size_t k = 0; k < kSites; ++k) {
      if (isOnRim(k) && leastSquared(k) <= best_) compare(k);
    }
  }

  const Site& nearest() const { return sites_[nearest_]; }
  /// Squared.
  double distance() const { return best_; }

  /// To the border of the nearest one's cell.
  double border() {
    double border = 1e9;
    for (size_t k = 0; k < kSites; ++k) {
      if (isFound_[k]) border = std::min(border, borderTo(k));
    }
    // A border is at least half as far as its point is farther than the nearest one.
    const double far = 2 * border + std::sqrt(best_);
    for (size_t k = 0; k < kSites; ++k) {
      if (isFound_[k] || leastSquared(k) > far * far * (1 + kRounding)) continue;
      find(k);
      border = std::min(border, borderTo(k));
    }
    return border;
  }

 private:
  static constexpr double kRounding = 1e-9;

  static bool isOnRim(size_t k) { return std::abs(across(k)) == 2 || std::abs(down(k)) == 2; }

  /// The least that a point so many cells away is from a place that lies so far into its own cell.
  double least(int cells, double into) const {
    if (std::abs(cells) < 2) return 0;
    return std::max(0.0, (cells < 0 ? into + 1.5 : 2.5 - into) - cells_.jitter / 2);
  }
  double leastSquared(size_t k) const {
    const double x = least(across(k), x_ - ix_) * wide_, y = least(down(k), y_ - iy_) * high_;
    return (x * x + y * y) * (1 - kRounding);
  }

  void find(size_t k) {
    const Jitters::Jitter& jitter = jitters_.of(k);
    Site& s = sites_[k];
    s.i = jitter.i;
    s.j = jitter.j;
    s.x = (ix_ + across(k) + 0.5 + jitter.aside - x_) * wide_;
    s.y = (iy_ + down(k) + 0.5 + jitter.up - y_) * high_;
    isFound_[k] = true;
  }

  /// Of points as near as each other, the first counts.
  void compare(size_t k) {
    find(k);
    const double d = sites_[k].x * sites_[k].x + sites_[k].y * sites_[k].y;
    if (d > best_ || (d == best_ && k > nearest_)) return;
    best_ = d;
    nearest_ = k;
  }

  double borderTo(size_t k) const {
    const Site &s = sites_[k], &own = nearest();
    const double ax = s.x - own.x, ay = s.y - own.y, far = std::sqrt(ax * ax + ay * ay);
    if (k == nearest_ || far == 0) return 1e9;
    return ((s.x + own.x) * ax + (s.y + own.y) * ay) / (2 * far);
  }

  const Cells& cells_;
  double x_, y_;
  int ix_, iy_;
  double wide_, high_;
  Jitters& jitters_;
  std::array<Site, kSites> sites_;
  std::array<bool, kSites> isFound_{};
  size_t nearest_ = 0;
  double best_ = 1e9;
};

}  // namespace

Cell cellAt(double u, double v, const Cells& c) {
  Sites sites(u, v, c);
  const Sites::Site& own = sites.nearest();
  Cell out;
  out.point = std::sqrt(sites.distance());
  out.dx = -own.x;
  out.dy = -own.y;
  out.id = chance(own.i, own.j, c.seed + 2);
  out.second = chance(own.i, own.j, c.seed + 3);
  out.border = sites.border();
  return out;
}

Vec3 toneOf(const LibraryMaterial& m, double id) {
  return mix(rgb(m.color), rgb(m.second), m.variety * id * id);
}

uint64_t seedOf(const LibraryMaterial& m) { return hashBytes(m.name); }

}  // namespace gable::surface
