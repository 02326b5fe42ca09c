// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which edge of the initial shape a shape or a component of it belongs to (shape/edge_attributes.h
// says how), and the values of that edge. Calls that ask read the world and the initial shape.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "shape/edge_attributes.h"
#include "shape/services.h"

namespace gable {

class EdgeSampler {
 public:
  EdgeSampler(const Services& services, const Shape& shape)
      : services_(services), shape_(shape), edges_(services.initialShape().edges.get()) {}

  /// Null where the initial shape has no attributes of edges; then no edge is found either.
  const EdgeAttributes* attributes() const { return edges_; }
  /// By points and a normal in scope coordinates. Negative for none.
  int32_t edgeAt(std::span<const Vec3> points, const Vec3& normal) const;
  /// By all of the shape and its mean normal.
  int32_t ofShape() const;
  /// A direction of the scope in the object frame.
  Vec3 inObject(const Vec3& direction) const;

 private:
  const Services& services_;
  const Shape& shape_;
  const EdgeAttributes* edges_;
};

/// The element of an array that belongs to an edge; null where it has none.
Value edgeValue(const Value& list, int32_t edge, const ValuePool& pool);

}  // namespace gable
