// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Blades, straws and leaves are drawn one by one into the field; the higher one covers.

#include "base/work.h"
#include "io/image/surface_noise.h"
#include "math/trig.h"

namespace gable::surface {

namespace {

struct Spread {
  double least, most;
};

// Of a rectangle that begins at 0, by how far its end and its half width lie in one direction.
Spread acrossRectangle(double end, double half) {
  const double beside = std::fabs(half);
  return {std::min(0.0, end) - beside, std::max(0.0, end) + beside};
}

// Where a line at dy meets the rectangle along (c, s).
Spread alongRow(double dy, double c, double s, double length, double half) {
  // A direction that is all but along the row, or across it, bounds nothing.
  constexpr double kFlat = 1e-6;
  Spread out = acrossRectangle(length * c, half * s);
  const auto bound = [&](double a, double b) {
    out = {std::max(out.least, std::min(a, b)), std::min(out.most, std::max(a, b))};
  };
  if (std::fabs(c) > kFlat) bound(-dy * s / c, (length - dy * s) / c);
  if (std::fabs(s) > kFlat) bound((dy * c - half) / s, (dy * c + half) / s);
  return out;
}

class Painter {
 public:
  explicit Painter(const LibraryMaterial& m) : m_(m), seed_(seedOf(m)) {
    field_.texels.resize(size_t{kSurfaceSize} * kSurfaceSize);
    const int n = static_cast<int>(kSurfaceSize);
    for (int y = 0; y < n; ++y) {
      work(kSurfaceSize);
      for (int x = 0; x < n; ++x) {
        const double u = (x + 0.5) / n, v = (y + 0.5) / n;
        SurfaceTexel& t = at(x, y);
        t.color = rgb(m.between) * (0.7 + 0.6 * clouds(u, v, 60, 60, 3, seed_));
        t.height = 0;
        t.roughness = 0.97;
      }
    }
  }

  double free(uint64_t what, uint64_t i) const { return chance(what, i, seed_ + 1); }

  /// An almond from (u, v) along `turn` degrees: `length` x `width` metres, its middle rib at
  /// `height`, which grows by `rise` to its end.
  void leaf(double u, double v, double turn, double length, double width, double height,
            double rise, const Vec3& color, double roughness) {
    const double c = cosDeg(turn), s = sinDeg(turn);
    const double px = kSurfaceSize / m_.width, py = kSurfaceSize / m_.height;
    // At least a pixel wide.
    const double half = std::max(width / 2, 0.6 / px);
    const Spread rows = acrossRectangle(length * s, half * c);
    const int low = floorOf(v * kSurfaceSize + rows.least * py) - 1;
    const int high = floorOf(v * kSurfaceSize + rows.most * py) + 1;
    for (int y = low; y <= high; ++y) {
      work();
      const double dy = (y + 0.5) / py - v * m_.height;
      const Spread row = alongRow(dy, c, s, length, half);
      const int left = floorOf(u * kSurfaceSize + row.least * px) - 1;
      const int right = floorOf(u * kSurfaceSize + row.most * px) + 1;
      for (int x = left; x <= right; ++x) {
        const double dx = (x + 0.5) / px - u * m_.width;
        const double along = (dx * c + dy * s) / length;
        if (along < 0 || along > 1) continue;
        const double across = (dy * c - dx * s) / half;
        const double wide =
            1 - (2 * along - 1) * (2 * along - 1) * (2 * along - 1) * (2 * along - 1);
        if (std::fabs(across) > wide) continue;
        const double h = height + rise * along - 0.25 * half * across * across;
        SurfaceTexel& t = at(x, y);
        if (h <= t.height) continue;
        t.height = h;
        t.color = color * (0.8 + 0.25 * along + (across > 0 ? 0.06 : -0.02));
        t.roughness = roughness;
      }
    }
  }

  void disc(double u, double v, double radius, double height, const Vec3& color) {
    for (int k = 0; k < 5; ++k) {
      leaf(u, v, 72 * k + 360 * u, radius, radius * 0.9, height, 0.001, color, 0.8);
    }
  }

  SurfaceField take() { return std::move(field_); }

 private:
  SurfaceTexel& at(int x, int y) {
    const int n = static_cast<int>(kSurfaceSize);
    return field_.texels[static_cast<size_t>(wrapped(y, n)) * kSurfaceSize +
                         static_cast<size_t>(wrapped(x, n))];
  }
  const LibraryMaterial& m_;
  uint64_t seed_;
  SurfaceField field_;
};

}  // namespace

SurfaceField drawPlants(const LibraryMaterial& m) {
  Painter p(m);
  const uint64_t seed = seedOf(m);
  const auto count = static_cast<uint64_t>(m.columns) * static_cast<uint64_t>(m.rows);
  const bool leaves = m.kind == SurfaceKind::Leaves;
  for (uint64_t i = 0; i < count; ++i) {
    const double u = p.free(1, i), v = p.free(2, i), id = p.free(3, i), second = p.free(4, i);
    // Patches of one tone, tufts of one height.
    const double patch = clouds(u, v, 5, 5, 3, seed + 9), tuft = noise(u, v, 14, 14, seed + 15);
    Vec3 c = mix(rgb(m.color), rgb(m.second), m.variety * (0.6 * id + 0.9 * (patch - 0.35)));
    const double depth = p.free(5, i);
    // What lies deep is dark.
    c = c * (0.55 + 0.5 * depth);
    const double height = m.relief * (0.25 + 0.5 * depth + 0.25 * tuft);
    if (leaves) {
      const double length = m.joint * (0.7 + 0.6 * second);
      // Ivy's leaves hang; a hedge's look all ways.
      const double turn = m.joint > 0.05 ? 230 + 80 * id : 360 * id;
      p.leaf(u, v, turn, length, length * 0.75, height, 0.008 * (second - 0.5), c, m.roughness);
      continue;
    }
    const bool laid = m.bond == Bond::Stack;
    const double turn = laid ? 270 + 40 * m.wander * (id - 0.5) * 2 : 360 * id;
    const double length = m.joint * (0.6 + 0.8 * second);
    const double width = laid ? 0.006 : 0.0045;
    p.leaf(u, v, turn, length, width, height, laid ? 0.004 : 0.3 * length * (depth - 0.4), c,
           m.roughness);
    // Flowers.
    if (m.joint > 0.1 && !laid && i % 97 == 0) {
      constexpr uint32_t kFlowers[] = {0xf2efe2, 0xe8c63a, 0xb45a8a, 0xf2efe2};
      p.disc(u, v, 0.016, m.relief * 1.15, rgb(kFlowers[i / 97 % 4]));
    }
  }
  return p.take();
}

}  // namespace gable::surface
