// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces in one plane are one layer. Where two planes cross above one place, the layers are cut
// along the line, so that of two layers one is above the other wherever both are; sorted by that,
// an overlay of the plan gives what is seen of each (geom/region/overlay.h). It shares its edges to
// the bit, which makes the shell close: a wall stands on each edge whose sides differ in height.
#include "io/exporters/city_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/work.h"
#include "geom/region/overlay.h"
#include "io/exporters/city_faces.h"

namespace gable {
namespace {

// Of a unit normal, upwards: less is a wall.
constexpr double kSteepest = 0.1;
// Faces are of one plane within these: metres of height, and metres a metre of slope.
constexpr double kSameHeight = 0.03, kSameSlope = 0.02;
// Heights of roofs that meet are one within this, in metres.
constexpr double kSameLevel = 0.01;
// Layers of less than so many square metres, and those that are nowhere wider than twice this, are
// details.
constexpr double kLeastArea = 1, kLeastWidth = 0.3;
// Gaps between faces of one plane are closed up to twice this.
constexpr double kGap = 0.05;
// Of the overlay.
constexpr double kThin = 0.25;
// The largest are taken.
constexpr size_t kMostPlanes = 200, kMostLayers = 600;

double millimetre(double v) { return std::round(v * 1000) / 1000; }
bool isOneLevel(double between) { return std::fabs(between) < kSameLevel + 1e-6; }

struct Plane {
  double height = 0, slopeX = 0, slopeY = 0;
  double at(Vec2 p) const { return height + slopeX * p.x + slopeY * p.y; }
};

struct Layer {
  Plane plane;
  Region region;
  Box2 box;
};

Box2 boxOf(const Region& region) {
  Box2 box;
  for (const Polygon& p : region) {
    const Box2 own = bounds(p);
    if (own.empty()) continue;
    box.include(own.min);
    box.include(own.max);
  }
  return box;
}

// ---- Planes and layers --------------------------------------------------------------------------

struct FlatFace {
  Plane plane;
  std::vector<Ring> rings;
  Box2 box;
  double area = 0;
};

bool liesIn(const FlatFace& f, const Plane& plane) {
  if (std::fabs(f.plane.slopeX - plane.slopeX) > kSameSlope) return false;
  if (std::fabs(f.plane.slopeY - plane.slopeY) > kSameSlope) return false;
  return std::all_of(f.rings[0].begin(), f.rings[0].end(),
                     [&](Vec2 p) { return std::fabs(f.plane.at(p) - plane.at(p)) <= kSameHeight; });
}

// Seen from above, about `origin`; false for what is no roof.
bool flatten(const TopFace& face, const Vec3& origin, double base, FlatFace& out) {
  const Vec3 normal = ringNormal(face.rings[0]);
  const double size = length(normal);
  if (!(size > 0) || normal.z <= kSteepest * size) return false;
  const Vec3 from = face.rings[0][0] - origin;
  out.plane.slopeX = -normal.x / normal.z;
  out.plane.slopeY = -normal.y / normal.z;
  out.plane.height = from.z - out.plane.slopeX * from.x - out.plane.slopeY * from.y;
  out.area = normal.z / 2;
  double highest = base - origin.z;
  for (const std::vector<Vec3>& ring : face.rings) {
    Ring& flat = out.rings.emplace_back();
    for (const Vec3& p : ring) {
      work();
      flat.push_back({p.x - origin.x, p.y - origin.y});
      out.box.include(flat.back());
      highest = std::max(highest, p.z - origin.z);
    }
  }
  return highest >= base - origin.z + kLeastRoof;
}

// Without details. A layer that is only thin goes, all others keep their outline as it is.
Region withoutDetails(const std::vector<Ring>& rings) {
  Region whole = repaired(rings, FillRule::NonZero);
  if (whole.size() > 1) whole = offset(offset(whole, kGap), -kGap);
  Region out;
  for (const Polygon& p : whole) {
    work();
    const double size = area(p);
    if (size < kLeastArea) continue;
    // The area of a polygon is at most its perimeter by the radius of a circle that fits into it.
    double edges = perimeter(p.outer);
    for (const Ring& hole : p.holes) edges += perimeter(hole);
    if (size > kLeastWidth * edges || !offset({p}, -kLeastWidth).empty()) out.push_back(p);
  }
  return out;
}

std::vector<Layer> layersOf(std::span<const TopFace> faces, const Vec3& origin, double base) {
  std::vector<FlatFace> flat;
  for (const TopFace& f : faces) {
    FlatFace one;
    if (!f.rings.empty() && flatten(f, origin, base, one)) flat.push_back(std::move(one));
  }
  std::stable_sort(flat.begin(), flat.end(),
                   [](const FlatFace& a, const FlatFace& b) { return a.area > b.area; });
  struct Gathered {
    Plane plane;
    std::vector<Ring> rings;
    double area = 0;
  };
  std::vector<Gathered> planes;
  for (FlatFace& f : flat) {
    work(planes.size());
    const auto at = std::find_if(planes.begin(), planes.end(),
                                 [&](const Gathered& g) { return liesIn(f, g.plane); });
    if (at == planes.end() && planes.size() == kMostPlanes) continue;
    Gathered& to = at == planes.end() ? planes.emplace_back(Gathered{f.plane, {}}) : *at;
    to.rings.insert(to.rings.end(), f.rings.begin(), f.rings.end());
    to.area += f.area;
  }
  std::vector<Layer> layers;
  for (const Gathered& g : planes) {
    // Most of a building are sills and ledges, which need no kernel to be told.
    if (g.area < kLeastArea) continue;
    Layer layer{g.plane, withoutDetails(g.rings), {}};
    layer.box = boxOf(layer.region);
    if (!layer.region.empty()) layers.push_back(std::move(layer));
  }
  return layers;
}

// ---- Which layer is above -----------------------------------------------------------------------

// The least and the largest height of a over b where both are; nothing where they do not meet.
std::optional<std::pair<double, double>> heightOver(const Layer& a, const Layer& b) {
  if (!a.box.overlaps(b.box)) return std::nullopt;
  const Region both = intersect(a.region, b.region);
  if (area(both) < kThin * kThin) return std::nullopt;
  double least = 1e300, most = -1e300;
  const auto take = [&](const Ring& r) {
    for (const Vec2 p : r) {
      const double over = a.plane.at(p) - b.plane.at(p);
      least = std::min(least, over);
      most = std::max(most, over);
    }
  };
  for (const Polygon& p : both) take(p.outer);
  return std::pair{least, most};
}

// The half of the plan, as far as the box goes, in which a is above b.
Region halfAbove(const Plane& a, const Plane& b, const Box2& box) {
  const Vec2 slope{a.slopeX - b.slopeX, a.slopeY - b.slopeY};
  const double size = length(slope), far = 4 * (length(box.size()) + 1);
  const Vec2 middle = box.center(), up = slope * (1 / size), along{-up.y, up.x};
  const Vec2 on = middle - up * ((a.at(middle) - b.at(middle)) / size);
  Polygon half{{on - along * far, on + up * far - along * far, on + up * far + along * far,
                on + along * far},
               {}};
  orient(half);
  return {half};
}

// Cuts layers until of any two one is above the other. above[i]: the layers over i.
void cutCrossing(std::vector<Layer>& layers, std::vector<std::vector<uint32_t>>& above) {
  std::vector<std::pair<uint32_t, uint32_t>> over;
  for (uint32_t i = 0; i < layers.size(); ++i) {
    for (uint32_t j = 0; j < i; ++j) {
      work(16);
      const auto d = heightOver(layers[i], layers[j]);
      if (!d) continue;
      const bool crosses = d->first < -kSameHeight && d->second > kSameHeight;
      if (!crosses || layers.size() >= kMostLayers) {
        const bool isOver = d->first + d->second > 0;
        over.emplace_back(isOver ? i : j, isOver ? j : i);
        continue;
      }
      // The part of i above j stays i; the other is a layer of its own, which is looked at later.
      const Region half = halfAbove(layers[i].plane, layers[j].plane, layers[i].box);
      Layer below = layers[i];
      below.region = subtract(below.region, half);
      layers[i].region = intersect(layers[i].region, half);
      for (Layer* l : {&below, &layers[i]}) l->box = boxOf(l->region);
      if (!below.region.empty()) layers.push_back(std::move(below));
      if (!layers[i].region.empty()) over.emplace_back(i, j);
    }
  }
  above.assign(layers.size(), {});
  for (const auto& [upper, lower] : over) above[lower].push_back(upper);
}

// From below to above; among those that do not care the first comes first. Layers that lie on each
// other in a ring, which roofs do not, come by number.
std::vector<uint32_t> sorted(const std::vector<std::vector<uint32_t>>& above) {
  std::vector<uint32_t> below(above.size()), order;
  for (const auto& list : above) {
    for (const uint32_t u : list) ++below[u];
  }
  std::vector<bool> done(above.size());
  while (order.size() < above.size()) {
    uint32_t next = static_cast<uint32_t>(above.size());
    for (uint32_t i = 0; i < above.size(); ++i) {
      work();
      if (done[i]) continue;
      if (next == above.size() || below[i] < below[next]) next = i;
      if (below[i] == 0) break;
    }
    done[next] = true;
    order.push_back(next);
    for (const uint32_t u : above[next]) below[u] -= below[u] > 0 ? 1 : 0;
  }
  return order;
}

// ---- Shells -------------------------------------------------------------------------------------

struct Piece {
  Plane plane;
  std::vector<Ring> rings;
  // By edge through the rings.
  std::vector<uint32_t> beyond;
};

using PlanKey = std::pair<double, double>;
PlanKey keyOf(Vec2 p) { return {p.x, p.y}; }

// Where the border of the pieces touches itself: no wall could stand there, since four would share
// its upright side.
std::vector<Vec2> contactsOf(const std::vector<OverlayPiece>& pieces) {
  std::map<PlanKey, int> begins;
  for (const OverlayPiece& p : pieces) {
    size_t edge = 0;
    const auto count = [&](const Ring& ring) {
      for (const Vec2 at : ring) {
        if (p.beyond[edge++] == OverlayPiece::kNothing) ++begins[keyOf(at)];
      }
    };
    count(p.polygon.outer);
    for (const Ring& hole : p.polygon.holes) count(hole);
  }
  std::vector<Vec2> out;
  for (const auto& [at, count] : begins) {
    if (count > 1) out.push_back({at.first, at.second});
  }
  return out;
}

// The overlay, where what touches itself in points has a neck there, as wide as gaps that are
// closed.
std::vector<OverlayPiece> joinedOverlay(std::vector<OverlayLayer> layers) {
  OverlayOptions options;
  options.thin = kThin;
  std::vector<OverlayPiece> pieces = overlay(layers, options);
  // A neck may touch what is near it.
  constexpr int kMostTurns = 3;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const std::vector<Vec2> contacts = contactsOf(pieces);
    if (contacts.empty()) break;
    work(contacts.size());
    const double r = kGap * (turn + 1);
    for (const Vec2 c : contacts) {
      layers[0].rings.push_back(
          {{c.x - r, c.y - r}, {c.x + r, c.y - r}, {c.x + r, c.y + r}, {c.x - r, c.y + r}});
    }
    pieces = overlay(layers, options);
  }
  return pieces;
}

std::vector<Piece> piecesOf(const std::vector<Layer>& layers, const std::vector<uint32_t>& order) {
  std::vector<OverlayLayer> flat(1);
  flat[0].fill = FillRule::NonZero;
  for (const uint32_t l : order) {
    OverlayLayer& to = flat.emplace_back();
    to.fill = FillRule::NonZero;
    for (const Polygon& p : layers[l].region) {
      to.rings.push_back(p.outer);
      to.rings.insert(to.rings.end(), p.holes.begin(), p.holes.end());
    }
  }
  // The first layer is the area of all others.
  std::vector<Ring> all;
  for (const OverlayLayer& l : flat) all.insert(all.end(), l.rings.begin(), l.rings.end());
  for (const Polygon& p : offset(offset(repaired(all, FillRule::NonZero), kGap), -kGap)) {
    flat[0].rings.push_back(p.outer);
    flat[0].rings.insert(flat[0].rings.end(), p.holes.begin(), p.holes.end());
  }
  const std::vector<OverlayPiece> seen = joinedOverlay(std::move(flat));
  std::vector<Piece> out;
  for (const OverlayPiece& p : seen) {
    Piece& piece = out.emplace_back();
    piece.rings.push_back(p.polygon.outer);
    piece.rings.insert(piece.rings.end(), p.polygon.holes.begin(), p.polygon.holes.end());
    piece.beyond = p.beyond;
    if (p.layer > 0) piece.plane = layers[order[p.layer - 1]].plane;
  }
  // Gaps between layers are as high as a neighbour.
  for (size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].layer > 0) continue;
    for (const uint32_t other : out[i].beyond) {
      if (other != OverlayPiece::kNothing && seen[other].layer > 0) out[i].plane = out[other].plane;
    }
  }
  return out;
}

