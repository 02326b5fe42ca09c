// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/building_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>

#include "base/measure.h"
#include "base/work.h"
#include "city/buildings.h"
#include "city/grid_point.h"
#include "city/surface.h"

namespace gable {
namespace {

// A point so near to an outline lies on it, in metres.
constexpr double kOn = 0.4;

constexpr const char* kUses[] = {"shop", "amenity", "office", "craft", "tourism"};
// What of `amenity` has a front towards the street.
constexpr std::string_view kOpen[] = {"restaurant", "cafe",      "bar",         "pub",
                                      "fast_food",  "ice_cream", "bank",        "pharmacy",
                                      "biergarten", "nightclub", "post_office", "bureau_de_change"};

bool isAddress(const MapFeature& f) {
  return !f.tag("addr:housenumber").empty() || !f.tag("addr:street").empty();
}
bool isEntrance(const MapFeature& f) {
  const std::string_view entrance = f.tag("entrance");
  return isTrue(entrance) && entrance != "garage" && entrance != "emergency";
}
bool isUse(const MapFeature& f) {
  return std::any_of(std::begin(kUses), std::end(kUses),
                     [&](const char* key) { return isTrue(f.tag(key)); });
}
bool isShop(const MapFeature& f) {
  // On another floor.
  if (writtenNumber(f.tag("level")).value_or(0) != 0) return false;
  const std::string_view amenity = f.tag("amenity");
  return isTrue(f.tag("shop")) || isTrue(f.tag("craft")) ||
         std::find(std::begin(kOpen), std::end(kOpen), amenity) != std::end(kOpen);
}

double distanceTo(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double whole = dot(along, along);
  const double t = whole > 0 ? std::clamp(dot(p - a, along) / whole, 0.0, 1.0) : 0;
  return length(p - (a + along * t));
}

struct Outline {
  uint32_t feature;
  Box2 box;
  double area;
};

// Finds the outline at a place.
class Outlines {
 public:
  Outlines(const std::vector<MapFeature>& features, bool parts)
      : features_(features), grid_(make(parts)), lists_(grid_.size(), [&](const auto& put) {
          for (uint32_t k = 0; k < all_.size(); ++k) {
            const GridPoint low = gridPoint(all_[k].box.min), high = gridPoint(all_[k].box.max);
            for (int64_t r = grid_.row(low.y); r <= grid_.row(high.y); ++r) {
              for (int64_t c = grid_.column(low.x); c <= grid_.column(high.x); ++c) {
                work();
                put(grid_.cell(c, r), k);
              }
            }
          }
        }) {}

  std::optional<uint32_t> at(Vec2 p) const {
    const Outline* best = nullptr;
    bool bestOn = false;
    const size_t cell = grid_.cellOf(gridPoint(p));
    for (const uint32_t* k = lists_.begin(cell); k != lists_.end(cell); ++k) {
      const Outline& o = all_[*k];
      if (!o.box.contains(p)) continue;
      const bool inside = isInside(features_[o.feature], p);
      const bool on = !inside && isOn(features_[o.feature], p);
      if (!inside && !on) continue;
      const auto order = [](bool isOn, const Outline& x) {
        return std::tuple(isOn, x.area, x.feature);
      };
      if (best && order(bestOn, *best) < order(on, o)) continue;
      best = &o;
      bestOn = on;
    }
    return best ? std::optional(best->feature) : std::nullopt;
  }

  static bool isOn(const MapFeature& f, Vec2 p) {
    for (const Ring& r : f.rings) {
      work(r.size());
      for (size_t i = 0; i < r.size(); ++i) {
        if (distanceTo(p, r[i], r[(i + 1) % r.size()]) <= kOn) return true;
      }
    }
    return false;
  }

 private:
  static bool isInside(const MapFeature& f, Vec2 p) {
    bool inside = false;
    for (const Ring& r : f.rings) {
      work(r.size());
      const Where where = locate(r, p);
      if (where == Where::Boundary) return false;
      if (where == Where::Inside) inside = !inside;
    }
    return inside;
  }
  CellGrid make(bool parts) {
    Box2 whole;
    for (uint32_t i = 0; i < features_.size(); ++i) {
      const MapFeature& f = features_[i];
      if (parts ? !isBuildingPart(f) : !isBuilding(f)) continue;
      Outline o{i, {}, 0};
      for (const Ring& r : f.rings) {
        work(r.size());
        o.area += std::fabs(signedArea(r));
        for (const Vec2 p : r) o.box.include(p);
      }
      o.box.min = o.box.min - Vec2{kOn, kOn};
      o.box.max = o.box.max + Vec2{kOn, kOn};
      whole.include(o.box.min);
      whole.include(o.box.max);
      all_.push_back(o);
    }
    if (whole.empty()) whole.include({0, 0});
    return CellGrid(gridPoint(whole.min), gridPoint(whole.max), all_.size());
  }

