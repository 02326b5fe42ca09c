// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Frames by the writers and readers of base/bytes.h, without what lies behind their last field.
#pragma once

#include <cstdint>

#include "math/frame.h"

namespace gable {

template <class Writer>
void writeFrame(Writer& w, const Frame& f) {
  for (const Vec3& v : {f.origin, f.x, f.y, f.z}) w.value(v);
  w.value(static_cast<uint8_t>(f.turned));
}

template <class Reader>
Frame readFrame(Reader& r) {
  Frame f;
  for (Vec3* v : {&f.origin, &f.x, &f.y, &f.z}) *v = r.template value<Vec3>();
  f.turned = r.template value<uint8_t>() != 0;
  return f;
}

}  // namespace gable
