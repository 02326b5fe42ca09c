// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/buildings.h"

#include <algorithm>
#include <cmath>

#include "base/measure.h"
#include "base/work.h"
#include "city/grid_point.h"
#include "city/surface.h"

namespace gable {
namespace {

constexpr double kStorey = 3.2;
// Neighbours are looked for so far, in metres, and so many are asked.
constexpr double kReach = 120;
constexpr size_t kAsked = 7;
// Of the area of a building: from so much on its parts stand for it.
constexpr double kMostlyParts = 0.6;

double areaOf(const MapFeature& f) {
  // The largest ring, less what lies within it by even-odd: outlines first, then their courts.
  double largest = 0, sum = 0;
  for (const Ring& r : f.rings) {
    const double a = std::fabs(signedArea(r));
    largest = std::max(largest, a);
    sum += a;
  }
  return std::max(2 * largest - sum, 0.3 * largest);
}

double levelsOf(const MapFeature& f) {
  const double levels = writtenNumber(f.tag("building:levels")).value_or(0);
  if (levels > 0 && levels < 200) return levels;
  const double height = writtenMetres(f.tag("height")).value_or(0);
  return height > 0 && height < 900 ? std::max(1.0, std::round(height / kStorey)) : 0;
}

// Places in cells, to find those near another.
class Near {
 public:
  Near(const std::vector<BuildingFacts>& facts, std::vector<uint32_t> numbers)
      : facts_(facts),
        numbers_(std::move(numbers)),
        grid_(make()),
        lists_(grid_.size(), [&](const auto& put) {
          for (const uint32_t i : numbers_) put(grid_.cellOf(gridPoint(facts_[i].place)), i);
        }) {}

  template <class Visit>
  void within(Vec2 p, double reach, Visit&& visit) const {
    const GridPoint low = gridPoint({p.x - reach, p.y - reach});
    const GridPoint high = gridPoint({p.x + reach, p.y + reach});
    for (int64_t r = grid_.row(low.y); r <= grid_.row(high.y); ++r) {
      for (int64_t c = grid_.column(low.x); c <= grid_.column(high.x); ++c) {
        const size_t cell = grid_.cell(c, r);
        for (const uint32_t* i = lists_.begin(cell); i != lists_.end(cell); ++i) {
          work();
          if (length(facts_[*i].place - p) <= reach) visit(*i);
        }
      }
    }
  }