  const std::vector<MapFeature>& features_;
  std::vector<Outline> all_;
  CellGrid grid_;
  CellLists lists_;
};

// Values that stand in a list, each once, in the order of their first.
class List {
 public:
  void add(std::string_view value) {
    if (value.empty() || !seen_.insert(std::string(value)).second) return;
    text_ += (text_.empty() ? "" : ";") + std::string(value);
  }
  size_t size() const { return seen_.size(); }
  const std::string& text() const { return text_; }

 private:
  std::set<std::string> seen_;
  std::string text_;
};

double leadingNumber(std::string_view text) {
  double value = 0;
  size_t end = 0;
  while (end < text.size() && end < 9 && text[end] >= '0' && text[end] <= '9') {
    value = 10 * value + (text[end++] - '0');
  }
  return end > 0 ? value : 1e12;
}

void takeAddresses(std::vector<const MapFeature*> points, const MapFeature& building,
                   BuildingPoints& out) {
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const MapFeature* f) { return !isAddress(*f); }),
               points.end());
  if (points.empty()) return;
  const auto order = [](const MapFeature* f) {
    const std::string_view number = f->tag("addr:housenumber");
    return std::tuple(f->tag("entrance") != "main", f->tag("addr:street"), leadingNumber(number),
                      number);
  };
  std::stable_sort(points.begin(), points.end(),
                   [&](const MapFeature* a, const MapFeature* b) { return order(a) < order(b); });
  for (const auto& [key, value] : points[0]->tags) {
    if (key.starts_with("addr:")) out.tags.emplace_back(key, value);
  }
  List all;
  for (const MapFeature* f : points) {
    std::string text(f->tag("addr:street").empty() ? f->tag("addr:place") : f->tag("addr:street"));
    const std::string_view number = f->tag("addr:housenumber");
    if (!number.empty()) text += (text.empty() ? "" : " ") + std::string(number);
    all.add(text);
  }
  out.addresses = all.text();
  if (!out.entrances.empty()) return;
  for (const MapFeature* f : points) {
    if (!Outlines::isOn(building, f->points[0])) continue;
    out.entrances.push_back(f->points[0]);
    break;
  }
}

BuildingPoints summed(std::vector<const MapFeature*> points, const MapFeature& building) {
  std::sort(points.begin(), points.end(), [](const MapFeature* a, const MapFeature* b) {
    return std::tuple(a->id, a->points[0].x, a->points[0].y) <
           std::tuple(b->id, b->points[0].x, b->points[0].y);
  });
  BuildingPoints out;
  for (const bool main : {true, false}) {
    for (const MapFeature* f : points) {
      if (isEntrance(*f) && (f->tag("entrance") == "main") == main) {
        out.entrances.push_back(f->points[0]);
      }
    }
  }
  takeAddresses(points, building, out);
  List names;
  for (const MapFeature* f : points) {
    if (isUse(*f) || isAddress(*f)) names.add(f->tag("name"));
    if (isShop(*f)) out.shops.push_back(f->points[0]);
  }
  out.names = names.text();
  if (names.size() == 1) out.tags.emplace_back("name", names.text());
  for (const char* key : kUses) {
    std::set<std::string_view> values;
    for (const MapFeature* f : points) {
      if (isTrue(f->tag(key))) values.insert(f->tag(key));
    }
    List list;
    for (const std::string_view value : values) list.add(value);
    if (list.size() > 0) out.tags.emplace_back(key, list.text());
  }
  return out;
}

}  // namespace

std::map<uint32_t, BuildingPoints> buildingPointsOf(const std::vector<MapFeature>& features) {
  std::vector<const MapFeature*> said;
  for (const MapFeature& f : features) {
    if (f.kind != MapFeature::Kind::Point) continue;
    if (isAddress(f) || isEntrance(f) || isUse(f)) said.push_back(&f);
  }
  std::map<uint32_t, BuildingPoints> out;
  if (said.empty()) return out;
  for (const bool parts : {false, true}) {
    const Outlines outlines(features, parts);
    std::map<uint32_t, std::vector<const MapFeature*>> points;
    for (const MapFeature* f : said) {
      work();
      if (const auto at = outlines.at(f->points[0])) points[*at].push_back(f);
    }
    for (auto& [feature, list] : points) {
      out.emplace(feature, summed(std::move(list), features[feature]));
    }
  }
  return out;
}

}  // namespace gable
