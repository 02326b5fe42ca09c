// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Things put into a region: at one place, or along edges. The region goes on after them, less what
// was cut out of it.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_attributes.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/autoindex.h"
#include "geom/region/cut_holes.h"
#include "geom/region/segment_grid.h"
#include "math/trig.h"

namespace gable {

namespace {

struct Place {
  Selection where;
  bool over = false, split = false, align = false;
};

struct Distribute {
  Selection selection;
  std::optional<double> spacing;
  double inset = 0;
  std::optional<Floats> at;
  std::optional<double> intervals, interval;
  bool start = false, end = false;
  bool over = false, split = false, chain = false;
};

constexpr double kMostIntervals = 100000;

// South-west, south-east, north-east, north-west.
Quad cornersOf(const RegionView& view) {
  const Ring& r = view.polygon().outer;
  const size_t n = r.size();
  Quad q{};
  bool found[4] = {};
  for (size_t i = 0; i < n && view.logicalCount() == 4; ++i) {
    const uint32_t own = view.marks()[i].logical, before = view.marks()[(i + n - 1) % n].logical;
    if (own == before || own > 3) continue;
    // South begins in the south-west, east in the south-east.
    q[3 - own] = r[i];
    found[3 - own] = true;
  }
  if (found[0] && found[1] && found[2] && found[3]) return q;
  const OrientedRect box = orientedFrame(r);
  return {box.at(0, 0), box.at(box.width, 0), box.at(box.width, box.height), box.at(0, box.height)};
}

bool hasFourSides(const RegionView& view) {
  bool has[4] = {};
  for (size_t i = 0; i < view.polygon().outer.size(); ++i) {
    if (view.marks()[i].logical < 4) has[view.marks()[i].logical] = true;
  }
  return view.logicalCount() == 4 && has[0] && has[1] && has[2] && has[3];
}

// Of a region that is no quadrilateral: where, clockwise, logical edge k begins, or the next one
// that there is. Corner 0 of a sector is its centre.
Vec2 logicalCorner(const RegionView& view, uint32_t k) {
  const Ring& r = view.polygon().outer;
  const size_t n = r.size();
  const uint32_t count = std::max(1u, view.logicalCount());
  for (uint32_t step = 0; step < count; ++step) {
    work();
    const uint32_t wanted = (k + step) % count;
    for (size_t i = 0; i < n; ++i) {
      work(4);
      const size_t next = (i + 1) % n;
      if (view.marks()[i].logical == wanted && view.marks()[next].logical != wanted) return r[next];
    }
  }
  return r[0];
}

// The corners of the outline between two edges that a selection means.
void cornersBetween(const OpCall& call, const RegionJob& job, size_t face,
                    std::span<const Term> selection, std::vector<Vec2>& out) {
  const RegionView& view = *job.faces()[face];
  const Ring& r = view.polygon().outer;
  const SelectionInput input{view, call.randomAddress(1000 + face), job.worldIn(face),
                             call.services().pool()};
  std::vector<bool> begins(r.size(), false), ends(r.size(), false);
  for (const EdgePart& e : selectEdges(selection, input)) {
    if (e.edge >= r.size()) continue;
    begins[e.edge] = begins[e.edge] || e.from <= 0;
    ends[e.edge] = ends[e.edge] || e.to >= 1;
  }
  constexpr double kLeastTurn = 15;
  for (size_t i = 0; i < r.size(); ++i) {
    work();
    const size_t before = (i + r.size() - 1) % r.size();
    const Vec2 in = r[i] - r[before], out1 = r[(i + 1) % r.size()] - r[i];
    const double turn = std::fabs(atan2Deg(cross(in, out1), dot(in, out1)));
    if (begins[i] && ends[before] && turn > kLeastTurn) out.push_back(r[i]);
  }
}

Vec2 cornerNumbered(const RegionView& view, double i) {
  const double count = std::max(1u, view.logicalCount());
  const auto k = static_cast<uint32_t>(
      std::fmod(std::fmod(std::clamp(std::floor(i), -1e6, 1e6), count) + count, count));
  if (!hasFourSides(view)) return logicalCorner(view, k);
  // Clockwise from the south-west.
  static constexpr size_t kOrder[] = {0, 3, 2, 1};
  // Corner k begins side k; of a mirrored cell it ends the image of side k.
  uint32_t corner = k;
  if (view.cell()) {
    const uint32_t side = view.cell()->side(k), next = view.cell()->side((k + 1) % 4);
    corner = next == (side + 1) % 4 ? side : (side + 1) % 4;
  }
  return cornersOf(view)[kOrder[corner]];
}

void addAddress(const RegionView& view, double u, double v, std::vector<Vec2>& out) {
  if (view.cell() && !view.cell()->address(u, v)) return;
  const Quad q = cornersOf(view);
  const Vec2 low = q[0] + (q[1] - q[0]) * u, high = q[3] + (q[2] - q[3]) * u;
  out.push_back(low + (high - low) * v);
}

void addCorners(const RegionView& view, std::vector<Vec2>& out) {
  std::vector<Vec2> all;
  for (uint32_t k = 0; k < view.logicalCount(); ++k) {
    const Vec2 at = logicalCorner(view, k);
    if (std::find(all.begin(), all.end(), at) == all.end()) all.push_back(at);
  }
  out.insert(out.end(), all.begin(), all.end());
}

// Whether `corners` stands for the places and not, within corner( .. ), for edges.
bool isPlace(std::span<const Term> terms, size_t i) {
  for (size_t k = i + 1; k < terms.size(); ++k) {
    if (terms[k].is("corner")) return false;
    const bool place = terms[k].is("centre") || terms[k].is("center") || terms[k].is("at") ||
                       terms[k].is("point") || terms[k].is("centroid") || terms[k].is("corners");
    if (place) return true;
  }
  return true;
}

// Each term adds its places; nothing where the pattern of the cell places nothing here.
Status placesOf(OpCall& call, const Selection& where, const RegionJob& job, size_t face,
                std::vector<Vec2>& out) {
  const RegionView& view = *job.faces()[face];
  const std::vector<Term> terms = termsOf(where, call.services(), call.randomAddress(900));
  // What stands within corner( .. ) is a selection of edges, and comes before it.
  size_t begin = 0;
  for (size_t i = 0; i < terms.size(); ++i) {
    const Term& t = terms[i];
    if (t.is("centre") || t.is("center")) {
      out.push_back(middleOf(view.polygon()));
    } else if (t.is("centroid")) {
      out.push_back(centroid(view.polygon()));
    } else if (t.is("at")) {
      addAddress(view, t.number(0), t.number(1), out);
    } else if (t.is("point")) {
      out.push_back(Vec2{t.number(0), t.number(1)} + bounds(view.polygon()).min);
    } else if (t.is("corner")) {
      const std::span<const Term> inside{terms.data() + begin, i - begin};
      if (inside.size() == 1 && inside[0].kind == ArgumentTerm::Kind::Value) {
        out.push_back(cornerNumbered(view, inside[0].number(0)));
      } else {
        cornersBetween(call, job, face, inside, out);
      }
    } else if (t.is("corners") && isPlace(terms, i)) {
      addCorners(view, out);
    } else {
      if (t.kind == ArgumentTerm::Kind::Or && begin == i) begin = i + 1;
      continue;
    }
    begin = i + 1;
  }
  if (out.empty() && begin == 0) {
    return call.fail("bad-argument", "this is no place of a region",
                     "write centre, corners, corner(0), corner(outer), at(0.8, 0.1) in shares of "
                     "the sides or point(3, 4) in metres");
  }
  return {};
}

// Along the edge of the outline that is nearest to a place.
Vec2 alongNearest(const Polygon& p, Vec2 at) {
  Vec2 best{1, 0};
  double least = 1e300;
  for (const Segment& s : edgesOf(p)) {
    const double d = distanceTo(s, at);
    if (d >= least || !(length(s.b - s.a) > 0)) continue;
    least = d;
    best = normalized(s.b - s.a);
  }
  return best;
}

// Gives out a point, or a figure there, which is cut out of the region.
class Placer {
 public:
  Placer(OpCall& call, RegionView& view, bool over, bool split, uint32_t count, uint32_t places)
      : call_(call),
        view_(view),
        cut_(!over),
        split_(split),
        warnsOfHoles_(std::string_view(call.spec().name) == "place"),
        slot_(thingSlot(call)),
        parent_(call.shape()),
        count_(count),
        places_(places) {}

