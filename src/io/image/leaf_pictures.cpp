// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A leaf's outline is half a width for each share of its middle rib, after the forms that botany
// has names for: cordate, rhombic, lanceolate, lobed; palmate leaves are several of them. Leaves
// are painted one over the other, each with a shadow on those below, at twice the size.
#include "io/image/leaf_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/check.h"
#include "base/elementary.h"
#include "base/work.h"
#include "io/image/palette.h"
#include "io/image/surface_noise.h"
#include "material/builtin_textures.h"
#include "math/trig.h"

namespace gable {

namespace {

using surface::chance;

constexpr int kCells = 2, kFine = 2;
constexpr int kCell = static_cast<int>(kLeafPictureSize) / kCells * kFine;
// The picture takes a third of the room that it takes with all its colours, and nobody sees it.
constexpr size_t kLeafColors = 64;

/// Half the width of a leaf over its length: it widens like t^low and narrows like (1 - t)^high.
struct Outline {
  double width, low, high;
  /// Teeth or lobes: how many on a side, how deep.
  double lobes = 0, depth = 0;
};

/// An outline at many places of the rib: powers take long.
class Profile {
 public:
  explicit Profile(const Outline& o) : width_(o.width) {
    const double top = o.low / (o.low + o.high);
    const double most = powOf(top, o.low) * powOf(1 - top, o.high);
    for (size_t i = 1; i + 1 < half_.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(half_.size() - 1);
      half_[i] = 0.5 * powOf(t, o.low) * powOf(1 - t, o.high) / most;
      if (o.lobes > 0) half_[i] *= 1 - o.depth * (0.5 - 0.5 * cosDeg(360 * o.lobes * t));
    }
  }
  double width() const { return width_; }
  /// Half the width over the length; `t` in [0, 1].
  double half(double t, double width) const {
    return width * half_[static_cast<size_t>(t * static_cast<double>(half_.size() - 1) + 0.5)];
  }

 private:
  double width_;
  std::array<double, 257> half_{};
};

/// How the leaves of a twig stand.
enum class Habit : uint8_t {
  Twig,
  Palmate,
  Fingers,
  Needles,
  Comb,
  Scales,
  One,
  Blossom,
  Candle,
  Tuft
};

struct LeafKind {
  Habit habit;
  Outline outline;
  /// How many, or how many twigs beside the middle one; how long in cells; between them and what
  /// carries them.
  int count;
  double length, angle;
  /// Of a spray: from one leaf to the next, as a share of their length; between twigs and the
  /// middle one.
  double gap = 0.5, spread = 48;
};

// In the order of kBuiltinLeaves.
constexpr std::array<LeafKind, kBuiltinLeaves.size()> kKinds{{
    {Habit::Twig, {0.62, 0.6, 0.85, 10, 0.2}, 8, 0.13, 55, 0.36, 46},     // birch
    {Habit::Blossom, {0.9, 0.7, 0.35}, 46, 0.075, 50},                    // blossom
    {Habit::Candle, {0.8, 0.6, 0.5}, 80, 0.06, 60},                       // candle
    {Habit::Twig, {0.5, 0.7, 0.75, 20, 0.07}, 8, 0.19, 48, 0.34, 48},     // cherry
    {Habit::Fingers, {0.36, 1.5, 0.5, 18, 0.05}, 3, 0.3, 60, 0.8, 52},    // chestnut
    {Habit::Scales, {0.2, 0.3, 0.4}, 15, 0.34, 32},                       // cypress
    {Habit::Tuft, {0.045, 0.25, 0.9}, 42, 0.9, 21},                       // grass
    {Habit::Palmate, {0.5, 0.4, 1.1}, 7, 0.17, 55, 0.5, 60},              // ivy
    {Habit::Twig, {0.86, 0.42, 0.72, 22, 0.07}, 8, 0.165, 52, 0.42, 52},  // lime
    {Habit::Twig, {0.6, 0.95, 0.42, 4.5, 0.45}, 8, 0.19, 48, 0.36, 50},   // oak
    {Habit::Twig, {0.2, 0.6, 0.6}, 9, 0.15, 42, 0.25, 38},                // olive
    {Habit::One, {0.85, 0.25, 0.8}, 1, 0.98, 0},                          // palm
    {Habit::Needles, {0.03, 0.15, 0.4}, 120, 0.42, 38},                   // pine
    {Habit::Palmate, {0.44, 0.5, 1.0}, 5, 0.24, 52, 0.55, 54},            // plane
    {Habit::Twig, {0.88, 0.36, 0.95, 16, 0.05}, 8, 0.155, 58, 0.42, 48},  // poplar
    {Habit::Comb, {0.09, 0.2, 0.5}, 130, 0.1, 55},                        // spruce
    {Habit::Twig, {0.14, 0.6, 0.8}, 8, 0.24, 28, 0.3, 26},                // willow
}};

struct Dot {
  Vec3 color;
  bool covered = false;
};

/// One twig: x to the right and y up, from 0 to 1.
class Canvas {
 public:
  Canvas() : dots_(static_cast<size_t>(kCell) * kCell) {}