// Where the roofs on both sides of an edge cross in between, the edge gets a point there; gives
// these points.
std::set<PlanKey> splitCrossedEdges(std::vector<Piece>& pieces) {
  const std::vector<Piece> before = pieces;
  std::set<PlanKey> points;
  for (size_t i = 0; i < pieces.size(); ++i) {
    Piece& to = pieces[i];
    const Piece& from = before[i];
    to.beyond.clear();
    size_t edge = 0;
    for (size_t r = 0; r < from.rings.size(); ++r) {
      const Ring& ring = from.rings[r];
      to.rings[r].clear();
      for (size_t k = 0; k < ring.size(); ++k, ++edge) {
        work();
        const Vec2 p = ring[k], q = ring[(k + 1) % ring.size()];
        const uint32_t other = from.beyond[edge];
        to.rings[r].push_back(p);
        to.beyond.push_back(other);
        if (other == OverlayPiece::kNothing) continue;
        const Plane &a = from.plane, &b = before[other].plane;
        // From the same end on both sides.
        const bool swap = keyOf(q) < keyOf(p);
        const Vec2 s = swap ? q : p, e = swap ? p : q;
        const double atS = millimetre(a.at(s)) - millimetre(b.at(s));
        const double atE = millimetre(a.at(e)) - millimetre(b.at(e));
        if (isOneLevel(atS) || isOneLevel(atE) || (atS > 0) == (atE > 0)) continue;
        const double t = std::fabs(atS) / (std::fabs(atS) + std::fabs(atE));
        const Vec2 m{millimetre(s.x + t * (e.x - s.x)), millimetre(s.y + t * (e.y - s.y))};
        if (m == p || m == q) continue;
        to.rings[r].push_back(m);
        to.beyond.push_back(other);
        points.insert(keyOf(m));
      }
    }
  }
  return points;
}

