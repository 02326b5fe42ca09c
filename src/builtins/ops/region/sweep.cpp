// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines along a boundary, as ribbons of a width or as bare segments.
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/profile_sweep.h"

namespace gable {

namespace {

Status checked(const OpCall& call, double inset) {
  if (std::isfinite(inset) && inset >= 0) return {};
  return call.fail("bad-argument", "an inset is zero or more metres", "write 0 or leave it out");
}

struct SweepOptions {
  double width = 0, height = 0;
  RibbonOptions ribbon;
  std::optional<Profile> profile;
};

// A name, or points in shares: "(0,0)(0,1)(1,0.6)(1,0)".
bool readProfile(std::string_view text, std::optional<Profile>& out) {
  out = profileNamed(text);
  if (out) return true;
  std::vector<Disc> points;
  if (!readPoints(text, points)) return false;
  out.emplace();
  for (const Disc& d : points) out->push_back(d.centre);
  return isProfile(*out);
}

Status optionsOf(const OpCall& call, SweepOptions& o) {
  o.width = call.number(1);
  if (!(o.width >= 0) || !std::isfinite(o.width)) {
    return call.fail("bad-argument", "a ribbon cannot be " + shortestText(o.width) + " wide",
                     "write a width above zero, or 0 for bare lines");
  }
  const Status status = optionsAre(
      call, 3, "round joins=mitre|miter|round ends=butt|square|round height=# profile=*");
  if (!status.ok()) return status;
  const std::string options = textOf(call, 3, "");
  if (!option(options, "round").empty()) o.ribbon = {true, RibbonEnds::Round};
  if (option(options, "joins") == "round") o.ribbon.roundJoins = true;
  const std::string ends = option(options, "ends"), profile = option(options, "profile");
  if (ends == "round") o.ribbon.ends = RibbonEnds::Round;
  if (ends == "square") o.ribbon.ends = RibbonEnds::Square;
  parseNumber(option(options, "height"), o.height);
  if (profile.empty()) {
    if (o.height > 0) o.profile = profileNamed("box");
  } else if (!readProfile(profile, o.profile)) {
    return call.fail("bad-argument", "'" + profile + "' is no cross-section",
                     "write box, batter, gable, round, dome, kerb, or points from x = 0 to 1 "
                     "without blanks: profile=(0,0)(0,1)(1,0.6)(1,0)");
  } else if (!(o.height > 0)) {
    o.height = o.width;
  }
  if (o.profile && !(o.width > 0)) {
    return call.fail("bad-argument", "a cross-section needs a width above zero",
                     "write how wide the volume is");
  }
  return {};
}

Status applySweep(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  SweepOptions o;
  const double inset = call.number(2, 0);
  Status status = checked(call, inset);
  if (status.ok()) status = optionsOf(call, o);
  if (!status.ok()) return status;
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  const auto give = [&](Shape child) {
    if (slot) call.emit(std::move(child), *slot, piece);
    ++piece;
  };
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Polyline> lines;
    status = linesOf(call, 0, inset, job, f, view, lines);
    if (!status.ok()) return status;
    if (!(o.width > 0) || o.profile) {
      for (const Polyline& line : lines) {
        if (line.points.size() < 2) continue;
        if (!o.profile) {
          give(view.lineOf(call.shape(), line.points, line.closed));
          continue;
        }
        Mesh mesh =
            sweptProfile(view.polygon(), line, o.width, o.height, *o.profile, o.ribbon.ends);
        if (mesh.faceCount() == 0) continue;
        give(view.solidOf(call.shape(), std::move(mesh), line.points[1] - line.points[0]));
      }
      continue;
    }
    for (const RegionPiece& p : ribbons(view.polygon(), lines, o.width, o.ribbon)) {
      give(view.shapeOf(call.shape(), p, view.marksOf(p, EdgeIndex::Outline), std::nullopt));
    }
  }
  if (piece == 0) giveToOtherwise(call);
  return {};
}

Status applyParametrise(OpCall& call) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  const double inset = call.number(1, 0);
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  for (size_t f = 0; f < job.faces().size(); ++f) {
    const RegionView& view = *job.faces()[f];
    std::vector<Polyline> lines;
    Status status = checked(call, inset);
    if (status.ok()) status = linesOf(call, 0, inset, job, f, view, lines);
    if (!status.ok()) return status;
    for (const Polyline& line : lines) {
      const size_t n = line.points.size();
      for (size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
        if (slot) {
          call.emit(view.segmentAt(call.shape(), line.points[i], line.points[(i + 1) % n]), *slot,
                    piece);
        }
        ++piece;
      }
    }
  }
  if (piece == 0) giveToOtherwise(call);
  return {};
}

constexpr ParamSpec kLines = {
    "lines", ParamType::Selector,
    "A selection of edges as in peel, or ranges along the logical edges from 0 on: "
    "\"[0.02,1] [0,1] [0,0.15]\", [] for none, _ for a whole edge; several of both with ; "
    "between."};
constexpr ParamSpec kInset = {"inset", ParamType::Float, "How far inside the boundary.", "0"};
constexpr ParamSpec kSweep[] = {
    kLines,
    {"width", ParamType::Float, "Of the ribbon, in metres; 0 for bare lines."},
    kInset,
    {"options", ParamType::String,
     "joins=mitre|round, ends=butt|square|round; round: both. height=1.2 makes volumes of that "
     "height, profile=box|batter|gable|round|dome|kerb gives them a cross-section, or points in "
     "shares of width and height: profile=(0,0)(0,1)(1,0.6)(1,0).",
     "\"\""}};
constexpr ParamSpec kParametrise[] = {kLines, kInset};
constexpr Signature kSweepSignatures[] = {{kSweep}};
constexpr Signature kParametriseSignatures[] = {{kParametrise}};

constexpr OpSpec kSpecs[] = {
    {"sweep", "region", "Makes ribbons of a width along the boundary of a region.",
     kSweepSignatures, applySweep, BlockKind::Operations, kRandom | kReadsWorld | kReadsWorldByWord,
     "otherwise", false, true},
    {"parametrise", "region", "Gives out parts of the boundary as straight lines.",
     kParametriseSignatures, applyParametrise, BlockKind::Operations,
     kRandom | kReadsWorld | kReadsWorldByWord, "otherwise", false, true},
};

}  // namespace

extern const OpList kOps_sweep;
const OpList kOps_sweep = kSpecs;

}  // namespace gable
