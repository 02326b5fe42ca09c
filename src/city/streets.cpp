// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ways are taken apart into segments between positions; a segment that several ways have goes to
// the most important one. Segments are joined to stretches again where just two of one profile and
// one direction meet. A junction goes, around its node, from the kerbs of one stretch to those of
// the next: along a curve from where the facing kerbs would cross.
#include "city/streets.h"

#include <algorithm>
#include <cmath>

#include "base/measure.h"
#include "base/work.h"
#include "city/ribbon.h"
#include "geom/curve/curve.h"
#include "math/trig.h"

namespace gable {
namespace {

constexpr uint32_t kNone = 0xffffffff;
// A junction takes at most this share of a stretch.
constexpr double kMostCut = 0.45;
// Of the kerbs at corners, in metres.
constexpr double kCornerRadius = 4;
constexpr double kNarrowest = 2, kWidest = 60;

struct Usual {
  const char* highway;
  int lanes;
  double lane;
  double walk;
};
// The more important first. Lanes of both directions; those of one way streets are half as many.
constexpr Usual kUsual[] = {{"motorway", 4, 3.6, 0},
                            {"trunk", 4, 3.5, 0},
                            {"primary", 2, 3.5, 2.5},
                            {"secondary", 2, 3.4, 2.5},
                            {"tertiary", 2, 3.3, 2.2},
                            {"motorway_link", 1, 4.5, 0},
                            {"trunk_link", 1, 4.5, 0},
                            {"primary_link", 1, 4, 1.5},
                            {"secondary_link", 1, 4, 1.5},
                            {"tertiary_link", 1, 4, 1.5},
                            {"residential", 2, 3, 2},
                            {"unclassified", 2, 3, 1.5},
                            {"busway", 2, 3.3, 0},
                            {"living_street", 2, 2.6, 1.2},
                            {"road", 2, 3, 0},
                            {"service", 1, 3.6, 0},
                            {"raceway", 2, 4, 0}};

bool hasWalk(const MapFeature& f, const char* side, bool usual) {
  const std::string_view own = f.tag(std::string("sidewalk:") + side);
  const std::string_view both = own.empty() ? f.tag("sidewalk:both") : own;
  if (!both.empty()) return both != "no" && both != "none";
  const std::string_view all = f.tag("sidewalk");
  if (all.empty()) return usual;
  return all == "both" || all == "yes" || all == "separate" || all == side;
}

struct Segment {
  uint32_t from, to, feature;
};

// Segments of the streets between numbered positions.
class Network {
 public:
  explicit Network(const std::vector<MapFeature>& features) : profiles_(features.size()) {
    for (uint32_t i = 0; i < features.size(); ++i) {
      profiles_[i] = streetProfileOf(features[i]);
      if (!profiles_[i]) continue;
      points_.insert(points_.end(), features[i].points.begin(), features[i].points.end());
    }
    const auto less = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(points_.begin(), points_.end(), less);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    const auto pointNumber = [&](Vec2 p) {
      const auto at = std::lower_bound(points_.begin(), points_.end(), p, less);
      return static_cast<uint32_t>(at - points_.begin());
    };
    for (uint32_t i = 0; i < features.size(); ++i) {
      if (!profiles_[i]) continue;
      const std::vector<Vec2>& line = features[i].points;
      for (size_t k = 1; k < line.size(); ++k) {
        work();
        segments_.push_back({pointNumber(line[k - 1]), pointNumber(line[k]), i});
      }
    }
    keepTheMostImportant();
  }

  const std::vector<Vec2>& points() const { return points_; }
  const std::vector<Segment>& segments() const { return segments_; }
  const StreetProfile& profile(uint32_t segment) const {
    return *profiles_[segments_[segment].feature];
  }

 private:
  void keepTheMostImportant() {
    std::vector<uint32_t> order(segments_.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto key = [&](uint32_t i) {
      return std::pair(std::min(segments_[i].from, segments_[i].to),
                       std::max(segments_[i].from, segments_[i].to));
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      if (key(a) != key(b)) return key(a) < key(b);
      const int ra = profiles_[segments_[a].feature]->rank,
                rb = profiles_[segments_[b].feature]->rank;
      return ra != rb ? ra > rb : a < b;
    });
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < order.size(); ++i) {
      if (i > 0 && key(order[i]) == key(order[i - 1])) continue;
      if (segments_[order[i]].from != segments_[order[i]].to) kept.push_back(order[i]);
    }
    std::sort(kept.begin(), kept.end());
    std::vector<Segment> out;
    for (const uint32_t i : kept) out.push_back(segments_[i]);
    segments_ = std::move(out);
  }

  std::vector<std::optional<StreetProfile>> profiles_;
  std::vector<Vec2> points_;
  std::vector<Segment> segments_;
};

// What leaves a node: the beginning of a stretch, or its end seen backwards.
struct Leg {
  uint32_t stretch;
  bool begin;
  double length, half;
  Vec2 direction;
  double cut = 0;
};

class Builder {
 public:
  explicit Builder(const std::vector<MapFeature>& features) : network_(features) {
    const auto& segments = network_.segments();
    at_.resize(network_.points().size());
    for (uint32_t s = 0; s < segments.size(); ++s) {
      at_[segments[s].from].push_back(s);
      at_[segments[s].to].push_back(s);
    }
    ends_.resize(at_.size());
    joinSegments();
  }

