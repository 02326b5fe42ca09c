// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines are sampled every few metres. Each sample may be as high as its layer, and no higher than
// another sample and the slope to it: heights are the shortest paths from the ends on the ground
// (Dijkstra), where an end may be as high as the street that goes on from it can come down.
#include "city/bridges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>

#include "base/measure.h"
#include "base/work.h"
#include "city/ribbon.h"
#include "city/surface.h"

namespace gable {
namespace {

// A deck of one layer: room for 4.7 m below a street's.
constexpr double kLayerHeight = 5.6;
constexpr double kMostLayers = 5;
constexpr double kStep = 5;
// From the middle to a rail.
constexpr double kGauge = 0.74;
constexpr double kPierEvery = 18, kLeastPier = 2.5;
// Lower decks are solid.
constexpr double kSolid = 1.5;
// What is lower is no deck.
constexpr double kLeastHeight = 0.02;
// How deep walls and piers stand in terrain.
constexpr double kBuried = 0.5;

struct Kind {
  bool isStreet, isRail;
  double width, thickness, slope;
};

double layerOf(const MapFeature& f) {
  const double layer = writtenNumber(f.tag("layer")).value_or(1);
  return std::clamp(layer == 0 ? 1 : layer, -1.0, kMostLayers);
}

// Nothing for what is no bridge, or is none that is built here.
std::optional<Kind> kindOf(const MapFeature& f) {
  if (f.kind != MapFeature::Kind::Line || !isTrue(f.tag("bridge")) || isTrue(f.tag("tunnel")) ||
      isTrue(f.tag("indoor")) || layerOf(f) < 0) {
    return std::nullopt;
  }
  if (const auto street = streetProfileOf(f, true)) {
    return Kind{true, false, street->width + street->leftWalk + street->rightWalk, 0.9, 0.08};
  }
  const std::string_view rail = f.tag("railway");
  if (rail == "tram") return Kind{false, true, 3.2, 0.8, 0.06};
  const auto line = lineGroundOf(f, true);
  if (!line || line->surface == Surface::Water) return std::nullopt;
  if (line->surface == Surface::Track) return Kind{false, true, line->width + 1, 0.9, 0.035};
  return Kind{false, false, line->width + 0.4, 0.5, f.tag("highway") == "steps" ? 0.6 : 0.5};
}

struct LessPoint {
  bool operator()(Vec2 a, Vec2 b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

class Heights {
 public:
  Heights(const std::vector<MapFeature>& features, const Streets& streets,
          const GroundHeight& ground)
      : features_(features), streets_(streets), ground_(ground) {}

  std::vector<Bridge> build() {
    for (uint32_t i = 0; i < features_.size(); ++i) {
      work();
      if (const auto kind = kindOf(features_[i])) addLine(i, *kind);
    }
    if (lines_.empty()) return {};
    findGround();
    bases_.assign(samples_.size(), 0);
    if (ground_) findBases();
    relax();
    std::vector<Bridge> out;
    for (const Line& l : lines_) {
      out.push_back(
          {l.feature, l.kind.width, l.kind.thickness, l.kind.isStreet, l.kind.isRail, false, {}});
      for (const uint32_t s : l.samples) {
        const Vec2 p = samples_[s].place;
        double height = bases_[s] + samples_[s].height;
        if (ground_) height = std::max(height, ground_(p));
        out.back().line.push_back({p.x, p.y, height});
      }
    }
    addRamps(out);
    return out;
  }

 private:
  struct Sample {
    Vec2 place;
    double height;
  };
  struct Link {
    uint32_t other;
    double rise, length;
  };
  struct Line {
    uint32_t feature;
    Kind kind;
    std::vector<uint32_t> samples;
  };
  // What leads down from an end: a stretch, from its beginning or its end.
  struct Ramp {
    uint32_t end, stretch;
    bool begin;
    double length, slope;
  };

  uint32_t sampleAt(Vec2 p, double height, bool shared) {
    if (shared) {
      const auto [at, isNew] = shared_.emplace(p, static_cast<uint32_t>(samples_.size()));
      if (!isNew) {
        samples_[at->second].height = std::min(samples_[at->second].height, height);
        return at->second;
      }
    }
    samples_.push_back({p, height});
    links_.emplace_back();
    return static_cast<uint32_t>(samples_.size() - 1);
  }

  void addLine(uint32_t feature, const Kind& kind) {
    const std::vector<Vec2>& points = features_[feature].points;
    const double height = kLayerHeight * layerOf(features_[feature]);
    Line line{feature, kind, {}};
    const auto add = [&](Vec2 p, bool shared) {
      const uint32_t s = sampleAt(p, height, shared);
      if (!line.samples.empty()) {
        if (line.samples.back() == s) return;
        const double l = length(p - samples_[line.samples.back()].place);
        const double rise = kind.slope * l;
        links_[line.samples.back()].push_back({s, rise, l});
        links_[s].push_back({line.samples.back(), rise, l});
      }
      line.samples.push_back(s);
    };
    add(points[0], true);
    for (size_t i = 1; i < points.size(); ++i) {
      constexpr double kMostSteps = 10'000;
      const double l = length(points[i] - points[i - 1]);
      const int steps = static_cast<int>(std::clamp(std::ceil(l / kStep), 1.0, kMostSteps));
      for (int k = 1; k < steps; ++k) {
        work();
        add(points[i - 1] + (points[i] - points[i - 1]) * (static_cast<double>(k) / steps), false);
      }
      add(points[i], true);
    }
    if (line.samples.size() < 2) return;
    ++lineEnds_[line.samples.front()];
    ++lineEnds_[line.samples.back()];
    lines_.push_back(std::move(line));
  }

  // Ends of bridges that something on the ground goes on from, or nothing.
  void findGround() {
    std::map<Vec2, uint32_t, LessPoint> onGround;
    for (const MapFeature& f : features_) {
      const bool isWay = f.kind == MapFeature::Kind::Line && isOnGround(f) &&
                         (!f.tag("highway").empty() || !f.tag("railway").empty());
      for (size_t i = 0; isWay && i < f.points.size(); ++i) {
        work();
        if (shared_.count(f.points[i])) ++onGround[f.points[i]];
      }
    }
    std::map<Vec2, std::vector<std::pair<uint32_t, bool>>, LessPoint> stretchEnds;
    for (uint32_t s = 0; s < streets_.stretches.size(); ++s) {
      work();
      const std::vector<Vec2>& line = streets_.stretches[s].line;
      for (const bool begin : {true, false}) {
        const Vec2 p = begin ? line.front() : line.back();
        if (shared_.count(p)) stretchEnds[p].emplace_back(s, begin);
      }
    }
    for (const Line& l : lines_) {
      for (const uint32_t end : {l.samples.front(), l.samples.back()}) {
        const Vec2 p = samples_[end].place;
        const bool loose = lineEnds_[end] == 1 && links_[end].size() == 1;
        if (!loose && !onGround.count(p)) continue;
        double height = 0;
        const auto next = stretchEnds.find(p);
        if (l.kind.isStreet && loose && next != stretchEnds.end() && next->second.size() == 1) {
          const auto [number, begin] = next->second[0];
          const Stretch& s = streets_.stretches[number];
          const double room = lineLength(s.line) - (begin ? s.cutEnd : s.cutBegin) - 1;
          height = std::max(0.0, room * l.kind.slope);
          ramps_.push_back({end, number, begin, room, l.kind.slope});
        }
        samples_[end].height = std::min(samples_[end].height, height);
        ends_.push_back(end);
      }
    }
  }

  // The even fall between the ends on the ground: of the two that are nearest along bridges, each
  // counts the more the nearer it is. A bridge that none belongs to lies on the ground below.
  void findBases() {
    struct Entry {
      double distance;
      uint32_t end, sample;
      bool operator>(const Entry& o) const {
        if (distance != o.distance) return distance > o.distance;
        return end != o.end ? end > o.end : sample > o.sample;
      }
    };
    struct Near {
      uint32_t count = 0;
      std::array<std::pair<uint32_t, double>, 2> ends;
    };
    std::vector<Near> near(samples_.size());
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const uint32_t e : ends_) queue.push({0, e, e});
    while (!queue.empty()) {
      work();
      const Entry at = queue.top();
      queue.pop();
      Near& n = near[at.sample];
      if (n.count == 2 || (n.count == 1 && n.ends[0].first == at.end)) continue;
      n.ends[n.count++] = {at.end, at.distance};
      for (const Link& l : links_[at.sample]) {
        queue.push({at.distance + l.length, at.end, l.other});
      }
    }
    std::vector<bool> isEnd(samples_.size(), false);
    for (const uint32_t e : ends_) isEnd[e] = true;
    for (uint32_t i = 0; i < samples_.size(); ++i) {
      double sum = 0, weights = 0;
      for (uint32_t k = 0; k < near[i].count; ++k) {
        const double w = 1 / std::max(near[i].ends[k].second, 1e-3);
        sum += w * ground_(samples_[near[i].ends[k].first].place);
        weights += w;
      }
      const double below = ground_(samples_[i].place);
      bases_[i] = isEnd[i] || !(weights > 0) ? below : sum / weights;
      // Clear of the ground where that is higher than its ends.
      if (!isEnd[i]) samples_[i].height += std::max(0.0, below - bases_[i]);
    }
  }

  void relax() {
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (uint32_t i = 0; i < samples_.size(); ++i) queue.emplace(samples_[i].height, i);
    while (!queue.empty()) {
      work();
      const auto [height, i] = queue.top();
      queue.pop();
      if (height > samples_[i].height) continue;
      for (const Link& l : links_[i]) {
        if (height + l.rise >= samples_[l.other].height) continue;
        samples_[l.other].height = height + l.rise;
        queue.emplace(samples_[l.other].height, l.other);
      }
    }
  }

  void addRamps(std::vector<Bridge>& out) const {
    for (const Ramp& r : ramps_) {
      const double height = samples_[r.end].height;
      if (height < 0.1) continue;
      const Stretch& s = streets_.stretches[r.stretch];
      const double whole = lineLength(s.line), down = std::min(r.length, height / r.slope);
      std::vector<Vec2> line =
          r.begin ? linePart(s.line, 0, down) : linePart(s.line, whole - down, whole);
      if (!r.begin) std::reverse(line.begin(), line.end());
      Bridge ramp{s.feature, s.profile.width, 0.4, true, false, true, {}};
      double along = 0;
      if (ground_) line = withSteps(line);
      for (size_t i = 0; i < line.size(); ++i) {
        if (i > 0) along += length(line[i] - line[i - 1]);
        const double above = std::max(0.0, height * (1 - along / std::max(down, 1e-6)));
        ramp.line.push_back({line[i].x, line[i].y, above + (ground_ ? ground_(line[i]) : 0)});
      }
      if (ramp.line.size() > 1) out.push_back(std::move(ramp));
    }
  }

  // With points every few metres.
  static std::vector<Vec2> withSteps(const std::vector<Vec2>& line) {
    std::vector<Vec2> out{line[0]};
    for (size_t i = 1; i < line.size(); ++i) {
      const Vec2 d = line[i] - line[i - 1];
      const int steps = static_cast<int>(std::clamp(std::ceil(length(d) / kStep), 1.0, 1e4));
      for (int k = 1; k <= steps; ++k) {
        work();
        out.push_back(k == steps ? line[i] : line[i - 1] + d * (static_cast<double>(k) / steps));
      }
    }
    return out;
  }

  const std::vector<MapFeature>& features_;
  const Streets& streets_;
  const GroundHeight& ground_;
  // Samples that meet the ground; by sample, the height that its own counts from.
  std::vector<uint32_t> ends_;
  std::vector<double> bases_;
  std::vector<Line> lines_;
  std::vector<Sample> samples_;
  std::vector<std::vector<Link>> links_;
  std::map<Vec2, uint32_t, LessPoint> shared_;
  std::map<uint32_t, uint32_t> lineEnds_;
  std::vector<Ramp> ramps_;
};

Vec2 flat(const SpacePoint& p) { return {p.x, p.y}; }

// To the left of each point of a line, a metre away, mitred.
std::vector<Vec2> sidesOf(const std::vector<SpacePoint>& line) {
  std::vector<Vec2> out;
  const auto left = [&](size_t segment) {
    const Vec2 d = normalized(flat(line[segment + 1]) - flat(line[segment]));
    return Vec2{-d.y, d.x};
  };
  for (size_t i = 0; i < line.size(); ++i) {
    const Vec2 a = left(i > 0 ? i - 1 : 0), b = left(std::min(i, line.size() - 2));
    out.push_back((a + b) * (1 / std::max(1 + dot(a, b), 0.5)));
  }
  return out;
}

class Builder {
 public:
  Builder(const Bridge& bridge, const Box2& area, const GroundHeight& height)
      : b_(bridge), area_(area), height_(height) {
    sides_ = sidesOf(b_.line);
    for (const SpacePoint& p : b_.line) above_.push_back(p.z - (height_ ? height_(flat(p)) : 0));
  }