 private:
  CellGrid make() const {
    GridPoint low{0, 0}, high{0, 0};
    for (size_t k = 0; k < numbers_.size(); ++k) {
      const GridPoint p = gridPoint(facts_[numbers_[k]].place);
      low = k == 0 ? p : GridPoint{std::min(low.x, p.x), std::min(low.y, p.y)};
      high = k == 0 ? p : GridPoint{std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return CellGrid(low, high, numbers_.size());
  }

  const std::vector<BuildingFacts>& facts_;
  std::vector<uint32_t> numbers_;
  CellGrid grid_;
  CellLists lists_;
};

// The middle of what the nearest say; those of the same kind go first.
double guess(const std::vector<MapFeature>& features, const std::vector<BuildingFacts>& facts,
             const Near& known, uint32_t building) {
  struct Neighbour {
    bool other;
    double distance;
    uint32_t number;
  };
  std::vector<Neighbour> found;
  const std::string_view kind = features[building].tag("building");
  known.within(facts[building].place, kReach, [&](uint32_t i) {
    // What is of quite another size says little.
    const double ratio = facts[i].area / std::max(facts[building].area, 1.0);
    if (ratio > 8 || ratio < 0.125) return;
    found.push_back(
        {features[i].tag("building") != kind, length(facts[i].place - facts[building].place), i});
  });
  if (found.empty()) return 0;
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    if (a.other != b.other) return b.other;
    return a.distance != b.distance ? a.distance < b.distance : a.number < b.number;
  });
  found.resize(std::min(found.size(), kAsked));
  std::vector<double> levels;
  for (const Neighbour& n : found) levels.push_back(facts[n.number].levels);
  std::nth_element(levels.begin(), levels.begin() + levels.size() / 2, levels.end());
  return levels[levels.size() / 2];
}

bool hasWithin(const MapFeature& f, Vec2 p) {
  bool inside = false;
  for (const Ring& r : f.rings) {
    if (locate(r, p) != Where::Outside) inside = !inside;
  }
  return inside;
}

void findParts(const std::vector<MapFeature>& features, std::vector<BuildingFacts>& facts) {
  std::vector<uint32_t> parts;
  for (uint32_t i = 0; i < features.size(); ++i) {
    if (isBuildingPart(features[i])) parts.push_back(i);
  }
  if (parts.empty()) return;
  const Near near(facts, parts);
  for (uint32_t i = 0; i < features.size(); ++i) {
    if (!isBuilding(features[i])) continue;
    Box2 box;
    for (const Ring& r : features[i].rings) {
      for (const Vec2 p : r) box.include(p);
    }
    double covered = 0;
    near.within(facts[i].place, 0.5 * length(box.size()), [&](uint32_t part) {
      if (!hasWithin(features[i], facts[part].place)) return;
      covered += facts[part].area;
      if (facts[part].owner != BuildingFacts::kNone) return;
      facts[part].owner = i;
      if (facts[part].levels > 0) return;
      facts[part].levels = facts[i].levels;
      facts[part].guessedLevels = facts[i].guessedLevels;
    });
    facts[i].hasParts = covered >= kMostlyParts * facts[i].area;
  }
}

// Larger areas first, so that the smallest one counts.
void findLandUse(const std::vector<MapFeature>& features, std::vector<BuildingFacts>& facts) {
  std::vector<uint32_t> buildings;
  std::vector<std::pair<double, uint32_t>> areas;
  for (uint32_t i = 0; i < features.size(); ++i) {
    const MapFeature& f = features[i];
    if (isBuilding(f)) buildings.push_back(i);
    if (f.kind == MapFeature::Kind::Area && !f.tag("landuse").empty()) {
      areas.emplace_back(-areaOf(f), i);
    }
  }
  if (buildings.empty() || areas.empty()) return;
  std::sort(areas.begin(), areas.end());
  const Near near(facts, buildings);
  for (const auto& entry : areas) {
    const MapFeature& f = features[entry.second];
    Box2 box;
    for (const Ring& r : f.rings) {
      work(r.size());
      for (const Vec2 p : r) box.include(p);
    }
    if (box.empty()) continue;
    near.within(box.center(), 0.5 * length(box.size()), [&](uint32_t building) {
      const Vec2 p = facts[building].place;
      if (box.contains(p) && hasWithin(f, p)) facts[building].landUse = f.tag("landuse");
    });
  }
}

}  // namespace

std::vector<bool> buildingsBeyond(const std::vector<MapFeature>& features,
                                  const std::vector<BuildingFacts>& facts, const Box2& area) {
  const auto beyond = [&](uint32_t i) {
    const Vec2 p = facts[i].place;
    return p.x < area.min.x || p.y < area.min.y || p.x >= area.max.x || p.y >= area.max.y;
  };
  std::vector<bool> out(features.size(), false);
  for (uint32_t i = 0; i < features.size(); ++i) {
    const bool part = isBuildingPart(features[i]);
    if (!part && !isBuilding(features[i])) continue;
    out[i] = beyond(part && facts[i].owner != BuildingFacts::kNone ? facts[i].owner : i);
  }
  return out;
}

bool isBuilding(const MapFeature& f) {
  return f.kind == MapFeature::Kind::Area && isTrue(f.tag("building"));
}
bool isBuildingPart(const MapFeature& f) {
  return f.kind == MapFeature::Kind::Area && isTrue(f.tag("building:part")) && !isBuilding(f);
}

std::vector<BuildingFacts> buildingFactsOf(const std::vector<MapFeature>& features) {
  std::vector<BuildingFacts> out(features.size());
  std::vector<uint32_t> known;
  for (uint32_t i = 0; i < features.size(); ++i) {
    const MapFeature& f = features[i];
    if (!isBuilding(f) && !isBuildingPart(f)) continue;
    Box2 box;
    for (const Ring& r : f.rings) {
      work(r.size());
      for (const Vec2 p : r) box.include(p);
    }
    out[i].place = box.center();
    out[i].area = areaOf(f);
    out[i].levels = levelsOf(f);
    if (isBuilding(f) && out[i].levels > 0) known.push_back(i);
  }
  const Near near(out, known);
  for (uint32_t i = 0; i < features.size(); ++i) {
    if (isBuilding(features[i]) && out[i].levels == 0) {
      out[i].guessedLevels = guess(features, out, near, i);
    }
  }
  findParts(features, out);
  findLandUse(features, out);
  return out;
}

}  // namespace gable