  void add(Vec2 at, Vec2 along) {
    // What the block begins with, for this place.
    DrawnFigure drawn;
    if (slot_) drawn = drawFigure(call_, *slot_, call_.randomAddress(2000 + places_++), parent_);
    bad_ = bad_ || !planFigureOf(drawn, figure_);
    if (bad_) return;
    if (!contains(view_.polygon(), at)) {
      // Something else has taken the place before.
      if (figure_.shape != PlanShape::None && warnsOfHoles_ && inHole(at)) ++nested_;
      return;
    }
    if (figure_.shape == PlanShape::None) {
      if (slot_) call_.emit(view_.pointAt(parent_, at, along), *slot_, count_);
      ++count_;
      return;
    }
    const Region ring{{ringOf(figure_, at, along), {}}};
    if (occupied(ring)) {
      ++nested_;
      return;
    }
    const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
    std::vector<RegionPiece> pieces =
        combineTraced(BooleanOp::Intersection, wholePiece(view_.polygon()), ring, made);
    if (meetsHole(pieces, area(ring[0]))) {
      ++nested_;
      return;
    }
    for (RegionPiece& p : pieces) {
      p.axis = along;
      if (slot_) {
        std::optional<CellMark> cell;
        if (drawn.ordinal > 0) cell.emplace().choice = drawn.ordinal;
        call_.emit(view_.shapeOf(parent_, p, view_.marksOf(p, EdgeIndex::Outline), cell), *slot_,
                   count_);
      }
      ++count_;
    }
    holes_.push_back(ring[0]);
  }