  std::vector<BridgeShape> shapes(const std::vector<GroundPiece>& ground, GroundIndex& index) {
    const double half = b_.width / 2, parapet = b_.isStreet ? 0.3 : 0.12;
    addStrip("BridgeDeck", -half, half);
    addStrip("BridgeParapet", -half, parapet - half);
    addStrip("BridgeParapet", half - parapet, half);
    if (b_.isRail) {
      addStrip("BridgeRail", -kGauge - 0.04, -kGauge + 0.04);
      addStrip("BridgeRail", kGauge - 0.04, kGauge + 0.04);
    }
    addWalls(half);
    if (!b_.isRamp) addPiers(ground, index);
    return std::move(out_);
  }

 private:
  bool inside(size_t i) const {
    for (const double at : {-0.5, 0.5}) {
      if (!area_.contains(flat(b_.line[i]) + sides_[i] * (at * b_.width))) return false;
    }
    return true;
  }
  bool isBuilt(size_t segment) const {
    return inside(segment) && inside(segment + 1) &&
           std::max(above_[segment], above_[segment + 1]) > kLeastHeight;
  }
  // `at` metres to the left of the line.
  SpacePoint beside(size_t i, double at) const {
    const Vec2 p = flat(b_.line[i]) + sides_[i] * at;
    return {p.x, p.y, b_.line[i].z};
  }