class ShellMaker {
 public:
  /// `crossings`: where two roofs are as high as each other, whatever their planes say.
  ShellMaker(const std::vector<Piece>& pieces, std::set<PlanKey> crossings, const Vec3& origin,
             double base)
      : pieces_(pieces),
        crossings_(std::move(crossings)),
        origin_(origin),
        base_(millimetre(base - origin.z)) {}

  std::vector<BuildingShell> make() {
    findLevels();
    findComponents();
    std::vector<BuildingShell> out;
    for (uint32_t c = 0; c < componentCount_; ++c) {
      BuildingShell shell = shellOf(c);
      if (shell.area >= kLeastArea) out.push_back(std::move(shell));
    }
    return out;
  }

 private:
  // The heights that roofs have above each point; of those that nearly agree the lowest.
  void findLevels() {
    for (const Piece& piece : pieces_) {
      for (const Ring& ring : piece.rings) {
        for (const Vec2 p : ring) {
          work();
          levels_[keyOf(p)].push_back(raised(piece.plane.at(p)));
        }
      }
    }
    for (auto& [point, heights] : levels_) {
      std::sort(heights.begin(), heights.end());
      std::vector<double> kept{heights[0]};
      const bool isOne = crossings_.count(point) > 0;
      for (size_t i = 1; i < heights.size() && !isOne; ++i) {
        if (!isOneLevel(heights[i] - heights[i - 1])) kept.push_back(heights[i]);
      }
      heights = std::move(kept);
    }
  }
  // A roof that would reach the ground stays above it.
  double raised(double height) const {
    return std::max(millimetre(height), base_ + 2 * kSameLevel);
  }
  double levelOf(uint32_t piece, Vec2 p) const {
    const std::vector<double>& heights = levels_.at(keyOf(p));
    const double h = raised(pieces_[piece].plane.at(p));
    return *std::prev(std::upper_bound(heights.begin(), heights.end(), h));
  }

