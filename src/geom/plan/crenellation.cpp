// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gaps are laid out as stretches of length along each ring; merlons are what lies between them. A
// merlon is its part of the line made as thick as the band, within the band; crenels are what is
// then left of the band, so that nothing is lost to rounding.

#include "geom/plan/crenellation.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/curve/curve.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "math/trig.h"

namespace gable {

namespace {

// Rings turn sharply at corners of more degrees than this; less is a round outline.
constexpr double kSharpTurn = 50;
// Parts of the band smaller than this share of a merlon's area are rounding.
constexpr double kSliver = 1e-3;
// An edge of a part lies on the outline when its middle is this near to it.
constexpr double kOnOutline = 1e-3;

bool sharpAt(const Ring& r, size_t i) {
  const size_t n = r.size();
  const Vec2 a = normalized(r[i] - r[(i + n - 1) % n]), b = normalized(r[(i + 1) % n] - r[i]);
  return dot(a, b) < cosDeg(kSharpTurn);
}

struct Stretch {
  double from = 0, to = 0;
};

/// One ring by length: from its first sharp corner, if it has one.
class Course {
 public:
  /// `lay`: the gaps as well, and not only how many there are.
  Course(const Ring& ring, const CrenellationOptions& o, bool lay = true) : o_(o), lay_(lay) {
    const size_t n = ring.size();
    size_t first = 0;
    while (first < n && !sharpAt(ring, first)) ++first;
    const bool round = first == n;
    double at = 0;
    for (size_t k = 0; k < n; ++k) {
      const size_t i = (first + k) % n;
      if (!round && sharpAt(ring, i)) corners_.push_back(at);
      points_.push_back(ring[i]);
      lengths_.push_back(at);
      at += length(ring[(i + 1) % n] - ring[i]);
    }
    whole_ = at;
    if (round) {
      layRound();
    } else {
      for (size_t c = 0; c < corners_.size(); ++c) {
        laySide(corners_[c], c + 1 < corners_.size() ? corners_[c + 1] : whole_);
      }
    }
  }

  const std::vector<Stretch>& gaps() const { return gaps_; }
  double gapCount() const { return count_; }
  double whole() const { return whole_; }

  /// The line between two lengths; `to` may lie beyond the end of the ring.
  Line part(const Stretch& s) const {
    Line out = {at(s.from)};
    work(2 * points_.size());
    for (int turn = 0; turn < 2; ++turn) {
      for (size_t i = 0; i < points_.size(); ++i) {
        const double l = lengths_[i] + turn * whole_;
        if (l > s.from && l < s.to) out.push_back(points_[i]);
      }
    }
    out.push_back(at(s.to));
    return out;
  }

 private:
  Vec2 at(double s) const {
    s -= whole_ * std::floor(s / whole_);
    const auto next = std::upper_bound(lengths_.begin(), lengths_.end(), s);
    const size_t i = static_cast<size_t>(next - lengths_.begin()) - 1;
    const Vec2 a = points_[i], b = points_[(i + 1) % points_.size()];
    const double l = length(b - a);
    return l > 0 ? a + (b - a) * ((s - lengths_[i]) / l) : a;
  }

  void laySide(double from, double to) {
    const double l = to - from;
    const double n = std::max(0.0, std::nearbyint((l - o_.merlon) / (o_.merlon + o_.gap)));
    if (n == 0) return;
    const double stretch = l / (n * o_.gap + (n + 1) * o_.merlon);
    count_ += n;
    if (!lay_) return;
    for (double i = 0; i < n; ++i) {
      work();
      const double at = from + stretch * ((i + 1) * o_.merlon + i * o_.gap);
      gaps_.push_back({at, at + stretch * o_.gap});
    }
  }

  void layRound() {
    if (whole_ <= o_.merlon + o_.gap) return;
    const double n = std::max(1.0, std::nearbyint(whole_ / (o_.merlon + o_.gap)));
    const double stretch = whole_ / (n * (o_.merlon + o_.gap));
    count_ += n;
    if (!lay_) return;
    for (double i = 0; i < n; ++i) {
      work();
      const double at = stretch * (i * (o_.merlon + o_.gap) + o_.merlon);
      gaps_.push_back({at, at + stretch * o_.gap});
    }
  }

  const CrenellationOptions& o_;
  bool lay_ = true;
  Line points_;
  std::vector<double> lengths_, corners_;
  double whole_ = 0, count_ = 0;
  std::vector<Stretch> gaps_;
};

/// Collects merlons, each within the band and off those before it.
class Merlons {
 public:
  Merlons(const Region& band, const CrenellationOptions& o)
      : band_(band), o_(o), least_(kSliver * o.merlon * o.thickness) {}

  void add(const Line& line) {
    Region r = intersect(thicken(line, o_.thickness), band_);
    keep(r);
  }
  /// A ring without gaps: all of the band that is near to it.
  void addRing(const Ring& ring) {
    Line closed = ring;
    closed.push_back(ring.front());
    Region r = intersect(thicken(closed, o_.thickness), band_);
    keep(r);
  }
  const Region& all() const { return all_; }

 private:
  void keep(Region& r) {
    Region before;
    for (const Polygon& p : r) {
      const Box2 box = bounds(p);
      work(all_.size());
      for (size_t i = 0; i < all_.size(); ++i) {
        if (box.meets(boxes_[i])) before.push_back(all_[i]);
      }
    }
    if (!before.empty()) r = subtract(r, before);
    for (Polygon& p : r) {
      if (area(p) < least_) continue;
      boxes_.push_back(bounds(p));
      all_.push_back(std::move(p));
    }
  }

  const Region& band_;
  const CrenellationOptions& o_;
  double least_;
  Region all_;
  std::vector<Box2> boxes_;
};

CrenellationPart partOf(Polygon p, const Polygon& whole) {
  CrenellationPart out{std::move(p), 0};
  double best = -1;
  const Ring& ring = out.polygon.outer;
  for (uint32_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if (length(b - a) <= best || distanceToBoundary(whole, (a + b) * 0.5) > kOnOutline) continue;
    best = length(b - a);
    out.front = i;
  }
  return out;
}

}  // namespace

double merlonCount(const Polygon& p, const CrenellationOptions& options) {
  double count = 0;
  for (const Ring& r : ringsOf({p})) {
    count += std::max(1.0, Course(r, options, false).gapCount());
  }
  return count;
}

Crenellation crenellate(const Polygon& p, const CrenellationOptions& options) {
  Crenellation out;
  out.rest = offset({p}, -options.thickness);
  const Region band = subtract({p}, out.rest);
  Merlons merlons(band, options);
  for (const Ring& ring : ringsOf({p})) {
    const Course course(ring, options);
    const std::vector<Stretch>& gaps = course.gaps();
    if (gaps.empty()) merlons.addRing(ring);
    for (size_t i = 0; i < gaps.size(); ++i) {
      // The last merlon goes on beyond the beginning of the ring.
      const double next = i + 1 < gaps.size() ? gaps[i + 1].from : gaps[0].from + course.whole();
      merlons.add(course.part({gaps[i].to, next}));
    }
  }
  for (const Polygon& m : merlons.all()) out.merlons.push_back(partOf(m, p));
  for (Polygon& c : subtract(band, merlons.all())) out.crenels.push_back(partOf(std::move(c), p));
  return out;
}

}  // namespace gable
