// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "gbbg_world.h"

#include <algorithm>
#include <cmath>

namespace gbbg_world {

Rotation Rotation::inverse() const {
  Rotation r;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) r.axes[i][j] = axes[j][i];
  }
  return r;
}

Rotation turned(int axis, double degrees) {
  const double a = degrees * std::acos(-1.0) / 180, c = std::cos(a), s = std::sin(a);
  if (axis == 0) return {{{{1, 0, 0}, {0, c, s}, {0, -s, c}}}};
  if (axis == 1) return {{{{c, 0, -s}, {0, 1, 0}, {s, 0, c}}}};
  return {{{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}}};
}

Rotation euler(const Vec& d) { return turned(1, d[1]) * turned(0, d[0]) * turned(2, d[2]); }

Box part(const Box& b, const Vec& from, const Vec& size, const std::string& symbol) {
  return {symbol, b.root + b.rotation(from), b.rotation, size};
}

Box rerooted(const Box& b, int axis, int quarters) {
  const Rotation turn = turned(axis, 90.0 * quarters);
  Box out = b;
  out.rotation = b.rotation * turn;
  Vec corner{};
  for (size_t i = 0; i < 3; ++i) {
    // The new axis i runs along one of the old ones, perhaps against it.
    for (size_t j = 0; j < 3; ++j) {
      const double along = turn.axes[i][j];
      if (std::fabs(along) < 0.5) continue;
      out.size[i] = b.size[j];
      if (along < 0) corner[j] = b.size[j];
    }
  }
  out.root = b.root + b.rotation(corner);
  return out;
}

Box scopeRule(Box b, const ScopeChange& t, const ScopeChange& r, const ScopeChange& s,
              const Box& root) {
  if (t.on) {
    if (t.set) {
      b.root = root.root + root.rotation(t.value);
    } else {
      b.root = b.root + (t.world ? root.rotation(t.value) : b.rotation(t.value));
    }
  }
  if (r.on) {
    const Rotation e = euler(r.value);
    if (r.set) {
      b.rotation = root.rotation * e;
    } else if (r.world) {
      b.rotation = root.rotation * e * root.rotation.inverse() * b.rotation;
    } else {
      b.rotation = b.rotation * e;
    }
  }
  if (s.on) {
    for (size_t i = 0; i < 3; ++i) {
      if (s.set) {
        if (s.value[i] != -1) b.size[i] = std::max(0.0, s.value[i]);
      } else {
        b.size[i] = std::max(0.0, s.relative ? b.size[i] * s.value[i] : b.size[i] + s.value[i]);
      }
    }
  }
  return b;
}

std::vector<Box> splitRule(const Box& b, int axis, std::vector<double> widths, bool toRoot,
                           const std::vector<std::string>& symbols) {
  const auto a = static_cast<size_t>(axis);
  std::vector<Box> out;
  double used = 0;
  for (size_t i = 0; i < symbols.size(); ++i) {
    const double left = b.size[a] - used;
    const double width = i < widths.size() ? std::min(widths[i], left) : left;
    if (width <= 0) break;
    Vec from{}, size = b.size;
    size[a] = width;
    from[a] = toRoot ? b.size[a] - used - width : used;
    out.push_back(part(b, from, size, symbols[i]));
    used += width;
  }
  return out;
}

namespace {

int countOf(double length, double preferred) {
  // std::nearbyint rounds halves to the even number, as Unity does.
  return preferred == 0 ? 1 : std::max(1, static_cast<int>(std::nearbyint(length / preferred)));
}

}  // namespace

std::vector<Box> repeatRule(const Box& b, int axis, const Vec& preferred,
                            const std::string& symbol) {
  const auto a = static_cast<size_t>(axis);
  const int n = countOf(b.size[a], preferred[a]);
  std::vector<Box> out;
  for (int i = 0; i < n; ++i) {
    Vec from{}, size = b.size;
    size[a] = b.size[a] / n;
    from[a] = size[a] * i;
    out.push_back(part(b, from, size, symbol));
  }
  return out;
}

