// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The faces of placed leaves as polygons with holes, for formats whose faces must be flat: a face
// that is bent is given as its triangles. World coordinates, metres, y up. Rings turn as the face
// does, holes the other way; mirrored leaves have theirs turned round. Faces with a coordinate that
// is no number, or is farther than kFarthestCity, are left out and counted.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "geom/mesh/face_triangles.h"
#include "io/exporters/city_kinds.h"
#include "scene/scene.h"

namespace gable {

/// A number of millimetres that doubles hold exactly with room for map coordinates.
constexpr double kFarthestCity = 1e9;

struct CityFace {
  /// The outer ring, and holes.
  std::vector<std::vector<Vec3>> rings;
  /// Newell's normal of the outer ring, not unit.
  Vec3 normal;
  uint16_t slot = 0;
};

/// Newell's normal of a ring: its length is twice the area.
Vec3 ringNormal(const std::vector<Vec3>& ring);

/// More looks up, less than its negative down: the upward part of a unit normal.
constexpr double kCityUp = 0.3;

/// How far above the lowest point of a building its ground may be, and below which height above it
/// nothing is a roof, in metres.
constexpr double kCityGround = 0.3, kLeastRoof = 1.5;

/// What a face of a building is by where it looks: upwards Roof, or Floor near the foot of the
/// building, `foot`; Wall to the side; downwards Ground at the foot and Ceiling above it.
CityKind kindBySight(const CityFace& face, double foot);

/// What several faces are by where they look.
class CitySights {
 public:
  void add(const CityFace& face, double foot);
  void clear() { areas_.clear(); }
  /// The kind of nearly all of their area; Unknown where they look several ways.
  CityKind oneWay() const;

 private:
  std::map<CityKind, double> areas_;
};

class CityFaces {
 public:
  explicit CityFaces(const Scene& scene) : scene_(scene) {}
  /// Calls `take` for each face with an area.
  void forEach(const Leaf& leaf, const Frame& world, const std::function<void(CityFace&)>& take);
  /// The box of a leaf where it stands.
  Box3 boxOf(const Leaf& leaf, const Frame& world);
  uint64_t leftOut() const { return leftOut_; }

 private:
  bool isFlat(const CityFace& face) const;
  void give(CityFace& face, bool turn, const std::function<void(CityFace&)>& take) const;

  const Scene& scene_;
  FaceTriangulator triangulator_;
  std::vector<Vec3> placed_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<Box3> meshBounds_;
  std::vector<bool> boundsKnown_;
  uint64_t leftOut_ = 0;
};

}  // namespace gable
