// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/depth_image.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"

namespace gable {
namespace {

// Neighbours share their edge, in cells and in metres.
constexpr double kEdge = 1e-6;

}  // namespace

DepthImage::DepthImage(const Frame& frame, const Box3& reach, double side)
    : frame_(frame),
      low_{reach.min.x - side, reach.min.y - side},
      side_(side),
      width_(cellsOf(reach.size().x)),
      height_(cellsOf(reach.size().y)),
      hits_(static_cast<size_t>(width_ * height_)) {}

void DepthImage::add(const CoarseModel& model, const CoarsePart& part) {
  forEachTriangle(model, part, [&](const CoarseTriangle& t) { add(t, part); });
}

void DepthImage::add(const CoarseTriangle& world, const CoarsePart& part) {
  CoarseTriangle t;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 p = frame_.toLocal(world[i]);
    t[i] = {(p.x - low_.x) / side_ - 0.5, (p.y - low_.y) / side_ - 0.5, p.z};
  }
  const Vec3 n = cross(world[1] - world[0], world[2] - world[0]);
  const double twice =
      (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  if (!(std::abs(twice) > 1e-9) || !(length(n) > 0)) return;
  const double facing = dot(n, frame_.z) / length(n);
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto first = [](double v) { return std::max(std::ceil(v - kEdge), 0.0); };
  const auto last = [](double v, int64_t most) {
    return std::min(std::floor(v + kEdge), static_cast<double>(most - 1));
  };
  for (double y = first(low); y <= last(high, height_); ++y) {
    work();
    double from = first(left), to = last(right, width_);
    // The depth along the row, and where the row is inside all three sides.
    double base = 0, slope = 0;
    for (size_t k = 0; k < 3; ++k) {
      // The share of a corner: what the side across from it leaves.
      const Vec3 &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
      const double per = -(b.y - a.y) / twice;
      const double share = ((b.x - a.x) * (y - a.y)) / twice - per * a.x;
      if (per > 0) from = std::max(from, std::ceil((-kEdge - share) / per));
      if (per < 0) to = std::min(to, std::floor((-kEdge - share) / per));
      if (per == 0 && share < -kEdge) to = -1;
      base += share * t[k].z;
      slope += per * t[k].z;
    }
    if (!(from <= to)) continue;
    size_t cell =
        static_cast<size_t>(static_cast<int64_t>(y) * width_ + static_cast<int64_t>(from));
    for (double x = from; x <= to; ++x) see(cell++, {base + slope * x, facing, &part});
  }
}

// The nearer; of what is equally near the front.
void DepthImage::see(size_t cell, const Hit& hit) {
  Hit& seen = hits_[cell];
  const bool isEqual = std::abs(hit.depth - seen.depth) <= kEdge;
  if (isEqual ? hit.facing > seen.facing : hit.depth > seen.depth) seen = hit;
}

}  // namespace gable
