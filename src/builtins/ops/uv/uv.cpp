// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edits of texture coordinates. A mesh keeps its size of reference, so nothing of the geometry is
// touched; a primitive with the coordinates that it carries anyway stays a primitive.

#include <algorithm>
#include <cmath>
#include <string>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/subdivide/shared/uv_extent.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

using UvSet = std::vector<Vec2>;

// Runs an edit on the coordinates of a set; without coordinates there is nothing to do.
template <class Edit>
Status editSet(OpCall& call, double number, Edit edit) {
  const auto set = static_cast<int>(number);
  if (!hasUvSet(call.shape(), set)) return {};
  editMesh(call.shape(), [&](Mesh& m) { edit(m, m.uvs[static_cast<size_t>(set)]); });
  return {};
}

template <class Map>
Status mapSet(OpCall& call, double number, Map map) {
  return editSet(call, number, [&](Mesh&, UvSet& uvs) {
    for (Vec2& uv : uvs) uv = map(uv);
  });
}

// A set and a number for each coordinate.
struct PerCoordinate {
  double uvSet;
  double u, v;
};

Status applyScale(OpCall& call, const PerCoordinate& args) {
  return mapSet(call, args.uvSet, [&](Vec2 uv) { return Vec2{uv.x * args.u, uv.y * args.v}; });
}

Status applyTranslate(OpCall& call, const PerCoordinate& args) {
  const Vec2 by{args.u, args.v};
  return mapSet(call, args.uvSet, [&](Vec2 uv) { return uv + by; });
}

struct RotateUv {
  double uvSet, angle;
};

Status applyRotate(OpCall& call, const RotateUv& args) {
  const double c = cosDeg(args.angle), s = sinDeg(args.angle);
  return mapSet(call, args.uvSet, [&](Vec2 uv) {
    return Vec2{uv.x * c - uv.y * s, uv.x * s + uv.y * c};
  });
}

enum class NormalizeMode : uint8_t { Uv, UvUniform, U, V };
enum class NormalizeType : uint8_t { SeparatePerFace, CollectiveAllFaces };

}  // namespace

template <>
struct WordsOf<NormalizeMode> {
  static constexpr const char* text = "uv uvUniform u v";
};
template <>
struct WordsOf<NormalizeType> {
  static constexpr const char* text = "separatePerFace collectiveAllFaces";
};

namespace {

struct NormalizeUv {
  double uvSet;
  NormalizeMode mode;
  NormalizeType type;
};

// Brings the coordinates of some corners into [0, 1].
void normalize(UvSet& uvs, const std::vector<uint32_t>& corners, NormalizeMode mode) {
  Box2 box;
  for (const uint32_t c : corners) box.include(uvs[c]);
  if (box.empty()) return;
  Vec2 by = box.min, size = box.size();
  if (mode == NormalizeMode::UvUniform) size = {std::max(size.x, size.y), std::max(size.x, size.y)};
  Vec2 factor{size.x > 0 ? 1 / size.x : 0, size.y > 0 ? 1 / size.y : 0};
  if (mode == NormalizeMode::U) {
    by.y = 0;
    factor.y = 1;
  } else if (mode == NormalizeMode::V) {
    by.x = 0;
    factor.x = 1;
  }
  for (const uint32_t c : corners) {
    work();
    uvs[c] = {(uvs[c].x - by.x) * factor.x, (uvs[c].y - by.y) * factor.y};
  }
}

Status applyNormalize(OpCall& call, const NormalizeUv& args) {
  const NormalizeMode mode = args.mode;
  const bool separate = args.type == NormalizeType::SeparatePerFace;
  return editSet(call, args.uvSet, [&](Mesh& m, UvSet& uvs) {
    std::vector<uint32_t> corners;
    for (size_t f = 0; f < m.faceCount(); ++f) {
      for (const MeshLoop& loop : m.loopsOf(f)) {
        work(loop.cornerCount);
        for (uint32_t i = 0; i < loop.cornerCount; ++i) corners.push_back(loop.firstCorner + i);
      }
      if (!separate) continue;
      normalize(uvs, corners, mode);
      corners.clear();
    }
    normalize(uvs, corners, mode);
  });
}

// The factor that makes tiles of the size asked for out of what one coordinate spans.
double tileFactor(const Size& tile, const UvExtent& extent) {
  const double range = extent.max - extent.min;
  if (tile.number == 0 || range <= 0 || extent.metres <= 0) return 1;
  double tiles = 1 / tile.number;
  if (tile.unit == Unit::Floating) {
    tiles = std::max(1.0, std::round(extent.metres / std::fabs(tile.number)));
    if (tile.number < 0) tiles = -tiles;
  } else if (tile.unit == Unit::Absolute) {
    tiles = extent.metres / tile.number;
  }
  return tiles / range;
}

struct TileUv {
  double uvSet;
  FloatingSize width, height;
};

Status applyTile(OpCall& call, const TileUv& args) {
  const auto set = static_cast<int>(args.uvSet);
  if (!hasUvSet(call.shape(), set)) return {};
  const MeshRef measured = meshInScope(call.shape());
  const Vec2 factor{tileFactor(args.width, uvExtent(*measured, set, 0)),
                    tileFactor(args.height, uvExtent(*measured, set, 1))};
  return mapSet(call, args.uvSet, [&](Vec2 uv) { return Vec2{uv.x * factor.x, uv.y * factor.y}; });
}

struct DeleteUv {
  double uvSet;
};

Status applyDelete(OpCall& call, const DeleteUv& args) {
  const auto set = static_cast<int>(args.uvSet);
  Geometry& g = call.shape().geometry;
  if (!hasUvSet(call.shape(), set)) return {};
  if (g.kind != GeometryKind::Mesh) {
    g.uv = false;
    g.instanced = false;
    return {};
  }
  editMesh(call.shape(), [&](Mesh& m) { m.uvs[static_cast<size_t>(set)].clear(); });
  return {};
}

struct CopyUv {
  double from, to;
};

Status applyCopy(OpCall& call, const CopyUv& args) {
  const auto from = static_cast<int>(args.from), to = static_cast<int>(args.to);
  if (from == to || (!hasUvSet(call.shape(), from) && !hasUvSet(call.shape(), to))) return {};
  editMesh(call.shape(),
           [&](Mesh& m) { m.uvs[static_cast<size_t>(to)] = m.uvs[static_cast<size_t>(from)]; });
  return {};
}

constexpr const char* kSetDoc = "The uv set, 0 to 9.";

constexpr ParamSpec kScaleParams[] = {
    param<&PerCoordinate::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1),
    param<&PerCoordinate::u>("uFactor", "What u is multiplied by."),
    param<&PerCoordinate::v>("vFactor", "What v is multiplied by."),
};
constexpr Signature kScaleSignatures[] = {{kScaleParams}};

