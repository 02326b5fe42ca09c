// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/lists.h"
#include "geom/mesh/simplify.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Arguments {
  double tolerance;
};

Status applyReduceGeometry(OpCall& call, const Arguments& args) {
  Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::None) return {};
  setMesh(s, simplified(*meshInScope(s), args.tolerance), ScopeFit::Keep);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Arguments::tolerance>("tolerance", "The share of the vertices that shall go.")
        .between(0, 1),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    heavy({"reduceGeometry", "edit",
           "Takes vertices out of the geometry with the least change of its form.", kSignatures,
           typed<applyReduceGeometry>}),
};

}  // namespace

extern const OpList kOps_reduce_geometry;
const OpList kOps_reduce_geometry = kSpecs;

}  // namespace gable
