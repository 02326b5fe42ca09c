// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "builtins/ops/subdivide/shared/uv_extent.h"

#include "geom/mesh/uv.h"

namespace gable {

UvExtent uvExtent(const Mesh& m, int set, int coordinate) {
  const Box2 box = uvBounds(m, set);
  const auto axis = static_cast<size_t>(coordinate);
  const double range = box.max[axis] - box.min[axis];
  return {box.min[axis], box.max[axis], range * uvUnitLength(m, set)[axis]};
}

}  // namespace gable
