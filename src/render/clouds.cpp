// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Schneider 2015, The Real-Time Volumetric Cloudscapes of Horizon: Zero Dawn: a map says where
// clouds stand and how high, cellular noise gives them their lobes. Wrenninge, Kulla and Lundqvist
// 2013, Oz: The Great and Volumetric: what is scattered many times is light by weaker copies of the
// cloud. Lengths in kilometres.

#include "render/clouds.h"

#include <array>
#include <mutex>
#include <optional>
#include <vector>

#include "base/work.h"
#include "math/noise.h"
#include "math/trig.h"
#include "render/sampler.h"

namespace gable::rt {

namespace {

constexpr float kEarth = 6360;
/// Where clouds begin, and the height of the largest.
constexpr float kBase = 1.2f, kHigh = 0.75f;
/// By density 1, in 1 / km.
constexpr float kExtinction = 26;
/// Air takes this share of a cloud's contrast in so many kilometres.
constexpr float kFade = 17;

/// The dome of directions, by compass angle and elevation, and the side of its tiles.
constexpr int kColumns = 3072, kRows = 768, kTile = 32;
constexpr int kTilesAcross = kColumns / kTile, kTilesUp = kRows / kTile;
constexpr int kSunSteps = 6;
/// Kilometres of a step through the layer, and how many there are.
constexpr float kStep = 0.035f;
constexpr int kLeastSteps = 20, kMostSteps = 110;

/// The map of where clouds stand: kilometres of a side and of a large cloud, and cells.
constexpr float kMapSide = 26, kGroup = 2.1f;
constexpr int kMapCells = 1024;
constexpr int kGroupOctaves = 6;
/// From the edge of a cloud to its highest place, in the noise of the map.
constexpr float kSwing = 0.5f;
/// Above this height of the map clouds are seen; one of fewer cells, 25 metres wide each, is a
/// speck.
constexpr float kSeen = 0.1f;
constexpr size_t kLeastCloud = 600;
/// The share of a thin sky that nobody sees.
constexpr double kThin = 0.3;
/// The share of the height over which the foot of a cloud becomes dense, and the height at which
/// one ends that stands at 1.
constexpr float kFoot = 0.07f, kTop = 1.25f;
/// How fast clouds become dense behind their edge, and how much of that lobes take.
constexpr float kSteep = 5, kLobed = 1.5f, kSoft = 0.25f;

/// The block of cellular noise that is laid side by side.
constexpr int kBlockCells = 64;
constexpr float kBlockSide = 1.5f;

int wrapped(int i, int n) {
  const int m = i % n;
  return m < 0 ? m + n : m;
}

/// Cellular noise (Worley 1996) that goes on over the sides of a unit cube of `cells` a side: 1 at
/// the middles of lobes, down to 0 between them.
float lobes(const Vec3f& p, int cells, uint32_t seed) {
  const float scale = static_cast<float>(cells);
  const Vec3f q = p * scale;
  const std::array<int, 3> at{static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z)};
  float nearest = 4;
  for (int k = 0; k < 27; ++k) {
    const std::array<int, 3> c{at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1};
    uint32_t h = seed;
    for (const int i : c) h = mix32(h + static_cast<uint32_t>(wrapped(i, cells)));
    const Vec3f corner{static_cast<float>(c[0]), static_cast<float>(c[1]),
                       static_cast<float>(c[2])};
    const Vec3f d = corner + Vec3f{drawnBy(h, 1), drawnBy(h, 2), drawnBy(h, 3)} - q;
    nearest = std::min(nearest, dot(d, d));
  }
  return std::max(0.0f, 1 - std::sqrt(nearest));
}

/// The layer of clouds.
class Layer {
 public:
  explicit Layer(double cover) : map_(kMapCells * kMapCells), block_(kBlock) {
    makeMap(cover);
    makeBlock();
  }

