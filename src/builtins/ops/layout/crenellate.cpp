// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "geom/plan/crenellation.h"

#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/layout/shared/ground.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr double kMostMerlons = 20000;

class Emitter {
 public:
  explicit Emitter(OpCall& call) : call_(call) {}

  void emit(const Ground& ground, const std::vector<CrenellationPart>& parts, const char* what) {
    const SelectorItem* item = itemFor(call_, what);
    for (uint32_t i = 0; i < parts.size(); ++i, ++piece_) {
      if (!item) continue;
      Shape child = groundPart(call_, ground, parts[i].polygon, parts[i].front, {});
      child.split = {i, static_cast<uint32_t>(parts.size())};
      call_.emit(std::move(child), item->slot, piece_);
    }
  }
  void emit(const Ground& ground, const Region& rest) {
    const SelectorItem* item = itemFor(call_, "remainder");
    for (const Polygon& p : rest) {
      const uint32_t piece = piece_++;
      if (item) call_.emit(groundPart(call_, ground, p, kNoFront, {}), item->slot, piece);
    }
  }

 private:
  OpCall& call_;
  uint32_t piece_ = 0;
};

struct Crenellate {
  double merlon, gap, thickness;
};

Status applyCrenellate(OpCall& call, const Crenellate& args) {
  const CrenellationOptions o{args.merlon, args.gap, args.thickness};
  std::vector<Ground> grounds;
  if (Status bad = groundsOf(call, grounds); !bad) return bad;
  double count = 0;
  for (const Ground& g : grounds) count += merlonCount(g.polygon, o);
  if (!(count <= kMostMerlons)) {
    return call.fail("crenellate-too-many", "crenellate would make more than 20000 merlons",
                     "make merlons and gaps wider, or divide the shape first");
  }
  Emitter emitter(call);
  for (const Ground& g : grounds) {
    const Crenellation c = crenellate(g.polygon, o);
    emitter.emit(g, c.merlons, "merlon");
    emitter.emit(g, c.crenels, "crenel");
    emitter.emit(g, c.rest);
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Crenellate::merlon>("merlon", "Width of a merlon along the outline.", "1.5").above(0),
    param<&Crenellate::gap>("gap", "Width of the gap between two of them.", "0.75").above(0),
    param<&Crenellate::thickness>("thickness", "How far they reach inward.", "0.5").above(0),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {{"merlon", "Where a merlon stands."},
                               {"crenel", "The gap between two of them."},
                               {"remainder", "The face within."}};
constexpr OpSpec kSpecs[] = {
    heavy({"crenellate", "layout", "Divides the band along an outline into merlons and crenels.",
           kSignatures, typed<applyCrenellate>, BlockKind::Selectors, kPure, kParts, false, true}),
};

}  // namespace

extern const OpList kOps_crenellate;
const OpList kOps_crenellate = kSpecs;

}  // namespace gable
