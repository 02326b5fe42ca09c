// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/mesh/cleanup.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/trim.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Components : uint8_t { Vertices, Edges, Faces, All };

}  // namespace

template <>
struct WordsOf<Components> {
  static constexpr const char* text = "vertices edges faces all";
};

namespace {

struct Cleanup {
  Components components;
  double tolerance;
};

// The scope stays: cleaning is not meant to change how the shape looks.
Status applyCleanup(OpCall& call, const Cleanup& args) {
  Shape& s = call.shape();
  CleanupOptions options;
  options.tolerance = args.tolerance;
  const auto cleans = [&](Components c) {
    return args.components == c || args.components == Components::All;
  };
  options.vertices = cleans(Components::Vertices);
  options.edges = cleans(Components::Edges);
  options.faces = cleans(Components::Faces);
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
    param<&Cleanup::components>("components", "What to clean up."),
    param<&Cleanup::tolerance>(
        "tolerance",
        "0 cleans what matches exactly; 1 allows a metre, 10 degrees and a square metre.")
        .between(0, 1),
};
constexpr Signature kCleanup[] = {{kCleanupParams}};
constexpr Signature kNone[] = {{}};

constexpr OpSpec kSpecs[] = {
    heavy({"cleanupGeometry", "edit",
           "Unites vertices and coplanar faces and drops degenerate ones.", kCleanup,
           typed<applyCleanup>}),
    heavy({"trim", "edit", "Cuts the geometry by the trim planes that a component split left.",
           kNone, applyTrim, BlockKind::None, kUsesTrim}),
};

}  // namespace

extern const OpList kOps_cleanup;
const OpList kOps_cleanup = kSpecs;

}  // namespace gable
