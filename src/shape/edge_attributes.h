// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Attributes of the edges of an initial shape, and which of its edges lie at a street.
//
// An attribute is a list with a value for each face edge, in order: the edges of the first face,
// its outer loop first, then those of the next. Where the list ends, edges have no value.
//
// What a rule works on is seldom an edge of the initial shape itself, so edges are sampled: the
// geometry is moved along its normal, in the plane of the initial shape, and the edge that it
// covers most is the one that is meant. Of edges behind each other the nearest counts. Geometry
// that looks along the normal of that plane (a lot, a flat roof), or meets no edge that looks its
// way, belongs to the edge nearest to its middle.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geom/mesh/mesh.h"
#include "math/frame.h"
#include "math/vec.h"
#include "program/value.h"

namespace gable {

/// Where an edge lies by the streets: Front at a street, the others by the way they look, as seen
/// with the street in front.
enum class StreetSide : uint8_t { Front, Back, Left, Right };

/// The name of an attribute of edges without the /edgeattr/ in front of it.
std::string_view edgeAttributeName(std::string_view name);

class EdgeAttributes {
 public:
  /// By name, each an array.
  using Given = std::vector<std::pair<std::string, Value>>;
  /// The list of widths that tells which edges lie at a street: those over 0.
  static constexpr std::string_view kStreetWidth = "streetWidth";

  /// Whether an attribute of a shape is one of its edges: all whose names begin with /edgeattr/,
  /// and lists of widths of streets.
  static bool isNamed(std::string_view name, bool isList) {
    return edgeAttributeName(name) != name || (isList && name == kStreetWidth);
  }

  /// Of an initial shape in its object frame. O(edges).
  EdgeAttributes(const Mesh& footprint, Given attributes, const ValuePool& pool);

  const Given& attributes() const { return attributes_; }
  const Value* find(std::string_view name) const;
  size_t edgeCount() const { return edges_.size(); }

  /// The edge that some geometry belongs to, by points and the way it looks, both in the object
  /// frame. Negative where there are no edges. O(edges + covered edges squared).
  int32_t edgeAt(std::span<const Vec3> points, const Vec3& normal) const;
  /// True when a street is known.
  bool hasStreets() const { return !sides_.empty(); }
  /// The side of an edge that edgeAt() gave; a street must be known.
  StreetSide sideOf(size_t edge) const { return sides_[edge]; }
  /// The normal of the plane of the initial shape.
  const Vec3& up() const { return plane_.z; }
  uint64_t hash() const { return hash_; }

 private:
  struct Edge {
    Vec2 from, to, outward;
  };
  void findStreets(const ValuePool& pool);
  int32_t covered(const Vec2& along, double low, double high, double depth) const;
  int32_t nearest(Vec2 p, const Vec2& along) const;

  Frame plane_;
  std::vector<Edge> edges_;
  std::vector<StreetSide> sides_;
  Given attributes_;
  uint64_t hash_ = 0;
};

}  // namespace gable
