// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Everyday words, and words of other programs, for what is built in under another name. Completion
// and search know them; sorted by word.

#include "language/service.h"

namespace gable::language {

std::span<const Alias> aliases() {
  static constexpr Alias kAliases[] = {
      {"array", "scatter"},
      {"avenue", "along"},
      {"bevel", "offset"},
      {"border", "setback"},
      {"building", "extrude"},
      {"chance", "p"},
      {"chance", "rand"},
      {"circle", "primitiveDisk"},
      {"colour", "color"},
      {"courtyard", "shapeO"},
      {"cube", "primitiveCube"},
      {"cut", "split"},
      {"cylinder", "primitiveCylinder"},
      {"delete", "NIL"},
      {"divide", "split"},
      {"faces", "comp"},
      {"fence", "sweep"},
      {"floors", "split"},
      {"garden", "voronoi"},
      {"gable", "roofGable"},
      {"grow", "streets"},
      {"height", "extrude"},
      {"hedge", "sweep"},
      {"hip", "roofHip"},
      {"hollow", "shapeO"},
      {"import", "i"},
      {"insert", "i"},
      {"layers", "split"},
      {"lots", "parcels"},
      {"mansard", "roofHip"},
      {"mansard", "taper"},
      {"merge", "joined"},
      {"model", "i"},
      {"move", "t"},
      {"parts", "comp"},
      {"paths", "grid"},
      {"pillar", "primitiveCylinder"},
      {"plots", "parcels"},
      {"pyramid", "roofPyramid"},
      {"random", "rand"},
      {"remove", "NIL"},
      {"repeat", "split"},
      {"roof", "roofGable"},
      {"roof", "roofHip"},
      {"rotate", "r"},
      {"scale", "s"},
      {"size", "s"},
      {"sphere", "primitiveSphere"},
      {"stairs", "split"},
      {"storeys", "split"},
      {"texture", "setupProjection"},
      {"translate", "t"},
      {"trees", "scatter"},
      {"turn", "r"},
      {"wall", "comp"},
      {"windows", "split"},
  };
  return kAliases;
}

}  // namespace gable::language