  /// At a place in the plan and a height above the base, 0 to 1.
  float density(float x, float z, float height, bool fine) const {
    const float share = height / kHigh;
    if (share < 0 || share > 1) return 0;
    // Flat below, domed above: a taller cloud is a wider one.
    const float stands = standing(x, z);
    if (stands <= 0) return 0;
    const float left = stands * std::min(1.0f, share / kFoot) - share / kTop;
    if (left <= 0) return 0;
    const float lobed = fine ? lobesAt(x, height, z) : 0.5f;
    return std::clamp(left * kSteep - (1 - lobed) * kLobed + kSoft, 0.0f, 1.0f);
  }

 private:
  static constexpr size_t kBlock =
      static_cast<size_t>(kBlockCells) * static_cast<size_t>(kBlockCells) * kBlockCells;

  void makeMap(double cover) {
    for (int j = 0; j < kMapCells; ++j) {
      work(kMapCells * kGroupOctaves);
      for (int i = 0; i < kMapCells; ++i) {
        const double km = static_cast<double>(kMapSide) / kMapCells / static_cast<double>(kGroup);
        map_[index(i, j)] =
            static_cast<float>(fractalNoise(Vec2{i * km, j * km}, kGroupOctaves, 0x636c6f7564));
      }
    }
    // From the level that so much lies above, and a little more: what is just above it is too thin
    // to be seen.
    std::vector<float> sorted = map_;
    const double below = std::clamp((1 - cover) * (1 - kThin * std::sqrt(cover)), 0.0, 1.0);
    const auto nth =
        sorted.begin() + static_cast<ptrdiff_t>(below * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), nth, sorted.end());
    const float level = *nth;
    for (float& v : map_) v = std::clamp((v - level) / kSwing, 0.0f, 1.0f);
    leaveOutSpecks();
  }

  /// Lowers what is seen of few cells alone: in a picture it is a white dot.
  void leaveOutSpecks() {
    std::vector<bool> known(map_.size(), false);
    std::vector<size_t> cloud;
    for (size_t first = 0; first < map_.size(); ++first) {
      if (known[first] || map_[first] <= kSeen) continue;
      cloud.assign(1, first);
      known[first] = true;
      for (size_t k = 0; k < cloud.size(); ++k) {
        const size_t at = cloud[k], i = at % kMapCells, j = at / kMapCells;
        const auto visit = [&](bool isInside, size_t next) {
          if (!isInside || known[next] || map_[next] <= kSeen) return;
          known[next] = true;
          cloud.push_back(next);
        };
        visit(i > 0, at - 1);
        visit(i + 1 < kMapCells, at + 1);
        visit(j > 0, at - kMapCells);
        visit(j + 1 < kMapCells, at + kMapCells);
      }
      work(cloud.size());
      if (cloud.size() >= kLeastCloud) continue;
      for (const size_t at : cloud) map_[at] = kSeen / 2;
    }
  }