  void findComponents() {
    component_.assign(pieces_.size(), OverlayPiece::kNothing);
    for (uint32_t i = 0; i < pieces_.size(); ++i) {
      if (component_[i] != OverlayPiece::kNothing) continue;
      std::vector<uint32_t> open{i};
      component_[i] = componentCount_;
      while (!open.empty()) {
        work();
        const uint32_t at = open.back();
        open.pop_back();
        for (const uint32_t other : pieces_[at].beyond) {
          if (other == OverlayPiece::kNothing) continue;
          if (component_[other] != OverlayPiece::kNothing) continue;
          component_[other] = componentCount_;
          open.push_back(other);
        }
      }
      ++componentCount_;
    }
  }

  uint32_t pointAt(Vec2 p, double z) {
    const auto [at, isNew] = points_.try_emplace({p.x, p.y, z}, shell_.points.size());
    if (isNew) shell_.points.push_back(origin_ + Vec3{p.x, p.y, z});
    return at->second;
  }

  BuildingShell shellOf(uint32_t component) {
    shell_ = {};
    points_.clear();
    outline_.clear();
    for (uint32_t i = 0; i < pieces_.size(); ++i) {
      if (component_[i] == component) addPiece(i);
    }
    addGround();
    shell_.closed = isClosed();
    return std::move(shell_);
  }

