// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edits of texture coordinates. A mesh keeps its size of reference, so nothing of the geometry is
// touched; a primitive with the coordinates that it carries anyway stays a primitive.

#include <algorithm>
#include <cmath>
#include <string>

#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/subdivide/shared/uv_extent.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

using UvSet = std::vector<Vec2>;

// Runs an edit on the coordinates of the set that argument 0 names; none there is nothing to do.
template <class Edit>
Status editSet(OpCall& call, Edit edit) {
  int set = 0;
  if (Status bad = uvSetOf(call, 0, set); !bad) return bad;
  if (!hasUvSet(call.shape(), set)) return {};
  editMesh(call.shape(), [&](Mesh& m) { edit(m, m.uvs[static_cast<size_t>(set)]); });
  return {};
}

template <class Map>
Status mapSet(OpCall& call, Map map) {
  return editSet(call, [&](Mesh&, UvSet& uvs) {
    for (Vec2& uv : uvs) uv = map(uv);
  });
}

Status applyScale(OpCall& call) {
  const double u = call.number(1), v = call.number(2);
  return mapSet(call, [&](Vec2 uv) { return Vec2{uv.x * u, uv.y * v}; });
}

Status applyTranslate(OpCall& call) {
  const Vec2 by{call.number(1), call.number(2)};
  return mapSet(call, [&](Vec2 uv) { return uv + by; });
}

Status applyRotate(OpCall& call) {
  const double c = cosDeg(call.number(1)), s = sinDeg(call.number(1));
  return mapSet(call, [&](Vec2 uv) { return Vec2{uv.x * c - uv.y * s, uv.x * s + uv.y * c}; });
}

// Brings the coordinates of some corners into [0, 1].
void normalize(UvSet& uvs, const std::vector<uint32_t>& corners, std::string_view mode) {
  Box2 box;
  for (const uint32_t c : corners) box.include(uvs[c]);
  if (box.empty()) return;
  Vec2 by = box.min, size = box.size();
  if (mode == "uvUniform") size = {std::max(size.x, size.y), std::max(size.x, size.y)};
  Vec2 factor{size.x > 0 ? 1 / size.x : 0, size.y > 0 ? 1 / size.y : 0};
  if (mode == "u") {
    by.y = 0;
    factor.y = 1;
  } else if (mode == "v") {
    by.x = 0;
    factor.x = 1;
  }
  for (const uint32_t c : corners) {
    uvs[c] = {(uvs[c].x - by.x) * factor.x, (uvs[c].y - by.y) * factor.y};
  }
}

Status applyNormalize(OpCall& call) {
  const std::string_view mode = call.text(1, "uv");
  const bool separate = call.is(2, "separatePerFace");
  return editSet(call, [&](Mesh& m, UvSet& uvs) {
    std::vector<uint32_t> corners;
    for (size_t f = 0; f < m.faceCount(); ++f) {
      for (const MeshLoop& loop : m.loopsOf(f)) {
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
double tileFactor(const Value& tile, const UvExtent& extent) {
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

Status applyTile(OpCall& call) {
  int set = 0;
  if (Status bad = uvSetOf(call, 0, set); !bad) return bad;
  if (!hasUvSet(call.shape(), set)) return {};
  const MeshRef measured = meshInScope(call.shape());
  const Vec2 factor{tileFactor(call.arg(1), uvExtent(*measured, set, 0)),
                    tileFactor(call.arg(2), uvExtent(*measured, set, 1))};
  return mapSet(call, [&](Vec2 uv) { return Vec2{uv.x * factor.x, uv.y * factor.y}; });
}

Status applyDelete(OpCall& call) {
  int set = 0;
  if (Status bad = uvSetOf(call, 0, set); !bad) return bad;
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

Status applyCopy(OpCall& call) {
  int from = 0, to = 0;
  if (Status bad = uvSetOf(call, 0, from); !bad) return bad;
  if (Status bad = uvSetOf(call, 1, to); !bad) return bad;
  if (from == to || (!hasUvSet(call.shape(), from) && !hasUvSet(call.shape(), to))) return {};
  editMesh(call.shape(),
           [&](Mesh& m) { m.uvs[static_cast<size_t>(to)] = m.uvs[static_cast<size_t>(from)]; });
  return {};
}

constexpr ParamSpec kSet = {"uvSet", ParamType::Float, "The uv set, 0 to 9."};

constexpr ParamSpec kScaleParams[] = {
    kSet,
    {"uFactor", ParamType::Float, "What u is multiplied by."},
    {"vFactor", ParamType::Float, "What v is multiplied by."},
};
constexpr Signature kScaleSignatures[] = {{kScaleParams}};

constexpr ParamSpec kTranslateParams[] = {
    kSet,
    {"uOffset", ParamType::Float, "What is added to u; 1 is the width of the texture."},
    {"vOffset", ParamType::Float, "What is added to v."},
};
constexpr Signature kTranslateSignatures[] = {{kTranslateParams}};

constexpr ParamSpec kRotateParams[] = {
    kSet,
    {"angle", ParamType::Float, "The turn around u = v = 0, in degrees."},
};
constexpr Signature kRotateSignatures[] = {{kRotateParams}};

constexpr ParamSpec kNormalizeParams[] = {
    kSet,
    {"normalizeMode", ParamType::Selector,
     "Both coordinates each by itself, both by the larger one, or only one of them.", nullptr,
     "uv uvUniform u v"},
    {"normalizeType", ParamType::Selector,
     "Whether each face comes to fill [0, 1] or all faces together.", nullptr,
     "separatePerFace collectiveAllFaces"},
};
constexpr Signature kNormalizeSignatures[] = {{kNormalizeParams}};

constexpr ParamSpec kTileParams[] = {
    kSet,
    {"textureWidth", ParamType::FloatingSize,
     "Width of a tile in metres; with ' as a share of what there is, with ~ about that wide so "
     "that whole tiles fit; 0 leaves u."},
    {"textureHeight", ParamType::FloatingSize, "Height of a tile, likewise; 0 leaves v."},
};
constexpr Signature kTileSignatures[] = {{kTileParams}};

constexpr ParamSpec kDeleteParams[] = {kSet};
constexpr Signature kDeleteSignatures[] = {{kDeleteParams}};

constexpr ParamSpec kCopyParams[] = {
    {"uvSetSource", ParamType::Float, "The uv set to copy, 0 to 9."},
    {"uvSetDest", ParamType::Float, "The uv set to overwrite, 0 to 9."},
};
constexpr Signature kCopySignatures[] = {{kCopyParams}};

constexpr OpSpec kSpecs[] = {
    {"scaleUV", "uv", "Multiplies texture coordinates.", kScaleSignatures, applyScale},
    {"translateUV", "uv", "Shifts texture coordinates.", kTranslateSignatures, applyTranslate},
    {"offsetUV", "uv", "Old name of translateUV.", kTranslateSignatures, applyTranslate},
    {"rotateUV", "uv", "Turns texture coordinates around their origin.", kRotateSignatures,
     applyRotate},
    {"normalizeUV", "uv", "Brings texture coordinates into the range from 0 to 1.",
     kNormalizeSignatures, applyNormalize},
    {"tileUV", "uv", "Scales texture coordinates so that a tile has a real size.", kTileSignatures,
     applyTile},
    {"deleteUV", "uv", "Takes the coordinates of a uv set away.", kDeleteSignatures, applyDelete},
    {"copyUV", "uv", "Copies the coordinates of one uv set to another.", kCopySignatures,
     applyCopy},
};

}  // namespace

extern const OpList kOps_uv;
const OpList kOps_uv = kSpecs;

}  // namespace gable
