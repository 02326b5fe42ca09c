// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From the trace of a wavefront to the faces of a skeleton.
#pragma once

#include <cstdint>
#include <vector>

#include "geom/skeleton/skeleton.h"
#include "geom/skeleton/wavefront.h"

namespace gable::skeleton {

struct FaceInput {
  /// An edge put into the wavefront (in that order): its nodes and the face it makes.
  struct Edge {
    uint32_t from = 0, to = 0, face = 0;
    /// True where it stands still.
    bool upright = false;
  };
  /// An upright face between collinear edges of two weights; stands on the start of an edge.
  struct Step {
    uint32_t ring = 0, edge = 0;
  };
  std::vector<Edge> edges;
  std::vector<Step> steps;
  std::vector<Ring> inputPoints;
  Vec2 center;
  double step = 1, timeStep = 1;
  /// The height that the roof was cut off at, 0 for none.
  double top = 0;
};

/// False where the trace does not close to faces that tile the polygon. O(m log m).
bool assembleFaces(const FaceInput& in, const Trace& trace, Skeleton& out);

}  // namespace gable::skeleton
