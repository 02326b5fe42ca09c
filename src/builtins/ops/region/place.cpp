// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Things put into a region: at one place, or along edges. The region goes on after them, less what
// was cut out of it.
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/autoindex.h"

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

// Where a text says; false when the pattern of the cell places nothing here.
Status placeOf(OpCall& call, const RegionView& view, std::string_view text, bool& here, Vec2& at) {
  TextReader r(text);
  here = true;
  if (r.accept('(')) {
    double u = 0, v = 0;
    if (r.number(u) && r.accept(',') && r.number(v) && r.accept(')') && r.atEnd()) {
      if (view.cell()) here = view.cell()->along(false, u) && view.cell()->along(true, v);
      const Quad q = cornersOf(view);
      const Vec2 low = q[0] + (q[1] - q[0]) * u, high = q[3] + (q[2] - q[3]) * u;
      at = low + (high - low) * v;
      return {};
    }
  }
  const std::string w = r.word();
  if ((w == "centre" || w == "center") && r.atEnd()) {
    at = middleOf(view.polygon());
    return {};
  }
  if (w == "centroid" && r.atEnd()) {
    at = centroid(view.polygon());
    return {};
  }
  double i = 0;
  if (w == "corner" && r.accept('(') && r.number(i) && r.accept(')')) {
    // Clockwise from the south-west.
    static constexpr size_t kOrder[] = {0, 3, 2, 1};
    at = cornersOf(view)[kOrder[static_cast<size_t>(std::fmod(std::clamp(i, 0.0, 1e6), 4))]];
    return {};
  }
  return call.fail("bad-argument", "'" + std::string(text) + "' is no place of a region",
                   "write centre, centroid, corner(0) or \"(0.8, 0.1)\"");
}

// Gives out a point, or a figure there, which is cut out of the region.
class Placer {
 public:
  Placer(OpCall& call, RegionView& view, PlanFigure figure, bool cut)
      : call_(call), view_(view), figure_(figure), cut_(cut), parent_(call.shape()) {}

  void add(Vec2 at, Vec2 along) {
    if (!contains(view_.polygon(), at)) return;
    if (figure_.shape == PlanShape::None) {
      call_.emit(view_.pointAt(parent_, at, along), 0, count_++);
      return;
    }
    const Region ring{{ringOf(figure_, at, along), {}}};
    const EdgeOrigin made{kNoEdge, EdgeRole::Cut, EdgeOrigin::kNoSide};
    for (RegionPiece& p :
         combineTraced(BooleanOp::Intersection, wholePiece(view_.polygon()), ring, made)) {
      p.axis = along;
      call_.emit(view_.shapeOf(parent_, p, view_.marksOf(p, false, true), std::nullopt), 0,
                 count_++);
    }
    holes_.push_back(ring[0]);
  }

  void finish() {
    if (!cut_ || holes_.empty()) return;
    const Region together =
        holes_.size() > 1 ? repaired(ringsOf(holes_), FillRule::NonZero) : holes_;
    const EdgeOrigin made{kNoEdge, EdgeRole::Hole, EdgeOrigin::kNoSide};
    const std::vector<RegionPiece> left =
        combineTraced(BooleanOp::Difference, wholePiece(view_.polygon()), together, made);
    if (!left.empty()) view_.replace(call_.shape(), left);
  }

 private:
  OpCall& call_;
  RegionView& view_;
  PlanFigure figure_;
  bool cut_;
  Shape parent_;
  Region holes_;
  uint32_t count_ = 0;
};

Status oneFace(OpCall& call, const RegionJob& job) {
  if (job.faces().size() == 1) return {};
  return call.fail("no-geometry", "the shape is not one face",
                   "take it apart first: comp(f) { all : ... }");
}

Status figureOf(OpCall& call, size_t argument, PlanFigure& figure) {
  const std::string text = textOf(call, argument, "");
  std::string problem;
  if (text.empty() || text == "none" || readFigure(text, figure, problem)) return {};
  return call.fail("bad-argument", problem,
                   "write romb(r), circle(r), square(a), rect(a, b) or polygon(n, r)");
}

Status applyPlace(OpCall& call) {
  RegionJob job(call);
  Status status = oneFace(call, job);
  PlanFigure figure;
  if (status.ok()) status = figureOf(call, 1, figure);
  if (!status.ok()) return status;
  RegionView& view = *job.faces()[0];
  bool here = true;
  Vec2 at;
  status = placeOf(call, view, textOf(call, 0, "centre"), here, at);
  if (!status.ok() || !here) return status;
  Placer placer(call, view, figure, option(textOf(call, 2, ""), "over").empty());
  placer.add(at, {1, 0});
  placer.finish();
  return {};
}

// Positions on a line: "[0.1, 0.5]", "[3]", "[start : 2.5 : end]", or a spacing.
Status stationsOf(const OpCall& call, std::string_view text, const Polyline& line,
                  std::vector<Station>& out) {
  double spacing = 0;
  if (parseNumber(text, spacing)) {
    out = spaced(line, spacing);
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
  out = evenly(line, static_cast<uint32_t>(std::max(1.0, count)), start, end);
  return {};
}

// What two edges place beside their common corner stands between both, once, whichever edge comes
// first. O(n^2).
void mergeNear(std::vector<Station>& stations, double distance) {
  std::vector<Station> out;
  for (const Station& s : stations) {
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

Status applyDistribute(OpCall& call) {
  RegionJob job(call);
  Status status = oneFace(call, job);
  PlanFigure figure;
  if (status.ok()) status = figureOf(call, 3, figure);
  if (!status.ok()) return status;
  RegionView& view = *job.faces()[0];
  std::vector<EdgePart> parts;
  status = selected(call, 0, "all", job, 0, view, parts);
  if (!status.ok()) return status;
  std::vector<uint32_t> group;
  for (const EdgeMark& m : view.marks()) group.push_back(m.logical);
  const double inset = call.number(2, 0);
  Placer placer(call, view, figure, option(textOf(call, 4, ""), "over").empty());
  std::vector<Station> all;
  for (const Polyline& line : runsOf(view.polygon(), parts, group)) {
    std::vector<Station> stations;
    status = stationsOf(call, textOf(call, 1, "1"), line, stations);
    if (!status.ok()) return status;
    for (const Station& s : stations)
      all.push_back({s.at + perpendicular(s.along) * inset, s.along});
  }
  double spacing = 0;
  if (!parseNumber(textOf(call, 1, "1"), spacing)) spacing = 0;
  mergeNear(all, std::max(1e-6, spacing / 4));
  for (const Station& s : all) placer.add(s.at, s.along);
  placer.finish();
  return {};
}

constexpr ParamSpec kFigure = {
    "figure", ParamType::Any,
    "A figure that is cut out of the region and given out, as \"circle(1)\"; without one a point "
    "is given out.",
    "\"none\""};
constexpr ParamSpec kOptions = {"options", ParamType::String,
                                "over: the figure is not cut out of the region.", "\"\""};
constexpr ParamSpec kPlace[] = {
    {"where", ParamType::Selector,
     "centre (of a region that is not convex: the place farthest from its boundary), centroid, "
     "corner(i) clockwise from the south-west, or \"(u, v)\" in shares of the sides."},
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
     BlockKind::Operations, kPure, nullptr, false, true},
    {"distribute", "region", "Puts things along edges of a region.", kDistributeSignatures,
     applyDistribute, BlockKind::Operations, kRandom | kReadsWorld | kReadsWorldByWord, nullptr,
     false, true},
};

}  // namespace

extern const OpList kOps_place;
const OpList kOps_place = kSpecs;

}  // namespace gable
