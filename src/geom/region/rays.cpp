// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Without a width the region falls into sectors: the boundary from one hit to the next, and the
// centre. With one, each path is a strip within the halves of the angles to its neighbours, cut to
// the little of the region's outline that is near it, and the regions are what is left.
#include "geom/region/rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "geom/region/ray_cast.h"
#include "geom/region/ray_strips.h"

namespace gable {
namespace {

// Several centres are never joined by paths of no width.
constexpr double kLeastWidth = 0.02;
// Sectors are no thinner, in metres, and no smaller, in square metres.
constexpr double kThinSector = 0.02;

class RayDivision {
 public:
  RayDivision(const Polygon& p, const RayOptions& o) : p_(p), o_(o), cast_(p, o) {}

  RayResult run(std::span<const Vec2> centres, std::span<const RayTarget> targets) {
    RayResult out;
    out.moved = !cast_.takeCentres(centres);
    cast_.cast(targets);
    out.rays = static_cast<uint32_t>(cast_.rays().size());
    out.links = static_cast<uint32_t>(cast_.links().size());
    if (cast_.rays().size() + 2 * cast_.links().size() < 2) {
      out.pieces.push_back(wholePiece(p_));
      return out;
    }
    if (o_.pathWidth > 0 || cast_.centres().size() > 1) {
      withPaths(out.pieces);
    } else {
      sectors(out.pieces);
    }
    return out;
  }

 private:
  // What the figures around the centres take of the region.
  Region allCentres() const {
    Region centres;
    if (o_.centre.shape == PlanShape::None || !(o_.centre.reach() > 0)) return centres;
    for (const Vec2 c : cast_.centres()) {
      const Polygon figure{ringOf(o_.centre, c), {}};
      if (signedDistance(p_, c) > o_.centre.reach() * 1.001) {
        centres.push_back(figure);
        continue;
      }
      for (Polygon& p : intersect({figure}, {p_})) {
        if (contains(p, c)) centres.push_back(std::move(p));
      }
    }
    return centres.size() > 1 ? repaired(ringsOf(centres), FillRule::NonZero) : centres;
  }

  // The region without the centres; they are holes where they keep clear of all else.
  Region besideCentres(const Region& centres) const {
    if (centres.empty()) return {p_};
    if (centres.size() == 1 && centres[0].holes.empty() && cast_.centres().size() == 1 &&
        signedDistance(p_, cast_.centres()[0]) > o_.centre.reach() * 1.001) {
      Polygon out = p_;
      out.holes.push_back(centres[0].outer);
      std::reverse(out.holes.back().begin(), out.holes.back().end());
      return {out};
    }
    return subtract({p_}, centres);
  }

  void withPaths(std::vector<RegionPiece>& out) const {
    const double width = std::max(o_.pathWidth, kLeastWidth);
    const Region centres = allCentres();
    const EdgeOrigin side{kNoEdge, EdgeRole::Path, EdgeOrigin::kNoSide};
    Region taken = centres;
    EdgeSource beside;
    for (const Ring& r : ringsOf(centres)) {
      beside.rings.push_back(r);
      beside.origins.resize(beside.origins.size() + r.size(),
                            {kNoEdge, EdgeRole::Centre, EdgeOrigin::kNoSide});
    }
    std::vector<RegionPiece> paths;
    Region sections;
    for (RayStrips::Section& s : RayStrips(p_, cast_).sections(width, besideCentres(centres))) {
      RegionPiece piece;
      piece.kind = PieceKind::Path;
      piece.ix = static_cast<uint32_t>(paths.size());
      piece.axis = normalized(s.to - s.centre);
      piece.width = length(s.to - s.centre);
      piece.height = width;
      paths.push_back(std::move(piece));
      for (Ring& r : ringsOf(s.polygon)) {
        beside.origins.resize(beside.origins.size() + r.size(), side);
        beside.rings.push_back(std::move(r));
      }
      taken.push_back(s.polygon);
      sections.push_back(std::move(s.polygon));
    }
    const EdgeSource sources[] = {sourceOf(p_)};
    std::vector<std::vector<EdgeOrigin>> edges = originsOf(sections, sources, side);
    for (size_t i = 0; i < paths.size(); ++i) {
      paths[i].polygon = std::move(sections[i]);
      paths[i].edges = std::move(edges[i]);
    }
    uint32_t index = 0;
    for (RegionPiece& piece : leftBeside(wholePiece(p_), taken, beside)) {
      piece.ix = index++;
      piece.part = 0;
      out.push_back(std::move(piece));
    }
    out.insert(out.end(), paths.begin(), paths.end());
    // A sector too thin to be one belongs to the path beside it.
    mergeSlivers(out, std::min(kThinSector, o_.pathWidth / 50),
                 std::min(kThinSector, area(p_) / 1e4));
    addCentres(centres, out);
  }

