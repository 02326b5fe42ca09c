// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/insert.h"

#include <cmath>

#include "builtins/ops/shared/frames.h"
#include "builtins/ops/shared/trim.h"
#include "geom/primitive/solids.h"
#include "shape/losses.h"

namespace gable {

void fillZeroSizes(Shape& s, const Box3& box) {
  if (s.size.x != 0 && s.size.y != 0 && s.size.z != 0) return;
  const Vec3 asset = box.size();
  int zeros = 0, ratios = 0;
  double sum = 0;
  for (size_t i = 0; i < 3; ++i) {
    if (s.size[i] == 0) {
      ++zeros;
    } else if (asset[i] > 0) {
      sum += std::fabs(s.size[i]) / asset[i];
      ++ratios;
    }
  }
  const double ratio = zeros == 3 ? 1 : ratios > 0 ? sum / ratios : 1;
  Vec3 by;
  for (size_t i = 0; i < 3; ++i) {
    if (s.size[i] != 0) continue;
    s.size[i] = asset[i] * ratio;
    if (zeros > 1) by[i] = box.min[i] * ratio;
  }
  s.scope.origin = s.scope.point(by);
}

void centerOnGround(Shape& s, const Vec3& size) {
  const Vec3 by{(s.size.x - std::fabs(size.x)) / 2, size.y < 0 ? size.y : 0,
                (s.size.z - std::fabs(size.z)) / 2};
  s.scope.origin = s.scope.point(by);
  s.size = {std::fabs(size.x), std::fabs(size.y), std::fabs(size.z)};
}

void insertMesh(Shape& s, Mesh mesh, const Box3& box) {
  if (box.min != Vec3{}) {
    for (Vec3& p : mesh.positions) p = p - box.min;
  }
  insertMesh(s, makeRef<Mesh>(std::move(mesh)), box.size());
}

void insertMesh(Shape& s, MeshRef mesh, const Vec3& size) {
  s.assetMaterials = 0;
  s.geometry = {};
  if (mesh->empty()) return;
  if (isMirrored(s.size)) mesh = makeRef<Mesh>(reversed(*mesh));
  s.geometry = {GeometryKind::Mesh, false, size, std::move(mesh)};
  s.geometry.instanced = true;
  trimGeometry(s);
}

void insertPrimitive(Shape& s, GeometryKind kind, bool uv) {
  s.assetMaterials = 0;
  Geometry& g = s.geometry;
  g.kind = kind;
  g.uv = uv;
  g.refSize = {};
  g.mesh = {};
  g.order = BoxOrder::Cube;
  g.tags.fill(0);
  g.instanced = true;
  if (s.extra) trimGeometry(s);
}

void insertPlaceholder(OpCall& call, std::string_view path, const std::string& why,
                       const char* hint) {
  call.services().warn(
      "missing-asset",
      "cannot insert '" + std::string(path) + "': " + why + "; its scope stands in its place",
      hint);
  Shape& s = call.shape();
  const int flat = (s.size.x == 0) + (s.size.y == 0) + (s.size.z == 0);
  if (flat == 0) return insertBox(s, false);
  if (flat == 1 && s.size.z == 0) insertPrimitive(s, GeometryKind::QuadXy, false);
  if (flat == 1 && s.size.y == 0) insertPrimitive(s, GeometryKind::QuadXz, false);
}

void tellLosses(const OpCall& call, std::string_view path, const AssetModel& model) {
  if (model.warnings.empty()) return;
  call.services().warn("read-with-loss", lossesOf(path, model.warnings), kWithoutThem);
}

void insertBox(Shape& s, bool uv) {
  if (s.size.x < 0 || s.size.y < 0 || s.size.z < 0)
    insertMesh(s, makeBoxMesh({1, 1, 1}, uv), kUnitBox);
  else
    insertPrimitive(s, GeometryKind::Box, uv);
}

Mesh builtinModel(std::string_view path) {
  // Round ones have radius 1 and lie around the axis.
  const auto round = [](const Mesh& m, double low, double high) {
    return transformed(m, {0.5, 1 / (high - low), 0.5},
                       Frame::moved({0.5, -low / (high - low), 0.5}));
  };
  if (path == "builtin:cube") return makeBoxMesh({1, 1, 1}, true);
  if (path == "builtin:cube:notex") return makeBoxMesh({1, 1, 1}, false);
  if (path == "builtin:quad") return makeQuadMesh(1, 1, QuadPlane::Xz, true);
  if (path == "builtin:disk") return round(makeDisk(16), 0, 1);
  if (path == "builtin:sphere") return round(makeSphere(16, 16), -1, 1);
  if (path == "builtin:cylinder") return round(makeCylinder(16), 0, 1);
  if (path == "builtin:cone") return round(makeCone(16), 0, 1);
  return {};
}

}  // namespace gable
