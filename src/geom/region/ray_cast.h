// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rays from centres to what they aim at, and links between the centres: the lines of a division by
// rays (region/rays.h), before they have a width.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geom/region/line.h"
#include "geom/region/rays.h"

namespace gable {

struct Ray {
  Vec2 from, to;
  // On the outer ring: the edge and the place on it.
  uint32_t edge = kNoEdge;
  double at = 0;
};

inline bool lessXy(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

class RayCaster {
 public:
  /// Both must outlive it.
  RayCaster(const Polygon& p, const RayOptions& o);

  /// Centres that lie outside are left out, and then the answer is false; without any the middle of
  /// the region is one.
  bool takeCentres(std::span<const Vec2> centres);
  /// A ray for each target that a centre sees, from the nearest; then the links.
  void cast(std::span<const RayTarget> targets);

  const std::vector<Vec2>& centres() const { return centres_; }
  const std::vector<Ray>& rays() const { return rays_; }
  const std::vector<Ray>& links() const { return links_; }
  size_t edgeCount() const { return edges_.size(); }
  /// The first edge that starts at a place, and how many do.
  std::pair<uint32_t, uint32_t> cornerAt(Vec2 place) const;

 private:
  bool firstHit(Vec2 from, Vec2 d, Vec2 except, bool hasExcept, Ray& hit, double& reach) const;
  bool fromOutside(uint32_t edge, Vec2 place) const;
  bool rayTo(Vec2 c, const RayTarget& t, Ray& ray) const;
  void castTo(const RayTarget& t);
  void dropDuplicates();
  bool sees(Vec2 a, Vec2 b) const;
  bool crossesAny(Vec2 a, Vec2 b) const;
  void addLink(size_t i, size_t k);
  void link();
  void linkAround();
  void linkTree();

  const Polygon& p_;
  const RayOptions& o_;
  std::vector<Segment> edges_;
  // By edge: the one before it in its ring, and the one after it.
  std::vector<uint32_t> before_, after_;
  // By edge: on which side of the ray in question it starts.
  mutable std::vector<double> sides_;
  // Edges by the place where they start.
  std::vector<uint32_t> corners_;
  double scale_ = 0;
  std::vector<Vec2> centres_;
  std::vector<Ray> rays_, links_;
};

}  // namespace gable
