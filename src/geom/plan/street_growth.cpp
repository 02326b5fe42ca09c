// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Fields: G. Chen, G. Esch, P. Wonka, P. Mueller, E. Zhang, "Interactive Procedural Street
// Modeling", SIGGRAPH 2008: directions are averaged as tensors, that is with doubled angles, so
// that opposite ones agree. Lines are traced with the fourth-order Runge-Kutta step and kept apart
// as in B. Jobard, W. Lefer, "Creating Evenly-Spaced Streamlines of Arbitrary Density", 1997.
#include "geom/plan/street_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>

#include "base/random.h"
#include "base/work.h"
#include "geom/region/segment_grid.h"
#include "math/noise.h"
#include "math/trig.h"

namespace gable {

namespace {

constexpr size_t kMostSteps = 20000;
/// How far the straight pieces of a street may lie from its curve, in metres.
constexpr double kBend = 0.3;

double degreesOf(Vec2 d) { return atan2Deg(d.y, d.x); }
Vec2 unit(double degrees) { return {cosDeg(degrees), sinDeg(degrees)}; }

Box2 boxOf(const Region& area) {
  Box2 box;
  for (const Polygon& p : area) {
    const Box2 b = bounds(p);
    box.include(b.min);
    box.include(b.max);
  }
  return box;
}

bool isIn(const Region& area, Vec2 p) {
  return std::any_of(area.begin(), area.end(), [&](const Polygon& q) { return contains(q, p); });
}

// The parts of a line within the area, cut at every crossing with its border.
void clip(const Region& area, const Line& line, double width, std::vector<Street>& out) {
  Line part;
  const auto flush = [&] {
    if (part.size() > 1 && out.size() < kMostGrown) out.push_back({part, width});
    part.clear();
  };
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 a = line[i], d = line[i + 1] - line[i];
    work(4);
    std::vector<double> cuts{0, 1};
    for (const Polygon& p : area) {
      for (const Segment& s : edgesOf(p)) {
        const Vec2 v = s.b - s.a;
        const double det = cross(d, v);
        if (det == 0) continue;
        const double t = cross(s.a - a, v) / det, u = cross(s.a - a, d) / det;
        if (t > 0 && t < 1 && u >= 0 && u <= 1) cuts.push_back(t);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Vec2 from = a + d * cuts[k], to = a + d * cuts[k + 1];
      if (!isIn(area, (from + to) * 0.5)) {
        flush();
        continue;
      }
      if (part.empty()) part.push_back(from);
      part.push_back(to);
    }
  }
  flush();
}

double moved(double share, double step, uint64_t address, uint64_t k) {
  return std::clamp(share, 0.0, 0.4) * step * randomIn(hashCombine(address, k), -1, 1);
}

}  // namespace

std::vector<Street> streetsWithin(const Region& area, const std::vector<Street>& streets) {
  std::vector<Street> out;
  for (const Street& s : streets) clip(area, s.line, s.width, out);
  return out;
}

std::vector<Street> gridStreets(const Region& area, const GridStreets& o) {
  std::vector<Street> out;
  const Vec2 x = unit(o.angle), y = perpendicular(x);
  Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  for (const Polygon& p : area) {
    for (const Vec2 q : p.outer) {
      low = {std::min(low.x, dot(q, x)), std::min(low.y, dot(q, y))};
      high = {std::max(high.x, dot(q, x)), std::max(high.y, dot(q, y))};
    }
  }
  const auto family = [&](Vec2 along, Vec2 across, double from, double to, double begin, double end,
                          double spacing, uint64_t salt) {
    if (!(spacing > 0) || !(end > begin)) return;
    const double count = std::min(std::floor((end - begin) / spacing), double{kMostGrown});
    const double start = (begin + end - count * spacing) / 2;
    for (double i = 0; i <= count; ++i) {
      work(8);
      const double at =
          start + i * spacing +
          moved(o.irregularity, spacing, hashCombine(o.address, salt), static_cast<uint64_t>(i));
      clip(area, {along * from + across * at, along * to + across * at}, o.width, out);
    }
  };
  family(x, y, low.x, high.x, low.y, high.y, o.spacing, 1);
  family(y, x, low.y, high.y, low.x, high.x, o.crossSpacing, 2);
  return out;
}

std::vector<Street> radialStreets(const Region& area, const RadialStreets& o) {
  std::vector<Street> out;
  if (area.empty() || !(o.spacing > 0)) return out;
  double far = 0;
  for (const Polygon& p : area) {
    for (const Vec2 q : p.outer) far = std::max(far, length(q - o.center));
  }
  const double rings = std::min(std::floor(far / o.spacing), double{kMostGrown} / 4);
  std::vector<double> radius{0};
  for (double i = 1; i <= rings + 1; ++i) {
    radius.push_back(i * o.spacing + moved(o.irregularity, o.spacing, hashCombine(o.address, 1),
                                           static_cast<uint64_t>(i)));
  }
  for (size_t i = 1; i < radius.size(); ++i) {
    clip(area, arc(o.center, radius[i], 0, 360, 0.1), o.width, out);
  }
  // A spoke begins at the first ring where there is room for it.
  size_t count = std::max<size_t>(o.spokes, 1);
  for (size_t ring = 0; ring + 1 < radius.size(); ++ring) {
    const bool first = ring == 0;
    const bool doubled =
        !first && 2 * kPi * radius[ring] / static_cast<double>(count) >= 2 * o.spacing;
    if (!first && !doubled) continue;
    for (size_t k = 0; k < count; ++k) {
      work(8);
      const double step = 360.0 / static_cast<double>(count);
      const double angle = step * (static_cast<double>(k) + (first ? 0 : 0.5)) +
                           moved(o.irregularity / 2, step, hashCombine(o.address, 2 + ring), k);
      clip(area,
           {o.center + unit(angle) * radius[ring], o.center + unit(angle) * (far + o.spacing)},
           o.width, out);
    }
    if (doubled) count *= 2;
  }
  return out;
}

void DirectionField::addGrid(Vec2 center, double angle, double reach) {
  sources_.push_back({center, angle, reach, false});
}

void DirectionField::addRadial(Vec2 center, double reach) {
  sources_.push_back({center, 0, reach, true});
}

void DirectionField::setNoise(double degrees, double scale, uint64_t address) {
  noise_ = degrees;
  scale_ = scale > 0 ? scale : 1;
  address_ = address;
}

Vec2 DirectionField::direction(Vec2 p) const {
  Vec2 sum;
  for (const Source& s : sources_) {
    const Vec2 d = p - s.center;
    const double share = s.reach > 0 ? expOf(-dot(d, d) / (s.reach * s.reach)) : 1;
    if (s.radial && d == Vec2{}) continue;
    const double angle = s.radial ? degreesOf(d) + 90 : s.angle;
    sum = sum + unit(2 * angle) * share;
  }
  if (length(sum) < 1e-9) return {};
  double angle = degreesOf(sum) / 2;
  if (noise_ != 0) angle += noise_ * fractalNoise(p * (1 / scale_), 2, address_);
  return unit(angle);
}

namespace {

// Points of the lines of one direction, to keep new ones apart.
class Traces {
 public:
  explicit Traces(double cell) : cell_(cell) {}
  void add(Vec2 p) { cells_[key(p)].push_back(p); }
  bool anyWithin(Vec2 p, double distance) const {
    const auto n = static_cast<int64_t>(std::ceil(distance / cell_));
    const auto [cx, cy] = key(p);
    for (int64_t x = cx - n; x <= cx + n; ++x) {
      for (int64_t y = cy - n; y <= cy + n; ++y) {
        work(4);
        const auto at = cells_.find({x, y});
        if (at == cells_.end()) continue;
        work(at->second.size());
        for (const Vec2 q : at->second) {
          if (length(q - p) < distance) return true;
        }
      }
    }
    return false;
  }

