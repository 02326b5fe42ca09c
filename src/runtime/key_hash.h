// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Hashing of what a rule call works on, 128 bits wide: equal keys stand for equal results.
#pragma once

#include <cstdint>

#include "base/hash.h"
#include "math/frame.h"
#include "runtime/output.h"
#include "shape/shape.h"

namespace gable {

class KeyHash {
 public:
  void add(uint64_t v) {
    a_ = hashCombine(a_, v);
    b_ = mix64(b_ * 0x9fb21c651e98df25ULL + v);
  }
  void add(double v) { add(hashDouble(v)); }
  void add(const Vec3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void add(const Frame& f) {
    add(f.origin);
    add(f.x);
    add(f.y);
    add(f.z);
  }
  /// Trim planes, projections, deformation.
  void add(const ShapeExtra& extra);
  ShareKey key() const { return {a_, b_ | 1}; }

 private:
  uint64_t a_ = 0x243f6a8885a308d3ULL, b_ = 0x13198a2e03707344ULL;
};

/// A key of a call without the set of attributes that its shape has, and with it; and back again.
inline ShareKey withAttributes(const ShareKey& key, uint32_t set) {
  return {key.a + mix64(set), key.b + (mix64(~uint64_t{set}) << 1)};
}
inline ShareKey withoutAttributes(const ShareKey& key, uint32_t set) {
  return {key.a - mix64(set), key.b - (mix64(~uint64_t{set}) << 1)};
}

}  // namespace gable