  void makeBlock() {
    constexpr int n = kBlockCells;
    for (int k = 0; k < n; ++k) {
      work(n * n);
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const Vec3f p = toVec3f(Vec3{i + 0.5, j + 0.5, k + 0.5} * (1.0 / n));
          block_[static_cast<size_t>((k * n + j) * n + i)] =
              lobes(p, 5, 11) * 0.55f + lobes(p, 11, 23) * 0.29f + lobes(p, 23, 37) * 0.16f;
        }
      }
    }
  }

  static size_t index(int i, int j) {
    return static_cast<size_t>(j) * kMapCells + static_cast<size_t>(i);
  }
  /// The map goes on mirrored.
  static float mirrored(float km) {
    const float turn = std::abs(km) / kMapSide, rest = turn - 2 * std::floor(turn / 2);
    return (rest > 1 ? 2 - rest : rest) * (kMapCells - 1);
  }

  float standing(float x, float z) const {
    const float u = mirrored(x), v = mirrored(z);
    const int i = std::min(kMapCells - 2, static_cast<int>(u));
    const int j = std::min(kMapCells - 2, static_cast<int>(v));
    const float fu = u - static_cast<float>(i), fv = v - static_cast<float>(j);
    const float* const row = &map_[index(i, j)];
    const float* const next = row + kMapCells;
    return (row[0] * (1 - fu) + row[1] * fu) * (1 - fv) + (next[0] * (1 - fu) + next[1] * fu) * fv;
  }

  float lobesAt(float x, float y, float z) const {
    constexpr int n = kBlockCells;
    const float s = n / kBlockSide;
    const float px = x * s, py = y * s, pz = z * s;
    const float bx = std::floor(px), by = std::floor(py), bz = std::floor(pz);
    const float fx = px - bx, fy = py - by, fz = pz - bz;
    const auto at = [&](int i, int j, int k) {
      const int a = (static_cast<int>(bx) + i) & (n - 1), b = (static_cast<int>(by) + j) & (n - 1);
      const int c = (static_cast<int>(bz) + k) & (n - 1);
      return block_[static_cast<size_t>((c * n + b) * n + a)];
    };
    const auto line = [&](int j, int k) { return at(0, j, k) * (1 - fx) + at(1, j, k) * fx; };
    const auto face = [&](int k) { return line(0, k) * (1 - fy) + line(1, k) * fy; };
    return face(0) * (1 - fz) + face(1) * fz;
  }

  std::vector<float> map_, block_;
};

/// The way along a ray that rises with that sine to a height above the round Earth.
float wayTo(float height, float up) {
  const float r = kEarth * up;
  return std::sqrt(r * r + 2 * kEarth * height + height * height) - r;
}

/// Light from the sun that reaches a point: what is scattered again and again goes on as if the
/// cloud were thinner.
float sunThrough(float depth) {
  float share = 0, weight = 0.62f, thin = 1;
  for (int order = 0; order < 3; ++order) {
    share += weight * std::exp(-depth * thin);
    weight *= 0.42f;
    thin *= 0.22f;
  }
  return share;
}

Clouds::Seen marched(const Layer& layer, const Vec3f& d, const Vec3f& toSun) {
  Clouds::Seen seen;
  const float near = wayTo(kBase, d.y), far = wayTo(kBase + kHigh, d.y);
  const int steps = std::clamp(static_cast<int>((far - near) / kStep), kLeastSteps, kMostSteps);
  const float step = (far - near) / static_cast<float>(steps);
  // What lies far off is hazy, and under a pixel.
  const float fade = std::exp(-near / kFade);
  const float sunStep = 0.5f * kHigh / kSunSteps;
  for (int i = 0; i < steps && seen.clear > 0.01f; ++i) {
    const float t = near + step * (static_cast<float>(i) + 0.5f);
    const float x = d.x * t, z = d.z * t, flat = x * x + z * z;
    const float height = d.y * t + flat / (2 * kEarth) - kBase;
    const float density = layer.density(x, z, height, true);
    if (density <= 0) continue;
    float depth = 0;
    for (int k = 0; k < kSunSteps; ++k) {
      // Finer near the point.
      const float s =
          sunStep * (static_cast<float>(k) + 0.5f) * (0.4f + 0.3f * static_cast<float>(k));
      const float wide = sunStep * (0.4f + 0.6f * static_cast<float>(k));
      depth += layer.density(x + toSun.x * s, z + toSun.z * s, height + toSun.y * s, k < 3) * wide;
    }
    const float kept = std::exp(-density * kExtinction * step);
    const float part = seen.clear * (1 - kept);
    seen.sun += part * sunThrough(depth * kExtinction) / kPif;
    // From above more than from below.
    seen.sky += part * (0.45f + 0.55f * std::min(1.0f, height / kHigh * 1.6f)) / kPif;
    seen.clear *= kept;
  }
  seen.sun *= fade;
  seen.sky *= fade;
  seen.clear = 1 - (1 - seen.clear) * fade;
  return seen;
}

/// A part between two, by the share of the second.
Clouds::Seen between(const Clouds::Seen& a, const Clouds::Seen& b, float t) {
  return {a.clear + (b.clear - a.clear) * t, a.sun + (b.sun - a.sun) * t,
          a.sky + (b.sky - a.sky) * t};
}

}  // namespace