  /// A leaf from (x, y), `turn` degrees to the right of upright.
  void leaf(const Profile& o, double x, double y, double turn, double length, const Vec3& tone,
            double wider = 1) {
    paint(o, x + 0.008, y - 0.014, turn, length, nullptr, wider);
    paint(o, x, y, turn, length, &tone, wider);
  }

  /// A part of a leaf, or without a tone of its shadow.
  void lobe(const Profile& o, double x, double y, double turn, double length, const Vec3* tone) {
    const double off = tone ? 0 : 0.008;
    paint(o, x + off, y - 1.7 * off, turn, length, tone, 1);
  }

  void stalk(double x, double y, double turn, double length, double width, const Vec3& tone) {
    const double s = sinDeg(turn), c = cosDeg(turn);
    forBox(x, y, x + length * s, y + length * c, width, [&](double px, double py, Dot& d) {
      const double along = ((px - x) * s + (py - y) * c) / length;
      const double across = ((px - x) * c - (py - y) * s) / (width * 0.5 * (1.2 - 0.5 * along));
      if (along < 0 || along > 1 || std::fabs(across) > 1) return;
      d.color = tone * (0.8 + 0.2 * across);
      d.covered = true;
    });
  }

  const Dot& at(int x, int y) const {
    return dots_[static_cast<size_t>(y) * kCell + static_cast<size_t>(x)];
  }

 private:
  template <class Each>
  void forBox(double ax, double ay, double bx, double by, double reach, Each&& each) {
    const auto low = [&](double v) { return std::max(0, static_cast<int>(v * kCell)); };
    const auto high = [&](double v) {
      return std::min(kCell - 1, static_cast<int>(v * kCell) + 1);
    };
    for (int py = low(std::min(ay, by) - reach); py <= high(std::max(ay, by) + reach); ++py) {
      for (int px = low(std::min(ax, bx) - reach); px <= high(std::max(ax, bx) + reach); ++px) {
        each((px + 0.5) / kCell, (py + 0.5) / kCell,
             dots_[static_cast<size_t>(py) * kCell + static_cast<size_t>(px)]);
      }
    }
  }

  // Without a tone the leaf's shadow on what is there.
  void paint(const Profile& o, double x, double y, double turn, double length, const Vec3* tone,
             double wider) {
    const double s = sinDeg(turn), c = cosDeg(turn), width = o.width() * wider;
    const double reach = 0.6 * width * length + 2.0 / kCell;
    forBox(x, y, x + length * s, y + length * c, reach, [&](double px, double py, Dot& d) {
      const double t = ((px - x) * s + (py - y) * c) / length;
      const double across = ((px - x) * c - (py - y) * s) / length;
      if (t <= 0 || t >= 1) return;
      const double half = o.half(t, width);
      // A pixel wide at least.
      if (std::fabs(across) > std::max(half, 0.8 / (kCell * length))) return;
      if (!tone) {
        d.color = d.color * 0.72;
        return;
      }
      const double side = across > 0 ? 1.03 : 0.95;
      const double rib = std::fabs(across) < 0.012 * (1.3 - t) ? 1.1 : 1;
      const bool broad = o.width() > 0.1;
      const double veins = broad ? 1 + 0.05 * cosDeg(2880 * (t - 0.9 * std::fabs(across))) : 1;
      const double edge = half > 0 ? 1 - 0.1 * std::fabs(across) / half : 1;
      d.color = *tone * (side * rib * veins * edge * (0.84 + 0.16 * t));
      d.covered = true;
    });
  }

