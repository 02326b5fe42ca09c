// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Borders get corners every few metres, where both sides of a border agree on them because they
// depend on its ends alone. All corners of the graded ground take its height. Then water takes the
// lowest height of its shore, and draws the shore down to it where that is near; floors take the
// highest ground that has to stay, and draw the rest down to them. What a street lies on is drawn
// nowhere.
#include "city/terrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/work.h"
#include "city/plan_mesh.h"
#include "city/surface.h"

namespace gable {
namespace {

constexpr uint32_t kNothing = GroundPiece::kNothing;
// Metres between corners of the ground, along borders and within pieces; within level ones they
// keep triangles small. Places of more than so many square metres have them farther apart.
constexpr double kBorderStep = 8, kInnerStep = 12, kLevelStep = 48, kUsualArea = 5e7;
// A bank that leads down to water; what is higher is a cliff.
constexpr double kHighestBank = 4;
// How deep a building without a street is let into the hill.
constexpr double kDeepestCut = 2.5;
// What a pitch may be levelled by.
constexpr double kMostLevelled = 6;
// Walls reach below the ground, and below the level of water.
constexpr double kBelow = 0.3, kBelowWater = 1.6;
// What is lower is no wall.
constexpr double kLeastWall = 1e-6;

bool less(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// The corners between the ends of a border, from the lesser end on.
template <class Visit>
void alongBorder(Vec2 a, Vec2 b, double step, Visit&& visit) {
  const bool turned = less(b, a);
  const Vec2 from = turned ? b : a, to = turned ? a : b;
  const auto steps = static_cast<int>(std::clamp(std::ceil(length(to - from) / step), 1.0, 1e5));
  for (int k = 1; k < steps; ++k) {
    work();
    visit(from + (to - from) * (static_cast<double>(turned ? steps - k : k) / steps));
  }
}

bool keepsItsHeight(Surface s) {
  return s == Surface::Carriageway || s == Surface::Junction || s == Surface::Sidewalk ||
         s == Surface::Square || s == Surface::Path || s == Surface::Track;
}
bool isWater(Surface s) { return s == Surface::Water || s == Surface::Sea; }

class Maker {
 public:
  Maker(const HeightField& field, const StreetGrade& grade, const std::vector<MapFeature>& features,
        const std::vector<GroundPiece>& ground)
      : field_(field), grade_(grade), features_(features), ground_(ground) {
    double whole = 0;
    for (const GroundPiece& p : ground_) whole += area(p.polygon);
    wider_ = std::max(1.0, std::sqrt(whole / kUsualArea));
  }

  Terrain make() {
    outline();
    number();
    findWater();
    findPitches();
    findFloors();
    lowerPitches();
    cut();
    Terrain out;
    findWalls(out.walls);
    out.surface = surface();
    return out;
  }

 private:
  // A piece with corners every few metres; by edge, what is beyond.
  struct Outline {
    Polygon polygon;
    std::vector<uint32_t> beyond;
    // By corner: its number among all places.
    std::vector<uint32_t> places;
  };

  template <class Visit>
  static void forRings(const Polygon& p, Visit&& visit) {
    visit(p.outer);
    for (const Ring& h : p.holes) visit(h);
  }

  void outline() {
    outlines_.resize(ground_.size());
    for (size_t i = 0; i < ground_.size(); ++i) {
      Outline& o = outlines_[i];
      size_t edge = 0;
      bool first = true;
      forRings(ground_[i].polygon, [&](const Ring& r) {
        Ring ring;
        for (size_t k = 0; k < r.size(); ++k, ++edge) {
          work();
          const auto put = [&](Vec2 p) {
            ring.push_back(p);
            o.beyond.push_back(ground_[i].beyond[edge]);
          };
          put(r[k]);
          alongBorder(r[k], r[(k + 1) % r.size()], kBorderStep * wider_, put);
        }
        places_.insert(places_.end(), ring.begin(), ring.end());
        if (first) {
          o.polygon.outer = std::move(ring);
        } else {
          o.polygon.holes.push_back(std::move(ring));
        }
        first = false;
      });
    }
  }

  void number() {
    std::sort(places_.begin(), places_.end(), less);
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
    heights_.resize(places_.size());
    stays_.assign(places_.size(), false);
    for (size_t i = 0; i < places_.size(); ++i) heights_[i] = grade_.heightAt(places_[i]);
    for (size_t i = 0; i < outlines_.size(); ++i) {
      Outline& o = outlines_[i];
      const bool keeps = keepsItsHeight(ground_[i].surface);
      forRings(o.polygon, [&](const Ring& r) {
        for (const Vec2 p : r) {
          const auto at = std::lower_bound(places_.begin(), places_.end(), p, less);
          o.places.push_back(static_cast<uint32_t>(at - places_.begin()));
          if (keeps) stays_[o.places.back()] = true;
        }
      });
    }
    levels_.assign(ground_.size(), std::numeric_limits<double>::quiet_NaN());
  }
  bool isLevel(uint32_t piece) const { return std::isfinite(levels_[piece]); }

  // The lowest tenth of what the heights say of the sea: near the coast some are the land's.
  double seaLevel() const {
    std::vector<double> heights;
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Sea) continue;
      for (const uint32_t p : outlines_[i].places) heights.push_back(field_.at(places_[p]));
    }
    if (heights.empty()) return 0;
    const auto at = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10);
    std::nth_element(heights.begin(), at, heights.end());
    return *at;
  }

