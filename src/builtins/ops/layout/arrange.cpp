// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Footprints find their places on the faces of a shape: what finds none on the first face tries the
// next. A wish that is not given is drawn on the face.
#include "geom/plan/arrange.h"
#include "base/work.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/ground.h"
#include "geom/region/boolean.h"
#include "geom/region/hull.h"
#include "geom/region/places.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr uint32_t kMostFootprints = 2000;
constexpr double kMostPoints = 100000;
// Parts of the remainder smaller than this share of the ground are rounding.
constexpr double kSliver = 1e-9;
// An edge of the remainder is one of the ground when its middle lies this near to it.
constexpr double kOnEdge = 1e-3;
constexpr uint32_t kDrawTries = 64;

Vec2 drawnIn(const OpCall& call, const Polygon& p, uint64_t k) {
  const Box2 box = bounds(p);
  for (uint32_t attempt = 0; attempt < kDrawTries; ++attempt) {
    const uint64_t address = hashCombine(call.randomAddress(k), attempt);
    const Vec2 at{randomIn(hashCombine(address, 0), box.min.x, box.max.x),
                  randomIn(hashCombine(address, 1), box.min.y, box.max.y)};
    if (contains(p, at)) return at;
  }
  return middleOf(p);
}

// The direction of the nearest edge of the outline, in degrees; the face lies to its left.
double nearestEdge(const Polygon& p, Vec2 at) {
  double best = HUGE_VAL;
  Vec2 along{1, 0};
  const auto look = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      work();
      const Vec2 a = ring[i], d = ring[(i + 1) % ring.size()] - a;
      const double t = dot(d, d) > 0 ? std::clamp(dot(at - a, d) / dot(d, d), 0.0, 1.0) : 0;
      const double distance = length(at - (a + d * t));
      if (distance >= best) continue;
      best = distance;
      along = d;
    }
  };
  look(p.outer);
  for (const Ring& hole : p.holes) look(hole);
  return atan2Deg(along.y, along.x);
}

enum class TurnBy : uint8_t { Scope, Edge, Random };
enum class Order : uint8_t { Largest, Given };
enum class PointPattern : uint8_t { Poisson, Jittered };

}  // namespace

template <>
struct WordsOf<TurnBy> {
  static constexpr const char* text = "scope edge random";
};
template <>
struct WordsOf<Order> {
  static constexpr const char* text = "largest given";
};
template <>
struct WordsOf<PointPattern> {
  static constexpr const char* text = "poisson jittered";
};

namespace {

struct Arrange {
  Floats footprints;
  double gap;
  std::optional<double> edge;
  TurnBy turn;
  Order order;
};

struct ScatterSpaced {
  double distance;
  PointPattern pattern;
  double edge, jitter;
};

// Row by row: width and depth, then perhaps where the middle is to be, then perhaps the turn.
std::vector<Footprint> wanted(const OpCall& call, TurnBy turn, const Array& rows,
                              const Polygon& ground) {
  std::vector<Footprint> out;
  for (uint32_t r = 0; r < rows.rows; ++r) {
    work(4);
    const double* n = rows.numbers.data() + size_t{r} * rows.columns;
    Footprint f{n[0], n[1], {}, 0};
    f.wish = rows.columns >= 4 ? Vec2{n[2], -n[3]} : drawnIn(call, ground, 2 * uint64_t{r});
    if (rows.columns >= 5) {
      f.angle = n[4];
    } else if (turn == TurnBy::Edge) {
      f.angle = nearestEdge(ground, f.wish);
    } else if (turn == TurnBy::Random) {
      f.angle = randomIn(call.randomAddress(2 * uint64_t{r} + 1), 0, 360);
    }
    out.push_back(f);
  }
  return out;
}

// The shortest line around all that was placed on a ground.
void emitHull(OpCall& call, const Ground& ground, const Region& covered, const SelectorItem* item,
              uint32_t piece) {
  std::vector<Vec2> points;
  for (const Polygon& p : covered) points.insert(points.end(), p.outer.begin(), p.outer.end());
  Ring ring = convexHull(points);
  if (item && ring.size() > 2) {
    call.emit(groundPart(call, ground, {std::move(ring), {}}, kNoFront, {}), item->slot, piece);
  }
}

// Which edges of a part of the ground lie on edges of the ground that are a street.
std::vector<bool> streetOf(const Ground& ground, const Polygon& part) {
  std::vector<bool> out;
  if (std::find(ground.street.begin(), ground.street.end(), true) == ground.street.end())
    return out;
  std::vector<std::pair<Vec2, Vec2>> streets;
  size_t edge = 0;
  const auto collect = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i, ++edge) {
      work();
      if (ground.street[edge]) streets.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
    }
  };
  collect(ground.polygon.outer);
  for (const Ring& hole : ground.polygon.holes) collect(hole);
  const auto mark = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      work(streets.size());
      const Vec2 at = (ring[i] + ring[(i + 1) % ring.size()]) * 0.5;
      out.push_back(std::any_of(streets.begin(), streets.end(), [&](const auto& s) {
        const Vec2 d = s.second - s.first;
        const double t = dot(d, d) > 0 ? std::clamp(dot(at - s.first, d) / dot(d, d), 0.0, 1.0) : 0;
        return length(at - (s.first + d * t)) < kOnEdge;
      }));
    }
  };
  mark(part.outer);
  for (const Ring& hole : part.holes) mark(hole);
  return out;
}

