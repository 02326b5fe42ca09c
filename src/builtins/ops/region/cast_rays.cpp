// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Paths from centres to the boundary; the kernel is geom/region/rays.
#include "base/work.h"
#include "geom/region/rays.h"

#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_attributes.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/along.h"
#include "geom/region/places.h"
#include "math/trig.h"

namespace gable {

enum class Hidden : uint8_t { Drop, Stop };

template <>
struct WordsOf<Hidden> {
  static constexpr const char* text = "drop stop";
};
template <>
struct WordsOf<CentreLinks> {
  static constexpr const char* text = "none loop tree pairs opposite thin";
};

namespace {

constexpr double kMostTargets = 1000;

struct CastRays {
  Selection centres, targets;
  double path = 3;
  Drawn radius;
  CentreLinks connect = CentreLinks::Tree;
  double share = 0;
  Hidden hidden = Hidden::Drop;
};

Status centresOf(OpCall& call, const CastRays& args, const RegionView& view, uint64_t seed,
                 std::vector<Vec2>& out) {
  const std::vector<Term> terms = termsOf(args.centres, call.services(), call.randomAddress(900));
  if (terms.size() == 1 && (terms[0].is("centre") || terms[0].is("center"))) {
    out.push_back(middleOf(view.polygon()));
    return {};
  }
  std::vector<Disc> discs;
  const DrawnNumber radius = numberOf(args.radius, call.services(), call.randomAddress(902));
  const Status status = discsOf(call, terms, radius, view, seed, discs);
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

void addCoordinates(const OpCall& call, const RegionView& view, const Value& v,
                    std::vector<RayTarget>& out) {
  const Vec3 o = view.plane().frame().toLocal({});
  const Array& a = call.services().pool().array(v);
  for (size_t i = 0; i + 1 < a.numbers.size(); i += 2) {
    out.push_back({RayTarget::Kind::Point, {a.numbers[i] + o.x, a.numbers[i + 1] + o.y}});
  }
}

// Each term adds its targets; || stands between them.
Status targetsOf(OpCall& call, const CastRays& args, const RegionView& view,
                 std::vector<RayTarget>& out) {
  const Status bad = call.fail("bad-argument", "these are no targets for rays",
                               "write corners, a count, or direction(0) || entrance(1.5) || "
                               "point(3, 4)");
  for (const Term& t : termsOf(args.targets, call.services(), call.randomAddress(901))) {
    if (t.kind == ArgumentTerm::Kind::Or) continue;
    if (t.is("corners")) {
      for (const Vec2 p : view.polygon().outer) out.push_back({RayTarget::Kind::Point, p});
    } else if (t.is("direction")) {
      const double a = t.number(0);
      out.push_back({RayTarget::Kind::Direction, {cosDeg(a), sinDeg(a)}});
    } else if (t.is("entrance")) {
      if (!std::isfinite(t.number(0))) return bad;
      out.push_back({RayTarget::Kind::Point, entranceAt(view, t.number(0))});
    } else if (t.is("point")) {
      out.push_back(
          {RayTarget::Kind::Point, Vec2{t.number(0), t.number(1)} + bounds(view.polygon()).min});
    } else if (t.kind != ArgumentTerm::Kind::Value) {
      return bad;
    } else if (t.values[0].type == ValueType::FloatArray) {
      addCoordinates(call, view, t.values[0], out);
    } else {
      const double n = t.number(0);
      if (!(n >= 0 && n <= kMostTargets)) return bad;
      for (double k = 0; k < n; ++k) {
        work(8);
        const double a = 360 * k / n;
        out.push_back({RayTarget::Kind::Direction, {cosDeg(a), sinDeg(a)}});
      }
    }
  }
  return {};
}

Status applyCastRays(OpCall& call, const CastRays& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  RayOptions o;
  o.pathWidth = args.path;
  o.links = args.connect;
  o.thin = args.share;
  o.stopHidden = args.hidden == Hidden::Stop;
  const std::optional<uint32_t> centreSlot = slotOf(call, "centre");
  uint32_t choice = 0;
  if (centreSlot) {
    const DrawnFigure figure = drawFigure(call, *centreSlot, call.randomAddress(600), call.shape());
    if (!planFigureOf(figure, o.centre)) return badFigure(call);
    choice = figure.ordinal;
  }
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Vec2> centres;
    std::vector<RayTarget> targets;
    Status status = centresOf(call, args, view, call.randomAddress(f), centres);
    if (status.ok()) status = targetsOf(call, args, view, targets);
    if (!status.ok()) return status;
    RayResult r = castRays(view.polygon(), centres, targets, o);
    if (r.rays + 2 * r.links < 2) {
      return call.orElse(call.fail("no-rays", "fewer than two rays reach the boundary",
                                   "give more targets, or a centre that sees them"));
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
      } else if (choice > 0 && word == "centre") {
        cell = CellMark{};
        cell->choice = choice;
      }
      job.keep(f, word, std::move(p), std::move(marks), cell);
    }
  }
  job.emitCells("write fewer targets, a narrower path, or a smaller centre");
  return {};
}

constexpr ParamSpec kDegrees[] = {{"angle", ParamType::Float, "In degrees, from x to the left."}};
constexpr ParamSpec kAt[] = {
    {"at", ParamType::Float, "1.25 is a quarter along logical edge 1, clockwise."}};
constexpr TermSpec kCentreTerms[] = {{"centre", "The middle of the region."},
                                     {.name = "center", .doc = "The middle of the region."},
                                     site_terms::kSites[0]};
constexpr TermSpec kTargetTerms[] = {
    {"corners", "Every corner of the outline."},
    TermSpec::call("direction", "As far as the boundary in that direction.", kDegrees),
    TermSpec::call("entrance", "A place along the outline.", kAt),
    site_terms::kSites[0]};

constexpr ParamSpec kParams[] = {
    selection<&CastRays::centres>(
        "centres",
        "Where rays come from: centre, so many scattered places, places, point(3, 4) || point(10, "
        "4), or a list of coordinates from the scope's origin.",
        kCentreTerms)
        .between(0, kMostDiscs),
    selection<&CastRays::targets>(
        "targets",
        "Where they go: corners, a count of equal angles, or direction(0), entrance(1.5) and "
        "point(3, 4) with || between; or a list of coordinates.",
        kTargetTerms)
        .between(0, kMostTargets),
    param<&CastRays::path>("path", "Width of the paths along rays; 0 for none.", "3").atLeast(0),
    param<&CastRays::radius>(
        "radius", "Scattered centres keep so far from the boundary, and twice from each other.",
        "0")
        .atLeast(0),
    param<&CastRays::connect>(
        "connect",
        "How several centres are joined: not at all, in a round, by the shortest tree, two and "
        "two, "
        "each with the one across, or by the tree and a share of the shortest links besides.",
        "tree"),
    param<&CastRays::share>("share", "Of connect = thin: the share of further links.", "0")
        .between(0, 1),
    param<&CastRays::hidden>(
        "hidden", "A target that something hides: no ray, or one that stops there.", "drop"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {{"region", "Ground between rays."},
                               {"path", "A path along a ray or between centres."},
                               {"centre", "Where rays come from; may begin with a figure."},
                               kOtherwise};
constexpr OpSpec kSpecs[] = {
    withFigures({"castRays", "region", "Divides a region by paths from centres to its boundary.",
                 kSignatures, typed<applyCastRays>, BlockKind::Selectors, kReadsRegion | kRandom,
                 kParts, false, true},
                "centre", kRegionChoice),
};

}  // namespace

extern const OpList kOps_cast_rays;
const OpList kOps_cast_rays = kSpecs;

}  // namespace gable
