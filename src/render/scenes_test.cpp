// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/random.h"
#include "render/test_scenes.h"

namespace gable {

Mesh ballMesh(int rings) {
  MeshBuilder b;
  const int around = 2 * rings;
  for (int j = 0; j <= rings; ++j) {
    const double a = 180.0 * j / rings;
    for (int i = 0; i < around; ++i) {
      const double p = 360.0 * i / around;
      b.addPosition({sinDeg(a) * sinDeg(p), cosDeg(a), sinDeg(a) * cosDeg(p)});
    }
  }
  const auto at = [&](int j, int i) { return static_cast<uint32_t>(j * around + i % around); };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < around; ++i) {
      b.beginFace(0, 0, true);
      b.beginLoop();
      for (const uint32_t p : {at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i + 1)}) {
        const uint32_t c = b.addCorner(p);
        b.setNormal(c, b.mesh().positions[p]);
      }
    }
  }
  return b.take();
}

namespace {

/// A prism over the rectangle w x d with a gable of the given height.
Mesh gableMesh(double w, double d, double h) {
  MeshBuilder b;
  const uint32_t p0 = b.addPosition({0, 0, 0}), p1 = b.addPosition({w, 0, 0});
  const uint32_t p2 = b.addPosition({w, 0, d}), p3 = b.addPosition({0, 0, d});
  const uint32_t r0 = b.addPosition({0, h, d / 2}), r1 = b.addPosition({w, h, d / 2});
  const std::vector<std::vector<uint32_t>> faces = {
      {p3, p2, r1, r0}, {p1, p0, r0, r1}, {p0, p3, r0}, {p2, p1, r1}, {p0, p1, p2, p3}};
  for (const auto& f : faces) b.addPolygon(f);
  return b.take();
}

/// The wall of a bay, w x h, with a hole for the window.
Mesh bayMesh(double w, double h, double x, double y, double ww, double wh) {
  MeshBuilder b;
  std::vector<uint32_t> p;
  for (const Vec3& v : {Vec3{0, 0, 0}, Vec3{w, 0, 0}, Vec3{w, h, 0}, Vec3{0, h, 0}}) {
    p.push_back(b.addPosition(v));
  }
  for (const Vec3& v :
       {Vec3{x, y, 0}, Vec3{x, y + wh, 0}, Vec3{x + ww, y + wh, 0}, Vec3{x + ww, y, 0}}) {
    p.push_back(b.addPosition(v));
  }
  b.beginFace();
  b.beginLoop();
  for (size_t k = 0; k < 4; ++k) b.addCorner(p[k]);
  b.beginLoop();
  for (size_t k = 4; k < 8; ++k) b.addCorner(p[k]);
  const std::vector<Vec3> back = {
      {x, y, -0.2}, {x, y + wh, -0.2}, {x + ww, y + wh, -0.2}, {x + ww, y, -0.2}};
  std::vector<uint32_t> q;
  for (const Vec3& v : back) q.push_back(b.addPosition(v));
  for (size_t k = 0; k < 4; ++k) {
    const size_t n = (k + 1) % 4;
    b.addPolygon(std::vector<uint32_t>{p[4 + k], q[k], q[n], p[4 + n]});
  }
  return b.take();
}

struct StreetMaker {
  SceneMaker m;
  uint32_t white = m.material("#EFEDE4", 0.4), glass = m.material("#2B3338", 0.06);
  uint32_t door = m.material("#2E4A3E", 0.35), iron = m.material("#25282B", 0.45);
  uint32_t tile = m.material("#A0583B", 0.8), slate = m.material("#50565E", 0.55);
  uint32_t asphalt = m.material("#696765", 0.92), paving = m.material("#A6A199", 0.88);
  uint32_t leaf = m.material("#5F7B3C", 0.9), bark = m.material("#7F7B66", 0.9);
  uint32_t grass = m.material("#6B8743", 0.95), brick = m.material("#8A503D", 0.9);
  std::vector<uint32_t> windows, trees;

  static double draw(uint64_t a, uint64_t b, double lo, double hi) {
    return randomIn(hashCombine(a, b), lo, hi);
  }

