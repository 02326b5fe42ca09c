// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Paths from centres to the boundary; the kernel is geom/region/rays.
#include "base/work.h"
#include "geom/region/rays.h"

#include <algorithm>
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
    std::vector<Disc> places;
    if (readPoints(call.text(1), places)) {
      const Vec2 corner = bounds(view.polygon()).min;
      for (const Disc& d : places) out.push_back({RayTarget::Kind::Point, d.centre + corner});
      return {};
    }
    n = -1;
  }
  if (!(n >= 0 && n <= 1000)) {
    return call.fail("bad-argument", "these are no targets for rays",
                     "write corners, a count, \"directions(0, 90)\", \"entrances(0.5, 2.5)\" or "
                     "places, \"(3, 4) "
                     "(10, 4)\"");
  }
  for (double k = 0; k < n; ++k) {
    work(8);
    const double a = 360 * k / n;
    out.push_back({RayTarget::Kind::Direction, {cosDeg(a), sinDeg(a)}});
  }
  return {};
}

// How several centres are joined, and whether rays end at what hides their target.
Status linksOf(const OpCall& call, RayOptions& o) {
  const Status status = optionsAre(call, 4, "hidden=drop|stop connect=* share=#");
  if (!status.ok()) return status;
  const std::string options = textOf(call, 4, ""), links = option(options, "connect");
  o.stopHidden = option(options, "hidden") == "stop";
  parseNumber(option(options, "share"), o.thin);
  TextReader r(links);
  const std::string word = r.word();
  constexpr std::pair<std::string_view, CentreLinks> kKnown[] = {
      {"tree", CentreLinks::Tree},         {"none", CentreLinks::None},
      {"loop", CentreLinks::Loop},         {"pairs", CentreLinks::Pairs},
      {"opposite", CentreLinks::Opposite}, {"thin", CentreLinks::Thin}};
  const auto* found = std::find_if(std::begin(kKnown), std::end(kKnown),
                                   [&](const auto& k) { return k.first == word; });
  bool read = links.empty() || found != std::end(kKnown);
  if (!links.empty() && read) o.links = found->second;
  if (word == "thin" && r.accept('(')) read = r.number(o.thin) && r.accept(')');
  if (read && r.atEnd() && o.thin >= 0 && o.thin <= 1) return {};
  return call.fail(
      "bad-argument", "centres cannot be joined so",
      "write connect=tree, none, loop, pairs, opposite or thin(0.5), a share of 0 to 1");
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
  if (const Status status = linksOf(call, o); !status.ok()) return status;
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
      const bool any = std::any_of(centres.begin(), centres.end(), [&](Vec2 c) {
        return locate(view.polygon(), c) == Where::Inside;
      });
      call.services().warn("centre-moved",
                           any ? "'castRays': a centre outside of the region was left out"
                               : "'castRays': the centre is outside of the region; rays come from "
                                 "its middle",
                           "give coordinates in the region");
    }
    const auto cells = static_cast<uint32_t>(
        std::count_if(r.pieces.begin(), r.pieces.end(),
                      [](const RegionPiece& p) { return p.kind == PieceKind::Cell; }));
    for (RegionPiece& p : r.pieces) {
      std::vector<EdgeMark> marks =
          view.marksOf(p, p.kind == PieceKind::Cell ? EdgeIndex::Sector : EdgeIndex::Inherited);
      const std::string_view word = p.kind == PieceKind::Cell   ? "region"
                                    : p.kind == PieceKind::Path ? "path"
                                                                : "centre";
      std::optional<CellMark> cell;
      if (p.kind == PieceKind::Cell) {
        const Vec2 size = bounds(p.polygon).size();
        cell = CellMark{p.ix, 0, cells, 1, size.x, size.y, CellPattern::Local, p.part};
        cell->free = true;
      }
      job.keep(f, word, std::move(p), std::move(marks), cell);
    }
  }
  job.emit();
  return {};
}

constexpr ParamSpec kParams[] = {
    {"centres", ParamType::Any,
     "\"centre\", a text \"1 {15}\" (places scattered so far from the boundary and each other), "
     "places \"(3, 4) (10, 4)\", or a list of coordinates."},
    {"targets", ParamType::Any,
     "\"corners\", a count of equal angles, \"directions(0, 90)\", \"entrances(0.5, 2.5)\" (places "
     "along logical edges: here the middles of 0 and 2), places, or a list of coordinates."},
    {"pathWidth", ParamType::Float, "Of the paths along rays; 0 for none.", "3"},
    {"centre", ParamType::Any, "Around each centre: a radius, or a figure as \"square(4)\".", "0"},
    {"options", ParamType::String,
     "hidden=drop|stop, connect=tree|none|loop|pairs|opposite|thin(0.5).", "\"\""},
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
