// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a file of initial shapes; the first byte chooses the format. What is read can be
// derived.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "gable/gable.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const gable::Rules rules =
      gable::Rules::parse("A --> extrude(3) comp(f) { side : B | all : C }", "fuzz.cga");
  constexpr const char* kNames[] = {"a.geojson", "a.obj", "a.gltf", "a.glb"};
  if (size == 0) return 0;
  const std::string content(reinterpret_cast<const char*>(data + 1), size - 1);
  const gable::Shapes shapes = gable::Shapes::parse(content, kNames[data[0] % 4]);
  for (const gable::Diagnostic& m : shapes.diagnostics()) {
    GABLE_CHECK(!m.code.empty() && !m.message.empty());
  }
  if (!shapes.ok() || shapes.size() > 20) return 0;
  gable::DeriveSettings settings;
  settings.jobs = 1;
  settings.limits.shapes = 1000;
  settings.limits.vertices = 100000;
  (void)gable::derive(rules, shapes, settings).dump();
  return 0;
}