  /// A window of 1.1 x 1.7 with its lower left corner at the origin, in the wall's plane.
  void makeWindows() {
    const uint32_t curtain = m.material("#E9E3D5", 0.95);
    for (int kind = 0; kind < 3; ++kind) {
      const double w = 1.1, h = 1.7;
      m.box({0, 0, -0.20}, {w, h, 0.01}, glass);
      m.box({0, 0, -0.19}, {0.06, h, 0.05}, white);
      m.box({w - 0.06, 0, -0.19}, {0.06, h, 0.05}, white);
      m.box({0, 0, -0.19}, {w, 0.06, 0.05}, white);
      m.box({0, h - 0.06, -0.19}, {w, 0.06, 0.05}, white);
      m.box({w / 2 - 0.03, 0, -0.19}, {0.06, h, 0.04}, white);
      m.box({0, h * 0.68, -0.19}, {w, 0.04, 0.04}, white);
      m.box({-0.08, -0.1, -0.1}, {w + 0.16, 0.1, 0.18}, paving);
      if (kind > 0) {
        m.box({0.06, 0.06, -0.195}, {0.2, h - 0.1, 0.01}, curtain);
        if (kind > 1) m.box({w - 0.26, 0.06, -0.195}, {0.2, h - 0.1, 0.01}, curtain);
      }
      windows.push_back(m.prototype());
    }
  }

  void makeTrees() {
    for (uint64_t kind = 0; kind < 3; ++kind) {
      const double crown = draw(kind, 1, 2.1, 2.7), base = draw(kind, 2, 2.6, 3.0);
      m.mesh(ballMesh(5), bark, Frame::moved({0, base * 0.5, 0}), {0.16, base * 0.9, 0.16});
      for (uint64_t i = 0; i < 13; ++i) {
        const double a = 137.5 * static_cast<double>(i);
        const double up = draw(kind + 9, i, -0.55, 0.8);
        const double r = crown * 0.68 * std::sqrt(1 - up * up * 0.8);
        const double size = crown * draw(kind + 31, i, 0.38, 0.5);
        Mesh blob = ballMesh(7);
        for (size_t v = 0; v < blob.positions.size(); ++v) {
          const Vec3 p = blob.positions[v];
          const double n = sinDeg(p.x * 210 + 40 * a) * sinDeg(p.y * 260 + a) * sinDeg(p.z * 230);
          blob.positions[v] = p * (1 + 0.14 * n);
        }
        m.mesh(std::move(blob), leaf,
               Frame::moved({r * sinDeg(a), base + crown * (0.8 + up), r * cosDeg(a)}),
               {size, size * 0.9, size});
      }
      trees.push_back(m.prototype());
    }
  }

  /// A house of `bays` x `floors` with its front in the plane z = 0, towards +z.
  double house(uint64_t id, double left, const Frame& at) {
    static const char* const kWalls[] = {"#E6D9BE", "#D8CAAD", "#C9B08A", "#D8B8A0",
                                         "#EFEBE0", "#BCC4B4", "#8A503D"};
    const uint32_t wall = m.material(kWalls[id * 5 % 7], 0.9);
    const int bays = 3 + static_cast<int>(draw(id, 1, 0, 2.99));
    const int floors = 3 + static_cast<int>(draw(id, 2, 0, 1.99));
    const double bay = draw(id, 3, 2.4, 2.8), storey = draw(id, 4, 3.0, 3.3), ground = 3.8;
    const double width = bay * bays, depth = 11;
    const auto put = [&](double x, double y, double z) {
      return at * Frame::moved({left + x, y, z});
    };
    const auto bar = [&](const Vec3& p, const Vec3& size, uint32_t material) {
      m.box(p, size, material);
      m.leaves.back().frame = put(p.x, p.y, p.z);
    };
    const double top = ground + storey * floors;
    const Frame back = at * Frame::moved({left + width, 0, -depth}) * rotationXyz(0, 180, 0);
    for (int b = 0; b < bays; ++b) {
      for (int f = 0; f <= floors; ++f) {
        const Frame place = back * Frame::moved({bay * b, f ? ground + storey * (f - 1) : 0.4, 0});
        m.mesh(bayMesh(bay, f ? storey : ground - 0.4, (bay - 1.1) / 2, 0.8, 1.1, 1.7), wall,
               place);
        m.place(windows[(id + static_cast<uint64_t>(f * b)) % 3],
                place * Frame::moved({(bay - 1.1) / 2, 0.8, 0}));
      }
      for (int f = 0; f < floors; ++f) {
        const double x = bay * b, y = ground + storey * f;
        m.mesh(bayMesh(bay, storey, (bay - 1.1) / 2, 0.8, 1.1, 1.7), wall, put(x, y, 0));
        m.place(windows[static_cast<size_t>(
                    draw(id * 97 + 1, static_cast<uint64_t>(b * 31 + f), 0, 2.99))],
                put(x + (bay - 1.1) / 2, y + 0.8, 0));
      }
      const bool isDoor = b == static_cast<int>(id % 3);
      m.mesh(bayMesh(bay, ground, 0.45, isDoor ? 0.15 : 0.7, bay - 0.9, isDoor ? 2.8 : 2.3), wall,
             put(bay * b, 0, 0));
      bar({bay * b + 0.45, isDoor ? 0.15 : 0.7, -0.2}, {bay - 0.9, isDoor ? 2.8 : 2.3, 0.02},
          isDoor ? door : glass);
      if (isDoor) bar({bay * b + 0.35, 0, 0}, {bay - 0.7, 0.15, 0.5}, paving);
    }
    bar({0, 0, 0}, {width, 0.5, 0.04}, paving);
    bar({0, ground - 0.3, 0}, {width, 0.22, 0.08}, white);
    bar({0, top - 0.15, 0}, {width, 0.15, 0.25}, white);
    bar({0, top, 0}, {width, 0.18, 0.4}, white);
    bar({0, 0, -depth + 0.3}, {width, top, depth - 0.6}, wall);
    bar({0, 0, -0.3}, {0.05, top, 0.3}, wall);
    bar({width - 0.05, 0, -0.3}, {0.05, top, 0.3}, wall);
    m.mesh(gableMesh(width, depth + 0.6, 4.2), id % 2 ? tile : slate,
           put(0, top + 0.18, -depth - 0.3));
    bar({0, 0, -depth - 0.02}, {width, 0.4, 0.32}, paving);
    bar({0, top, -depth - 0.3}, {width, 0.18, 0.4}, white);
    bar({0.3, top + 1.5, -depth * 0.45}, {0.7, 4.0, 1.2}, brick);
    return width;
  }

