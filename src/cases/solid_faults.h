// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is wrong with a model as a thing of solid parts, whatever its rules: faces of two leaves in
// one plane, which flicker; leaves that nothing carries; closed leaves that stand in each other.
//
// Each takes O(n log n) for the leaves whose boxes meet, and looks at the triangles that lie where
// both do. Faults come in the order of derivation.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "cases/parts.h"

namespace gable::cases {

/// Leaves are told by their index in Parts.
struct SolidFault {
  uint32_t first = 0, second = 0;
  /// Square metres in one plane, the lowest point above the ground, or the depth of one in the
  /// other.
  double amount = 0;
  Vec3 at;
};

/// Faces of different leaves that look the same way and lie within a millimetre of one plane, where
/// they share more than ten square centimetres. Where their materials are the same nothing is seen
/// of it, so they are left out, and so is what looks down at the ground from less than 15 cm above
/// it.
std::vector<SolidFault> coplanarFaces(const Parts& parts, double ground);

/// Leaves that are not joined to the ground by others: those that touch are joined, and those that
/// reach down to the height `ground` stand on it. A fault a group of joined leaves: `first` is the
/// lowest leaf, `second` the number of leaves.
std::vector<SolidFault> floatingParts(const Parts& parts, double ground);

/// Closed leaves that stand in each other by more than a centimetre, but for those that `skip` says
/// may.
std::vector<SolidFault> overlaps(const Parts& parts,
                                 const std::function<bool(uint32_t, uint32_t)>& skip = {});

}  // namespace gable::cases
