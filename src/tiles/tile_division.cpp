// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_division.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/work.h"

namespace gable {

size_t TileSquare::quarterOf(Vec2 p) const {
  const Vec2 m = middle();
  return (p.x >= m.x ? 1u : 0u) + (p.y >= m.y ? 2u : 0u);
}

TileSquare TileSquare::quarter(size_t q) const {
  const double half = side / 2;
  return {{low.x + (q & 1 ? half : 0), low.y + (q & 2 ? half : 0)}, half};
}

bool TileSquare::holds(const Box2& box) const {
  return box.min.x >= low.x && box.min.y >= low.y && box.max.x <= low.x + side &&
         box.max.y <= low.y + side;
}

TileSquare squareAround(const Box2& box) {
  if (box.empty()) return {{}, kSmallestSquare};
  const Vec2 size = box.size();
  const double side = std::max({size.x, size.y, kSmallestSquare});
  return {box.center() - Vec2{side, side} * 0.5, side};
}

TileSquare TileDivision::squareOf(std::string_view name) const {
  TileSquare out = square;
  for (size_t i = 1; i < name.size(); ++i) out = out.quarter(static_cast<size_t>(name[i] - '0'));
  return out;
}

namespace {

// A folder has at most four to the power of this squares, and as many folders.
constexpr size_t kNamePiece = 5;

}  // namespace

std::string squarePath(std::string_view name) {
  std::string out;
  for (size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && i % kNamePiece == 0) out += '/';
    out += name[i];
  }
  return out;
}

bool isSquarePath(std::string_view path) {
  for (size_t i = 0; i < path.size(); ++i) {
    const bool slash = i % (kNamePiece + 1) == kNamePiece;
    if (slash ? path[i] != '/' : path[i] < '0' || path[i] > '3') return false;
  }
  return !path.empty() && path.back() != '/';
}

TileDivision divided(const std::vector<Vec2>& middles, size_t most) {
  TileDivision out;
  Box2 box;
  for (const Vec2 p : middles) box.include(p);
  out.square = squareAround(box);
  struct Open {
    TileSquare square;
    TileUnit unit;
  };
  std::vector<Open> open(1);
  open[0].square = out.square;
  open[0].unit.name = "0";
  open[0].unit.shapes.resize(middles.size());
  for (uint32_t i = 0; i < middles.size(); ++i) open[0].unit.shapes[i] = i;
  while (!open.empty()) {
    Open top = std::move(open.back());
    open.pop_back();
    work(top.unit.shapes.size());
    if (top.unit.shapes.empty()) continue;
    const bool deepest = top.unit.name.size() > static_cast<size_t>(kDeepestSquare);
    if (most == 0 || top.unit.shapes.size() <= most || deepest) {
      out.units.push_back(std::move(top.unit));
      continue;
    }
    std::array<Open, 4> quarters;
    for (size_t q = 0; q < 4; ++q) {
      quarters[q].square = top.square.quarter(q);
      quarters[q].unit.name = top.unit.name + static_cast<char>('0' + q);
    }
    for (const uint32_t s : top.unit.shapes) {
      quarters[top.square.quarterOf(middles[s])].unit.shapes.push_back(s);
    }
    // The last comes off first.
    for (size_t q = 4; q-- > 0;) open.push_back(std::move(quarters[q]));
  }
  return out;
}

}  // namespace gable