std::vector<Box> gridRule(const Box& b, int axis, const Vec& preferred, const std::string& symbol) {
  const int flat = b.size[2] == 0 ? 2 : axis;
  const int first = flat == 0 ? 2 : 0, second = flat == 1 ? 2 : 1;
  std::vector<Box> out;
  for (const Box& row : repeatRule(b, first, preferred, symbol)) {
    for (const Box& cell : repeatRule(row, second, preferred, symbol)) out.push_back(cell);
  }
  return out;
}

std::vector<Box> marginRule(const Box& b, int axis, bool relative, double m, Facing facing,
                            bool center) {
  // Cyclic: the edge at the far end of `first` is not turned, and runs along `second`.
  const auto a = static_cast<size_t>(axis), first = (a + 1) % 3, second = (a + 2) % 3;
  const auto thirds = [&](size_t i) {
    const double width = relative ? m * b.size[i] : m;
    return std::array<std::array<double, 2>, 3>{
        {{0, width}, {width, b.size[i] - 2 * width}, {b.size[i] - width, width}}};
  };
  const auto f = thirds(first), s = thirds(second);
  std::vector<Box> out;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const auto& alongFirst = f[static_cast<size_t>(i + 1)];
      const auto& alongSecond = s[static_cast<size_t>(j + 1)];
      if (alongFirst[1] <= 1e-9 || alongSecond[1] <= 1e-9) continue;
      Vec from{}, size = b.size;
      from[first] = alongFirst[0];
      size[first] = alongFirst[1];
      from[second] = alongSecond[0];
      size[second] = alongSecond[1];
      const int border = std::abs(i) + std::abs(j);
      if (border == 0 && !center) continue;
      Box piece = part(b, from, size, border == 2 ? "C" : border == 1 ? "E" : "X");
      int quarters = 0;
      if (border == 1) quarters = i == 1 ? 0 : j == 1 ? 1 : i == -1 ? 2 : 3;
      if (border == 2) quarters = i == 1 ? (j == 1 ? 0 : 3) : (j == 1 ? 1 : 2);
      if (facing == Facing::In) quarters += 2;
      if (border > 0 && facing != Facing::Default) piece = rerooted(piece, axis, quarters);
      out.push_back(piece);
    }
  }
  return out;
}

std::vector<Box> componentRule(const Box& b, int axis) {
  // The box as if the axis of the rule were y.
  const auto y = static_cast<size_t>(axis), z = (y + 1) % 3, x = (y + 2) % 3;
  Box u = b;
  u.rotation = {{b.rotation.axes[x], b.rotation.axes[y], b.rotation.axes[z]}};
  u.size = {b.size[x], b.size[y], b.size[z]};
  const double sx = u.size[0], sy = u.size[1], sz = u.size[2];
  const Vec right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, 1};
  const auto face = [&](const Vec& origin, const Vec& alongX, const Vec& alongY, double w, double h,
                        const char* symbol) {
    // x, y and the axis into the box, in a left-handed frame.
    const Vec into{alongX[1] * alongY[2] - alongX[2] * alongY[1],
                   alongX[2] * alongY[0] - alongX[0] * alongY[2],
                   alongX[0] * alongY[1] - alongX[1] * alongY[0]};
    return Box{symbol,
               u.root + u.rotation(origin),
               {{u.rotation(alongX), u.rotation(alongY), u.rotation(into)}},
               {w, h, 0}};
  };
  return {face({}, right, up, sx, sy, "Side"),
          face(right * sx, forward, up, sz, sy, "Side"),
          face(right * sx + forward * sz, right * -1, up, sx, sy, "Side"),
          face(forward * sz, forward * -1, up, sz, sy, "Side"),
          face(up * sy, right, forward, sx, sz, "Top"),
          face(forward * sz, right, forward * -1, sx, sz, "Bottom")};
}

}  // namespace gbbg_world