 private:
  std::pair<int64_t, int64_t> key(Vec2 p) const {
    return {static_cast<int64_t>(std::floor(p.x / cell_)),
            static_cast<int64_t>(std::floor(p.y / cell_))};
  }
  double cell_;
  std::map<std::pair<int64_t, int64_t>, std::vector<Vec2>> cells_;
};

class Grower {
 public:
  Grower(const Region& area, const DirectionField& field, const FieldStreets& o)
      : area_(area), field_(field), options_(o), box_(boxOf(area)) {}

  std::vector<Street> grow() {
    if (area_.empty()) return {};
    if (options_.mainSpacing > 0) level(options_.mainSpacing, options_.mainWidth, 1);
    if (options_.spacing > 0) level(options_.spacing, options_.width, 2);
    return std::move(out_);
  }

 private:
  // All streets of one rank, one direction after the other from each seed.
  void level(double spacing, double width, uint64_t rank) {
    step_ = std::clamp(spacing / 20, 1.0, 10.0);
    std::array<Traces, 2> traces{Traces(spacing / 2), Traces(spacing / 2)};
    for (size_t k = 0; k < lines_.size(); ++k) {
      for (const Vec2 p : lines_[k]) traces[family_[k]].add(p);
    }
    const Vec2 size = box_.max - box_.min;
    const double tries = std::min(6 * size.x * size.y / (spacing * spacing) + 16, 200000.0);
    // Beside the streets there are, a spacing away, new ones fit best.
    std::deque<Vec2> open;
    const uint64_t address = hashCombine(options_.address, rank);
    for (double i = 0; i < tries && out_.size() < kMostGrown;) {
      work(16);
      Vec2 seed;
      if (open.empty()) {
        const uint64_t draw = hashCombine(address, static_cast<uint64_t>(i));
        seed = box_.min + Vec2{size.x * randomUnit(hashCombine(draw, 0)),
                               size.y * randomUnit(hashCombine(draw, 1))};
        ++i;
      } else {
        seed = open.front();
        open.pop_front();
      }
      if (!isIn(area_, seed)) continue;
      for (const size_t family : {0u, 1u}) {
        if (traces[family].anyWithin(seed, spacing * 0.95)) continue;
        Line line = traced(seed, family, traces[family], spacing / 2);
        if (line.size() < 2 || Path(line).length() < options_.shortest) continue;
        for (const Vec2 p : line) traces[family].add(p);
        const Path path(line);
        for (double s = spacing / 2; s < path.length(); s += spacing) {
          work(16);
          const Path::Place at = path.at(s);
          for (const double side : {1.0, -1.0}) {
            open.push_back(at.point + perpendicular(at.tangent) * (side * spacing));
          }
        }
        lines_.push_back(line);
        family_.push_back(family);
        out_.push_back({simplified(joinedEnds(std::move(line), spacing), kBend), width});
      }
    }
  }

