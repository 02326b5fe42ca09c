// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Selection: which components of a shape a selector means. One place for comp, setback and its
// kin, and for functions that take a side (geometry.area(top)).
//
// Directions are decided by the largest component of a normal along the axes asked for: of the
// scope, of the initial shape (object.*, and street.* where no street is known) or of the world.
//
// Streets are known in two ways. Where edges or faces of the shape have the tag `street`, as lots
// of parcels() have, those are at the street. Else street.* ask for the edge of the initial shape
// that a component belongs to and for the width of the street there (shape/edge_attributes.h). On a
// tie, which also is what differs by rounding, up and down win over front and back, and those over
// left and right. The angles of vertical, aslant, nutant and horizontal are those of the reference:
// within 11.25 degrees of the scope's ground plane, and within 11.25 of its normal.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/small_buffer.h"
#include "shape/op_call.h"

namespace gable {

/// Where an edge lies on a roof.
enum class RoofEdge : uint8_t { None, Eave, Hip, Valley, Ridge };

/// What uv selectors say about an edge, as bits.
enum UvSide : uint8_t {
  kUvLeft = 1,
  kUvRight = 2,
  kUvBottom = 4,
  kUvTop = 8,
  kUvMinU = 16,
  kUvMaxU = 32,
  kUvMinV = 64,
  kUvMaxV = 128,
};

/// What can be asked of a component.
struct Selectable {
  /// The way it looks, in scope coordinates; need not be a unit vector.
  Vec3 normal;
  uint32_t index = 0;
  /// Has, or is, an edge with one face only.
  bool border = false;
  /// Neither border nor inside is said of it (holes).
  bool borderless = false;
  RoofEdge roof = RoofEdge::None;
  uint8_t uvSides = 0;
};

/// What is gathered of a component only when a selector asks for it.
class ComponentSource {
 public:
  virtual ~ComponentSource() = default;
  enum class Of : uint8_t { Component, Edges, Vertices, Itself };
  /// Tag sets: its own and inherited ones, those of its edges or vertices, or its own alone.
  virtual void tagsOf(const Selectable& c, Of of, std::vector<uint32_t>& out) const = 0;
  /// Its vertices in scope coordinates.
  virtual void pointsOf(const Selectable& c, std::vector<Vec3>& out) const = 0;
};

/// True when a tag, or one of its parents by the dots of its name, is what the query says; ? stands
/// for one part of a name, * for one or more.
bool tagMatches(std::string_view query, std::string_view tag);

/// The directions of a call: the axes of the scope, of the initial shape and of the world.
class Directions {
 public:
  Directions(const Services& services, const Shape& shape) : services_(services), shape_(shape) {}
  enum class Axes : uint8_t { Scope, Object, World };
  /// The axis among x, y, z along which a normal (in scope coordinates) is largest: 0 to 2 for
  /// the positive and 3 to 5 for the negative direction.
  int side(const Vec3& normal, Axes axes) const;
  bool knowsStreets() const;
  /// The same by streets, which must be known: the front looks to them.
  int streetSide(const Selectable& c, const ComponentSource& source) const;

 private:
  bool hasTaggedStreets() const;
  int sideByTags(const Selectable& c, const ComponentSource& source) const;
  int sideByEdges(const Selectable& c, const ComponentSource& source) const;

  const Services& services_;
  const Shape& shape_;
  /// Where the streets lie by the tags of the shape, in scope coordinates and level; found when it
  /// is first asked for.
  mutable bool looked_ = false;
  mutable Vec3 street_;
};

/// Word by word, as comp and geometry.area take it. False for words that are no selector. `points`
/// are the component's vertices in scope coordinates, `tags` its own tag set.
bool selectsDirection(std::string_view word, const Vec3& normal, std::span<const Vec3> points,
                      uint32_t tags, const Directions& directions);

/// A block's selector made ready for many components.
class Selector {
 public:
  Selector(const SelectorItem& item, const ValuePool& pool, const Directions& directions);

  /// `count` wraps indices when it is not 0. Boolean terms hold or not for all components.
  bool matches(const Selectable& c, const ComponentSource& source, const TagTable& table,
               uint32_t count = 0) const;
  /// True when the item is this word alone.
  bool is(std::string_view word) const;
  /// As comp.sel shows it: front, 2, left || right.
  std::string text() const;

 private:
  bool holds(size_t term, const Selectable& c, const ComponentSource& source, const TagTable& table,
             uint32_t count) const;

  const SelectorItem& item_;
  const ValuePool& pool_;
  const Directions& directions_;
  /// A number for each term's word, so that components cost no text comparison.
  SmallBuffer<uint8_t, 16> words_;
};

}  // namespace gable
