// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/ops/subdivide/shared/slabs.h"
#include "geom/mesh/clip.h"

namespace gable {

namespace {

// The extent of a scope below which it cannot be divided.
constexpr double kFlat = 1e-9;

std::vector<MeshPart> slicesOf(const Mesh& m, const Shape& s, Axis axis, const SplitPieces& pieces,
                               std::vector<size_t>& slab) {
  const auto a = static_cast<size_t>(axis);
  Cuts cuts = cutsOf(pieces, 0, std::fabs(s.size[a]));
  if (s.size[a] < 0) {
    std::reverse(cuts.at.begin(), cuts.at.end());
    for (double& c : cuts.at) c = -c;
    for (size_t& i : cuts.slab) i = cuts.at.size() - i;
  }
  slab = cuts.slab;
  CutOptions options;
  options.cap = true;
  return sliceAxis(m, static_cast<int>(a), cuts.at, options);
}

// A cell has no tags on the sides that the cuts made.
void dropInnerTags(Geometry& g, Axis axis, const SplitPiece& piece, double whole) {
  const auto a = static_cast<size_t>(axis);
  if (piece.start > 0) g.tags[2 * a] = 0;
  if (piece.start + piece.size < whole * (1 - 1e-12)) g.tags[2 * a + 1] = 0;
}

}  // namespace

Cells::Cells(const Shape& shape, Axis u, const SplitPieces& first, Axis v,
             const SplitPieces& second)
    : shape_(shape), u_(u), v_(v), first_(first), second_(second) {
  primitive_ = shape.geometry.kind != GeometryKind::Mesh && !shape.geometry.uv;
  if (primitive_) return;
  const size_t columns = std::max<size_t>(1, second.size());
  meshes_.resize(first.size() * columns);
  std::vector<size_t> slab;
  std::vector<MeshPart> slices = slicesOf(*meshInScope(shape), shape, u, first, slab);
  for (size_t i = 0; i < first.size(); ++i) {
    Mesh& slice = slices[slab[i]].mesh;
    if (second.size() == 0) {
      meshes_[i] = std::move(slice);
      continue;
    }
    if (slice.empty()) continue;
    std::vector<size_t> inner;
    std::vector<MeshPart> cells = slicesOf(slice, shape, v, second, inner);
    for (size_t j = 0; j < columns; ++j) {
      meshes_[i * columns + j] = std::move(cells[inner[j]].mesh);
    }
  }
}

bool Cells::take(size_t i, size_t j, Shape& out) {
  const bool both = second_.size() > 0;
  out = scopePart(shape_, u_, first_[i].start, first_[i].size);
  if (both) out = scopePart(out, v_, second_[j].start, second_[j].size);
  if (primitive_) {
    const auto size = [&](Axis a) { return std::fabs(component(shape_.size, a)); };
    dropInnerTags(out.geometry, u_, first_[i], size(u_));
    if (both) dropInnerTags(out.geometry, v_, second_[j], size(v_));
  } else {
    Mesh& mesh = meshes_[both ? i * second_.size() + j : i];
    if (mesh.empty()) return false;
    setPartMesh(out, shape_, std::move(mesh), true);
  }
  forgetFarTrimPlanes(out);
  return true;
}

bool axesAround(const Shape& s, Axis axis, AxisPair& out) {
  constexpr std::array<AxisPair, 3> kPairs{
      {{Axis::X, Axis::Y, Axis::Z}, {Axis::Y, Axis::X, Axis::Z}, {Axis::Z, Axis::X, Axis::Y}}};
  const auto flat = [&](Axis a) { return !(std::fabs(component(s.size, a)) > kFlat); };
  int count = 0;
  for (const Axis a : {Axis::X, Axis::Y, Axis::Z}) {
    if (!flat(a)) continue;
    ++count;
    axis = a;
  }
  out = kPairs[static_cast<size_t>(axis)];
  return count < 2;
}

double roundedCount(double ratio, std::string_view rounding) {
  // Equal lengths with rounding errors in them are equal.
  const double nearest = std::nearbyint(ratio);
  if (std::fabs(ratio - nearest) <= 1e-9 * (1 + std::fabs(ratio))) ratio = nearest;
  const double below = std::floor(ratio), above = std::ceil(ratio);
  double n = std::floor(ratio + 0.5);
  if (rounding == "floor") n = below;
  if (rounding == "ceil") n = above;
  // To the even of two that are equally near, in the processor's own rounding mode: to nearest.
  if (rounding == "even") n = std::nearbyint(ratio);
  // The count whose pieces differ least from what is wanted: ratio / n against 1.
  if (rounding == "closest")
    n = below > 0 && ratio / below - 1 <= 1 - ratio / above ? below : above;
  return std::max(1.0, n);
}

Status equalPieces(double whole, double preferred, std::string_view rounding, SplitPieces& out) {
  const double n = preferred > 0 ? roundedCount(whole / preferred, rounding) : 1;
  if (!(n <= kMaxSplitPieces)) {
    return Status::failure(
        "split-too-many",
        "this would make more than " + std::to_string(kMaxSplitPieces) + " shapes",
        "make the preferred size larger");
  }
  const double size = whole / n;
  for (double i = 0; i < n; ++i) out.push_back({i * size, size, 0});
  return {};
}

}  // namespace gable
