// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lines along a boundary, as ribbons of a width or as bare segments.
#include <cmath>

#include "base/number.h"
#include "builtins/lists.h"
#include "builtins/ops/region/shared/region_job.h"
#include "geom/region/boolean.h"
#include "geom/region/profile_sweep.h"

namespace gable {

enum class Joins : uint8_t { Mitre, Round };

template <>
struct WordsOf<Joins> {
  static constexpr const char* text = "mitre round";
};
template <>
struct WordsOf<RibbonEnds> {
  static constexpr const char* text = "butt square round";
};

namespace {

struct Sweep {
  Selection lines;
  double width = 0, inset = 0;
  Joins joins = Joins::Mitre;
  RibbonEnds ends = RibbonEnds::Butt;
  double height = 0;
  Selection profile;
  bool cut = false;
};

// The cross-section and the height of a volume; none for flat ribbons and bare lines.
struct Section {
  std::optional<Profile> profile;
  double height = 0;
};

Status sectionOf(const OpCall& call, const Sweep& args, Section& out) {
  out.height = args.height;
  const std::vector<Term> terms = termsOf(args.profile, call.services(), call.randomAddress(901));
  const Term* t = terms.size() == 1 ? &terms[0] : nullptr;
  const bool none = !t || t->is("none");
  if (none) {
    if (out.height > 0) out.profile = profileNamed("box");
  } else if (t->kind == ArgumentTerm::Kind::Term) {
    out.profile = profileNamed(t->name);
  } else if (t->values[0].type == ValueType::FloatArray) {
    const Array& points = call.services().pool().array(t->values[0]);
    out.profile.emplace();
    for (size_t i = 0; points.columns == 2 && i + 1 < points.numbers.size(); i += 2) {
      out.profile->push_back({points.numbers[i], points.numbers[i + 1]});
    }
  }
  if (!none && (!out.profile || !isProfile(*out.profile))) {
    return call.fail("bad-argument", "this is no cross-section",
                     "write box, batter, gable, round, dome, kerb, or points from x = 0 to 1: "
                     "[0, 0; 0, 1; 1, 0.6; 1, 0]");
  }
  if (!none && !(out.height > 0)) out.height = args.width;
  if (out.profile && !(args.width > 0)) {
    return call.fail("bad-argument", "a cross-section needs a width above zero",
                     "write how wide the volume is");
  }
  return {};
}

Status applySweep(OpCall& call, const Sweep& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  Section section;
  Status status = sectionOf(call, args, section);
  if (!status.ok()) return status;
  const bool flat = args.width > 0 && !section.profile;
  if (flat && args.cut && !job.flat()) return noOneRegion(call);
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  const auto give = [&](Shape child) {
    if (slot) call.emit(std::move(child), *slot, piece);
    ++piece;
  };
  std::vector<std::vector<RegionPiece>> left;
  for (size_t f = 0; f < job.faces().size(); ++f) {
    RegionView& view = *job.faces()[f];
    std::vector<Polyline> lines;
    status = linesOf(call, args.lines, args.inset, job, f, lines);
    if (!status.ok()) return status;
    if (!flat) {
      for (const Polyline& line : lines) {
        if (line.points.size() < 2) continue;
        if (!section.profile) {
          give(view.lineOf(call.shape(), line.points, line.closed));
          continue;
        }
        Mesh mesh = sweptProfile(view.polygon(), line, args.width, section.height, *section.profile,
                                 args.ends);
        if (mesh.faceCount() == 0) continue;
        give(view.solidOf(call.shape(), std::move(mesh), line.points[1] - line.points[0]));
      }
      continue;
    }
    const RibbonOptions ribbon{args.joins == Joins::Round, args.ends};
    Region taken;
    for (const RegionPiece& p : ribbons(view.polygon(), lines, args.width, ribbon)) {
      taken.push_back(p.polygon);
      give(view.shapeOf(call.shape(), p, view.marksOf(p, EdgeIndex::Outline), std::nullopt));
    }
    if (!args.cut) continue;
    const EdgeOrigin made{kNoEdge, EdgeRole::Hole, EdgeOrigin::kNoSide};
    left.push_back(combineTraced(BooleanOp::Difference, wholePiece(view.polygon()), taken, made));
  }
  if (piece == 0) {
    call.giveToOtherwise();
  } else if (flat && args.cut) {
    job.replace(call.shape(), left);
  }
  return {};
}

struct Parametrise {
  Selection lines;
  double inset = 0;
};

Status applyParametrise(OpCall& call, const Parametrise& args) {
  RegionJob job(call);
  if (job.empty()) return noRegion(call);
  uint32_t piece = 0;
  const std::optional<uint32_t> slot = thingSlot(call);
  for (size_t f = 0; f < job.faces().size(); ++f) {
    const RegionView& view = *job.faces()[f];
    std::vector<Polyline> lines;
    const Status status = linesOf(call, args.lines, args.inset, job, f, lines);
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
  if (piece == 0) call.giveToOtherwise();
  return {};
}

constexpr const char* kLinesDoc =
    "Edges, as in peel. Parts of logical edges, edge(0, 0.02, 1) || edge(1), or range(0.02, 2), "
    "run "
    "clockwise, backwards where the end comes first, and are one line where they meet.";
constexpr const char* kInsetDoc = "How far inside the boundary.";
constexpr TermSpec kProfiles[] = {{"none", "Flat, or a box where there is a height."},
                                  {"box", "Upright sides."},
                                  {"batter", "Sides that lean inward."},
                                  {"gable", "A ridge in the middle."},
                                  {"round", "Half a circle."},
                                  {"dome", "Upright sides under a round top."},
                                  {"kerb", "One edge cut off."}};
constexpr ParamSpec kSweep[] = {
    selection<&Sweep::lines>("lines", kLinesDoc, kEdgeTerms),
    param<&Sweep::width>("width", "Of the ribbon, in metres; 0 for bare lines.").atLeast(0),
    param<&Sweep::inset>("inset", kInsetDoc, "0").atLeast(0),
    param<&Sweep::joins>("joins", "What corners look like.", "mitre"),
    param<&Sweep::ends>("ends", "What the ends look like.", "butt"),
    param<&Sweep::height>("height", "Above 0: volumes of that height.", "0"),
    selection<&Sweep::profile>(
        "profile",
        "Cross-section of volumes: box, batter, gable, round, dome, kerb, or points in shares of "
        "width and height, [0, 0; 0, 1; 1, 0.6; 1, 0].",
        kProfiles, "none", true),
    param<&Sweep::cut>("cut", "Flat ribbons are cut out of the region.", "false")};
constexpr ParamSpec kParametrise[] = {
    selection<&Parametrise::lines>("lines", kLinesDoc, kEdgeTerms),
    param<&Parametrise::inset>("inset", kInsetDoc, "0").atLeast(0)};
constexpr Signature kSweepSignatures[] = {{kSweep}};
constexpr Signature kParametriseSignatures[] = {{kParametrise}};

constexpr OpSpec kSpecs[] = {
    {"sweep", "region", "Makes ribbons of a width along the boundary of a region.",
     kSweepSignatures, typed<applySweep>, BlockKind::Operations,
     kReadsRegion | kRandom | kReadsWorld | kReadsWorldByWord, kOtherwiseOnly, false, true},
    {"parametrise", "region", "Gives out parts of the boundary as straight lines.",
     kParametriseSignatures, typed<applyParametrise>, BlockKind::Operations,
     kReadsRegion | kRandom | kReadsWorld | kReadsWorldByWord, kOtherwiseOnly, false, true},
};

}  // namespace

extern const OpList kOps_sweep;
const OpList kOps_sweep = kSpecs;

}  // namespace gable