Status checked(const OpCall& call, const Array& rows) {
  if (rows.numbers.size() != rows.size() || rows.columns < 2 || rows.rows > kMostFootprints) {
    return call.fail("bad-argument", "footprints are up to 2000 rows of two: width, depth",
                     "such as arrange([12, 9; 6, 5], 2)");
  }
  return {};
}

// Rows of nothing take no place.
void tellLeftOut(OpCall& call, const Array& rows, const std::vector<bool>& done) {
  uint32_t asked = 0, left = 0;
  for (uint32_t r = 0; r < rows.rows; ++r) {
    const double* n = rows.numbers.data() + size_t{r} * rows.columns;
    if (!(n[0] > 0) || !(n[1] > 0)) continue;
    ++asked;
    left += done[r] ? 0 : 1;
  }
  if (left == 0) return;
  call.services().note("no-room",
                       "'arrange': " + std::to_string(left) + " of " + std::to_string(asked) +
                           " footprints found no place",
                       "ask for fewer or smaller ones, a smaller gap, or a larger ground");
}

Status applyArrange(OpCall& call, const Arrange& args) {
  const Array& rows = *args.footprints.array;
  const double gap = args.gap, edge = args.edge.value_or(gap);
  if (Status bad = checked(call, rows); !bad) return bad;
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  const SelectorItem* placed = itemFor(call, "placed");
  const SelectorItem* remainder = itemFor(call, "remainder");
  const SelectorItem* hull = itemFor(call, "hull", false);
  std::vector<bool> done(rows.rows, false);
  uint32_t rest = rows.rows, hulls = 0;
  for (const Ground& ground : grounds) {
    std::vector<Footprint> footprints = wanted(call, args.turn, rows, ground.polygon);
    for (size_t i = 0; i < footprints.size(); ++i) {
      if (done[i]) footprints[i].width = 0;
    }
    const ArrangeOrder order =
        args.order == Order::Given ? ArrangeOrder::Given : ArrangeOrder::Largest;
    const std::vector<ArrangedPlace> places =
        arrange(ground.polygon, footprints, gap, edge, {}, order);
    Region covered;
    for (uint32_t i = 0; i < places.size(); ++i) {
      if (!places[i].placed) continue;
      done[i] = true;
      const Polygon part{footprints[i].at(places[i].middle), {}};
      covered.push_back(part);
      if (!placed) continue;
      Shape child = groundPart(call, ground, part, 0, {});
      child.split = {i, rows.rows};
      call.emit(std::move(child), placed->slot, i);
    }
    emitHull(call, ground, covered, hull, hulls++);
    if (!remainder) continue;
    for (const Polygon& p : subtract({ground.polygon}, covered)) {
      const uint32_t piece = rest++;
      if (gable::area(p) < kSliver * gable::area(ground.polygon)) continue;
      call.emit(groundPart(call, ground, p, kNoFront, streetOf(ground, p)), remainder->slot, piece);
    }
  }
  tellLeftOut(call, rows, done);
  return {};
}

