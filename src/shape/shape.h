// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Shape: what a rule sees and rewrites. A small value: a scope (an oriented box), a pivot, a
// geometry handle, and interned material and attributes. Copying one allocates nothing.
//
// Frames. Scope and pivot lie in the local frame of the rule call that works on the shape; the
// runtime knows where that frame lies in the world (OpCall::world). A point p of the scope lies at
// scope.point(p); the scope covers [0,size] of its own axes. Sizes may be negative (a mirrored
// scope) or zero (a face, an edge, a point).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/ref.h"
#include "geom/mesh/mesh.h"
#include "material/material.h"
#include "math/affine.h"
#include "math/frame.h"
#include "program/value.h"

namespace gable {

/// A box or a rectangle stays a primitive until an operation needs polygons.
enum class GeometryKind : uint8_t {
  None,
  /// [0,sx] x [0,sy] in the plane z = 0 of the scope, normal +z.
  QuadXy,
  /// [0,sx] x [0,sz] in the plane y = 0, normal +y.
  QuadXz,
  /// Fills the scope.
  Box,
  /// `mesh` in scope coordinates, made when the scope had the size `refSize`: a position lies at
  /// p * size / refSize (component by component; by 1 where refSize is 0).
  Mesh,
};

/// The order of a box's faces and where their rings begin: rules see both through indices.
enum class BoxOrder : uint8_t {
  /// That of primitiveCube; see makeBoxMesh.
  Cube,
  /// That of an extruded QuadXz: bottom, front, right, back, left, top.
  Extruded,
};

/// The sides of a box, as places in Geometry::tags.
enum BoxSide : uint8_t { kSideLeft, kSideRight, kSideBottom, kSideTop, kSideBack, kSideFront };

struct Geometry {
  GeometryKind kind = GeometryKind::None;
  /// A primitive that carries uv set 0 (each face 0..1). Meshes have their own.
  bool uv = false;
  Vec3 refSize;
  MeshRef mesh;
  /// Boxes only.
  BoxOrder order = BoxOrder::Cube;
  /// Tag sets of a box's faces, by the side they look to. A rectangle has those of its face at
  /// the side it looks to (QuadXy kSideFront, QuadXz kSideTop) and those of its edges at the sides
  /// they look to; see quadEdges. All zero for meshes.
  std::array<uint32_t, 6> tags{};
  /// An asset or a primitive as it was inserted, whatever became of the scope since.
  bool instanced = false;

  /// True when an operation could tell the two apart at equal scope sizes. Meshes are compared by
  /// identity.
  friend bool operator==(const Geometry&, const Geometry&) = default;
};

/// Agrees with ==, but hashes the content of a mesh: O(size of the mesh).
uint64_t contentHash(const Geometry& g);

/// The rings of a box in face order, as indices of the positions of makeBoxMesh, and the side
/// that each face looks to.
struct BoxFace {
  std::array<uint8_t, 4> ring;
  BoxSide side;
};
const std::array<BoxFace, 6>& boxFaces(BoxOrder order);

/// The sides that the edges of a rectangle look to, in the order of its ring.
const std::array<BoxSide, 4>& quadEdges(GeometryKind quad);
/// True when a rectangle's edges have tags.
bool hasEdgeTags(const Geometry& quad);

/// A half-space dot(normal, p) <= distance, in the frame of the shape that carries it.
struct TrimPlane {
  Vec3 normal;
  double distance = 0;
  /// Of an edge under 40 degrees to the pivot's ground plane.
  bool horizontal = false;
};

/// A prepared planar projection (setupProjection), in the frame of the shape that carries it:
/// u = dot(p - origin, frame.x) / width + offsetU, v likewise with y; uwFactor adds dot(.., z).
struct UvProjection {
  int set = 0;
  Frame frame;
  double width = 1, height = 1, offsetU = 0, offsetV = 0, uwFactor = 0;
};

/// What no orthonormal scope can say: a shear, or a far side unlike the near one. A point u of the
/// unit cube lies at scope.point(scaled(near(u), size)) on the near side, at that of `far` on the
/// far side, and between them in between. Scope and size stay as they were when the deformation
/// began; see shape/deformation.h.
struct Deformation {
  Affine near, far;
  /// Factors on the points of a body's front, then of its top, done before all else.
  Vec3 front{1, 1, 1}, top{1, 1, 1};
  bool operator==(const Deformation&) const = default;
};

/// What few shapes carry. Immutable once shared; frames as the shape's. Never leaves its worker.
struct ShapeExtra : LocalRefCounted {
  std::vector<TrimPlane> trim;
  bool deformed = false;
  Deformation deformation;
  /// By uv set, those that have one.
  std::vector<UvProjection> projections;