  void addCentres(const Region& centres, std::vector<RegionPiece>& out) const {
    uint32_t index = 0;
    for (const Polygon& c : centres) {
      RegionPiece piece;
      piece.kind = PieceKind::Junction;
      piece.ix = index++;
      const EdgeSource sources[] = {sourceOf(p_)};
      piece.edges = originsOf(c, sources);
      piece.polygon = c;
      out.push_back(std::move(piece));
    }
  }

  void sectors(std::vector<RegionPiece>& out) const {
    std::vector<Ray> rays = cast_.rays();
    // A ray that ends at a hole divides nothing.
    const size_t outer = p_.outer.size();
    std::erase_if(rays, [&](const Ray& r) { return r.edge >= outer; });
    std::stable_sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.at < b.at;
    });
    if (rays.size() < 2) {
      out.push_back(wholePiece(p_));
      return;
    }
    const Vec2 c = cast_.centres()[0];
    std::vector<bool> given(p_.holes.size(), false);
    for (size_t i = 0; i < rays.size(); ++i) {
      const Ray& a = rays[i];
      const Ray& b = rays[(i + 1) % rays.size()];
      RegionPiece piece = sector(c, a, b);
      piece.ix = static_cast<uint32_t>(i);
      addHoles(piece, given);
      out.push_back(std::move(piece));
    }
    if (o_.centre.shape == PlanShape::None || !(o_.centre.reach() > 0)) return;
    Region centre;
    for (Polygon& p : intersect({{ringOf(o_.centre, c), {}}}, {p_})) {
      if (contains(p, c)) centre.push_back(std::move(p));
    }
    std::vector<RegionPiece> cut;
    for (const RegionPiece& s : out) {
      for (RegionPiece& p : combineTraced(BooleanOp::Difference, s, centre,
                                          {kNoEdge, EdgeRole::Centre, EdgeOrigin::kNoSide})) {
        cut.push_back(std::move(p));
      }
    }
    out = std::move(cut);
    addCentres(centre, out);
  }

  // The centre, a's hit, the boundary, b's hit.
  RegionPiece sector(Vec2 c, const Ray& a, const Ray& b) const {
    RegionPiece piece;
    const auto add = [&](Vec2 at, EdgeOrigin origin) {
      if (!piece.polygon.outer.empty() && piece.polygon.outer.back() == at) {
        piece.edges.back() = origin;
        return;
      }
      piece.polygon.outer.push_back(at);
      piece.edges.push_back(origin);
    };
    const EdgeOrigin cut{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
    const auto kept = [](uint32_t e) { return EdgeOrigin{e, EdgeRole::Kept, EdgeOrigin::kNoSide}; };
    const auto n = static_cast<uint32_t>(p_.outer.size());
    add(c, cut);
    add(a.to, kept(a.edge));
    const bool sameEdge = a.edge == b.edge && b.at > a.at;
    for (uint32_t e = a.edge, k = 0; !sameEdge && k < n; ++k) {
      e = (e + 1) % n;
      add(p_.outer[e], kept(e));
      if (e == b.edge) break;
    }
    add(b.to, cut);
    return piece;
  }

  void addHoles(RegionPiece& piece, std::vector<bool>& given) const {
    const Ring outer = piece.polygon.outer;
    auto first = static_cast<uint32_t>(p_.outer.size());
    for (size_t h = 0; h < p_.holes.size(); ++h) {
      const auto n = static_cast<uint32_t>(p_.holes[h].size());
      const bool in = !given[h] && std::any_of(p_.holes[h].begin(), p_.holes[h].end(), [&](Vec2 v) {
        return locate(outer, v) == Where::Inside;
      });
      if (in) {
        given[h] = true;
        piece.polygon.holes.push_back(p_.holes[h]);
        for (uint32_t i = 0; i < n; ++i) {
          piece.edges.push_back({first + i, EdgeRole::Kept, EdgeOrigin::kNoSide});
        }
      }
      first += n;
    }
  }

  const Polygon& p_;
  const RayOptions& o_;
  RayCaster cast_;
};

}  // namespace

RayResult castRays(const Polygon& p, std::span<const Vec2> centres,
                   std::span<const RayTarget> targets, const RayOptions& options) {
  return RayDivision(p, options).run(centres, targets);
}

}  // namespace gable
