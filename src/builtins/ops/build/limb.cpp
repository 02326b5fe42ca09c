// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The lists of an operation, one number for each order of limbs, become levels of the kernel; what
// grows is given out limb by limb and leaf by leaf, or all in one.
#include "geom/plant/limb.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

template <>
struct WordsOf<CrownShape> {
  static constexpr const char* text = "cone round dome even taper flame bowl";
};

namespace {

constexpr size_t kMostOrders = 6;

struct LimbArguments {
  Size length, width;
  std::optional<Floats> boughs, share, thick, angle, top, from, flat, tip, rise, wander;
  CrownShape crown = CrownShape::Dome;
  double flare = 0, sides = 8;
  double leaves = 0, leafLength = 0.1, leafWidth = 0.1, leafAngle = 50, leafRise = 0, leafFlat = 0,
         fold = 0, looks = 1;
};

/// The number of an order: lists go on with their last one.
void take(const std::optional<Floats>& list, size_t order, double& to) {
  if (!list || list->array->numbers.empty()) return;
  const std::vector<double>& n = list->array->numbers;
  to = n[std::min(order, n.size() - 1)];
}

LimbOptions optionsOf(OpCall& call, const LimbArguments& args) {
  const Shape& s = call.shape();
  LimbOptions o;
  o.length = args.length.of(s.size.y);
  o.width = args.width.of(s.size.x);
  o.crown = args.crown;
  // Four millimetres, but of small things less.
  o.leastWidth = std::min(0.004, 0.05 * o.width);
  o.flare = args.flare;
  o.sides = std::floor(args.sides);
  o.leaf = {args.leaves,   0.1,           args.leafLength, args.leafWidth, args.leafAngle,
            args.leafRise, args.leafFlat, args.fold,       args.looks};
  o.seed = call.randomAddress(0);
  const size_t orders = args.boughs ? args.boughs->array->numbers.size() : 0;
  for (size_t i = 0; i <= orders && i <= kMostOrders; ++i) {
    LimbLevel level;
    if (i < orders) take(args.boughs, i, level.boughs);
    take(args.share, i, level.share);
    take(args.thick, i, level.thick);
    take(args.angle, i, level.angle);
    level.topAngle = level.angle;
    take(args.top, i, level.topAngle);
    take(args.from, i, level.from);
    take(args.flat, i, level.flat);
    take(args.tip, i, level.tip);
    take(args.rise, i, level.rise);
    take(args.wander, i, level.wander);
    o.levels.push_back(level);
  }
  return o;
}

Status checked(const OpCall& call, const LimbArguments& args, const LimbOptions& o) {
  if (!(o.length > 0) || !(o.width > 0)) {
    return call.fail("bad-argument", "a limb needs a length and a width above zero",
                     "write both in metres, or give the scope a size for shares of it");
  }
  if (!std::isfinite(o.length) || !std::isfinite(o.width)) {
    return call.fail("bad-argument", "the length or the width of the limb is no number",
                     "write both in metres");
  }
  if (args.boughs && args.boughs->array->numbers.size() > kMostOrders) {
    return call.fail("bad-argument", "limb takes boughs of six orders at most",
                     "write six numbers at most: a tree has three or four");
  }
  const LimbCounts counts = limbCounts(o);
  if (!(counts.limbs <= kMostLimbs) || !(counts.leaves <= kMostLeaves)) {
    return call.fail("limb-too-many", "limb would make more than 200000 limbs or a million leaves",
                     "the numbers in 'boughs' are multiplied with each other and with 'leaves'");
  }
  return {};
}

class Emitter {
 public:
  explicit Emitter(OpCall& call) : call_(call) {}

  /// `add(builder, i)` adds the i-th part of `count` to a mesh.
  template <class Add>
  void emit(std::string_view what, size_t count, Add&& add) {
    for (const SelectorItem& item : call_.selectors()) {
      if (!selectsWord(item, what, call_.services().pool())) continue;
      if (item.op == SelectOperator::Each) {
        for (size_t i = 0; i < count; ++i) {
          MeshBuilder b;
          add(b, i);
          give(b.take(), item.slot, i, count);
        }
      } else if (count > 0) {
        MeshBuilder b;
        for (size_t i = 0; i < count; ++i) add(b, i);
        give(b.take(), item.slot, 0, 1);
      }
      return;
    }
  }

