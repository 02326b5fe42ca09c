// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/ground.h"

#include <algorithm>
#include <cmath>

#include "base/measure.h"
#include "base/work.h"
#include "city/coast.h"
#include "city/grid_point.h"
#include "city/ribbon.h"
#include "geom/region/locator.h"
#include "geom/region/overlay.h"

namespace gable {
namespace {

constexpr uint32_t kNothing = GroundPiece::kNothing;

// Higher levels take the ground from lower ones.
int levelOf(Surface s, bool ofLine) {
  switch (s) {
    case Surface::Lot: return 0;
    case Surface::Sea: return 1;
    case Surface::Water: return 3;
    case Surface::Pier: return 4;
    case Surface::Path: return 5;
    case Surface::Track: return ofLine ? 6 : 2;
    case Surface::Sidewalk: return 7;
    case Surface::Carriageway: return 8;
    case Surface::Junction: return 9;
    case Surface::Footprint: return 10;
    default: break;
  }
  return ofLine ? 5 : 2;
}

struct Candidate {
  int level;
  Surface surface;
  uint32_t feature;
  // Larger ones lie lower.
  double size;
  OverlayLayer layer;
};

double sizeOf(const std::vector<Ring>& rings) {
  double sum = 0;
  for (const Ring& r : rings) sum += std::fabs(signedArea(r));
  return sum;
}

class Candidates {
 public:
  void add(Surface s, uint32_t feature, std::vector<Ring> rings, FillRule fill,
           bool ofLine = false) {
    const double size = sizeOf(rings);
    all_.push_back({levelOf(s, ofLine), s, feature, size, {std::move(rings), fill}});
  }
  std::vector<Candidate> sorted() {
    std::stable_sort(all_.begin(), all_.end(), [](const Candidate& a, const Candidate& b) {
      return a.level != b.level ? a.level < b.level : a.size > b.size;
    });
    return std::move(all_);
  }

