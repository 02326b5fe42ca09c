// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Outlines from outlines. Each works face by face, in the face's plane; the hull alone takes all
// points of the shape, in the plane of its first face.
#include "geom/region/outline.h"
#include "base/work.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/ground.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/clean.h"
#include "geom/region/hull.h"
#include "geom/region/triangulate.h"
#include "geom/region/voronoi.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr double kMostPoints = 200000;
constexpr double kMostCuts = 6;
// Points of a slope this near to each other, or to the line past them, would make triangles without
// an area.
constexpr double kNoWidth = 1e-3;

// One mesh of all faces; nothing left deletes the shape.
void become(OpCall& call, Mesh mesh) {
  if (mesh.faceCount() == 0) {
    call.drop();
  } else {
    setPartMesh(call.shape(), Shape(call.shape()), std::move(mesh), true);
  }
}

void addFaces(MeshBuilder& b, const Ground& g, const Region& r) {
  for (const Polygon& p : r) {
    b.beginFace(g.materialSlot, g.tags);
    for (const Ring& ring : ringsOf({p})) {
      b.beginLoop();
      for (const Vec2 at : ring) b.addCorner(b.addPosition(fromPlanFrame(g.frame, at)));
    }
  }
}

// Replaces each face by what `make` makes of its polygon.
template <class Make>
Status replaceFaces(OpCall& call, Make&& make) {
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  MeshBuilder b;
  for (size_t i = 0; i < grounds.size(); ++i) addFaces(b, grounds[i], make(grounds[i].polygon, i));
  become(call, b.take());
  return {};
}

// ---- hull -----------------------------------------------------------------------------------

struct Hull {
  double shortest;
};

Status applyHull(OpCall& call, const Hull& args) {
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  const MeshRef mesh = meshInScope(call.shape());
  std::vector<Vec2> points;
  for (const Vec3& p : mesh->positions) {
    const Vec3 local = grounds[0].frame.toLocal(p);
    points.push_back({local.x, local.y});
  }
  const double shortest = args.shortest;
  Ring hull = withoutShortEdges(convexHull(points), shortest);
  MeshBuilder b;
  addFaces(b, grounds[0], {Polygon{std::move(hull), {}}});
  become(call, b.take());
  return {};
}

// ---- ring -----------------------------------------------------------------------------------

using Points = std::vector<std::pair<double, double>>;