constexpr ParamSpec kTranslateParams[] = {
    param<&PerCoordinate::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1),
    param<&PerCoordinate::u>("uOffset", "What is added to u; 1 is the width of the texture."),
    param<&PerCoordinate::v>("vOffset", "What is added to v."),
};
constexpr Signature kTranslateSignatures[] = {{kTranslateParams}};

constexpr ParamSpec kRotateParams[] = {
    param<&RotateUv::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1),
    param<&RotateUv::angle>("angle", "The turn around u = v = 0, in degrees."),
};
constexpr Signature kRotateSignatures[] = {{kRotateParams}};

constexpr ParamSpec kNormalizeParams[] = {
    param<&NormalizeUv::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1),
    param<&NormalizeUv::mode>(
        "normalizeMode",
        "Both coordinates each by itself, both by the larger one, or only one of them."),
    param<&NormalizeUv::type>("normalizeType",
                              "Whether each face comes to fill [0, 1] or all faces together."),
};
constexpr Signature kNormalizeSignatures[] = {{kNormalizeParams}};

constexpr ParamSpec kTileParams[] = {
    param<&TileUv::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1),
    param<&TileUv::width>(
        "textureWidth",
        "Width of a tile in metres; with ' as a share of what there is, with ~ about that wide so "
        "that whole tiles fit; 0 leaves u."),
    param<&TileUv::height>("textureHeight", "Height of a tile, likewise; 0 leaves v."),
};
constexpr Signature kTileSignatures[] = {{kTileParams}};

constexpr ParamSpec kDeleteParams[] = {
    param<&DeleteUv::uvSet>("uvSet", kSetDoc).between(0, kUvSets - 1)};
constexpr Signature kDeleteSignatures[] = {{kDeleteParams}};

constexpr ParamSpec kCopyParams[] = {
    param<&CopyUv::from>("uvSetSource", "The uv set to copy, 0 to 9.").between(0, kUvSets - 1),
    param<&CopyUv::to>("uvSetDest", "The uv set to overwrite, 0 to 9.").between(0, kUvSets - 1),
};
constexpr Signature kCopySignatures[] = {{kCopyParams}};

constexpr OpSpec kSpecs[] = {
    {"scaleUV", "uv", "Multiplies texture coordinates.", kScaleSignatures, typed<applyScale>},
    {"translateUV", "uv", "Shifts texture coordinates.", kTranslateSignatures,
     typed<applyTranslate>},
    {"offsetUV", "uv", "Old name of translateUV.", kTranslateSignatures, typed<applyTranslate>},
    {"rotateUV", "uv", "Turns texture coordinates around their origin.", kRotateSignatures,
     typed<applyRotate>},
    {"normalizeUV", "uv", "Brings texture coordinates into the range from 0 to 1.",
     kNormalizeSignatures, typed<applyNormalize>},
    {"tileUV", "uv", "Scales texture coordinates so that a tile has a real size.", kTileSignatures,
     typed<applyTile>},
    {"deleteUV", "uv", "Takes the coordinates of a uv set away.", kDeleteSignatures,
     typed<applyDelete>},
    {"copyUV", "uv", "Copies the coordinates of one uv set to another.", kCopySignatures,
     typed<applyCopy>},
};

}  // namespace

extern const OpList kOps_uv;
const OpList kOps_uv = kSpecs;

}  // namespace gable
