// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Boxes and rectangles are divided by arithmetic alone: a part of one is one. Other geometry is cut
// by planes, which close what they open, or along lines of equal uv coordinate.
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/ops/subdivide/shared/slabs.h"
#include "builtins/ops/subdivide/shared/split_sizes.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/uv.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The extent of a scope below which it cannot be divided.
constexpr double kFlat = 1e-9;

bool isPrimitive(const Geometry& g) { return g.kind != GeometryKind::Mesh && !g.uv; }

// Where a direction is named the parts are meant to fit. Else rules may well count on the cut, most
// of all those with a part that takes what the others leave.
void tellOverflow(const OpCall& call, double whole, bool meantToFit) {
  const auto& items = call.splitBlock().items;
  const bool gives = std::any_of(items.begin(), items.end(), [](const SplitItem& item) {
    return !item.group && item.unit == Unit::Floating;
  });
  if (gives && !meantToFit) return;
  const double over = overflowOf(call.splitBlock(), whole);
  if (over <= 1e-9 * (1 + whole)) return;
  const auto rounded = [](double v) { return shortestText(std::round(v * 1000) / 1000); };
  std::string what = "'split': the parts are " + rounded(over) + " m longer than the shape, of " +
                     rounded(whole) + " m; the last ones are cut or not made";
  const char* const hint = "make them smaller, or the shape larger";
  if (meantToFit) {
    call.services().warn("split-overflow", std::move(what), hint);
  } else {
    call.services().note("split-overflow", std::move(what), hint);
  }
}

enum class Adjust : uint8_t { Adjust, NoAdjust };
enum class Direction : uint8_t { FromRoot, ToRoot };
enum class Coordinate : uint8_t { U, V };
enum class UvSpace : uint8_t { UvSpace, UnitSpace };

}  // namespace

template <>
struct WordsOf<Adjust> {
  static constexpr const char* text = "adjust noAdjust";
};
template <>
struct WordsOf<Direction> {
  static constexpr const char* text = "fromRoot toRoot";
};
template <>
struct WordsOf<Coordinate> {
  static constexpr const char* text = "u v";
};
template <>
struct WordsOf<UvSpace> {
  static constexpr const char* text = "uvSpace unitSpace";
};

namespace {

// Along an axis of the scope, or along a texture coordinate.
struct Split {
  Axis axis;
  std::optional<Direction> direction;
  Adjust adjust;
  std::optional<Coordinate> coordinate;
  UvSpace space;
  double uvSet;
};

Status splitAlong(OpCall& call, const Split& args) {
  const Axis axis = args.axis;
  const Shape& s = call.shape();
  const double whole = std::fabs(component(s.size, axis));
  if (!(whole > kFlat)) {
    return flatAlong(call, axis);
  }
  SplitPieces pieces;
  const Status status = dividePattern(call.splitBlock(), whole, pieces);
  if (!status.ok()) return status;
  const bool directed = args.direction.has_value();
  if (args.direction == Direction::ToRoot) mirrorPieces(pieces, whole);
  tellOverflow(call, whole, directed);
  const bool adjust = args.adjust == Adjust::Adjust;
  if (isPrimitive(s.geometry)) {
    call.emitParts(axis, adjust, {pieces.begin(), pieces.size()}, !directed);
  } else {
    emitSlabs(call, axis, pieces, adjust, true);
  }
  return {};
}

Status splitUv(OpCall& call, const Split& args) {
  const Shape& s = call.shape();
  const auto set = static_cast<int>(args.uvSet);
  const MeshRef given = meshInScope(s);
  if (!given->hasUv(set)) {
    return call.fail("split-no-uv",
                     "the geometry has no texture coordinates in uv set " + std::to_string(set),
                     howToMakeUvs(s, set));
  }
  const auto a = static_cast<size_t>(*args.coordinate);
  // Cuts along a street follow its bends.
  const Mesh mesh = cutWhereUvBends(*given, set, 1 - static_cast<int>(a));
  const Box2 box = uvBounds(mesh, set);
  const double range = box.max[a] - box.min[a];
  const bool units = args.space == UvSpace::UnitSpace;
  const double whole = units ? range * uvUnitLength(mesh, set)[a] : range;
  if (!(whole > kFlat)) {
    return call.fail("split-flat", "the texture coordinates have no extent in this direction", {});
  }
  SplitPieces pieces;
  const Status status = dividePattern(call.splitBlock(), whole, pieces);
  if (!status.ok()) return status;
  Cuts cuts = cutsOf(pieces, 0, whole);
  for (double& c : cuts.at) c = box.min[a] + c * (range / whole);
  std::vector<double> field;
  for (const Vec2 uv : mesh.uvs[static_cast<size_t>(set)]) field.push_back(uv[a]);
  std::vector<MeshPart> parts = sliceField(mesh, field, cuts.at);
  for (size_t i = 0; i < pieces.size(); ++i) {
    work(4);
    Mesh& part = parts[cuts.slab[i]].mesh;
    if (part.empty()) continue;
    Shape child = s;
    setPartMesh(child, s, std::move(part), true);
    call.emit(numbered(std::move(child), i, pieces.size()), pieces[i].slot,
              static_cast<uint32_t>(i));
  }
  return {};
}

Status applySplit(OpCall& call, const Split& args) {
  return args.coordinate ? splitUv(call, args) : splitAlong(call, args);
}

constexpr ParamSpec kScopeParams[] = {
    param<&Split::axis>("axis", "The scope axis along which to divide."),
    param<&Split::adjust>(
        "adjustMode",
        "Whether a part's scope is fitted to its geometry, or parts fill the scope without gaps.",
        "adjust"),
};
constexpr ParamSpec kDirectionParams[] = {
    kScopeParams[0],
    param<&Split::direction>(
        "direction", "Whether the first part lies at the scope's origin or at its far end."),
    kScopeParams[1],
};
constexpr ParamSpec kUvParams[] = {
    param<&Split::coordinate>("direction", "The texture coordinate along which to divide."),
    param<&Split::space>("surfaceParameterization",
                         "Whether sizes count in texture coordinates or in metres on the surface."),
    param<&Split::uvSet>("uvSet", "The uv set, 0 to 9.").between(0, kUvSets - 1),
};
constexpr Signature kSignatures[] = {{kScopeParams}, {kDirectionParams}, {kUvParams}};

constexpr OpSpec kSpecs[] = {
    {"split", "subdivide", "Divides the shape into parts along a direction.", kSignatures,
     typed<applySplit>, BlockKind::Split, kIgnoresTags},
};

}  // namespace

extern const OpList kOps_split;
const OpList kOps_split = kSpecs;

}  // namespace gable