  // Where a wall or a pier begins: on terrain, in the ground.
  SpacePoint footOf(Vec2 p) const { return {p.x, p.y, height_ ? height_(p) - kBuried : 0}; }

  void addStrip(const char* rule, double from, double to) {
    BridgeShape shape{rule, {}, 0};
    for (size_t i = 0; i + 1 < b_.line.size(); ++i) {
      work();
      if (!isBuilt(i)) continue;
      const SpacePoint a = beside(i, from), b = beside(i + 1, from), c = beside(i + 1, to),
                       d = beside(i, to);
      // Where the line turns, four corners lie in no plane.
      const bool straight = std::fabs(cross(sides_[i], sides_[i + 1])) < 1e-9;
      if (straight) {
        shape.faces.push_back({a, b, c, d});
      } else {
        shape.faces.push_back({a, b, c});
        shape.faces.push_back({a, c, d});
      }
    }
    if (!shape.faces.empty()) out_.push_back(std::move(shape));
  }

  void addWalls(double half) {
    BridgeShape shape{"BridgeWall", {}, 0};
    for (size_t i = 0; i + 1 < b_.line.size(); ++i) {
      work();
      const double high = std::max(above_[i], above_[i + 1]);
      if (!isBuilt(i) || (!b_.isRamp && high > kSolid)) continue;
      for (const double at : {-half, half}) {
        SpacePoint a = beside(i, at), b = beside(i + 1, at);
        if (at > 0) std::swap(a, b);
        std::vector<SpacePoint> face{footOf(flat(a)), footOf(flat(b))};
        if (b.z - face[1].z > kLeastHeight / 2) face.push_back(b);
        if (a.z - face[0].z > kLeastHeight / 2) face.push_back(a);
        if (face.size() > 2) shape.faces.push_back(std::move(face));
      }
    }
    // Where the ramp meets the bridge, which may be wider.
    if (b_.isRamp && isBuilt(0)) {
      const SpacePoint a = beside(0, half), b = beside(0, -half);
      shape.faces.push_back({footOf(flat(a)), footOf(flat(b)), b, a});
    }
    if (!shape.faces.empty()) out_.push_back(std::move(shape));
  }