 private:
  void give(Mesh mesh, uint32_t slot, size_t index, size_t total) {
    Shape child = call_.shape();
    child.assetMaterials = 0;
    setMesh(child, std::move(mesh), ScopeFit::Refit);
    child.split = {static_cast<uint32_t>(index), static_cast<uint32_t>(total)};
    call_.emit(std::move(child), slot, piece_++);
  }
  OpCall& call_;
  uint32_t piece_ = 0;
};

Status applyLimb(OpCall& call, const LimbArguments& args) {
  const LimbOptions o = optionsOf(call, args);
  if (Status bad = checked(call, args, o); !bad) return bad;
  const LimbSystem system = growLimbs(o);
  // A corner takes some sixty bytes, and a point of a ring is in six.
  double points = 0;
  for (const Limb& limb : system.limbs) {
    points += static_cast<double>(limb.rings.size()) * limb.sides;
  }
  workMemory(static_cast<uint64_t>(400 * (points + 4 * static_cast<double>(system.leaves.size()))));
  Emitter emitter(call);
  emitter.emit("wood", system.limbs.size(),
               [&](MeshBuilder& b, size_t i) { addSkin(b, system.limbs[i]); });
  emitter.emit("leaf", system.leaves.size(),
               [&](MeshBuilder& b, size_t i) { addLeaf(b, system.leaves[i], o.leaf); });
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&LimbArguments::length>("length", "Of the stem, in metres or as a share of the scope."),
    param<&LimbArguments::width>("width", "Across the stem above its foot."),
    param<&LimbArguments::boughs>(
        "boughs", "How many boughs the stem carries, how many each of these, and so on: [20, 6].",
        "none: the stem alone")
        .between(0, 100000),
    param<&LimbArguments::share>(
        "share", "Lengths of the boughs, as a share of the limb that carries them.", "[0.5]")
        .between(0, 10),
    param<&LimbArguments::thick>(
        "thick", "Widths of the boughs, as a share of the limb's width there.", "[0.6]")
        .between(0, 1),
    param<&LimbArguments::angle>("angle", "Between a limb and its boughs.", "[50]").between(0, 180),
    param<&LimbArguments::top>("top", "The same of the uppermost boughs.", "as angle")
        .between(0, 180),
    param<&LimbArguments::from>("from", "The share of a limb below its boughs.", "[0.3]")
        .between(0, 1),
    param<&LimbArguments::flat>("flat", "How far boughs are pressed into the level plane.", "[0]")
        .between(0, 1),
    param<&LimbArguments::tip>("tip",
                               "The width at a limb's end, as a share of that at its foot. From "
                               "0.25 on its last bough goes on with it.",
                               "[0.1]")
        .between(0, 1),
    param<&LimbArguments::rise>(
        "rise", "How far a limb turns to the upright: 1 wholly, below 0 to hang.", "[0]")
        .between(-1, 1),
    param<&LimbArguments::wander>("wander", "How far a limb strays, in degrees.", "[10]")
        .between(0, 90),
    param<&LimbArguments::crown>("crown", "The profile of the stem's boughs, from below to above.",
                                 "dome"),
    param<&LimbArguments::flare>("flare", "How much wider the foot is than the stem.", "0")
        .between(0, 5),
    param<&LimbArguments::sides>("sides", "Of the stem; thinner limbs have fewer.", "8")
        .between(3, 64),
    param<&LimbArguments::leaves>("leaves", "On each limb of the last order.", "0")
        .between(0, 1000000),
    param<&LimbArguments::leafLength>("leafLength", "Of a leaf, or of the picture of several.",
                                      "0.1")
        .above(0),
    param<&LimbArguments::leafWidth>("leafWidth", "Across a leaf.", "0.1").above(0),
    param<&LimbArguments::leafAngle>("leafAngle", "Between limb and leaf.", "50").between(0, 180),
    param<&LimbArguments::leafRise>("leafRise",
                                    "How far leaves turn to the upright; below 0 they hang.", "0")
        .between(-1, 1),
    param<&LimbArguments::leafFlat>(
        "leafFlat", "How far leaves are pressed into the level plane: two ranks.", "0")
        .between(0, 1),
    param<&LimbArguments::fold>("fold", "How far a leaf is bent up along its middle.", "0")
        .between(0, 85),
    param<&LimbArguments::looks>(
        "looks", "The picture has so many leaves beside and above one another.", "1")
        .between(1, 16),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {{"wood", "The skin of a limb."}, {"leaf", "A leaf."}};
constexpr OpSpec kSpecs[] = {
    {"limb", "build", "Grows a tapering stem with boughs, and leaves on the last of them.",
     kSignatures, typed<applyLimb>, BlockKind::Selectors, kRandom, kParts, false, true},
};

}  // namespace

extern const OpList kOps_limb;
const OpList kOps_limb = kSpecs;

}  // namespace gable
