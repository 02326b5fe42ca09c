// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/kept_shape.h"

namespace gable {

KeptShape keptShape(const Shape& from, uint32_t slot) {
  KeptShape out;
  out.shape = from;
  out.shape.extra = {};
  out.slot = slot;
  if (from.extra) out.extra = std::make_unique<const ShapeExtra>(*from.extra);
  return out;
}

Shape takenShape(const KeptShape& from, uint32_t locals) {
  Shape out = from.shape;
  out.locals = locals;
  if (from.extra) out.extra = makeRef<ShapeExtra>(*from.extra);
  return out;
}

}  // namespace gable
