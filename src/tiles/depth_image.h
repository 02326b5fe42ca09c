// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Depth images of coarse models: which part is seen where from one direction, and how deep it lies.
// They are orthographic; a cell shows what lies in its middle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "tiles/coarse.h"
#include "tiles/sheets.h"

namespace gable {

/// Of one triangle, in the world.
using CoarseTriangle = std::array<Vec3, 3>;

/// The triangles of a part: those of its box where it has none, one side where that is flat.
template <class Visit>
void forEachTriangle(const CoarseModel& model, const CoarsePart& part, const Visit& visit) {
  static constexpr std::array<std::array<size_t, 4>, 6> kSides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (uint32_t t = 0; t < part.triangleCount; ++t) {
    const auto& corners = model.triangles[part.firstTriangle + t];
    const auto at = [&](size_t k) { return model.vertices[part.firstVertex + corners[k]]; };
    visit(CoarseTriangle{at(0), at(1), at(2)});
  }
  if (part.triangleCount > 0) return;
  const std::array<Vec3, 8> c = cornersOf(part);
  const auto visitSide = [&](size_t side) {
    const auto& s = kSides[side];
    visit(CoarseTriangle{c[s[0]], c[s[1]], c[s[2]]});
    visit(CoarseTriangle{c[s[0]], c[s[2]], c[s[3]]});
  };
  // Faces look along the z of their scope.
  const Vec3 size = part.box.size();
  const size_t across = thinnestOf(size);
  if (size[across] == 0) return visitSide(2 * across + 1);
  for (size_t side = 0; side < kSides.size(); ++side) visitSide(side);
}

class DepthImage {
 public:
  /// What is seen in a cell.
  struct Hit {
    double depth = -std::numeric_limits<double>::infinity();
    /// How much it faces the viewer: a cosine, negative for a back.
    double facing = 0;
    const CoarsePart* part = nullptr;
  };

  /// Looks along the z of a frame, from where it is large, at what lies in `reach`, which counts in
  /// the frame; cells are `side` metres wide.
  DepthImage(const Frame& frame, const Box3& reach, double side);

  int64_t width() const { return width_; }
  int64_t height() const { return height_; }
  bool contains(int64_t x, int64_t y) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_;
  }
  const Hit& at(int64_t x, int64_t y) const { return hits_[static_cast<size_t>(y * width_ + x)]; }
  /// Where the lower side of a cell is, counted in the frame.
  Vec2 cornerAt(double x, double y) const { return {low_.x + x * side_, low_.y + y * side_}; }

  /// The part has to stay where it is while it is asked for.
  void add(const CoarseModel& model, const CoarsePart& part);

 private:
  int64_t cellsOf(double length) const { return static_cast<int64_t>(length / side_) + 3; }
  void add(const CoarseTriangle& world, const CoarsePart& part);
  void see(size_t cell, const Hit& hit);

  Frame frame_;
  Vec2 low_;
  double side_;
  int64_t width_, height_;
  std::vector<Hit> hits_;
};

}  // namespace gable