  std::vector<Dot> dots_;
};

constexpr Vec3 kTwig{0.52, 0.44, 0.36}, kStalk{0.72, 0.76, 0.6};

/// Draws one twig of a kind; chance by address.
class Twig {
 public:
  Twig(const LeafKind& kind, size_t number, uint64_t cell)
      : kind_(kind), outline_(kind.outline), seed_(1000 * number + cell) {}

  Canvas take() {
    switch (kind_.habit) {
      case Habit::Needles: needles(); break;
      case Habit::Comb: comb(); break;
      case Habit::Scales: scales(); break;
      case Habit::One: canvas_.leaf(outline_, 0.5, 0.005, 0, kind_.length, tone(1)); break;
      case Habit::Tuft: tuft(); break;
      case Habit::Candle: candle(); break;
      case Habit::Blossom: blossom(); break;
      default: twig(); break;
    }
    return std::move(canvas_);
  }

 private:
  double free(uint64_t what, int i) const { return chance(what, static_cast<uint64_t>(i), seed_); }
  double either(uint64_t what, int i) const { return 2 * free(what, i) - 1; }

  Vec3 tone(int i) const {
    const double light = 0.72 + 0.26 * free(90, i), warm = either(91, i);
    return Vec3{light * (1 + 0.05 * warm), light, light * (1 - 0.1 * warm)};
  }

  /// A point of the twig's middle line.
  Vec2 on(double t, double long_) const {
    const double bend = 0.16 * either(99, 0);
    return {0.5 + bend * t * t, long_ * t};
  }

  void branch(double long_, double width) {
    constexpr int kParts = 10;
    for (int i = 0; i < kParts; ++i) {
      const Vec2 a = on(i / 10.0, long_), b = on((i + 1) / 10.0, long_);
      canvas_.stalk(a.x, a.y, atan2Deg(b.x - a.x, b.y - a.y), 1.1 * length(b - a),
                    width * (1.1 - 0.06 * i), kTwig);
    }
  }

  void oneLeaf(double x, double y, double turn, double length, int i) {
    const Vec3 c = tone(i);
    if (kind_.habit == Habit::Palmate) {
      constexpr double kTurns[] = {100, -100, 52, -52, 0}, kLengths[] = {0.5, 0.5, 0.82, 0.82, 1};
      // One leaf: its lobes throw no shadow on each other.
      for (const bool shadow : {true, false}) {
        for (int k = 0; k < 5; ++k) {
          canvas_.lobe(outline_, x, y, turn + kTurns[k], length * kLengths[k],
                       shadow ? nullptr : &c);
        }
      }
    } else if (kind_.habit == Habit::Fingers) {
      constexpr double kTurns[] = {112, -112, 74, -74, 38, -38, 0};
      constexpr double kLengths[] = {0.5, 0.5, 0.74, 0.74, 0.93, 0.93, 1};
      for (int k = 0; k < 7; ++k) {
        canvas_.leaf(outline_, x, y, turn + kTurns[k], length * kLengths[k], tone(10 * i + k));
      }
    } else {
      canvas_.leaf(outline_, x, y, turn, length, c);
    }
  }

  // A spray: twigs on both sides of the middle one, whose leaves lie on top.
  void twig() {
    const double long_ = 0.97 - 0.9 * kind_.length;
    branch(long_ + 0.02, 0.016);
    const int sides = kind_.count;
    for (int k = 0; k < sides; ++k) {
      const double t = 0.1 + 0.7 * (k + 0.3 * free(11, k)) / sides;
      const double turn = (k % 2 == 0 ? 1 : -1) * (0.8 + 0.4 * free(12, k)) * kind_.spread;
      const Vec2 at = on(t, long_);
      // As far as the cell reaches.
      const double room = (0.47 - std::fabs(at.x - 0.5)) / std::max(0.2, sinDeg(std::fabs(turn)));
      leavesAlong(at, turn, std::min(room, 0.95 - at.y) - 0.8 * kind_.length, 50 * k);
    }
    const Vec2 at = on(0.5, long_), end = on(1, long_);
    leavesAlong(at, atan2Deg(end.x - at.x, end.y - at.y), length(end - at), 50 * sides);
  }