  void lamp(const Frame& at) {
    for (const auto& [p, size] : {std::pair{Vec3{-0.05, 0, -0.05}, Vec3{0.1, 4.2, 0.1}},
                                  std::pair{Vec3{-0.2, 4.2, -0.2}, Vec3{0.4, 0.5, 0.4}},
                                  std::pair{Vec3{-0.12, 0, -0.12}, Vec3{0.24, 0.7, 0.24}}}) {
      m.box(p, size, iron);
      m.leaves.back().frame = at * Frame::moved(p);
    }
  }

  Scene make() {
    makeWindows();
    makeTrees();
    const double streetWidth = 15, length = 58;
    m.box({-6, -0.3, -4}, {length + 12, 0.3, 23}, asphalt);
    m.box({-4, 0, -3}, {length + 8, 0.14, 6}, paving);
    m.box({-4, 0, streetWidth - 3}, {length + 8, 0.14, 6}, paving);
    const Frame north = Frame::moved({0, 0.14, 0});
    const Frame south = rotationXyz(0, 180, 0);
    double x = 0;
    uint64_t id = 0;
    while (x < length - 8) x += house(id++, x, north);
    double s = 0;
    while (s < length - 8) {
      s += house(id++, s, Frame::moved({length, 0.14, streetWidth}) * south);
    }
    m.box({-6, -0.3, -24}, {length + 12, 0.35, 20}, grass);
    m.box({-6, -0.3, streetWidth + 4}, {length + 12, 0.35, 20}, grass);
    for (uint64_t i = 0; i < 7; ++i) {
      const double at = 4 + 8 * static_cast<double>(i);
      const Frame turn = rotationXyz(0, draw(i, 77, 0, 360), 0);
      if (i != 3) m.place(trees[i % 3], Frame::moved({at, 0.14, 2.2}) * turn);
      if (i != 5) m.place(trees[(i + 1) % 3], Frame::moved({at, 0.14, streetWidth - 2.2}) * turn);
      m.place(trees[(i + 2) % 3], Frame::moved({at + 3, 0, -18}) * turn);
      if (i % 2) m.place(trees[i % 3], Frame::moved({at, 0, streetWidth + 17 + i % 3}) * turn);
      lamp(Frame::moved({at + 4, 0.14, 2.4}));
    }
    return std::move(m.finish());
  }
};

}  // namespace

Scene streetScene() { return StreetMaker().make(); }

}  // namespace gable