  Streets build() {
    for (uint32_t n = 0; n < ends_.size(); ++n) {
      if (ends_[n].size() >= 3) addJunction(n);
    }
    for (Stretch& s : out_.stretches) cover(s);
    for (uint32_t n = 0; n < ends_.size(); ++n) {
      if (ends_[n].size() == 2) closeJoint(n);
    }
    return std::move(out_);
  }

 private:
  // The segment that goes on where this one ends, if nothing else meets there.
  uint32_t after(uint32_t segment) const {
    const uint32_t node = network_.segments()[segment].to;
    if (at_[node].size() != 2) return kNone;
    const uint32_t other = at_[node][0] == segment ? at_[node][1] : at_[node][0];
    const bool goesOn = network_.segments()[other].from == node && other != segment &&
                        network_.profile(other) == network_.profile(segment);
    return goesOn ? other : kNone;
  }

  void joinSegments() {
    const auto& segments = network_.segments();
    std::vector<bool> hasBefore(segments.size(), false), used(segments.size(), false);
    for (uint32_t s = 0; s < segments.size(); ++s) {
      if (after(s) != kNone) hasBefore[after(s)] = true;
    }
    // Those with a beginning first, then circles.
    for (const bool circles : {false, true}) {
      for (uint32_t first = 0; first < segments.size(); ++first) {
        if (used[first] || (hasBefore[first] && !circles)) continue;
        Stretch stretch;
        stretch.feature = segments[first].feature;
        stretch.profile = network_.profile(first);
        stretch.line.push_back(network_.points()[segments[first].from]);
        uint32_t last = first;
        for (uint32_t s = first; s != kNone && !used[s]; s = after(s)) {
          work();
          used[s] = true;
          last = s;
          stretch.line.push_back(network_.points()[segments[s].to]);
        }
        const auto number = static_cast<uint32_t>(out_.stretches.size());
        ends_[segments[first].from].push_back({number, true});
        ends_[segments[last].to].push_back({number, false});
        out_.stretches.push_back(std::move(stretch));
      }
    }
  }

  Leg legOf(uint32_t number, bool begin) const {
    const Stretch& s = out_.stretches[number];
    Leg leg{number, begin, lineLength(s.line), s.profile.width / 2, {}, 0};
    // Curves leave in the direction that they have a street's width away.
    const double away = std::min(leg.half * 2, leg.length / 2);
    const Path path(s.line);
    const Vec2 node = begin ? s.line.front() : s.line.back();
    leg.direction = normalized(path.at(begin ? away : leg.length - away).point - node);
    return leg;
  }

  // Where the facing kerbs of two legs cross and the corner is round, as the length along each.
  static bool cutCorner(Leg& a, Leg& b, Vec2 node, Vec2& corner) {
    const double sine = cross(a.direction, b.direction), cosine = dot(a.direction, b.direction);
    double angle = atan2Deg(sine, cosine);
    if (angle < 0) angle += 360;
    if (angle > 155 || angle < 12) return false;
    const double along = (b.half + a.half * cosine) / sine;
    const double rounding =
        std::min({kCornerRadius, a.half * 1.5, b.half * 1.5}) / std::max(tanDeg(angle / 2), 0.3);
    a.cut = std::max(a.cut, along + rounding);
    b.cut = std::max(b.cut, (a.half + b.half * cosine) / sine + rounding);
    corner = node + Vec2{-a.direction.y, a.direction.x} * a.half + a.direction * along;
    return true;
  }

