// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as GeoJSON: reading ends in valid shapes that face up, or in a status.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/check.h"
#include "io/importers/shape_input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gable;
  const auto file =
      readGeoJsonShapes(std::string_view(reinterpret_cast<const char*>(data), size), "a.geojson");
  if (!file.ok()) return 0;
  for (const ShapeInput& s : file.value().shapes) {
    GABLE_CHECK(s.mesh.valid());
    for (size_t f = 0; f < s.mesh.faceCount(); ++f) GABLE_CHECK(s.mesh.areaNormal(f).y > 0);
  }
  return 0;
}