  static bool mayStandOn(Surface s) {
    return s != Surface::Carriageway && s != Surface::Junction && s != Surface::Track &&
           s != Surface::Footprint && s != Surface::ParkingLot && s != Surface::Path;
  }

  // As far as possible from each other, beside what passes below.
  void addPiers(const std::vector<GroundPiece>& ground, GroundIndex& index) {
    double since = kPierEvery / 2;
    for (size_t i = 1; i + 1 < b_.line.size(); ++i) {
      work();
      since += length(flat(b_.line[i]) - flat(b_.line[i - 1]));
      if (since < kPierEvery || above_[i] < kLeastPier || !inside(i)) continue;
      const Vec2 across = sides_[i] * (0.3 * b_.width);
      const Vec2 along = normalized(Vec2{sides_[i].y, -sides_[i].x}) * 0.5;
      const Vec2 p = flat(b_.line[i]);
      const Vec2 corners[] = {p - across - along, p - across + along, p + across + along,
                              p + across - along};
      const bool stands = std::all_of(std::begin(corners), std::end(corners), [&](Vec2 c) {
        const uint32_t piece = index.pieceAt(c);
        return piece != GroundPiece::kNothing && mayStandOn(ground[piece].surface);
      });
      if (!stands) continue;
      // Level, on the lowest corner.
      double foot = footOf(p).z;
      for (const Vec2 c : corners) foot = std::min(foot, footOf(c).z);
      BridgeShape pier{"BridgePier", {{}}, b_.line[i].z - b_.thickness - foot};
      for (const Vec2 c : corners) pier.faces[0].push_back({c.x, c.y, foot});
      out_.push_back(std::move(pier));
      since = 0;
    }
  }

  const Bridge& b_;
  const Box2& area_;
  const GroundHeight& height_;
  // By point: the deck above the ground.
  std::vector<double> above_;
  std::vector<Vec2> sides_;
  std::vector<BridgeShape> out_;
};

}  // namespace

std::vector<Bridge> bridgesOf(const std::vector<MapFeature>& features, const Streets& streets,
                              const GroundHeight& ground) {
  return Heights(features, streets, ground).build();
}

std::vector<BridgeShape> shapesOf(const Bridge& bridge, const Box2& area,
                                  const std::vector<GroundPiece>& ground, GroundIndex& index,
                                  const GroundHeight& height) {
  return Builder(bridge, area, height).shapes(ground, index);
}

}  // namespace gable
