// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Limbs: a stem that tapers, with boughs that carry boughs, and leaves on the last of them. What
// the numbers mean follows Weber & Penn, "Creation and Rendering of Realistic Trees" (1995):
// lengths are shares of the limb that carries, and a crown is the profile of the lengths along the
// stem.
//
// The stem begins at the origin and grows along y. Lengths in metres, angles in degrees.
//
//   1. Each limb's skin is a closed tube. A bough's begins on the axis of the limb that carries it,
//      and where that is the stem leaves its skin in a collar. So no joint shows a gap.
//   2. A limb never gets thicker from its collar to its tip.
//   3. Where a limb ends cut off and carries thick boughs, the last one goes on with the width that
//      it ends with.
//   4. Equal options make equal limbs, to the bit.
//
// Time and memory are linear in limbs and leaves, and bounded by work().
#pragma once

#include <cstdint>
#include <vector>

#include "geom/mesh/mesh.h"
#include "math/frame.h"

namespace gable {

/// The lengths of a stem's boughs from the lowest to the uppermost.
enum class CrownShape : uint8_t { Cone, Round, Dome, Even, Taper, Flame, Bowl };

/// All limbs of one order: the stem, its boughs, theirs.
struct LimbLevel {
  /// How many boughs each carries, along what is above `from`, a share of its length.
  double boughs = 0, from = 0.3;
  /// Of the boughs: their length as a share of this limb's, their width as a share of its width
  /// where they begin.
  double share = 0.5, thick = 0.6;
  /// Between the limb and its lowest boughs, and its uppermost ones.
  double angle = 50, topAngle = 40;
  /// How far boughs are pressed into the level plane through the limb, 0 to 1.
  double flat = 0;
  /// Of the limb: the width at its end as a share of that at its foot; how far it turns to the
  /// upright along its length (1 wholly, below 0 to hang); how far it strays.
  double tip = 0.1, rise = 0, wander = 10;
};

struct LeafOptions {
  /// On each limb of the last order, above `from`.
  double count = 0, from = 0.1;
  double length = 0.1, width = 0.1;
  /// Between limb and leaf; how far the leaf turns to the upright, below 0 to hang.
  double angle = 50, rise = 0;
  /// How far leaves are pressed into the level plane through the limb, 0 to 1: two ranks.
  double flat = 0;
  /// How far its halves are bent up along the middle.
  double fold = 0;
  /// The picture has so many leaves beside and above one another.
  double looks = 1;
};

struct LimbOptions {
  double length = 1, width = 0.05;
  /// One at least; the first is the stem.
  std::vector<LimbLevel> levels;
  CrownShape crown = CrownShape::Dome;
  /// How much wider the stem's foot is than the stem.
  double flare = 0;
  /// Of the stem; thinner limbs have fewer, three at least.
  double sides = 8;
  LeafOptions leaf;
  /// Limbs are at least so wide, so that no bough is a thread.
  double leastWidth = 0.004;
  uint64_t seed = 0;
};

/// One limb: rings from foot to tip.
struct Limb {
  struct Ring {
    Vec3 at;
    /// Unit: along the limb, and square to it.
    Vec3 along, aside;
    double radius = 0;
    /// From the foot.
    double distance = 0;
  };
  std::vector<Ring> rings;
  uint32_t level = 0, sides = 3;
  /// It ends in a point, as twigs do, and thin boughs of trees with few sides.
  bool pointed = false;
  /// The stem's foot: how deep its lobes are, as a share of the radius.
  double lobes = 0;
};

/// y along the leaf from its stalk, z off its upper side.
struct LeafPlace {
  Frame frame;
  double scale = 1;
  uint32_t look = 0;
};

struct LimbSystem {
  std::vector<Limb> limbs;
  std::vector<LeafPlace> leaves;
};

/// More limbs or leaves than this are taken for a mistake.
constexpr double kMostLimbs = 200000, kMostLeaves = 1000000;
/// What would grow.
struct LimbCounts {
  double limbs = 1, leaves = 0;
};
LimbCounts limbCounts(const LimbOptions& o);

LimbSystem growLimbs(const LimbOptions& o);

/// Adds the skin of a limb, with corner normals; u runs around in whole tiles of about a metre,
/// v along in tiles of the same size. Around a twig of few sides u runs there and, over the last
/// side, back.
void addSkin(MeshBuilder& b, const Limb& limb);
/// Adds a leaf: two faces along its middle where it is folded, one elsewhere; the picture stands
/// upright from the stalk.
void addLeaf(MeshBuilder& b, const LeafPlace& place, const LeafOptions& leaf);

}  // namespace gable
