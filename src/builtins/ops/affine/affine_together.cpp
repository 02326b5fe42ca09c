// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A deformation of several bodies as one: their common box along the object's axes is taken for the
// cube from -1 to 1, and what lies beyond its middle is scaled and moved there, for x, y and z in
// this order. Faces that are no longer flat become triangles.

#include <algorithm>

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "geom/mesh/topology.h"
#include "math/box.h"
#include "shape/deformation.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr size_t kNumbers = 9;
/// Half of the least size of the common box: a flat one has no other side.
constexpr double kLeastHalf = 1e-6;

struct Sides {
  Floats factors, moves;
};

// Numbers `3 * axis` to `3 * axis + 2`.
Vec3 sideOf(const Floats& numbers, size_t axis) {
  const double* n = numbers.array->numbers.data() + 3 * axis;
  return {n[0], n[1], n[2]};
}

// Waits for the bodies.
Status beginTogether(OpCall& call, const Sides& args) {
  if (args.factors.array->size() != kNumbers || args.moves.array->size() != kNumbers) {
    return call.fail("bad-argument", "affineTogether takes nine factors and nine moves",
                     "write three for each axis: [1, 1, 1, 1, 1, 1, 1, 1, 1]");
  }
  uint32_t piece = 0;
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.empty()) call.emit(call.shape(), item.slot, piece++);
  }
  call.gather();
  return {};
}

Vec3 deformed(Vec3 p, const Sides& sides) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] > 0) p = scaled(p, sideOf(sides.factors, axis)) + sideOf(sides.moves, axis);
  }
  return p;
}

Status deformTogether(OpCall& call, std::span<Gathered> leaves) {
  Sides sides;
  if (Status bound = call.bind(&sides); !bound.ok()) return bound;
  const Frame frame = objectFrame(call.services());
  std::vector<Mesh> meshes;
  Box3 box;
  for (const Gathered& leaf : leaves) {
    Mesh& mesh = meshes.emplace_back(meshInLocal(leaf.shape));
    for (Vec3& p : mesh.positions) box.include(p = frame.toLocal(p));
  }
  if (meshes.empty()) return {};
  const Vec3 middle = (box.min + box.max) * 0.5;
  Vec3 half = (box.max - box.min) * 0.5;
  for (size_t axis = 0; axis < 3; ++axis) half[axis] = std::max(half[axis], kLeastHalf);
  for (size_t i = 0; i < meshes.size(); ++i) {
    Mesh& mesh = meshes[i];
    const bool inside = volume(mesh) < 0;
    for (Vec3& p : mesh.positions) {
      Vec3 unit = p - middle;
      for (size_t axis = 0; axis < 3; ++axis) unit[axis] /= half[axis];
      p = middle + scaled(deformed(unit, sides), half);
    }
    // The normals of curved faces would have to be made anew.
    mesh.normals.clear();
    Mesh flat = flatFaces(mesh);
    if (!flat.valid()) {
      return call.fail("not-finite", "what is deformed together has no finite place",
                       "see what the factors and moves are");
    }
    if ((volume(flat) < 0) != inside) {
      for (size_t f = 0; f < flat.faceCount(); ++f) reverseFace(flat, f);
    }
    Shape& s = leaves[i].shape;
    s.scope = frame;
    s.size = {1, 1, 1};
    s.geometry = {GeometryKind::Mesh, false, {1, 1, 1}, makeRef<Mesh>(std::move(flat))};
  }
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Sides::factors>("factors",
                           "Nine factors: along x, y and z for the far side of x, then for those "
                           "of y and z."),
    param<&Sides::moves>("moves", "Nine moves, in halves of the common box, in the same order."),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"affineTogether",
     "affine",
     "Deforms all that a block leaves as one body, by the sides of their common box.",
     kSignatures,
     typed<beginTogether>,
     BlockKind::Operations,
     kTakesDeformed | kReadsWorld | kReadsInitialShape,
     kNoParts,
     false,
     true,
     {},
     1,
     deformTogether},
};

}  // namespace

extern const OpList kOps_affine_together;
const OpList kOps_affine_together = kSpecs;

}  // namespace gable
