// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as rings on a small grid, so that collinear, touching and repeated points are common:
// booleans and offsets give valid regions, and areas add up. Two bytes are a point; 0xff ends a
// ring.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/check.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"

namespace {

using namespace gable;

// Longer input finds nothing that shorter input does not find faster.
constexpr size_t kMaxPoints = 64;

std::vector<Ring> ringsFrom(const uint8_t* data, size_t size) {
  std::vector<Ring> rings(1);
  for (size_t i = 0; i + 1 < size && i / 2 < kMaxPoints; i += 2) {
    if (data[i] == 0xff) {
      rings.emplace_back();
      continue;
    }
    // Sixteenths of a metre, the low bits pulled off the grid now and then.
    const double off = data[i] % 7 == 0 ? 1e-5 : 0;
    rings.back().push_back({data[i] / 16.0 + off, data[i + 1] / 16.0});
  }
  return rings;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  const double distance = (data[0] - 128) / 64.0;
  const size_t half = 1 + (size - 1) / 2;
  const Region a = repaired(ringsFrom(data + 1, half - 1), FillRule::EvenOdd);
  const Region b = repaired(ringsFrom(data + half, size - half), FillRule::NonZero);
  GABLE_CHECK(isValid(a) && isValid(b));
  const Region both = unite(a, b), common = intersect(a, b), rest = subtract(a, b);
  GABLE_CHECK(isValid(both) && isValid(common) && isValid(rest));
  // The grid moves each crossing by at most its step.
  const double tolerance = 1e-2;
  GABLE_CHECK(std::abs(area(a) + area(b) - area(both) - area(common)) < tolerance);
  GABLE_CHECK(std::abs(area(a) - area(common) - area(rest)) < tolerance);
  const Region moved = offset(a, distance);
  GABLE_CHECK(isValid(moved));
  if (distance < 0) GABLE_CHECK(area(moved) <= area(a) + tolerance);
  return 0;
}
