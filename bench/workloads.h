// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The workloads of the benchmarks: the lots that the rules of bench/boxes begin with, and
// hard-coded loops that make the same boxes. Metres; y is up.
//
//   W1      a building of 20 x 10 bays on four sides, 5 boxes a bay: 4000 boxes
//   W1x25   the same 25 times over
//   W2      1000 buildings of 100 boxes with sizes of their own
//   W3a     a Menger sponge of depth 4: 160 000 boxes
//   W3b     a binary tree of 20 levels with rotations: 1 048 575 boxes
//
// Loops hand each box to `box(axes, origin, size)`: the axes of the box, its corner nearest to
// where they begin, and its lengths along them.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "math/frame.h"
#include "math/trig.h"

namespace gable::bench {

/// A rectangle with its first corner at (x, 0, z), `w` along x and `d` along -z. A height of 0 is
/// not an attribute of the lot.
struct Lot {
  double x = 0, z = 0, w = 0, d = 0, height = 0;
};

struct Workload {
  const char* name;
  /// In bench/boxes.
  const char* rules;
  std::vector<Lot> lots;
  size_t boxes;
};

inline std::vector<Lot> rowOfFacades(int count) {
  std::vector<Lot> out;
  for (int i = 0; i < count; ++i) out.push_back({i * 50.0, 0, 30, 20, 0});
  return out;
}

/// Buildings of W2; more of them stand further down the rows.
inline std::vector<Lot> houses(int count = 1000) {
  std::vector<Lot> out;
  for (int i = 0; i < count; ++i) {
    const double j = std::fmod(i * 0.618033988749895, 1.0);
    const double k = std::fmod(i * 0.754877666246693, 1.0);
    out.push_back({(i % 40) * 30.0, -(i / 40) * 30.0, 8 + 6 * j, 8 + 6 * k, 13.6 + 2.6 * j});
  }
  return out;
}

inline std::vector<Workload> workloads() {
  return {{"W1", "facade.cga", rowOfFacades(1), 4000},
          {"W1x25", "facade.cga", rowOfFacades(25), 100000},
          {"W2", "slabs.cga", houses(), 100000},
          {"W3a", "menger.cga", {{0, 0, 27, 27, 0}}, 160000},
          {"W3b", "tree.cga", {{0, 0, 1, 1, 0}}, 1048575}};
}

// One facade by loops: the frame has x along it, y up and z outwards.
template <class Box>
void facadeByLoops(const Frame& facade, double width, const Box& box) {
  const double bay = width / 10;
  for (int floor = 0; floor < 20; ++floor) {
    for (int i = 0; i < 10; ++i) {
      const auto put = [&](double x, double y, double w, double h, double d) {
        box(facade, facade.point({i * bay + x, floor * 3.0 + y, 0}), Vec3{w, h, d});
      };
      put(0, 0, 0.15, 3, 0.2);
      put(0.15, 0, bay - 0.3, 0.15, 0.2);
      put(0.15, 0.15, bay - 0.3, 2.7, 0.05);
      put(0.15, 2.85, bay - 0.3, 0.15, 0.2);
      put(bay - 0.15, 0, 0.15, 3, 0.2);
    }
  }
}

template <class Box>
void buildingByLoops(const Lot& lot, const Box& box) {
  const Vec3 up{0, 1, 0};
  const double x = lot.x, z = lot.z, w = lot.w, d = lot.d;
  facadeByLoops(Frame::of({x, 0, z}, {1, 0, 0}, up, {0, 0, 1}), w, box);
  facadeByLoops(Frame::of({x + w, 0, z}, {0, 0, -1}, up, {1, 0, 0}), d, box);
  facadeByLoops(Frame::of({x + w, 0, z - d}, {-1, 0, 0}, up, {0, 0, -1}), w, box);
  facadeByLoops(Frame::of({x, 0, z - d}, {0, 0, 1}, up, {-1, 0, 0}), d, box);
}

template <class Box>
void houseByLoops(const Lot& house, const Box& box) {
  const Frame upright;
  const double floor = house.height / 5, bay = house.w / 4, part = house.d / 5;
  for (int f = 0; f < 5; ++f) {
    for (int b = 0; b < 4; ++b) {
      for (int p = 0; p < 5; ++p) {
        box(upright, Vec3{house.x + b * bay, f * floor, house.z - house.d + p * part},
            Vec3{bay, floor, part});
      }
    }
  }
}

template <class Box>
void spongeByLoops(const Vec3& origin, double side, int depth, const Box& box) {
  if (depth == 0) return box(Frame{}, origin, Vec3{side, side, side});
  const double third = side / 3;
  for (int y = 0; y < 3; ++y) {
    for (int z = 0; z < 3; ++z) {
      for (int x = 0; x < 3; ++x) {
        if ((x == 1) + (y == 1) + (z == 1) > 1) continue;
        spongeByLoops(origin + Vec3{x * third, y * third, z * third}, third, depth - 1, box);
      }
    }
  }
}

template <class Box>
void treeByLoops(const Frame& at, const Vec3& size, int levels, const Box& box) {
  box(at, at.origin, size);
  if (levels == 1) return;
  for (const double turn : {25.0, -25.0}) {
    const double c = cosDeg(turn), s = sinDeg(turn);
    const Frame inner =
        Frame::of(at.point({0, size.y, 0}), at.x * c + at.y * s, at.y * c - at.x * s, at.z);
    treeByLoops(inner, size * 0.8, levels - 1, box);
  }
}

/// All boxes of the workload of that name.
template <class Box>
void boxesByLoops(const Workload& workload, const Box& box) {
  const std::string_view rules = workload.rules;
  if (rules == "menger.cga") return spongeByLoops({0, 0, -27}, 27, 4, box);
  if (rules == "tree.cga") {
    return treeByLoops(Frame::moved({0, 0, -1}), {1, 4, 1}, 20, box);
  }
  for (const Lot& lot : workload.lots) {
    if (rules == "slabs.cga")
      houseByLoops(lot, box);
    else
      buildingByLoops(lot, box);
  }
}

}  // namespace gable::bench
