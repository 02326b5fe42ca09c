// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Segments are written row by row into the cells that they cross, widened by a hair so that
// rounding never loses one; cells are stored as one array with starts (counting sort).
#include "geom/region/segment_grid.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"

namespace gable {
namespace {

void appendEdges(const Ring& r, std::vector<Segment>& out) {
  work(r.size());
  for (size_t i = 0; i < r.size(); ++i) out.push_back({r[i], r[i + 1 == r.size() ? 0 : i + 1]});
}

// Above this many cells a side, memory would outgrow the use.
constexpr int kMaxSide = 512;

}  // namespace

std::vector<Segment> edgesOf(const std::vector<Ring>& rings) {
  std::vector<Segment> out;
  for (const Ring& r : rings) appendEdges(r, out);
  return out;
}

std::vector<Segment> edgesOf(const Polygon& p) {
  std::vector<Segment> out;
  appendEdges(p.outer, out);
  for (const Ring& h : p.holes) appendEdges(h, out);
  return out;
}

double distanceTo(const Segment& s, Vec2 p) {
  const Vec2 d = s.b - s.a;
  const double l2 = dot(d, d);
  const double t = l2 > 0 ? std::clamp(dot(p - s.a, d) / l2, 0.0, 1.0) : 0.0;
  return length(p - (s.a + d * t));
}

SegmentGrid::SegmentGrid(std::span<const Segment> segments) {
  if (segments.empty()) return;
  Box2 box;
  for (const Segment& s : segments) {
    box.include(s.a);
    box.include(s.b);
  }
  const Vec2 size = box.size();
  const double longer = std::max(size.x, size.y);
  const double shorter = std::max(std::min(size.x, size.y), longer * 1e-3);
  const auto n = static_cast<double>(segments.size());
  const double pitch = longer > 0 ? std::sqrt(longer * shorter / n) : 1;
  const auto side = [&](double extent) {
    return std::clamp(static_cast<int>(extent / pitch), 1, kMaxSide);
  };
  nx_ = side(size.x);
  ny_ = side(size.y);
  origin_ = box.min;
  inverse_ = {size.x > 0 ? nx_ / size.x : 0, size.y > 0 ? ny_ / size.y : 0};
  seen_.assign(segments.size(), 0);
  starts_.assign(static_cast<size_t>(nx_) * static_cast<size_t>(ny_) + 1, 0);
  for (const Segment& s : segments) rasterize(s, [&](size_t c) { ++starts_[c + 1]; });
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  items_.resize(starts_.back());
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (uint32_t i = 0; i < segments.size(); ++i) {
    rasterize(segments[i], [&](size_t c) { items_[next[c]++] = i; });
  }
}

template <class Put>
void SegmentGrid::rasterize(const Segment& s, Put&& put) const {
  const Segment up = s.a.y <= s.b.y ? s : Segment{s.b, s.a};
  const int y0 = row(up.a.y), y1 = row(up.b.y);
  const double rise = up.b.y - up.a.y;
  const double slope = rise > 0 ? (up.b.x - up.a.x) / rise : 0;
  const double hair = 1e-9 * (std::fabs(up.b.x - up.a.x) + std::fabs(origin_.x) + 1e-300);
  // A segment that is almost level has no stable crossing with a row; it takes its whole width.
  const bool steep = y0 != y1 && rise > 1e-6 * std::fabs(up.b.x - up.a.x);
  for (int y = y0; y <= y1; ++y) {
    work(2);
    double lo = std::min(up.a.x, up.b.x), hi = std::max(up.a.x, up.b.x);
    if (steep) {
      const double bottom = std::max(up.a.y, origin_.y + y / inverse_.y);
      const double top = std::min(up.b.y, origin_.y + (y + 1) / inverse_.y);
      const double xb = up.a.x + slope * (bottom - up.a.y), xt = up.a.x + slope * (top - up.a.y);
      lo = std::max(lo, std::min(xb, xt) - hair);
      hi = std::min(hi, std::max(xb, xt) + hair);
    }
    const int x1 = column(hi);
    work(static_cast<size_t>(std::max(x1 - column(lo), 0)));
    for (int x = column(lo); x <= x1; ++x) put(cell(x, y));
  }
}

}  // namespace gable
