// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Corners are dropped by the usual cleaning, then those where a neighbour begins or ends are taken
// back. What a wall looks at is found by steps along its normal from its middle.
#include "city/walls.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/measure.h"
#include "base/work.h"
#include "geom/region/clean.h"
#include "math/trig.h"

namespace gable {
namespace {

constexpr uint32_t kNothing = GroundPiece::kNothing;
// Corners nearer to the line of their neighbours say nothing of a building, in metres.
constexpr double kSurveyed = 0.03;
// A shorter rest of a wall beside a neighbour is none of its own.
constexpr double kLeastRest = 0.4;
// Narrower walls have no door.
constexpr double kLeastEntrance = 1.8;
// Nor have those a door that the map places there.
constexpr double kLeastDoor = 1;
// Each metre between a door and the ground counts as so many metres to the street.
constexpr double kClimb = 8;
// Where a wall's view is asked for, in metres from it.
constexpr double kSteps[] = {0.5, 1.5, 3, 5, 8, 12, 17, 23, 30};

struct MarkedRing {
  Ring points;
  std::vector<uint32_t> beyond;
};

bool isParty(uint32_t beyond, const std::vector<GroundPiece>& ground) {
  return beyond != kNothing && ground[beyond].surface == Surface::Footprint;
}

// The neighbour along most of the edges from..to of a ring.
uint32_t mostBeyond(const MarkedRing& ring, size_t from, size_t to) {
  const size_t n = ring.points.size();
  std::vector<std::pair<uint32_t, double>> lengths;
  for (size_t i = from; i != to; i = (i + 1) % n) {
    work();
    const double l = length(ring.points[(i + 1) % n] - ring.points[i]);
    const auto at = std::find_if(lengths.begin(), lengths.end(),
                                 [&](const auto& e) { return e.first == ring.beyond[i]; });
    if (at == lengths.end()) {
      lengths.emplace_back(ring.beyond[i], l);
    } else {
      at->second += l;
    }
  }
  const auto most =
      std::max_element(lengths.begin(), lengths.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == lengths.end() ? kNothing : most->first;
}

MarkedRing cleaned(const MarkedRing& ring, const std::vector<GroundPiece>& ground) {
  Ring kept = ring.points;
  dropDuplicates(kept, kSurveyed);
  dropCollinear(kept, kSurveyed);
  if (kept.size() < 3) return {};
  const size_t n = ring.points.size();
  const auto less = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(kept.begin(), kept.end(), less);
  std::vector<bool> isCorner(n);
  for (size_t i = 0; i < n; ++i) {
    isCorner[i] = std::binary_search(kept.begin(), kept.end(), ring.points[i], less);
  }
  const auto nextCorner = [&](size_t i, size_t step) {
    size_t k = (i + step) % n;
    while (!isCorner[k] && k != i) k = (k + step) % n;
    return ring.points[k];
  };
  for (size_t i = 0; i < n; ++i) {
    work();
    const bool changes =
        isParty(ring.beyond[i], ground) != isParty(ring.beyond[(i + n - 1) % n], ground);
    if (isCorner[i] || !changes) continue;
    const Vec2 p = ring.points[i];
    isCorner[i] =
        length(nextCorner(i, 1) - p) > kLeastRest && length(nextCorner(i, n - 1) - p) > kLeastRest;
  }
  std::vector<size_t> corners;
  for (size_t i = 0; i < n; ++i) {
    if (isCorner[i]) corners.push_back(i);
  }
  MarkedRing out;
  for (size_t k = 0; k < corners.size(); ++k) {
    out.points.push_back(ring.points[corners[k]]);
    out.beyond.push_back(mostBeyond(ring, corners[k], corners[(k + 1) % corners.size()]));
  }
  return out;
}

void beginWithTheLongest(MarkedRing& ring) {
  size_t longest = 0;
  double most = -1;
  for (size_t i = 0; i < ring.points.size(); ++i) {
    const double l = length(ring.points[(i + 1) % ring.points.size()] - ring.points[i]);
    if (l > most + 1e-6) {
      most = l;
      longest = i;
    }
  }
  const auto turned = [&](auto& list) {
    std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(longest), list.end());
  };
  turned(ring.points);
  turned(ring.beyond);
}

BuildingOutline outlineOf(const Polygon& polygon, const std::vector<uint32_t>& beyond,
                          const std::vector<GroundPiece>& ground) {
  std::vector<MarkedRing> rings;
  size_t first = 0;
  const auto take = [&](const Ring& r) {
    rings.push_back({r, {}});
    for (size_t i = 0; i < r.size(); ++i) {
      rings.back().beyond.push_back(first + i < beyond.size() ? beyond[first + i] : kNothing);
    }
    first += r.size();
  };
  take(polygon.outer);
  for (const Ring& h : polygon.holes) take(h);
  std::vector<MarkedRing> clean;
  Polygon result;
  for (size_t i = 0; i < rings.size(); ++i) {
    MarkedRing ring = cleaned(rings[i], ground);
    if (ring.points.size() < 3 && i > 0) continue;
    if (i == 0) {
      result.outer = ring.points;
    } else {
      result.holes.push_back(ring.points);
    }
    clean.push_back(std::move(ring));
  }
  if (result.outer.size() < 3 || !isValid(result)) {
    clean = std::move(rings);
    result.holes = polygon.holes;
  }
  beginWithTheLongest(clean[0]);
  result.outer = clean[0].points;
  BuildingOutline out{std::move(result), {}};
  for (const MarkedRing& r : clean) {
    for (const uint32_t b : r.beyond) out.walls.push_back({b, 0, false});
  }
  return out;
}

bool isStreet(Surface s) {
  return s == Surface::Carriageway || s == Surface::Junction || s == Surface::Sidewalk ||
         s == Surface::Square;
}

// "234.9" or "SW".
std::optional<double> compassDegrees(std::string_view text) {
  constexpr const char* kPoints[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                     "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  for (size_t i = 0; i < std::size(kPoints); ++i) {
    if (text == kPoints[i]) return 22.5 * static_cast<double>(i);
  }
  const auto number = writtenNumber(text);
  return number && std::fabs(*number) <= 720 ? number : std::nullopt;
}

template <class Visit>
void forEachWall(const BuildingOutline& o, Visit&& visit) {
  size_t wall = 0;
  const auto ring = [&](const Ring& r) {
    for (size_t i = 0; i < r.size(); ++i) visit(wall++, r[i], r[(i + 1) % r.size()]);
  };
  ring(o.polygon.outer);
  for (const Ring& h : o.polygon.holes) ring(h);
}

}  // namespace

BuildingOutline outlineOf(const Polygon& polygon) { return outlineOf(polygon, {}, {}); }
BuildingOutline outlineOf(const GroundPiece& piece, const std::vector<GroundPiece>& ground) {
  return outlineOf(piece.polygon, piece.beyond, ground);
}

void findStreets(BuildingOutline& outline, const std::vector<GroundPiece>& ground,
                 GroundIndex& index, const std::function<double(Vec2)>& climb) {
  size_t best = outline.walls.size(), open = best;
  double bestScore = 0, openScore = 0;
  forEachWall(outline, [&](size_t number, Vec2 a, Vec2 b) {
    Wall& wall = outline.walls[number];
    const double l = length(b - a);
    if (isParty(wall.beyond, ground) || l < 0.2) return;
    const Vec2 out = Vec2{b.y - a.y, a.x - b.x} * (1 / l);
    for (const double step : kSteps) {
      work();
      const uint32_t piece = index.pieceAt((a + b) * 0.5 + out * step);
      if (piece == kNothing || ground[piece].surface == Surface::Footprint) break;
      if (!isStreet(ground[piece].surface)) continue;
      wall.street = step;
      break;
    }
    if (l < kLeastEntrance) return;
    // Near a street, on a wall that has room.
    const double above = climb ? climb((a + b) * 0.5 + out * kSteps[0]) : 0;
    const double score = 0.4 * std::min(l, 15.0) - wall.street - kClimb * above;
    if (wall.street > 0 && (best == outline.walls.size() || score > bestScore + 1e-6)) {
      best = number;
      bestScore = score;
    }
    if (wall.street == 0 && (open == outline.walls.size() || l > openScore + 1e-6)) {
      open = number;
      openScore = l;
    }
  });
  if (best == outline.walls.size()) best = open;
  if (best < outline.walls.size()) outline.walls[best].entrance = true;
}

void placeDoors(BuildingOutline& outline, const std::vector<GroundPiece>& ground,
                const std::vector<Vec2>& entrances, const std::vector<Vec2>& shops) {
  // The nearest wall with room for a door that no neighbour stands against.
  const auto nearest = [&](Vec2 p, bool atStreet) {
    size_t best = outline.walls.size();
    double least = 0;
    forEachWall(outline, [&](size_t number, Vec2 a, Vec2 b) {
      work();
      const Wall& wall = outline.walls[number];
      const double l = length(b - a);
      if (l < kLeastDoor || isParty(wall.beyond, ground) || (atStreet && wall.street == 0)) return;
      const double t = std::clamp(dot(p - a, b - a) / (l * l), 0.0, 1.0);
      const double distance = length(p - (a + (b - a) * t));
      if (best < outline.walls.size() && distance >= least - 1e-6) return;
      best = number;
      least = distance;
    });
    return best;
  };
  bool fresh = true;
  for (const Vec2 p : entrances) {
    const size_t wall = nearest(p, false);
    if (wall == outline.walls.size()) break;
    if (fresh) {
      for (Wall& w : outline.walls) w.entrance = false;
    }
    fresh = false;
    outline.walls[wall].entrance = true;
  }
  for (const Vec2 p : shops) {
    size_t wall = nearest(p, true);
    if (wall == outline.walls.size()) wall = nearest(p, false);
    if (wall < outline.walls.size()) ++outline.walls[wall].shops;
  }
}

double attachedShare(const BuildingOutline& outline, const std::vector<GroundPiece>& ground) {
  double all = 0, attached = 0;
  forEachWall(outline, [&](size_t number, Vec2 a, Vec2 b) {
    const double l = length(b - a);
    all += l;
    if (isParty(outline.walls[number].beyond, ground)) attached += l;
  });
  return all > 0 ? attached / all : 0;
}

uint32_t roofEdgeOf(const BuildingOutline& outline, const MapFeature& f, bool attached) {
  const Ring& ring = outline.polygon.outer;
  const auto along = [&](size_t i) { return normalized(ring[(i + 1) % ring.size()] - ring[i]); };
  // The edge that has most of something.
  const auto most = [&](const auto& value) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < ring.size(); ++i) {
      work();
      if (value(i) > value(best) + 1e-6) best = i;
    }
    return best;
  };
  if (const auto degrees = compassDegrees(f.tag("roof:direction"))) {
    const Vec2 way{sinDeg(*degrees), cosDeg(*degrees)};
    return most([&](uint32_t i) { return dot(Vec2{along(i).y, -along(i).x}, way); });
  }
  if (f.tag("roof:orientation") == "across") {
    const Vec2 longest = along(0);
    return most([&](uint32_t i) { return -std::fabs(dot(along(i), longest)); });
  }
  if (attached && f.tag("roof:orientation").empty()) {
    for (uint32_t i = 0; i < ring.size(); ++i) {
      if (outline.walls[i].entrance) return i;
    }
  }
  return 0;
}

}  // namespace gable