Status applySpaced(OpCall& call, const ScatterSpaced& args) {
  const double distance = args.distance, edge = args.edge, jitter = args.jitter;
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  MeshBuilder b;
  const uint32_t p = b.addPosition({});
  b.addPolygon({&p, 1});
  const Ref<Mesh> point = makeRef<Mesh>(b.take());
  uint32_t piece = 0;
  for (size_t g = 0; g < grounds.size(); ++g) {
    const Ground& ground = grounds[g];
    const uint64_t address = call.randomAddress(g);
    const auto most = static_cast<size_t>(kMostPoints);
    if (gable::area(ground.polygon) / (distance * distance) > kMostPoints) {
      return call.fail("scatter-too-many", "scatterSpaced would make more than 100000 shapes",
                       "give a larger distance, or divide the shape first");
    }
    const auto points = args.pattern == PointPattern::Jittered
                            ? scatterJittered(ground.polygon, distance, jitter, edge, most, address)
                            : scatterPoisson(ground.polygon, distance, edge, most, address);
    const Vec3 x = ground.frame.x, y = ground.frame.z;
    for (const Vec2 at : points) {
      work(4);
      Shape child = call.shape();
      child.scope =
          call.shape().scope * Frame::of(ground.frame.point({at.x, at.y, 0}), x, y, cross(x, y));
      child.size = {};
      setMesh(child, point, ScopeFit::Keep);
      forgetFarTrimPlanes(child);
      call.emit(std::move(child), 0, piece++);
    }
  }
  return {};
}

constexpr ParamSpec kArrangeParams[] = {
    param<&Arrange::footprints>(
        "footprints",
        "A row for each: width and depth, then perhaps x and z in the scope of where its middle is "
        "to "
        "be, then perhaps its turn in degrees. Without a place one is drawn."),
    param<&Arrange::gap>("gap", "Between any two, in metres.", "1").atLeast(0),
    param<&Arrange::edge>("edge", "Between them and the border.", "gap").atLeast(0),
    param<&Arrange::turn>("turn",
                          "Without a turn of its own a footprint lies as the scope does, fronts "
                          "the edge nearest to its "
                          "wish, or is turned at random.",
                          "scope"),
    param<&Arrange::order>(
        "order",
        "Who finds a place first: the largest, or the first row, then the second and so on.",
        "largest"),
};
constexpr Signature kArrange[] = {{kArrangeParams}};
constexpr ParamSpec kSpacedParams[] = {
    param<&ScatterSpaced::distance>("distance", "Between points: at least, or from cell to cell.")
        .above(0),
    param<&ScatterSpaced::pattern>(
        "pattern",
        "poisson: as many as fit, no two nearer than the distance; jittered: one in each cell of a "
        "grid, moved from its middle.",
        "poisson"),
    param<&ScatterSpaced::edge>("edge", "Kept free along the border, in metres.", "0").atLeast(0),
    param<&ScatterSpaced::jitter>(
        "jitter", "jittered: how far points may be moved, as a share of the cell.", "0.8")
        .atLeast(0),
};
constexpr Signature kSpaced[] = {{kSpacedParams}};

constexpr PartSpec kParts[] = {{"placed", "A footprint where it found its place."},
                               {"remainder", "The face without the footprints."},
                               {"hull", "The convex hull of all footprints."}};
constexpr OpSpec kSpecs[] = {
    heavy({"arrange", "layout",
           "Finds free places for footprints, each near to where it is wished.", kArrange,
           typed<applyArrange>, BlockKind::Selectors, kRandom, kParts, false, true}),
    {"scatterSpaced", "layout", "Gives out points that keep a distance from each other.", kSpaced,
     typed<applySpaced>, BlockKind::Operations, kRandom, kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_arrange;
const OpList kOps_arrange = kSpecs;

}  // namespace gable
