// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Perimeter: the edges of faces as one length, divided into sections that are set back by depths of
// their own.
//
// Promises
//  1. The areas of the sections and of the remainder add up to that of the faces.
//  2. What two sections have in common belongs to the deeper one, of equal ones to the first.
//  3. Sections that do not overlap keep the points of the face to the bit.
#pragma once

#include <memory>
#include <vector>

#include "base/status.h"
#include "builtins/ops/subdivide/shared/split_sizes.h"
#include "geom/mesh/mesh.h"
#include "shape/services.h"

namespace gable {

class Perimeter {
 public:
  /// The chain begins with the edge `firstEdge`, counted over all faces and around them; `mask`
  /// says of each edge whether it takes part, and may be null. Both the mesh and the services must
  /// outlive this.
  Perimeter(const Mesh& m, double firstEdge, const std::vector<double>* mask,
            const Services& services);
  ~Perimeter();

  /// Of the edges that take part.
  double length() const;
  /// Sets the sections back, whose pattern begins at `offset` along the chain. Fails where the
  /// skeleton does.
  Status setBack(const SplitPieces& sections, double offset, const std::vector<double>& depth);
  /// One of the sections, and what none of them has; empty where nothing is left.
  Mesh section(uint32_t number);
  Mesh remainder();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gable