  void addPiece(uint32_t i) {
    const Piece& piece = pieces_[i];
    ShellFace roof;
    size_t edge = 0;
    for (const Ring& ring : piece.rings) {
      std::vector<uint32_t>& to = roof.rings.emplace_back();
      for (size_t k = 0; k < ring.size(); ++k, ++edge) {
        work();
        const Vec2 p = ring[k], q = ring[(k + 1) % ring.size()];
        to.push_back(pointAt(p, levelOf(i, p)));
        measure(piece.plane, p, q);
        addWall(i, piece.beyond[edge], p, q);
      }
    }
    shell_.faces.push_back(std::move(roof));
  }

  // Area and volume below the edge as seen from the origin, by the triangle with it.
  void measure(const Plane& plane, Vec2 p, Vec2 q) {
    const double twice = cross(p, q);
    shell_.area += twice / 2;
    shell_.volume += twice / 2 * ((plane.at({0, 0}) + plane.at(p) + plane.at(q)) / 3 - base_);
  }

  void addWall(uint32_t i, uint32_t beyond, Vec2 p, Vec2 q) {
    const bool open = beyond == OverlayPiece::kNothing;
    if (open) outline_[keyOf(p)].push_back(q);
    const double topP = levelOf(i, p), topQ = levelOf(i, q);
    const double lowP = open ? base_ : levelOf(beyond, p);
    const double lowQ = open ? base_ : levelOf(beyond, q);
    if (topP < lowP || topQ < lowQ || (topP == lowP && topQ == lowQ)) return;
    ShellFace wall{CityKind::Wall, {{}}};
    std::vector<uint32_t>& ring = wall.rings[0];
    ring.push_back(pointAt(p, lowP));
    addColumn(q, lowQ, topQ, false, ring);
    if (topP > lowP) addColumn(p, lowP, topP, true, ring);
    if (topP > lowP) ring.pop_back();
    shell_.faces.push_back(std::move(wall));
  }