Points sortedPoints(const Region& r) {
  Points out;
  for (const Ring& ring : ringsOf(r)) {
    for (const Vec2 p : ring) out.emplace_back(p.x, p.y);
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Triangles, so that every face is flat; the corners of the outline at `to` lie lower.
void addSlope(MeshBuilder& b, const Ground& g, const Polygon& p, const Points& low, double drop) {
  std::vector<uint32_t> position;
  for (const Ring& ring : ringsOf({p})) {
    for (const Vec2 at : ring) {
      work();
      const bool isLow = std::binary_search(low.begin(), low.end(), std::make_pair(at.x, at.y));
      position.push_back(b.addPosition(fromPlanFrame(g.frame, at, isLow ? -drop : 0)));
    }
  }
  for (const Triangle& t : triangulateEvenly(p)) {
    work();
    b.beginFace(g.materialSlot, g.tags, true);
    b.beginLoop();
    for (const uint32_t corner : t) b.addCorner(position[corner]);
  }
}

enum class Corners : uint8_t { Miter, Round };

}  // namespace

template <>
struct WordsOf<Corners> {
  static constexpr const char* text = "miter round";
};

namespace {

struct RingArguments {
  double from, to, drop;
  Corners corners;
};

Status applyRing(OpCall& call, const RingArguments& args) {
  const double from = args.from, to = args.to, drop = args.drop;
  if (!std::isfinite(from) || !std::isfinite(to) || !std::isfinite(drop)) {
    return call.fail("bad-argument", "the distances of ring are not finite numbers",
                     "check the expressions for a division by zero");
  }
  const OffsetJoin join = args.corners == Corners::Round ? OffsetJoin::Round : OffsetJoin::Miter;
  if (drop == 0) {
    return replaceFaces(call,
                        [&](const Polygon& p, size_t) { return bandAround({p}, from, to, join); });
  }
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  OffsetOptions options;
  options.join = join;
  MeshBuilder b;
  for (const Ground& g : grounds) {
    const Points low = sortedPoints(offset({g.polygon}, to, options));
    Region band = bandAround({g.polygon}, from, to, join);
    clean(band, kNoWidth);
    for (const Polygon& p : band) addSlope(b, g, p, low, drop);
  }
  become(call, b.take());
  return {};
}

// ---- smoothOutline, roughenOutline ------------------------------------------------------------

enum class SmoothMode : uint8_t { Chaikin, Average, Round };

}  // namespace

template <>
struct WordsOf<SmoothMode> {
  static constexpr const char* text = "chaikin average round";
};

namespace {

struct SmoothOutline {
  SmoothMode mode;
  std::optional<double> amount;
};

Smoothing::Kind kindOf(SmoothMode mode) {
  switch (mode) {
    case SmoothMode::Round: return Smoothing::Kind::Round;
    case SmoothMode::Average: return Smoothing::Kind::Average;
    case SmoothMode::Chaikin: break;
  }
  return Smoothing::Kind::Chaikin;
}

Status applySmooth(OpCall& call, const SmoothOutline& args) {
  const double amount = args.amount.value_or(args.mode == SmoothMode::Round ? 1 : 2);
  Smoothing s;
  s.kind = kindOf(args.mode);
  s.radius = amount;
  const bool times = s.kind != Smoothing::Kind::Round;
  if (times && amount > kMostCuts) {
    return call.fail("bad-argument", "smoothOutline cuts corners 1 to 6 times",
                     "such as smoothOutline(chaikin, 3)");
  }
  s.times = times ? static_cast<uint32_t>(std::max(1.0, std::nearbyint(amount))) : 1;
  return replaceFaces(call, [&](const Polygon& p, size_t) { return smoothed(p, s); });
}

struct RoughenOutline {
  double amount, wavelength;
};

Status applyRoughen(OpCall& call, const RoughenOutline& args) {
  const double amount = args.amount, wavelength = args.wavelength;
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  double size = 0;
  for (const Ground& g : grounds) size += roughenedSize(g.polygon, wavelength);
  if (!(size <= kMostPoints)) {
    return call.fail("roughen-too-fine", "roughenOutline would make more than 200000 points",
                     "make the wavelength longer");
  }
  return replaceFaces(call, [&](const Polygon& p, size_t i) {
    return roughened(p, amount, wavelength, call.randomAddress(i));
  });
}

constexpr ParamSpec kHullParams[] = {
    param<&Hull::shortest>("shortest",
                           "Shorter edges go: their neighbours are drawn on until they meet.", "0")
        .atLeast(0),
};
constexpr Signature kHull[] = {{kHullParams}};
constexpr ParamSpec kRingParams[] = {
    param<&RingArguments::from>("from",
                                "Where the ring begins: metres outward, inward where negative."),
    param<&RingArguments::to>("to", "Where it ends."),
    param<&RingArguments::drop>("drop",
                                "How much lower its edge at `to` lies: a slope of triangles.", "0"),
    param<&RingArguments::corners>("corners", "Whether corners are pointed or rounded.", "miter"),
};
constexpr Signature kRing[] = {{kRingParams}};
constexpr ParamSpec kSmoothParams[] = {
    param<&SmoothOutline::mode>(
        "mode", "chaikin cuts corners, average draws them in, round rounds them by a radius."),
    param<&SmoothOutline::amount>("amount", "How often, or the radius in metres.", "2, radius 1")
        .above(0),
};
constexpr Signature kSmooth[] = {{kSmoothParams}};
constexpr ParamSpec kRoughenParams[] = {
    param<&RoughenOutline::amount>("amount", "How far points move at most, outward and inward."),
    param<&RoughenOutline::wavelength>("wavelength", "Over what distance that changes.").above(0),
};
constexpr Signature kRoughen[] = {{kRoughenParams}};

constexpr OpSpec kSpecs[] = {
    {"hull", "layout", "Replaces the geometry by its convex hull in the plane of its first face.",
     kHull, typed<applyHull>},
    heavy({"ring", "layout", "Replaces each face by a ring around or within it, level or sloping.",
           kRing, typed<applyRing>}),
    heavy({"smoothOutline", "layout", "Smooths the outlines of the faces; they stay within.",
           kSmooth, typed<applySmooth>}),
    heavy({"roughenOutline", "layout", "Makes the outlines of the faces wander as natural ones do.",
           kRoughen, typed<applyRoughen>, BlockKind::None, kRandom}),
};

}  // namespace

extern const OpList kOps_outline;
const OpList kOps_outline = kSpecs;

}  // namespace gable
