// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Overhangs below zero: slopes keep their planes and lose the strip along their edge. Each slope is
// cut in plan with the cut of all faces (region/cut.h). A new vertex belongs to the edge and the
// line that cross, so that slopes go on sharing their vertices.
#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/work.h"
#include "geom/region/cut.h"
#include "geom/skeleton/roof_pieces.h"

namespace gable::skeleton {

namespace {

using HalfEdge = std::pair<uint32_t, uint32_t>;

class Cutter : public cut::Host {
 public:
  Cutter(std::vector<SkeletonVertex>& vertices, double tolerance)
      : vertices_(vertices), tolerance_(tolerance) {}

  /// Keeps what is above the height; `inwards` points up the slope in plan.
  void cutAtHeight(std::vector<RoofFace>& parts, double height, Vec2 inwards) {
    byHeight_ = true;
    cutAt(parts, 0, height, {}, inwards);
  }
  /// Keeps what is at least `distance` inwards of the line through `origin`.
  void cutAtLine(std::vector<RoofFace>& parts, uint32_t line, double distance, Vec2 origin,
                 Vec2 inwards) {
    byHeight_ = false;
    cutAt(parts, line + 1, distance, origin, inwards);
  }

  int side(const cut::Corner& c) const override {
    const double v = valueAt(c.point) - level_;
    return v > tolerance_ ? 1 : v < -tolerance_ ? -1 : 0;
  }
  Vec2 place(const cut::Corner& c) const override {
    const Vec2 p = vertices_[c.point].xy - origin_;
    return {-dot(p, perpendicular(inwards_)), dot(p, inwards_)};
  }
  cut::Corner split(const cut::Corner& from, const cut::Corner& to) override {
    const auto [a, b] = std::minmax(from.point, to.point);
    const auto [known, isNew] = fresh_.try_emplace({cut_, a, b}, vertices_.size());
    if (isNew) {
      const double va = valueAt(a), share = (level_ - va) / (valueAt(b) - va);
      const SkeletonVertex p = vertices_[a], q = vertices_[b];
      vertices_.push_back({p.xy + (q.xy - p.xy) * share,
                           byHeight_ ? level_ : p.height + (q.height - p.height) * share});
    }
    return {known->second, 0, from.edge};
  }

 private:
  double valueAt(uint32_t v) const {
    return byHeight_ ? vertices_[v].height : dot(vertices_[v].xy - origin_, inwards_);
  }
  void cutAt(std::vector<RoofFace>& parts, uint32_t cut, double level, Vec2 origin, Vec2 inwards) {
    cut_ = cut;
    level_ = level;
    origin_ = origin;
    inwards_ = inwards;
    std::vector<RoofFace> kept;
    for (const RoofFace& f : parts) {
      cut::Face face;
      for (const RoofLoop& l : f.loops) {
        cut::Loop& loop = face.emplace_back();
        for (const uint32_t v : l.vertices) loop.push_back({v, 0, 0});
      }
      std::vector<cut::Face> below, above;
      cut::cutFace(face, *this, 0, below, above);
      for (const cut::Face& part : above) {
        RoofFace& to = kept.emplace_back(RoofFace{f.role, f.ring, f.edge, {}});
        for (const cut::Loop& loop : part) {
          RoofLoop& l = to.loops.emplace_back();
          for (const cut::Corner& c : loop) l.vertices.push_back(c.point);
        }
      }
    }
    parts = std::move(kept);
  }

  std::vector<SkeletonVertex>& vertices_;
  double tolerance_;
  bool byHeight_ = false;
  uint32_t cut_ = 0;
  double level_ = 0;
  Vec2 origin_, inwards_;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> fresh_;
};

bool touches(const RoofFace& f, const std::set<HalfEdge>& edges) {
  for (const RoofLoop& l : f.loops) {
    for (size_t i = 0; i < l.vertices.size(); ++i) {
      work();
      if (edges.count({l.vertices[i], l.vertices[(i + 1) % l.vertices.size()]}) != 0) return true;
    }
  }
  return false;
}

}  // namespace

void RoofPieces::cutBack(Roof& roof, const RoofRetreat& retreat) const {
  if (retreat.eaves <= 0 && retreat.ends.empty()) return;
  const auto inwardsOf = [&](uint32_t e) {
    return normalized(perpendicular(vertices_[endOf(e)].xy - vertices_[startOf(e)].xy));
  };
  // Which slopes stand over an upright edge is asked before the first cut.
  std::vector<std::vector<uint32_t>> endsOf(roof.faces.size());
  for (const Side& s : sides_) {
    const auto end = retreat.ends.find(s.edge);
    if (end == retreat.ends.end()) continue;
    std::set<HalfEdge> back;
    for (size_t i = 0; i < s.loop.size(); ++i) {
      back.insert({s.loop[(i + 1) % s.loop.size()], s.loop[i]});
    }
    for (size_t f = 0; f < roof.faces.size(); ++f) {
      if (touches(roof.faces[f], back)) endsOf[f].push_back(s.edge);
    }
  }
  Cutter cutter(roof.vertices, tolerance_);
  std::vector<RoofFace> slopes;
  for (size_t i = 0; i < roof.faces.size(); ++i) {
    std::vector<RoofFace> parts{std::move(roof.faces[i])};
    const Vec2 inwards = inwardsOf(edgeNumber(parts[0].ring, parts[0].edge));
    if (retreat.eaves > 0) cutter.cutAtHeight(parts, retreat.eaves, inwards);
    for (const uint32_t e : endsOf[i]) {
      cutter.cutAtLine(parts, e, retreat.ends.at(e), vertices_[startOf(e)].xy, inwardsOf(e));
    }
    for (RoofFace& f : parts) slopes.push_back(std::move(f));
  }
  roof.faces = std::move(slopes);
}

}  // namespace gable::skeleton
