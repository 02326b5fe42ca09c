// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/sheets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gable {
namespace {

// Directions are equal that differ by less.
constexpr double kTurn = 1.0 / 1024;
constexpr double kMostWeight = 1e12;

}  // namespace

size_t thinnestOf(const Vec3& size) {
  const size_t least = size.x <= size.y ? 0 : 1;
  return size[least] <= size.z ? least : 2;
}

double faceArea(const Box3& box) {
  const Vec3 s = box.size();
  return std::max({s.x * s.y, s.y * s.z, s.x * s.z});
}

double weightOf(const Box3& box) { return std::min(faceArea(box), kMostWeight); }

Vec3 axisOf(const Frame& frame, size_t axis) {
  Vec3 unit;
  unit[axis] = 1;
  return frame.direction(unit);
}

std::array<Vec3, 8> cornersOf(const CoarsePart& p) {
  std::array<Vec3, 8> out;
  for (size_t i = 0; i < 8; ++i) {
    out[i] = p.frame.point({i & 1 ? p.box.max.x : p.box.min.x, i & 2 ? p.box.max.y : p.box.min.y,
                            i & 4 ? p.box.max.z : p.box.min.z});
  }
  return out;
}

size_t endOfFeature(const std::vector<CoarsePart>& parts, size_t begin) {
  size_t end = begin;
  while (end < parts.size() && parts[end].feature == parts[begin].feature) ++end;
  return end;
}

void addFlat(CoarseModel& model, CoarsePart& p) {
  p.firstVertex = static_cast<uint32_t>(model.vertices.size());
  p.firstTriangle = static_cast<uint32_t>(model.triangles.size());
  p.vertexCount = 4;
  p.triangleCount = 2;
  const Vec3 &low = p.box.min, &high = p.box.max;
  for (const Vec3& v : {low, Vec3{high.x, low.y, low.z}, high, Vec3{low.x, high.y, low.z}}) {
    model.vertices.push_back(p.frame.point(v));
  }
  model.triangles.push_back({0, 1, 2});
  model.triangles.push_back({0, 2, 3});
}

double shownOf(const CoarseModel& model, const CoarsePart& p) {
  double area = 0;
  for (uint32_t t = 0; t < p.triangleCount; ++t) {
    const auto& tri = model.triangles[p.firstTriangle + t];
    const auto at = [&](size_t k) { return model.vertices[p.firstVertex + tri[k]]; };
    area += length(cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return area;
}

std::optional<Sheet> sheetOf(const CoarseModel& model, size_t part, double most) {
  const CoarsePart& p = model.parts[part];
  const Vec3 size = p.box.size();
  const size_t across = thinnestOf(size);
  if (!(size[across] <= most)) return std::nullopt;
  Sheet s;
  s.part = part;
  s.normal = axisOf(p.frame, across);
  for (size_t i = 0; i < 3; ++i) s.direction[i] = std::llround(s.normal[i] / kTurn);
  if (s.direction < std::array<int64_t, 3>{}) {
    s.normal = s.normal * -1;
    for (int64_t& d : s.direction) d = -d;
  }
  s.offset = dot(s.normal, p.frame.point(p.box.center()));
  if (!std::isfinite(s.offset)) return std::nullopt;
  return s;
}

bool liesBefore(const Sheet& a, const Sheet& b) {
  return std::tie(a.direction, a.offset) < std::tie(b.direction, b.offset);
}

double facingOf(const CoarseModel& model, const Sheet& s) {
  const CoarsePart& p = model.parts[s.part];
  const Vec3 size = p.box.size();
  const size_t across = thinnestOf(size);
  if (size[across] > 0) return 0;
  return weightOf(p.box) * dot(s.normal, axisOf(p.frame, across));
}

Frame frameOf(const CoarseModel& model, const Sheet& s, double facing) {
  const CoarsePart& p = model.parts[s.part];
  const Vec3 z = s.normal * (facing < 0 ? -1.0 : 1.0);
  const Vec3 x = axisOf(p.frame, (thinnestOf(p.box.size()) + 1) % 3);
  return Frame::of(p.frame.point(p.box.center()), x, cross(z, x), z);
}

}  // namespace gable
