// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each point of the cross-section follows the line at its own distance (mitered), and two that
// follow each other span faces with it. Where the ribbon leaves the region, or a part of the line
// is too short for its bend, each part of each span is cut to the region by itself and becomes a
// prism with a slanted top.
#include "geom/region/profile_sweep.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "geom/region/boolean.h"
#include "geom/region/cut_holes.h"
#include "geom/region/hull.h"
#include "math/trig.h"

namespace gable {
namespace {

// Spans of a cross-section that are narrower stand upright.
constexpr double kThin = 1e-9;
// Shares of the width and of the height under which a part, a piece or a height is none.
constexpr double kNear = 1e-3;
constexpr int kArcParts = 8;
// Parts of a line times edges of the region: with more, what has to be cut gets a plain
// cross-section.
constexpr double kMostWork = 2e6;

Profile arc(double from, double top) {
  Profile p;
  for (int k = 0; k <= kArcParts; ++k) {
    const double a = 180.0 - 180.0 * k / kArcParts;
    p.push_back({0.5 + 0.5 * cosDeg(a), from + (top - from) * sinDeg(a)});
  }
  p.front().x = 0;
  p.back().x = 1;
  return p;
}

// Down to the plane on both sides.
Profile grounded(const Profile& profile) {
  Profile out = profile;
  if (out.front().y > 0) out.insert(out.begin(), Vec2{out.front().x, 0});
  if (out.back().y > 0) out.push_back({out.back().x, 0});
  return out;
}

// The line with its inner side to the left, longer by half the width where ends are square.
Polyline prepared(const Polygon& region, Polyline line, double width, RibbonEnds ends) {
  std::vector<Vec2>& p = line.points;
  const double least = kNear * width;
  const Vec2 end = p.back();
  const auto near = [&](Vec2 a, Vec2 b) { return !(length(b - a) > least); };
  p.erase(std::unique(p.begin(), p.end(), near), p.end());
  // The end of an open line stays where it is.
  if (!line.closed && p.size() > 1) p.back() = end;
  if (line.closed && p.size() > 1 && near(p.front(), p.back())) p.pop_back();
  if (p.size() < 2) return line;
  const Vec2 middle = (p[0] + p[1]) * 0.5, left = perpendicular(normalized(p[1] - p[0]));
  const double reach = width / 2;
  if (signedDistance(region, middle + left * reach) <
      signedDistance(region, middle - left * reach) - 1e-9 * width) {
    std::reverse(p.begin(), p.end());
  }
  if (ends == RibbonEnds::Butt || line.closed) return line;
  const size_t last = p.size() - 1;
  const Vec2 back = normalized(p[0] - p[1]), ahead = normalized(p[last] - p[last - 1]);
  p[0] = p[0] + back * reach;
  p[last] = p[last] + ahead * reach;
  return line;
}

// By point of the cross-section: the line that it follows.
std::vector<Polyline> followed(const Polyline& line, const Profile& profile, double width) {
  std::vector<Polyline> out;
  for (const Vec2 q : profile) out.push_back(movedLeft(line, (q.x - 0.5) * width));
  return out;
}

size_t partsOf(const Polyline& line) {
  return line.closed ? line.points.size() : line.points.size() - 1;
}

// No part turns round when it moves to a side.
bool folds(const Polyline& line, const std::vector<Polyline>& sides, double width) {
  const size_t n = line.points.size();
  for (const Polyline& side : sides) {
    work();
    for (size_t k = 0; k < partsOf(line); ++k) {
      const Vec2 d = normalized(line.points[(k + 1) % n] - line.points[k]);
      if (!(dot(side.points[(k + 1) % n] - side.points[k], d) > kNear * width)) return true;
    }
  }
  return false;
}

bool liesWithin(const Polygon& region, const std::vector<Polyline>& sides, bool closed) {
  std::vector<Ring> rings{sides.front().points, sides.back().points};
  if (!closed) {
    rings[0].insert(rings[0].end(), rings[1].rbegin(), rings[1].rend());
    rings.pop_back();
  }
  const Region plan = repaired(rings, FillRule::EvenOdd);
  return area(subtract(plan, {region})) <= 1e-6 * area(plan);
}

// One shell of mitered corners.
Mesh shell(const std::vector<Polyline>& sides, const Profile& profile, double height, bool closed) {
  MeshBuilder b;
  const size_t n = sides[0].points.size(), m = profile.size();
  const size_t parts = closed ? n : n - 1;
  std::vector<uint32_t> at(n * m);
  for (size_t k = 0; k < n; ++k) {
    for (size_t j = 0; j < m; ++j) {
      work();
      const Vec2 p = sides[j].points[k];
      at[k * m + j] = b.addPosition({p.x, p.y, profile[j].y * height});
    }
  }
  const auto corner = [&](size_t k, size_t j) { return at[(k % n) * m + j]; };
  for (size_t k = 0; k < parts; ++k) {
    for (size_t j = 0; j + 1 < m; ++j) {
      work();
      const uint32_t f[] = {corner(k, j), corner(k + 1, j), corner(k + 1, j + 1), corner(k, j + 1)};
      b.addPolygon(f);
    }
    const uint32_t under[] = {corner(k, m - 1), corner(k + 1, m - 1), corner(k + 1, 0),
                              corner(k, 0)};
    b.addPolygon(under);
  }
  if (closed) return b.take();
  std::vector<uint32_t> begin, end;
  for (size_t j = 0; j < m; ++j) {
    begin.push_back(corner(0, j));
    end.push_back(corner(n - 1, m - 1 - j));
  }
  b.addPolygon(begin);
  b.addPolygon(end);
  return b.take();
}

// What lies between a ring of the plan and a slanted top, closed.
void addPrism(MeshBuilder& b, const Ring& r, double least, const auto& heightAt) {
  std::vector<uint32_t> top, foot;
  for (const Vec2 v : r) {
    const double h = heightAt(v);
    foot.push_back(b.addPosition({v.x, v.y, 0}));
    top.push_back(h > least ? b.addPosition({v.x, v.y, h}) : foot.back());
  }
  for (size_t i = 0; i < r.size(); ++i) {
    const size_t k = (i + 1) % r.size();
    std::vector<uint32_t> side{foot[i], foot[k]};
    if (top[k] != foot[k]) side.push_back(top[k]);
    if (top[i] != foot[i]) side.push_back(top[i]);
    if (side.size() > 2) b.addPolygon(side);
  }
  b.addPolygon(top);
  std::reverse(foot.begin(), foot.end());
  b.addPolygon(foot);
}

// Each part of each span by itself: what the region and the parts before leave of it.
Mesh prisms(const Polygon& region, const Polyline& line, const std::vector<Polyline>& sides,
            const Profile& profile, double width, double height) {
  MeshBuilder b;
  const size_t n = line.points.size();
  Region before;
  for (size_t k = 0; k < partsOf(line); ++k) {
    work();
    const Vec2 from = line.points[k], d = normalized(line.points[(k + 1) % n] - from);
    const auto quad = [&](size_t low, size_t high) {
      return Ring{sides[low].points[k], sides[low].points[(k + 1) % n],
                  sides[high].points[(k + 1) % n], sides[high].points[k]};
    };
    const Region whole = repaired({quad(0, sides.size() - 1)}, FillRule::NonZero);
    Region near;
    for (const Polygon& part : whole) {
      for (const Polygon& p : before) {
        work();
        if (bounds(p).overlaps(bounds(part))) near.push_back(p);
      }
    }
    const Region free = subtract(intersect(whole, {region}), near);
    before.insert(before.end(), whole.begin(), whole.end());
    for (size_t j = 0; j + 1 < profile.size() && !free.empty(); ++j) {
      const Vec2 low = profile[j], high = profile[j + 1];
      if (!(high.x - low.x > kThin) || !(std::max(low.y, high.y) > 0)) continue;
      const auto heightAt = [&](Vec2 v) {
        const double x = cross(d, v - from) / width + 0.5;
        const double t = std::clamp((x - low.x) / (high.x - low.x), 0.0, 1.0);
        return (low.y + (high.y - low.y) * t) * height;
      };
      for (const Polygon& p : intersect({{quad(j, j + 1), {}}}, free)) {
        for (const RegionPiece& piece : withoutHoles(p)) {
          if (!(thickness(piece.polygon) > kNear * width)) continue;
          addPrism(b, piece.polygon.outer, kNear * height, heightAt);
        }
      }
    }
  }
  return b.take();
}

// The ribbon drawn up to the height of the cross-section.
Mesh block(const Polygon& region, const Polyline& line, double width, double height,
           RibbonEnds ends) {
  MeshBuilder b;
  for (const RegionPiece& ribbon : ribbons(region, {&line, 1}, width, {false, ends})) {
    for (const RegionPiece& piece : withoutHoles(ribbon.polygon)) {
      addPrism(b, piece.polygon.outer, 0, [&](Vec2) { return height; });
    }
  }
  return b.take();
}

}  // namespace

std::optional<Profile> profileNamed(std::string_view name) {
  if (name == "box") return Profile{{0, 1}, {1, 1}};
  if (name == "batter") return Profile{{0, 0}, {0.15, 1}, {0.85, 1}, {1, 0}};
  if (name == "gable") return Profile{{0, 0.6}, {0.5, 1}, {1, 0.6}};
  if (name == "round") return arc(0, 1);
  if (name == "dome") return arc(0.65, 1);
  if (name == "kerb") return Profile{{0, 1}, {0.7, 1}, {1, 0.6}};
  return std::nullopt;
}

bool isProfile(const Profile& p) {
  if (p.size() < 2 || p.front().x != 0 || p.back().x != 1) return false;
  bool above = false;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!std::isfinite(p[i].y) || p[i].y < 0 || (i > 0 && !(p[i].x >= p[i - 1].x))) return false;
    above = above || p[i].y > 0;
  }
  return above;
}

Mesh sweptProfile(const Polygon& region, const Polyline& given, double width, double height,
                  const Profile& profile, RibbonEnds ends) {
  if (given.points.size() < 2) return {};
  const Polyline line = prepared(region, given, width, ends);
  if (line.points.size() < 2) return {};
  const Profile section = grounded(profile);
  const std::vector<Polyline> sides = followed(line, section, width);
  if (!folds(line, sides, width) && liesWithin(region, sides, line.closed)) {
    return shell(sides, section, height, line.closed);
  }
  if (static_cast<double>(partsOf(line)) * static_cast<double>(edgeCount(region)) > kMostWork) {
    return block(region, given, width, height, ends);
  }
  return prisms(region, line, sides, section, width, height);
}

}  // namespace gable
