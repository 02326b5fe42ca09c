// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Things put into a region: at one place, or along edges. The region goes on after them, less what
// was cut out of it.
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/autoindex.h"
#include "geom/region/cut_holes.h"
#include "geom/region/segment_grid.h"
#include "math/trig.h"

namespace gable {

namespace {

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
Status cornersBetween(OpCall& call, const RegionJob& job, size_t face, std::string_view selection,
                      std::vector<Vec2>& out) {
  const RegionView& view = *job.faces()[face];
  const Ring& r = view.polygon().outer;
  std::vector<EdgePart> parts;
  std::string problem;
  const SelectionInput input{view, call.randomAddress(1000 + face), job.worldIn(face)};
  if (!selectEdges(selection, input, parts, problem)) {
    return call.fail("bad-selection", "the selection cannot be read: " + problem,
                     "write corner(0) or corner(outer)");
  }
  std::vector<bool> begins(r.size(), false), ends(r.size(), false);
  for (const EdgePart& e : parts) {
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
  return {};
}

// Where a text says; nothing when the pattern of the cell places nothing here.
Status placesOf(OpCall& call, const RegionJob& job, size_t face, std::string_view text,
                std::vector<Vec2>& out) {
  const RegionView& view = *job.faces()[face];
  TextReader r(text);
  if (r.peek() == '(') {
    const Quad q = cornersOf(view);
    bool read = true;
    while (read && r.accept('(')) {
      double u = 0, v = 0;
      read = r.number(u) && r.accept(',') && r.number(v) && r.accept(')');
      r.accept(',');
      if (!read || (view.cell() && !view.cell()->address(u, v))) continue;
      const Vec2 low = q[0] + (q[1] - q[0]) * u, high = q[3] + (q[2] - q[3]) * u;
      out.push_back(low + (high - low) * v);
    }
    if (read && r.atEnd()) return {};
  }
  const std::string w = r.word();
  if ((w == "centre" || w == "center") && r.atEnd()) {
    out.push_back(middleOf(view.polygon()));
    return {};
  }
  if (w == "centroid" && r.atEnd()) {
    out.push_back(centroid(view.polygon()));
    return {};
  }
  if (w == "corners") {
    // As the notation's corners(region) has it.
    if (r.accept('(') && !(r.word() == "region" && r.accept(')'))) r.goTo(0);
    for (uint32_t k = 0; r.atEnd() && k < view.logicalCount(); ++k) {
      const Vec2 at = logicalCorner(view, k);
      if (std::find(out.begin(), out.end(), at) == out.end()) out.push_back(at);
    }
    if (!out.empty()) return {};
  }
  if (std::vector<Disc> points; w == "points" && readPoints(text, points)) {
    for (const Disc& d : points) out.push_back(d.centre + bounds(view.polygon()).min);
    return {};
  }
  if (w == "corner" && r.accept('(')) {
    const size_t inside = r.place();
    double i = 0;
    if (r.number(i) && r.accept(')') && r.atEnd()) {
      const double count = std::max(1u, view.logicalCount());
      const auto k = static_cast<uint32_t>(
          std::fmod(std::fmod(std::clamp(std::floor(i), -1e6, 1e6), count) + count, count));
      if (!hasFourSides(view)) {
        out.push_back(logicalCorner(view, k));
        return {};
      }
      // Clockwise from the south-west.
      static constexpr size_t kOrder[] = {0, 3, 2, 1};
      // Corner k begins side k; of a mirrored cell it ends the image of side k.
      uint32_t corner = k;
      if (view.cell()) {
        const uint32_t side = view.cell()->side(k), next = view.cell()->side((k + 1) % 4);
        corner = next == (side + 1) % 4 ? side : (side + 1) % 4;
      }
      out.push_back(cornersOf(view)[kOrder[corner]]);
      return {};
    }
    const size_t close = text.rfind(')');
    if (close != std::string_view::npos && close > inside) {
      return cornersBetween(call, job, face, text.substr(inside, close - inside), out);
    }
  }
  return call.fail("bad-argument", "'" + std::string(text) + "' is no place of a region",
                   "write centre, centroid, corners, corner(0), corner(outer), \"(0.8, 0.1)\" in "
                   "shares of the sides or \"points((3, 4))\" in metres");
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
  Placer(OpCall& call, RegionView& view, PlanFigure figure, const std::string& options,
         uint32_t count = 0)
      : call_(call),
        view_(view),
        figure_(figure),
        cut_(option(options, "over").empty()),
        split_(!option(options, "split").empty()),
        warnsOfHoles_(std::string_view(call.spec().name) == "place"),
        slot_(thingSlot(call)),
        parent_(call.shape()),
        count_(count) {}

  void add(Vec2 at, Vec2 along) {
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
    for (RegionPiece& p :
         combineTraced(BooleanOp::Intersection, wholePiece(view_.polygon()), ring, made)) {
      p.axis = along;
      if (slot_) {
        call_.emit(view_.shapeOf(parent_, p, view_.marksOf(p, EdgeIndex::Outline), std::nullopt),
                   *slot_, count_);
      }
      ++count_;
    }
    holes_.push_back(ring[0]);
  }

  /// How many were given out on this face and those before it, and how many found no place.
  uint32_t count() const { return count_; }
  uint32_t nested() const { return nested_; }
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
  // Along edges what has no room is left out without a word.
  bool warnsOfHoles_;
  std::optional<uint32_t> slot_;
  Shape parent_;
  Region holes_;
  uint32_t count_ = 0, nested_ = 0;
};

// The shape becomes what the figures leave of it.
void finish(OpCall& call, RegionJob& job, std::span<const Placer> placers) {
  uint32_t nested = 0;
  bool cuts = false;
  for (const Placer& p : placers) {
    nested += p.nested();
    cuts = cuts || p.cuts();
  }
  if (nested > 0) {
    call.services().warn("place-occupied",
                         "'" + std::string(call.spec().name) + "': " + std::to_string(nested) +
                             " figures were left out, because others stand there",
                         "place them farther apart, or make them smaller");
  }
  if (placers.empty() || placers.back().count() == 0) giveToOtherwise(call);
  if (!cuts) return;
  std::vector<std::vector<RegionPiece>> left;
  for (const Placer& p : placers) left.push_back(p.left());
  job.replace(call.shape(), left);
}

Status figureOf(OpCall& call, size_t argument, PlanFigure& figure) {
  const std::string text = textOf(call, argument, "");
  std::string problem;
  if (text.empty() || text == "none" || readFigure(text, figure, problem)) return {};
  return call.fail("bad-argument", problem,
                   "write romb(r), circle(r), square(a), rect(a, b) or polygon(n, r)");
}

constexpr std::string_view kFlags = "over split align chain";

Status applyPlace(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  PlanFigure figure;
  Status status = figureOf(call, 1, figure);
  if (status.ok()) status = optionsAre(call, 2, "over split align");
  if (!status.ok()) return status;
  // Of several pieces the largest is meant.
  const size_t largest = job.largest();
  std::vector<Vec2> places;
  status = placesOf(call, job, largest, textOf(call, 0, "centre"), places);
  if (!status.ok()) return status;
  const std::string options = textOf(call, 2, "");
  const bool align = !option(options, "align").empty();
  std::vector<Placer> placers;
  for (const auto& view : job.faces()) {
    placers.emplace_back(call, *view, figure, options,
                         placers.empty() ? 0 : placers.back().count());
    for (const Vec2 at : places) {
      placers.back().add(at, align ? alongNearest(view->polygon(), at) : Vec2{1, 0});
    }
  }
  finish(call, job, placers);
  return {};
}

// Positions on a line: "[0.1, 0.5]", "[3]", "[start : 2.5 : end]", or a spacing.
Status stationsOf(const OpCall& call, std::string_view text, const Polyline& line,
                  std::vector<Station>& out) {
  double spacing = 0;
  if (parseNumber(text, spacing)) {
    for (const Station& s : spaced(line, spacing)) out.push_back(s);
    return {};
  }
  const Status bad = call.fail("bad-argument", "these are no positions along an edge",
                               "write a spacing, \"[0.2, 0.8]\" or \"[start : 2.5 : end]\"");
  TextReader r(text);
  if (!r.accept('[')) return bad;
  const size_t begin = r.place();
  const bool start = r.word() == "start";
  if (!start) r.goTo(begin);
  const bool colon = r.accept(':');
  const size_t itemAt = r.place();
  double item = 0;
  if (!r.number(item)) return bad;
  if (!start && !colon && r.peek() != ']') {
    std::vector<double> shares{item};
    while (r.accept(',')) {
      if (!r.number(item)) return bad;
      shares.push_back(item);
    }
    if (!r.accept(']')) return bad;
    for (const double s : shares) {
      if (s >= 0 && s <= 1) out.push_back(stationAt(line, s));
    }
    return {};
  }
  const std::string_view written = text.substr(itemAt, r.place() - itemAt);
  bool end = false;
  if (r.accept(':')) end = r.word() == "end";
  if (!r.accept(']')) return bad;
  const bool real = written.find('.') != std::string_view::npos;
  double count = real ? std::round(line.length() / item) : item;
  if (!(count <= 100000)) return bad;
  for (const Station& s : evenly(line, static_cast<uint32_t>(std::max(1.0, count)), start, end)) {
    out.push_back(s);
  }
  return {};
}

// The same on lines that count as one, whose lengths follow each other.
Status stationsOnChain(const OpCall& call, std::string_view text, std::span<const Polyline> lines,
                       std::vector<Station>& out) {
  // A straight line of the whole length has the stations, and each lies on one of the lines.
  Polyline straight{{{0, 0}, {0, 0}}, false};
  for (const Polyline& line : lines) straight.points[1].x += line.length();
  if (!(straight.points[1].x > 0)) return {};
  std::vector<Station> flat;
  const Status status = stationsOf(call, text, straight, flat);
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
Status stationsAlong(OpCall& call, const RegionJob& job, size_t face, double inset, bool chain,
                     std::vector<Station>& out) {
  const RegionView& view = *job.faces()[face];
  std::vector<EdgePart> parts;
  Status status = selected(call, 0, "all", job, face, view, parts);
  if (!status.ok()) return status;
  std::vector<uint32_t> group;
  for (const EdgeMark& m : view.marks()) group.push_back(m.logical);
  std::vector<Polyline> lines =
      runsOf(view.polygon(), parts, chain ? std::vector<uint32_t>{} : group);
  const std::string positions = textOf(call, 1, "1");
  if (chain) {
    status = stationsOnChain(call, positions, lines, out);
  } else {
    for (const Polyline& line : lines) {
      if (status.ok()) status = stationsOf(call, positions, line, out);
    }
  }
  for (Station& s : out) s.at = s.at + perpendicular(s.along) * inset;
  return status;
}

Status applyDistribute(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  if (!job.flat()) return noOneRegion(call);
  PlanFigure figure;
  Status status = figureOf(call, 3, figure);
  if (status.ok()) status = optionsAre(call, 4, kFlags);
  if (!status.ok()) return status;
  const double inset = call.number(2, 0);
  const std::string options = textOf(call, 4, "");
  double spacing = 0;
  if (!parseNumber(textOf(call, 1, "1"), spacing)) spacing = 0;
  std::vector<Placer> placers;
  for (size_t f = 0; f < job.faces().size(); ++f) {
    placers.emplace_back(call, *job.faces()[f], figure, options,
                         placers.empty() ? 0 : placers.back().count());
    std::vector<Station> stations;
    status = stationsAlong(call, job, f, inset, !option(options, "chain").empty(), stations);
    if (!status.ok()) return status;
    mergeNear(stations, std::max(1e-6, spacing / 4));
    for (const Station& s : stations) placers.back().add(s.at, s.along);
  }
  finish(call, job, placers);
  return {};
}

constexpr ParamSpec kFigure = {
    "figure", ParamType::Any,
    "A figure that is cut out of the region and given out, as \"circle(1)\"; without one a point "
    "is given out.",
    "\"none\""};
constexpr ParamSpec kOptions = {
    "options", ParamType::String,
    "over: the figure is not cut out of the region; split: the region is cut apart "
    "so that it gets no holes; align: x runs along the nearest edge; chain (of distribute): the "
    "selected edges count as one, so that positions are shares of their length together.",
    "\"\""};
constexpr ParamSpec kPlace[] = {
    {"where", ParamType::Selector,
     "centre (of a region that is not convex: the place farthest from its boundary), centroid, "
     "corners, corner(i) clockwise from the south-west, where logical edge i begins, "
     "corner(selection) between selected edges, \"(u, v)\" in shares of the sides, also several, "
     "or "
     "\"points((3, 4) (9, 4))\" in metres from the south-west."},
    kFigure,
    kOptions};
constexpr ParamSpec kDistribute[] = {
    {"selection", ParamType::Selector, "The edges; words as in peel."},
    {"positions", ParamType::Any,
     "A spacing in metres, kept exactly, or a text: \"[0.2, 0.8]\" shares of the edge, \"[3]\" "
     "intervals, \"[start : 2.5 : end]\" intervals of about that length with the ends."},
    {"inset", ParamType::Float, "How far inside the edge.", "0"},
    kFigure,
    kOptions};
constexpr Signature kPlaceSignatures[] = {{kPlace}};
constexpr Signature kDistributeSignatures[] = {{kDistribute}};

constexpr OpSpec kSpecs[] = {
    {"place", "region", "Puts something at a place of a region.", kPlaceSignatures, applyPlace,
     BlockKind::Operations, kRandom | kReadsWorld | kReadsWorldByWord, "otherwise", false, true},
    {"distribute", "region", "Puts things along edges of a region.", kDistributeSignatures,
     applyDistribute, BlockKind::Operations, kRandom | kReadsWorld | kReadsWorldByWord, "otherwise",
     false, true},
};

}  // namespace

extern const OpList kOps_place;
const OpList kOps_place = kSpecs;

}  // namespace gable