/// Directions that have been looked at, in tiles. A tile holds the first column and row of its
/// neighbours, too.
class Clouds::Dome {
 public:
  Dome(double cover, double sunElevation)
      : cover_(cover), sunElevation_(sunElevation), tiles_(new Tile[kTilesAcross * kTilesUp]) {
    // Where the sun is low, its light still comes from a little above: it goes through less cloud
    // than a level ray would.
    const double high = std::max(4.0, sunElevation);
    toSun_ = toVec3f({cosDeg(high), sinDeg(high), 0});
  }

  bool isFor(double cover, double sunElevation) const {
    return cover_ == cover && sunElevation_ == sunElevation;
  }

  Seen seen(const Vec3f& d) const {
    const float up = std::asin(std::min(1.0f, d.y)) * (2 / kPif);
    const float row = std::clamp(up * kRows - 0.5f, 0.0f, kRows - 1.001f);
    const float turn = std::atan2(d.z, d.x) / (2 * kPif);
    const float column = turn * kColumns - 0.5f, left = std::floor(column);
    const int i = wrapped(static_cast<int>(left), kColumns), j = static_cast<int>(row);
    const Seen* const low =
        &tile(i / kTile, j / kTile)[static_cast<size_t>((j % kTile) * kStride + i % kTile)];
    const Seen* const high = low + kStride;
    const float across = column - left;
    return between(between(low[0], low[1], across), between(high[0], high[1], across),
                   row - static_cast<float>(j));
  }

 private:
  static constexpr int kStride = kTile + 1;
  struct Tile {
    std::once_flag made;
    std::vector<Seen> seen;
  };

  const Seen* tile(int across, int up) const {
    Tile& t = tiles_[static_cast<size_t>(up * kTilesAcross + across)];
    std::call_once(t.made, [&] { t.seen = made(across * kTile, up * kTile); });
    return t.seen.data();
  }

  std::vector<Seen> made(int firstColumn, int firstRow) const {
    std::call_once(layerMade_, [&] { layer_.emplace(cover_); });
    std::vector<Seen> seen;
    seen.reserve(kStride * kStride);
    for (int j = 0; j <= kTile; ++j) {
      work(kWorkBetweenLooks);
      const double elevation = 90 * (firstRow + j + 0.5) / kRows;
      for (int i = 0; i <= kTile; ++i) {
        const double turn = 360 * (firstColumn + i + 0.5) / kColumns;
        const Vec3 d{cosDeg(elevation) * cosDeg(turn), sinDeg(elevation),
                     cosDeg(elevation) * sinDeg(turn)};
        seen.push_back(marched(*layer_, toVec3f(d), toSun_));
      }
    }
    return seen;
  }

  double cover_, sunElevation_;
  Vec3f toSun_;
  mutable std::once_flag layerMade_;
  mutable std::optional<Layer> layer_;
  std::unique_ptr<Tile[]> tiles_;
};

Clouds::Clouds(double cover, double sunElevation)
    : dome_(std::make_unique<Dome>(cover, sunElevation)) {}
Clouds::~Clouds() = default;

bool Clouds::isFor(double cover, double sunElevation) const {
  return dome_->isFor(cover, sunElevation);
}

Clouds::Seen Clouds::seen(const Vec3f& direction) const {
  return direction.y > 0 ? dome_->seen(direction) : Seen{};
}

float Clouds::forward(float cosine) {
  // Henyey and Greenstein 1941: a narrow lobe ahead and a wide one.
  const auto lobe = [](float g, float c) {
    const float v = 1 + g * g - 2 * g * c;
    return (1 - g * g) / (v * std::sqrt(v));
  };
  const auto both = [&](float c) { return 0.25f * lobe(0.72f, c) + 0.75f * lobe(0.12f, c); };
  return both(cosine) / both(0);
}

}  // namespace gable::rt