  // The points above a place from one height to the other.
  void addColumn(Vec2 at, double low, double top, bool down, std::vector<uint32_t>& ring) {
    std::vector<double> heights{low};
    for (const double h : levels_.at(keyOf(at))) {
      if (h > low && h < top) heights.push_back(h);
    }
    if (top > low) heights.push_back(top);
    if (down) std::reverse(heights.begin(), heights.end());
    for (const double h : heights) ring.push_back(pointAt(at, h));
  }

  // The outline turned round, at the foot of the walls. Where it touches itself in a point, it goes
  // on to the right as far as it can: what hangs together has one outer ring then, and holes.
  void addGround() {
    std::vector<Ring> rings;
    for (auto& [start, ways] : outline_) {
      while (!ways.empty()) {
        Ring ring;
        Vec2 at{start.first, start.second}, from = at;
        do {
          work();
          ring.push_back(at);
          const Vec2 next = takeWay(outline_[keyOf(at)], from, at);
          from = at;
          at = next;
        } while (!(keyOf(at) == start) && !outline_[keyOf(at)].empty());
        rings.push_back(std::move(ring));
      }
    }
    ShellFace ground{CityKind::Ground, {}};
    std::stable_sort(rings.begin(), rings.end(),
                     [](const Ring& a, const Ring& b) { return signedArea(a) > signedArea(b); });
    for (const Ring& r : rings) {
      std::vector<uint32_t>& to = ground.rings.emplace_back();
      for (size_t k = r.size(); k > 0; --k) to.push_back(pointAt(r[k - 1], base_));
    }
    if (!ground.rings.empty()) shell_.faces.push_back(std::move(ground));
  }

  static Vec2 takeWay(std::vector<Vec2>& ways, Vec2 from, Vec2 at) {
    size_t best = 0;
    // By the angle to the way back, counter-clockwise from it: the least is the rightmost.
    const auto turn = [&](Vec2 to) {
      const Vec2 back = from - at, out = to - at;
      const double s = cross(back, out), c = dot(back, out);
      const double size = std::fabs(s) + std::fabs(c);
      // A number that grows with the angle from 0 to 4.
      const double part = size > 0 ? s / size : 0;
      return c >= 0 ? (s >= 0 ? part : 4 + part) : 2 - part;
    };
    for (size_t i = 1; i < ways.size(); ++i) {
      if (turn(ways[i]) < turn(ways[best])) best = i;
    }
    const Vec2 to = ways[best];
    ways.erase(ways.begin() + static_cast<std::ptrdiff_t>(best));
    return to;
  }

