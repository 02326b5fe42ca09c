// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/mesh/cleanup.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/trim.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The scope stays: cleaning is not meant to change how the shape looks.
Status applyCleanup(OpCall& call) {
  Shape& s = call.shape();
  CleanupOptions options;
  options.tolerance = call.number(1);
  if (!(options.tolerance >= 0 && options.tolerance <= 1)) {
    return call.fail("cleanup-tolerance", "the tolerance of a cleanup is not within 0 and 1",
                     "0 cleans what matches exactly, 1 allows a metre and 10 degrees");
  }
  const bool all = call.is(0, "all");
  options.vertices = all || call.is(0, "vertices");
  options.edges = all || call.is(0, "edges");
  options.faces = all || call.is(0, "faces");
  if (!options.vertices && !options.edges && !options.faces) {
    return call.fail("cleanup-components", "there is no such kind of component to clean up",
                     "the kinds are vertices, edges, faces and all");
  }
  if (s.geometry.kind != GeometryKind::Mesh) return {};
  Mesh mesh = *meshInScope(s);
  cleanup(mesh, options);
  setMesh(s, std::move(mesh), ScopeFit::Keep);
  return {};
}

Status applyTrim(OpCall& call) {
  trimGeometry(call.shape());
  return {};
}

constexpr ParamSpec kCleanupParams[] = {
    {"components", ParamType::Selector, "What to clean up.", nullptr, "vertices edges faces all"},
    {"tolerance", ParamType::Float,
     "0 cleans what matches exactly; 1 allows a metre, 10 degrees and a square metre."},
};
constexpr Signature kCleanup[] = {{kCleanupParams}};
constexpr Signature kNone[] = {{}};

constexpr OpSpec kSpecs[] = {
    heavy({"cleanupGeometry", "edit",
           "Unites vertices and coplanar faces and drops degenerate ones.", kCleanup,
           applyCleanup}),
    heavy({"trim", "edit", "Cuts the geometry by the trim planes that a component split left.",
           kNone, applyTrim, BlockKind::None, kUsesTrim}),
};

}  // namespace

extern const OpList kOps_cleanup;
const OpList kOps_cleanup = kSpecs;

}  // namespace gable
