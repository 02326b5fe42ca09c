// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures treat what is a mirror and what is none in two ways: a material on both sides of the
// bound would be speckled by its own roughness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/image/surface.h"
#include "render/integrator.h"

namespace gable {
namespace {

TEST(Mirrors, noMaterialOfTheLibraryLiesAtTheBound) {
  for (const LibraryMaterial& m : materialLibrary()) {
    // The rest is far from it.
    if (std::abs(m.roughness - rt::kMirror) > 0.3) continue;
    const SurfaceField field = drawSurface(m);
    const auto near = std::count_if(
        field.texels.begin(), field.texels.end(),
        [](const SurfaceTexel& t) { return std::abs(t.roughness - rt::kMirror) < 0.02; });
    // Between glass and its frame some texels are.
    EXPECT_LT(static_cast<double>(near), 0.02 * static_cast<double>(field.texels.size())) << m.name;
  }
}

}  // namespace
}  // namespace gable