  void addJunction(uint32_t node) {
    const Vec2 at = network_.points()[node];
    std::vector<Leg> legs;
    for (const End& e : ends_[node]) legs.push_back(legOf(e.stretch, e.begin));
    std::sort(legs.begin(), legs.end(), [](const Leg& a, const Leg& b) {
      const auto key = [](const Leg& l) { return atan2Deg(l.direction.y, l.direction.x); };
      return key(a) != key(b) ? key(a) < key(b) : a.stretch < b.stretch;
    });
    std::vector<Vec2> corners(legs.size());
    std::vector<bool> isRound(legs.size());
    for (size_t i = 0; i < legs.size(); ++i) {
      isRound[i] = cutCorner(legs[i], legs[(i + 1) % legs.size()], at, corners[i]);
    }
    StreetJunction junction{at, {}, {}};
    double widest = 0;
    for (Leg& leg : legs) {
      leg.cut =
          std::clamp(leg.cut, std::min(leg.half, leg.length * kMostCut), leg.length * kMostCut);
      widest = std::max(widest, leg.half);
      Stretch& s = out_.stretches[leg.stretch];
      (leg.begin ? s.cutBegin : s.cutEnd) = leg.cut;
      junction.stretches.push_back(leg.stretch);
    }
    Ring outline;
    for (size_t i = 0; i < legs.size(); ++i) {
      const auto [point, direction] = mouth(legs[i]);
      const auto [facing, onward] = mouth(legs[(i + 1) % legs.size()]);
      const Leg& next = legs[(i + 1) % legs.size()];
      const Vec2 side{-direction.y, direction.x}, nextSide{-onward.y, onward.x};
      outline.push_back(point - side * legs[i].half);
      const Vec2 p = point + side * legs[i].half, q = facing - nextSide * next.half;
      outline.push_back(p);
      for (int k = 1; isRound[i] && k < 5; ++k) {
        const double t = k / 5.0;
        outline.push_back(p * ((1 - t) * (1 - t)) + corners[i] * (2 * t * (1 - t)) + q * (t * t));
      }
    }
    if (signedArea(outline) < 0) std::reverse(outline.begin(), outline.end());
    junction.outline.push_back(std::move(outline));
    junction.outline.push_back(discAround(at, widest));
    // What a curve leaves beside the straight way from its mouth.
    for (const Leg& leg : legs) {
      const Stretch& s = out_.stretches[leg.stretch];
      const double from = leg.begin ? 0 : leg.length - leg.cut;
      junction.outline.push_back(
          ribbonAlong(linePart(s.line, from, from + leg.cut), leg.half, leg.half));
    }
    out_.junctions.push_back(std::move(junction));
  }

  struct Mouth {
    Vec2 point, direction;
  };
  // Where a leg leaves its junction, and which way.
  Mouth mouth(const Leg& leg) const {
    const Path path(out_.stretches[leg.stretch].line);
    const Path::Place place = path.at(leg.begin ? leg.cut : leg.length - leg.cut);
    return {place.point, leg.begin ? place.tangent : place.tangent * -1.0};
  }

  static void cover(Stretch& s) {
    const double half = s.profile.width / 2, whole = lineLength(s.line);
    s.carriageway.push_back(
        ribbonAlong(linePart(s.line, s.cutBegin, whole - s.cutEnd), half, half));
    if (s.profile.leftWalk > 0 || s.profile.rightWalk > 0) {
      s.sidewalk.push_back(
          ribbonAlong(s.line, half + s.profile.leftWalk, half + s.profile.rightWalk));
    }
  }

  // Two stretches with nothing between them at the outer side of a bend.
  void closeJoint(uint32_t node) {
    const Vec2 at = network_.points()[node];
    Stretch &a = out_.stretches[ends_[node][0].stretch],
            &b = out_.stretches[ends_[node][1].stretch];
    const double half = std::min(a.profile.width, b.profile.width) / 2;
    a.carriageway.push_back(discAround(at, half));
    const double walk = std::min(
        {a.profile.leftWalk, a.profile.rightWalk, b.profile.leftWalk, b.profile.rightWalk});
    if (walk > 0) a.sidewalk.push_back(discAround(at, half + walk));
  }

  struct End {
    uint32_t stretch;
    bool begin;
  };
  Network network_;
  std::vector<std::vector<uint32_t>> at_;
  std::vector<std::vector<End>> ends_;
  Streets out_;
};

}  // namespace

std::optional<StreetProfile> streetProfileOf(const MapFeature& f, bool anywhere) {
  if (f.kind != MapFeature::Kind::Line || (!anywhere && !isOnGround(f))) return std::nullopt;
  const std::string_view highway = f.tag("highway");
  const Usual* usual = std::find_if(std::begin(kUsual), std::end(kUsual),
                                    [&](const Usual& u) { return highway == u.highway; });
  if (usual == std::end(kUsual)) return std::nullopt;
  StreetProfile out;
  out.rank = static_cast<int>(std::end(kUsual) - usual);
  const std::string_view oneway = f.tag("oneway");
  out.oneway = oneway == "yes" || oneway == "1" || oneway == "-1" || highway == "motorway" ||
               f.tag("junction") == "roundabout";
  out.lanes = out.oneway ? std::max(1, usual->lanes / 2) : usual->lanes;
  const double lanes = writtenNumber(f.tag("lanes")).value_or(0);
  if (lanes >= 1 && lanes <= 16) out.lanes = static_cast<int>(lanes);
  // A single lane has room for what stops in it.
  out.width = out.lanes * usual->lane + (out.lanes == 1 && usual->walk > 0 ? 1 : 0);
  const double width = writtenMetres(f.tag("width")).value_or(0);
  if (width >= kNarrowest && width <= kWidest) out.width = width;
  const bool walks = usual->walk > 0 && out.rank > 1;
  const double walk = std::max(usual->walk, 1.5);
  out.leftWalk = hasWalk(f, "left", walks) ? walk : 0;
  out.rightWalk = hasWalk(f, "right", walks) ? walk : 0;
  return out;
}

Streets streetsOf(const std::vector<MapFeature>& features) { return Builder(features).build(); }

}  // namespace gable