 private:
  std::vector<Candidate> all_;
};

void addFeatures(const std::vector<MapFeature>& features, const std::vector<bool>& leftOut,
                 Candidates& out) {
  for (uint32_t i = 0; i < features.size(); ++i) {
    work();
    if (!leftOut.empty() && leftOut[i]) continue;
    const MapFeature& f = features[i];
    if (const auto surface = surfaceOfArea(f)) out.add(*surface, i, f.rings, FillRule::EvenOdd);
    if (const auto line = lineGroundOf(f)) {
      const double half = line->width / 2;
      out.add(line->surface, i, {ribbonAlong(f.points, half, half, half)}, FillRule::Positive,
              true);
    }
  }
}

void addStreets(const Streets& streets, Candidates& out) {
  for (const Stretch& s : streets.stretches) {
    if (!s.sidewalk.empty()) {
      out.add(Surface::Sidewalk, s.feature, s.sidewalk, FillRule::Positive);
    }
    out.add(Surface::Carriageway, s.feature, s.carriageway, FillRule::Positive);
  }
  for (const StreetJunction& j : streets.junctions) {
    out.add(Surface::Junction, kNothing, j.outline, FillRule::NonZero);
  }
}

}  // namespace

std::optional<LineGround> lineGroundOf(const MapFeature& f, bool anywhere) {
  if (f.kind != MapFeature::Kind::Line || (!anywhere && !isOnGround(f))) return std::nullopt;
  struct Usual {
    const char *key, *value;
    Surface surface;
    double width;
  };
  static constexpr Usual kUsual[] = {{"highway", "footway", Surface::Path, 2},
                                     {"highway", "path", Surface::Path, 1.6},
                                     {"highway", "steps", Surface::Path, 2},
                                     {"highway", "cycleway", Surface::Path, 2.2},
                                     {"highway", "bridleway", Surface::Path, 2},
                                     {"highway", "track", Surface::Path, 3},
                                     {"highway", "pedestrian", Surface::Square, 5},
                                     {"highway", "platform", Surface::Square, 3},
                                     {"railway", "platform", Surface::Square, 3},
                                     {"railway", "rail", Surface::Track, 3.6},
                                     {"railway", "narrow_gauge", Surface::Track, 3},
                                     {"railway", "light_rail", Surface::Track, 3.4},
                                     {"waterway", "river", Surface::Water, 10},
                                     {"waterway", "canal", Surface::Water, 8},
                                     {"waterway", "stream", Surface::Water, 2},
                                     {"man_made", "pier", Surface::Pier, 3},
                                     {"man_made", "breakwater", Surface::Pier, 5}};
  constexpr double kNarrowest = 0.5, kWidest = 500;
  for (const Usual& u : kUsual) {
    if (f.tag(u.key) != u.value) continue;
    const double width = writtenMetres(f.tag("width")).value_or(0);
    return LineGround{u.surface, width >= kNarrowest && width <= kWidest ? width : u.width};
  }
  return std::nullopt;
}

std::vector<GroundPiece> groundOf(const std::vector<MapFeature>& features, const Streets& streets,
                                  const Box2& area, const std::vector<bool>& leftOut) {
  const Ring border{area.min, {area.max.x, area.min.y}, area.max, {area.min.x, area.max.y}};
  Candidates candidates;
  candidates.add(Surface::Lot, kNothing, {border}, FillRule::EvenOdd);
  std::vector<std::vector<Vec2>> coast;
  for (const MapFeature& f : features) {
    const bool isCoast = f.kind == MapFeature::Kind::Line && f.tag("natural") == "coastline";
    if (isCoast) coast.push_back(f.points);
  }
  std::vector<Ring> sea = seaOf(coast, area);
  if (!sea.empty()) candidates.add(Surface::Sea, kNothing, std::move(sea), FillRule::EvenOdd);
  addFeatures(features, leftOut, candidates);
  addStreets(streets, candidates);

  std::vector<Candidate> sorted = candidates.sorted();
  std::vector<OverlayLayer> layers;
  for (Candidate& c : sorted) layers.push_back(std::move(c.layer));
  std::vector<GroundPiece> out;
  for (OverlayPiece& p : overlay(layers)) {
    const Candidate& c = sorted[p.layer];
    out.push_back({c.surface, c.feature, std::move(p.polygon), std::move(p.beyond)});
  }
  return out;
}

struct GroundIndex::Cells {
  explicit Cells(const std::vector<GroundPiece>& g)
      : ground(g),
        area(boxOf(g)),
        grid(gridPoint(area.min), gridPoint(area.max), g.size()),
        lists(grid.size(),
              [&](const auto& put) {
                for (uint32_t i = 0; i < g.size(); ++i) {
                  const Box2 b = bounds(g[i].polygon);
                  const GridPoint low = gridPoint(b.min), high = gridPoint(b.max);
                  for (int64_t r = grid.row(low.y); r <= grid.row(high.y); ++r) {
                    for (int64_t c = grid.column(low.x); c <= grid.column(high.x); ++c) {
                      work();
                      put(grid.cell(c, r), i);
                    }
                  }
                }
              }),
        locators(g.size()) {}

  static Box2 boxOf(const std::vector<GroundPiece>& g) {
    Box2 box;
    for (const GroundPiece& p : g) {
      const Box2 b = bounds(p.polygon);
      box.include(b.min);
      box.include(b.max);
    }
    if (box.empty()) box.include({0, 0});
    return box;
  }

  const std::vector<GroundPiece>& ground;
  Box2 area;
  CellGrid grid;
  CellLists lists;
  std::vector<std::unique_ptr<Locator>> locators;
};

GroundIndex::GroundIndex(const std::vector<GroundPiece>& ground)
    : cells_(std::make_unique<Cells>(ground)) {}
GroundIndex::~GroundIndex() = default;

uint32_t GroundIndex::pieceAt(Vec2 p) {
  Cells& c = *cells_;
  if (!c.area.contains(p)) return kNothing;
  const size_t cell = c.grid.cellOf(gridPoint(p));
  for (const uint32_t* i = c.lists.begin(cell); i != c.lists.end(cell); ++i) {
    std::unique_ptr<Locator>& locator = c.locators[*i];
    if (!locator) locator = std::make_unique<Locator>(c.ground[*i].polygon);
    if (locator->at(p) != Where::Outside) return *i;
  }
  return kNothing;
}

}  // namespace gable
