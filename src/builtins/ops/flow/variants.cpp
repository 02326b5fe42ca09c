// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a rule makes is a prototype for each of its inputs. This makes the inputs few: it draws one
// of so many seeds, and drops what says where the shape stands among others. Sizes, which differ by
// nothing that is seen, go to a grid.

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"
#include "shape/seeded_path.h"

namespace gable {

namespace {

struct Variants {
  double count, step;
};

// Never to nothing: a body stays one.
double onGrid(double length, double step) {
  const double steps = std::nearbyint(std::fabs(length) / step);
  return length == 0 ? 0 : std::copysign(std::max(1.0, steps) * step, length);
}

Status applyVariants(OpCall& call, const Variants& args) {
  Shape& s = call.shape();
  const double count = std::nearbyint(args.count);
  const double drawn = std::floor(count * randomUnit(call.randomAddress(0)));
  if (args.step > 0) {
    resizeScope(
        s, {onGrid(s.size.x, args.step), onGrid(s.size.y, args.step), onGrid(s.size.z, args.step)});
  }
  s.pivot = s.scope;
  s.split = {};
  s.comp = {};
  s.compSelector = 0;
  s.path = seededPath(std::min(drawn, count - 1));
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Variants::count>("count", "How many looks there are; rounded to a whole number.")
        .between(1, 1 << 24),
    param<&Variants::step>("step",
                           "To multiples of this length the sizes of the scope are rounded, in "
                           "metres; 0: they stay.",
                           "0")
        .atLeast(0),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"variants", "flow",
     "Gives the shape one of so many looks, so that what the next rules make of it is shared.",
     kSignatures, typed<applyVariants>, BlockKind::None, kRandom | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_variants;
const OpList kOps_variants = kSpecs;

}  // namespace gable