  /// Null where the set has none.
  const UvProjection* projection(int set) const;
  /// Takes the place of the set's former one.
  void setProjection(const UvProjection& p);
};

struct IndexInfo {
  uint32_t index = 0;
  uint32_t total = 0;
};

struct Shape {
  Frame scope;
  Vec3 size;
  Frame pivot;
  Geometry geometry;
  MaterialId material = 0;
  /// 0, or an id of AttributePool's material lists: the materials of the mesh's slots 1, 2, ...
  uint32_t assetMaterials = 0;
  /// An id of the AttributePool: the attributes that set() changed.
  uint32_t attributes = 0;
  /// The innermost value that `local` gave to an attribute, as the runtime counts them; 0 for none.
  uint32_t locals = 0;
  bool trimVertical = true;
  bool trimHorizontal = false;
  IndexInfo split;
  IndexInfo comp;
  StringId compSelector = 0;
  /// The address of the shape for randomness; see base/random.h.
  uint64_t path = 0;
  Ref<ShapeExtra> extra;
};

/// The geometry in scope coordinates at the present size (mirrored when a size is negative), as a
/// mesh. Shares the stored mesh when no scaling is needed. O(size of the mesh).
MeshRef meshInScope(const Shape& s);

/// The same in the shape's local frame (scope applied).
Mesh meshInLocal(const Shape& s);

/// What becomes of the scope when the geometry changes.
enum class ScopeFit : uint8_t {
  /// Origin, axes and size stay.
  Keep,
  /// The scope becomes the bounding box of the new geometry along its present axes.
  Refit,
};

/// Gives the shape a mesh in scope coordinates. Meshes that are exactly a rectangle or a box that
/// fills the scope become primitives again.
void setMesh(Shape& s, Mesh mesh, ScopeFit fit);
void setMesh(Shape& s, MeshRef mesh, ScopeFit fit);

/// A primitive that fills the scope, with one tag set on all of its faces.
Geometry primitive(GeometryKind kind, uint32_t tags = 0);

/// Puts the scope of a shape to `frame` (in the local frame) with its geometry where it is; the
/// size becomes the bounding box along the new axes, and the origin its lower corner. A shape
/// without geometry keeps the box of its old scope.
void alignScope(Shape& s, const Frame& axes);

/// Makes `s` the start of a derivation: the geometry in its object frame, with the scope of the
/// language's initial shapes. A single face gets y along its normal and x along its first edge;
/// other geometry keeps the object's axes. The pivot has the scope's axes and stands at the first
/// vertex of the first face; without faces it is the scope's frame.
void setInitialGeometry(Shape& s, const Mesh& mesh);

/// The extra of `s` for editing: a copy of its own. Put it back with s.extra = makeRef(...).
ShapeExtra extraOf(const Shape& s);

/// Faces, edges and positions of the geometry without making a mesh of primitives.
struct GeometryCounts {
  uint32_t faces = 0, edges = 0, vertices = 0, holes = 0;
};
GeometryCounts countsOf(const Geometry& g);

}  // namespace gable
