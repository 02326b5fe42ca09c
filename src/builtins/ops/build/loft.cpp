// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The outlines of the shape's faces are the lines of a skin, in the order of the faces.
#include "geom/mesh/loft.h"

#include "base/work.h"
#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Loft {
  bool caps = true, around = false;
};

Status applyLoft(OpCall& call, const Loft& args) {
  Shape& s = call.shape();
  const MeshRef mesh = meshInScope(s);
  std::vector<ClosedLine> lines;
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    const MeshLoop& outline = mesh->loopsOf(f)[0];
    if (outline.cornerCount < 3) continue;
    ClosedLine& line = lines.emplace_back();
    for (const uint32_t position : mesh->cornersOf(outline)) {
      work();
      line.push_back(mesh->positions[position]);
    }
  }
  if (lines.size() < 2) {
    return call.fail("no-geometry", "loft needs two faces at least, and bridges their outlines",
                     "put them into one shape: inline { Low t(0, 3, 0) High } loft()");
  }
  Mesh skin = loft(lines, {args.caps, args.around});
  s.assetMaterials = 0;
  setMesh(s, std::move(skin), ScopeFit::Refit);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Loft::caps>("caps", "Whether the first and the last face stay, as ends.", "true"),
    param<&Loft::around>("around", "Whether the last one is bridged to the first.", "false"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    heavy({"loft",
           "build",
           "Makes a skin through the outlines of the shape's faces.",
           kSignatures,
           typed<applyLoft>,
           BlockKind::None,
           kPure,
           {},
           false,
           true}),
};

}  // namespace

extern const OpList kOps_loft;
const OpList kOps_loft = kSpecs;

}  // namespace gable
