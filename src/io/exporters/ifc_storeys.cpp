// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/ifc_storeys.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/work.h"

namespace gable {
namespace {

constexpr double kStoreyHeight = 3;
constexpr double kMostStoreys = 300;
// Metres between feet that count as one.
constexpr double kFoot = 0.05;
// Of the usual width of upright faces: less is a gable.
constexpr double kLeastWall = 0.4;
// Of a unit normal, upwards or downwards: more is not upright.
constexpr double kUpright = 0.3;

// Attributes and reports that say how many storeys a building has.
constexpr const char* kStoreyNames[] = {"storeys",         "stories",         "storeysAboveGround",
                                        "floors",          "building:levels", "building_levels",
                                        "building.levels", "levels"};

bool carries(CityKind kind) {
  return kind == CityKind::Wall || kind == CityKind::Floor || kind == CityKind::Door;
}

}  // namespace

double storeyCountOf(const std::vector<AttributeValue>& known) {
  for (const char* name : kStoreyNames) {
    for (const AttributeValue& a : known) {
      if (a.name != name || a.values.empty()) continue;
      double count = a.values[0].number;
      const bool isText = a.values[0].kind == PlainValue::Kind::Text;
      if (isText && !parseNumber(a.values[0].text, count)) continue;
      if (count >= 1 && count <= kMostStoreys) return std::floor(count);
    }
  }
  return 0;
}

void IfcStoreys::clear() {
  bounds_ = Box3{};
  widths_.clear();
  walls_.clear();
  anything_.clear();
  all_.clear();
}

void IfcStoreys::add(const Leaf& leaf, const Frame& world, const CityPart& part) {
  const Box3 box = faces_.boxOf(leaf, world);
  if (box.empty()) return;
  bounds_.include(box);
  const bool stands =
      part.kind == CityKind::Wall || part.kind == CityKind::Unknown || isOpening(part.kind);
  if (stands) addUpright(leaf, world);
  if (part.storey == 0) return;
  const double width = std::max(box.size().x, box.size().z);
  if (!(std::fabs(box.min.y) < kFarthestCity) || !(width < kFarthestCity)) return;
  const int64_t foot = std::llround(box.min.y / kFoot);
  if (carries(part.kind)) walls_[part.storey][foot] += width;
  anything_[part.storey][foot] += width;
}

// A face counts over its height with its middle width.
void IfcStoreys::addUpright(const Leaf& leaf, const Frame& world) {
  faces_.forEach(leaf, world, [&](CityFace& face) {
    const double twice = length(face.normal);
    if (!(std::fabs(face.normal.y) < kUpright * twice)) return;
    double low = face.rings[0][0].y, high = low;
    for (const Vec3& p : face.rings[0]) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
    if (!(high - low > 0.01)) return;
    const double width = twice / 2 / (high - low);
    if (widths_.size() == widths_.capacity()) {
      workMemory((widths_.size() + 2) * sizeof(std::pair<double, double>));
    }
    widths_.emplace_back(low, width);
    widths_.emplace_back(high, -width);
  });
}

double IfcStoreys::eaves() {
  work(widths_.size());
  std::sort(widths_.begin(), widths_.end());
  // The usual width is the mean over the area, so that cornices and gables hardly count.
  double area = 0, weighted = 0, width = 0;
  for (size_t i = 0; i + 1 < widths_.size(); ++i) {
    width += widths_[i].second;
    const double tall = widths_[i + 1].first - widths_[i].first;
    area += width * tall;
    weighted += width * width * tall;
  }
  const double least = area > 0 ? kLeastWall * weighted / area : 0;
  double top = bounds_.min.y;
  width = 0;
  for (size_t i = 0; i + 1 < widths_.size(); ++i) {
    width += widths_[i].second;
    const bool isTall = widths_[i + 1].first > widths_[i].first + 1e-9;
    if (isTall && width >= least) top = widths_[i + 1].first;
  }
  return top > bounds_.min.y + 1 ? top : bounds_.max.y;
}

// The lowest foot that is as wide as half of the widest: a single high wall does not count.
double IfcStoreys::elevationOf(const Feet& feet) const {
  double most = 0;
  for (const auto& [foot, width] : feet) most = std::max(most, width);
  for (const auto& [foot, width] : feet) {
    if (width >= most / 2) return static_cast<double>(foot) * kFoot;
  }
  return bounds_.min.y;
}

void IfcStoreys::addEven(double count) {
  const double height = eaves() - bounds_.min.y;
  if (count == 0) count = std::clamp(std::round(height / kStoreyHeight), 1.0, kMostStoreys);
  const double each = height / count;
  const std::vector<IfcStorey> named = all_;
  for (double i = 0; i < count; ++i) {
    work(named.size() + 1);
    const double at = bounds_.min.y + i * each;
    const bool isNamed = std::any_of(named.begin(), named.end(), [&](const IfcStorey& s) {
      return std::fabs(s.elevation - at) < each / 2;
    });
    if (!isNamed) all_.push_back({"", at, 0});
  }
}

void IfcStoreys::nameEven() {
  const auto isTaken = [&](const std::string& name) {
    return std::any_of(all_.begin(), all_.end(),
                       [&](const IfcStorey& s) { return s.name == name; });
  };
  for (size_t i = 0; i < all_.size(); ++i) {
    if (all_[i].named) continue;
    for (size_t number = i; all_[i].name.empty(); ++number) {
      work(all_.size());
      const std::string name = "Storey " + std::to_string(number);
      if (!isTaken(name)) all_[i].name = name;
    }
  }
}

void IfcStoreys::divide(double count) {
  if (bounds_.empty()) return;
  for (const auto& [named, feet] : anything_) {
    work(feet.size());
    const auto walls = walls_.find(named);
    all_.push_back(
        {parts_.text(named), elevationOf(walls == walls_.end() ? feet : walls->second), named});
  }
  addEven(count);
  std::stable_sort(all_.begin(), all_.end(), [](const IfcStorey& a, const IfcStorey& b) {
    return a.elevation < b.elevation;
  });
  nameEven();
}

size_t IfcStoreys::of(const CityPart& part, const Box3& box) const {
  size_t in = 0;
  for (size_t i = 0; i < all_.size(); ++i) {
    if (part.storey && all_[i].named == part.storey) return i;
    if (all_[i].elevation <= box.center().y) in = i;
  }
  return in;
}

}  // namespace gable
