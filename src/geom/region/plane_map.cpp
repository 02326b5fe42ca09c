// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Around each point half-edges are sorted by direction; following them gives cycles. A cycle that
// turns left is the outline of a face, one that turns right the outside of a connected part: the
// face that holds it is found by a look downwards from its leftmost point, at the next edge there.
// Parts are taken from left to right, so that what lies below is known already.
#include "geom/region/plane_map.h"

namespace gable {
namespace {

__extension__ using Wide = __int128;
constexpr uint32_t kNone = 0xffffffff;

bool upper(GridPoint d) { return d.y > 0 || (d.y == 0 && d.x > 0); }

// Edge s is below edge t just to the right of x, where both are.
bool isBelow(GridPoint a, GridPoint b, GridPoint c, GridPoint d, int64_t x) {
  const int64_t dx = b.x - a.x, dy = b.y - a.y, ex = d.x - c.x, ey = d.y - c.y;
  const Wide s = (static_cast<Wide>(a.y) * dx + static_cast<Wide>(x - a.x) * dy) * ex;
  const Wide t = (static_cast<Wide>(c.y) * ex + static_cast<Wide>(x - c.x) * ey) * dx;
  if (s != t) return s < t;
  return static_cast<Wide>(dy) * ex < static_cast<Wide>(ey) * dx;
}

}  // namespace

PlaneMap::PlaneMap(std::span<const GridPoint> points, std::span<const Edge> edges)
    : points_(points), edges_(edges) {
  sortAround();
  traceFaces();
}

void PlaneMap::sortAround() {
  const uint32_t count = halfEdgeCount();
  starts_.assign(points_.size() + 1, 0);
  for (uint32_t h = 0; h < count; ++h) ++starts_[from(h) + 1];
  for (size_t p = 0; p < points_.size(); ++p) starts_[p + 1] += starts_[p];
  around_.resize(count);
  places_.resize(count);
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (uint32_t h = 0; h < count; ++h) around_[next[from(h)]++] = h;
  const auto direction = [&](uint32_t h) {
    const GridPoint a = points_[from(h)], b = points_[to(h)];
    return GridPoint{b.x - a.x, b.y - a.y};
  };
  for (size_t p = 0; p < points_.size(); ++p) {
    work(1 + starts_[p + 1] - starts_[p]);
    std::sort(around_.begin() + starts_[p], around_.begin() + starts_[p + 1],
              [&](uint32_t g, uint32_t h) {
                const GridPoint d = direction(g), e = direction(h);
                if (upper(d) != upper(e)) return upper(d);
                return d.x * e.y - d.y * e.x > 0;
              });
  }
  for (uint32_t i = 0; i < count; ++i) places_[around_[i]] = i;
}

// The half-edge with the next edge below a point on its right side, or none.
uint32_t PlaneMap::halfEdgeBelow(uint32_t point, const CellGrid& grid,
                                 const CellLists& lists) const {
  const GridPoint p = points_[point];
  uint32_t best = kNone;
  const int64_t column = grid.column(p.x);
  for (int64_t row = grid.row(p.y); row >= 0; --row) {
    const size_t cell = grid.cell(column, row);
    work(1 + static_cast<size_t>(lists.end(cell) - lists.begin(cell)));
    for (const uint32_t* e = lists.begin(cell); e != lists.end(cell); ++e) {
      const GridPoint a = points_[edges_[*e].low], b = points_[edges_[*e].high];
      if (a.x > p.x || b.x <= p.x || turn(a, b, p) <= 0) continue;
      if (best != kNone) {
        const Edge& other = edges_[best];
        if (!isBelow(points_[other.low], points_[other.high], a, b, p.x)) continue;
      }
      best = *e;
    }
    if (best == kNone) continue;
    // What cells further down hold besides is below this cell.
    const GridPoint a = points_[edges_[best].low], b = points_[edges_[best].high];
    const Wide height = static_cast<Wide>(a.y - grid.bottom(row)) * (b.x - a.x) +
                        static_cast<Wide>(p.x - a.x) * (b.y - a.y);
    if (height >= 0) break;
  }
  return best == kNone ? kNone : 2 * best;
}

void PlaneMap::traceFaces() {
  const uint32_t count = halfEdgeCount();
  struct Cycle {
    uint32_t lowest;
    uint32_t face;
    uint32_t any;
  };
  std::vector<Cycle> cycles;
  std::vector<uint32_t> cycleOf(count, kNone), outsides;
  for (uint32_t start = 0; start < count; ++start) {
    if (cycleOf[start] != kNone) continue;
    const auto number = static_cast<uint32_t>(cycles.size());
    Wide area = 0;
    Cycle cycle{kNone, kNone, start};
    const GridPoint o = points_[from(start)];
    for (uint32_t h = start; cycleOf[h] == kNone; h = next(h)) {
      work();
      cycleOf[h] = number;
      area += turn(o, points_[from(h)], points_[to(h)]);
      cycle.lowest = std::min(cycle.lowest, from(h));
    }
    if (area > 0) {
      cycle.face = faceCount_++;
    } else {
      outsides.push_back(number);
    }
    cycles.push_back(cycle);
  }
  if (count == 0) return;
  std::sort(outsides.begin(), outsides.end(),
            [&](uint32_t a, uint32_t b) { return cycles[a].lowest < cycles[b].lowest; });

  GridPoint low = points_[0], high = points_[0];
  for (const GridPoint p : points_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const CellGrid grid(low, high, edges_.size());
  const CellLists lists(grid.size(), [&](const auto& put) {
    for (uint32_t e = 0; e < edges_.size(); ++e) {
      grid.along(points_[edges_[e].low], points_[edges_[e].high], 0,
                 [&](size_t cell) { put(cell, e); });
    }
  });
  for (const uint32_t number : outsides) {
    const uint32_t below = halfEdgeBelow(cycles[number].lowest, grid, lists);
    cycles[number].face = below == kNone ? 0 : cycles[cycleOf[below]].face;
  }
  faces_.resize(count);
  for (uint32_t h = 0; h < count; ++h) faces_[h] = cycles[cycleOf[h]].face;
}

}  // namespace gable
