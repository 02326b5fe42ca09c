// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// World: a scene as triangles in single precision, ready for rays.
//
// A part is a set of triangles with its own acceleration structure; part 0 holds everything that
// stands only once, in world coordinates less `origin`; the others are prototypes that are placed
// several times. Placements are one level deep: prototypes within a placed prototype are merged
// into it where that costs less memory than placing them one by one.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "math/box.h"
#include "math/frame.h"
#include "render/surface.h"
#include "render/vec3f.h"
#include "scene/scene.h"

namespace gable::rt {

constexpr uint32_t kNone = 0xffffffff;

/// What a corner carries beyond its position: word 0 says what follows. Bit 0: three normals, one
/// word each (octahedral); bit 1 + s: three pairs of floats for uv set s, in the order of sets.
using AttributePool = std::vector<uint32_t>;

struct TriangleSet {
  /// With one more at the end that no triangle uses.
  std::vector<Vec3f> positions;
  /// All that a hit asks of one lies together in memory.
  struct Triangle {
    /// Indices into `positions`.
    std::array<uint32_t, 3> corners;
    /// Indices into World::materials and Part::pieces.
    uint32_t material = 0, piece = 0;
    /// Where its record begins in the pool, or kNone.
    uint32_t attributes = kNone;
  };
  std::vector<Triangle> triangles;
  AttributePool pool;
};

/// A leaf as it stands in a part.
struct Piece {
  /// Index into Scene::leaves, and of the root it belongs to (of part 0; placements have their
  /// own).
  uint32_t leaf = 0, root = 0;
  /// The middle of its box and its longest side, in the part.
  Vec3f middle;
  float size = 0;
};

struct Part {
  /// Light passes some triangles of `clear` and none of `solid`.
  TriangleSet solid, clear;
  std::vector<Piece> pieces;
  Box3 bounds;
  /// Area of the box about what lies within half a metre above the part's lowest point.
  double footArea = 0;
  /// Sum over upright triangles of area and of area * (cos, sin) of four times the compass angle
  /// of their normals: the directions in which its walls look, quarter turns apart.
  double wallArea = 0, wallCos = 0, wallSin = 0;
  uint64_t triangles() const { return solid.triangles.size() + clear.triangles.size(); }
  const TriangleSet& set(bool isClear) const { return isClear ? clear : solid; }
};

struct Placement {
  uint32_t part = 0;
  uint32_t root = 0;
  /// The number of its first piece among those of all parts and placements; part 0 comes first.
  uint32_t firstPiece = 0;
  Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;
};

/// Less World::origin: what lies beyond is cut away.
struct Cut {
  Vec3f normal{0, 1, 0};
  float offset = 0;
  float beyond(const Vec3f& p) const { return dot(normal, p) - offset; }
  /// Where the line between two points of either side goes through.
  Vec3f between(const Vec3f& a, const Vec3f& b) const {
    return mix(a, b, beyond(a) / (beyond(a) - beyond(b)));
  }
};

struct World {
  std::vector<Part> parts;
  std::vector<Placement> placements;
  std::vector<SurfaceMaterial> materials;
  TextureTable textures;
  /// Subtracted from world coordinates before rounding.
  Vec3 origin;
  /// Of everything, less `origin`; a unit box about it for an empty scene.
  Box3 bounds;
  /// What pictures are of: all of it, or the place without the land that runs on around it.
  Box3 subject;
  /// Height of the scene's foot less `origin`, single deep things left out.
  double footHeight = 0;
  /// Compass angle of a wall normal (degrees, in (-45, 45]) and how far walls agree on it, 0 to 1.
  double wallAngle = 0, wallAgreement = 0;
  /// With placements expanded.
  uint64_t triangles = 0;
};

/// O(triangles stored). Textures are asked for here, once each.
World makeWorld(const Scene& scene, const TextureSource* textures);

/// Points that span the subject for framing, or what a cut leaves of it: corners of triangles, and
/// where the cut goes through their sides. About `limit` at most.
std::vector<Vec3f> framingPoints(const World& world, const Cut* cut = nullptr,
                                 size_t limit = 200000);

uint32_t packNormal(const Vec3f& n);
Vec3f unpackNormal(uint32_t packed);

}  // namespace gable::rt