  // Streams and rivers that the map draws as lines run down with the ground.
  bool isStill(size_t piece) const {
    const uint32_t f = ground_[piece].feature;
    return ground_[piece].surface == Surface::Water &&
           (f == kNothing || features_[f].kind == MapFeature::Kind::Area);
  }

  void findWater() {
    const double sea = seaLevel();
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface == Surface::Sea) levels_[i] = sea;
      if (!isStill(i)) continue;
      double lowest = std::numeric_limits<double>::infinity();
      for (const uint32_t p : outlines_[i].places) lowest = std::min(lowest, heights_[p]);
      const auto& beyond = ground_[i].beyond;
      const bool atSea = std::any_of(beyond.begin(), beyond.end(), [&](uint32_t b) {
        return b != kNothing && ground_[b].surface == Surface::Sea;
      });
      levels_[i] = atSea ? sea : lowest;
    }
    shore_.assign(places_.size(), -std::numeric_limits<double>::infinity());
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (!isWater(ground_[i].surface) || !isLevel(static_cast<uint32_t>(i))) continue;
      for (const uint32_t p : outlines_[i].places) shore_[p] = std::max(shore_[p], levels_[i]);
    }
    std::vector<bool> isPier(places_.size(), false);
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Pier) continue;
      for (const uint32_t p : outlines_[i].places) isPier[p] = true;
    }
    for (size_t p = 0; p < places_.size(); ++p) {
      if (!std::isfinite(shore_[p])) continue;
      // Whatever the heights say of a pier: it stands in the water.
      const double above = isPier[p] ? 0 : heights_[p] - shore_[p];
      const double left = stays_[p] ? above : above - kHighestBank;
      heights_[p] = shore_[p] + std::max(0.0, left);
    }
  }

  void findPitches() {
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Pitch) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
      for (const uint32_t p : outlines_[i].places) {
        low = std::min(low, heights_[p]);
        high = std::max(high, heights_[p]);
        sum += heights_[p];
      }
      const double count = static_cast<double>(outlines_[i].places.size());
      if (high - low <= kMostLevelled && count > 0) levels_[i] = sum / count;
    }
  }

  // One for all pieces of a building.
  void findFloors() {
    struct Ground {
      double highest = -std::numeric_limits<double>::infinity(), atStreet = highest, sum = 0;
      double count = 0;
    };
    std::map<uint32_t, Ground> grounds;
    const auto keyOf = [&](size_t i) {
      const uint32_t f = ground_[i].feature;
      return f == kNothing ? static_cast<uint32_t>(features_.size() + i) : f;
    };
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Footprint) continue;
      Ground& g = grounds[keyOf(i)];
      for (const uint32_t p : outlines_[i].places) {
        g.highest = std::max(g.highest, heights_[p]);
        g.atStreet = std::max(g.atStreet, stays_[p] ? heights_[p] : shore_[p]);
        g.sum += heights_[p];
        ++g.count;
      }
    }
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Footprint) continue;
      const Ground& g = grounds[keyOf(i)];
      const double free = std::max(g.sum / std::max(g.count, 1.0), g.highest - kDeepestCut);
      levels_[i] = std::max(free, g.atStreet);
    }
  }

  void lowerPitches() {
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Pitch) continue;
      for (const uint32_t b : ground_[i].beyond) {
        const bool building = b != kNothing && ground_[b].surface == Surface::Footprint;
        if (building && isLevel(b)) levels_[i] = std::min(levels_[i], levels_[b]);
      }
    }
  }

  // Beside a building the ground is no higher than its floor.
  void cut() {
    for (size_t i = 0; i < ground_.size(); ++i) {
      if (ground_[i].surface != Surface::Footprint) continue;
      for (const uint32_t p : outlines_[i].places) {
        if (!stays_[p]) heights_[p] = std::max(std::min(heights_[p], levels_[i]), shore_[p]);
      }
    }
  }

  double heightOf(uint32_t piece, uint32_t place) const {
    return isLevel(piece) ? levels_[piece] : heights_[place];
  }

  // From one corner to the next, the piece on the left, where it is higher than what is beyond.
  void addWall(uint32_t piece, uint32_t beyond, uint32_t from, uint32_t to,
               std::vector<std::vector<Vec3>>& out) const {
    const double topA = heightOf(piece, from), topB = heightOf(piece, to);
    const double lowA = heightOf(beyond, from), lowB = heightOf(beyond, to);
    const double a = topA - lowA, b = topB - lowB;
    if (a <= kLeastWall && b <= kLeastWall) return;
    const double below = isWater(ground_[beyond].surface) ? kBelowWater : kBelow;
    const auto at = [&](double t, double z) {
      const Vec2 p = places_[from] + (places_[to] - places_[from]) * t;
      return Vec3{p.x, p.y, z};
    };
    const double t0 = a > 0 ? 0 : a / (a - b), t1 = b > 0 ? 1 : a / (a - b);
    const auto mix = [](double x, double y, double t) { return x + (y - x) * t; };
    out.push_back({at(t0, mix(lowA, lowB, t0) - below), at(t1, mix(lowA, lowB, t1) - below),
                   at(t1, mix(topA, topB, t1)), at(t0, mix(topA, topB, t0))});
  }

  void findWalls(std::vector<TerrainWall>& out) const {
    for (uint32_t i = 0; i < ground_.size(); ++i) {
      const Outline& o = outlines_[i];
      std::map<uint32_t, std::vector<std::vector<Vec3>>> walls;
      size_t first = 0;
      forRings(o.polygon, [&](const Ring& r) {
        for (size_t k = 0; k < r.size(); ++k) {
          work();
          const uint32_t beyond = o.beyond[first + k];
          if (beyond == kNothing || (!isLevel(i) && !isLevel(beyond))) continue;
          std::vector<std::vector<Vec3>> faces;
          addWall(i, beyond, o.places[first + k], o.places[first + (k + 1) % r.size()], faces);
          for (auto& f : faces) walls[beyond].push_back(std::move(f));
        }
        first += r.size();
      });
      for (auto& [beyond, faces] : walls) out.push_back({i, beyond, std::move(faces)});
    }
  }

  std::shared_ptr<const TerrainSurface> surface() const {
    std::vector<Vec3> points;
    std::vector<TerrainSurface::Facet> facets;
    std::vector<TerrainSurface::Piece> pieces;
    for (uint32_t i = 0; i < ground_.size(); ++i) {
      const Outline& o = outlines_[i];
      const PlanMesh mesh = meshOf(o.polygon, (isLevel(i) ? kLevelStep : kInnerStep) * wider_);
      const auto first = static_cast<uint32_t>(points.size());
      for (size_t k = 0; k < mesh.points.size(); ++k) {
        const Vec2 p = mesh.points[k];
        const double z = k < o.places.size() ? heightOf(i, o.places[k])
                         : isLevel(i)        ? levels_[i]
                                             : grade_.heightAt(p);
        points.push_back({p.x, p.y, z});
      }
      pieces.push_back({static_cast<uint32_t>(facets.size()),
                        static_cast<uint32_t>(mesh.triangles.size()), first,
                        static_cast<uint32_t>(o.places.size()), isLevel(i)});
      for (const Triangle& t : mesh.triangles) {
        facets.push_back({{first + t[0], first + t[1], first + t[2]}, i});
      }
    }
    return std::make_shared<TerrainSurface>(std::move(points), std::move(facets),
                                            std::move(pieces));
  }

  const HeightField& field_;
  const StreetGrade& grade_;
  const std::vector<MapFeature>& features_;
  const std::vector<GroundPiece>& ground_;
  // By how much the usual steps are stretched.
  double wider_ = 1;
  std::vector<Outline> outlines_;
  std::vector<Vec2> places_;
  // By place: the graded ground; whether a street lies there; the water's level at a shore.
  std::vector<double> heights_;
  std::vector<bool> stays_;
  std::vector<double> shore_;
  // By piece: not a number where it lies on the graded ground.
  std::vector<double> levels_;
};

}  // namespace

Terrain terrainOf(const HeightField& field, const StreetGrade& grade,
                  const std::vector<MapFeature>& features, const std::vector<GroundPiece>& ground) {
  return Maker(field, grade, features, ground).make();
}

}  // namespace gable
