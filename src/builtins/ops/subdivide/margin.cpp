// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A frame around a middle, as a grid of three by three. Pieces that face out or in have scopes of
// their own: quarter turns about the axis that is not divided, which leave their boxes in place.

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/quarter_turn.h"
#include "builtins/ops/subdivide/shared/cells.h"
#include "builtins/selection.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Role : uint8_t { Corner, Edge, Center };

constexpr std::string_view kRoleWords[] = {"corner", "edge", "center"};

// The slot of a role, and whether there is one.
struct RoleSlot {
  bool wanted = false;
  uint32_t slot = 0;
};

RoleSlot slotOf(const OpCall& call, Role role) {
  for (const SelectorItem& item : call.selectors()) {
    const std::string_view word = kRoleWords[static_cast<size_t>(role)];
    if (selectsWord(item, word, call.services().pool())) return {true, item.slot};
  }
  return {};
}

// A third of a length: the margin, what is between, the margin again. Nothing is made of no length.
struct Thirds {
  SplitPieces pieces;
  // For each piece -1, 0 or 1: near, middle, far.
  std::vector<int> place;

  Thirds(double whole, double margin) {
    const double tolerance = 1e-9 * (1 + whole);
    add(0, margin, -1, tolerance);
    add(margin, whole - 2 * margin, 0, tolerance);
    add(whole - margin, margin, 1, tolerance);
  }

 private:
  void add(double start, double size, int where, double tolerance) {
    if (!(size > tolerance)) return;
    pieces.push_back({start, size, 0});
    place.push_back(where);
  }
};

enum class Orientation : uint8_t { Default, Out, In };

}  // namespace

template <>
struct WordsOf<Orientation> {
  static constexpr const char* text = "default out in";
};

namespace {

// How wide the margin is along an axis: at most half of it.
double marginAlong(OpCall& call, const Size& width, Axis axis, double preferred, bool& cut) {
  const double whole = std::fabs(component(call.shape().size, axis));
  const double m = width.of(whole);
  if (m == 0) return std::min(preferred, whole / 2);
  if (m > whole / 2 + 1e-9 * (1 + whole)) cut = true;
  return std::min(m, whole / 2);
}

// Quarter turns about the axis that is not divided. With b and c the next axes in the cycle x y z,
// the edge at the far end of b needs none to look outward along b, nor the corner at the far end of
// both.
int turnsOf(int b, int c) {
  if (b != 0 && c != 0) return b > 0 ? (c > 0 ? 0 : 3) : (c > 0 ? 1 : 2);
  if (b != 0) return b > 0 ? 0 : 2;
  return c > 0 ? 1 : 3;
}

class Margin {
 public:
  Margin(OpCall& call, const AxisPair& pair, double mu, double mv)
      : call_(call),
        pair_(pair),
        u_(std::fabs(component(call.shape().size, pair.u)), mu),
        v_(std::fabs(component(call.shape().size, pair.v)), mv),
        cells_(call.shape(), pair.u, u_.pieces, pair.v, v_.pieces) {}

  void emit(const RoleSlot (&slots)[3], Orientation orientation) {
    uint32_t piece = 0;
    for (size_t i = 0; i < u_.place.size(); ++i) {
      for (size_t j = 0; j < v_.place.size(); ++j, ++piece) {
        work(4);
        const int border = (u_.place[i] != 0) + (v_.place[j] != 0);
        const RoleSlot& slot = slots[2 - border];
        Shape child;
        if (!slot.wanted || !cells_.take(i, j, child)) continue;
        if (border > 0 && orientation != Orientation::Default) {
          turn(child, i, j, orientation == Orientation::In);
        }
        call_.emit(std::move(child), slot.slot, piece);
      }
    }
  }

 private:
  void turn(Shape& child, size_t i, size_t j, bool in) const {
    const auto a = static_cast<size_t>(pair_.whole);
    const bool uIsB = static_cast<size_t>(pair_.u) == (a + 1) % 3;
    const int b = uIsB ? u_.place[i] : v_.place[j], c = uIsB ? v_.place[j] : u_.place[i];
    turnScope(child, quarterTurn(a, turnsOf(b, c) + (in ? 2 : 0)));
  }

  OpCall& call_;
  AxisPair pair_;
  Thirds u_, v_;
  Cells cells_;
};

struct MarginArguments {
  Axis axis;
  Size width;
  Orientation orientation;
};

Status applyMargin(OpCall& call, const MarginArguments& args) {
  AxisPair pair;
  if (!axesAround(call.shape(), args.axis, pair)) {
    return call.fail("split-flat", "the scope has an extent along one axis only",
                     "give the scope a size first");
  }
  const double wanted = args.width.number;
  if (!(wanted >= 0) || !std::isfinite(wanted)) {
    return call.fail("bad-argument", "a margin of " + shortestText(wanted) + " is none",
                     "write a width of zero or more; zero takes the corner's preferred size");
  }
  RoleSlot slots[3];
  for (const Role r : {Role::Corner, Role::Edge, Role::Center}) {
    slots[static_cast<size_t>(r)] = slotOf(call, r);
  }
  const Vec3 preferred = slots[0].wanted ? call.preferredSize(slots[0].slot) : Vec3{};
  bool cut = false;
  const double mu = marginAlong(call, args.width, pair.u, component(preferred, pair.u), cut);
  const double mv = marginAlong(call, args.width, pair.v, component(preferred, pair.v), cut);
  if (cut) {
    call.services().warn("margin-too-wide",
                         "'margin': the margin is wider than half of the shape and ends there",
                         "make it narrower, or write it as a share: '0.2");
  }
  Margin(call, pair, mu, mv).emit(slots, args.orientation);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&MarginArguments::axis>("axis",
                                  "The scope axis that is not divided. A flat shape is divided in "
                                  "its plane, whatever the axis."),
    param<&MarginArguments::width>(
        "width",
        "Of the margin, in metres or, with ', as a share of the size along each axis (0 to 0.5); 0 "
        "takes the preferred size of the corner.",
        "0")
        .atLeast(0),
    param<&MarginArguments::orientation>(
        "orientation",
        "Whether the pieces keep the axes of the shape, or corners and edges face out or in.",
        "default"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {{"corner", "A piece at a corner."},
                               {"edge", "A strip between two corners."},
                               {"center", "What the margin leaves."}};
constexpr OpSpec kSpecs[] = {
    {"margin", "subdivide",
     "Divides the shape into four corners, four edges and a centre around an axis.", kSignatures,
     typed<applyMargin>, BlockKind::Selectors, kPure, kParts, false, true},
};

}  // namespace

extern const OpList kOps_margin;
const OpList kOps_margin = kSpecs;

}  // namespace gable