  void leavesAlong(const Vec2& from, double turn, double long_, int first) {
    long_ = std::max(long_, 0.05);
    const double s = sinDeg(turn), c = cosDeg(turn);
    canvas_.stalk(from.x, from.y, turn, long_, 0.009, kTwig);
    const int count = std::max(2, static_cast<int>(long_ / (kind_.gap * kind_.length)));
    for (int k = 0; k <= count; ++k) {
      const int i = first + k;
      const bool last = k == count;
      const double t = last ? 1 : (k + 0.3 * free(2, i)) / count;
      const double side = last ? 0.15 * either(3, i) : k % 2 == 0 ? 1 : -1;
      const double out = turn + side * kind_.angle * (0.7 + 0.6 * free(4, i));
      const double size = kind_.length * (0.75 + 0.3 * free(5, i));
      const double stalk = (kind_.outline.width > 0.3 ? 0.22 : 0.08) * size;
      const double x = from.x + t * long_ * s, y = from.y + t * long_ * c;
      canvas_.stalk(x, y, out, stalk, 0.006, kStalk);
      oneLeaf(x + stalk * sinDeg(out), y + stalk * cosDeg(out), out + 14 * either(6, i),
              size - 0.3 * stalk, i);
    }
  }

  void needles() {
    branch(0.62, 0.028);
    for (int i = 0; i < kind_.count; ++i) {
      const double t = (i + 0.5) / kind_.count;
      const Vec2 at = on(0.1 + 0.9 * t, 0.6);
      const double turn = kind_.angle * (1.15 - 0.5 * t) * 1.6 * either(2, i);
      canvas_.leaf(outline_, at.x, at.y, turn,
                   std::min(0.96 - at.y, kind_.length) * (0.7 + 0.3 * free(3, i)), tone(i));
    }
  }

  // A twig with twigs on both sides, all with short needles.
  void comb() {
    branch(0.9, 0.02);
    for (int side = 0; side < 8; ++side) {
      const double t = 0.12 + 0.09 * side, turn = (side % 2 == 0 ? 48 : -48) + 6 * either(8, side);
      combed(on(t, 0.9), turn, 0.46 * (1 - 0.75 * t), 46, 100 * side);
    }
    needlesAlong([&](double t) { return on(t, 0.9); }, atan2Deg(0.16 * either(99, 0), 0.9),
                 kind_.count, 5000);
  }
  void combed(const Vec2& from, double turn, double long_, int count, int first) {
    canvas_.stalk(from.x, from.y, turn, long_, 0.012, kTwig);
    const Vec2 way{long_ * sinDeg(turn), long_ * cosDeg(turn)};
    needlesAlong([&](double t) { return from + way * t; }, turn, count, first);
  }
  /// `at`: the line, by share of its length.
  template <class At>
  void needlesAlong(At&& at, double turn, int count, int first) {
    for (int i = 0; i < count; ++i) {
      const double t = (i + 0.5) / count;
      const Vec2 foot = at(t);
      const double out = kind_.angle * (1.2 - 0.7 * t) * (i % 2 == 0 ? 1 : -1);
      canvas_.leaf(outline_, foot.x, foot.y, turn + out * (0.6 + 0.6 * free(9, first + i)),
                   kind_.length * (0.8 + 0.3 * free(10, first + i)), tone(first + i));
    }
  }

  // Sprays that fork, all of them leaf.
  void scales() {
    for (int i = 0; i < kind_.count; ++i) {
      const double t = 0.6 * i / kind_.count;
      const double turn = (i % 2 == 0 ? 1 : -1) * kind_.angle * (1.1 - 0.9 * t / 0.6);
      spray(on(t, 1), turn + 8 * either(4, i), kind_.length * (1.1 - 0.5 * t), 2, 40 * i);
    }
  }
  void spray(const Vec2& from, double turn, double long_, int level, int first) {
    canvas_.leaf(outline_, from.x, from.y, turn, long_, tone(first),
                 0.024 / (long_ * kind_.outline.width));
    if (level == 0) return;
    for (int k = 0; k < 5; ++k) {
      const double t = 0.2 + 0.16 * k;
      spray({from.x + t * long_ * sinDeg(turn), from.y + t * long_ * cosDeg(turn)},
            turn + (k % 2 == 0 ? 34 : -34), long_ * 0.5 * (1.15 - 0.6 * t), level - 1,
            first + 6 * k + level);
    }
  }

