// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The strips of ground along rays and links (region/ray_cast.h): each within the halves of the
// angles to its neighbours, cut to the little of the region's outline that is near it.
#pragma once

#include <vector>

#include "geom/region/ray_cast.h"

namespace gable {

class RayStrips {
 public:
  struct Section {
    Vec2 centre, to;
    bool link = false;
    Polygon polygon;
    Box2 box;
  };

  /// All must outlive it.
  RayStrips(const Polygon& p, const RayCaster& cast);

  /// Of `free`, which is the region without what lies around its centres. Links come first, then
  /// rays; what two would share stays with the first.
  std::vector<Section> sections(double width, const Region& free) const;

 private:
  std::vector<size_t> nextRays() const;
  Ring strip(const Ray& r, double width, const Ray* next, const Ray* previous) const;
  bool plainSection(const Ring& strip, const Polygon& free, Polygon& out) const;
  size_t rankOf(Vec2 v, const Ring& strip, const Ring& centre) const;
  Region section(const Ray& r, const Ring& strip, const Region& free) const;

  const Polygon& p_;
  const RayCaster& cast_;
  double scale_;
};

}  // namespace gable