  /// How many were given out on this face and those before it, and how many found no place.
  uint32_t count() const { return count_; }
  uint32_t nested() const { return nested_; }
  /// Places that were asked for, and whether one of their figures had no size.
  uint32_t places() const { return places_; }
  bool bad() const { return bad_; }
  bool cuts() const { return cut_ && !holes_.empty(); }

  /// What the figures leave of the face; nothing when they took all of it.
  std::vector<RegionPiece> left() const {
    if (!cuts()) return {wholePiece(view_.polygon())};
    const Region together =
        holes_.size() > 1 ? repaired(ringsOf(holes_), FillRule::NonZero) : holes_;
    const EdgeOrigin made{kNoEdge, EdgeRole::Hole, EdgeOrigin::kNoSide};
    std::vector<RegionPiece> left =
        combineTraced(BooleanOp::Difference, wholePiece(view_.polygon()), together, made);
    return split_ ? apart(left) : left;
  }

 private:
  bool occupied(const Region& ring) const {
    const Box2 box = bounds(ring[0]);
    return std::any_of(holes_.begin(), holes_.end(), [&](const Polygon& h) {
      const Box2 other = bounds(h);
      const bool near = box.min.x < other.max.x && other.min.x < box.max.x &&
                        box.min.y < other.max.y && other.min.y < box.max.y;
      return near && area(intersect(ring, {h})) > 1e-6 * area(h);
    });
  }
  // Whether something that was placed before takes a part of a figure, of which `pieces` are left.
  bool meetsHole(const std::vector<RegionPiece>& pieces, double whole) const {
    double left = 0;
    bool beside = false;
    for (const RegionPiece& p : pieces) {
      left += area(p.polygon);
      beside = beside || std::any_of(p.edges.begin(), p.edges.end(), [&](const EdgeOrigin& e) {
                 return e.source != kNoEdge && view_.marks()[e.source].role == EdgeRole::Hole;
               });
    }
    return beside && left < whole * (1 - 1e-6);
  }
  bool inHole(Vec2 at) const {
    size_t edge = view_.polygon().outer.size();
    for (const Ring& hole : view_.polygon().holes) {
      const bool placed = view_.marks()[edge].role == EdgeRole::Hole;
      if (placed && locate(hole, at) == Where::Inside) return true;
      edge += hole.size();
    }
    return false;
  }
  // Pieces without holes, with the edges of the region that they come from.
  static std::vector<RegionPiece> apart(const std::vector<RegionPiece>& pieces) {
    std::vector<RegionPiece> out;
    for (const RegionPiece& p : pieces) {
      for (RegionPiece& part : withoutHoles(p.polygon)) {
        for (EdgeOrigin& e : part.edges) {
          if (e.source != kNoEdge) e = p.edges[e.source];
        }
        out.push_back(std::move(part));
      }
    }
    return out;
  }

