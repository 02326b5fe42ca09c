// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Buildings without detail, made of what looks up: LoD 2.2 and 1.2 in the sense of Biljecki,
// Ledoux, Stoter: An improved LOD specification for 3D building models, 2016. The roof of a place
// is the topmost of the faces above it; walls stand wherever two roofs, or a roof and the open,
// meet at different heights, straight down from eaves; the ground is flat.
//
// Promises: a shell that says it is closed has every edge twice, once in each direction; every
// face turns counter-clockwise as seen from outside; walls and ground are flat, roofs within two
// centimetres; points lie on a grid of 2^-8 m in the plan and of a millimetre in height, and no two
// are equal. Coordinates: metres, x east, y north, z up. Equal input gives equal output.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/exporters/city_kinds.h"
#include "math/vec.h"

namespace gable {

struct TopFace {
  /// The outer ring counter-clockwise as seen from above, holes clockwise.
  std::vector<std::vector<Vec3>> rings;
};

struct ShellFace {
  /// Roof, Wall or Ground.
  CityKind kind = CityKind::Roof;
  /// Indices into BuildingShell::points.
  std::vector<std::vector<uint32_t>> rings;
};

/// What hangs together as seen from above.
struct BuildingShell {
  std::vector<Vec3> points;
  std::vector<ShellFace> faces;
  bool closed = false;
  double area = 0, volume = 0;
};

/// LoD 2.2. Faces that rise too steeply to be seen from above, and what is less than `kLeastRoof`
/// above `base`, are no roofs. Empty where nothing is left.
std::vector<BuildingShell> shellsOf(std::span<const TopFace> faces, double base);

/// LoD 1.2: a block of the same outline and the same volume.
BuildingShell blockOf(const BuildingShell& shell);

}  // namespace gable
