// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/slabs.h"

#include <algorithm>
#include <cmath>

#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/mesh/clip.h"

namespace gable {

Cuts cutsOf(const SplitPieces& pieces, double from, double whole) {
  Cuts cuts;
  double reached = 0;
  const auto add = [&](const SplitPiece& p) {
    const double tolerance = 1e-9 * (1 + whole);
    if (p.start > reached + tolerance) cuts.at.push_back(from + p.start);
    reached = p.start + p.size;
    cuts.slab.push_back(cuts.at.size());
    if (reached < whole - tolerance) cuts.at.push_back(from + reached);
  };
  // Pieces that are counted from the far end come from there.
  if (pieces.size() > 1 && pieces[1].start < pieces[0].start) {
    for (size_t i = pieces.size(); i-- > 0;) add(pieces[i]);
    std::reverse(cuts.slab.begin(), cuts.slab.end());
  } else {
    for (const SplitPiece& p : pieces) add(p);
  }
  return cuts;
}

Shape numbered(Shape child, size_t index, size_t total) {
  child.split = {static_cast<uint32_t>(index), static_cast<uint32_t>(total)};
  forgetFarTrimPlanes(child);
  return child;
}

void emitSlabs(OpCall& call, Axis axis, const SplitPieces& pieces, bool adjust, bool cap) {
  const Shape& s = call.shape();
  const MeshRef mesh = meshInScope(s);
  const auto a = static_cast<size_t>(axis);
  const double whole = std::fabs(s.size[a]);
  Cuts cuts = cutsOf(pieces, 0, whole);
  if (s.size[a] < 0) {
    // Parts are counted from the origin, against the axis.
    std::reverse(cuts.at.begin(), cuts.at.end());
    for (double& c : cuts.at) c = -c;
    for (size_t& slab : cuts.slab) slab = cuts.at.size() - slab;
  }
  CutOptions options;
  options.cap = cap;
  std::vector<MeshPart> parts = sliceAxis(*mesh, static_cast<int>(a), cuts.at, options);
  for (size_t i = 0; i < pieces.size(); ++i) {
    Mesh& part = parts[cuts.slab[i]].mesh;
    if (part.empty()) continue;
    Shape child = scopePart(s, axis, pieces[i].start, pieces[i].size);
    setPartMesh(child, s, std::move(part), adjust);
    call.emit(numbered(std::move(child), i, pieces.size()), pieces[i].slot,
              static_cast<uint32_t>(i));
  }
}

}  // namespace gable