  OpCall& call_;
  RegionView& view_;
  PlanFigure figure_;
  bool cut_, split_;
  // Along edges what has no room is left out without a warning.
  bool warnsOfHoles_;
  std::optional<uint32_t> slot_;
  Shape parent_;
  Region holes_;
  uint32_t count_ = 0, nested_ = 0, places_ = 0;
  bool bad_ = false;
};

// Of places that were asked for, those on none of the faces.
uint32_t outsideOf(const RegionJob& job, std::span<const Vec2> places) {
  uint32_t outside = 0;
  for (const Vec2 at : places) {
    work(job.faces().size());
    outside += std::all_of(job.faces().begin(), job.faces().end(), [&](const auto& view) {
      return locate(view->polygon().outer, at) == Where::Outside;
    });
  }
  return outside;
}

// The shape becomes what the figures leave of it. `outside`: places that lie beyond the region.
// `asked`: somebody has said where each figure stands; else the border has, and that none of a few
// has room is no mistake.
void finish(OpCall& call, RegionJob& job, std::span<const Placer> placers, bool asked,
            uint32_t outside = 0) {
  uint32_t nested = 0;
  bool cuts = false;
  for (const Placer& p : placers) {
    nested += p.nested();
    cuts = cuts || p.cuts();
  }
  const bool nothing = placers.empty() || placers.back().count() == 0;
  if (nested > 0) {
    std::string what = "'" + std::string(call.spec().name) + "': " + std::to_string(nested) +
                       (nested == 1 ? " figure was" : " figures were") +
                       " left out, because others stand there";
    const char* const hint = "place them farther apart, or make them smaller";
    if (nothing && asked)
      call.services().warn("place-occupied", std::move(what), hint);
    else
      call.services().note("place-occupied", std::move(what), hint);
  }
  const bool given = nothing && call.giveToOtherwise();
  if (outside > 0 && !given) {
    call.services().warn("place-outside",
                         "'" + std::string(call.spec().name) + "': " + std::to_string(outside) +
                             (outside == 1 ? " place lies" : " places lie") +
                             " outside of the region, where nothing is put",
                         "shares of the sides are 0 to 1; points are metres from the south-western "
                         "corner");
  }
  if (!cuts) return;
  std::vector<std::vector<RegionPiece>> left;
  for (const Placer& p : placers) left.push_back(p.left());
  job.replace(call.shape(), left);
}

Status applyPlace(OpCall& call, const Place& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  // Of several pieces the largest is meant.
  std::vector<Vec2> places;
  const Status status = placesOf(call, args.where, job, job.largest(), places);
  if (!status.ok()) return status;
  std::vector<Placer> placers;
  for (const auto& view : job.faces()) {
    placers.emplace_back(call, *view, args.over, args.split,
                         placers.empty() ? 0 : placers.back().count(), 0);
    for (const Vec2 at : places) {
      placers.back().add(at, args.align ? alongNearest(view->polygon(), at) : Vec2{1, 0});
    }
    if (placers.back().bad()) return badFigure(call);
  }
  finish(call, job, placers, true, outsideOf(job, places));
  return {};
}

// Positions on a line: shares of it, intervals, or a spacing. Lines run counter-clockwise, and
// positions are told clockwise, but for mirrored cells.
Status stationsOf(const OpCall& call, const Distribute& args, bool clockwise, const Polyline& line,
                  std::vector<Station>& out) {
  if (args.at) {
    for (const double s : args.at->array->numbers) {
      if (s >= 0 && s <= 1) out.push_back(stationAt(line, clockwise ? 1 - s : s));
    }
    return {};
  }
  if (args.intervals || args.interval) {
    const double count =
        args.intervals ? *args.intervals : std::round(line.length() / *args.interval);
    if (!(count <= kMostIntervals)) {
      return call.fail("bad-argument", "there can be 1 to 100000 intervals", "write longer ones");
    }
    for (const Station& s :
         evenly(line, static_cast<uint32_t>(std::max(1.0, count)),
                clockwise ? args.end : args.start, clockwise ? args.start : args.end)) {
      out.push_back(s);
    }
    return {};
  }
  for (const Station& s : spaced(line, args.spacing.value_or(1))) out.push_back(s);
  return {};
}

// The same on lines that count as one, whose lengths follow each other.
Status stationsOnChain(const OpCall& call, const Distribute& args, bool clockwise,
                       std::span<const Polyline> lines, std::vector<Station>& out) {
  // A straight line of the whole length has the stations, and each lies on one of the lines.
  Polyline straight{{{0, 0}, {0, 0}}, false};
  for (const Polyline& line : lines) straight.points[1].x += line.length();
  if (!(straight.points[1].x > 0)) return {};
  std::vector<Station> flat;
  const Status status = stationsOf(call, args, clockwise, straight, flat);
  for (const Station& s : flat) {
    work(1 + lines.size());
    double along = s.at.x;
    size_t k = 0;
    while (k + 1 < lines.size() && along > lines[k].length()) along -= lines[k++].length();
    out.push_back(stationAt(lines[k], along / lines[k].length()));
  }
  return status;
}

// What two edges place beside their common corner stands between both, once, whichever edge comes
// first. O(n^2).
void mergeNear(std::vector<Station>& stations, double distance) {
  std::vector<Station> out;
  for (const Station& s : stations) {
    work(1 + out.size());
    const auto near = std::find_if(
        out.begin(), out.end(), [&](const Station& o) { return length(o.at - s.at) < distance; });
    if (near == out.end()) {
      out.push_back(s);
    } else {
      near->at = (near->at + s.at) * 0.5;
    }
  }
  stations = std::move(out);
}

// Stations along the selected edges of a face, `inset` inside of them.
Status stationsAlong(OpCall& call, const Distribute& args, const RegionJob& job, size_t face,
                     std::vector<Station>& out) {
  const RegionView& view = *job.faces()[face];
  const std::vector<EdgePart> parts = selected(call, args.selection, job, face);
  std::vector<uint32_t> group;
  for (const EdgeMark& m : view.marks()) group.push_back(m.logical);
  std::vector<Polyline> lines =
      runsOf(view.polygon(), parts, args.chain ? std::vector<uint32_t>{} : group);
  const bool mirrored = view.cell() && view.logicalCount() == 4 &&
                        view.cell()->mirroredX() != view.cell()->mirroredY();
  Status status;
  if (args.chain) {
    status = stationsOnChain(call, args, !mirrored, lines, out);
  } else {
    for (const Polyline& line : lines) {
      if (status.ok()) status = stationsOf(call, args, !mirrored, line, out);
    }
  }
  for (Station& s : out) s.at = s.at + perpendicular(s.along) * args.inset;
  return status;
}

Status applyDistribute(OpCall& call, const Distribute& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  const int ways = (args.spacing ? 1 : 0) + (args.at ? 1 : 0) + (args.intervals ? 1 : 0) +
                   (args.interval ? 1 : 0);
  if (ways > 1) {
    return call.fail("bad-argument", "places are given in more than one way",
                     "write one of spacing, at, intervals and interval");
  }
  const bool exact = !args.at && !args.intervals && !args.interval;
  const double spacing = exact ? args.spacing.value_or(1) : 0;
  std::vector<Placer> placers;
  for (size_t f = 0; f < job.faces().size(); ++f) {
    placers.emplace_back(call, *job.faces()[f], args.over, args.split,
                         placers.empty() ? 0 : placers.back().count(),
                         placers.empty() ? 0 : placers.back().places());
    std::vector<Station> stations;
    const Status status = stationsAlong(call, args, job, f, stations);
    if (!status.ok()) return status;
    mergeNear(stations, std::max(1e-6, spacing / 4));
    for (const Station& s : stations) placers.back().add(s.at, s.along);
    if (placers.back().bad()) return badFigure(call);
  }
  finish(call, job, placers, false);
  return {};
}

constexpr ParamSpec kCornerOf[] = {
    {"edges", ParamType::Selection,
     "A number, clockwise from the south-west, where logical edge i begins; or the edges that the "
     "corners lie between: corner(outer)."}};
constexpr ParamSpec kAddress[] = {
    {"u", ParamType::Float, "From 0 in the west to 1 in the east."},
    {"v", ParamType::Float, "From 0 in the south to 1 in the north."}};
constexpr ParamSpec kCorner[] = {[] {
  ParamSpec p = kCornerOf[0];
  p.terms = kEdgeTerms;
  return p;
}()};
constexpr TermSpec kPlaces[] = {
    {"centre", "The middle; of a region that is not convex, the place farthest from its boundary."},
    {.name = "center", .doc = "The middle."},
    {"centroid", "The centre of mass, which may lie outside."},
    {"corners", "All corners."},
    TermSpec::call("corner", "A corner, or those between edges.", kCorner),
    TermSpec::call("at", "In shares of the sides; mirrored with the cell.", kAddress),
    TermSpec::call("point", "In metres from the south-west.", site_terms::kPoint),
};

constexpr const char* kOver = "The figure is not cut out of the region.";
constexpr const char* kSplit = "The region is cut apart, so that it gets no holes.";
constexpr const char* kAlign = "x runs along the nearest edge.";
constexpr ParamSpec kPlace[] = {
    selection<&Place::where>("where", "Places, with || between several.", kPlaces, "centre"),
    param<&Place::over>("over", kOver, "false"), param<&Place::split>("split", kSplit, "false"),
    param<&Place::align>("align", kAlign, "false")};
constexpr ParamSpec kDistribute[] = {
    selection<&Distribute::selection>("selection", "The edges, as in peel.", kEdgeTerms, "all"),
    param<&Distribute::spacing>("spacing", "Metres between them, kept exactly.", "1").above(0),
    param<&Distribute::inset>("inset", "How far inside the edge.", "0"),
    param<&Distribute::at>("at", "Shares of the edge's length, clockwise: [0.2, 0.8].", "none")
        .between(0, 1),
    param<&Distribute::intervals>("intervals", "How many equal parts; one at each joint.", "none")
        .between(1, kMostIntervals),
    param<&Distribute::interval>("interval", "About how long these parts are.", "none").above(0),
    param<&Distribute::start>("start", "One where the edge begins as well.", "false"),
    param<&Distribute::end>("end", "One where the edge ends as well.", "false"),
    param<&Distribute::over>("over", kOver, "false"),
    param<&Distribute::split>("split", kSplit, "false"),
    param<&Distribute::chain>("chain", "The selected edges count as one.", "false")};
constexpr Signature kPlaceSignatures[] = {{kPlace}};
constexpr Signature kDistributeSignatures[] = {{kDistribute}};

constexpr OpSpec kSpecs[] = {
    withFigures(
        {"place", "region",
         "Puts something at a place of a region, and cuts out the figure that it begins "
         "with.",
         kPlaceSignatures, typed<applyPlace>, BlockKind::Operations,
         kReadsRegion | kRandom | kReadsWorld | kReadsWorldByWord, kOtherwiseOnly, false, true},
        "", kRegionChoice),
    withFigures(
        {"distribute", "region",
         "Puts things along edges of a region, and cuts out the figures that they begin "
         "with.",
         kDistributeSignatures, typed<applyDistribute>, BlockKind::Operations,
         kReadsRegion | kRandom | kReadsWorld | kReadsWorldByWord, kOtherwiseOnly, false, true},
        "", kRegionChoice),
};

}  // namespace

extern const OpList kOps_place;
const OpList kOps_place = kSpecs;

}  // namespace gable
