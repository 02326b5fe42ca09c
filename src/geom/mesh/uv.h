// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edits of the uv coordinates of a mesh. `set` is 0 to 9; a set that the mesh does not have stays
// absent, but for projections, which make it. Lengths are in the mesh's units, angles in degrees.
#pragma once

#include "geom/mesh/mesh.h"
#include "math/box.h"

namespace gable {

/// Empty when the mesh lacks the set.
Box2 uvBounds(const Mesh& m, int set);

/// u = dot(p - origin, u) and v alike: the vectors are the texture's axes divided by its size.
void projectUv(Mesh& m, int set, const Vec3& origin, const Vec3& u, const Vec3& v);

void scaleUv(Mesh& m, int set, Vec2 by);
void translateUv(Mesh& m, int set, Vec2 by);
/// Counter-clockwise about (0, 0).
void rotateUv(Mesh& m, int set, double degrees);

enum class UvNormalize : uint8_t { Both, Uniform, U, V };
/// Moves and scales to [0, 1]; Uniform keeps the aspect, so that the longer side fills it. A side
/// without extent moves to 0. Each face by itself or all together.
void normalizeUv(Mesh& m, int set, UvNormalize mode, bool eachFace);

/// Metres that one unit of u, and one of v, spans on the surface: the mean over faces by area, over
/// the triangles of faces that bend. Zero where the set is absent or has no extent.
Vec2 uvUnitLength(const Mesh& m, int set);

/// A face bends where a set is not linear over it, as that of a street along a curve. Cuts such
/// faces across, where their corners have values of u (coordinate 0) or v (1), so that lines of the
/// other coordinate run straight in each strip. Other faces stay.
Mesh cutWhereUvBends(const Mesh& m, int set, int coordinate);

struct UvTile {
  /// Metres a tile; 0 leaves the direction as it is, negative mirrors.
  double size = 0;
  /// Round to a whole number of tiles, at least one, over the range of the set.
  bool floating = false;
};
/// Scales so that a unit of uv spans a tile.
void tileUv(Mesh& m, int set, const UvTile& u, const UvTile& v);

void copyUv(Mesh& m, int from, int to);
void deleteUv(Mesh& m, int set);

}  // namespace gable