  void tuft() {
    for (int i = 0; i < kind_.count; ++i) {
      canvas_.leaf(outline_, 0.5 + 0.3 * either(3, i), 0, kind_.angle * either(4, i),
                   kind_.length * (0.45 + 0.55 * free(5, i)), tone(i), 0.6 + 0.8 * free(2, i));
    }
  }

  // Upright, of small flowers, narrower above.
  void candle() {
    for (int i = 0; i < kind_.count; ++i) {
      const double t = 1.0 * i / kind_.count;
      flower({0.5 + 0.26 * (1 - 0.85 * t) * either(2, i), 0.06 + 0.86 * t},
             kind_.length * (1.1 - 0.4 * t), i);
    }
  }

  void blossom() {
    branch(0.9, 0.03);
    for (int i = 0; i < kind_.count; ++i) {
      const Vec2 at = on(0.12 + 0.86 * (i + free(2, i)) / kind_.count, 0.9);
      flower({std::clamp(at.x + 0.26 * either(3, i), 0.1, 0.9),
              std::min(0.9, at.y + 0.05 * either(4, i))},
             kind_.length * (0.8 + 0.3 * free(5, i)), i);
    }
  }
  void flower(const Vec2& at, double size, int i) {
    const Vec3 c = Vec3{0.98, 0.95, 0.96} * (0.88 + 0.12 * free(6, i));
    for (int k = 0; k < 5; ++k) {
      canvas_.leaf(outline_, at.x, at.y, 72 * k + 72 * free(7, i), size, c);
    }
    canvas_.leaf(outline_, at.x, at.y - 0.12 * size, 0, 0.28 * size, {0.85, 0.55, 0.5});
  }

  const LeafKind& kind_;
  Profile outline_;
  uint64_t seed_;
  Canvas canvas_;
};

uint8_t byteOf(double v) {
  return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
}

/// What is clear has the mean colour: pictures that are made smaller mix it in.
void put(const Canvas& from, int column, int row, Image& to) {
  Vec3 mean;
  double covered = 0;
  for (int y = 0; y < kCell; ++y) {
    work(kCell);
    for (int x = 0; x < kCell; ++x) {
      if (!from.at(x, y).covered) continue;
      mean += from.at(x, y).color;
      ++covered;
    }
  }
  mean = mean * (1 / std::max(1.0, covered));
  constexpr int kSize = kCell / kFine;
  for (int y = 0; y < kSize; ++y) {
    work(kCell);
    for (int x = 0; x < kSize; ++x) {
      Vec3 sum;
      double share = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const Dot& d = from.at(x * kFine + k % kFine, y * kFine + k / kFine);
        if (!d.covered) continue;
        sum += d.color;
        share += 1;
      }
      const Vec3 color = share > 0 ? sum * (1 / share) : mean;
      const size_t line = kLeafPictureSize - 1 - static_cast<size_t>(row * kSize + y);
      uint8_t* out =
          to.rgba.data() + (line * kLeafPictureSize + static_cast<size_t>(column * kSize + x)) * 4;
      for (size_t i = 0; i < 3; ++i) out[i] = byteOf(color[i]);
      out[3] = static_cast<uint8_t>(std::lround(share / (kFine * kFine) * 255));
    }
  }
}

}  // namespace

Image drawLeaves(size_t number) {
  GABLE_CHECK_LT(number, kKinds.size());
  Image image{kLeafPictureSize, kLeafPictureSize, {}};
  image.rgba.resize(size_t{kLeafPictureSize} * kLeafPictureSize * 4);
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    work(kWorkBetweenLooks);
    Twig twig(kKinds[number], number, static_cast<uint64_t>(cell));
    put(twig.take(), cell % kCells, cell / kCells, image);
  }
  reduceColors(image, kLeafColors);
  return image;
}

}  // namespace gable