  Vec2 heading(Vec2 p, size_t family, Vec2 before) const {
    Vec2 d = field_.direction(p);
    if (family == 1) d = perpendicular(d);
    return dot(d, before) < 0 ? -d : d;
  }

  Line half(Vec2 seed, size_t family, Vec2 direction, const Traces& others, double apart) const {
    Line out;
    Vec2 p = seed, d = direction;
    double gone = 0;
    for (size_t i = 0; i < kMostSteps; ++i) {
      work(64);
      const Vec2 k1 = heading(p, family, d);
      const Vec2 k2 = heading(p + k1 * (step_ / 2), family, k1);
      const Vec2 k3 = heading(p + k2 * (step_ / 2), family, k1);
      const Vec2 k4 = heading(p + k3 * step_, family, k1);
      const Vec2 next = normalized(k1 + k2 * 2 + k3 * 2 + k4);
      if (next == Vec2{}) break;
      p = p + next * step_;
      d = next;
      gone += step_;
      if (!isIn(area_, p)) {
        out.push_back(p);
        break;
      }
      if (others.anyWithin(p, apart)) break;
      // Once round: the ring closes.
      if (gone > 4 * apart && length(p - seed) < step_) {
        out.push_back(seed);
        break;
      }
      // A spiral comes back to itself without closing.
      if (i % 8 == 0 && gone > 4 * apart && comesBack(out, p, apart)) break;
      out.push_back(p);
    }
    return out;
  }
  bool comesBack(const Line& line, Vec2 p, double apart) const {
    work(line.size() / 4);
    const auto recent = static_cast<size_t>(std::ceil(3 * apart / step_));
    for (size_t i = 0; i + recent < line.size(); i += 4) {
      if (length(line[i] - p) < apart) return true;
    }
    return false;
  }

  Line traced(Vec2 seed, size_t family, const Traces& others, double apart) const {
    const Vec2 d = heading(seed, family, {1, 0});
    if (d == Vec2{}) return {};
    const Line forward = half(seed, family, d, others, apart);
    const bool ring = !forward.empty() && forward.back() == seed;
    Line line = ring ? Line{} : half(seed, family, -d, others, apart);
    std::reverse(line.begin(), line.end());
    line.push_back(seed);
    line.insert(line.end(), forward.begin(), forward.end());
    return line;
  }

  // An end in the open goes straight on to the next street, where one is near.
  Line joinedEnds(Line line, double reach) const {
    if (line.front() == line.back()) return line;
    for (int end = 0; end < 2; ++end) {
      const Vec2 tip = line.back();
      if (isIn(area_, tip)) {
        const Vec2 d = normalized(tip - line[line.size() - 2]);
        double best = reach;
        for (const Line& other : lines_) {
          work(other.size());
          for (size_t i = 0; i + 1 < other.size(); ++i) {
            const Vec2 v = other[i + 1] - other[i], w = other[i] - tip;
            const double det = cross(d, v);
            if (std::fabs(det) < 1e-9) continue;
            const double t = cross(w, v) / det, u = cross(w, d) / det;
            if (t > step_ / 2 && t < best && u >= 0 && u <= 1) best = t;
          }
        }
        if (best < reach) line.push_back(tip + d * best);
      }
      std::reverse(line.begin(), line.end());
    }
    return line;
  }

  const Region& area_;
  const DirectionField& field_;
  const FieldStreets& options_;
  Box2 box_;
  double step_ = 2;
  std::vector<Line> lines_;
  std::vector<size_t> family_;
  std::vector<Street> out_;
};

}  // namespace

std::vector<Street> fieldStreets(const Region& area, const DirectionField& field,
                                 const FieldStreets& options) {
  return Grower(area, field, options).grow();
}

}  // namespace gable
