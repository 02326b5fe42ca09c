// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The border of the place is the box around its ground: edges of facets that lie on it, and that no
// other facet has.
#include "city/soil.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work.h"

namespace gable {
namespace {

constexpr double kLeastDepth = 2;
// Of the longer side of a place: as a model on a table has it.
constexpr double kUsualShare = 0.02, kLeastUsual = 4, kMostUsual = 40;

bool isOnBorder(const Box2& box, const Vec3& a, const Vec3& b) {
  return (a.x == b.x && (a.x == box.min.x || a.x == box.max.x)) ||
         (a.y == b.y && (a.y == box.min.y || a.y == box.max.y));
}

}  // namespace

SoilBlock soilBelow(const TerrainSurface& ground, std::optional<double> depth) {
  Box2 box;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : ground.points()) {
    work();
    box.include({p.x, p.y});
    lowest = std::min(lowest, p.z);
  }
  SoilBlock out;
  if (box.empty()) return out;
  const double longer = std::max(box.size().x, box.size().y);
  const double usual = std::clamp(kUsualShare * longer, kLeastUsual, kMostUsual);
  const double base = std::floor(lowest - std::max(depth.value_or(usual), kLeastDepth));
  for (uint32_t i = 0; i < ground.pieces().size(); ++i) {
    const TerrainSurface::Piece& piece = ground.pieces()[i];
    SoilSide side;
    side.piece = i;
    for (uint32_t f = piece.firstFacet; f < piece.firstFacet + piece.facetCount; ++f) {
      work();
      const auto& v = ground.facets()[f].points;
      for (size_t k = 0; k < 3; ++k) {
        const Vec3 &a = ground.points()[v[k]], &b = ground.points()[v[(k + 1) % 3]];
        if (!isOnBorder(box, a, b)) continue;
        side.side.push_back({{a.x, a.y, base},
                             {b.x, b.y, base},
                             {b.x, b.y, b.z - kSoilRim},
                             {a.x, a.y, a.z - kSoilRim}});
        side.rim.push_back(
            {{a.x, a.y, -kSoilRim}, {b.x, b.y, -kSoilRim}, {b.x, b.y, 0}, {a.x, a.y, 0}});
      }
    }
    if (!side.side.empty()) out.sides.push_back(std::move(side));
  }
  out.bottom = {{box.min.x, box.min.y, base},
                {box.min.x, box.max.y, base},
                {box.max.x, box.max.y, base},
                {box.max.x, box.min.y, base}};
  return out;
}

}  // namespace gable
