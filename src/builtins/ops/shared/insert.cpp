// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/insert.h"

#include <cmath>

#include "builtins/ops/shared/frames.h"

namespace gable {

void fillZeroSizes(Shape& s, const Box3& box) {
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
  if (zeros == 0) return;
  const double ratio = zeros == 3 ? 1 : ratios > 0 ? sum / ratios : 1;
  Vec3 by;
  for (size_t i = 0; i < 3; ++i) {
    if (s.size[i] != 0) continue;
    s.size[i] = asset[i] * ratio;
    if (zeros > 1) by[i] = box.min[i] * ratio;
  }
  s.scope.origin = s.scope.point(by);
}

void insertMesh(Shape& s, Mesh mesh, const Box3& box) {
  if (box.min != Vec3{}) {
    for (Vec3& p : mesh.positions) p = p - box.min;
  }
  if (isMirrored(s.size)) mesh = reversed(mesh);
  s.assetMaterials = 0;
  if (mesh.empty())
    s.geometry = {};
  else
    s.geometry = {GeometryKind::Mesh, false, box.size(), makeRef<Mesh>(std::move(mesh))};
}

}  // namespace gable
