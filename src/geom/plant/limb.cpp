// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A limb is walked from its foot in steps; each step turns it towards the upright or down, and a
// little astray. Rings stand square to the walk, and their first point is carried along without
// twist (Bishop 1975). Boughs leave a limb a golden angle apart (phyllotaxis; Weber & Penn take 140
// degrees). Lengths are 4.3 of Weber & Penn, crowns their table of ShapeRatio.
#include "geom/plant/limb.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "base/work.h"
#include "math/trig.h"

namespace gable {

namespace {

/// Limbs of a tree whose stem has fewer sides are seen from afar.
constexpr double kCoarseSides = 8;

constexpr double kGoldenAngle = 137.50776405003785;
constexpr Vec3 kUp{0, 1, 0};

/// Chance of one limb.
class Chance {
 public:
  explicit Chance(uint64_t seed) : seed_(seed) {}
  /// In [0, 1), then in [-1, 1).
  double unit(uint64_t what) const { return randomUnit(hashCombine(seed_, what)); }
  double either(uint64_t what) const { return 2 * unit(what) - 1; }
  uint64_t of(uint64_t child) const { return hashCombine(seed_, child + (uint64_t{1} << 32)); }

 private:
  uint64_t seed_;
};

// Square to a unit direction; some direction where v is along it.
Vec3 squareTo(const Vec3& direction, const Vec3& v) {
  const Vec3 out = v - direction * dot(v, direction);
  if (length(out) > 1e-6) return normalized(out);
  const Vec3 other = std::fabs(direction.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  return normalized(other - direction * dot(other, direction));
}

// A unit direction, turned towards another one by an angle.
Vec3 turnedTo(const Vec3& from, const Vec3& to, double degrees) {
  return from * cosDeg(degrees) + squareTo(from, to) * sinDeg(degrees);
}

double angleBetween(const Vec3& a, const Vec3& b) {
  return acosDeg(std::clamp(dot(a, b), -1.0, 1.0));
}

// Towards the upright by a share of the angle to it, or down by one below 0.
Vec3 risen(const Vec3& direction, double rise, double angle) {
  const Vec3 to = rise < 0 ? kUp * -1 : kUp;
  const double left = angleBetween(direction, to);
  return left < 1e-6 ? direction : turnedTo(direction, to, std::min(left, std::fabs(rise) * angle));
}

double crownShare(CrownShape shape, double up) {
  const double down = 1 - up;
  switch (shape) {
    case CrownShape::Cone: return 0.15 + 0.85 * down;
    case CrownShape::Round: return 0.25 + 0.75 * sinDeg(180 * down);
    case CrownShape::Dome: return 0.3 + 0.7 * sinDeg(90 * down);
    case CrownShape::Even: return 1;
    case CrownShape::Taper: return 0.5 + 0.5 * down;
    case CrownShape::Flame: return down <= 0.7 ? 0.2 + 0.8 * down / 0.7 : 0.2 + 0.8 * up / 0.3;
    case CrownShape::Bowl: return 1 - 0.7 * down;
  }
  return 1;
}

const LimbLevel& levelOf(const LimbOptions& o, size_t level) {
  return o.levels[std::min(level, o.levels.size() - 1)];
}

/// Where a limb begins.
struct Foot {
  Vec3 at, along;
  double length = 0, radius = 0;
  /// Radius and slant of the limb that carries it; 0 for the stem.
  double inside = 0, slant = 90;
  /// It goes on where the one that carries it ends.
  bool goesOn = false;
  size_t level = 0;
  uint64_t seed = 0;
};

/// Widens the foot of a limb: the stem's to its roots, a bough's to a collar where it leaves the
/// skin of the limb that carries it.
struct Collar {
  double until = 0, reach = 0, wider = 0;
  double at(double distance) const {
    if (reach <= 0 || distance >= until + reach) return 1;
    const double t = std::max(0.0, distance - until) / reach;
    return 1 + wider * (1 - t) * (1 - t);
  }
};

Collar collarOf(const LimbOptions& o, const Foot& f) {
  // Of twigs nobody sees it, nor of boughs from afar.
  if (f.goesOn || f.level > 1 || (f.level == 1 && o.sides < kCoarseSides)) return {};
  if (f.level == 0) return {0, std::min(4 * f.radius, 0.4 * f.length), o.flare};
  const double sine = std::max(0.35, sinDeg(f.slant));
  const double out = std::min(f.inside / sine, 0.5 * f.length);
  return {0.85 * out, std::min(2.5 * f.radius, 0.3 * f.length),
          std::min(0.7, 0.4 * f.inside / f.radius)};
}

// Distances of the rings: close in the collar, even beyond it.
std::vector<double> ringDistances(const Collar& collar, double length, uint32_t steps) {
  std::vector<double> out{0};
  if (collar.until > 0) out.push_back(collar.until);
  if (collar.reach > 0) {
    for (const double t : {0.3, 0.65, 1.0}) out.push_back(collar.until + t * collar.reach);
  }
  const double begin = out.back();
  for (uint32_t i = 1; i <= steps; ++i) out.push_back(begin + (length - begin) * i / steps);
  return out;
}

class Grower {
 public:
  explicit Grower(const LimbOptions& o) : o_(o) {}

  LimbSystem take() {
    const LimbCounts counts = limbCounts(o_);
    reserveWork(pending_, counts.limbs);
    reserveWork(out_.limbs, counts.limbs);
    reserveWork(out_.leaves, counts.leaves);
    // The rings; twigs have fewer.
    workMemory(static_cast<uint64_t>(counts.limbs * (o_.sides + 6) * sizeof(Limb::Ring)));
    Foot stem;
    stem.along = kUp;
    stem.length = o_.length;
    stem.radius = o_.width / 2;
    stem.seed = o_.seed;
    pending_.push_back(stem);
    // Breadth first: limbs of one order lie together.
    for (size_t i = 0; i < pending_.size(); ++i) grow(Foot{pending_[i]});
    return std::move(out_);
  }

 private:
  size_t lastLevel() const { return o_.levels.size() - 1; }

  uint32_t sidesOf(const Foot& f) const {
    const double share = std::sqrt(std::min(1.0, 2 * f.radius / o_.width));
    return static_cast<uint32_t>(std::max(3.0, std::nearbyint(o_.sides * share)));
  }

  // Twigs have as few as their turn lets them. What is straight has one: its taper is even.
  uint32_t stepsOf(size_t order, const LimbLevel& level, double turn, bool lobed) const {
    if (level.wander == 0 && (level.rise == 0 || turn == 0) && !lobed) return 1;
    // Where limbs have few sides, bends may be coarse as well.
    const double fine = std::min(1.0, o_.sides / (kCoarseSides + 2));
    const double turned = fine * (4 * std::fabs(level.rise) + level.wander / 45);
    if (order > 1) return 1 + static_cast<uint32_t>(turned);
    return static_cast<uint32_t>(
        std::max(2.0, std::nearbyint(o_.sides * (order == 0 ? 0.9 : 0.55))));
  }

  void grow(const Foot& f) {
    const LimbLevel& level = levelOf(o_, f.level);
    const Chance chance(f.seed);
    Limb limb;
    limb.level = static_cast<uint32_t>(f.level);
    limb.sides = sidesOf(f);
    limb.pointed = f.level > 1 || (f.level == 1 && o_.sides < kCoarseSides && level.tip < 0.15);
    const Collar collar = collarOf(o_, f);
    // Fewer sides show no lobes.
    if (f.level == 0 && limb.sides >= 10) limb.lobes = 0.35 * o_.flare;
    const Vec3 aim = level.rise < 0 ? kUp * -1 : kUp;
    const double turn = angleBetween(f.along, aim);
    const uint32_t steps = stepsOf(f.level, level, turn, limb.lobes > 0);
    const std::vector<double> distances = ringDistances(collar, f.length, steps);
    Limb::Ring ring{f.at, f.along, squareTo(f.along, {chance.either(1), 0.3, chance.either(2)}), 0,
                    0};
    // Two slow waves across the limb make it stray.
    const Vec3 stray = ring.aside, other = cross(ring.along, ring.aside);
    for (size_t i = 0; i < distances.size(); ++i) {
      work();
      const double step = i == 0 ? 0 : distances[i] - distances[i - 1];
      ring.at += ring.along * step;
      ring.distance = distances[i];
      const double t = ring.distance / f.length, share = step / f.length;
      ring.radius = std::max(o_.leastWidth / 2, f.radius * (1 - (1 - level.tip) * t)) *
                    collar.at(ring.distance);
      limb.rings.push_back(ring);
      if (i + 1 == distances.size()) break;
      const double next = (distances[i + 1] - distances[i]) / f.length;
      Vec3 to = risen(ring.along, level.rise, turn * next);
      const double far = std::sqrt(std::max(share, next)) * level.wander;
      to = normalized(to + stray * sinDeg(far * chance.either(10 + 2 * i)) +
                      other * sinDeg(far * chance.either(11 + 2 * i)));
      ring.along = to;
      ring.aside = squareTo(to, ring.aside);
    }
    if (f.level < lastLevel()) {
      addBoughs(f, limb, level, chance);
    } else {
      addLeaves(limb, chance);
    }
    out_.limbs.push_back(std::move(limb));
  }

  // The place at a share of the length.
  static Limb::Ring placeAt(const Limb& limb, double t) {
    const double distance = t * limb.rings.back().distance;
    size_t i = 1;
    while (i + 1 < limb.rings.size() && limb.rings[i].distance < distance) ++i;
    const Limb::Ring &a = limb.rings[i - 1], &b = limb.rings[i];
    const double long_ = b.distance - a.distance;
    const double s = long_ > 0 ? std::clamp((distance - a.distance) / long_, 0.0, 1.0) : 0;
    Limb::Ring out = a;
    out.at = a.at + (b.at - a.at) * s;
    out.along = normalized(a.along + (b.along - a.along) * s);
    out.aside = squareTo(out.along, a.aside + (b.aside - a.aside) * s);
    out.radius = a.radius + (b.radius - a.radius) * s;
    return out;
  }

  // Off a limb by an angle, so far around it.
  static Vec3 offset(const Limb::Ring& place, double angle, double around, double flat) {
    const Vec3 third = cross(place.along, place.aside);
    Vec3 out = place.aside * cosDeg(around) + third * sinDeg(around);
    const Vec3 up = squareTo(place.along, kUp);
    out = out - up * (flat * dot(out, up));
    out = length(out) > 1e-3 ? normalized(out) : cross(place.along, up);
    return place.along * cosDeg(angle) + out * sinDeg(angle);
  }

  void addBoughs(const Foot& f, const Limb& limb, const LimbLevel& level, const Chance& chance) {
    const double count = std::floor(level.boughs);
    // A limb that ends thick ends in its last bough.
    const bool cutOff = level.tip >= 0.25 && level.thick >= 0.3;
    const double first = 360 * chance.unit(3);
    for (double i = 0; i < count; ++i) {
      work();
      const auto k = static_cast<uint64_t>(i);
      const Chance own(chance.of(k));
      const bool last = cutOff && i + 1 == count;
      double up = last ? 1 : (i + 0.2 + 0.6 * own.unit(4)) / (cutOff ? count - 0.5 : count);
      up = std::min(up, 1.0);
      const double t = last ? 1 : level.from + (0.98 - level.from) * up;
      const Limb::Ring place = placeAt(limb, t);
      double share = f.level == 0 ? crownShare(o_.crown, up) : 1 - 0.55 * t;
      share *= level.share * (0.85 + 0.3 * own.unit(5));
      Foot bough;
      bough.at = place.at;
      bough.slant =
          (level.angle + (level.topAngle - level.angle) * up) * (0.85 + 0.3 * own.unit(6));
      if (last) bough.slant = std::min(bough.slant, 0.5 * level.topAngle);
      const double around = first + kGoldenAngle * i + 25 * own.either(7);
      bough.along = offset(place, bough.slant, around, level.flat);
      bough.length = share * f.length;
      bough.inside = place.radius;
      bough.goesOn = last;
      const double most = f.level == 0 ? 1 : 1 - 0.55 * level.from;
      const double thick =
          level.thick * std::sqrt(std::min(1.0, share / std::max(1e-9, level.share * most)));
      bough.radius = last ? place.radius : std::min(0.95, thick) * place.radius;
      bough.radius = std::max(bough.radius, o_.leastWidth / 2);
      bough.level = f.level + 1;
      bough.seed = chance.of(k);
      if (bough.length > 2 * bough.radius) pending_.push_back(bough);
    }
  }

  void addLeaves(const Limb& limb, const Chance& chance) {
    const LeafOptions& leaf = o_.leaf;
    const double count = std::floor(leaf.count);
    const double first = 360 * chance.unit(20);
    for (double i = 0; i < count; ++i) {
      work();
      const auto k = static_cast<uint64_t>(i);
      const Chance own(hashCombine(chance.of(k), 77));
      const bool last = i + 1 == count;
      const double t = last ? 1 : leaf.from + (1 - leaf.from) * (i + own.unit(0)) / count;
      const Limb::Ring place = placeAt(limb, t);
      const double angle = (last ? 0.2 : 1) * leaf.angle * (0.75 + 0.5 * own.unit(1));
      Vec3 along = offset(place, angle, first + kGoldenAngle * i + 40 * own.either(2), leaf.flat);
      const Vec3 to = leaf.rise < 0 ? kUp * -1 : kUp;
      along = risen(along, leaf.rise, angleBetween(along, to));
      // The upper side looks up, as far as the leaf's direction lets it, and a little away.
      const Vec3 tilt{0.7 * own.either(3), 1, 0.7 * own.either(4)};
      const Vec3 off = squareTo(along, tilt);
      LeafPlace out;
      out.scale = 0.8 + 0.4 * own.unit(5);
      const Vec3 side = cross(along, off);
      out.frame = Frame::of(place.at, side, along, off);
      const double cells = std::max(1.0, std::floor(leaf.looks));
      out.look = static_cast<uint32_t>(std::min(cells * cells - 1, own.unit(6) * cells * cells));
      out_.leaves.push_back(out);
    }
  }

  const LimbOptions& o_;
  std::vector<Foot> pending_;
  LimbSystem out_;
};

// How far the skin stands off the axis: the roots of a stem make lobes of its foot.
double lobed(const Limb& limb, const Limb::Ring& ring, double around) {
  if (limb.lobes <= 0) return 1;
  const double reach = 4 * limb.rings.back().radius + 2 * limb.rings.front().radius;
  const double low = std::max(0.0, 1 - ring.distance / std::max(1e-9, reach));
  return 1 + limb.lobes * low * low * cosDeg(5 * around);
}

/// The skin of one limb: rings of points, triangles between them, caps.
class Skin {
 public:
  Skin(MeshBuilder& b, const Limb& limb) : b_(b), limb_(limb), n_(limb.sides) {
    const double middle = limb.rings[limb.rings.size() / 2].radius;
    tiles_ = std::max(1.0, std::nearbyint(2 * kPi * middle));
    tile_ = std::max(1e-9, 2 * kPi * middle / tiles_);
  }

  void add() {
    const size_t rings = limb_.rings.size();
    for (size_t r = 0; r < rings; ++r) addRing(r);
    for (size_t r = 0; r + 1 < rings; ++r) {
      for (uint32_t i = 0; i < n_; ++i) addBand(r, i);
    }
    addCap(false);
    if (!limb_.pointed) addCap(true);
  }

 private:
  bool isPoint(size_t r) const { return limb_.pointed && r + 1 == limb_.rings.size(); }

  void addRing(size_t r) {
    const Limb::Ring& ring = limb_.rings[r];
    const Vec3 third = cross(ring.along, ring.aside);
    // The skin leans with the taper.
    const Limb::Ring& low = limb_.rings[r == 0 ? 0 : r - 1];
    const Limb::Ring& high = limb_.rings[std::min(r + 1, limb_.rings.size() - 1)];
    const double run = high.distance - low.distance;
    const double lean = run > 0 ? (low.radius - high.radius) / run : 0;
    const uint32_t point = isPoint(r) ? b_.addPosition(ring.at) : 0;
    for (uint32_t i = 0; i < n_; ++i) {
      work();
      const double around = 360.0 * i / n_;
      const Vec3 out = ring.aside * cosDeg(around) + third * sinDeg(around);
      const Vec3 at = ring.at + out * (ring.radius * lobed(limb_, ring, around));
      points_.push_back(isPoint(r) ? point : b_.addPosition(at));
      normals_.push_back(isPoint(r) ? ring.along : normalized(out + ring.along * lean));
    }
  }

  // Twigs are most of a tree's limbs, so they take few vertices: a point is one, whichever side it
  // ends, and where sides are few the last of them shows the tiles backwards, to where u begins.
  double around(size_t r, uint32_t i) const {
    constexpr uint32_t kFew = 4;
    if (isPoint(r)) return 0.5;
    return limb_.pointed && n_ <= kFew ? 1.0 * (i % n_) / (n_ - 1) : 1.0 * i / n_;
  }
  void corner(size_t r, uint32_t i) {
    const size_t at = r * n_ + i % n_;
    const uint32_t c = b_.addCorner(points_[at]);
    b_.setUv(c, 0, {tiles_ * around(r, i), limb_.rings[r].distance / tile_});
    b_.setNormal(c, normals_[at]);
  }
  void triangle(size_t r0, uint32_t i0, size_t r1, uint32_t i1, size_t r2, uint32_t i2) {
    b_.beginFace();
    b_.beginLoop();
    corner(r0, i0);
    corner(r1, i1);
    corner(r2, i2);
  }
  // Triangles: a ring and the next one seldom lie in one plane.
  void addBand(size_t r, uint32_t i) {
    const bool turned = (r + i) % 2 == 0 && !isPoint(r + 1);
    triangle(r, i, r, i + 1, r + 1, turned ? i + 1 : i);
    if (!isPoint(r + 1)) triangle(r + 1, i + 1, r + 1, i, r, turned ? i : i + 1);
  }
  // A bough's foot lies inside what carries it: nobody sees it, and it takes the skin's vertices.
  void addCap(bool end) {
    const size_t r = end ? limb_.rings.size() - 1 : 0;
    b_.beginFace();
    b_.beginLoop();
    for (uint32_t k = 0; k < n_; ++k) {
      const uint32_t i = end ? k : n_ - 1 - k;
      if (!end && limb_.level > 0) {
        corner(r, i);
        continue;
      }
      const uint32_t c = b_.addCorner(points_[r * n_ + i]);
      const double around = 360.0 * i / n_;
      b_.setUv(c, 0, {0.5 + 0.5 * cosDeg(around), 0.5 + 0.5 * sinDeg(around)});
      b_.setNormal(c, limb_.rings[r].along * (end ? 1.0 : -1.0));
    }
  }

  MeshBuilder& b_;
  const Limb& limb_;
  uint32_t n_;
  double tiles_ = 1, tile_ = 1;
  std::vector<uint32_t> points_;
  std::vector<Vec3> normals_;
};

}  // namespace

LimbCounts limbCounts(const LimbOptions& o) {
  LimbCounts out;
  double level = 1;
  for (size_t i = 0; i + 1 < o.levels.size(); ++i) {
    level *= std::floor(o.levels[i].boughs);
    out.limbs += level;
  }
  out.leaves = level * std::floor(o.leaf.count);
  return out;
}

LimbSystem growLimbs(const LimbOptions& o) { return Grower(o).take(); }

void addSkin(MeshBuilder& b, const Limb& limb) { Skin(b, limb).add(); }

void addLeaf(MeshBuilder& b, const LeafPlace& place, const LeafOptions& leaf) {
  const double w = leaf.width * place.scale / 2, l = leaf.length * place.scale;
  const double cells = std::max(1.0, std::floor(leaf.looks));
  const double column = std::fmod(place.look, cells), row = std::floor(place.look / cells);
  const double lift = w * sinDeg(leaf.fold), half = w * cosDeg(leaf.fold);
  const auto position = [&](double x, double y, double z) {
    return b.addPosition(place.frame.point({x, y, z}));
  };
  const uint32_t left[2] = {position(-half, 0, lift), position(-half, l, lift)};
  const uint32_t right[2] = {position(half, 0, lift), position(half, l, lift)};
  const auto corner = [&](uint32_t p, double u, double v) {
    b.setUv(b.addCorner(p), 0, {(column + u) / cells, (row + v) / cells});
  };
  const auto face = [&](const uint32_t* from, const uint32_t* to, double u, double until) {
    b.beginFace();
    b.beginLoop();
    corner(from[0], u, 0);
    corner(to[0], until, 0);
    corner(to[1], until, 1);
    corner(from[1], u, 1);
  };
  if (leaf.fold == 0) {
    face(left, right, 0, 1);
    return;
  }
  const uint32_t middle[2] = {position(0, 0, 0), position(0, l, 0)};
  face(left, middle, 0, 0.5);
  face(middle, right, 0.5, 1);
}

}  // namespace gable
