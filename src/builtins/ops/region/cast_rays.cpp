// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Paths from centres to the boundary; the kernel is geom/region/rays.
#include "geom/region/rays.h"

#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/along.h"
#include "geom/region/places.h"
#include "math/trig.h"

namespace gable {

namespace {

bool isMiddle(std::string_view text) {
  TextReader r(text);
  const std::string w = r.word();
  return (w == "centre" || w == "center") && r.atEnd();
}

Status centresOf(OpCall& call, const RegionView& view, uint64_t seed, std::vector<Vec2>& out) {
  if (isMiddle(textOf(call, 0, ""))) {
    out.push_back(middleOf(view.polygon()));
    return {};
  }
  std::vector<Disc> discs;
  const Status status = discsOf(call, 0, view, seed, discs);
  for (const Disc& d : discs) out.push_back(d.centre);
  return status;
}

// A place on the outline: 0.5 is the middle of logical edge 0, 1.25 a quarter along edge 1.
Vec2 entranceAt(const RegionView& view, double at) {
  const std::vector<uint32_t> logical = view.logicals();
  const double count = std::max(1u, view.logicalCount());
  const double turn = std::fmod(std::fmod(at, count) + count, count);
  const LogicalRange whole[] = {{static_cast<uint32_t>(turn), 0, 1}};
  const std::vector<Polyline> lines = parametrise(view.polygon().outer, logical, whole, true);
  if (lines.empty()) return view.polygon().outer[0];
  return stationAt(lines[0], turn - std::floor(turn)).at;
}

Status targetsOf(OpCall& call, const RegionView& view, std::vector<RayTarget>& out) {
  const Value& v = call.arg(1);
  if (v.type == ValueType::FloatArray) {
    const Vec3 o = view.plane().frame().toLocal({});
    const Array& a = call.services().pool().array(v);
    for (size_t i = 0; i + 1 < a.numbers.size(); i += 2) {
      out.push_back({RayTarget::Kind::Point, {a.numbers[i] + o.x, a.numbers[i + 1] + o.y}});
    }
    return {};
  }
  double n = v.number;
  if (v.type == ValueType::String || v.type == ValueType::Selector) {
    TextReader r(call.text(1));
    const std::string w = r.word();
    if (w == "corners") {
      for (const Vec2 p : view.polygon().outer) out.push_back({RayTarget::Kind::Point, p});
      return {};
    }
    if (w == "directions" && r.accept('(')) {
      double a = 0;
      while (r.number(a)) {
        out.push_back({RayTarget::Kind::Direction, {cosDeg(a), sinDeg(a)}});
        r.accept(',');
      }
      if (r.accept(')')) return {};
    }
    if (w == "entrances" && r.accept('(')) {
      const bool bracket = r.accept('[');
      double at = 0;
      while (r.number(at)) {
        out.push_back({RayTarget::Kind::Point, entranceAt(view, at)});
        r.accept(',');
      }
      if ((!bracket || r.accept(']')) && r.accept(')')) return {};
    }
    n = -1;
  }
  if (!(n >= 0 && n <= 1000)) {
    return call.fail(
        "bad-argument", "these are no targets for rays",
        "write corners, a count, \"directions(0, 90)\", \"entrances(0.5, 2.5)\" or a list of "
        "coordinates");
  }
  for (double k = 0; k < n; ++k) {
    const double a = 360 * k / n;
    out.push_back({RayTarget::Kind::Direction, {cosDeg(a), sinDeg(a)}});
  }
  return {};
}

Status applyCastRays(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  RayOptions o;
  o.pathWidth = call.number(2, 3);
  if (!(o.pathWidth >= 0) || !std::isfinite(o.pathWidth)) {
    return call.fail("bad-argument", "a path cannot be " + shortestText(o.pathWidth) + " wide",
                     "write a width of zero or more");
  }
  const std::string figure = textOf(call, 3, "");
  std::string problem;
  double radius = 0;
  if (parseNumber(figure, radius)) {
    if (radius > 0) o.centre = {PlanShape::Circle, radius, 0, 24};
  } else if (!figure.empty() && figure != "none" && !readFigure(figure, o.centre, problem)) {
    return call.fail("bad-argument", problem, "write a radius, circle(r), square(a) or romb(r)");
  }
  const std::string options = textOf(call, 4, "");
  o.stopHidden = option(options, "hidden") == "stop";
  const std::string links = option(options, "connect");
  o.links = links == "none"       ? CentreLinks::None
            : links == "loop"     ? CentreLinks::Loop
            : links == "pairs"    ? CentreLinks::Pairs
            : links == "opposite" ? CentreLinks::Opposite
            : links == "thin"     ? CentreLinks::Thin
                                  : CentreLinks::Tree;
  parseNumber(option(options, "share"), o.thin);
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Vec2> centres;
    std::vector<RayTarget> targets;
    Status status = centresOf(call, view, call.randomAddress(f), centres);
    if (status.ok()) status = targetsOf(call, view, targets);
    if (!status.ok()) return status;
    RayResult r = castRays(view.polygon(), centres, targets, o);
    if (r.rays + 2 * r.links < 2) {
      return failOrElse(call, "no-rays", "fewer than two rays reach the boundary",
                        "give more targets, or a centre that sees them");
    }
    if (r.moved) {
      call.services().warn("centre-moved",
                           "'castRays': a centre outside of the region was left out",
                           "give coordinates in the region");
    }
    for (RegionPiece& p : r.pieces) {
      std::vector<EdgeMark> marks =
          view.marksOf(p, p.kind == PieceKind::Cell ? EdgeIndex::Sector : EdgeIndex::Inherited);
      const std::string_view word = p.kind == PieceKind::Cell   ? "region"
                                    : p.kind == PieceKind::Path ? "path"
                                                                : "centre";
      job.keep(f, word, std::move(p), std::move(marks), std::nullopt);
    }
  }
  job.emit();
  return {};
}

constexpr ParamSpec kParams[] = {
    {"centres", ParamType::Any,
     "\"centre\", a text \"1 {15}\" (places scattered so far from the boundary and each other), "
     "or a list of coordinates."},
    {"targets", ParamType::Any,
     "\"corners\", a count of equal angles, \"directions(0, 90)\", \"entrances(0.5, 2.5)\" (places "
     "along logical edges: here the middles of 0 and 2), or a list of coordinates."},
    {"pathWidth", ParamType::Float, "Of the paths along rays; 0 for none.", "3"},
    {"centre", ParamType::Any, "Around each centre: a radius, or a figure as \"square(4)\".", "0"},
    {"options", ParamType::String,
     "hidden=drop|stop, connect=tree|none|loop|pairs|opposite|thin, share=0.5 (of thin).", "\"\""},
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"castRays", "region", "Divides a region by paths from centres to its boundary.", kSignatures,
     applyCastRays, BlockKind::Selectors, kRandom, "region path centre otherwise", false, true},
};

}  // namespace

extern const OpList kOps_cast_rays;
const OpList kOps_cast_rays = kSpecs;

}  // namespace gable
