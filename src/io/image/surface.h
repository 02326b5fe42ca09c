// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pictures of the library's materials (material/library.h), drawn when they are asked for. A
// material is a field of heights with colours first; normals, occlusion and roughness come from
// the heights, so all pictures agree. They repeat without a seam. The same pixels on every
// machine: chance comes from whole numbers, the rest is sums, products, quotients and roots.
#pragma once

#include <string>
#include <vector>

#include "io/image/image.h"
#include "material/library.h"
#include "math/vec.h"

namespace gable {

/// Pixels each way; occlusion, roughness and metalness vary slowly and have half of that.
constexpr uint32_t kSurfaceSize = 512;

struct SurfaceTexel {
  /// Metres.
  double height = 0;
  /// sRGB.
  Vec3 color;
  double roughness = 1, metallic = 0;
};

/// Rows from the bottom, as v runs.
struct SurfaceField {
  std::vector<SurfaceTexel> texels;
  /// Wraps round.
  const SurfaceTexel& at(int x, int y) const {
    constexpr int n = static_cast<int>(kSurfaceSize);
    return texels[static_cast<size_t>((y + n) % n) * kSurfaceSize +
                  static_cast<size_t>((x + n) % n)];
  }
};

/// O(pixels), about 100 ms.
SurfaceField drawSurface(const LibraryMaterial& m);
Image pictureOf(const SurfaceField& field, const LibraryMaterial& m, MaterialPicture picture);
/// Of all pictures of a library material.
inline constexpr size_t kMostMaterialBytes = 120'000;
/// As JPEG, in a quality that falls to 30 while the colour has more than 56 kB, the normals more
/// than 44, the rest more than 20; then at half the size. Those of the library then fit.
Result<std::string> encodeMaterialPicture(Image image, MaterialPicture picture);

}  // namespace gable
