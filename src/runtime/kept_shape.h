// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// KeptShape: a shape that outlives its worker or goes to another one. Counted pointers to its extra
// stay with a worker, so the extra is apart.
#pragma once

#include <memory>

#include "shape/shape.h"

namespace gable {

struct KeptShape {
  Shape shape;
  std::unique_ptr<const ShapeExtra> extra;
  /// The block slot of a child.
  uint32_t slot = 0;
};

KeptShape keptShape(const Shape& from, uint32_t slot);

/// The shape again. Local values are counted by each machine for itself: `locals` is what they are
/// here.
Shape takenShape(const KeptShape& from, uint32_t locals);

}  // namespace gable