  bool isClosed() const {
    std::vector<std::pair<uint32_t, uint32_t>> edges;
    for (const ShellFace& f : shell_.faces) {
      for (const std::vector<uint32_t>& ring : f.rings) {
        for (size_t k = 0; k < ring.size(); ++k) {
          edges.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    for (size_t e = 0; e < edges.size(); ++e) {
      work();
      const std::pair back{edges[e].second, edges[e].first};
      if (e > 0 && edges[e] == edges[e - 1]) return false;
      if (!std::binary_search(edges.begin(), edges.end(), back)) return false;
    }
    return !edges.empty();
  }

  const std::vector<Piece>& pieces_;
  std::set<PlanKey> crossings_;
  Vec3 origin_;
  double base_;
  std::map<PlanKey, std::vector<double>> levels_;
  std::vector<uint32_t> component_;
  uint32_t componentCount_ = 0;
  // Of the shell at hand. The outline: where its edges lead from each point.
  BuildingShell shell_;
  std::map<std::array<double, 3>, uint32_t> points_;
  std::map<PlanKey, std::vector<Vec2>> outline_;
};

}  // namespace

std::vector<BuildingShell> shellsOf(std::span<const TopFace> faces, double base) {
  // Kernels are exact near the origin.
  Vec3 origin;
  for (const TopFace& f : faces) {
    if (f.rings.empty() || f.rings[0].empty()) continue;
    const Vec3& p = f.rings[0][0];
    origin = {std::floor(p.x), std::floor(p.y), std::floor(base)};
    break;
  }
  std::vector<Layer> layers = layersOf(faces, origin, base);
  std::vector<std::vector<uint32_t>> above;
  cutCrossing(layers, above);
  if (layers.empty()) return {};
  std::vector<Piece> pieces = piecesOf(layers, sorted(above));
  std::set<PlanKey> crossings = splitCrossedEdges(pieces);
  return ShellMaker(pieces, std::move(crossings), origin, base).make();
}

BuildingShell blockOf(const BuildingShell& shell) {
  BuildingShell out;
  out.area = shell.area;
  out.volume = shell.volume;
  out.closed = shell.closed;
  const auto isGround = [](const ShellFace& f) { return f.kind == CityKind::Ground; };
  const auto ground = std::find_if(shell.faces.begin(), shell.faces.end(), isGround);
  if (ground == shell.faces.end() || !(shell.area > 0)) return out;
  const double height = std::max(0.1, millimetre(shell.volume / shell.area));
  ShellFace floor{CityKind::Ground, {}}, roof{CityKind::Roof, {}};
  std::vector<ShellFace> walls;
  std::map<uint32_t, uint32_t> known;
  for (const std::vector<uint32_t>& ring : ground->rings) {
    // Without the points where only roofs met.
    std::vector<uint32_t> kept;
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vec3& p = shell.points[ring[(k + ring.size() - 1) % ring.size()]];
      const Vec3 &at = shell.points[ring[k]], &q = shell.points[ring[(k + 1) % ring.size()]];
      if (length(cross(at - p, q - at)) > 1e-9) kept.push_back(ring[k]);
    }
    if (kept.size() < 3) continue;
    std::vector<uint32_t>& low = floor.rings.emplace_back();
    for (const uint32_t i : kept) {
      const auto [at, isNew] = known.try_emplace(i, static_cast<uint32_t>(out.points.size()));
      if (isNew) {
        out.points.push_back(shell.points[i]);
        out.points.push_back(shell.points[i] + Vec3{0, 0, height});
      }
      low.push_back(at->second);
    }
    std::vector<uint32_t>& high = roof.rings.emplace_back();
    for (size_t k = low.size(); k > 0; --k) high.push_back(low[k - 1] + 1);
    for (size_t k = 0; k < low.size(); ++k) {
      // The floor runs against the outline.
      const uint32_t q = low[k], p = low[(k + 1) % low.size()];
      walls.push_back({CityKind::Wall, {{p, q, q + 1, p + 1}}});
    }
  }
  if (roof.rings.empty()) return out;
  out.faces.push_back(std::move(roof));
  out.faces.insert(out.faces.end(), walls.begin(), walls.end());
  out.faces.push_back(std::move(floor));
  return out;
}

}  // namespace gable
